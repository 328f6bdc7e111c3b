"""Panels of results over two axes, drawn as images: one for the values, one for the hatch."""

import copy
from collections import Counter

import numpy as np
from matplotlib import cm, colormaps, colors, ticker

from plot_data import APERIODIC, FIRST_FAILURE
from plot_scales import MOST_LEVELS, colour_range, is_count
from plot_style import BLUE, CYCLE, GREEN, ORANGE, is_geometric, label

PIXELS = (900, 700)  # of an image, if its cells aren't all equal, and of a hatch
MOST_PIXELS = 1200  # along one axis; of more points the nearest to each pixel is shown
STRIPE = 6  # pixels from one line of the hatch to the next
NO_PERIOD = "#cfcfcf"


class Grid:
    """Where the points of a map lie on its two axes: each in the middle of a cell, and no cell cut by the frame."""

    def __init__(self, output, names, limits=(None, None), log=""):
        self.output, self.names = output, names
        self.sides = [
            Side(values, view, axis in log or is_geometric(values))
            for values, view, axis in zip((output.values(name) for name in names), limits, "xy")
        ]

    def image(self, values):
        """The values of the cells, shape of the two axes, as pixels: rows from below."""
        column, row = (side.cells for side in self.sides)
        pixels = values[np.ix_(np.maximum(column, 0), np.maximum(row, 0))].T
        outside = (row < 0)[:, None] | (column < 0)
        return np.ma.masked_where(outside, pixels) if outside.any() else pixels

    def draw(self, axes, pixels):
        """Fills the frame with pixels, [row][column][red, green, blue, opacity] as bytes."""
        axes.imshow(
            pixels,
            origin="lower",
            aspect="auto",
            extent=(0, 1, 0, 1),
            transform=axes.transAxes,
            interpolation="nearest",
        )
        for side, name, axis in zip(self.sides, self.names, "xy"):
            getattr(axes, f"set_{axis}scale")("log" if side.is_log else "linear")
            getattr(axes, f"set_{axis}lim")(*side.view)
            getattr(axes, f"set_{axis}label")(label(self.output, name))
        axes.tick_params(which="both", top=False, right=False)

    def colour(self, axes, values, **shades):
        """Fills the frame with values in colours, none if they are NaN; returns what a colour bar takes."""
        shade = cm.ScalarMappable(colors.Normalize(shades["vmin"], shades["vmax"]), shades["cmap"])
        self.draw(axes, shade.to_rgba(np.ma.masked_invalid(self.image(values)), bytes=True))
        return shade

    def hatch(self, axes, cells):
        """Strokes over these cells, all of them in one image."""
        fine = copy.copy(self)
        fine.sides = [side.finer(pixels) for side, pixels in zip(self.sides, PIXELS)]
        covered = np.ma.filled(fine.image(cells), False)
        rows, columns = np.indices(covered.shape)
        strokes = np.zeros((*covered.shape, 4), np.uint8)
        strokes[covered & ((rows - columns) % STRIPE < 1), 3] = 160
        self.draw(axes, strokes)


class Side:
    """One axis of a map: its scale, its limits, and the cell that each pixel shows, -1 for none."""

    def __init__(self, values, view, is_log, pixels=None):
        self.values, self.is_log = values, is_log and values.min() > 0
        order = np.argsort(values, kind="stable")
        place = self.to_scale(values[order])
        middles = (place[1:] + place[:-1]) / 2
        first, last = (middles[0] - place[0], place[-1] - middles[-1]) if len(values) > 1 else (0.5, 0.5)
        edges = np.concatenate([[place[0] - first], middles, [place[-1] + last]])
        if edges[0] == edges[-1]:
            edges = edges + np.linspace(-0.5, 0.5, len(edges))  # all values are one
        low, high = self.to_scale(np.asarray(view, float)) if view else (edges[0], edges[-1])
        self.view = self.from_scale(low), self.from_scale(high)
        even = not view and len(values) <= MOST_PIXELS and np.allclose(np.diff(edges), edges[1] - edges[0], rtol=1e-6)
        count = pixels or (len(values) if even else PIXELS[0] if len(values) <= PIXELS[0] else MOST_PIXELS)
        centres = low + (np.arange(count) + 0.5) / count * (high - low)
        cell = np.searchsorted(edges, centres) - 1
        inside = (cell >= 0) & (cell < len(values))
        self.cells = np.where(inside, order[np.clip(cell, 0, len(values) - 1)], -1)

    def finer(self, pixels):
        return Side(self.values, self.view, self.is_log, pixels)

    def to_scale(self, values):
        return np.log(values) if self.is_log else np.asarray(values, float)

    def from_scale(self, value):
        return float(np.exp(value) if self.is_log else value)


