"""Panels of results over two axes."""

import numpy as np
from matplotlib import colors

from plot_data import APERIODIC, FIRST_FAILURE
from plot_style import BLUE, GREEN, ORANGE, set_axis


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
    """The kind of motion at each point: its period in forcing periods, none, or a failure."""
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
