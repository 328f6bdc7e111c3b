"""Logarithmic scales that the command line asks for: what they have no place for is left out, and named."""

import textwrap

import numpy as np

from .empty import say_empty
from .style import NOTE, legend_above

MARGIN = 0.05  # of the length of a logarithmic axis beside its values


def names_left_out(axes, options):
    """Takes curves that lie at 0 and below off the logarithmic scales of a panel, with their entries of the legend, and
    returns their names, and those of curves of which only a part is drawn."""
    lines = [line for line in axes.get_lines() if line.get_transform() == axes.transData and len(line.get_xdata())]
    shown = {line: drawn_share(line, options.log) for line in lines}
    left_out = [line for line, share in shown.items() if share < 1.0]
    if not options.log or not lines:
        return []
    kept = [line for line in lines if shown[line] > 0.0]
    fit(axes, kept, options)
    if not left_out:
        return []
    drawn = {name_of(axes, line) for line in kept}
    names = dict.fromkeys(name_of(axes, line) for line in left_out)
    colours = {colour_of(line) for line in kept}
    columns = getattr(axes.get_legend(), "_ncols", 4)
    if axes.get_legend():
        axes.get_legend().remove()
    for line in axes.get_lines():
        is_entry = line not in lines and not len(line.get_xdata()) and colour_of(line) not in colours
        if line in left_out and line not in kept or is_entry and colour_of(line) in map(colour_of, left_out):
            line.remove()
    legend_above(axes, columns=columns)
    if not kept:
        say_empty(axes, "nothing above 0")
        for axis in options.log:
            leave_bare(axes, axis)
    return [f"part of {name}" if name in drawn else name for name in names]


def leave_bare(axes, axis):
    """A logarithmic axis without numbers, if nobody has set its limits and nothing lies on it."""
    if min(getattr(axes, f"get_{axis}lim")()) <= 0:
        getattr(axes, f"set_{axis}lim")(0.1, 1.0)
        axes.tick_params(axis=axis, which="both", labelleft=False, labelbottom=False)


def colour_of(line):
    return line.get_color() if line.get_linestyle() != "None" else line.get_markeredgecolor()


def name_of(axes, line):
    """A curve in words: its entry of the legend, if hidden, or else that of its colour, or the label of its axis."""
    same = [other for other in axes.get_lines() if colour_of(other) == colour_of(line)]
    labels = [other.get_label() for other in (line, *same)]
    names = [name.removeprefix("_") for name in labels if not name.startswith(("_child", "_no"))]
    return names[0] if names else axes.get_ylabel().replace("\n", ", ")


def drawn_share(line, log):
    """The share of the points of a line that logarithmic axes have a place for; 1 if it has none."""
    places = dict(zip("xy", (np.asarray(part, float) for part in line.get_data())))
    known = np.isfinite(places["x"]) & np.isfinite(places["y"])
    above = np.all([places[axis] > 0 for axis in log] + [known], axis=0)
    return above.sum() / known.sum() if known.any() else 1.0


def fit(axes, lines, options):
    """Limits of logarithmic scales, where nobody has set them, that leave out 0 and what lies below."""
    for axis, limits in (("x", options.xlim), ("y", options.ylim)):
        values = [np.asarray(getattr(line, f"get_{axis}data")(), float) for line in lines]
        values = np.concatenate(values) if values else np.empty(0)
        values = values[np.isfinite(values) & (values > 0)]
        if axis in options.log and not limits and values.size and min(getattr(axes, f"get_{axis}lim")()) <= 0:
            low, high = np.log([values.min(), values.max()])
            room = MARGIN * ((high - low) or 1.0)
            getattr(axes, f"set_{axis}lim")(np.exp(low - room), np.exp(high + room))


def note_left_out(figure, names):
    """Names in the caption of a figure, which grows by the lines, what logarithmic scales leave out."""
    if not names:
        return
    note = f"at 0 and below, so not on a logarithmic axis: {', '.join(dict.fromkeys(names))}"
    lines = textwrap.wrap(note, int(13 * figure.get_figwidth()))
    caption = figure._supxlabel.get_text() if figure._supxlabel else ""
    figure.supxlabel("\n".join([caption, *lines]).strip(), fontsize=9.5, linespacing=1.4)
    figure.set_figheight(figure.get_figheight() + NOTE * len(lines))
