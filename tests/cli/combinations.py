"""Random scenes of all effects together, run by the program, and relations between the runs that hold in mechanics.

Nothing is shared with the program but its files: its own integrals decide whether one impact of a log follows from the
one before, and everything else is a relation between runs of one motion written in two ways: mirrored, scaled, shifted,
in other units of time, cut in two, alone instead of in a sweep, on another instruction set.

usage: combinations.py [SCENES [SEED]]     (environment: CLATTER, the program)
"""

import itertools
import math
import os
import random
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

INF = math.inf
DURATION = 24.0
OBSERVED = "[observe]\nextrema = true\nimpacts = true\nimpact_log = true\nenergy = true\ntrajectory = 3\n"
STEADY = OBSERVED.replace("3", "2") + "period = true\nword = true\nstability = true\n"


@dataclass
class Scene:
    """A scene in units of its own; stops at infinity aren't there, those of infinite stiffness are rigid."""

    h: float = 0.0
    f: float = 0.0
    nu: float = 1.0
    phase: float = 0.0
    load: float = 0.0
    stiffness: float = 1.0
    stop_lower: float = -INF
    stop_upper: float = INF
    R_lower: float = 1.0
    R_upper: float = 1.0
    x0: float = 0.0
    v0: float = 0.0
    stop_amplitude: float = 0.0
    base_amplitude: float = 0.0
    stop_stiffness_lower: float = INF
    stop_stiffness_upper: float = INF
    stop_damping_lower: float = 0.0
    stop_damping_upper: float = 0.0

    def changed(self, **values):
        return Scene(**{**self.__dict__, **values})

    def mirrored(self):
        def swapped(name):
            return getattr(self, name + "_upper"), getattr(self, name + "_lower")

        changes = {name: 0.0 - getattr(self, name) for name in ("f", "load", "x0", "v0")}
        changes |= {name: -getattr(self, name) for name in ("stop_amplitude", "base_amplitude")}
        changes["stop_lower"], changes["stop_upper"] = -self.stop_upper, -self.stop_lower
        for name in ("R", "stop_stiffness", "stop_damping"):
            changes[name + "_lower"], changes[name + "_upper"] = swapped(name)
        return self.changed(**changes)

    def scaled(self, size):
        names = ("f", "load", "x0", "v0", "stop_lower", "stop_upper", "stop_amplitude", "base_amplitude")
        return self.changed(**{name: size * getattr(self, name) for name in names})

    def shifted(self, place):
        moved = {name: getattr(self, name) + place for name in ("x0", "stop_lower", "stop_upper")}
        return self.changed(load=self.load + self.stiffness * place, **moved)

    def in_time(self, faster):
        """The same motion in units of time that are shorter by so much."""
        changes = {name: getattr(self, name) / faster for name in ("h", "nu", "v0")}
        squares = ("f", "load", "stiffness", "stop_stiffness_lower", "stop_stiffness_upper")
        return self.changed(**changes, **{name: getattr(self, name) / faster**2 for name in squares})

    def is_unforced(self):
        return self.f == 0 and self.stop_amplitude == 0 and self.base_amplitude == 0


