"""Names of variables and constants in pictures: words, symbols, values with their units; and texts of files and command
lines as pictures show them."""

import re
from itertools import groupby

import numpy as np

# Words and symbol of what the paper and the configuration name; anything else is labelled by its long_name.
LABELS = {
    "h": ("damping ratio", r"$h$"),
    "f": ("force amplitude", r"$f$"),
    "nu": ("excitation frequency", r"$\nu$"),
    "phase": ("forcing phase", r"$\varphi$"),
    "R": ("restitution", r"$R$"),
    "xs": ("stop", r"$x_s$"),
    "stop_lower": ("lower stop", r"$x_-$"),
    "stop_upper": ("upper stop", r"$x_+$"),
    "R_lower": ("restitution, lower stop", r"$R_-$"),
    "R_upper": ("restitution, upper stop", r"$R_+$"),
    "stop_stiffness": ("stiffness of the stops", r"$\kappa$"),
    "stop_stiffness_lower": ("stiffness of the lower stop", r"$\kappa_-$"),
    "stop_stiffness_upper": ("stiffness of the upper stop", r"$\kappa_+$"),
    "stop_damping": ("damping of the stops", r"$\zeta$"),
    "stop_damping_lower": ("damping of the lower stop", r"$\zeta_-$"),
    "stop_damping_upper": ("damping of the upper stop", r"$\zeta_+$"),
    "load": ("constant load", "load"),
    "stiffness": ("stiffness", r"$k$"),
    "mass": ("mass", r"$m$"),
    "damping": ("damping", r"$c$"),
    "damping_ratio": ("damping ratio", r"$h$"),
    "quality": ("quality factor", r"$Q$"),
    "force": ("force amplitude", r"$F$"),
    "frequency": ("excitation frequency", r"$f$"),
    "gap": ("stop", r"$x_s$"),
    "stop_amplitude": ("amplitude of the stops", r"$b$"),
    "base_amplitude": ("amplitude of the base", r"$b$"),
    "x0": ("initial displacement", r"$x(0)$"),
    "v0": ("initial velocity", "$x$\N{PRIME}$(0)$"),
    "start_period": ("period", r"$\bar\tau$"),
    "tau": ("time", r"$\tau$"),
    "x": ("displacement", r"$x$"),
    "v": ("velocity", "$x$\N{PRIME}"),
    "x_min": ("minimum", r"$x_{\min}$"),
    "x_max": ("maximum", r"$x_{\max}$"),
    "v_min": ("minimum", "$x$\N{PRIME}$_{\\min}$"),
    "v_max": ("maximum", "$x$\N{PRIME}$_{\\max}$"),
    "v_before": ("velocity before impact", "$x$\N{PRIME}$^{{-}}$"),
    "v_after": ("velocity after impact", "$x$\N{PRIME}$^{{+}}$"),
    "period": ("period", r"$\bar\tau$"),
    "eigenfrequency": ("eigenfrequency", r"$\bar\omega$"),
    "period_ratio": ("period", r"$\nu\bar\tau/2\pi$"),
    "velocity_ratio": ("velocity ratio", "$|x$\N{PRIME}$^{{-}}/x_s|$"),
    "base_frequency": ("base frequency", r"$\Omega$"),
    "harmonic": ("harmonic", r"$k$"),
    "x_amplitude": ("amplitude of displacement", r"$a_k$"),
    "v_amplitude": ("amplitude of velocity", "$a$\N{PRIME}$_k$"),
    "x_phase": ("phase of displacement", r"$\varphi_k$"),
    "v_phase": ("phase of velocity", "$\\varphi$\N{PRIME}$_k$"),
    "multiplier_re": ("multipliers", r"$\mathrm{Re}\,\mu$"),
    "multiplier_im": ("multipliers", r"$\mathrm{Im}\,\mu$"),
    "lyapunov": ("Lyapunov exponent", r"$\lambda$"),
    "impacts_per_period": ("impacts per period", ""),
    "rest_fraction": ("share of time at rest", ""),
    "contact_fraction": ("share of time in contact", ""),
    "contact_force_max": ("greatest force of the stop", ""),
    "symmetric": ("symmetric motion", ""),
    "attractor": ("motion", ""),
    "settling_periods": ("periods until settled", ""),
    "work_in": ("work of force and load", "work"),
    "loss_damping": ("loss by damping", "damping"),
    "loss_impact": ("loss by impacts", ""),
    "impulse": ("impulse", ""),
    "impact_power": ("power lost in impacts", ""),
}


