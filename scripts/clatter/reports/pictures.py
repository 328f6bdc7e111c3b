"""The picture of an output for a page, and which point lies under each of its places."""

import io

from ..plots import names, options, pictures, style
from ..plots.branch import chosen, parameter_of, plane_of
from ..plots.choice import members_of
from ..plots.maps import AxesImage

LARGEST = 1_500_000  # bytes of a picture
RESOLUTIONS = (150, 110, 80, 55)  # dots per inch of what is drawn as an image


def picture(output):
    """The picture as SVG, and its panels."""
    choices = options.choices([output.path])
    if output.is_branch:
        figure = pictures.branches_together(choices)
        panels = branch_panels(figure, output)
    elif output.is_accuracy:
        figure = pictures.single_figure(output, choices)
        panels = []
    else:
        members = members_of(output)
        figure = pictures.figure_of(members, choices)
        panels = sweep_panels(figure, output, members[0].output)
    svg = svg_of(figure)
    return svg, panels


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


def sweep_panels(figure, output, shown):
    """Panels whose places stand for points: maps of the two axes that are shown, curves or areas over one of them."""
    places = [output.axes.index(axis) for axis in shown.axes]
    panels = []
    for axes in figure.axes:
        if axes.get_label() == "<colorbar>":
            continue
        if len(places) == 2 and any(isinstance(image, AxesImage) for image in axes.images):
            panels.append(frame(axes, axes=places))
        else:
            across = [place for place, axis in zip(places, shown.axes) if lies_across(axes, shown, axis)]
            panels += [frame(axes, axes=[place]) for place in across]
    return panels


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
