"""Derivatives of periodic motion by keys of the scene: `observe.sensitivity`.

They satisfy what the units of length, time and mass demand of them (Euler's theorem on homogeneous functions), and are
the limits of differences of runs. Scenes are random; CLATTER_SENSITIVITY is COUNT or COUNT:SEED of them.
"""

import math
import os
import random
import tempfile
import unittest

import numpy as np
from random_scenes import compliant_scenes, pressing_scenes, random_scenes, rubbed
from scene_runs import STEADY, Program, keys_of, machine_keys

CLATTER = os.environ["CLATTER"]
COUNT, _, SEED = os.environ.get("CLATTER_SENSITIVITY", "150").partition(":")
COUNT, SEED = int(COUNT), int(SEED or 461)

STARTS = {"x0", "v0", "phase"}
SETTLE = 'mode = "steady"\nmax_periods = 600\n'
PERIODIC = 0  # the status
SIDES = (-2, -1, 1, 2)

# powers of length, time and mass; all that isn't here is a number
OF_SCENE = {"h": (0, -1), "nu": (0, -1), "stiffness": (0, -2)}
OF_SCENE |= dict.fromkeys(("f", "load", "friction", "friction_static"), (1, -2))
OF_MACHINE = {
    "damping": (0, -1, 1),
    "frequency": (0, -1, 0),
    **dict.fromkeys(("force", "load", "friction", "friction_static"), (1, -2, 1)),
    "stiffness": (0, -2, 1),
    "mass": (0, 0, 1),
}
LENGTHS = ("stop_lower", "stop_upper", "stop_amplitude", "base_amplitude")
STIFFNESSES = ("stop_stiffness_lower", "stop_stiffness_upper")
RESULTS = {
    "x_min": (1, 0, 0),
    "x_max": (1, 0, 0),
    "period": (0, 1, 0),
    "impact_speed": (1, -1, 0),
    "impact_power": (2, -3, 1),
}


def powers_of(key, of_section):
    if key in LENGTHS:
        return (1, 0, 0)
    if key in STIFFNESSES:
        return (0, -2, 1)
    return of_section.get(key, (0, 0, 0))


def derivative(runs, result, key):
    return runs[f"d_{result}_d_{key}"]


class Family:
    """Scenes with the same keys, and the derivatives by all of them."""

    def __init__(self, program, scenes, section="[scene]\n", of_section=keys_of, time=SETTLE, observe=""):
        self.values = [of_section(scene) for scene in scenes]
        self.keys = [key for key in self.values[0] if key not in STARTS]
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


