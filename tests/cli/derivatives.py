"""Derivatives of results by keys of the scene, as the program tells them, and relations that they satisfy."""

import math
import os
import tempfile
import unittest

import numpy as np
from force_scenes import ORDERS
from restitution_scenes import SPEEDS
from scene_runs import STEADY, Program, keys_of

CLATTER = os.environ["CLATTER"]
STARTS = {"x0", "v0", "phase", "loose_x0", "loose_v0"}
TEXTS = {"force_shape", "force_table"}
SETTLE = 'mode = "steady"\nmax_periods = 600\n'
PERIODIC = 0  # the status
SIDES = (-2, -1, 1, 2)

# powers of length, time and mass; all that isn't here is a number
LEVELS = ("friction", "friction_static", "loose_friction", "loose_friction_static")
OF_SCENE = {"h": (0, -1), "nu": (0, -1), "stiffness": (0, -2)}
OF_SCENE |= dict.fromkeys(("f", "force_factor", "load", *LEVELS, "loose_load"), (1, -2))
OF_SCENE |= dict.fromkeys((f"f_{j}" for j in ORDERS), (1, -2))
OF_MACHINE = {
    "damping": (0, -1, 1),
    "frequency": (0, -1, 0),
    **dict.fromkeys(("force", "force_factor", "load", *LEVELS), (1, -2, 1)),
    **dict.fromkeys((f"force_{j}" for j in ORDERS), (1, -2, 1)),
    "stiffness": (0, -2, 1),
    **dict.fromkeys(("mass", "loose_mass"), (0, 0, 1)),
    "loose_load": (1, -2, 0),
}
LENGTHS = ("stop_lower", "stop_upper", "stop_amplitude", "base_amplitude", "loose_gap", "loose_lower", "loose_upper")
STIFFNESSES = ("stop_stiffness_lower", "stop_stiffness_upper")
RESULTS = {
    "x_min": (1, 0, 0),
    "x_max": (1, 0, 0),
    "period": (0, 1, 0),
    "impact_speed": (1, -1, 0),
    "impact_power": (2, -3, 1),
}
RESULTS_IN_HOUSING = {**RESULTS, **dict.fromkeys(("y_min", "y_max", "z_min", "z_max"), (1, 0, 0))}


def powers_of(key, of_section):
    if key in LENGTHS:
        return (1, 0, 0)
    if key in SPEEDS:
        return (1, -1, 0)
    if key in STIFFNESSES:
        return (0, -2, 1)
    return of_section.get(key, (0, 0, 0))


def derivative(runs, result, key):
    return runs[f"d_{result}_d_{key}"]


def by_each(function, values):
    """The derivatives of a function by its arguments, by complex steps: exact to rounding."""
    step = 1e-200
    return {
        key: function(**{**values, key: value + step * 1j}).imag / step for key, value in values.items()
    }  # fmt: skip


class Family:
    """Scenes with the same keys, and the derivatives by all of them."""

    def __init__(self, program, scenes, section="[scene]\n", of_section=keys_of, time=SETTLE, observe=""):
        self.values = [of_section(scene) for scene in scenes]
        self.keys = [key for key in self.values[0] if key not in STARTS | TEXTS]
        if section.startswith("[machine]"):
            self.keys.append("mass")
        if "friction" in self.keys:
            observe += "word_sticks = true\n"
        wanted = f'{STEADY}{observe}sensitivity = "{", ".join(self.keys)}"\n'
        self.runs = program.run(scenes, time, wanted, section=section, keys_of=of_section)

    def __len__(self):
        return len(self.values)


def families(scenes, of_section=keys_of):
    kinds = {}
    for scene in scenes:
        kinds.setdefault(tuple(of_section(scene)), []).append(scene)
    return kinds.values()


