"""Panels that have nothing to draw say why."""

import numpy as np

from .data import PHASE, lacks_period
from .maps import MISSING
from .names import label
from .scales import shown_values

EMPTY = "empty"  # marks the text of a panel without anything


def say_empty(axes, words, is_map=False):
    """A text in the middle of a panel that has nothing else, so that its ordinate has no numbers but in a map."""
    if not is_map:
        axes.set_yticks([])
    axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", va="center", gid=EMPTY)


def empty_results(output, only):
    """The results that are asked for by name, and have no number at any point."""
    names = [name for name in only if name in output and name != PHASE and output[name].values.dtype.kind in "fi"]
    return [name for name in names if not np.isfinite(shown_values(output, name)).any()]


def why_empty(output, name):
    """Why no point has a value of a result."""
    if name == "contact_force_max":
        return "no soft stops"
    reason = MISSING.get(name, "no value")
    if reason == "no impact":
        return "no impacts"
    return "no period" if lacks_period(output.values("status")).all() else reason


def empty_panel(output, only, set_axes):
    """One panel for the results that are asked for and that no point has, with the reason in it."""

    def draw(figure, axes):
        is_map = len(output.axes) > 1
        set_axes(axes, output, output.axes[0])
        (axes.set_title if is_map else axes.set_ylabel)(label(output, names[0]))
        say_empty(axes, why_empty(output, names[0]), is_map)

    names = empty_results(output, only)
    return [draw] if names else []