def drawn(count, seed):
    """Forced scenes of any effects, some that rest, some between soft stops; a third with dry friction."""
    draw = random.Random(f"friction {seed}")
    scenes = random_scenes(count, seed) + pressing_scenes(count // 6, seed) + compliant_scenes(count // 6, seed)
    scenes = [rubbed(draw, scene) if draw.random() < 0.33 else scene for scene in scenes]
    return [scene for scene in scenes if not scene.is_unforced() and abs(scene.f) >= 0.02]


class OfRandomScenes(unittest.TestCase):
    """Every failure names its scene."""

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

    def check_scaling(self, family, scenes, of_section, mass):
        """If the unit of a quantity changes, keys and results change by its powers; so do their derivatives."""
        for i, values in enumerate(family.values):
            if family.runs["status"][i] != PERIODIC or math.isnan(family.runs["period"][i]):
                continue
            values = {**values, "mass": mass}
            for result, of_result in RESULTS.items():
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

    def test_the_units_of_length_time_and_mass_may_change(self):
        for scenes in families(drawn(COUNT, SEED)):
            self.check_scaling(Family(self.program, scenes), scenes, OF_SCENE, 0)
            if any(scene.base_amplitude or scene.stop_amplitude for scene in scenes):
                absolute = Family(self.program, scenes, observe='frame = "absolute"\n')
                self.check_scaling(absolute, scenes, OF_SCENE, 0)
        mass = 0.3
        for scenes in families(drawn(COUNT // 3, SEED + 1), machine_keys(mass)):
            family = Family(self.program, scenes, f"[machine]\nmass = {mass}\n", machine_keys(mass))
            self.check_scaling(family, scenes, OF_MACHINE, mass)
        self.assertEqual(self.told(), "")
        self.assertGreater(self.compared, 8 * COUNT)
        springless = [text for text in self.unknown if "stiffness=0.0," in text]  # free to drift without impacts
        self.assertEqual([text for text in self.unknown if text not in springless], [])
        self.assertLess(len(springless), 0.1 * self.compared)

    def test_they_are_the_limits_of_differences(self):
        """By one key of each scene, from runs that begin on the motion itself; to four orders in the step."""
        sharp = rough = 0
        for n, scenes in enumerate(families(drawn(COUNT, SEED + 2))):
            frame = 'frame = "absolute"\n' if scenes[0].base_amplitude or scenes[0].stop_amplitude else ""
            family = Family(self.program, scenes, observe=frame)
            key = family.keys[n % len(family.keys)]
            found = [i for i in range(len(scenes)) if family.runs["status"][i] == PERIODIC]
            found = [i for i in found if not math.isnan(family.runs["period"][i])]
            starts = [started(scenes[i], family.runs["x"][i, 0], family.runs["v"][i, 0], frame) for i in found]
            steps = [1e-4 * max(0.05, abs(getattr(scene, key))) for scene in starts]
            moved = [[moved_by(s, key, side * d) for side in SIDES] for s, d in zip(starts, steps)]
            kept = [j for j in range(len(found)) if all(map(permitted, moved[j]))]
            if not kept:
                continue
            observe = STEADY + frame + ("word_sticks = true\n" if scenes[0].friction else "")
            sides = {
                side: self.program.run(
                    [moved[j][n] for j in kept], SETTLE, observe, keys_of=lambda s: keys_of_kind(s, starts[0])
                )
                for n, side in enumerate(SIDES)
            }
            for n, j in enumerate(kept):
                i = found[j]
                by_it = self.compare_differences(family.runs, i, key, sides, n, steps[j], scenes[i])
                sharp += by_it
                rough += by_it if scenes[i].friction else 0
        self.assertEqual(self.told(), "")
        self.assertGreater(sharp, COUNT // 2)
        self.assertGreater(rough, COUNT // 8)

    def test_friction_that_begins(self):
        """Derivatives by the friction at 0, by differences to one side of it."""
        scenes = [scene for scene in drawn(COUNT, SEED + 3) if not scene.stop_amplitude and not scene.friction]
        wanted = STEADY + 'sensitivity = "friction"\n'
        runs, sharp = self.program.run(scenes, SETTLE, wanted), 0
        found = [i for i in range(len(scenes)) if runs["status"][i] == PERIODIC and not math.isnan(runs["period"][i])]
        starts = [started(scenes[i], runs["x"][i, 0], runs["v"][i, 0], "") for i in found]
        steps = [1e-5 * max(0.05, abs(scene.f)) for scene in starts]
        some = [
            self.program.run([s.changed(friction=n * d) for s, d in zip(starts, steps)], SETTLE, STEADY)
            for n in (1, 2, 4)
        ]
        for j, i in enumerate(found):
            sharp += self.compare_begun(runs, i, some, j, steps[j], scenes[i])
        self.assertEqual(self.told(), "")
        self.assertGreater(sharp, COUNT // 4)

    def compare_begun(self, runs, i, some, j, step, scene):
        """How many derivatives the differences to one side confirm."""
        contraction = 1 - abs(complex(runs["multiplier_re"][i, 0], runs["multiplier_im"][i, 0]))
        if not contraction > 1e-2 or not all(same_motion(run, j, runs, i) for run in some):
            return 0
        confirmed = 0
        for result in RESULTS:
            zero, *at = [np.atleast_1d(run[result][k]) for run, k in [(runs, i)] + [(run, j) for run in some]]
            told = np.atleast_1d(derivative(runs, result, "friction")[i])
            slopes = [(value - zero) / (n * step) for n, value in zip((1, 2, 4), at)]
            near, far = 2 * slopes[0] - slopes[1], 2 * slopes[1] - slopes[2]
            for own, one, other, size in zip(told, near, far, np.abs(zero)):
                rounding = 1e-10 * (size + 1e-3) / contraction / step
                if math.isnan(one) or math.isnan(other) or abs(one - other) > 1e-2 * abs(one) + rounding:
                    continue
                allowed = 2 * abs(one - other) + rounding
                self.check(abs(own - one), allowed, f"{result} by friction at 0, {scene}")
                confirmed += allowed < 1e-3 * abs(own)
        return confirmed

    def compare_differences(self, runs, i, key, sides, j, step, scene):
        """How many derivatives the differences confirm to 1e-5 or better."""
        same = all(same_motion(side, j, runs, i) for side in sides.values())
        contraction = 1 - abs(complex(runs["multiplier_re"][i, 0], runs["multiplier_im"][i, 0]))
        if not same or not contraction > 1e-3:
            return 0
        sharp = 0
        for result in RESULTS:
            at = {side: np.atleast_1d(run[result][j]) for side, run in sides.items()}
            near, far = (at[1] - at[-1]) / (2 * step), (at[2] - at[-2]) / (4 * step)
            told, noise = np.atleast_1d(derivative(runs, result, key)[i]), 1e-11 * np.abs(at[1]) / contraction / step
            for own, one, other, rounding in zip(told, near, far, noise):
                if math.isnan(one) or math.isnan(other) or (key == "stiffness" and scene.stiffness == 0):
                    continue
                if abs(one - other) > 1e-3 * abs(one) + rounding:
                    continue  # too long a step for motion so near a fold
                allowed = 0.05 * abs(one - other) + rounding + 1e-12 / step
                self.check(abs(own - (4 * one - other) / 3), allowed, f"{result} by {key}, {scene}")
                sharp += allowed < 1e-5 * abs(own)
        return sharp


def same_motion(some, j, others, i):
    """Whether two periodic motions have the same events; of those whose word is cut off that isn't known."""
    return (
        some["status"][j] == PERIODIC
        and not others["impact_word"][i].decode().endswith("…")
        and some["impact_word"][j] == others["impact_word"][i]
        and abs(some["period_ratio"][j] - others["period_ratio"][i]) < 1e-9
    )


def moved_by(scene, key, step):
    return within_stops(scene.changed(**{key: getattr(scene, key) + step}))


def permitted(scene):
    sides = ("_lower", "_upper")
    numbers = [getattr(scene, name + side) for name in ("stop_damping",) for side in sides] + [scene.h]
    R = [getattr(scene, "R" + side) for side in sides]
    below = 0 < scene.friction_static < scene.friction
    return all(number >= 0 for number in numbers) and all(0 <= number <= 1 for number in R) and not below


def started(scene, x, v, frame):
    """The scene from a state at its forcing phase, which is absolute if a frame is asked for."""
    amplitude, angle = scene.base_amplitude + scene.stop_amplitude, scene.phase + scene.stop_phase
    if frame:
        x, v = x - amplitude * math.sin(angle), v - amplitude * scene.nu * math.cos(angle)
    return within_stops(scene.changed(x0=x, v0=v))


def within_stops(scene):
    """The same scene, its start on a rigid stop that has moved over it."""
    low = scene.stop_lower if math.isinf(scene.stop_stiffness_lower) else -math.inf
    high = scene.stop_upper if math.isinf(scene.stop_stiffness_upper) else math.inf
    return scene.changed(x0=min(max(scene.x0, low), high))


def keys_of_kind(scene, first):
    """The keys of the first scene of a kind, also where a step leaves 0."""
    return {key: getattr(scene, key) for key in keys_of(first)}


if __name__ == "__main__":
    unittest.main()
