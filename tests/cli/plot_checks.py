"""Elements of pictures that scripts/plot.py makes."""

import re
import sys
import xml.etree.ElementTree

import numpy as np

from command_line import SOURCE

sys.path.insert(0, str(SOURCE / "scripts"))

SVG = "{http://www.w3.org/2000/svg}"


class Svg:
    """A picture in SVG: its panels, and the texts, curves, images of each. Texts are drawn as outlines, with what they
    say in a comment."""

    def __init__(self, path):
        builder = xml.etree.ElementTree.TreeBuilder(insert_comments=True)
        self.root = xml.etree.ElementTree.parse(path, xml.etree.ElementTree.XMLParser(target=builder)).getroot()
        groups = self.root.iter(f"{SVG}g")
        self.panels = [Panel(group) for group in groups if re.fullmatch(r"axes_\d+", group.get("id", ""))]

    def texts(self):
        return texts_in(self.root)


class Panel:
    def __init__(self, group):
        self.group = group

    def texts(self):
        return texts_in(self.group)

    def legend(self):
        """The entries of the legend."""
        return [text for part in self.children("legend_") for text in texts_in(part)]

    def curves(self):
        """Lines and markers outside axes and legend."""
        return self.children("line2d_")

    def images(self):
        return list(self.group.iter(f"{SVG}image"))

    def children(self, prefix):
        return [child for child in self.group if child.get("id", "").startswith(prefix)]


def texts_in(element):
    """The texts, with plain blanks where a line may not end."""
    return [part.text.strip().replace("\N{NO-BREAK SPACE}", " ") for part in element.iter() if callable(part.tag)]


def texts_with_boxes(figure):
    """The texts of a figure that are drawn, each with its place in pixels."""
    from matplotlib.text import Text

    figure.draw_without_rendering()
    hidden = {id(text) for axes in figure.axes for text in numbers_beyond(axes)}
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip()]
    return [(text.get_text(), text.get_window_extent()) for text in texts if id(text) not in hidden]


def texts_beyond(figure, texts=None):
    """Texts that a figure cuts off; they are measured unless they are given."""
    texts = texts or texts_with_boxes(figure)
    low, high = corners(texts)
    room = figure.bbox.padded(1)
    cut = ((low < room.min) | (high > room.max)).any(axis=1)
    return [texts[place][0] for place in np.flatnonzero(cut)]


def overlapping_texts(figure, texts=None):
    """Pairs of texts of a figure that lie on each other; they are measured unless they are given."""
    texts = texts or texts_with_boxes(figure)
    low, high = corners(texts)
    common = np.minimum(high[:, None], high) - np.maximum(low[:, None], low)
    pairs = np.argwhere(np.triu((common > 1).all(axis=2), 1))
    return [(texts[one][0], texts[other][0]) for one, other in pairs]


def crowded_texts(figure):
    """Both, of texts that are measured once: pairs that lie on each other, and those that are cut off."""
    texts = texts_with_boxes(figure)
    return overlapping_texts(figure, texts), texts_beyond(figure, texts)


def corners(texts):
    """The lower left and the upper right corners of the boxes of texts, in pixels."""
    return tuple(np.array([getattr(box, corner) for _, box in texts]).reshape(-1, 2) for corner in ("min", "max"))


def numbers_beyond(axes):
    """The numbers of ticks beyond the limits, which are not drawn, and all that belongs to axes that are off."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        room = 1e-9 * (high - low)
        for tick in axis.get_major_ticks() + axis.get_minor_ticks():
            if not axes.axison or not low - room <= tick.get_loc() <= high + room:
                yield from (tick.label1, tick.label2)
