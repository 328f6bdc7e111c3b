"""Derivatives of periodic motion with a loose mass by keys of the scene, `observe.sensitivity`.

They are those of closed forms, the limits of differences of runs, and what units, a mirror and other models demand.
Environment: CLATTER, the program; CLATTER_SENSITIVITY, COUNT or COUNT:SEED of random scenes.
"""

import cmath
import math
import os
import random
import unittest

import numpy as np

from derivatives import OF_MACHINE, OF_SCENE, PERIODIC, RESULTS_IN_HOUSING, SETTLE, SIDES, STARTS, Family, OfScenes
from derivatives import by_each, derivative, families
from force_scenes import SHAPES, Force
from loose_mass_relations_test import mirrored
from loose_mass_test import ATTRACTING, LooseMass, symmetric
from random_scenes import logarithmic
from scene_runs import STEADY

COUNT, _, SEED = os.environ.get("CLATTER_SENSITIVITY", "60").partition(":")
COUNT, SEED = int(COUNT), int(SEED or 977)
EXTREMA = ("x_min", "x_max", "y_min", "y_max", "z_min", "z_max")


def carrying(draw):
    """A scene that may chatter, be pressed for a while or for good, have one wall, or be shaken by its base."""
    scene = {
        "h": draw.choice([logarithmic(draw, 0.01, 0.4), 1.3]),
        "stiffness": draw.choice([1.0, draw.uniform(0.5, 2)]),
    }
    scene |= {"f": draw.choice([-1, 1]) * draw.uniform(0.3, 1), "nu": draw.choice([1.0, draw.uniform(0.5, 1.7)])}
    scene |= {"phase": draw.uniform(0, 6), "load": draw.uniform(-0.2, 0.2), "x0": 0.1, "v0": draw.uniform(-0.5, 0.5)}
    scene |= {"loose_mass": logarithmic(draw, 1e-3, 2), "loose_R": draw.choice([0.0, draw.uniform(0.2, 0.9)])}
    scene |= {"loose_load": draw.choice([0.0, draw.uniform(-0.1, 0.1), -0.4]), "loose_lower": -draw.uniform(0.2, 0.8)}
    if scene["loose_load"] != -0.4 or draw.random() < 0.5:
        scene["loose_upper"] = draw.uniform(0.2, 0.8)
    if draw.random() < 0.35:
        scene |= {"base_amplitude": draw.choice([0.0, 0.3]), "stop_phase": draw.choice([0.0, 1.1])}
    return scene | {"loose_x0": 0.0, "loose_v0": draw.uniform(-0.5, 0.5)}


def drawn(count, seed):
    draw = random.Random(seed)
    return [carrying(draw) for _ in range(count)]


def values_of(scene):
    return scene


def machine_of(mass):
    """A function that gives the values of [machine], in SI, of a scene whose numbers are metres and seconds."""

    def machine(scene):
        values = dict(scene)
        values["damping"], values["frequency"] = 2 * mass * values.pop("h"), values.pop("nu") / (2 * math.pi)
        for key, of_scene in (("force", "f"), ("stiffness", "stiffness"), ("load", "load"), ("loose_mass",) * 2):
            values[key] = mass * values.pop(of_scene)
        return values

    return machine


def framed(scenes, n):
    return 'frame = "absolute"\n' if "base_amplitude" in scenes[0] and n % 2 else ""


def unshaken(scene, **changes):
    return {"base_amplitude": 0.0, "stop_phase": 0.0, **scene, "base_amplitude": 0.0, **changes}


def carried(scene):
    """Damped so that both masses, while a wall presses the loose one, move aperiodically to the limit."""
    stiffness, ratio = 0.64, 0.5625
    return {**scene, "stiffness": stiffness, "loose_mass": ratio, "h": math.sqrt(stiffness * (1 + ratio))}


