"""The picture of an output for a page, and which point lies under each of its places."""

import io
import re

from ..plots import names, options, pictures, style
from ..plots.branch import chosen, parameter_of, plane_of
from ..plots.choice import members_of
from ..plots.maps import AxesImage
from ..plots.shown import plane_in, results_in

LARGEST = 1_500_000  # bytes of a picture
SYMBOL = r"(?:[^\s,$]*\$[^$]*\$)+[^\s,$]*(?: / \S+)?"
EXTREMES = ("minimum", "maximum")  # whose symbols say of what
RESOLUTIONS = (150, 110, 80, 55)  # dots per inch of what is drawn as an image


def picture(output, points):
    """The picture as SVG, its panels, and what it shows in words."""
    choices = options.choices([output.path])
    if output.is_branch:
        figure = pictures.branches_together([output], choices)
        panels = branch_panels(figure, output)
    elif output.is_accuracy:
        figure = pictures.single_figure(output, choices)
        panels = []
    else:
        members = members_of(output)
        figure = pictures.figure_of(members, choices)
        panels = sweep_panels(figure, points, [member.output for member in members])
    return svg_of(figure), panels, in_words(figure, output)


def in_words(figure, output):
    """What the panels of a figure show, without symbols and units: "displacement, velocity over nu"; of maps over
    both axes: "over nu and xs"."""
    panels = [axes for axes in figure.axes if axes.axison and axes.get_label() != "<colorbar>"]
    shown = dict.fromkeys(result_words(axes, output) for axes in panels)
    over = dict.fromkeys(without_symbols(axes.get_xlabel()) for axes in panels)
    up = dict.fromkeys(without_symbols(axes.get_ylabel()) for axes in panels if is_map(axes))
    parts = [", ".join(filter(None, words)) for words in (shown, over)]
    return " and ".join(filter(None, (" over ".join(filter(None, parts)), *up)))


def is_map(axes):
    return any(isinstance(image, AxesImage) for image in axes.images)


def result_words(axes, output):
    """What a panel shows. A label may be short of words beside its symbol: that of an extreme, a section, a
    sensitivity."""
    text = axes.get_title() or axes.get_ylabel()
    shown = list(dict.fromkeys(name for name, _ in results_in(axes) if name in output))
    if any(names.is_sensitivity(output[name]) for name in shown):
        return ", ".join(names.result_in_words(output, name) for name in shown)
    if len(shown) == 1 and shown[0] in names.RECORDED.values():
        return f"{names.words_of(output, shown[0])} {without_symbols(text)}"
    if len(shown) == 1 and names.words_of(output, shown[0]) in EXTREMES:
        return without_symbols(text).replace(*extreme_in_words(output, shown[0]))
    return without_symbols(text)


def extreme_in_words(output, name):
    """The word of a label for an extreme, and that which says of what."""
    word, quantity = names.words_of(output, name), names.words_of(output, name.partition("_")[0])
    return word, f"{word} {quantity}"


def without_symbols(text):
    """A label without units and powers of ten in brackets or after "in", and without symbols, which go on beside their
    mathematics: x′ and |x′⁻| / gap are one each."""
    while (shorter := re.sub(r"(?<!\$)\([^()]*\)", " ", text)) != text:
        text = shorter
    text = re.sub(rf"(\bin )?{SYMBOL}", " ", text)
    text = re.sub(r"(?<!\bthe)[,\s]+((lower|upper)\s+(stop|wall))\s*$", r", \1", text)  # a component
    return " ".join(text.split()).replace(" ,", ",")


def svg_of(figure):
    """The picture, coarser if it would be large."""
    for dpi in RESOLUTIONS:
        file = io.StringIO()
        figure.savefig(file, format="svg", metadata=pictures.DATELESS["svg"], dpi=style.resolution(figure, dpi))
        if file.tell() < LARGEST:
            break
    return file.getvalue()


def branch_panels(figure, output):
    plane = plane_of(output)
    if plane:
        return [frame(figure.axes[0], columns=list(plane))]
    return [frame(axes, columns=[parameter_of(output), name]) for axes, name in zip(figure.axes, chosen(()))]


def sweep_panels(figure, points, outputs):
    """Panels whose places stand for points: maps of the two axes that are shown, curves or areas over one of them, dots
    at two inputs."""
    output, shown = points.output, outputs[0]
    places = [output.axes.index(axis) for axis in shown.axes]
    panels = []
    for axes in figure.axes:
        if axes.get_label() == "<colorbar>":
            continue
        if len(places) == 2 and is_map(axes):
            panels.append(frame(axes, axes=places))
        elif plane_in(axes):
            panels.append(frame(axes, plane=plane_in(axes)))
        else:
            across = [place for place, axis in zip(places, shown.axes) if lies_across(axes, shown, axis)]
            panels += [frame(axes, axes=[place], **curves_in(axes, points, outputs)) for place in across]
    return panels


def curves_in(axes, points, outputs):
    """The results along the ordinate of a panel, the axes of which each value has its own curves, and whether they are
    dots instead."""
    results = [values for part in results_in(axes) for values in points.drawn(*part)]
    if not results:
        return {}
    held = [output.held for output in outputs]
    families = [axis for axis in held[0] if len({one[axis] for one in held}) > 1]
    return {
        "results": results,
        "families": [points.output.axes.index(axis) for axis in families],
        "cloud": any(output.is_cloud for output in outputs),
    }


def lies_across(axes, shown, axis):
    """Whether a panel has an axis of the sweep as its abscissa; its label may go on, with what its ticks share."""
    label, text = names.label(shown, axis), axes.get_xlabel()
    return text.startswith(label) and text[len(label) :][:1] in ("", " ", ",")


def frame(panel, **under):
    """Where a panel lies in the picture, as shares of its width and height from the upper left, and its scales."""
    box = panel.get_position()
    return {
        "box": [box.x0, 1 - box.y1, box.x1, 1 - box.y0],
        "limits": [*map(float, panel.get_xlim()), *map(float, panel.get_ylim())],
        "log": [panel.get_xscale() == "log", panel.get_yscale() == "log"],
        **under,
    }
