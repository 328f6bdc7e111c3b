"""The variables of a file, with all that it says of them, and the names of its scene's constants."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from .names import plain
from ..hdf5_files import dimensions_of, text, values_of

try:
    import tomllib
except ModuleNotFoundError:  # before Python 3.11
    import tomli as tomllib


@dataclass
class Variable:
    """One variable of the file; `dims` are the names of its dimensions, slowest first."""

    name: str
    values: np.ndarray
    dims: tuple
    long_name: str
    units: str
    frame: str = ""  # "relative" or "absolute" in scenes that are shaken
    label: str = ""  # words of an axis
    symbol: str = ""  # as the file has it; `names` typesets it
    observable: str = ""  # the key of [observe] that asks for it

    def at(self, axis, index):
        """This variable at one value of an axis; itself if it doesn't depend on it."""
        if axis not in self.dims:
            return self
        place = self.dims.index(axis)
        dims = self.dims[:place] + self.dims[place + 1 :]
        return dataclasses.replace(self, values=np.asarray(self.values.take(index, place)), dims=dims)

    def in_order(self, old, new):
        """This variable over axes in another order; itself if it isn't over all of them."""
        if self.dims[: len(old)] != old:
            return self
        places = [old.index(axis) for axis in new] + list(range(len(old), self.values.ndim))
        return dataclasses.replace(self, values=self.values.transpose(places), dims=new + self.dims[len(old) :])


def is_bare_dimension(item):
    """Whether a dataset only stands for a dimension that has no coordinate."""
    return text(item.attrs.get("NAME", "")).startswith("This is a netCDF dimension")


def read_variable(item):
    own = item.name.lstrip("/")
    return Variable(
        own,
        values_of(item),
        dimensions_of(item),
        text(item.attrs.get("long_name", own)),
        text(item.attrs.get("units", "1")),
        text(item.attrs.get("frame", "")),
        plain(text(item.attrs.get("label", ""))),
        text(item.attrs.get("symbol", "")),
        text(item.attrs.get("observable", "")),
    )


def constants_of(names):
    """What a file says of the constants of its scene, by key: units, words and symbol of each."""
    constants = tomllib.loads(names)
    for key, told in constants.items():
        units, words, symbol = (told[name] for name in ("units", "words", "symbol"))
        constants[key] = {"units": plain(units), "words": plain(words), "symbol": symbol}
    return constants


def flag_meanings(item):
    """Meaning of each value of a status or method, e.g. {1: 'aperiodic'}."""
    values = np.atleast_1d(item.attrs.get("flag_values", []))
    return dict(zip((int(value) for value in values), text(item.attrs.get("flag_meanings", "")).split()))