# By name: a scene at a value at which a formula branches, the key that has it, and the sides to which it may change
SPECIAL = {
    "no damping": (lambda s: {**s, "h": 0.0}, "h", (1,)),
    "critical damping": (lambda s: {**s, "h": 0.5, "stiffness": 0.25}, "h", (-1, 1)),
    "critical spring": (lambda s: {**s, "h": 0.5, "stiffness": 0.25}, "stiffness", (-1, 1)),
    "critical press": (carried, "h", (-1, 1)),
    "base at rest": (unshaken, "base_amplitude", (-1, 1)),
    "base at rest, out of phase": (lambda s: unshaken(s, stop_phase=2.0), "base_amplitude", (-1, 1)),
    "base in phase": (lambda s: unshaken(s, base_amplitude=-0.3), "stop_phase", (-1, 1)),
    "base in phase, undamped": (lambda s: unshaken(s, base_amplitude=0.3, h=0.0), "h", (1,)),
    "no force beside a base": (lambda s: unshaken(s, base_amplitude=0.3, f=0.0), "f", (-1, 1)),
    "no load": (lambda s: {**s, "load": 0.0, "loose_load": 0.0}, "loose_load", (-1, 1)),
    "plastic walls": (lambda s: {**s, "loose_R": 0.0}, "loose_R", (1,)),
}


