"""Lists of scenes run by the program, and what it answers."""

import math
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

OBSERVED = "[observe]\nextrema = true\nimpacts = true\nimpact_log = true\nenergy = true\ntrajectory = 3\n"
STEADY = OBSERVED.replace("3", "2") + "period = true\nword = true\nstability = true\n"

LOGGED = ("impact_count", "impact_tau", "impact_stop", "impact_v_")


def keys_of_law(scene, law):
    """Those of a restitution, which may depend on the speed."""
    pre, _, side = law.rpartition("R")
    exponent, below, table = (f"{pre}R_{name}{side}" for name in ("exponent", "below", "of_speed"))
    power = [exponent, f"{pre}R_reference_speed{side}"] if getattr(scene, exponent) else []
    keys = [table] if getattr(scene, table) else [law, *power]
    return keys + ([below] if getattr(scene, below) else [])


def value_of(scene, key):
    value = getattr(scene, key)
    return ", ".join(f"{v!r}: {R!r}" for v, R in value) if isinstance(value, tuple) else value


def keys_of(scene):
    """The values of the keys that a scene's kind of stops and shaking has."""
    keys = "h f nu phase load stiffness x0 v0".split()
    for side in ("_lower", "_upper"):
        if math.isfinite(getattr(scene, "stop" + side)):
            is_soft = math.isfinite(getattr(scene, "stop_stiffness" + side))
            keys += ["stop" + side] + (["stop_stiffness" + side, "stop_damping" + side] if is_soft else [])
            keys += [] if is_soft else keys_of_law(scene, "R" + side)
    keys += scene.keys_of_force()
    optional = "stop_amplitude base_amplitude stop_phase friction friction_static".split()
    keys += [key for key in optional if getattr(scene, key) != 0]
    if scene.loose_mass:
        keys += "loose_mass loose_load loose_x0 loose_v0".split()
        for side in ("_lower", "_upper"):
            is_there = math.isfinite(getattr(scene, "loose" + side))
            keys += ["loose" + side, *keys_of_law(scene, "loose_R" + side)] if is_there else ["loose_R" + side]
    values = {key: value_of(scene, key) for key in keys}
    if "force_table" in values:
        values["force_factor"] = values.pop("f")
    return values


def machine_keys(mass):
    """A function that gives the values of [machine], in SI, of a scene whose numbers are metres and seconds."""

    def keys_of_machine(scene):
        values = keys_of(scene)
        values["damping"] = 2 * mass * values.pop("h")
        force = "force"
        if "force_table" in values:
            force, values["f"] = "force_factor", values["force_factor"]
            values["force_table"] = values["force_table"].replace(", f;", ", force (N);")
        for key, of_scene in ((force, "f"), ("stiffness", "stiffness"), ("load", "load")):
            values[key] = mass * values.pop(of_scene)
        for key in [key for key in values if key.startswith("f_")]:
            values[f"force_{key[2:]}"] = mass * values.pop(key)
        for key in ("stop_stiffness_lower", "stop_stiffness_upper", "friction", "friction_static", "loose_mass"):
            if key in values:
                values[key] *= mass
        values["frequency"] = values.pop("nu") / (2 * math.pi)
        if scene.is_unforced():
            del values["frequency"], values["phase"], values[force]
        return values

    return keys_of_machine


@dataclass
class Runs:
    """What the program answers to a list of scenes: arrays [scene], logs of impacts one after the other."""

    values: dict = field(default_factory=dict)
    logs: list = field(default_factory=list)

    def __getitem__(self, name):
        return self.values[name]


