"""Totals over the observed time, which isn't the same at all points: one period of periodic motion, a window of motion
without a period. Where points are compared, they are given per forcing period."""

import copy
import dataclasses

import numpy as np

from .data import has_failed, lacks_period

TOTALS = ("work_in", "loss_damping", "loss_friction", "loss_impact", "impulse")
WINDOW = 64  # forcing periods, of files that don't tell
WHOLE = 1e-6  # how close to a whole number the observed forcing periods have to be
IN_TIME, PER_PERIOD = "in the observed time", "per forcing period"


def compared(output):
    """An output whose totals are per forcing period, if the file tells for how many of them each point was observed, so
    that points can be compared; else they are those of the file. Labels say which."""
    totals = [name for name in TOTALS if name in output]
    if not totals or not output.axes or output.is_branch:
        return output
    periods = observed_periods(output)
    known = np.isfinite(periods[~has_failed(output.values("status"))]).all()
    part = copy.copy(output)
    part.variables = dict(output.variables)
    for name in totals:
        part.variables[name] = per_period(output[name], periods) if known else titled(output[name], IN_TIME)
    return part


def per_period(variable, periods):
    along = periods.reshape(periods.shape + (1,) * (variable.values.ndim - periods.ndim))
    words = variable.long_name.replace(IN_TIME, PER_PERIOD)
    return dataclasses.replace(titled(variable, PER_PERIOD), values=variable.values / along, long_name=words)


def titled(variable, words):
    return dataclasses.replace(variable, label=f"{variable.label} {words}".strip())


def observed_periods(output):
    """For how many forcing periods each point was observed; NaN where the file doesn't tell, or there is no force."""
    if output.is_transient or not output.is_forced():
        return np.full(output.shape, np.nan)
    status = output.values("status")
    window = float(output.config.get("time", {}).get("window", WINDOW))
    if "period_ratio" in output:
        found = output.values("period_ratio").astype(float)
        periods = np.where(found > 0, found, np.nan)
    else:
        periods = np.full(output.shape, np.nan)
    periods = np.where(np.isnan(periods), told_by_losses(output), periods)
    return np.where(lacks_period(status), window, periods)


def told_by_losses(output):
    """The same as the losses in impacts and their mean power tell it: motion that presses no stop repeats with the
    force."""
    if any(name not in output for name in ("loss_impact", "impulse", "impact_power")):
        return np.full(output.shape, np.nan)
    lost, pressed = (np.nansum(output.values(name), axis=-1) for name in ("loss_impact", "impulse"))
    frequency = output.parameter("frequency" if output.is_si else "nu", 1.0)
    period = 1 / frequency if output.is_si else 2 * np.pi / frequency
    with np.errstate(all="ignore"):
        periods = lost / output.values("impact_power") / period
    whole = np.round(periods)
    periods = np.where((whole >= 1) & (np.abs(periods - whole) <= WHOLE * whole), whole, np.nan)
    return np.where(pressed == 0, 1.0, periods)
