"""Lists of scenes run by the program, and what it answers."""

import math
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

OBSERVED = "[observe]\nextrema = true\nimpacts = true\nimpact_log = true\nenergy = true\ntrajectory = 3\n"
STEADY = OBSERVED.replace("3", "2") + "period = true\nword = true\nstability = true\n"


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

    def run(self, scenes, time, observe, *words):
        """A sweep for each kind of scene, since a key of one kind of stop is refused beside the other kind."""
        kinds = {}
        for i, scene in enumerate(scenes):
            kinds.setdefault(tuple(keys_of(scene)), []).append(i)
        runs = Runs(logs=[None] * len(scenes))
        for keys, points in kinds.items():
            self.sweep(keys, [scenes[i] for i in points], points, runs, time, observe, *words)
        return runs

    def branch(self, scene, limits):
        """The arrays of a branch along nu; None if the scene settles on nothing that can be followed."""
        self.count += 1
        name = self.folder / f"{self.count}.toml"
        values = "".join(f"{key} = {getattr(scene, key)!r}\n" for key in keys_of(scene))
        branch = f'[branch]\nalong = "nu"\nrange = [{limits[0]!r}, {limits[1]!r}]\nmax_points = 400\n'
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

    def sweep(self, keys, scenes, points, runs, time, observe, *words):
        self.count += 1
        name = self.folder / f"{self.count}.toml"
        lists = "".join(f"{key} = {numbers([getattr(s, key) for s in scenes])}\n" for key in keys)
        linked = f'linked = "{", ".join(keys)}"\n'
        name.write_text(f"[sweep]\n{lists}{linked}[time]\n{time}\n{observe}", encoding="utf-8")
        output = name.with_suffix(".h5")
        command = [self.program, "run", name, "-o", output, "-q", "--set", "time.max_impacts=20000", *words]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if not output.exists():
            raise RuntimeError(f"{result.returncode}: {result.stderr}")
        with h5py.File(output) as data:
            for key, values in data.items():
                if isinstance(values, h5py.Dataset) and values.shape and not key.startswith("impact_"):
                    if values.shape[0] == len(scenes) and (values.ndim > 1 or key not in ("sample", "stop")):
                        is_text = values.dtype.kind not in "fiub"
                        empty = np.full((len(runs.logs), *values.shape[1:]), None if is_text else math.nan)
                        kept = runs.values.setdefault(key, empty)
                        kept[points] = values[()]
            columns = [data["impact_" + column][()] for column in ("tau", "stop", "v_before", "v_after")]
            ends = np.cumsum(data["impact_count"][()])
            for point, log in zip(points, np.split(np.column_stack(columns), ends[:-1])):
                runs.logs[point] = log
        output.unlink()


def keys_of(scene):
    """The keys that a scene's kind of stops and shaking has."""
    keys = "h f nu phase load stiffness x0 v0".split()
    for side in ("_lower", "_upper"):
        if math.isfinite(getattr(scene, "stop" + side)):
            is_soft = math.isfinite(getattr(scene, "stop_stiffness" + side))
            keys += ["stop" + side] + (["stop_stiffness" + side, "stop_damping" + side] if is_soft else ["R" + side])
    return keys + [key for key in ("stop_amplitude", "base_amplitude") if getattr(scene, key) != 0]


def numbers(values):
    return "[" + ", ".join(repr(float(x)) for x in values) + "]"


def sizes(runs, kind):
    """The size of displacements or velocities of each motion."""
    return np.maximum(np.abs(runs[kind + "_min"]), np.abs(runs[kind + "_max"]))


def complex_of(runs, i, which):
    return complex(runs["multiplier_re"][i, which], runs["multiplier_im"][i, which])
