"""The numbers of the points of an output, packed for a page: each is the double of the file."""

import base64
import math
import zlib

import numpy as np

from ..plots.names import in_one_line, names_of
from ..plots.per_period import IN_TIME, TOTALS, compared

MOST = 200  # points along an axis of a map
ROOM = 2_600_000  # bytes of all numbers in a page
PACKED = 11  # bytes of a double that doesn't compress
COMPONENTS = 12  # of a result that a page shows
RECORDS = ("sample", "impact")  # dimensions of a motion, which is drawn
UNSHOWN = ("impact_count",)


class Points:
    """Some points of an output, evenly spread over its axes, with all their results."""

    def __init__(self, output):
        self.output = output
        self.axes = output.axes if not output.is_branch else ("point",)
        names = [name for name, variable in output.variables.items() if variable.dims[:1] == ("point",)]
        self.results = names if output.is_branch else [name for name in output.results() if name not in UNSHOWN]
        self.columns = [column for name in self.results for column in self.components(name)]
        self.whole = output.values("arclength").shape if output.is_branch else output.shape
        self.kept = [spread(length, most) for length, most in zip(self.whole, self.most_of_each())]

    def components(self, name):
        """(name of the column as `clatter export` has it, variable, place) of each component that is shown."""
        variable = self.output[name]
        extra = variable.dims[len(self.axes) :]
        if not extra:
            return [(name, variable, ())]
        if len(extra) > 1 or extra[0] in RECORDS:
            return []
        coordinate = self.output.variables.get(extra[0])
        count = min(variable.values.shape[-1], COMPONENTS)
        places = coordinate.values if coordinate is not None else range(count)
        return [(f"{name}[{int(places[part])}]", variable, (part,)) for part in range(count)]

    def most_of_each(self):
        """How many values of each axis have room; one axis alone has all that a map would."""
        points = min(MOST**2, ROOM // (PACKED * max(1, len(self.columns))))
        return shared_out(points, self.whole)

    @property
    def shape(self):
        return [len(kept) for kept in self.kept]

    @property
    def are_all(self):
        return tuple(self.shape) == tuple(self.whole)

    def packed(self):
        """Their data for the page's script."""
        return {
            "shape": self.shape,
            "whole": [list(map(int, kept)) for kept in self.kept],  # their indexes in the file
            "axes": [] if self.output.is_branch else [self.axis(place) for place in range(len(self.axes))],
            "columns": [self.column(*column) for column in self.columns],
        }

    def axis(self, place):
        """An axis and the keys that are linked to it."""
        own, *linked = keys_along(self.output, self.axes[place]) or [self.axes[place]]
        return {**self.input(own, place), "linked": [self.input(name, place) for name in linked]}

    def input(self, name, place):
        unit = self.output[name].units
        words = names_of(self.output, name)[0] or self.output[name].long_name  # as in pictures
        return {
            "name": name,
            "title": words + (f" ({in_one_line(unit)})" if unit != "1" else ""),
            "values": packed(self.output.values(name)[self.kept[place]]),
        }

    def drawn(self, name, part):
        """The numbers of a result, or a component of it, as pictures draw it: the name of a column, or the numbers;
        nothing if a page has no such column."""
        columns = [own for own, variable, place in self.columns if variable.name == name and place in ((), (part,))]
        if name not in TOTALS or not columns:
            return columns[:1]
        values = compared(self.output).values(name)[np.ix_(*self.kept)]
        return [{"values": packed(values if part is None else values[..., part])}]

    def column(self, name, variable, part):
        values = variable.values[np.ix_(*self.kept)][(..., *part)] if self.kept else variable.values[part]
        item = {
            "name": name,
            "title": variable.long_name,
            "unit": in_one_line(variable.units) if variable.units != "1" else "",
        }
        if IN_TIME in variable.long_name:
            item["over"] = IN_TIME  # not per forcing period, as pictures and extremes have it
        if variable.name == "status":
            item["texts"] = {str(code): meaning.replace("_", " ") for code, meaning in self.output.meanings.items()}
        elif values.dtype.kind in "UOS":
            texts, codes = np.unique(np.ravel(values).astype(str), return_inverse=True)
            item["texts"], values = dict(enumerate(map(str, texts))), codes
        return {**item, "values": packed(values)}


def keys_along(output, axis):
    """The keys of the sweep that have their values along an axis: its own first, and those linked to it."""
    keys = [key for key in output.sweep if key in output and output[key].dims == (axis,)]
    return sorted(keys, key=lambda key: key != axis)


def packed(values):
    """Doubles in the machine's usual order, deflated, as text."""
    return base64.b64encode(zlib.compress(np.ravel(values).astype("<f8").tobytes(), 9)).decode()


def spread(length, most):
    """Indexes, evenly spread from the first to the last; all of them if they are few."""
    return np.unique(np.linspace(0, length - 1, min(length, most)).round().astype(int))


def shared_out(points, shape):
    """The largest numbers of values along the axes, as equal as these allow, whose product has room."""
    counts = [1] * len(shape)
    for place in sorted(range(len(shape)), key=lambda place: shape[place]):
        rest = [other for other in range(len(shape)) if counts[other] == 1 and other != place and shape[other] > 1]
        room = points // math.prod(counts)
        counts[place] = max(1, min(shape[place], int(room ** (1 / (1 + len(rest))) + 1e-9)))
    return counts
