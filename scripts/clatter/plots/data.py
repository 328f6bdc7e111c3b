"""Reads what `clatter run` or `clatter accuracy` wrote: variables with named dimensions, and the scene behind them."""

import copy
import dataclasses
import re

import numpy as np

from .variables import constants_of, flag_meanings, is_bare_dimension, read_variable, tomllib
from ..hdf5_files import FileProblem, UNREADABLE, damaged, open_output, printable, text

PAPER = "10.5755/j02.mech.32277"
ORIGIN = ("clatter_version", "git_commit", "compiler", "source", "config_sha256", "instruction_set")  # attributes
APERIODIC = 1  # status of motion without a period
UNDECIDED = 4  # status of motion whose period rounding would decide
CREEPING = 5  # status of a mass that comes ever closer to where dry friction holds it
GRAZING = 3  # status of periodic motion without multipliers, since it just touches a stop
FIRST_FAILURE = 16  # status values from here on have no results
ESCAPED = 19  # of them, the one that is no failure: nothing brings the mass back
SOFT_STOPS = ("stop_stiffness_lower", "stop_stiffness_upper")
SI_WORDS = {"tau": "t", "xs": "gap"}  # of long names, in [machine]
SHAKEN = ("stop_amplitude", "base_amplitude")
OWN_AMPLITUDES = ("stop_amplitude_lower", "stop_amplitude_upper")  # of stops that move by themselves
LOGGED = ("impact",)  # dimensions of the log
WALL = 2  # |impact_stop| of a wall of a loose mass whose main mass has stops or friction of its own
STARTS = ("x0", "v0", "phase", "start_period", "loose_x0", "loose_v0")  # keys that say where motion begins
PHASE = "impact_phase"  # of the log, the result that has a diagram of its own