# The same where a scene is given in [machine]: its own keys, but for the letters of its equation m x'' + c x' + k x.
SI_LABELS = {
    **{
        key: ("", key)
        for key in (
            *("damping_ratio", "gap", "stop_lower", "stop_upper", "R_lower", "R_upper", "stop_amplitude"),
            *("stop_stiffness", "stop_stiffness_lower", "stop_stiffness_upper", "base_amplitude"),
            *("stop_damping", "stop_damping_lower", "stop_damping_upper"),
        )
    },
    "quality": ("quality factor", "quality"),
    "frequency": ("excitation frequency", "frequency"),
    "phase": ("forcing phase", "phase"),
    "tau": ("time", "$t$"),
    "period": ("period", "$T$"),
    "period_ratio": ("period in forcing periods", ""),
    "eigenfrequency": ("eigenfrequency", ""),
    "base_frequency": ("base frequency", ""),
    "velocity_ratio": ("velocity ratio", "$|x$\N{PRIME}$^{{-}}|$ / gap"),
}

# The units of constants in [machine], as of the variables in the file.
UNITS = {
    "mass": "kg",
    **dict.fromkeys(("stiffness", "stop_stiffness", "stop_stiffness_lower", "stop_stiffness_upper"), "N m-1"),
    "damping": "N s m-1",
    "force": "N",
    "frequency": "Hz",
    "phase": "rad",
    "load": "N",
    "v0": "m s-1",
    **dict.fromkeys(("gap", "stop_lower", "stop_upper", "stop_amplitude", "base_amplitude", "x0"), "m"),
}
LONGEST = 12  # letters of a word that is written out
SHORT = 0.1  # m: lengths that are all below it are written in mm
YES_OR_NO = ("symmetric",)  # what 1 and 0 stand for
PLACES = ("x", "x_min", "x_max")  # drawn between the stops
RECORDED = {"tau": "impact_tau", "v_before": "impact_v_before", "x": "section_x", "v": "section_v"}  # the same, too


def names_of(output, name):
    """Words and symbol of a variable of an output, or of a constant of its scene; empty if it has none."""
    return (SI_LABELS if output.is_si and name in SI_LABELS else LABELS).get(name, ("", ""))


def symbol(name, output=None):
    """The symbol of a variable or constant, of an output as it names it; its name in the file if it has none."""
    _, sign = names_of(output, name) if output else LABELS.get(name, ("", ""))
    return sign or name.replace("_", " ")


def words_of(name):
    return LABELS.get(name, ("", ""))[0] or name.replace("_", " ")


def label(output, name):
    """Axis label: words and symbol if the name is known, else long_name; the unit unless it is 1."""
    words, sign = names_of(output, name)
    variable = variable_of(output, name)
    if name == "impacts_per_period" and output.is_transient:
        words = ""
    full = f"{words} {sign if sign not in words else ''}".strip() or plain(variable.long_name if variable else name)
    return in_frame(output, name, with_unit(output, full, name)) + " (∞ left out)" * (name in output.left_out)


def variable_of(output, name):
    """The variable of an output that holds a quantity, by its own name or as it was recorded; None if there is none."""
    return output.variables.get(name) or output.variables.get(RECORDED.get(name, ""))