class AtSpecialValues(OfScenes):
    def test_derivatives_where_a_formula_branches_are_those_beside(self):
        known = {}
        for n, (name, (prepared, key, sides)) in enumerate(SPECIAL.items()):
            draw = random.Random(f"{SEED} {name}")
            scenes = [scene for scene in map(prepared, drawn(COUNT // 4, SEED + 10 + n))]
            scenes = [scene for scene in scenes if "loose_upper" in scene or scene["loose_load"] < 0]
            ways = [1e-9 * draw.choice(sides) for _ in scenes]
            known[name] = sum(self.compare(some, key, name) for some in kinds(scenes, ways, key))
        self.assertEqual(self.told(), "")
        self.assertEqual({name: count for name, count in known.items() if count < 8}, {})

    def compare(self, groups, key, name):
        keys = sorted({own for own in groups[0][0] if own not in STARTS} | {key})
        wanted = f'{STEADY}{framed(groups[0], 1)}sensitivity = "{", ".join(keys)}"\n'
        here, *beside = (self.program.run(some, SETTLE, wanted, keys_of=values_of) for some in groups)
        return self.compare_limits(here, beside, keys, name, RESULTS_IN_HOUSING, [()] * len(groups[0]))


def kinds(scenes, ways, key):
    """Scenes of equal keys, and those one and two steps beside them."""
    for kind in families(list(zip(scenes, ways)), lambda pair: pair[0]):
        yield [[{**scene, key: scene[key] + n * way} for scene, way in kind] for n in (0, 1, 2)]


class OfRandomScenes(OfScenes):
    drawn = staticmethod(drawn)
    machine_of = staticmethod(machine_of)
    of_machine = OF_MACHINE
    unconfirmed = 0  # keys that no difference confirms, at most
    part = 0.05  # of the difference of two steps that four orders leave at most

    def test_the_units_of_length_time_and_mass_may_change(self):
        for n, scenes in enumerate(families(self.drawn(COUNT, SEED), values_of)):
            family = Family(self.program, scenes, of_section=values_of, observe=framed(scenes, n))
            self.check_scaling(family, scenes, OF_SCENE, 0, RESULTS_IN_HOUSING)
        for scenes in families(self.drawn(COUNT // 3, SEED + 1), values_of):
            family = Family(self.program, scenes, "[machine]\nmass = 0.3\n", self.machine_of(0.3))
            self.check_scaling(family, scenes, self.of_machine, 0.3, RESULTS_IN_HOUSING)
        self.assertEqual(self.told(), "")
        self.assertGreater(self.compared, 8 * COUNT)
        self.assertEqual(self.unknown, [])

    def test_they_are_the_limits_of_differences(self):
        """By each key in turn, from runs that begin on the motion itself; to four orders in the step."""
        sharp = {}
        for n, scenes in enumerate(families(self.drawn(COUNT, SEED + 2), values_of)):
            frame = framed(scenes, n)
            family = Family(self.program, scenes, of_section=values_of, observe=frame)
            found = [i for i in range(len(scenes)) if family.runs["status"][i] == PERIODIC]
            starts = [started(scenes[i], family.runs, i, frame) for i in found]
            keys = [family.keys[(n + j) % len(family.keys)] for j in range(len(found))]
            steps = [1e-4 * (abs(scene[key]) or 0.05) for scene, key in zip(starts, keys)]
            sides = {side: [moved(s, key, side * d) for s, key, d in zip(starts, keys, steps)] for side in SIDES}
            kept = [j for j in range(len(found)) if all(is_valid(side[j]) for side in sides.values())]
            if not kept:
                continue
            runs = {
                side: self.program.run([scenes[j] for j in kept], SETTLE, STEADY + frame, keys_of=values_of)
                for side, scenes in sides.items()
            }
            for place, j in enumerate(kept):
                i, key = found[j], keys[j]
                part = self.part
                if scenes[i]["loose_R"] == 0:
                    # where an impact just presses, the second derivative jumps; others before it the word doesn't tell
                    part = 1.0
                    if {len(run.logs[place]) for run in runs.values()} != {len(family.runs.logs[i])}:
                        continue
                compared = (family.runs, i, key, runs, place, steps[j], scenes[i], RESULTS_IN_HOUSING)
                sharp[key] = sharp.get(key, 0) + self.compare_differences(*compared, part=part)
        self.assertEqual(self.told(), "")
        self.assertGreater(sum(sharp.values()), 2 * COUNT)
        self.assertLessEqual(len([key for key, count in sharp.items() if count == 0]), self.unconfirmed, sharp)

    def test_a_mirrored_scene_has_mirrored_ones(self):
        scenes = [scene for scene in self.drawn(COUNT, SEED + 3) if "loose_upper" in scene]
        for scenes in families(scenes, values_of):
            others = [mirrored(scene) for scene in scenes]
            one, other = (Family(self.program, s, of_section=values_of) for s in (scenes, others))
            for i, scene in enumerate(scenes):
                if one.runs["status"][i] == PERIODIC and np.isclose(one.runs["x_max"][i], -other.runs["x_min"][i]):
                    for key in one.keys:
                        self.check_mirrored(one.runs, other.runs, i, key, scene)
        self.assertEqual(self.told(), "")
        self.assertGreater(self.compared, 8 * COUNT)

    def check_mirrored(self, one, other, i, key, scene):
        walls = {"loose_lower": "loose_upper", "loose_upper": "loose_lower"}
        negative = key in walls or key in ("f", "load", "loose_load", "base_amplitude")
        ends = {name: name[:2] + {"min": "max", "max": "min"}[name[2:]] for name in EXTREMA}
        for result in RESULTS_IN_HOUSING:
            expected = np.atleast_1d(derivative(one, result, key)[i])[::-1]
            sign = (-1 if negative else 1) * (-1 if result in ends else 1)
            found = np.atleast_1d(derivative(other, ends.get(result, result), walls.get(key, key))[i])
            for own, known in zip(found, sign * expected):
                if not math.isnan(own) or not math.isnan(known):
                    self.check(abs(own - known), 1e-6 * abs(known) + 1e-8, f"{result} by {key}, {scene}")


def drawn_in_pieces(count, seed):
    """Under forces of other shapes, none of them shaken."""
    draw = random.Random(f"pieces {seed}")
    scenes = []
    for scene in drawn(count, seed):
        scene.pop("base_amplitude", None), scene.pop("stop_phase", None)
        force = Force(draw.choice(SHAPES), draw.uniform(0.1, 0.9), draw.uniform(0.05, 0.45))
        scenes.append(scene | {key: getattr(force, key) for key in force.keys_of_force()})
    return scenes


class UnderForcesInPieces(OfRandomScenes):
    drawn = staticmethod(drawn_in_pieces)
    part = 1.0  # second derivatives jump between the steps if an event passes a knot


def started(scene, runs, i, frame):
    """The scene from the state in which its observed period begins, which is absolute if a frame is asked for."""
    x, v, z, w = (float(runs[name][i, 0]) for name in "xvzw")
    b, angle = scene.get("base_amplitude", 0.0) if frame else 0.0, scene["phase"] + scene.get("stop_phase", 0.0)
    state = {"x0": x - b * math.sin(angle), "v0": v - b * scene["nu"] * math.cos(angle), "loose_x0": z, "loose_v0": w}
    return {**scene, **state}


def moved(scene, key, step):
    """The scene with a key that has changed, its start on a wall or a stop that has moved over it."""
    scene = {**scene, key: scene[key] + step}
    for start, kind in (("loose_x0", "loose"), ("x0", "stop")):
        low, high = scene.get(f"{kind}_lower", -math.inf), scene.get(f"{kind}_upper", math.inf)
        soft = [f"stop_stiffness_{side}" in scene and kind == "stop" for side in ("lower", "upper")]
        low, high = -math.inf if soft[0] else low, math.inf if soft[1] else high
        scene[start] = min(max(scene[start], low), high)
    return scene


def is_valid(scene):
    return scene["loose_R"] >= 0 and all(
        scene.get(level, 0.0) <= scene.get(f"{level}_static", math.inf) for level in ("friction", "loose_friction")
    )


def slopes_of(function, values):
    """The derivatives of a function by its arguments, by differences of the sixth order."""
    slopes = {}
    for key, value in values.items():
        step = 1e-4 * max(abs(value), 0.05)
        at = {n: np.array(function({**values, key: value + n * step})) for n in (-3, -2, -1, 1, 2, 3)}
        ways = [(at[n] - at[-n]) / (2 * n * step) for n in (1, 2, 3)]
        slopes[key] = 1.5 * ways[0] - 0.6 * ways[1] + 0.1 * ways[2]
    return slopes


class ClosedForms(LooseMass):
    def derivatives(self, scene, keys=None, time=None, **observe):
        keys = keys or [key for key in scene if key not in STARTS]
        asked = {"sensitivity": ", ".join(keys), "extrema": True, "impacts": True, "word": True, **observe}
        return self.observed(scene, {"max_periods": 4000, **(time or {})}, asked)

    def test_symmetric_motion_with_two_impacts(self):
        """Masri and Caughey 1966."""
        for scene in (ATTRACTING, {**ATTRACTING, "h": 0.01, "f": 0.011, "loose_R": 0.7}):
            with self.subTest(scene=scene):
                data, slopes = self.derivatives(scene), slopes_of(symmetric, scene)
                eps, R, nu, w = (*(scene[key] for key in ("loose_mass", "loose_R", "nu")), symmetric(scene)[3])
                np.testing.assert_allclose(data["impact_speed"], [w, w], rtol=1e-11)
                for key, (x, _, _, speed, _) in slopes.items():
                    told = {name: data[f"d_{name}_d_{key}"] for name in RESULTS_IN_HOUSING}
                    size = max(abs(speed), 1e-3)
                    np.testing.assert_allclose(told["impact_speed"], [speed, speed], atol=1e-8 * size, err_msg=key)
                    gap = 1.0 if key == "loose_gap" else 0.0
                    np.testing.assert_allclose([told["z_min"], told["z_max"]], [-gap, gap], atol=1e-15)
                    np.testing.assert_allclose([told["y_min"], told["y_max"]], [-x - gap, x + gap], atol=1e-8)
                    np.testing.assert_allclose(told["x_min"], -told["x_max"], atol=1e-8 * max(1, abs(told["x_max"])))
                    lost = {"loose_mass": (1 - R * R) / (1 + eps) ** 2, "loose_R": -2 * R * eps / (1 + eps)}
                    power = lost.get(key, 0.0) * w * w + 2 * eps / (1 + eps) * (1 - R * R) * w * speed
                    power = power * nu / (2 * math.pi)
                    power += eps / (1 + eps) * (1 - R * R) * w * w / (2 * math.pi) if key == "nu" else 0.0
                    np.testing.assert_allclose(told["impact_power"], power, atol=1e-8, err_msg=key)
                    period = -2 * math.pi / nu**2 if key == "nu" else 0.0
                    np.testing.assert_allclose(told["period"], period, rtol=1e-14)

    def test_pressed_for_good_both_masses_are_one(self):
        scene = {"h": 0.1, "f": 0.05, "nu": 1.3, "load": 0.1, "stiffness": 1.2}
        scene |= {"loose_mass": 0.3, "loose_lower": -0.7, "loose_R": 0.5, "loose_load": -0.4}

        def ends(h, f, nu, load, stiffness, loose_mass, loose_load, **_):
            size = f / cmath.sqrt((stiffness - (1 + loose_mass) * nu * nu) ** 2 + (2 * h * nu) ** 2)
            middle = (load + loose_mass * loose_load) / stiffness
            return middle - size, middle + size

        data = self.derivatives(scene)
        self.assertEqual(data["impact_word"], "(L)")
        low, high = (by_each(lambda end=end, **values: ends(**values)[end], scene) for end in (0, 1))
        for key in scene:
            lower = 1.0 if key == "loose_lower" else 0.0
            np.testing.assert_allclose(data[f"d_x_min_d_{key}"], low[key], rtol=1e-9, atol=1e-12, err_msg=key)
            np.testing.assert_allclose(data[f"d_x_max_d_{key}"], high[key], rtol=1e-9, atol=1e-12, err_msg=key)
            np.testing.assert_allclose(data[f"d_y_max_d_{key}"], high[key] + lower, rtol=1e-9, atol=1e-12)
            self.assertEqual([data[f"d_z_min_d_{key}"], data[f"d_z_max_d_{key}"]], [lower, lower])
            self.assertEqual(data[f"d_impact_power_d_{key}"], 0.0)
            self.assertTrue(np.isnan(data[f"d_impact_speed_d_{key}"]).all())

    def test_the_lightest_loose_mass_is_a_ball_between_shaken_walls(self):
        """Its impacts change with its numbers as those of a ball between stops on a base do."""
        scene = {"h": 0.05, "f": 0.5, "nu": 1.4, "loose_mass": 1e-12, "loose_lower": -0.6, "loose_upper": 0.5}
        scene |= {"loose_R": 0.6, "loose_load": -0.02, "loose_v0": 0.4}
        gain, lag = scene["f"] / math.hypot(1 - 1.4**2, 2 * 0.05 * 1.4), math.atan2(2 * 0.05 * 1.4, 1 - 1.4**2)
        ball = {"stiffness": 0.0, "load": -0.02, "nu": 1.4, "base_amplitude": gain, "stop_phase": -lag}
        ball |= {"stop_lower": -0.6, "stop_upper": 0.5, "R": 0.6, "v0": 0.4}
        keys = {"loose_lower": "stop_lower", "loose_upper": "stop_upper", "loose_R": "R", "loose_load": "load"}
        scene["x0"], scene["v0"] = gain * math.sin(-lag), gain * 1.4 * math.cos(lag)
        one, other = self.derivatives(scene, keys), self.derivatives(ball, [*keys.values(), "base_amplitude"])
        self.assertEqual(one["impact_word"], other["impact_word"])
        self.assertEqual(other["status"], PERIODIC)
        np.testing.assert_allclose(one["impact_speed"], other["impact_speed"], rtol=1e-9)
        for key, of_ball in keys.items():
            for result, its in (("impact_speed", "impact_speed"), ("z_min", "x_min"), ("z_max", "x_max")):
                expected = other[f"d_{its}_d_{of_ball}"]
                np.testing.assert_allclose(one[f"d_{result}_d_{key}"], expected, rtol=1e-6, err_msg=key)
        force = self.derivatives(scene, ["f"])["d_impact_speed_d_f"]
        np.testing.assert_allclose(force, other["d_impact_speed_d_base_amplitude"] * gain / scene["f"], rtol=1e-6)

    def test_none_without_an_impact_on_a_wall(self):
        floating = {"h": 0.1, "f": 0.1, "nu": 0.7, "loose_mass": 0.1, "loose_gap": 2.0}
        data = self.derivatives(floating)
        self.assertEqual((data["status"], data["impact_word"]), (PERIODIC, "-"))
        for key in floating:
            for result in RESULTS_IN_HOUSING:
                self.assertTrue(np.isnan(data[f"d_{result}_d_{key}"]).all())

    def test_without_the_loose_mass_they_are_those_of_the_structure(self):
        masses, scene = [0.0, 0.02], {key: value for key, value in ATTRACTING.items() if key != "loose_mass"}
        keys = ["h", "f", "nu", "loose_gap", "loose_mass"]
        asked = {"sensitivity": ", ".join(keys), "extrema": True}
        swept = self.observed(scene, {"max_periods": 4000}, asked, sweep={"loose_mass": masses})
        alone = {**{key: scene[key] for key in ("h", "f", "nu")}, "stop_upper": math.inf}
        alone = self.observed(alone, {"max_periods": 4000}, {**asked, "sensitivity": "h, f, nu"})
        for key in ("h", "f", "nu"):
            np.testing.assert_array_equal(swept[f"d_x_max_d_{key}"][0], alone[f"d_x_max_d_{key}"])
            self.assertTrue(math.isnan(swept[f"d_y_max_d_{key}"][0]))
        self.assertEqual(swept["d_x_max_d_loose_gap"][0], 0.0)
        self.assertTrue(math.isnan(swept["d_x_max_d_loose_mass"][0]))
        self.assertFalse(math.isnan(swept["d_x_max_d_loose_mass"][1]))


if __name__ == "__main__":
    unittest.main()