class Output:
    """A whole output file in memory."""

    def __init__(self, path):
        self.path = path
        try:
            self.read(path)
        except UNREADABLE as error:
            raise damaged(path, error) from None
        self.axes = () if self.is_branch else tuple(name for name in self["status"].dims if name != "row")
        self.is_si = "machine" in self.config
        self.scene, self.units = numbers_of(self.config.get("machine" if self.is_si else "scene", {}))
        self.sweep = self.config.get("sweep", {})
        if self.is_branch:
            branch = self.config["branch"]
            self.sweep = {
                branch[key]: branch.get(f"{key}_range", branch["range"]) for key in ("along", "across") if key in branch
            }
        self.held = {}  # axes at one value each
        self.is_scattered = False  # a dot for each point is asked for
        self.left_out = set()  # axes without their infinite values
        for name, words in self.names_of_results().items():
            if name in self:
                self.variables[name] = dataclasses.replace(self[name], long_name=words)

    def read(self, path):
        with open_output(path) as file:
            if "shard" in file.attrs:
                shard = printable(file.attrs["shard"])
                raise FileProblem(f"{path}: shard {shard} of a sweep; join all with 'clatter merge' first")
            self.title = text(file.attrs.get("title", ""))
            self.source = text(file.attrs.get("source", ""))
            self.config_text = text(file.attrs["config"])
            self.config = tomllib.loads(self.config_text)
            self.constants = constants_of(text(file.attrs.get("scene_names", "")))
            if not self.constants:  # in files before 0.3.0
                self.constants = {key: {} for key in self.config.get("machine", self.config.get("scene", {}))}
            self.sampled = text(file.attrs.get("sampled_axes", "")).split()
            self.origin = {key: printable(text(file.attrs[key])) for key in ORIGIN if key in file.attrs}
            self.variables = {name: read_variable(item) for name, item in file.items() if not is_bare_dimension(item)}
            self.meanings = flag_meanings(file["status"]) if "status" in file else {}
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
        return () if self.is_branch else self.values("status").shape[: len(self.axes)]

    @property
    def is_accuracy(self):
        """Whether `clatter accuracy` wrote this file: rows of methods at every point of the sweep."""
        return "method" in self and "ns_per_period" in self

    @property
    def is_branch(self):
        """Whether `clatter branch` wrote this file: branches of periodic motion, and no points of a sweep."""
        return "arclength" in self

    @property
    def figure(self):
        """Number of the paper's figure that this file is, or None."""
        match = re.search(r"\bFig\.\s*(\d+)\s*$", self.source)
        return int(match.group(1)) if match and PAPER in self.source and not self.is_accuracy else None

    @property
    def follow(self):
        """Axis along which each point started from the end of the one before, whichever of its linked keys names it, or
        ''."""
        names = [] if self.is_branch else [name.strip() for name in self.sweep.get("follow", "").split(",")]
        axes = [self[name].dims[0] for name in names if name in self and self[name].dims]
        return next((axis for axis in axes if axis in self.axes), "")

    @property
    def is_cloud(self):
        """Whether the only axis stands for several that are sampled together, so that no curve runs along it."""
        return self.is_scattered or sum(self[name].dims == tuple(self.axes) for name in self.sampled) > 1

    @property
    def goes_down(self):
        """Whether the followed axis was run from its end to its beginning."""
        return self.held.get("direction", 1 if self.sweep.get("direction", "up") == "up" else -1) < 0

    def swept(self, name):
        """Whether a variable is an input of the sweep (an axis, or linked to one) and not a result."""
        return name in self.axes or name in self.sweep

    def results(self):
        """Names of the variables that have values for each point, in the order of the file."""
        return [
            name
            for name, variable in self.variables.items()
            if variable.dims[: len(self.axes)] == self.axes
            and variable.dims != (name,)
            and not self.swept(name)
            and not name.startswith("motion_")
        ]

    def at(self, axis, index):
        """This output at one value of an axis, which it then has no more."""
        part = copy.copy(self)
        part.held = {**self.held, axis: self.values(axis)[index].item()}
        linked = [name for name in self.sweep if name in self and self[name].dims == (axis,)]
        constants = {name: self.values(name)[index].item() for name in (axis, *linked)}
        part.scene = {**self.scene, **constants}
        part.units = {**self.units, **{name: self[name].units for name in constants}}
        part.sweep = {key: value for key, value in self.sweep.items() if key not in constants}
        part.axes = tuple(name for name in self.axes if name != axis)
        part.variables = {
            name: variable.at(axis, index) for name, variable in self.variables.items() if name not in constants
        }
        if "impact_count" in self:
            points = np.arange(self.values("status").size).reshape(self.shape)
            part.keep_impacts(self, points.take(index, self.axes.index(axis)))
        return part

    def in_order(self, axes):
        """This output with its axes in another order."""
        if axes == self.axes:
            return self
        part = copy.copy(self)
        part.axes = axes
        part.variables = {name: variable.in_order(self.axes, axes) for name, variable in self.variables.items()}
        if "impact_count" in self:
            points = np.arange(self.values("status").size).reshape(self.shape)
            part.keep_impacts(self, points.transpose([self.axes.index(axis) for axis in axes]))
        return part

    def in_increasing_order(self):
        """This output with the values of its only axis sorted, unless they are a path that the sweep followed."""
        if len(self.axes) != 1 or self.follow or (np.diff(self.values(self.axes[0])) >= 0).all():
            return self
        return self.picked(self.axes[0], np.argsort(self.values(self.axes[0]), kind="stable"))

    def without_infinite_values(self):
        """This output without its points at infinite values of an axis, for which a picture over it has no place."""
        part = self
        for axis in self.axes:
            finite = np.isfinite(self.values(axis))
            if not finite.any():
                part = part.at(axis, 0)
            elif not finite.all():
                part = part.picked(axis, np.flatnonzero(finite))
                part.left_out = {*part.left_out, axis}
        return part

    def picked(self, axis, indexes):
        """This output at these values of an axis, in this order."""
        part = copy.copy(self)
        part.variables = {
            name: dataclasses.replace(variable.at(axis, indexes), dims=variable.dims)
            for name, variable in self.variables.items()
        }
        if "impact_count" in self:
            points = np.arange(self.values("status").size).reshape(self.shape)
            part.keep_impacts(self, points.take(indexes, self.axes.index(axis)))
        return part

    def keep_impacts(self, whole, points):
        """Keeps the impacts of these points of a whole output, in their order."""
        counts, points = whole.values("impact_count").ravel(), points.ravel()
        first, kept = np.cumsum(counts) - counts, counts[points]
        rows = np.repeat(first[points] - (np.cumsum(kept) - kept), kept) + np.arange(kept.sum())
        for name, variable in whole.variables.items():
            if variable.dims == LOGGED:
                self.variables[name] = dataclasses.replace(variable, values=variable.values[rows])

    def parameter(self, key, default=np.nan):
        """A scene key at every point: its coordinate if it is swept, else its constant; of branches, their start's."""
        if self.swept(key) and not self.is_branch:
            variable = self[key]
            place = self.axes.index(variable.dims[0])
            along = [-1 if axis == place else 1 for axis in range(len(self.axes))]
            return np.broadcast_to(variable.values.reshape(along), self.shape)
        return np.full(self.shape, float(self.scene.get(key, default)))

    def stops(self):
        """Lower and upper stop at every point; infinite if there is none."""
        for both in ("xs", "gap"):
            if both in self.scene or self.swept(both):
                gap = np.abs(self.parameter(both))
                return -gap, gap
        return self.parameter("stop_lower", -np.inf), self.parameter("stop_upper", np.inf)

    @property
    def is_absolute(self):
        """Whether displacements and velocities are those on the ground, where stops or base are shaken."""
        return any(variable.frame == "absolute" for variable in self.variables.values())

    def reach(self):
        """The farthest places of the lower and the upper stop at every point, in the frame of the displacements."""
        own = (np.abs(self.parameter(key, 0.0)) for key in OWN_AMPLITUDES)
        lower, upper = (stop + sign * moved for stop, sign, moved in zip(self.stops(), (-1, 1), own))
        if not self.is_absolute:
            return lower, upper
        moved = sum(np.abs(self.parameter(key, 0.0)) for key in SHAKEN)
        return lower - moved, upper + moved

    @property
    def stops_move(self):
        """Whether a stop moves by itself at any point, in the frame of the displacements."""
        return any(np.any(self.parameter(key, 0.0)) for key in OWN_AMPLITUDES)

    def soft_stops(self):
        """Whether the lower and the upper stop are soft, at every point."""
        both = self.parameter("stop_stiffness", np.inf)
        own = (self.parameter(key) for key in SOFT_STOPS)
        return tuple(np.isfinite(np.where(np.isnan(stiffness), both, stiffness)) for stiffness in own)

    def is_forced(self):
        """Whether a force, or stops or a base that are shaken, drive the mass at any point."""
        return any(
            np.any(self.parameter(key, 0.0)) for key in ("force" if self.is_si else "f", *SHAKEN, *OWN_AMPLITUDES)
        )

    @property
    def is_transient(self):
        """Whether the motion was observed from its start."""
        return self.config.get("time", {}).get("mode") == "transient"

    def names_of_results(self):
        """The long names of results that depend on the scene: what counts forcing periods where there are none, in
        transients and free motion, and in SI what names time or gap."""
        long_names = {name: variable.long_name for name, variable in self.variables.items()}
        for word, own in SI_WORDS.items() if self.is_si else ():
            long_names = {name: re.sub(rf"\b{word}\b", own, text) for name, text in long_names.items()}
        names = {name: text for name, text in long_names.items() if text != self[name].long_name}
        if self.is_branch or self.is_accuracy:
            return names
        if self.is_transient:
            names["impacts_per_period"] = "impacts in the observed time"
        elif not self.is_forced():
            names["impacts_per_period"] = "impacts per period of the motion"
        if not self.is_forced():
            names["simulated_periods"] = "turns of 2 pi simulated"
            names["settling_estimate"] = "turns of 2 pi until within the tolerance of the steady motion"
        return names

    def forcing_period(self, index):
        """The forcing period of a point; without a force what stands for it, a share of the observed time."""
        if not self.is_forced():
            return self.values("tau")[index][-1] / self.config.get("time", {}).get("window", 64)
        if self.is_si:
            return 1 / float(self.parameter("frequency", 1.0)[index])
        return 2 * np.pi / float(self.parameter("nu", 1.0)[index])

    @property
    def has_loose_mass(self):
        """Whether the main mass carries a loose one."""
        return "loose_mass" in self.scene or self.swept("loose_mass")

    @property
    def is_of_walls(self):
        """Whether impacts are those of a loose mass, whose main mass has neither stops nor friction of its own."""
        levels = [self.parameter(key, 0.0) for key in ("friction", "friction_static")]
        return self.has_loose_mass and not (np.isfinite(self.stops()).any() or np.nan_to_num(levels).any())

    def walls(self):
        """Lower and upper wall of the loose mass in its housing at every point; infinite if there is none."""
        if "loose_gap" in self.scene or self.swept("loose_gap"):
            gap = self.parameter("loose_gap")
            return -gap, gap
        return self.parameter("loose_lower", -np.inf), self.parameter("loose_upper", np.inf)

    def has_stop(self, side, result=""):
        """Whether any point has a stop, or a wall, of which a result is, on this side: -1 lower, 1 upper."""
        places = self.walls() if self.is_of_walls or result.startswith("wall_") else self.stops()
        return bool(np.isfinite(places[0 if side < 0 else 1]).any())

    def stop_name(self, side, result=""):
        """The stop, or wall, on a side, of which a result is: -1, -2 lower, 1, 2 upper; 2 is a wall beside stops."""
        is_wall = self.is_of_walls or abs(side) == WALL or result.startswith("wall_")
        return f"{'lower' if side < 0 else 'upper'} {'wall' if is_wall else 'stop'}"

    def wall_impacts(self, index):
        """The same as `impacts` of the loose mass alone."""
        impacts = self.impacts(index)
        on_wall = np.full(impacts[1].shape, True) if self.is_of_walls else np.abs(impacts[1]) == WALL
        return tuple(np.asarray(part)[on_wall] for part in impacts)

    def impacts(self, index):
        """Times, stops, velocities before and after of one point's observed impacts."""
        counts = self.values("impact_count")
        flat = np.ravel_multi_index(index, counts.shape) if index else 0
        first = int(np.sum(counts.ravel()[:flat]))
        part = slice(first, first + int(counts.ravel()[flat]))
        return tuple(self.values(f"impact_{name}")[part] for name in ("tau", "stop", "v_before", "v_after"))


def numbers_of(scene):
    """The constants of a scene as numbers, and the units of those that are written with one."""
    numbers, units = dict(scene), {}
    for key, value in scene.items():
        written = re.fullmatch(r"\s*(\S+)\s+(.+)", value) if isinstance(value, str) else None
        if written:
            numbers[key], units[key] = float(written[1]), re.sub(r"\s*/\s*(\w+)", r" \1-1", written[2])
    return numbers, units


def lacks_period(status):
    """Whether the motion of each point has no period that is known."""
    return np.isin(status, (APERIODIC, UNDECIDED))


def has_failed(status):
    """Whether each point failed, so that nothing is known of its motion."""
    return (np.asarray(status) >= FIRST_FAILURE) & (np.asarray(status) != ESCAPED)
