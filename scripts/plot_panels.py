"""Panels that any output can have: curves with their points' status, motion, impacts, harmonics, maps."""

import numpy as np
from matplotlib import colors, ticker

from plot_data import FIRST_FAILURE
from plot_style import (
    BLUE,
    CYCLE,
    GREEN,
    GRID,
    ORANGE,
    STOP,
    VERMILION,
    draw_walls,
    label,
    legend_above,
    number,
    set_axis,
    symbol,
)

APERIODIC = 1
DENSE = 60  # points from which a curve is drawn without markers
MAP_LIMIT = 4  # components of one variable (harmonics, stops) that maps show


def draw_branch(axes, output, name, values, color, title, loose_color=None, **style):
    """One result along the only axis: a line through the points that repeat, hollow markers where none does."""
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
    return label(output, first)


def motion(output, index):
    """Time, displacement, velocity of one point, with both sides of every logged impact put in."""
    tau, x, v = (output.values(name)[index] for name in ("tau", "x", "v"))
    if "impact_count" not in output:
        return tau, x, v
    times, sides, before, after = output.impacts(index)
    lower, upper = (stop[index] for stop in output.stops())
    place = np.repeat(np.searchsorted(tau, times, side="left"), 2)
    contact = np.where(np.repeat(sides, 2) < 0, lower, upper)
    return (
        np.insert(tau, place, np.repeat(times, 2)),
        np.insert(x, place, contact),
        np.insert(v, place, np.ravel([before, after], order="F")),
    )


def repeated(tau, values, period, end):
    """A periodic record, again and again up to `end`."""
    turns = int(np.ceil(end / period))
    times = np.concatenate([tau + turn * period for turn in range(turns)])
    inside = times <= end * (1 + 1e-12)
    return times[inside], np.tile(values, turns)[inside]


def chosen_points(output, most=5):
    """Indices of the points whose motion is drawn: all, or a few spread over the sweep; with their titles."""
    total = max(int(np.prod(output.shape)), 1)
    flat = np.unique(np.linspace(0, total - 1, min(total, most)).round().astype(int))
    points = [tuple(int(part) for part in np.unravel_index(place, output.shape)) for place in flat]
    return [
        (
            point,
            ", ".join(
                f"{symbol(axis)} = {number(output.values(axis)[place])}" for axis, place in zip(output.axes, point)
            ),
        )
        for point in points
    ]


def time_history(output, quantity, points, axes, end=None):
    """x or x' against time, for one point or a few; periodic motion is repeated to `end`."""
    for place, (point, title) in enumerate(points):
        tau, x, v = motion(output, point)
        values = x if quantity == "x" else v
        if end is not None:
            tau, values = repeated(tau, values, tau[-1], end)
            axes.set_xlim(0.0, end)
        axes.plot(tau, values, color=CYCLE[place % len(CYCLE)], lw=1.1, label=title or None)
    axes.margins(y=0.08)
    if quantity == "x":
        draw_common_walls(axes, output)
    else:
        axes.axhline(0.0, color=GRID, lw=0.7, zorder=0)
    axes.set_xlabel(label(output, "tau"))
    axes.set_ylabel(label(output, quantity))


def draw_common_walls(axes, output, vertical=False):
    """The stops, where every point has the same."""
    lower, upper = output.stops()
    if np.unique(lower).size == 1 and np.unique(upper).size == 1:
        draw_walls(axes, lower.flat[0], upper.flat[0], vertical, named=False)


def phase_plane(output, points, axes):
    """x' against x."""
    for place, (point, title) in enumerate(points):
        _, x, v = motion(output, point)
        axes.plot(x, v, color=CYCLE[place % len(CYCLE)], lw=1.1, label=title or None)
    axes.margins(x=0.08, y=0.08)
    draw_common_walls(axes, output, vertical=True)
    axes.axhline(0.0, color=GRID, lw=0.7, zorder=0)
    axes.set_xlabel(label(output, "x"))
    axes.set_ylabel(label(output, "v"))


