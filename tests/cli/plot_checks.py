"""Elements of pictures that scripts/plot.py makes."""

import re
import sys
import xml.etree.ElementTree
from itertools import combinations

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
    room = figure.bbox.padded(1)
    return [
        text
        for text, box in texts or texts_with_boxes(figure)
        if min(box.x0 - room.x0, room.x1 - box.x1, box.y0 - room.y0, room.y1 - box.y1) < 0
    ]


def overlapping_texts(figure, texts=None):
    """Pairs of texts of a figure that lie on each other; they are measured unless they are given."""
    return [
        (one, other)
        for (one, box), (other, second) in combinations(texts or texts_with_boxes(figure), 2)
        if min(box.x1, second.x1) - max(box.x0, second.x0) > 1 and min(box.y1, second.y1) - max(box.y0, second.y0) > 1
    ]


def numbers_beyond(axes):
    """The numbers of ticks beyond the limits, which are not drawn, and all that belongs to axes that are off."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        room = 1e-9 * (high - low)
        for tick in axis.get_major_ticks() + axis.get_minor_ticks():
            if not axes.axison or not low - room <= tick.get_loc() <= high + room:
                yield from (tick.label1, tick.label2)
