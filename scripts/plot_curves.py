"""Panels of results over the only axis, with the status of the points, and those of a single point."""

import numpy as np
from matplotlib import ticker

from plot_data import APERIODIC, FIRST_FAILURE
from plot_style import BLUE, CYCLE, STOP, draw_walls, label, legend_above, number, set_axis

DENSE = 60  # points from which a curve is drawn without markers


def draw_branch(axes, output, name, values, color, title, loose_color=None, **style):
    """One result along the only axis: a line through the points that repeat, hollow markers for those that don't."""
    along, loose = output.values(name), output.values("status") == APERIODIC
    along, values, loose = split_at_jumps(along, values, loose)
    steady = np.where(loose, np.nan, values)
    marker = "." if len(along) < DENSE else None
    axes.plot(along, steady, label=title, color=color, **{"lw": 1.2, "marker": marker, **style})
    alone = lonely(steady)
    axes.plot(along[alone], steady[alone], ls="none", marker=".", ms=3.2, color=color)
    axes.plot(
        along[loose],
        values[loose],
        ls="none",
        marker="o",
        ms=3.2,
        mfc="white",
        mec=loose_color or color,
        mew=0.8,
        zorder=3,
    )


def split_at_jumps(along, values, loose):
    """Puts a gap where the result jumps from one branch of the motion to another: no motion lies between."""
    step = np.diff(values)
    if len(values) < DENSE or not np.isfinite(step).any():
        return along, values, loose
    after, before = np.append(step[1:], 0.0), np.insert(step[:-1], 0, 0.0)
    around = np.fmax(*(np.where(np.sign(beside) == np.sign(step), np.abs(beside), 0.0) for beside in (before, after)))
    extent = np.nanmax(values) - np.nanmin(values)
    jumps = np.flatnonzero((np.abs(step) > 0.01 * extent) & (np.abs(step) > 4 * around)) + 1
    return np.insert(along, jumps, along[jumps]), np.insert(values, jumps, np.nan), np.insert(loose, jumps, False)


def lonely(values):
    """Points that no line reaches, since both neighbours are missing."""
    known = np.isfinite(values)
    beside = np.append(known[1:], False) | np.insert(known[:-1], 0, False)
    return known & ~beside


def name_statuses(axes, output, name, color=STOP, shown=True):
    """Legend entries for aperiodic points, and failed points marked at the foot of the panel."""
    along, status = output.values(name), output.values("status")
    if (status == APERIODIC).any() and shown:
        axes.plot([], [], ls="none", marker="o", ms=3.8, mfc="white", mec=color, mew=0.9, label="aperiodic")
    failed = status >= FIRST_FAILURE
    if failed.any():
        kinds = ", ".join(output.meanings.get(int(kind), "failed") for kind in np.unique(status[failed]))
        axes.plot(
            along[failed],
            np.full(failed.sum(), 0.03),
            transform=axes.get_xaxis_transform(),
            ls="none",
            marker="x",
            ms=5,
            mew=1.1,
            color="#c00000",
            clip_on=False,
            zorder=4,
            label=f"failed: {kinds}",
        )


def draw_stops_along(axes, output, name):
    """The stops in a panel of displacements over a swept axis."""
    along, (lower, upper) = output.values(name), output.stops()
    if np.ptp(lower) == 0.0 and np.ptp(upper) == 0.0 or not np.isfinite([lower, upper]).all():
        return draw_walls(axes, lower.flat[0], upper.flat[0])
    for place, stop in enumerate((lower, upper)):
        axes.plot(along, stop, color=STOP, lw=1.0, ls=(0, (5, 2)), zorder=1.5, label=None if place else "stops")
    return None