def value_map(figure, axes, grid, title, values, status):
    """A result over two axes in colours; hatched where motion has no period, black where the point failed. Returns
    the notes that explain it."""
    values = np.where(status >= FIRST_FAILURE, np.nan, values)
    low, high, is_clipped = colour_range(values)
    steps = is_count(values) and low == round(low) and high - low < MOST_LEVELS
    shades = {"vmin": low, "vmax": high, "cmap": "viridis"}
    if steps:
        high = np.ceil(high)
        levels = int(high - low) + 1
        shades = {"vmin": low - 0.5, "vmax": high + 0.5, "cmap": colors.ListedColormap(step_colours(levels))}
    elif low < 0.0 < high:
        most = max(-low, high)
        shades = {"vmin": -most, "vmax": most, "cmap": "RdBu_r"}
    shade = grid.colour(axes, values, **shades)
    bar = figure.colorbar(shade, ax=axes, pad=0.02, extend="max" if is_clipped else "neither")
    if steps:
        bar.set_ticks(np.arange(low, high + 0.5))
        bar.ax.tick_params(which="both", length=0)
    else:
        bar.ax.yaxis.set_major_locator(ticker.MaxNLocator(6, integer=is_count(values)))
    axes.set_title(title, fontsize=10)
    notes = ["greatest values clipped"] * is_clipped + mark_points(axes, grid, status)
    return notes + ["white: no value"] * bool((np.isnan(values) & (status < FIRST_FAILURE)).any())


def step_colours(count):
    """A colour for each of a few integers, from dark to light."""
    return colormaps["viridis"](np.linspace(0, 1, count)) if count > 1 else [BLUE]


def mark_points(axes, grid, status):
    """Hatches aperiodic points and blackens failed ones; returns the notes that explain this."""
    loose, failed = status == APERIODIC, status >= FIRST_FAILURE
    if loose.any():
        grid.hatch(axes, loose)
    if failed.any():
        cells = np.ma.filled(grid.image(failed), False)
        black = np.zeros((*cells.shape, 4), np.uint8)
        black[cells, 3] = 255
        grid.draw(axes, black)
    return ["hatched: no period"] * bool(loose.any()) + ["black: failed"] * bool(failed.any())


def class_map(figure, axes, grid, title, classes, codes):
    """Named classes over two axes, each with its colour; `codes` has the number of its class for each point, NaN for
    none."""
    shades = colors.ListedColormap([colour for _, colour in classes])
    shade = grid.colour(axes, codes, cmap=shades, vmin=-0.5, vmax=len(classes) - 0.5)
    bar = figure.colorbar(shade, ax=axes, ticks=range(len(classes)), pad=0.02)
    bar.ax.set_yticklabels([name for name, _ in classes])
    bar.ax.tick_params(which="both", length=0)
    axes.set_title(title, fontsize=10)
    return []


def kind_map(figure, axes, grid, status, ratio):
    """The kind of motion at each point: its period in forcing periods, none, or a failure."""
    kinds = [
        ("period 1", "#d6e6f4", ratio == 1),
        ("period 2", BLUE, ratio == 2),
        ("period 3, …", GREEN, ratio > 2),
        ("no period", ORANGE, status == APERIODIC),
        ("failed", "black", status >= FIRST_FAILURE),
    ]
    return class_map(figure, axes, grid, "kind of motion", *coded(kinds))


def regime_map(figure, axes, grid, status, regimes):
    """Regimes n/p, the most frequent ones each with a colour."""
    counts = Counter(regimes[regimes != ""].tolist())
    named = sorted((name for name, _ in counts.most_common(len(REGIME_COLOURS))), key=regime_order)
    kinds = [(regime_name(name), colour, regimes == name) for name, colour in zip(named, REGIME_COLOURS)]
    kinds += [
        ("others", "#7f7f7f", (regimes != "") & ~np.isin(regimes, named)),
        ("no period", NO_PERIOD, status == APERIODIC),
        ("failed", "black", status >= FIRST_FAILURE),
    ]
    return class_map(figure, axes, grid, "regime, impacts on a stop / forcing periods", *coded(kinds))


REGIME_COLOURS = ("#e8f1f8", *CYCLE, "#8c510a", "#80cdc1", "#543005")


def regime_order(name):
    """By forcing periods, then by impacts."""
    impacts, periods = name.split("/")
    return int(periods), float(impacts)


def regime_name(name):
    return name.replace("inf", "∞")


def coded(kinds):
    """The names and colours of the kinds that occur, and the number of each point's kind."""
    kinds = [kind for kind in kinds if kind[2].any()]
    codes = np.full(kinds[0][2].shape if kinds else (1, 1), np.nan)
    for code, (_, _, cells) in enumerate(kinds):
        codes[cells] = code
    return [(name, colour) for name, colour, _ in kinds], codes
