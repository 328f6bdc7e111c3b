"""Impacts by the forcing phase at which they happen: the diagrams of a bouncing ball."""

import numpy as np
from matplotlib import ticker

from .bifurcation import MANY, dots
from .data import PHASE
from .empty import say_empty
from .names import label
from .scales import tidy_ticks
from .style import BLUE, VERMILION, colour_of, legend_above

QUARTERS = ("0", "π/2", "π", "3π/2", "2π")
SIDES = ((-1, BLUE), (1, VERMILION))


def phases_panel(members):
    """The panel of all impacts of some outputs: one alone over an axis has a colour for each of its values."""
    output = members[0].output

    def draw(figure, axes):
        if len(members) == 1 and len(output.axes) == 1 and np.ptp(output.values(output.axes[0])) > 0:
            by_parameter(figure, axes, output)
        else:
            by_name(axes, members)
        finish(axes, members)

    return draw


def velocity_of(output):
    """The variable of the velocities: as the ground sees them if stops or base are shaken."""
    return "impact_v_before_absolute" if "impact_v_before_absolute" in output else "impact_v_before"


def by_parameter(figure, axes, output):
    """Each impact in the colour of its point's place on the axis."""
    axis = output.axes[0]
    along = np.repeat(output.values(axis).astype(float), output.values("impact_count"))
    phases, velocities = output.values(PHASE), output.values(velocity_of(output))
    known = np.isfinite(phases)
    if not known.any():
        return
    size = 1.5 if known.sum() > MANY else 6
    points = axes.scatter(phases[known], velocities[known], s=size, lw=0, c=along[known], rasterized=known.sum() > MANY)
    bar = figure.colorbar(points, ax=axes, pad=0.02)
    bar.set_label(label(output, axis))
    tidy_ticks(bar.ax)


def by_name(axes, members):
    """The impacts of a single output by stops, those of several by outputs."""
    for place, member in enumerate(members):
        output = member.output
        phases, velocities, sides = (output.values(name) for name in (PHASE, velocity_of(output), "impact_stop"))
        sides_of_one = [(side, colour, output.stop_name(side)) for side, colour in SIDES]
        parts = sides_of_one if len(members) == 1 else ((0, colour_of(place), member.title),)
        for side, colour, title in parts:
            shown = np.isfinite(phases) & (sides == side if side else True)
            if shown.any():
                dots(axes, phases[shown], velocities[shown], colour, title)
    legend_above(axes, columns=3)


def finish(axes, members):
    """A whole turn of the force on the abscissa, in quarters of it."""
    output = members[0].output
    if not axes.lines and not axes.collections:
        say_empty(axes, "no impacts" if output.is_forced() else "no force")
    axes.set_xlim(0.0, 2 * np.pi)
    axes.xaxis.set_major_locator(ticker.FixedLocator(np.linspace(0, 2 * np.pi, len(QUARTERS))))
    axes.xaxis.set_major_formatter(ticker.FixedFormatter(QUARTERS))
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    axes.margins(y=0.08)
    axes.set_xlabel(label(output, PHASE))
    axes.set_ylabel(label(output, velocity_of(output)))
