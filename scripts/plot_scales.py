"""Honest scales: noise is no curve, ticks can be read, and a few extreme values don't flatten all others."""

import numpy as np

SAME = 1e-9  # of its scale: what differs by less is one value
NEGLIGIBLE = 1e-12  # of the largest: the phase of such an amplitude is noise
MOST_LEVELS = 12  # integers that have a colour each
MOSTLY = 0.8  # share of whole numbers that makes a count
FAR = 3.0  # interquartile ranges beyond the quartiles


def shown_values(output, name):
    """The values of a result as floats, in its own shape; NaN for infinite ones, for the period of motion without one,
    and for phases of negligible amplitudes."""
    values = output.values(name).astype(float)
    values = np.where(np.isfinite(values), values + 0.0, np.nan)  # no negative zero
    if name == "period_ratio":
        values[values == 0] = np.nan
    if name.endswith("_phase"):
        amplitude = np.abs(output.values(name.replace("_phase", "_amplitude")))
        values[amplitude <= NEGLIGIBLE * largest(amplitude)] = np.nan
    return values


def largest(values):
    """The largest modulus; 0 if there is no number."""
    moduli = np.abs(values[np.isfinite(values)])
    return float(moduli.max()) if moduli.size else 0.0


def is_constant(values, scale):
    """Whether all numbers are one, to rounding of a quantity of this scale."""
    known = values[np.isfinite(values)]
    return known.size > 0 and float(np.ptp(known)) <= SAME * scale


def constant_value(values, scale):
    """The value of a constant; 0 if it is noise."""
    value = float(np.nanmean(values))
    return 0.0 if abs(value) <= SAME * scale else value


def is_integer(values):
    """Whether all numbers are whole."""
    known = values[np.isfinite(values)]
    return known.size > 0 and bool((known == np.round(known)).all())


def is_count(values):
    """Whether all numbers are whole, or most of them and several, as impacts per period."""
    known = values[np.isfinite(values)]
    whole = known[known == np.round(known)]
    return is_integer(known) or len(whole) >= MOSTLY * known.size and len(np.unique(whole)) > 2


def colour_range(values):
    """The least and the greatest value of a colour scale, and whether greater ones are clipped: of counts those far
    beyond the usual ones, as of chatter, which would leave no colours for the others (Tukey's outer fence)."""
    known = values[np.isfinite(values)]
    low, high = float(known.min()), float(known.max())
    if not is_count(values) or high - low < MOST_LEVELS:
        return low, high, False
    first, third = np.quantile(known, (0.25, 0.75))
    fence = np.floor(min(third + FAR * max(third - first, 1.0), low + MOST_LEVELS - 1))
    return low, float(fence), True