def curves(output, name, group, axes):
    """One panel of related results over the only axis; `group` lists (variable, component or None, title)."""
    first, shown, status = group[0][0], False, output.values("status")
    many_periods = "period_ratio" in output and bool((output.values("period_ratio") > 1).any())
    for place, (result, part, title) in enumerate(group):
        values = output.values(result).astype(float)
        values = values if part is None else values[:, part]
        if result == "period_ratio":
            values = np.where(values > 0, values, np.nan)
        shown = shown or bool(np.isfinite(values[status == APERIODIC]).any())
        dots = result == "period_ratio" or result == "period" and many_periods
        dashes = "none" if dots else (0, (4, 1.5)) if part is not None and place % 2 else "-"
        draw_branch(
            axes,
            output,
            name,
            values,
            CYCLE[place % len(CYCLE)],
            title if len(group) > 1 else None,
            ls=dashes,
            **({"marker": ".", "ms": 3.0} if dots else {}),
        )
    set_axis(axes, output, name)
    axes.margins(y=0.08)
    if first in ("x_min", "x_max"):
        draw_stops_along(axes, output, name)
    name_statuses(axes, output, name, shown=shown)
    axes.set_ylabel(common_label(output, [result for result, _, _ in group]))
    if first == "period_ratio":
        axes.set_ylim(0.5, (axes.dataLim.y1 if np.isfinite(axes.dataLim.y1) else 1) + 0.5)  # none may have a period
    if first in ("period_ratio", "impacts_per_period"):
        axes.yaxis.set_major_locator(ticker.MaxNLocator(integer=True))
    if first == "rest_fraction":
        axes.set_ylim(-0.02, max(1.02 * axes.get_ylim()[1], 0.1))
    if output.follow == name:
        upwards = output.values(name)[-1] > output.values(name)[0]
        axes.set_xlabel(f"{label(output, name)}, followed " + (r"$\rightarrow$" if upwards else r"$\leftarrow$"))
    legend_above(axes, columns=4 if len(axes.get_legend_handles_labels()[0]) < 5 else 3)


def common_label(output, names):
    """The label of results that share a panel."""
    first = names[0]
    if first in ("x_min", "x_max"):
        return r"displacement $x$"
    if first in ("v_min", "v_max"):
        return "velocity $x$\N{PRIME}"
    if set(names) == {"v_before", "v_after"}:
        return "velocity at impact $x$\N{PRIME}"
    if set(names) == {"work_in", "loss_damping"}:
        return "energy in the observed time"
    return label(output, first)


def spectrum(output, name, axes):
    """Amplitudes or phases of the harmonics of a single point."""
    order, values = output.values("harmonic"), output.values(name)
    axes.vlines(order, 0.0, values, color=BLUE, lw=1.2)
    axes.plot(order, values, ls="none", marker="o", ms=4, color=BLUE)
    axes.axhline(0.0, color=STOP, lw=0.7)
    axes.set_xlim(-0.5, order[-1] + 0.5)
    axes.xaxis.set_major_locator(ticker.MaxNLocator(integer=True))
    axes.set_xlabel(label(output, "harmonic"))
    axes.set_ylabel(label(output, name))


def scalars(output, names, axes):
    """The results of a single point, as a table in words."""
    axes.set_axis_off()
    rows = [part for name in names for part in scalar_parts(output, name) if np.isfinite(part[1])]
    for side, x, column in (("right", 0.78, 0), ("left", 0.82, 1)):
        lines = [row[0] if column == 0 else number(float(row[1])) for row in rows]
        axes.text(x, 1.0, "\n".join(lines), transform=axes.transAxes, va="top", ha=side, linespacing=1.6)


def scalar_parts(output, name):
    variable = output[name]
    if variable.values.ndim == 0:
        return [(variable.long_name, variable.values)]
    if variable.dims == ("stop",):
        sides = [("lower" if side < 0 else "upper") for side in output.values("stop")]
        return [(f"{variable.long_name}, {side} stop", value) for side, value in zip(sides, variable.values)]
    if variable.dims == ("multiplier",):
        return [
            (f"{variable.long_name}, {which} modulus", value)
            for which, value in zip(("larger", "smaller"), variable.values)
        ]
    return []