def logarithmic(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def drawn(draw):
    """A scene of any effects, also at their ends."""

    def stop():
        if draw.random() < 0.4:
            return 1.0, logarithmic(draw, 1, 1e5), draw.choice([0.0, logarithmic(draw, 1e-3, 1.5)])
        R = draw.choice([draw.uniform(0.1, 0.95), draw.uniform(0.3, 0.9), 0.0, 1.0, 1 - logarithmic(draw, 0.01, 0.1)])
        return R, INF, 0.0

    scene = Scene()
    weak = draw.random() < 0.2  # nearly nothing but the load
    scene.stiffness = draw.choice([1.0, 1.0, logarithmic(draw, 0.1, 10), -logarithmic(draw, 0.01, 0.3), 0.0])
    scene.h = draw.choice([0.0, logarithmic(draw, 1e-3, 0.5), logarithmic(draw, 1e-3, 0.5), draw.uniform(0.5, 2)])
    scene.f = draw.choice([-1, 1]) * draw.choice([1.0, logarithmic(draw, 0.03, 3)])
    scene.nu = logarithmic(draw, 0.3, 3)
    scene.phase = draw.choice([0.0, draw.uniform(-math.pi, math.pi)])
    scene.load = draw.choice([0.0, draw.uniform(-0.5, 0.5), draw.uniform(-2, 2)])
    if weak:
        small = [0.0, 1e-12, 1e-8, 1e-5, 1e-3]
        scene.stiffness, scene.h, scene.f = draw.choice(small), draw.choice(small), draw.choice(small)
        scene.load = draw.choice([-1, 1]) * draw.uniform(0.3, 3)
    gap = logarithmic(draw, 0.2, 3)
    middle = draw.choice([0.0, draw.uniform(-0.5, 0.5)])
    scene.R_lower, scene.stop_stiffness_lower, scene.stop_damping_lower = stop()
    scene.R_upper, scene.stop_stiffness_upper, scene.stop_damping_upper = stop()
    scene.stop_lower, scene.stop_upper = middle - gap / 2, middle + gap / 2
    only = draw.choice(["both", "both", "lower", "upper"])
    if weak:
        only = "lower" if scene.load < 0 else "upper"
    if only == "upper":
        scene.stop_lower, scene.R_lower = -INF, 1.0
        scene.stop_stiffness_lower, scene.stop_damping_lower = INF, 0.0
    if only == "lower":
        scene.stop_upper, scene.R_upper = INF, 1.0
        scene.stop_stiffness_upper, scene.stop_damping_upper = INF, 0.0
    low, high = max(scene.stop_lower, middle - 2), min(scene.stop_upper, middle + 2)
    scene.x0 = draw.choice([draw.uniform(low, high)] * 4 + [low, high])
    if math.isfinite(scene.stop_stiffness_lower) and draw.random() < 0.2:
        scene.x0 = low - draw.uniform(0, 0.2)
    scene.v0 = draw.choice([0.0, draw.uniform(-2, 2), draw.uniform(-2, 2)])
    if not weak and draw.random() < 0.15 and scene.stiffness != 0:
        scene.base_amplitude = draw.uniform(0.1, 0.5)
        scene.f = draw.choice([0.0, scene.f])
    elif not weak and draw.random() < 0.15:
        scene.stop_amplitude = draw.uniform(0.05, 0.3)
    return scene


def random_scenes(count, seed):
    draw = random.Random(seed)
    return [drawn(draw) for _ in range(count)]


def followed_scenes(count, seed):
    """Forced ones, at rest in the ground's frame."""
    draw = random.Random(seed)
    scenes = []
    while len(scenes) < count:
        scene = drawn(draw)
        if abs(scene.f) > 1e-2 and not scene.base_amplitude and not scene.stop_amplitude and scene.h > 1e-3:
            scenes.append(scene)
    return scenes


def weak_scenes():
    """A mass that a load presses on a stop, all else from nothing to as strong as the load; one stop and two."""
    strengths = (0.0, 1e-12, 1e-8, 1e-4, 1e-2, 1.0)
    scenes = []
    for i, (k, h, f) in enumerate(itertools.product(strengths, repeat=3)):
        scene = Scene(stiffness=k, h=h, f=f, nu=(0.7, 1.0, 1.9)[i % 3], load=-1.5, stop_lower=0.0, x0=0.3, v0=-1.0)
        scene.R_lower = scene.R_upper = (0.3, 0.5, 0.7)[i // 3 % 3]
        scenes += [scene, scene.changed(stop_upper=(0.4, 0.31)[i % 2])]
    return [s if math.isfinite(s.stop_upper) else s.changed(R_upper=1.0) for s in scenes]


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
        name.write_text(f"[scene]\n{values}[time]\nmax_periods = 600\n{observe}{branch}", encoding="utf-8")
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


class Campaign:
    """Compares runs of one motion written in two ways."""

    def __init__(self, program, scenes, stream=None):
        self.scenes, self.stream, self.failures = scenes, stream, []
        with tempfile.TemporaryDirectory() as folder:
            self.program = Program(program, folder)
            self.transients()
            self.steady_motions()

    def fail(self, relation, i, text):
        self.failures.append((relation, i, text, self.scenes[i]))

    def transients(self):
        scenes = self.scenes
        time = f'mode = "transient"\nduration = {DURATION}\n'

        def run(scenes, *words, time=time):
            return self.program.run(scenes, time, OBSERVED, *words)

        base = self.base = run(scenes)
        # How much a motion magnifies a change decides how far two runs of it may be apart.
        size = sizes(base, "x") + np.array([abs(s.x0) for s in scenes])
        nudge = 1e-11
        aside = run([s.changed(v0=s.v0 + nudge * (1 if s.v0 >= 0 else -1) * max(1, abs(s.v0))) for s in scenes])
        aside2 = run([s.changed(nu=s.nu * (1 + nudge)) for s in scenes])
        self.steady_count = np.ones(len(scenes), bool)
        grown = np.zeros(len(scenes))
        for other in (aside, aside2):
            self.steady_count &= self.counts(other) == self.counts(base)
            for name in ("x", "v"):
                grown = np.maximum(grown, np.abs(other[name] - base[name]).max(axis=1) / nudge)
                for end in ("_min", "_max"):
                    grown = np.maximum(grown, np.abs(other[name + end] - base[name + end]) / nudge)
        self.allowed = 1e-14 * (1e2 * grown + 30 * size + 30 * sizes(base, "v"))
        self.decided = (base["status"] == 2) & np.isfinite(grown) & (self.allowed < 1e-6 * (1 + size))
        self.say(f"{self.decided.sum()} of {len(scenes)} decided")

        def compare(relation, other, **how):
            self.compare(relation, base, other, **how)

        compare("scalar", run(scenes, "--arch", "scalar"))
        compare("effects", run(scenes, "--set", "integrator.effects=all"))
        compare("mirror", run([s.mirrored() for s in scenes]), mirror=True)
        compare("scale 4", run([s.scaled(4.0) for s in scenes]), size=4.0)
        compare("scale 3", run([s.scaled(3.0) for s in scenes]), size=3.0)
        compare(
            "time",
            run([s.in_time(3.0) for s in scenes], time=time.replace(str(DURATION), str(3 * DURATION))),
            speed=3.0,
        )
        still = [s if s.base_amplitude or s.stop_amplitude else s.shifted(0.75) for s in scenes]
        places = np.array([0.0 if s.base_amplitude or s.stop_amplitude else 0.75 for s in scenes])
        compare("shift", run(still), shift=places)
        self.split(run, base, time)
        self.alone(run, base)
        self.logs(base)
        self.energy(base)

    def say(self, text):
        if self.stream:
            print(text, file=self.stream, flush=True)

    @staticmethod
    def counts(runs):
        return np.array([len(log) for log in runs.logs])

    def compare(self, relation, base, other, mirror=False, size=1.0, speed=1.0, shift=0.0):
        sign = -1.0 if mirror else 1.0
        places = np.broadcast_to(np.asarray(shift), (len(self.scenes),))
        low, high = ("max", "min") if mirror else ("min", "max")

        def check(name, mine, its, scale=1.0):
            off, allowed = np.abs(mine - its), scale * self.allowed
            while off.ndim > 1:
                off = off.max(axis=-1)
            for i in np.flatnonzero(self.decided & ~(off <= allowed)):
                self.fail(relation, i, f"{name} {mine[i]} for {its[i]}, allowed {allowed[i]:.2g}")

        for i in np.flatnonzero(self.decided & (other["status"] != base["status"])):
            self.fail(relation, i, f"status {other['status'][i]} for {base['status'][i]}")
        check("x_min", sign * other["x_" + low] / size - places, base["x_min"])
        check("x_max", sign * other["x_" + high] / size - places, base["x_max"])
        check("v_min", sign * other["v_" + low] * speed / size, base["v_min"])
        check("v_max", sign * other["v_" + high] * speed / size, base["v_max"])
        check("x", sign * other["x"] / size - places[:, None], base["x"])
        check("v", sign * other["v"] * speed / size, base["v"])
        scale = 1 + sizes(base, "v") * (1 + self.counts(base))
        for name in ("work_in", "loss_damping", "loss_impact"):
            if relation == "shift" and name == "work_in":
                continue  # the spring's place counts as load
            its = other[name] * speed**2 / size**2
            if its.ndim == 2 and mirror:
                its = its[:, ::-1]
            check(
                name, its, base[name], 10 * scale + 100 * np.abs(base[name]).reshape(len(self.scenes), -1).max(axis=1)
            )
        for i in np.flatnonzero(self.decided & self.steady_count & (self.counts(other) != self.counts(base))):
            self.fail(relation, i, f"{self.counts(other)[i]} impacts for {self.counts(base)[i]}")

    def split(self, run, base, time):
        """A run cut in two has the states, impacts and extrema of the whole."""
        halves = time.replace(str(DURATION), str(DURATION / 2))
        first = run(self.scenes, time=halves)
        theirs = [
            s.changed(
                x0=first["x"][i, -1],
                v0=first["v"][i, -1],
                phase=math.remainder(s.phase + s.nu * DURATION / 2, 2 * math.pi),
            )
            for i, s in enumerate(self.scenes)
        ]
        usable = [
            i for i, s in enumerate(self.scenes) if self.decided[i] and not s.base_amplitude and not s.stop_amplitude
        ]
        if not usable:
            return
        second = run([theirs[i] for i in usable], time=halves)
        for j, i in enumerate(usable):
            allowed = 1e2 * self.allowed[i]
            for name in ("x", "v"):
                if not abs(second[name][j, -1] - base[name][i, -1]) <= allowed:
                    self.fail(
                        "split", i, f"{name} {second[name][j, -1]} for {base[name][i, -1]}, allowed {allowed:.2g}"
                    )
                for end, of in (("_min", min), ("_max", max)):
                    both = of(first[name + end][i], second[name + end][j])
                    if not abs(both - base[name + end][i]) <= allowed:
                        self.fail("split", i, f"{name + end} {both} for {base[name + end][i]}, allowed {allowed:.2g}")
            forced = not self.scenes[i].is_unforced()  # else the height at which a chatter is summed is of the start
            both = len(first.logs[i]) + len(second.logs[j])
            in_contact = is_beyond_soft(theirs[i]) or first["rest_fraction"][i].sum() > 0
            if forced and self.steady_count[i] and not in_contact and both != len(base.logs[i]):
                self.fail("split", i, f"{both} impacts for {len(base.logs[i])}")

    def alone(self, run, base):
        """A point alone has the bytes of the point in a sweep."""
        for i in range(0, len(self.scenes), max(1, len(self.scenes) // 20)):
            one = run([self.scenes[i]])
            for name in ("x_min", "x_max", "v_min", "v_max", "work_in", "x", "v"):
                if not np.array_equal(one[name][0], base[name][i], equal_nan=True):
                    self.fail("alone", i, f"{name} {one[name][0]} for {base[name][i]}")
            if not np.array_equal(one.logs[0], base.logs[i], equal_nan=True):
                self.fail("alone", i, "another log")

    def steady_motions(self):
        """Each periodic motion comes back to its state, by the impacts and with the derivative that are told of it."""
        settle = 'mode = "steady"\nmax_periods = 600\n'
        runs = self.program.run(self.scenes, settle, STEADY)
        periodic = [
            i
            for i in range(len(self.scenes))
            if runs["status"][i] in (0, 3)
            and not self.scenes[i].is_unforced()
            and not self.scenes[i].base_amplitude
            and not self.scenes[i].stop_amplitude
        ]
        self.say(f"{len(periodic)} periodic")
        starts, periods = [], []
        for i in periodic:
            starts.append(self.scenes[i].changed(x0=runs["x"][i, 0], v0=runs["v"][i, 0]))
            periods.append(runs["period"][i])
        for j, i in enumerate(periodic):
            s, log, period = self.scenes[i], runs.logs[i], periods[j]
            turns = period * s.nu / (2 * math.pi)
            if math.isnan(period) and runs["v_min"][i] == runs["v_max"][i] == 0:
                continue  # it stands still
            n = round(turns) if math.isfinite(turns) else 0
            if not (n >= 1 and abs(turns - n) < 1e-9 * n):
                self.fail("period", i, f"{turns} forcing periods, status {runs['status'][i]}")
                continue
            rests = runs["rest_fraction"][i].sum() > 0
            soft = math.isfinite(s.stop_stiffness_lower) or math.isfinite(s.stop_stiffness_upper)
            self.minimal(i, log, n, period)
            if not rests and not soft:
                self.closes(i, s, log, period)
            if runs["status"][i] == 3:
                self.grazes(i, s, log, runs)
                continue
            if not rests and not soft:
                of = {-1: s.R_lower, 1: s.R_upper}
                expected = math.exp(-2 * s.h * period) * math.prod(of[side] ** 2 for side in log[:, 1])
                product = complex_of(runs, i, 0) * complex_of(runs, i, 1)
                if not abs(product - expected) <= 1e-9 * expected + 1e-14:
                    self.fail("multipliers", i, f"product {product} for {expected}")
            self.returns(i, starts[j], period, runs, n)

    def minimal(self, i, log, n, period):
        """No part of the period repeats the motion already."""
        for m in range(1, n):
            if n % m or len(log) == 0 or len(log) * m % n:
                continue
            shift = len(log) * m // n
            later = np.roll(log, -shift, axis=0)
            off = np.abs((later[:, 0] - log[:, 0] - m * period / n + period / 2) % period - period / 2)
            if shift and np.all(off < 1e-7 * period) and np.all(np.abs(later[:, 1:3] - log[:, 1:3]) < 1e-7):
                self.fail("period", i, f"{n} forcing periods, but the motion repeats after {m}")
                return

    def closes(self, i, s, log, period):
        for row, (time, side, _, after) in enumerate(log):
            then = log[(row + 1) % len(log)]
            time_then = then[0] + (period if row + 1 == len(log) else 0)
            stop, next_stop = ((s.stop_upper if b > 0 else s.stop_lower) for b in (side, then[1]))
            there = flown(s, time, stop, after, time_then - time)
            off = abs(there[0] - next_stop) + abs(there[1] - then[2])
            if not off <= 1e-8 * (1 + abs(next_stop) + abs(then[2])):
                self.fail("log", i, f"row {row + 1} of {len(log)}: {there} for {next_stop}, {then[2]}")
                return

    def grazes(self, i, s, log, runs):
        slowest = np.abs(log[:, 2]).min() if len(log) else math.inf
        sides = set(log[:, 1]) if len(log) else set()
        gaps = [
            abs(stop - runs["x" + end][i])
            for stop, end, side in ((s.stop_lower, "_min", -1), (s.stop_upper, "_max", 1))
            if math.isfinite(stop) and side not in sides
        ]
        if slowest > 1e-3 and not any(gap < 1e-6 for gap in gaps) and len(log) < 3:
            self.fail("grazing", i, f"the slowest impact has the speed {slowest}")

    def returns(self, i, start, period, runs, n):
        """The state comes back after a period, and its neighbours as the multipliers say."""
        step = 1e-6
        nearby = [
            start,
            start.changed(x0=start.x0 + step),
            start.changed(v0=start.v0 + step),
            start.changed(x0=start.x0 - step),
            start.changed(v0=start.v0 - step),
        ]
        inside = all(s.stop_lower < s.x0 < s.stop_upper or is_beyond_soft(s) for s in nearby)
        time = f'mode = "transient"\nduration = {float(period)!r}\n'
        runs_of = self.program.run(nearby if inside else [start], time, OBSERVED)
        ends = np.column_stack([runs_of["x"][:, -1], runs_of["v"][:, -1]])
        begin = np.array([start.x0, start.v0])
        multipliers = [complex_of(runs, i, 0), complex_of(runs, i, 1)]
        size = 1 + np.abs(begin).max()
        rests = runs["rest_fraction"][i].sum() > 0
        derivative = np.column_stack([(ends[1] - ends[3]), (ends[2] - ends[4])]) / (2 * step) if inside else None
        growth = 1 + (np.abs(derivative).max() if inside and not rests else 1e3)
        # a repeat is found to 1e-12 of the state
        if not np.abs(ends[0] - begin).max() <= 1e-10 * size * growth:
            self.fail("return", i, f"{begin} comes to {ends[0]}")
        if not inside or rests or not np.isfinite(multipliers).all():
            return
        same = all(len(log) == len(runs_of.logs[0]) for log in runs_of.logs)
        forward = np.column_stack([(ends[1] - ends[0]), (ends[2] - ends[0])]) / step
        curved = np.abs(forward - derivative).max()
        if not same or curved > 1e-3 * (1 + np.abs(derivative).max()):
            return
        trace, expected = np.trace(derivative), sum(multipliers)
        if not abs(trace - expected) <= 1e-2 * curved + 1e-6 * growth:
            self.fail("derivative", i, f"trace {trace}, multipliers {multipliers}")

    def energy(self, base):
        """Finite motion has finite energies, and they balance."""
        for i in np.flatnonzero(base["status"] == 2):
            residual = base["energy_residual"][i]
            size = max(
                abs(base["work_in"][i]),
                base["loss_damping"][i],
                base["loss_impact"][i].max(),
                sizes(base, "v")[i] ** 2,
                sizes(base, "x")[i] ** 2,
            )
            if not abs(residual) <= 1e-10 * size + 1e-12:
                self.fail("energy", i, f"residual {residual} of {size}")

    def logs(self, base):
        """Each impact of rigid stops at rest follows from the one before, by closed forms of our own."""
        for i in np.flatnonzero(base["status"] == 2):
            s, log = self.scenes[i], base.logs[i]
            soft = math.isfinite(s.stop_stiffness_lower) or math.isfinite(s.stop_stiffness_upper)
            if soft or s.stop_amplitude or s.base_amplitude or len(log) == 0:
                continue
            tau, x, v = 0.0, s.x0, s.v0
            if x == s.stop_lower:
                v = max(v, -s.R_lower * v)  # the impact at the beginning isn't logged
            if x == s.stop_upper:
                v = min(v, -s.R_upper * v)
            for time, side, before, after in log[:40]:
                stop, R = (s.stop_upper, s.R_upper) if side > 0 else (s.stop_lower, s.R_lower)
                held = v == 0 and x in (s.stop_lower, s.stop_upper)  # it may have rested in between
                there = flown(s, tau, x, v, time - tau)
                off = abs(there[0] - stop) + abs(there[1] - before)
                if not held and not off <= 1e-9 * (1 + abs(stop) + abs(before)):
                    self.fail("log", i, f"impact at {time}: {there} for {stop}, {before}")
                    break
                if not abs(after + R * before) <= 1e-15 * abs(before):
                    self.fail("log", i, f"impact at {time}: {after} after {before}")
                    break
                # a slow rebound may be the one after which a chatter is summed
                if abs(after) < 1e-5:
                    break
                tau, x, v = time, stop, after
            else:
                # after the last impact the mass flies to the end of the run, unless it rebounds too low to be told
                low = after**2 / 2 < 1e-10 * (abs(s.f) + abs(s.load) + abs(s.stiffness * stop)) if len(log) else True
                if not low and len(log) <= 40:
                    there = flown(s, tau, x, v, DURATION - tau)
                    off = abs(there[0] - base["x"][i, -1]) + abs(there[1] - base["v"][i, -1])
                    if not off <= 1e-8 * (1 + abs(there[0]) + abs(there[1])):
                        self.fail("log", i, f"{there} at the end for {base['x'][i, -1]}, {base['v'][i, -1]}")


class BranchCampaign:
    """Follows branches of random scenes along nu, and runs their points again."""

    def __init__(self, program, scenes, stream=None):
        self.scenes, self.stream, self.failures, self.points = scenes, stream, [], 0
        self.ended = {}
        with tempfile.TemporaryDirectory() as folder:
            self.program = Program(program, folder)
            for i, scene in enumerate(scenes):
                self.follow(i, scene)

    def fail(self, relation, i, text):
        self.failures.append((relation, i, text, self.scenes[i]))

    def follow(self, i, scene):
        found = self.program.branch(scene, [0.7 * scene.nu, 1.4 * scene.nu])
        if found is None:
            return  # the scene settles on nothing that can be followed
        names = [text.decode() for text in found["special_kind"]]
        for number in range(int(found["branch"].max(initial=-1)) + 1):
            on = found["branch"] == number
            special = [
                (names[k], found["special_nu"][k]) for k, of in enumerate(found["special_branch"]) if number in of
            ]
            self.turns(i, number, found["nu"][on], special)
            self.crosses(i, number, found["nu"][on], found["multiplier_re"][on], found["multiplier_im"][on], special)
        self.twice(i, found)
        self.run_again(i, scene, found)

    def turns(self, i, number, nu, special):
        """Where the parameter turns round there is a fold, or the branch is born."""
        steps = np.diff(nu)
        for k in np.flatnonzero(steps[:-1] * steps[1:] < 0):
            near = 2 * (abs(steps[k]) + abs(steps[k + 1]))
            kinds = ("fold", "flip", "symmetry breaking", "graze", "chatter limit")
            if not any(kind in kinds and abs(at - nu[k + 1]) <= near for kind, at in special):
                self.fail("turns", i, f"branch {number} at nu = {nu[k + 1]}: {special}")

    def crosses(self, i, number, nu, real, imaginary, special):
        """Where a multiplier passes -1 there is a flip or a loss of symmetry."""
        plain = np.all(imaginary == 0, axis=1) & np.all(np.isfinite(real), axis=1)
        least = real.min(axis=1)
        for k in range(len(nu) - 1):
            if not (plain[k] and plain[k + 1]) or (least[k] < -1) == (least[k + 1] < -1):
                continue
            if max(abs(least[k]), abs(least[k + 1])) > 1.5:
                continue  # a graze in between
            low, high = sorted((nu[k], nu[k + 1]))
            if not any(
                kind in ("flip", "symmetry breaking", "graze", "chatter limit") and low - 1e-6 <= at <= high + 1e-6
                for kind, at in special
            ):
                self.fail("crosses", i, f"branch {number} at nu = {low} ... {high}: {special}")

    def twice(self, i, found):
        """No motion is on two branches, but where they meet."""
        state = np.column_stack([found["nu"], found["x"], found["v"], found["period_ratio"]])
        middle = found["nu"] * 0
        for number in range(int(found["branch"].max(initial=-1)) + 1):
            on = np.flatnonzero(found["branch"] == number)
            middle[on[len(on) // 2]] = 1
        for k in np.flatnonzero(middle):
            others = found["branch"] != found["branch"][k]
            if others.any() and (found["branch"] == found["branch"][k]).sum() > 10:
                off = np.abs(state[others] - state[k]).max(axis=1).min()
                if off < 1e-9:
                    self.fail("twice", i, f"a point of branch {found['branch'][k]} at nu = {found['nu'][k]}")

    def run_again(self, i, scene, found):
        """Points of branches are motions: they come back after their period, in units of time in which that is 2 pi."""
        for ratio in np.unique(found["period_ratio"]):
            if ratio != round(ratio):
                continue
            of = np.flatnonzero((found["period_ratio"] == ratio) & np.isfinite(found["x"]))
            of = of[:: max(1, len(of) // 20)]
            scenes = [
                scene.changed(nu=found["nu"][k], x0=found["x"][k], v0=found["v"][k], phase=0.0).in_time(found["nu"][k])
                for k in of
            ]
            inside = [k for k, s in enumerate(scenes) if s.stop_lower < s.x0 < s.stop_upper or is_beyond_soft(s)]
            if not inside:
                continue
            time = f'mode = "transient"\nduration = {2 * math.pi * ratio!r}\n'
            runs = self.program.run([scenes[k] for k in inside], time, OBSERVED)
            for row, k in enumerate(inside):
                s, point = scenes[k], of[k]
                growth = 1 + np.abs(found["multiplier_re"][point]).max() + np.abs(found["multiplier_im"][point]).max()
                if not growth < 1e3:
                    continue
                self.points += 1
                off = max(abs(runs["x"][row, -1] - s.x0), abs(runs["v"][row, -1] - s.v0))
                extrema = max(abs(runs["x_" + end][row] - found["x_" + end][point]) for end in ("min", "max"))
                allowed = 1e-7 * growth * (1 + abs(s.x0) + abs(s.v0))
                if not (off <= allowed and extrema <= allowed):
                    self.fail(
                        "run",
                        i,
                        f"branch {found['branch'][point]} at nu = {found['nu'][point]}: off by {off}, "
                        f"extrema by {extrema}",
                    )


def complex_of(runs, i, which):
    return complex(runs["multiplier_re"][i, which], runs["multiplier_im"][i, which])


def is_beyond_soft(s):
    return x_beyond(s.x0, s.stop_lower, s.stop_stiffness_lower, -1) or x_beyond(
        s.x0, s.stop_upper, s.stop_stiffness_upper, 1
    )


def x_beyond(x, stop, stiffness, sign):
    return math.isfinite(stiffness) and sign * (x - stop) >= 0


def flown(s, tau, x, v, time):
    """Displacement and velocity after a free flight, by its Taylor series in steps."""
    rate = max(1.0, math.sqrt(abs(s.stiffness)), 2 * s.h, s.nu)
    steps = max(1, math.ceil(4 * rate * time))
    step = time / steps
    for n in range(steps):
        theta = s.nu * (tau + n * step) + s.phase
        terms = [x, v]
        force = s.f
        for k in range(24):
            forced = force * (math.sin(theta), math.cos(theta), -math.sin(theta), -math.cos(theta))[k % 4]
            constant = s.load if k == 0 else 0.0
            # terms[k] is the k-th derivative
            terms.append(constant + forced - 2 * s.h * terms[k + 1] - s.stiffness * terms[k])
            force *= s.nu
        x = sum(term * step**k / math.factorial(k) for k, term in enumerate(terms))
        v = sum(term * step ** (k - 1) / math.factorial(k - 1) for k, term in enumerate(terms) if k)
    return x, v


def report(failures):
    kinds, lines = {}, []
    for relation, i, text, scene in failures:
        kinds.setdefault(relation, []).append((i, text, scene))
    for relation, found in kinds.items():
        lines.append(f"{relation}: {len({i for i, _, _ in found})} scenes")
        lines += [f"  {i}: {text}\n    {scene}" for i, text, scene in found[:4]]
    return "\n".join(lines)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    if len(sys.argv) > 3:
        campaign = BranchCampaign(os.environ["CLATTER"], followed_scenes(count, seed), sys.stdout)
        print(f"{campaign.points} points run again")
        print(report(campaign.failures))
        sys.exit(bool(campaign.failures))
    failed = False
    for first in range(0, count, 250):
        scenes = random_scenes(min(250, count - first), seed + first // 250)
        campaign = Campaign(os.environ["CLATTER"], scenes, sys.stdout)
        print(report(campaign.failures), flush=True)
        failed = failed or bool(campaign.failures)
    sys.exit(failed)


if __name__ == "__main__":
    main()
