"""Labels beside the points of curves, each at a place where it covers nothing; those without room are left out."""

from dataclasses import dataclass

import numpy as np

SIZE = 7.5  # points, as all lengths here
SAME = 5.0  # points of a curve that are nearer to each other share a label
TICK = 3.5  # what the ticks inside the frame need
DISTANCES = (4.0, 6.0, 8.0, 10.0)
ABOVE, BELOW = ((1, 1), (1, 0), (0, 1)), ((-1, -1), (-1, 0), (0, -1))  # of a curve that falls
DIRECTIONS = (*ABOVE, *BELOW, (1, -1), (-1, 1))
SIDES = {-1: "right", 0: "center", 1: "left"}, {-1: "top", 0: "center", 1: "bottom"}


@dataclass
class Labels:
    """The labels of one curve: a text for each of its points."""

    axes: object
    x: np.ndarray
    y: np.ndarray
    texts: list
    color: str
    directions: tuple = DIRECTIONS  # the first that is free is taken


def place_labels(figure, all_labels):
    """Writes the labels of all curves; everything else must be in the figure."""
    figure.draw_without_rendering()
    point = figure.dpi / 72.0
    taken = {labels.axes: obstacles(labels.axes, 2.0 * point) for labels in all_labels}
    boxes = {labels.axes: [] for labels in all_labels}
    for labels in all_labels:
        groups = together(labels, SAME * point)
        for first, last in ends_first(groups):
            box = place(labels, first, last, taken[labels.axes], boxes[labels.axes])
            boxes[labels.axes] += [box] if box else []


def together(labels, near):
    """(first, last) of each run of successive points that share a label, since they lie on each other."""
    spots = labels.axes.transData.transform(np.column_stack([labels.x, labels.y]))
    groups = []
    for place, spot in enumerate(spots):
        if groups and np.hypot(*(spot - spots[groups[-1][0]])) < near:
            groups[-1] = (groups[-1][0], place)
        else:
            groups.append((place, place))
    return groups


def ends_first(items):
    """The same items, the first and the last before those between."""
    return items[:1] + items[1:][-1:] + items[1:-1]


def place(labels, first, last, taken, boxes):
    """Writes one label beside its points at the first place that is free, and returns its box; or None."""
    axes, middle = labels.axes, (first + last) // 2
    text = labels.texts[first] if first == last else f"{labels.texts[first]} … {labels.texts[last]}"
    note = axes.annotate(
        text,
        (labels.x[middle], labels.y[middle]),
        (0, 0),
        textcoords="offset points",
        fontsize=SIZE,
        color=labels.color,
    )
    note.set_in_layout(False)
    for distance in DISTANCES:
        for right, up in labels.directions:
            length = distance / (1.0 if 0 in (right, up) else 1.6)
            note.set(position=(right * length, up * length), ha=SIDES[0][right], va=SIDES[1][up])
            box = note.get_window_extent()
            if is_free(box, axes.bbox.padded(-TICK * axes.figure.dpi / 72.0), taken, boxes):
                return box
    note.remove()
    return None


def is_free(box, frame, taken, boxes):
    """Whether a box lies inside the frame and covers no point and no other box."""
    inside = frame.x0 < box.x0 and box.x1 < frame.x1 and frame.y0 < box.y0 and box.y1 < frame.y1
    (x, y), half = np.transpose(taken), (box.width / 2, box.height / 2)
    hit = (np.abs(x - box.x0 - half[0]) < half[0]) & (np.abs(y - box.y0 - half[1]) < half[1])
    return inside and not hit.any() and not any(box.overlaps(other) for other in boxes)


def obstacles(axes, step):
    """Pixels along everything that is drawn in the axes, `step` apart, and around its markers."""
    pixels = [np.empty((0, 2))]
    for line in axes.get_lines():
        corners = line.get_transform().transform(np.column_stack(line.get_data()))
        corners = corners[np.isfinite(corners).all(axis=1)]
        pixels += [along(corners, step)] if line.get_linestyle() != "None" else []
        size = line.get_markersize() / 2 * axes.figure.dpi / 72.0 if line.get_marker() != "None" else 0.0
        pixels += [corners + size * np.array(direction) / np.hypot(*direction) for direction in DIRECTIONS]
    for bars in axes.collections:
        pixels += [along(axes.transData.transform(path.vertices), step) for path in bars.get_paths()]
    return np.concatenate(pixels)


def along(corners, step):
    """Points on the line through the corners, no farther apart than `step`."""
    parts = [
        np.linspace(start, end, int(np.hypot(*(end - start)) / step) + 2)
        for start, end in zip(corners[:-1], corners[1:])
    ]
    return np.concatenate([corners, *parts])
