"""Panels of results over two axes, drawn as images: one for the values, one for the hatch."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
from matplotlib import cm, colormaps, colors
from matplotlib.image import AxesImage

from .choice import ChoiceProblem
from .data import APERIODIC, CREEPING, ESCAPED, FIRST_FAILURE, GRAZING, UNDECIDED, has_failed, lacks_period
from .scales import integer_levels, shown_values, tidy_ticks
from .names import YES_OR_NO, label, number, plain
from .shown import note_results
from .style import BLUE, CYCLE, GREEN, ORANGE, is_geometric

PIXELS = 900  # along an axis of an image, if its cells aren't all equal
MOST_PIXELS = 1200  # along one axis; of more points the nearest to each pixel is shown
STRIPE, STROKE, INK = 4.3, 0.7, 170  # points from one stroke of a hatch to the next, their width; opacity of 255
NO_PERIOD = "#cfcfcf"
OLIVE = "#6b6b1f"  # escaped: no colour of a scale
BROWN = "#a9744f"  # creeping: another one
REGIME_COLOURS = ("#e8f1f8", *CYCLE, "#8c510a", "#80cdc1", "#543005")

# Why a result has no value at a point whose motion is periodic.
MISSING = {
    "v_before": "no impact",
    "v_after": "no impact",
    "impact_speed": "no impact",
    "velocity_ratio": "no impact",
    "x_phase": "amplitude is negligible",
    "v_phase": "amplitude is negligible",
    "z_phase": "amplitude is negligible",
    "w_phase": "amplitude is negligible",
    "symmetric": "scene isn't symmetric",
    "period": "mass stands still",
    "eigenfrequency": "mass stands still",
}


@dataclass
class Quantity:
    """A result over two axes, or one component of it."""

    name: str  # of the variable
    title: str
    values: np.ndarray  # float64, shape of the two axes; NaN if there is none
    at_rest: np.ndarray  # bool, the same shape: the exponent is minus infinity

    @property
    def is_angle(self):
        return self.name.endswith("_phase")


def quantity(output, name, part, title):
    """A component of a result (None: all of it) of an output over two axes."""
    place = () if part is None else (..., part)
    raw = output.values(name)[place]
    return Quantity(name, title, shown_values(output, name)[place], np.isneginf(raw.astype(float)))


class Grid:
    """Where the points of a map lie on its two axes: each in the middle of a cell, and no cell cut by the frame."""

    def __init__(self, output, names, limits=(None, None), log=""):
        self.output, self.names = output, names
        for axis in log:
            if (low := output.values(names["xy".index(axis)]).min()) <= 0:
                name = names["xy".index(axis)]
                raise ChoiceProblem(
                    f"--log {log}: {name} begins at {low:g}, and a logarithmic scale has no place for 0 and below; "
                    f"leave '{axis}' out"
                )
        self.sides = [
            Side(values, view, axis in log or is_geometric(values))
            for values, view, axis in zip((output.values(name) for name in names), limits, "xy")
        ]

    def image(self, values):
        """The values of the cells, shape of the two axes, as pixels: rows from below."""
        column, row = (side.cells() for side in self.sides)
        image = values[np.ix_(np.maximum(column, 0), np.maximum(row, 0))].T
        outside = (row < 0)[:, None] | (column < 0)
        return np.ma.masked_where(outside, image) if outside.any() else image

    def draw(self, axes, pixels, kind=AxesImage):
        """Fills the frame with pixels, [row][column][red, green, blue, opacity] as bytes."""
        image = kind(axes, origin="lower", extent=(0, 1, 0, 1), interpolation="nearest", transform=axes.transAxes)
        image.set_data(pixels)
        image.set_clip_path(axes.patch)
        axes.add_image(image)

    def colour(self, axes, values, shade):
        """Fills the frame with values in the colours of a ScalarMappable, none for NaN."""
        self.draw(axes, shade.to_rgba(np.ma.masked_invalid(self.image(values)), bytes=True))

    def set_axes(self, axes):
        for side, name, axis in zip(self.sides, self.names, "xy"):
            getattr(axes, f"set_{axis}scale")("log" if side.is_log else "linear")
            getattr(axes, f"set_{axis}lim")(*side.view)
            getattr(axes, f"set_{axis}label")(label(self.output, name))
        axes.tick_params(which="both", top=False, right=False)

    def hatch(self, axes, cells):
        """Strokes over these cells, all of them in one image."""
        covered = np.ma.filled(self.image(cells), False)
        self.draw(axes, one_colour(covered, INK), Hatch)


def one_colour(covered, opacity, colour="black"):
    """Pixels of this colour and opacity, 0 to 255, where they are covered."""
    pixels = np.zeros((*covered.shape, 4), np.uint8)
    pixels[covered] = (*np.round(255 * np.array(colors.to_rgb(colour))), opacity)
    return pixels


class Hatch(AxesImage):
    """An image of which only strokes are left, a whole number of pixels apart: files of such strokes are small."""

    def make_image(self, renderer, magnification=1.0, unsampled=False):
        pixels, *place = super().make_image(renderer, magnification, unsampled)
        point = self.figure.dpi * magnification / 72.0
        step, width = max(4, round(STRIPE * point)), STROKE * point
        rows, columns = np.indices(pixels.shape[:2])
        away = np.abs((columns - rows) % step - step // 2) / np.sqrt(2)
        pixels[..., 3] = pixels[..., 3] * np.clip(width / 2 + 0.5 - away, 0, 1)
        return pixels, *place


class Side:
    """One axis of a map: its scale, its limits, and the cells between them."""

    def __init__(self, values, view, is_log):
        self.is_log = is_log and values.min() > 0
        self.order = np.argsort(values, kind="stable")
        self.edges = edges_between(self.to_scale(values[self.order]))
        self.low, self.high = self.to_scale(np.asarray(view, float)) if view else self.edges[[0, -1]]
        self.view = self.from_scale(self.low), self.from_scale(self.high)
        steps = np.diff(self.edges)
        is_even = not view and len(values) <= MOST_PIXELS and np.allclose(steps, steps[0], rtol=1e-6)
        self.pixels = len(values) if is_even else PIXELS if len(values) <= PIXELS else MOST_PIXELS

    def cells(self):
        """The index of the value that each pixel shows, -1 for none."""
        centres = self.low + (np.arange(self.pixels) + 0.5) / self.pixels * (self.high - self.low)
        cell = np.searchsorted(self.edges, centres) - 1
        inside = (cell >= 0) & (cell < len(self.order))
        return np.where(inside, self.order[np.clip(cell, 0, len(self.order) - 1)], -1)

    def to_scale(self, values):
        return np.log(values) if self.is_log else np.asarray(values, float)

    def from_scale(self, value):
        return float(np.exp(value) if self.is_log else value)


def edges_between(places):
    """The limits of cells around sorted places, halfway to the neighbours; any if all places are one."""
    if places[0] == places[-1]:
        return places[0] + np.linspace(-0.5, 0.5, len(places) + 1)
    middles = (places[1:] + places[:-1]) / 2
    return np.concatenate([[2 * places[0] - middles[0]], middles, [2 * places[-1] - middles[-1]]])


def value_map(figure, axes, grid, shown, status):
    """A quantity in colours; hatched where motion has no period, black where the point failed. Returns the notes that
    explain it."""
    note_results(axes, [(shown.name, None)])
    values = np.where(status >= FIRST_FAILURE, np.nan, shown.values)
    levels = None if shown.is_angle else integer_levels(values, shown.name)
    shade = level_colours(levels) if levels else range_colours(values, shown.is_angle)
    grid.colour(axes, values, shade)
    notes = mark_points(axes, grid, status)
    grid.set_axes(axes)
    bar = figure.colorbar(shade, ax=axes, pad=0.02, **bar_style(levels))
    words = name_levels(bar, levels, shown.name) if levels else tidy_ticks(bar.ax, shown.title)["y"]
    name_panel(axes, shown.title, words)
    return notes + clip_notes(shown, levels) + white_notes(shown, status)


def level_colours(levels):
    """Colours of whole numbers from dark to light, and of the gaps between them if there is something."""
    count = len(levels.boundaries) - 1
    shades = colormaps["viridis"](np.linspace(0, 0.95, count)) if count > 1 else [BLUE]
    shades = colors.ListedColormap(shades).with_extremes(over="#fff3b0")
    return cm.ScalarMappable(colors.BoundaryNorm(levels.boundaries, count), shades)


def range_colours(values, is_angle):
    """Colours of a quantity between its extremes: around zero if it has both signs; cyclic for angles that go far."""
    low, high = np.nanmin(values), np.nanmax(values)
    if is_angle and high - low > np.pi:
        return cm.ScalarMappable(colors.Normalize(-np.pi, np.pi), "twilight")
    if low < 0.0 < high:
        most = max(-low, high)
        return cm.ScalarMappable(colors.Normalize(-most, most), "coolwarm")  # its middle is grey: white is no value
    return cm.ScalarMappable(colors.Normalize(low, high), "viridis")


def bar_style(levels):
    if not levels:
        return {}
    return {"spacing": "uniform", "extend": "max" if levels.is_clipped else "neither", "extendfrac": 0.06}


def name_levels(bar, levels, name):
    """Numbers beside the whole ones in a colour bar."""
    words = ["no", "yes"] if name in YES_OR_NO else list(map(str, levels.integers))
    bar.set_ticks(levels.integers, labels=words)
    bar.ax.tick_params(which="both", length=0)
    bar.minorticks_off()


def name_panel(axes, title, words=None):
    """The title of a panel, in more lines than one if its column has no room, and what the numbers have in common."""
    text = axes.set_title(title, fontsize=10, pad=4.0)
    room = 0.86 * axes.figure.bbox.width / axes.get_subplotspec().get_gridspec().ncols
    if text.get_window_extent().width > room:
        title = ",\n".join(title.rsplit(", ", 1))
    text.set_text(f"{title}\n{words}" if words else title)


def clip_notes(shown, levels):
    if not levels or not levels.is_clipped:
        return []
    words = shown.title.split(", ")[0]
    return [f"colours of {words} end at {levels.last}, values at {number(levels.greatest)}"]


def white_notes(shown, status):
    """Why cells are white."""
    empty = np.isnan(shown.values) & (status < FIRST_FAILURE)
    loose, grazing = empty & lacks_period(status), empty & (status == GRAZING)
    rest = empty & ~loose & ~grazing & shown.at_rest
    other = empty & ~loose & ~grazing & ~rest
    reasons = ["no period"] * bool(loose.any() and MISSING.get(shown.name) != "no impact")
    reasons += ["a stop is just touched"] * bool(grazing.any()) + ["rest in every period"] * bool(rest.any())
    reasons += [MISSING.get(shown.name, "no value")] * bool(other.any() or loose.any() and not reasons)
    return [f"white: {reason}" for reason in reasons]


def mark_points(axes, grid, status):
    """Hatches points without a known period, and has a colour for those that failed and those that escaped; returns the
    notes that explain this."""
    loose, notes = lacks_period(status), []
    if loose.any():
        grid.hatch(axes, loose)
        notes.append("hatched: no period")
    for words, colour, cells in (
        ("black: failed", "black", has_failed(status)),
        ("olive: escaped", OLIVE, status == ESCAPED),
    ):
        if cells.any():
            grid.draw(axes, one_colour(np.ma.filled(grid.image(cells), False), 255, colour))
            notes.append(words)
    return notes


def class_map(figure, axes, grid, title, kinds):
    """Kinds of motion over two axes; `kinds` lists name, colour and cells of each. Those that occur have a colour."""
    kinds = [kind for kind in kinds if kind[2].any()]
    codes = np.full(kinds[0][2].shape, np.nan)
    for code, (_, _, cells) in enumerate(kinds):
        codes[cells] = code
    shade = name_colours(figure, axes, kinds)
    grid.colour(axes, codes, shade)
    grid.set_axes(axes)
    name_panel(axes, title)
    return ["white: no value"] if np.isnan(codes).any() else []


def name_colours(figure, axes, kinds):
    """A bar of the colours of some kinds, their names beside it; the first two items of each are name and colour."""
    shades = colors.ListedColormap([kind[1] for kind in kinds])
    shade = cm.ScalarMappable(colors.Normalize(-0.5, len(kinds) - 0.5), shades)
    bar = figure.colorbar(shade, ax=axes, pad=0.02)
    bar.set_ticks(range(len(kinds)), labels=[kind[0] for kind in kinds])
    bar.ax.tick_params(which="both", length=0)
    bar.minorticks_off()
    return shade


def kind_map(figure, axes, grid, status, ratio):
    """The kind of motion at each point: its period in forcing periods, none, or a failure."""
    kinds = [
        ("period 1", "#d6e6f4", ratio == 1),
        ("period 2", BLUE, ratio == 2),
        ("period 3, …", GREEN, ratio > 2),
        ("no period", ORANGE, status == APERIODIC),
        ("undecided", "#f5cf8e", status == UNDECIDED),
        ("creeping", BROWN, status == CREEPING),
        ("failed", "black", has_failed(status)),
        ("escaped", OLIVE, status == ESCAPED),
    ]
    return class_map(figure, axes, grid, "kind of motion", kinds)


def regime_map(figure, axes, grid, status, regimes):
    """Regimes n/p, the most frequent ones each with a colour."""
    names, place = np.unique(regimes, return_inverse=True)
    place = place.reshape(regimes.shape)
    counts = Counter(dict(zip(range(len(names)), np.bincount(place.ravel(), minlength=len(names)))))
    counts.pop(0 if names[0] == "" else -1, None)
    frequent = sorted(
        (code for code, _ in counts.most_common(len(REGIME_COLOURS))), key=lambda c: regime_order(names[c])
    )
    kinds = [(regime_name(names[c]), colour, place == c) for c, colour in zip(frequent, REGIME_COLOURS)]
    kinds += [
        ("others", "#7f7f7f", (regimes != "") & ~np.isin(place, frequent)),
        ("no period", NO_PERIOD, status == APERIODIC),
        ("undecided", "#efe3c0", status == UNDECIDED),
        ("failed", "black", has_failed(status)),
        ("escaped", OLIVE, status == ESCAPED),
    ]
    notes = class_map(figure, axes, grid, "regime, impacts on a stop / forcing periods", kinds)
    has_twins = "symmetric" in grid.output and (grid.output.values("symmetric") == 0).any()
    return ["a motion and its mirror image have one regime"] * bool(has_twins) + notes


def regime_order(name):
    """By forcing periods, then by impacts."""
    impacts, periods = name.split("/")
    return int(periods), float(impacts)


def regime_name(name):
    return plain(name).replace("inf", "∞")
