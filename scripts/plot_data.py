"""Reads what `clatter run` or `clatter accuracy` wrote: variables with named dimensions, and the scene behind them."""

import re
import tomllib
from dataclasses import dataclass

import h5py
import numpy as np

from plain_hdf5 import UNREADABLE, FileProblem, damaged, open_output, printable, text

PAPER = "10.5755/j02.mech.32277"
APERIODIC = 1  # status of motion without a period
FIRST_FAILURE = 16  # status values from here on are failures


@dataclass
class Variable:
    """One variable of the file; `dims` are the names of its dimensions, slowest first."""

    name: str
    values: np.ndarray
    dims: tuple
    long_name: str
    units: str


class Output:
    """A whole output file in memory."""

    def __init__(self, path):
        self.path = path
        try:
            self.read(path)
        except UNREADABLE as error:
            raise damaged(path, error) from None
        self.axes = tuple(name for name in self["status"].dims if name != "row")
        self.scene = self.config.get("scene", {})

    def read(self, path):
        with open_output(path) as file:
            if "shard" in file.attrs:
                shard = printable(file.attrs["shard"])
                raise FileProblem(f"{path}: shard {shard} of a sweep; join all with 'clatter merge' first")
            self.title = text(file.attrs.get("title", ""))
            self.source = text(file.attrs.get("source", ""))
            self.config = tomllib.loads(text(file.attrs["config"]))
            self.variables = {name: read_variable(item) for name, item in file.items() if not is_bare_dimension(item)}
            self.meanings = flag_meanings(file["status"])
            self.methods = flag_meanings(file["method"]) if "method" in file else {}

    def __contains__(self, name):
        return name in self.variables

    def __getitem__(self, name):
        return self.variables[name]

    def values(self, name):
        return self.variables[name].values

    @property
    def shape(self):
        """Points along each axis of the sweep."""
        return self.values("status").shape[: len(self.axes)]

    @property
    def is_accuracy(self):
        """Whether this is an output of `clatter accuracy`: rows of methods at every point of the sweep."""
        return "method" in self and "ns_per_period" in self

    @property
    def figure(self):
        """Number of the paper's figure that this file is, or None."""
        match = re.search(r"\bFig\.\s*(\d+)\s*$", self.source)
        return int(match.group(1)) if match and PAPER in self.source and not self.is_accuracy else None

    @property
    def follow(self):
        """Axis along which each point started from the end of the one before, or ''."""
        followed = self.config.get("sweep", {}).get("follow", "")
        return followed if followed in self.axes else ""

    def swept(self, name):
        """Whether a variable is an input of the sweep (an axis, or linked to one) and not a result."""
        return name in self.axes or name in self.config.get("sweep", {})

    def results(self):
        """Names of the variables that have a value for each point, in the order of the file."""
        return [
            name
            for name, variable in self.variables.items()
            if variable.dims[: len(self.axes)] == self.axes and variable.dims != (name,) and not self.swept(name)
        ]

    def parameter(self, key, default=np.nan):
        """A scene key at every point: its coordinate where it is swept, else its constant."""
        if self.swept(key):
            variable = self[key]
            place = self.axes.index(variable.dims[0])
            along = [-1 if axis == place else 1 for axis in range(len(self.axes))]
            return np.broadcast_to(variable.values.reshape(along), self.shape)
        return np.full(self.shape, float(self.scene.get(key, default)))

    def stops(self):
        """Lower and upper stop at every point; infinite where there is none."""
        if "xs" in self.scene or self.swept("xs"):
            gap = np.abs(self.parameter("xs"))
            return -gap, gap
        return self.parameter("stop_lower", -np.inf), self.parameter("stop_upper", np.inf)

    def impacts(self, index):
        """Times, stops, velocities before and after of one point's observed impacts."""
        counts = self.values("impact_count")
        flat = np.ravel_multi_index(index, counts.shape) if index else 0
        first = int(np.sum(counts.ravel()[:flat]))
        part = slice(first, first + int(counts.ravel()[flat]))
        return tuple(self.values(f"impact_{name}")[part] for name in ("tau", "stop", "v_before", "v_after"))


def is_bare_dimension(item):
    """Whether a dataset only stands for a dimension that has no coordinate."""
    return text(item.attrs.get("NAME", "")).startswith("This is a netCDF dimension")


def read_variable(item):
    scales = [dim[0].name.lstrip("/") if len(dim) else f"dim{place}" for place, dim in enumerate(item.dims)]
    name = item.name.lstrip("/")
    dims = (name,) if h5py.h5ds.is_scale(item.id) else tuple(scales)
    return Variable(
        name,
        item[()] if item.shape else np.asarray(item[()]),
        dims,
        text(item.attrs.get("long_name", name)),
        text(item.attrs.get("units", "1")),
    )


def flag_meanings(item):
    """Meaning of each value of a status or method, e.g. {1: 'aperiodic'}."""
    values = np.atleast_1d(item.attrs.get("flag_values", []))
    return dict(zip((int(value) for value in values), text(item.attrs.get("flag_meanings", "")).split()))