class Program:
    def __init__(self, program, folder):
        self.program, self.folder, self.count = program, Path(folder), 0

    def run(self, scenes, time, observe, *words, section="[scene]\n", keys_of=keys_of):
        """A sweep for each kind of scene, since a key of one kind of stop is refused beside the other kind, and for
        each text, since texts are no axes.

        `section` is that of the scene, and keys_of(scene) the values of the keys that are its axes.
        """
        kinds = {}
        for i, scene in enumerate(scenes):
            values = keys_of(scene)
            texts = tuple((key, value) for key, value in values.items() if isinstance(value, str))
            kinds.setdefault((tuple(key for key in values if not isinstance(values[key], str)), texts), []).append(i)
        runs = Runs(logs=[None] * len(scenes))
        for (keys, texts), points in kinds.items():
            constant = section + "".join(f'{key} = "{value}"\n' for key, value in texts)
            lists = "".join(f"{key} = {numbers([keys_of(scenes[i])[key] for i in points])}\n" for key in keys)
            lists = f"{constant}[sweep]\n{lists}linked = \"{', '.join(keys)}\"\n"
            self.sweep(lists, points, runs, time, observe, *words)
        return runs

    def points(self, sweep, count, time, observe, *words):
        """The results of a sweep of one dimension and so many points."""
        runs = Runs(logs=[None] * count)
        self.sweep(sweep, range(count), runs, time, observe, *words)
        return runs

    def branch(self, scene, limits, keys=""):
        """The arrays of a branch along nu, or of a curve, with further keys of [branch]; None if the scene settles on
        nothing that can be followed."""
        self.count += 1
        name = self.folder / f"{self.count}.toml"
        values = "".join(f"{key} = {value!r}\n" for key, value in keys_of(scene).items())
        branch = f'[branch]\nalong = "nu"\nrange = [{limits[0]!r}, {limits[1]!r}]\nmax_points = 400\n{keys}'
        observe = "[observe]\nextrema = true\nstability = true\n"
        name.write_text(
            f"[scene]\n{values}[time]\nmax_periods = 600\nmax_impacts = 20000\n{observe}{branch}", encoding="utf-8"
        )
        output = name.with_suffix(".h5")
        result = subprocess.run(
            [self.program, "branch", name, "-o", output, "-q"],
            capture_output=True,
            text=True,
            check=False,
            timeout=300,
        )
        if not output.exists():
            if result.returncode not in (1, 2):
                raise RuntimeError(f"{result.returncode}: {result.stderr}")
            return None
        with h5py.File(output) as data:
            found = {key: values[()] for key, values in data.items() if isinstance(values, h5py.Dataset)}
        output.unlink()
        return found

    def sweep(self, sweep, points, runs, time, observe, *words):
        """The results of the only dimension of a sweep, put into `runs` at these points of it."""
        self.count += 1
        name = self.folder / f"{self.count}.toml"
        name.write_text(f"{sweep}[time]\n{time}\n{observe}", encoding="utf-8")
        output = name.with_suffix(".h5")
        command = [self.program, "run", name, "-o", output, "-q", "--set", "time.max_impacts=20000", *words]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if not output.exists():
            raise RuntimeError(f"{result.returncode}: {result.stderr}")
        with h5py.File(output) as data:
            for key, values in data.items():
                if isinstance(values, h5py.Dataset) and values.shape and not key.startswith(LOGGED):
                    if values.shape[0] == len(points) and (values.ndim > 1 or key not in ("sample", "stop")):
                        is_text = values.dtype.kind not in "fiub"
                        empty = np.full((len(runs.logs), *values.shape[1:]), None if is_text else math.nan)
                        kept = runs.values.setdefault(key, empty)
                        kept[list(points)] = values[()]
            if "impact_count" in data:
                columns = [data["impact_" + column][()] for column in ("tau", "stop", "v_before", "v_after")]
                ends = np.cumsum(data["impact_count"][()])
                for point, log in zip(points, np.split(np.column_stack(columns), ends[:-1])):
                    runs.logs[point] = log
        output.unlink()


def numbers(values):
    return "[" + ", ".join(repr(float(x)) for x in values) + "]"


def fastest(log):
    """The speed of the fastest impact of a log on either stop, NaN if there is none."""
    speeds = [np.abs(log[log[:, 1] == side, 2]) for side in (-1, 1)]
    return np.array([found.max() if len(found) else math.nan for found in speeds])


def sizes(runs, kind):
    """The size of displacements or velocities of each motion."""
    return np.maximum(np.abs(runs[kind + "_min"]), np.abs(runs[kind + "_max"]))


def complex_of(runs, i, which):
    return complex(runs["multiplier_re"][i, which], runs["multiplier_im"][i, which])
