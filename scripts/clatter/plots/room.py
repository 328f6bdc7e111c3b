"""Whether a picture of a given size has room for its texts and panels, and the smallest size of its shape that has."""

import numpy as np
from matplotlib.text import Text

from . import style
from .choice import ChoiceProblem

LOWEST, NARROWEST = 0.7, 0.9  # inches, of the frame of a panel
LARGEST = 100.0  # inches, of a side
TOUCH = 1.0  # pixels by which boxes may lie on each other
TRIES = 4  # halvings between a size that is too small and one that isn't
STEP = 0.1  # inches, of the sizes that are offered


def require_room(figure, draw, size):
    """Refuses a figure that has no room in its size; `draw` makes it for another."""
    problem = crowding(figure)
    if not problem:
        return
    found = smallest(draw, size)
    way = f"the smallest of this shape that fits is --size {written(found)}" if found else "choose another shape"
    raise ChoiceProblem(f"--size {written(size)}: {problem}; {way}; fewer panels (--only) need less")


def written(size):
    """A size in inches, and in brackets in centimetres."""
    return "x".join(f"{side:.3g}" for side in size) + f" ({'x'.join(f'{2.54 * side:.3g}' for side in size)}cm)"


def smallest(draw, size):
    """The smallest size of this shape that has room, in steps; None if none has."""
    with style.own_style():
        natural = draw(None).get_size_inches()
    low, high = 1.0, max(1.0, *(own / side for own, side in zip(natural, size)))
    while not fits(draw, scaled(size, high)):
        low, high = high, 1.3 * high
        if high * max(size) > LARGEST:
            return None
    for _ in range(TRIES):
        middle = (low + high) / 2
        low, high = (low, middle) if fits(draw, scaled(size, middle)) else (middle, high)
    return scaled(size, high)


def scaled(size, factor):
    """A size of the same shape, in steps: this is what a message offers, so this has to fit."""
    return tuple(-(-side * factor // STEP) * STEP for side in size)


def fits(draw, size):
    with style.own_style(size):
        return not crowding(draw(size))


def crowding(figure):
    """What has no room in a figure, as text; empty if all has."""
    texts = texts_with_boxes(figure)
    panels = [axes for axes in figure.axes if axes.axison and axes.get_label() != "<colorbar>"]
    frames = [axes.get_window_extent() for axes in panels]
    if any(frame.height < LOWEST * figure.dpi or frame.width < NARROWEST * figure.dpi for frame in frames):
        return f"its {'panels are' if len(panels) > 1 else 'panel is'} too small to be read"
    legends = [legend.get_window_extent() for legend in all_legends(figure)]
    if any(overlap(box, frame) for box in legends for frame in frames):
        return "its legends lie on its panels"
    if any_overlap(texts):
        return "its texts lie on each other"
    room = figure.bbox
    is_cut = any(box.x0 < -1 or box.y0 < -1 or box.x1 > room.x1 + 1 or box.y1 > room.y1 + 1 for box in texts)
    return "its texts are cut" if is_cut else ""


def all_legends(figure):
    return [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]


def overlap(one, other):
    """Whether two boxes lie on each other by more than a touch."""
    width = min(one.x1, other.x1) - max(one.x0, other.x0)
    return width > TOUCH and min(one.y1, other.y1) - max(one.y0, other.y0) > TOUCH


def any_overlap(boxes):
    """Whether any two of many boxes lie on each other by more than a touch."""
    low, high = (np.array([getattr(box, corner) for box in boxes]).reshape(-1, 2) for corner in ("min", "max"))
    common = np.minimum(high[:, None], high) - np.maximum(low[:, None], low)
    return bool(np.triu((common > TOUCH).all(axis=2), 1).any())


def texts_with_boxes(figure):
    """The boxes, in pixels, of all texts that a figure shows."""
    figure.draw_without_rendering()
    hidden = {id(text) for axes in figure.axes for text in unseen_numbers(axes)}
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip()]
    return [text.get_window_extent() for text in texts if id(text) not in hidden]


def unseen_numbers(axes):
    """The numbers of ticks that aren't drawn: those beyond the limits, and all of axes that are off."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        beyond = 1e-9 * (high - low)
        for tick in axis.get_major_ticks() + axis.get_minor_ticks():
            if not axes.axison or not low - beyond <= tick.get_loc() <= high + beyond:
                yield from (tick.label1, tick.label2)
