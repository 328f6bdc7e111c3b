"""Names of variables and constants in pictures: words, symbols, values with their units; and texts of files and command
lines as pictures show them."""

import functools
import re
from itertools import groupby

import numpy as np
from matplotlib import mathtext

POWERS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
LONGEST = 12  # letters of a word that is written out
SHORT = 0.1  # m: lengths that are all below it are written in mm
STUCK = "(S)"  # the word of a mass that friction holds for good, wherever that is
NO_CONTACT = ("-", "")  # the words of motion that meets no stop; the empty one in files before 0.3.0
YES_OR_NO = ("symmetric",)  # what 1 and 0 stand for
PLACES = ("x", "x_min", "x_max")  # drawn between the stops
SENSITIVITY = re.compile("∂(.+)/∂(.+)")  # the symbol of a derivative
RECORDED = {"tau": "impact_tau", "v_before": "impact_v_before", "x": "section_x", "v": "section_v"}  # the same, too


def names_of(output, name):
    """Words and symbol of a variable of an output, or of a constant of its scene; empty if the file has none. A
    sensitivity has a symbol only if both that it is made of have one."""
    variable = variable_of(output, name)
    if variable and is_key(variable.symbol) and is_sensitivity(variable):
        return sensitivity_in_words(output, variable), ""
    if variable and (variable.label or variable.symbol):
        return variable.label, typeset_symbol(variable.symbol)
    constant = output.constants.get(name, {})
    return constant.get("words", ""), typeset_symbol(constant.get("symbol", ""))


def symbol(output, name):
    """The symbol of a variable or constant; its words if it has none but its key."""
    sign = names_of(output, name)[1]
    return words_of(output, name) if is_key(sign) else sign or name.replace("_", " ")


def is_key(sign):
    """Whether a symbol is, or has in it, only the key of a configuration, e.g. damping_ratio."""
    return "_" in re.sub(r"\$[^$]*\$", "", sign)


def is_sensitivity(variable):
    return bool(SENSITIVITY.fullmatch(variable.symbol))


def sensitivity_in_words(output, variable):
    """Of which result to which key, each by its symbol if that is mathematics, else in words."""
    result, key = (
        sign if "$" in sign else f"the {words_of(output, sign) if is_key(sign) else sign}"
        for sign in SENSITIVITY.fullmatch(variable.symbol).groups()
    )
    return f"sensitivity of {typeset_symbol(result)} to {typeset_symbol(key)}"


def words_of(output, name):
    """A variable or constant in words."""
    constant = output.constants.get(name, {})
    return constant.get("words") or names_of(output, name)[0] or name.replace("_", " ")


def label(output, name):
    """Axis label: words and symbol if the name is known, else long_name; the unit unless it is 1."""
    words, sign = names_of(output, name)
    if is_key(sign):
        words, sign = words or words_of(output, name), ""
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
    return output.units.get(name, output.constants.get(name, {}).get("units", "1"))


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
    found = re.fullmatch(r"d_(.+?)_d_(.+)", name)
    if found and is_sensitivity(output[name]):
        result = plain(output[found[1]].long_name) if found[1] in output else found[1].replace("_", " ")
        sign = names_of(output, found[2])[1]
        key = words_of(output, found[2]) if "$" in sign or is_key(sign) else sign
        return f"sensitivity of the {result} to the {key}"
    return words_of(output, name) if name in YES_OR_NO else plain(output[name].long_name)


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
        words = words_of(output, name)
        return words.replace("stiffness of the", "rigid") if name.startswith("stop_stiffness") else f"no {words}"
    return f"{symbol(output, name)} = {amount(output, name, value)}"


def typeset_unit(unit):
    """A unit of the file with its powers raised: m s-1 becomes m s⁻¹, which no line ends within."""
    return re.sub(r"(?<=[A-Za-z])(-?\d+)", r"$^{\1}$", plain(unit)).replace(" ", "\N{NO-BREAK SPACE}")


def in_one_line(unit):
    """A unit of the file without powers: m s-1 becomes m/s, and kg s-2 kg/s²."""
    over, under = [], []
    for letters, sign, power in re.findall(r"([^\s\d-]+)(-?)(\d*)", unit):
        (under if sign else over).append(letters + power.translate(POWERS) * (power not in ("", "1")))
    below = " ".join(under)
    return (" ".join(over) or "1") + (f"/({below})" if len(under) > 1 else f"/{below}" if under else "")


def number(value):
    """A number as text, with a real minus sign, and none for zero."""
    return re.sub(r"e([-+])0", r"e\1", f"{value + 0.0:.6g}").replace("-", "\N{MINUS SIGN}")


@functools.lru_cache(maxsize=None)
def typeset_symbol(text):
    """A symbol of a file if it is mathematics that can be typeset, else as text. It takes milliseconds to find out."""
    try:
        mathtext.MathTextParser("path").parse(text)
    except ValueError:
        return plain(text)
    return text


def plain(text):
    """A text in one line without mathematics, and with a mark for what no picture can show."""
    text = re.sub(r"[\t\n\r]", " ", text)
    return re.sub(r"[\x00-\x1f\x7f\ud800-\udfff]", "\N{REPLACEMENT CHARACTER}", text).replace("$", r"\$")


def has_impacts(word):
    """Whether an impact word has a letter of a stop: motion that meets no stop, or stays where it is, has none."""
    return word[:1] != "(" and not {"L", "U"}.isdisjoint(word)


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