def impact_log(output, index, axes, period=None):
    """Velocity before each observed impact of one point, as stems at their times."""
    times, sides, before, _ = output.impacts(index)
    end = output.values("tau")[index][-1] if "tau" in output else None
    if period is not None:
        end = 2 * period
        sides, before = (repeated(times, part, period, end)[1] for part in (sides, before))
        times = repeated(times, times, period, end)[0]
    axes.axhline(0.0, color=STOP, lw=0.7)
    for side, marker, color, title in ((-1, "v", BLUE, "lower stop"), (1, "^", VERMILION, "upper stop")):
        hit = sides == side
        if hit.any():
            axes.vlines(times[hit], 0.0, before[hit], color=color, lw=1.0)
            axes.plot(
                times[hit],
                before[hit],
                ls="none",
                marker=marker,
                ms=4.5 if len(times) < 40 else 3.0,
                color=color,
                label=title,
            )
    axes.margins(y=0.1)
    axes.set_xlim(0.0, end if end is None or np.isfinite(end) else None)
    axes.set_xlabel(label(output, "tau"))
    axes.set_ylabel(label(output, "v_before"))
    legend_above(axes)


def impact_cloud(output, name, axes):
    """Velocities before all observed impacts over the only axis: a bifurcation diagram."""
    along = np.repeat(output.values(name), output.values("impact_count"))
    sides, before = output.values("impact_stop"), output.values("impact_v_before")
    for side, color, title in ((-1, BLUE, "lower stop"), (1, VERMILION, "upper stop")):
        axes.plot(
            along[sides == side],
            before[sides == side],
            ls="none",
            marker=".",
            mew=0,
            color=color,
            ms=2.0 if len(along) > 2000 else 4.0,
            label=title,
            rasterized=True,
        )
    set_axis(axes, output, name)
    axes.set_ylabel(label(output, "v_before"))
    name_statuses(axes, output, name, shown=False)
    legend_above(axes)


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


def value_map(output, figure, axes, names, title, values, status):
    """A result over two axes in colours; hatched where motion has no period, black where the point failed."""
    slow, fast = names
    values = np.where(status >= FIRST_FAILURE, np.nan, values.astype(float))
    finite = values[np.isfinite(values)]
    low, high = (finite.min(), finite.max()) if finite.size else (0.0, 0.0)
    shades = {"cmap": "viridis"}
    if low < 0.0 < high:
        most = max(-low, high)
        shades = {"cmap": "RdBu_r", "vmin": -most, "vmax": most}
    elif low == high:
        shades |= {"vmin": min(0.0, low), "vmax": max(1.0, high)}
    place = (output.values(slow), output.values(fast))
    mesh = axes.pcolormesh(*place, values.T, shading="nearest", rasterized=True, **shades)
    figure.colorbar(mesh, ax=axes, label=title, pad=0.02)
    finish_map(axes, output, names, status)


def finish_map(axes, output, names, status):
    """Marks aperiodic and failed points, sets scales and labels."""
    slow, fast = names
    place = (output.values(slow), output.values(fast))
    loose, failed = status == APERIODIC, status >= FIRST_FAILURE
    if loose.any():
        axes.pcolor(
            *place, np.ma.masked_where(~loose, loose).T, shading="nearest", hatch="//////", alpha=0.0, rasterized=True
        )
    if failed.any():
        axes.pcolormesh(
            *place,
            np.ma.masked_where(~failed, failed).T,
            shading="nearest",
            rasterized=True,
            cmap=colors.ListedColormap(["black"]),
        )
    set_axis(axes, output, slow)
    set_axis(axes, output, fast, vertical=True)


def kind_map(output, figure, axes, names, status, ratio):
    """Which kind of motion is where: its period in forcing periods, none, or a failure."""
    kinds = [
        ("period 1", "#d6e6f4", ratio == 1),
        ("period 2", BLUE, ratio == 2),
        ("period 3, …", GREEN, ratio > 2),
        ("no period", ORANGE, status == APERIODIC),
        ("failed", "black", status >= FIRST_FAILURE),
    ]
    codes = np.full(status.shape, np.nan)
    for code, (_, _, where) in enumerate(kinds):
        codes[where] = code
    shades = colors.ListedColormap([color for _, color, _ in kinds])
    mesh = axes.pcolormesh(
        output.values(names[0]),
        output.values(names[1]),
        codes.T,
        shading="nearest",
        rasterized=True,
        cmap=shades,
        vmin=-0.5,
        vmax=len(kinds) - 0.5,
    )
    bar = figure.colorbar(mesh, ax=axes, ticks=range(len(kinds)), pad=0.02)
    bar.ax.set_yticklabels([kind[0] for kind in kinds])
    bar.ax.tick_params(length=0)
    set_axis(axes, output, names[0])
    set_axis(axes, output, names[1], vertical=True)
