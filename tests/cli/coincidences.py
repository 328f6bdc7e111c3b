"""What is told of one periodic motion by two runs, and its differences; scenes written as configurations.

The relations themselves are in starts_on_contacts.py, keys_at_zero.py and branch_sets.py.
"""

import math
from dataclasses import dataclass, field
from functools import partial
from itertools import permutations

import numpy as np
import scene_runs
from random_scenes import Scene
from scene_runs import machine_keys, sizes

SETTLE = 'mode = "steady"\nmax_periods = 600\n'
IN_LANES = "[observe]\nextrema = true\nimpacts = true\nperiod = true\nword = true\nstability = true\n"  # lanes do these
ALL = IN_LANES + "energy = true\nimpact_log = true\ntrajectory = 2\n"

PERIODIC = 0
CONTRACTS = 0.95  # motion with greater multipliers isn't found to many digits from another start

# They belong to a start, not to the motion: when it is found, and which impact of the period comes first. And keys.
OF_A_START = "impact impact_phase impact_total simulated_periods settling_estimate".split()
OF_A_START += "v_before v_after velocity_ratio tau x v z w".split()
KEYS = {*Scene.__dataclass_fields__, "damping", "force", "frequency"}


@dataclass
class Way:
    """A way to write a scene: sections, keys, and what the numbers of the file are multiples of."""

    section: str = "[scene]\n"
    keys_of: object = scene_runs.keys_of
    mass: float = 1.0

    @staticmethod
    def machine(mass):
        return Way(f"[machine]\nmass = {mass!r}\n", machine_keys(mass), mass)

    def configuration(self, scene, observe, words=()):
        """A file that `clatter run` takes."""
        values = "".join(f"{key} = {value!r}\n" for key, value in self.keys_of(scene).items())
        how = f"# clatter run FILE --set time.max_impacts=20000 {' '.join(words)}\n"
        return f"{how}{self.section}{values}[time]\n{SETTLE}{observe}"


@dataclass
class Failure:
    relation: str
    scene: int
    text: str
    configuration: str


@dataclass
class Failures:
    """Differences that were found; `compared` counts the motions that were looked at."""

    compared: int = 0
    all: list = field(default_factory=list)

    def add(self, relation, i, text, configuration):
        self.all.append(Failure(relation, i, text, configuration))

    def report(self, shown=3):
        """Of each relation so many scenes, each with what differs and a configuration of its own."""
        lines = []
        for relation in dict.fromkeys(failure.relation for failure in self.all):
            of_scenes = {}
            for failure in self.all:
                if failure.relation == relation:
                    of_scenes.setdefault(failure.scene, []).append(failure)
            lines.append(f"== {relation}: {len(of_scenes)} scenes differ")
            for i, found in list(of_scenes.items())[:shown]:
                lines += [f"-- scene {i}", *(f"   {failure.text}" for failure in found[:6]), found[0].configuration]
        return "\n".join(lines)


def run(program, scenes, observe, *words, way=Way()):
    return program.run(scenes, SETTLE, observe, *words, section=way.section, keys_of=way.keys_of)


def contracts(runs, i):
    """Whether a motion is periodic, and found to rounding from any start near it."""
    if runs["status"][i] != PERIODIC:
        return False
    sizes_of_all = np.abs(multipliers(runs, i))
    return len(sizes_of_all) > 0 and bool(sizes_of_all.max() < CONTRACTS)


def multipliers(runs, i):
    values = runs["multiplier_re"][i] + 1j * runs["multiplier_im"][i]
    return values[np.isfinite(runs["multiplier_re"][i])]


def multipliers_apart(mine, its):
    """How far two sets of multipliers are apart, in any order; their symmetric functions are sharp, they aren't."""
    if len(mine) != len(its):
        return math.inf
    if len(mine) == 2:
        return max(abs(sum(mine) - sum(its)), abs(np.prod(mine) - np.prod(its)))
    return min((np.max(np.abs(np.array(order) - its), initial=0) for order in permutations(mine)), default=0.0)


def differences(runs, i, reference, j, scale=lambda name: 1.0, allowed=1e-7):
    """What is told of point i that isn't told of point j of a reference, one line each."""
    told = []
    size = 1 + sizes(reference, "x")[j] + sizes(reference, "v")[j]
    rests = np.nansum(reference["rest_fraction"][j]) > 0
    for name, its in reference.values.items():
        if name in OF_A_START or name in KEYS or name not in runs.values or name.startswith("multiplier"):
            continue
        if rests and name == "impacts_per_period":
            continue  # how many impacts of a chatter are taken is no property of it
        mine, its = runs[name][i], its[j]
        if isinstance(its, (bytes, str)) or its is None:
            if mine != its:
                told.append(f"{name} {mine} for {its}")
            continue
        mine, its = np.asarray(mine, float) / scale(name), np.asarray(its, float)
        same = (mine == its) | (np.isnan(mine) & np.isnan(its))
        off = np.abs(np.where(same, 0.0, mine) - np.where(same, 0.0, its))
        if not np.all(off <= allowed * (size**2 + np.where(same, 0.0, np.abs(its)))):
            told.append(f"{name} {mine} for {its}")
    apart = multipliers_apart(multipliers(runs, i), multipliers(reference, j))
    if not apart <= 100 * allowed * size:
        told.append(f"multipliers {multipliers(runs, i)} for {multipliers(reference, j)}")
    return told


def log_differences(log, reference, rests, size, allowed=1e-7):
    """The same of the impacts of a period, begun at any of them; rests take as many impacts as they like."""
    if rests:
        return []
    if len(log) != len(reference):
        return [f"{len(log)} impacts in the log for {len(reference)}"]
    if len(log) == 0:
        return []
    mine, its = log[:, 1:], reference[:, 1:]  # a contact with a soft stop that the period cuts has no velocity after
    off = min(np.nanmax(np.abs(np.roll(mine, k, axis=0) - its)) for k in range(len(mine)))
    return [] if off <= allowed * size else [f"impacts {mine.tolist()} for {its.tolist()}"]


def of_seed(text, count, seed):
    """COUNT or COUNT:SEED, as the environment gives it."""
    number, _, chosen = (text or str(count)).partition(":")
    return int(number), int(chosen or seed)


machine = partial(Way.machine, 0.37)