def in_frame(output, name, words):
    """Words for a variable, and its frame if something is shaken."""
    variable = variable_of(output, name)
    return f"{words}, {variable.frame}" if variable and variable.frame else words


def with_unit(output, words, *names):
    """Words for variables that share an axis, followed by their unit, unless it is 1."""
    unit = unit_of(output, *names)
    return f"{words} ({unit})" if unit else words


def unit_of(output, *names, value=None):
    """The unit of variables of the file, or of a constant of its scene that has this value, typeset; "" if they have
    none."""
    unit = si_unit(output, names[0])
    if unit == "m" and output.is_si and are_short(output, names, value):
        unit = "mm"
    return typeset_unit(unit) if unit != "1" else ""


def si_unit(output, name):
    """The unit that a file has for a variable, or for a constant of its scene."""
    variable = variable_of(output, name)
    if variable:
        return variable.units
    return output.units.get(name, UNITS.get(name, "1") if output.is_si else "1")


def are_short(output, names, value):
    """Whether all lengths that share an axis, and the stops among them, read better in mm."""
    found = [variable_of(output, name) for name in names]
    known = [variable.values for variable in found if variable]
    known = known or [output.parameter(names[0]) if value is None else value]
    if any(name in PLACES for name in names):
        known += output.reach()
    sizes = np.abs(np.concatenate([np.ravel(values).astype(float) for values in known]))
    sizes = sizes[np.isfinite(sizes)]
    return 0.0 < sizes.max(initial=0.0) < SHORT


def scale_in(words):
    """By how much the numbers of an axis are multiplied where they are written: data stay in m where words say mm."""
    return 1e3 if "(mm)" in words else 1.0


def result_in_words(output, name):
    """A result as a sentence has it, in words alone."""
    return words_of(name) if name in YES_OR_NO else plain(output[name].long_name)


def amount(output, name, value):
    """A value of a variable or constant with its unit, as text."""
    if name in YES_OR_NO:
        return "yes" if value else "no"
    unit = unit_of(output, name, value=value)
    return f"{number(value * (1e3 if unit == 'mm' else 1.0))}\N{NO-BREAK SPACE}{unit}".strip()


def equation(output, name, value):
    """A variable or constant and its value, as text, e.g. ν = 0.5."""
    if name == "direction":
        return "up" if value > 0 else "down"
    if not np.isfinite(value):
        words = words_of(name)
        return words.replace("stiffness of the", "rigid") if name.startswith("stop_stiffness") else f"no {words}"
    return f"{symbol(name, output)} = {amount(output, name, value)}"


def typeset_unit(unit):
    """A unit of the file with its powers raised: m s-1 becomes m s⁻¹, which no line ends within."""
    return re.sub(r"(?<=[A-Za-z])(-?\d+)", r"$^{\1}$", plain(unit)).replace(" ", "\N{NO-BREAK SPACE}")


def number(value):
    """A number as text, with a real minus sign, and none for zero."""
    return re.sub(r"e([-+])0", r"e\1", f"{value + 0.0:.6g}").replace("-", "\N{MINUS SIGN}")


def plain(text):
    """A text in one line without mathematics, and with a mark for what no picture can show."""
    text = re.sub(r"[\t\n\r]", " ", text)
    return re.sub(r"[\x00-\x1f\x7f\ud800-\udfff]", "\N{REPLACEMENT CHARACTER}", text).replace("$", r"\$")


def short_word(word):
    """An impact word, a long one with powers of what repeats: LLLLLLLUUUUUUU becomes L⁷U⁷."""
    if len(word) <= LONGEST:
        return plain(word)
    shown, room = "", LONGEST
    for letter, run in groupby(re.findall(r"\w\*?", word)):
        times = len(list(run))
        room -= len(letter) + (len(str(times)) if times > 1 else 0)
        if room < 0:
            return shown + "…"
        shown += letter + (f"$^{{{times}}}$" if times > 1 else "")
    return shown
