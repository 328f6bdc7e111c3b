"""Panels of the motion itself: time histories, phase planes, impacts."""

import numpy as np
from matplotlib import transforms

from .data import OWN_AMPLITUDES, WALL, lacks_period
from .names import equation, label
from .empty import say_empty
from .style import BLUE, CYCLE, GRID, STOP, VERMILION, draw_walls, legend_above

LAST_PERIODS = 20  # of motion without a period that are drawn


def tells_states(output):
    """Whether logged impacts tell the states on both sides of them: not if their velocities are those over something
    that moves in the picture."""
    moves = output.is_absolute or output.stops_move or output.has_loose_mass
    return "impact_count" in output and not moves


def motion(output, index):
    """Time, displacement, velocity of one point, with both sides of every logged impact put in. A touch of a soft stop
    has one: its velocity goes on, and v_after is that of the separation, later."""
    tau, x, v = (output.values(name)[index] for name in ("tau", "x", "v"))
    if not tells_states(output):
        return tau, x, v
    times, sides, before, after = output.impacts(index)
    position = np.where(sides < 0, *(stop[index] for stop in output.stops()))
    rows = np.where(np.where(sides < 0, *(soft[index] for soft in output.soft_stops())), 1, 2)
    place = np.repeat(np.searchsorted(tau, times, side="left"), rows)
    both = np.stack([before, after], axis=1)
    return (
        np.insert(tau, place, np.repeat(times, rows)),
        np.insert(x, place, np.repeat(position, rows)),
        np.insert(v, place, both[np.arange(2) < rows[:, None]]),
    )


def path_of_stop(output, side, index, tau):
    """Where the stop on a side, 0 or 1, of a point is at times of its observed motion; None: it stands."""
    amplitude = float(output.parameter(OWN_AMPLITUDES[side], 0.0)[index])
    if not amplitude or output.is_absolute:
        return None
    keys = ("phase", "stop_phase", ("stop_phase_lower", "stop_phase_upper")[side])
    lead = sum(float(output.parameter(key, 0.0)[index]) for key in keys)
    return output.stops()[side][index] + amplitude * np.sin(2 * np.pi * tau / output.forcing_period(index) + lead)


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
            ", ".join(equation(output, axis, output.values(axis)[place]) for axis, place in zip(output.axes, point)),
        )
        for point in points
    ]


def is_aperiodic(output, index):
    return bool(lacks_period(output.values("status")[index]))


def shown_motion(output, index):
    """The motion of a point, of one without a period its last forcing periods alone, and how thick its line is."""
    tau, x, v = motion(output, index)
    if not is_aperiodic(output, index):
        return tau, x, v, 1.1
    late = tau >= first_shown(output, index)
    return tau[late], x[late], v[late], 0.5


def first_shown(output, index):
    """The time from which on motion without a period is drawn: that of its last forcing periods, if it has so many."""
    tau = output.values("tau")[index]
    return max(tau[0], tau[-1] - LAST_PERIODS * output.forcing_period(index))


def mark_impacts(output, index, draw, color):
    """The impacts of motion without a period, by draw(time, position, velocity before, style)."""
    if not tells_states(output) or not is_aperiodic(output, index):
        return
    times, sides, before, _ = output.impacts(index)
    late = times >= first_shown(output, index)
    position = np.where(sides < 0, *(stop[index] for stop in output.stops()))
    draw(times[late], position[late], before[late], {"ls": "none", "marker": ".", "ms": 4.5, "mew": 0, "color": color})


class Beside(transforms.BboxBase):
    """The box of a panel, and as much beside it as half a marker of this size, in points, takes."""

    def __init__(self, axes, size):
        super().__init__()
        self.axes, self.marker = axes, size

    def get_points(self):
        half = self.marker / 2 * self.axes.figure.dpi / 72.0
        return self.axes.bbox.get_points() + [[-half, 0.0], [half, 0.0]]


def show_whole(markers):
    """Has the frame of their panel cut no markers at its sides."""
    for line in markers:
        line.set_clip_box(Beside(line.axes, line.get_markersize() + line.get_markeredgewidth()))


def time_history(output, quantity, points, axes, end=None):
    """x or x' against time, for one point or a few; periodic motion is repeated to `end`."""
    for place, (point, title) in enumerate(points):
        tau, x, v, width = shown_motion(output, point)
        values, color = x if quantity == "x" else v, CYCLE[place % len(CYCLE)]
        if end is not None:
            tau, values = repeated(tau, values, tau[-1], end)
            axes.set_xlim(0.0, end)
        axes.plot(tau, values, color=color, lw=width, label=title or None)
        for side in (0, 1) if quantity == "x" and place == 0 else ():
            path = path_of_stop(output, side, point, tau)
            if path is not None:
                axes.plot(tau, path, color=STOP, lw=1.0, zorder=1.5)
        mark_impacts(
            output,
            point,
            lambda t, p, w, style: show_whole(axes.plot(t, p if quantity == "x" else w, **style)),
            VERMILION,
        )
    axes.margins(y=0.08)
    if quantity == "x":
        draw_common_walls(axes, output)
    else:
        axes.axhline(0.0, color=GRID, lw=0.7, zorder=0)
    axes.set_xlabel(label(output, "tau"))
    axes.set_ylabel(label(output, quantity))


def draw_common_walls(axes, output, vertical=False):
    """The stops, if they are the same at every point."""
    lower, upper = output.reach()
    if np.unique(lower).size == 1 and np.unique(upper).size == 1:
        draw_walls(axes, lower.flat[0], upper.flat[0], vertical, named=False)


def phase_plane(output, points, axes):
    """x' against x."""
    for place, (point, title) in enumerate(points):
        _, x, v, width = shown_motion(output, point)
        axes.plot(x, v, color=CYCLE[place % len(CYCLE)], lw=width, label=title or None)
        mark_impacts(output, point, lambda t, p, w, style: axes.plot(p, w, **style), VERMILION)
    axes.margins(x=0.08, y=0.08)
    draw_common_walls(axes, output, vertical=True)
    axes.axhline(0.0, color=GRID, lw=0.7, zorder=0)
    axes.set_xlabel(label(output, "x"))
    axes.set_ylabel(label(output, "v"))


def impact_log(output, index, axes, period=None):
    """Velocity before each observed impact of one point, as stems at their times."""
    times, sides, before, _ = output.impacts(index)
    begin, end = 0.0, output.values("tau")[index][-1] if "tau" in output else None
    if end is not None and is_aperiodic(output, index):
        begin = first_shown(output, index)
        times, sides, before = (part[times >= begin] for part in (times, sides, before))
    if period is not None:
        end = 2 * period
        sides, before = (repeated(times, part, period, end)[1] for part in (sides, before))
        times = repeated(times, times, period, end)[0]
    if times.size:
        axes.axhline(0.0, color=STOP, lw=0.7)
    else:
        say_empty(axes, "no impacts")
    for side, marker, color in ((-1, "v", BLUE), (1, "^", VERMILION), (-WALL, "v", STOP), (WALL, "^", STOP)):
        hit = sides == side
        if hit.any():
            axes.vlines(times[hit], 0.0, before[hit], color=color, lw=1.0)
            look = {"ls": "none", "marker": marker, "ms": 4.5 if len(times) < 40 else 3.0, "color": color}
            show_whole(axes.plot(times[hit], before[hit], label=output.stop_name(side), **look))
    axes.margins(y=0.1)
    axes.set_xlim(begin, end if end is None or np.isfinite(end) else None)
    axes.set_xlabel(label(output, "tau"))
    axes.set_ylabel(label(output, "v_before"))
    legend_above(axes)
