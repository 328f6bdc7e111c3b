"""The picture of an output of `clatter accuracy`: errors against the time that they cost."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib import colors, ticker

from .data import FIRST_FAILURE
from .labels import BELOW, DIRECTIONS, Labels, place_labels
from .names import amount, symbol, unit_of
from .style import BLUE, GREEN, PURPLE, STOP, VERMILION, heading, legend_above, new_figure

FLOOR = 1e-17  # smaller errors are drawn here: a logarithmic axis has no place for 0
MINUS = "\N{MINUS SIGN}"
SCALAR = 0  # the arch of rows that no lanes ran
WRONG = ("missed", "doubled")
MOTION = ("error_contact_time", "error_contact_speed", "error_extrema")

# Method: its name in the legend, with the setting that labels its points in brackets; its colour; its symbol.
LOOKS = {
    "exact": ("exact", STOP, "D"),
    "exact_lanes": ("exact in lanes (extrema)", GREEN, "^"),
    "dopri5": ("Dormand\N{EN DASH}Prince (tolerance)", BLUE, "o"),
    "moreau": ("Moreau (step in forcing periods)", VERMILION, "s"),
    "harmonics_fft": ("FFT, displacement", BLUE, "o"),
    "harmonics_fft_v": ("FFT, velocity", VERMILION, "s"),
    "harmonics_exact": ("exact", STOP, ""),
    "steady": ("as configured", GREEN, "o"),
    "steady_repetition": ("repetition alone", PURPLE, "s"),
}


@dataclass
class Curve:
    """Cost and error of one method, from its coarsest to its finest setting."""

    method: str
    setting: np.ndarray
    cost: np.ndarray  # median over the points of the sweep
    spread: np.ndarray  # interquartile range of the cost
    error: np.ndarray  # worst over the points, at least FLOOR
    floored: bool  # whether an error is drawn at FLOOR
    wrong: np.ndarray  # impacts missed or doubled at some point
    failed: np.ndarray  # no result at some point, failed or escaped

    def __len__(self):
        return len(self.error)

    @property
    def hollow(self):
        return self.wrong | self.failed


def accuracy_figure(output, title=None, size=None):
    """The figure, with its heading: a panel for each kind of error in the file. The size is in inches, if it is
    given."""
    exact = curve(output, "harmonics_exact", ("error_harmonics",), None)
    lanes = curve(output, "exact", ("error_extrema",), "ns_per_period", "exact_lanes", in_lanes=True)
    panels = [
        (
            partial(time_panel, lanes),
            [curve(output, name, MOTION, "ns_per_period") for name in ("exact", "dopri5", "moreau")],
        ),
        (
            partial(samples_panel, exact),
            [
                curve(output, "harmonics_fft", ("error_harmonics",), "setting"),
                curve(output, "harmonics_fft", ("error_harmonics_v",), "setting", "harmonics_fft_v"),
            ],
        ),
        (
            steady_panel,
            [
                curve(output, name, (*MOTION, "error_harmonics"), "simulated_periods")
                for name in ("steady", "steady_repetition")
            ],
        ),
    ]
    panels = [(draw, [part for part in found if len(part)]) for draw, found in panels]
    panels = panels[:1] + [(draw, found) for draw, found in panels[1:] if found]
    figure, places = panel_places(len(panels))
    if size:
        figure.set_size_inches(size)
    heading(figure, output, title)  # takes room, and the labels come last
    figure.supxlabel(note(output, [exact, lanes, *(part for _, found in panels for part in found)]), fontsize=9.5)
    place_labels(figure, [labels for axes, (draw, found) in zip(places, panels) for labels in draw(axes, found)])
    return figure


def panel_places(count):
    """A figure and the axes of its panels; the first has the most to show."""
    figure = new_figure(3.9 if count == 1 else 6.5)
    grid = figure.add_gridspec(min(count, 2), max(count - 1, 1), height_ratios=(1.3, 1.0)[:count])
    return figure, [figure.add_subplot(grid[0, :]), *(figure.add_subplot(grid[1, place]) for place in range(count - 1))]


def note(output, found):
    """Notes on the symbols: the values that they stand for, and those drawn away from their own place."""
    points, symbols = int(np.prod(output.shape)), []
    if any(np.isfinite(part.spread).any() for part in found):
        symbols.append("bars: interquartile range")
    if any(part.floored for part in found):
        symbols.append("errors below $10^{-17}$ are drawn there")
    ends = (f"{symbol(output, axis)} = {span(output, axis)}" for axis in output.axes)
    lines = [f"worst error and median cost of {points} points, {', '.join(ends)}"] if points > 1 else []
    return "\n".join([*lines, ";  ".join(symbols)])


def span(output, axis):
    """The least and the greatest value of an axis, with their unit."""
    low, high = (amount(output, axis, end) for end in (output.values(axis).min(), output.values(axis).max()))
    unit = unit_of(output, axis)
    return f"{low.removesuffix(unit).strip()} … {high}"


def curve(output, method, errors, cost, look=None, in_lanes=False):
    """One method's rows, by the scalar loop or in lanes, that have an error: the largest of `errors` against a cost,
    over all points of the sweep."""
    error, setting = worst(at_points(output, *errors)), output.values("setting")
    costs = medians(at_points(output, cost)) if cost else np.zeros(len(setting))
    spread = medians(at_points(output, "ns_spread")) if cost == "ns_per_period" else np.full(len(setting), np.nan)
    wrong = worst(at_points(output, "missed", "doubled")) > 0
    failed = worst(at_points(output, "status")) >= FIRST_FAILURE
    mine = (output.values("method") == code_of(output, method)) & ((output.values("arch") != SCALAR) == in_lanes)
    rows = np.flatnonzero(mine & np.isfinite(error) & np.isfinite(costs))
    rows = rows[np.argsort(setting[rows] if method == "harmonics_fft" else -setting[rows], kind="stable")]
    return Curve(
        look or method,
        setting[rows],
        costs[rows],
        spread[rows],
        np.maximum(error[rows], FLOOR),
        bool((error[rows] < FLOOR).any()),
        wrong[rows],
        failed[rows],
    )


def at_points(output, *names):
    """These results, one after the other, at every point: a line each, with a column for each row of the file."""
    shape = output.values("status").shape
    return np.concatenate([np.broadcast_to(output.values(name), shape).reshape(-1, shape[-1]) for name in names])


def code_of(output, method):
    """The number that stands for a method in the file, or None."""
    return next((code for code, name in output.methods.items() if name == method), None)


def worst(values):
    """The largest value in each column, of those that exist; NaN if none does."""
    return np.fmax.reduce(values, axis=0)


def medians(values):
    """The median of each column, of the values that exist; NaN if none does."""
    known = [column[np.isfinite(column)] for column in values.T]
    return np.array([np.median(column) if len(column) else np.nan for column in known])


def pareto_front(cost, error):
    """Indices, by cost, of the points that no other beats: as good in both, and better in one."""
    front = []
    for place in np.lexsort((error, cost)):
        same = front and (cost[place], error[place]) == (cost[front[-1]], error[front[-1]])
        if not front or same or error[place] < error[front[-1]]:
            front.append(int(place))
    return front


def draw_curve(axes, part):
    """A line through a method's points, hollow if they are wrong; returns the points' labels."""
    name, color, marker = LOOKS[part.method]
    axes.errorbar(part.cost, part.error, xerr=bars(part), fmt="none", ecolor=color, elinewidth=2.2, alpha=0.3)
    axes.plot(part.cost, part.error, color=color, marker=marker, ms=4.5, label=name, gid=part.method)
    axes.plot(
        part.cost[part.hollow],
        part.error[part.hollow],
        ls="none",
        marker=marker,
        ms=4.5,
        mfc="white",
        mec=color,
        zorder=2.5,
        gid=f"{part.method}-hollow",
    )
    texts = [short(value) if np.isfinite(value) else name for value in part.setting]
    return Labels(axes, part.cost, part.error, texts, colors.to_hex(0.75 * np.array(colors.to_rgb(color))))


def bars(part):
    """Half the spread to both sides, as far as a logarithmic axis has them."""
    half = np.nan_to_num(part.spread / 2)
    return np.stack([np.minimum(half, 0.9 * part.cost), half])


def short(value):
    """A setting in few letters: 1e−3."""
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits.removesuffix('.0')}e{int(exponent)}".replace("-", MINUS)


def name_hollow(axes, found):
    """A legend entry for hollow points, if there are any."""
    wrong, failed = any(part.wrong.any() for part in found), any(part.failed.any() for part in found)
    if wrong or failed:
        words = ", ".join(["impacts missed or doubled"] * wrong + [f"{'or ' * wrong}failed"] * failed)
        axes.plot([], [], ls="none", marker="o", ms=4.5, mfc="white", mec=STOP, label=words)


def finish(axes, across, columns):
    """Scales, limits and labels of a panel, and its legend above it."""
    axes.loglog()
    axes.margins(x=0.1, y=0.16)
    axes.yaxis.set_major_locator(ticker.LogLocator(numticks=10))
    low, high = axes.get_xlim()
    if high < 100 * low:
        axes.xaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(ticker.StrMethodFormatter("{x:g}"))
        axes.xaxis.set_minor_formatter(ticker.NullFormatter())
    axes.set_xlabel(across)
    legend_above(axes, columns)


def time_panel(lanes, axes, found):
    """Error against time per forcing period, and the points that no method beats. Lanes stand beside them: of their
    errors only that of the extrema is drawn."""
    axes.set_gid("panel-time")
    if not found:
        axes.set_axis_off()
        axes.text(0.5, 0.5, "no method has an error and a time here", transform=axes.transAxes, ha="center")
        return []
    labels = [draw_curve(axes, found[0])]
    draw_front(
        axes, *(np.concatenate([getattr(part, name)[~part.hollow] for part in found]) for name in ("cost", "error"))
    )
    found = [*found, *([lanes] if len(lanes) else [])]
    labels += [draw_curve(axes, part) for part in found[1:]]
    name_hollow(axes, found)
    finish(axes, "time per forcing period (ns)", 3)
    axes.set_ylabel("largest error of contact times,\ncontact speeds and extrema")
    return labels


def draw_front(axes, cost, error):
    """Rings around the points of the Pareto front, and the least error that any method has by then."""
    front = pareto_front(cost, error)
    cost, error = cost[front], error[front]
    axes.plot(np.repeat(cost, 2)[1:], np.repeat(error, 2)[:-1], color=STOP, lw=0.7, ls=(0, (4, 2)), zorder=1.8)
    axes.plot(
        cost,
        error,
        ls="none",
        marker="o",
        ms=9,
        mfc="none",
        mec=STOP,
        mew=0.8,
        zorder=2.6,
        gid="pareto-front",
        label="Pareto front" if front else None,
    )


def samples_panel(exact, axes, found):
    """Error of the FFT's harmonics against its samples, with the slopes of first and second order."""
    for part in found:
        draw_curve(axes, part)
    for part in exact.error[:1]:
        axes.axhline(part, color=STOP, lw=1.0, ls=(0, (5, 2)), label="exact", gid="harmonics_exact")
    name_hollow(axes, found)
    axes.set_gid("panel-samples")
    finish(axes, "FFT samples", 2)
    axes.set_ylabel("error of harmonics")
    return [draw_slope(axes, part, order) for part, order in ((found[-1], 1), (found[0], 2)) if len(part) > 1]


def draw_slope(axes, fft, order):
    """A thin line of one order above all errors; returns its label."""
    first, low = fft.cost[0], axes.get_ylim()[0]
    start = 2 * max(fft.error * (fft.cost / first) ** order)
    last = min(fft.cost[-1], first * (start / low) ** (1 / order))
    axes.plot(
        [first, last],
        [start, start * (first / last) ** order],
        color=STOP,
        lw=0.6,
        scalex=False,
        scaley=False,
        gid=f"slope-{order}",
    )
    middle = first * (last / first) ** 0.6
    directions = DIRECTIONS if order == 1 else BELOW + DIRECTIONS
    return Labels(axes, [middle], [start * (first / middle) ** order], [f"slope {MINUS}{order}"], STOP, directions)


def steady_panel(axes, found):
    """Error of the steady motion against the forcing periods that it took to find."""
    labels = [draw_curve(axes, part) for part in found]
    name_hollow(axes, found)
    axes.set_gid("panel-steady")
    finish(axes, "forcing periods simulated", 2)
    axes.set_ylabel("largest error of contacts,\nextrema and harmonics")
    return labels
