"""Panels of a loose mass and of the main one, in whose housing it moves."""

import numpy as np

from .motion import LAST_PERIODS, is_aperiodic
from .names import in_frame, label, with_unit
from .style import BLUE, CYCLE, GRID, STOP, VERMILION, draw_walls

SYMBOLS = {"x": "displacements $x$, $y$", "v": "velocities $x$′, $y$′"}


def records(output, index):
    """Time, x, x', z and z' of one point; of motion without a period its last forcing periods alone, and how thick its
    line is."""
    rows = np.stack([output.values(name)[index] for name in ("tau", "x", "v", "z", "w")])
    if not is_aperiodic(output, index):
        return *rows, 1.1
    return *rows[:, rows[0] >= rows[0][-1] - LAST_PERIODS * output.forcing_period(index)], 0.6


def both_masses(output, quantity, points, axes):
    """The displacements of both masses against time, and the walls that the main one carries; or their velocities. Of
    several points the loose masses are dashed."""
    alone = len(points) == 1
    for place, (point, title) in enumerate(points):
        tau, x, v, z, w, width = records(output, point)
        main, loose = (x, x + z) if quantity == "x" else (v, v + w)
        color = CYCLE[place % len(CYCLE)]
        axes.plot(tau, main, color=BLUE if alone else color, lw=width, label="main mass" if alone else title)
        style = {"color": VERMILION} if alone else {"color": color, "ls": "--"}
        axes.plot(tau, loose, lw=width, label="loose mass" if alone else None, **style)
        walls = [wall[point] for wall in output.walls()] if alone and quantity == "x" else []
        for wall in filter(np.isfinite, walls):
            axes.plot(tau, x + wall, color=STOP, lw=0.6, zorder=1, label="its walls")
    if quantity == "v":
        axes.axhline(0.0, color=GRID, lw=0.7, zorder=0)
    axes.margins(y=0.08)
    axes.set_xlabel(label(output, "tau"))
    axes.set_ylabel(in_frame(output, quantity, with_unit(output, SYMBOLS[quantity], quantity)))


def housing_plane(output, points, axes):
    """z' against z, between the walls."""
    for place, (point, title) in enumerate(points):
        z, w, width = between_walls(output, point)
        axes.plot(
            z, w, color=VERMILION if len(points) == 1 else CYCLE[place % len(CYCLE)], lw=width, label=title or None
        )
    axes.margins(x=0.08, y=0.08)
    lower, upper = output.walls()
    if np.unique(lower).size == 1 and np.unique(upper).size == 1:
        draw_walls(axes, lower.flat[0], upper.flat[0], vertical=True, named=False)
    axes.axhline(0.0, color=GRID, lw=0.7, zorder=0)
    axes.set_xlabel(label(output, "z"))
    axes.set_ylabel(label(output, "w"))


def between_walls(output, index):
    """Place and velocity in the housing, with both sides of every logged impact put in."""
    tau, _, _, z, w, width = records(output, index)
    if "impact_count" not in output:
        return z, w, width
    times, sides, before, after = output.wall_impacts(index)
    shown = times >= tau[0]
    times, sides, before, after = times[shown], sides[shown], before[shown], after[shown]
    position = np.where(sides < 0, *(wall[index] for wall in output.walls()))
    place = np.repeat(np.searchsorted(tau, times, side="left"), 2)
    both = np.stack([before, after], axis=1).ravel()
    return np.insert(z, place, np.repeat(position, 2)), np.insert(w, place, both), width