class OfScenes(unittest.TestCase):
    """Tests of random scenes; every failure names its scene."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.program = Program(CLATTER, scratch.name)
        self.compared, self.worst = 0, 0.0
        self.failures, self.unknown = [], []

    def check(self, off, allowed, text):
        self.compared += 1
        self.worst = max(self.worst, off / allowed)
        if not off <= allowed:
            self.failures.append(f"{text}: off by {off:.3g}, {allowed:.3g} allowed")

    def told(self):
        return "\n".join(self.failures[:12])

    def check_scaling(self, family, scenes, of_section, mass, results=RESULTS):
        """If the unit of a quantity changes, keys and results change by its powers; so do their derivatives."""
        for i, values in enumerate(family.values):
            if family.runs["status"][i] != PERIODIC or math.isnan(family.runs["period"][i]):
                continue
            values = {**values, "mass": mass}
            for result, of_result in results.items():
                found = np.atleast_1d(family.runs[result][i])
                for unit in range(3 if mass else 2):
                    terms = np.zeros((len(family.keys), len(found)))
                    for row, key in enumerate(family.keys):
                        weight = (*powers_of(key, of_section), 0)[unit] * values[key]
                        if weight:
                            terms[row] = weight * derivative(family.runs, result, key)[i]
                    expected = of_result[unit] * found
                    size = np.abs(terms).sum(axis=0) + np.abs(expected)
                    text = f"{result} in units of {('length', 'time', 'mass')[unit]}, {scenes[i]}"
                    for own, off, scale in zip(found, np.abs(terms.sum(axis=0) - expected), size):
                        if math.isnan(off) and not math.isnan(own):
                            self.unknown.append(text)
                        elif not math.isnan(own):
                            self.check(off, 1e-8 * scale + 1e-13, text)

    def compare_differences(self, runs, i, key, sides, j, step, scene, results=RESULTS, part=0.05):
        """How many derivatives the differences confirm to 1e-5 or better, within a part of those of two steps."""
        same = all(same_motion(side, j, runs, i) for side in sides.values())
        contraction = 1 - abs(complex(runs["multiplier_re"][i, 0], runs["multiplier_im"][i, 0]))
        if not same or not contraction > 1e-3:
            return 0
        sharp = 0
        for result in results:
            at = {side: np.atleast_1d(run[result][j]) for side, run in sides.items()}
            near, far = (at[1] - at[-1]) / (2 * step), (at[2] - at[-2]) / (4 * step)
            told, noise = np.atleast_1d(derivative(runs, result, key)[i]), 1e-11 * np.abs(at[1]) / contraction / step
            for own, one, other, rounding in zip(told, near, far, noise):
                if math.isnan(one) or math.isnan(other):
                    continue
                if abs(one - other) > 1e-3 * abs(one) + rounding:
                    continue  # too long a step for motion so near a fold
                allowed = part * abs(one - other) + rounding + 1e-12 / step
                self.check(abs(own - (4 * one - other) / 3), allowed, f"{result} by {key}, {scene}")
                sharp += allowed < 1e-5 * abs(own)
        return sharp

    def compare_limits(self, here, beside, keys, name, results, shared):
        """How many derivatives by keys are the limits of those one and two steps beside.

        `shared` has for each scene the extrema that several impacts may share: any may be the farthest a step on.
        """
        known = 0
        for i, extrema in enumerate(shared):
            contraction = 1 - abs(complex(here["multiplier_re"][i, 0], here["multiplier_im"][i, 0]))
            if not all(same_motion(here, i, there, i) for there in beside) or not contraction > 1e-2:
                continue
            for result in results:
                at, *others = (np.atleast_1d(run[result][i]) for run in (here, *beside))
                if not all(np.allclose(at, other, rtol=1e-4, atol=1e-6, equal_nan=True) for other in others):
                    continue  # another motion
                if at[0] in extrema:
                    continue
                for by in keys:
                    known += self.compare_limit([derivative(run, result, by)[i] for run in (here, *beside)], by, name)
        return known

    def compare_limit(self, derivatives, by, name):
        """How many of the sides of a result have the derivative that those beside tend to."""
        known = 0
        for told, one, two in zip(*map(np.atleast_1d, derivatives)):
            if math.isnan(one) or math.isnan(two) or not abs(two - one) < 1e-2 * (1 + abs(one)):
                continue  # none, or beside a fold
            allowed = 1e-6 * (1 + abs(one)) + abs(two - one)
            self.check(abs(told - (2 * one - two)), allowed, f"{name}: by {by}, {told}, {one}, {two}")
            known += 1
        return known


def same_motion(some, j, others, i):
    """Whether two periodic motions have the same events; of those whose word is cut off that isn't known."""
    return (
        some["status"][j] == PERIODIC
        and not others["impact_word"][i].decode().endswith("…")
        and some["impact_word"][j] == others["impact_word"][i]
        and abs(some["period_ratio"][j] - others["period_ratio"][i]) < 1e-9
    )
