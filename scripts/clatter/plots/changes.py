"""Where neighbours along an axis are different motions, so that no line joins them: another impact word, another period
or attractor, or the mirror image."""

import numpy as np

from .scales import shown_values

NAMES = ("impact_word", "regime", "period_ratio", "attractor")  # results that tell motions apart
DERIVED = ("d_", "multiplier_", "lyapunov")  # how results of the derivative of the motion begin
PAIRS = (("v_min", "v_max"), ("z_min", "z_max"))  # the mirror image changes each for minus the other
SAME = 1e-6  # of the scale: what differs by less is noise
NEARER = 0.5  # how much nearer than its neighbour the mirror image must be
SIDED = (
    "R",
    "stop_stiffness",
    "stop_damping",
    "stop_R",
    "stop_amplitude",
    "stop_phase",
)  # keys that a stop may have for itself
ROUNDING = 1e-12


def changes_of_motion(output, result=""):
    """Whether the motion is another one between each point of the only axis and the next, or motion that is its own
    mirror image and motion that isn't, between which derivatives jump. Transients are one motion from several
    starts."""
    points = len(output.values(output.axes[0]))
    changes = np.zeros(max(points - 1, 0), bool)
    if output.is_transient:
        return changes
    for values in (output.values(name) for name in NAMES if name in output):
        changes |= differs(values)
    if "impact_word" not in output and "impacts_per_period" in output:
        changes |= differs(impacts_of_one_period(output)).any(axis=1)
    if result.startswith(DERIVED):
        changes |= differs(symmetries(output))
    return changes | swaps(output)


def differs(values):
    """Whether each value isn't the next; a value that neither has is the same."""
    one, other = values[:-1], values[1:]
    return (one != other) & ~((one != one) & (other != other))


def impacts_of_one_period(output):
    """The impacts of a period on each stop; NaN for motion without one."""
    ratio = shown_values(output, "period_ratio") if "period_ratio" in output else np.ones(output.shape)
    return np.round(output.values("impacts_per_period") * ratio[:, None], 6)


def symmetries(output):
    """Whether each motion is its own mirror image: as the file says, else as its results tell."""
    if "symmetric" in output:
        return output.values("symmetric")
    own, mirrored, mirror, scale = compared_with_mirror(output)
    return mirror & (length((own - mirrored) / scale) <= SAME) if len(own) else np.zeros(len(mirror), bool)


def swaps(output):
    """Whether the next point is nearer to the mirror image of each point than to the point."""
    own, mirrored, mirror, scale = compared_with_mirror(output)
    if not len(own):
        return np.zeros(max(len(mirror) - 1, 0), bool)
    straight = length((own[:, 1:] - own[:, :-1]) / scale)
    across = length((own[:, 1:] - mirrored[:, :-1]) / scale)
    return mirror[:-1] & mirror[1:] & (straight > SAME) & (across < NEARER * straight)


def compared_with_mirror(output):
    """Results of each motion, the same of its mirror image, whether that is a motion, too, and the scale of each."""
    with np.errstate(invalid="ignore"):  # stops that aren't there are infinite
        own, mirrored = features(output)
        mirror = has_mirror(output)
    if not len(own):
        return own, mirrored, mirror, 1.0
    scale = np.nanmax(np.abs(own), axis=1, initial=0.0, where=np.isfinite(own))[:, None]
    scale[scale == 0.0] = 1.0
    return own, mirrored, mirror, scale


def features(output):
    """Results that tell motion from its mirror image, and the same of the mirror image: a row for each, a column for
    each point."""
    own, mirrored = [], []
    for low, high in (pair for pair in PAIRS if all(name in output for name in pair)):
        low, high = shown_values(output, low), shown_values(output, high)
        own += [low, high]
        mirrored += [-high, -low]
    middle = sum(output.stops()) / 2
    if "x_min" in output and "x_max" in output and np.isfinite(middle).all():
        low, high = (shown_values(output, name) - middle for name in ("x_min", "x_max"))
        own += [low, high]
        mirrored += [-high, -low]
    if "impact_speed" in output:
        speeds = np.nan_to_num(shown_values(output, "impact_speed")).T
        own += list(speeds)
        mirrored += list(speeds[::-1])
    return np.array(own), np.array(mirrored)


def length(steps):
    """The length of each step, as far as it is known."""
    return np.sqrt(np.nansum(steps**2, axis=0))


def has_mirror(output):
    """Whether the mirror image of each motion is one, too, at every point."""
    lower, upper = output.stops()
    stiffness = output.parameter("stiffness", 1.0)
    rest = np.divide(output.parameter("load", 0.0), stiffness, where=stiffness != 0, out=np.zeros(output.shape))
    alike = np.isfinite(lower) == np.isfinite(upper)
    alike &= (output.parameter("load", 0.0) == 0) | (stiffness != 0)
    bounded = np.isfinite(lower) & np.isfinite(upper)
    alike &= ~bounded | (np.abs((lower + upper) / 2 - rest) <= ROUNDING * np.abs(upper - lower))
    for key in SIDED:
        sides = [output.parameter(f"{key}_{side}") for side in ("lower", "upper")]
        both = output.parameter(key)
        one, other = (np.where(np.isnan(own), both, own) for own in sides)
        alike &= (one == other) | np.isnan(one) & np.isnan(other)
    if output.has_loose_mass:
        alike &= (output.parameter("loose_load", 0.0) == 0) & np.isfinite(sum(output.walls()))
        lower, upper = (output.parameter(f"loose_R_{side}", 1.0) for side in ("lower", "upper"))
        alike &= lower == upper
    return alike
