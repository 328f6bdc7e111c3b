"""Restitution that depends on the speed of the impact: relations between runs, closed forms, and what is refused.

Environment: CLATTER, the program.
"""

import math
import random
import subprocess
import unittest

import h5py
import numpy as np

import loose_friction_test as friction
import loose_mass_relations_test as relations
from command_line import CLATTER, LONGEST, CommandLine
from loose_mass_test import LooseMass, text_of


def by_speed(scene, seed):
    """The scene of a loose mass with restitutions that depend on the speed, at one wall or at both."""
    draw = random.Random(3000 + seed)
    for side in draw.choice((("lower",), ("upper",), ("lower", "upper"))):
        kind = draw.choice(("power", "threshold", "both"))
        if kind != "threshold":
            p = draw.uniform(0.05, 0.4)
            scene[f"loose_R_exponent_{side}"], scene[f"loose_R_reference_speed_{side}"] = p, draw.uniform(0.3, 1.5)
            scene[f"loose_R_{side}"] = max(scene[f"loose_R_{side}"], p / (1 + p))
        if kind != "power":
            scene[f"loose_R_below_{side}"] = draw.uniform(0.01, 0.2)
    return scene


class BySpeed:
    # not of random scenes
    test_100000_elastic_impacts_keep_the_energy = None
    test_a_sweep_has_the_motions_of_its_points_with_any_number_of_threads = None

    @staticmethod
    def R_at(scene, key, speeds):
        R, side = scene[key], key.rpartition("_")[2]
        p, V = scene.get(f"loose_R_exponent_{side}", 0.0), scene.get(f"loose_R_reference_speed_{side}", 1.0)
        of_power = np.maximum(p / (1 + p), 1 - (1 - R) * (speeds / V) ** p)
        return np.where(speeds < scene.get(f"loose_R_below_{side}", 0.0), 0.0, of_power if p else R)


class Relations(BySpeed, relations.Relations):
    @staticmethod
    def drawn(seed):
        return by_speed(relations.drawn(seed), seed)


class RelationsOfRubbing(BySpeed, friction.Relations):
    @staticmethod
    def drawn(seed):
        return by_speed(friction.rubbing(seed), seed)


TABLE = "0.1: 0.9, 0.5: 0.8, 2: 0.6"
DRIVEN = {"h": 0.05, "f": 1.0, "nu": 0.8, "stop_lower": -0.6, "stop_upper": 0.9, "R_of_speed": TABLE}
TRANSIENT = {"mode": "transient", "duration": 25.0}


def of_table(speed, table=TABLE):
    knots = [[float(number) for number in pair.split(":")] for pair in table.split(",")]
    return np.interp(speed, *zip(*knots))


def dropped(R, g, height):
    """Instants and speeds of the impacts of a ball on a fixed plate."""
    time, speed = math.sqrt(2 * height / g), math.sqrt(2 * g * height)
    while speed > 1e-5:
        yield time, speed
        speed *= R(speed)
        time += 2 * speed / g


class Tables(LooseMass):
    def test_a_ball_bounces_by_its_table(self):
        scene = {"stiffness": 0.0, "f": 0.0, "load": -1.5, "x0": 1.2, "stop_lower": 0.0, "R_of_speed": TABLE}
        data = self.transient(scene, samples=2)
        known = np.array(list(dropped(of_table, 1.5, 1.2)))
        np.testing.assert_allclose(data["impact_tau"][: len(known)], known[:, 0], rtol=1e-12)
        np.testing.assert_allclose(-data["impact_v_before"][: len(known)], known[:, 1], rtol=1e-11)
        self.assertGreater(len(known), 40)

    def test_below_a_threshold_a_ball_lies_still_at_once(self):
        scene = {"stiffness": 0.0, "f": 0.0, "load": -1.5, "x0": 1.2, "stop_lower": 0.0, "R": 0.8, "R_below": 0.05}
        data = self.transient(scene, samples=2, time_to_rest=True)
        known = [impact for impact in dropped(lambda v: 0.8 if v >= 0.05 else 0.0, 1.5, 1.2)]
        self.assertEqual(len(data["impact_tau"]), len(known))
        self.assertAlmostEqual(data["time_to_rest"], known[-1][0], delta=1e-12)
        self.assertEqual(data["impact_v_after"][-1], 0)

    def test_a_table_of_one_speed_is_a_constant(self):
        one = self.transient(DRIVEN | {"R_of_speed": "0.3: 0.7"})
        del (constant := dict(DRIVEN))["R_of_speed"]
        other = self.transient(constant | {"R": 0.7})
        for name in ("x", "v", "impact_tau"):
            np.testing.assert_array_equal(one[name], other[name])

    def test_speeds_have_units_in_a_machine(self):
        mass, length, rate = 0.4, 3e-3, 70.0
        unit = length * rate
        table = ", ".join(f"{1e3 * v * unit!r} mm/s: {R}" for v, R in ((0.1, 0.9), (0.5, 0.8), (2, 0.6)))
        machine = {
            "mass": mass,
            "stiffness": mass * rate**2,
            "damping_ratio": 0.05,
            "force": mass * rate**2 * length,
        }
        machine |= {"frequency": 0.8 * rate / (2 * math.pi), "stop_lower": -0.6 * length, "stop_upper": 0.9 * length}
        one = self.transient(DRIVEN, 20.0)
        other = self.transient(machine | {"R_of_speed": table}, 20.0 / rate, kind="machine")
        self.assertGreater(len(one["impact_tau"]), 5)
        np.testing.assert_allclose(other["x"], length * one["x"], atol=1e-10 * length)
        np.testing.assert_allclose(other["impact_tau"] * rate, one["impact_tau"], rtol=1e-10)

    def test_each_impact_keeps_what_the_table_says(self):
        data = self.transient(DRIVEN, 100.0)
        before, after = np.abs(data["impact_v_before"]), np.abs(data["impact_v_after"])
        self.assertGreater(len(before), 30)
        np.testing.assert_allclose(after, of_table(before) * before, rtol=4e-16 * 4)

    def test_all_methods_tell_the_same(self):
        one = self.transient(DRIVEN, 15.0)

        def off(method):
            text = text_of(DRIVEN, TRANSIENT | {"duration": 15.0}, {"trajectory": 7}) + f"[integrator]\n{method}\n"
            with h5py.File(self.run_clatter(text, "other", options=("--force",))) as other:
                return np.abs(other["x"][()] - one["x"]).max()

        self.assertLess(off('method = "dopri5"\ntolerance = 1e-12'), 1e-8)
        errors = [off(f'method = "moreau"\nstep = {step}') for step in (1e-3, 1e-4, 1e-5)]
        self.assertLess(errors[2], 1e-3)
        self.assertLess(errors[2], errors[0] / 10)

    def test_multipliers_are_those_of_neighbouring_runs(self):
        steady = self.steady(DRIVEN)
        self.assertEqual(steady["status"], 0)
        start = {key: float(steady[name][0]) for key, name in (("x0", "x"), ("v0", "v"))}

        def after_a_period(**state):
            data = self.transient({**DRIVEN, **state}, float(steady["period"]), 2)
            return np.array([data["x"][-1], data["v"][-1]])

        columns = []
        for key in start:
            more, less = (after_a_period(**{**start, key: start[key] + d}) for d in (1e-6, -1e-6))
            columns.append((more - less) / 2e-6)
        told = np.poly(steady["multiplier_re"] + 1j * steady["multiplier_im"])
        np.testing.assert_allclose(told, np.poly(np.array(columns).T), atol=1e-7)

    def test_the_configuration_of_a_file_is_read_again(self):
        stops = {key: value for key, value in DRIVEN.items() if key != "R_of_speed"}
        power = {"R": 0.7, "R_exponent": 0.2, "R_reference_speed_lower": 1.0, "R_reference_speed_upper": 2.0}
        mixed = {"R_of_speed_lower": TABLE, "R_upper": 0.7, "R_exponent_upper": 0.2, "R_reference_speed_upper": 1.0}
        for law in (
            {"R_of_speed": TABLE},
            {"R_of_speed_lower": TABLE},
            power,
            {"R_below_upper": 0.1, "R_lower": 0.5},
            mixed,
        ):
            one = self.run_clatter(text_of(stops | law, TRANSIENT, {"extrema": True}), "one", options=("--force",))
            with h5py.File(one) as file:
                again = self.run_clatter(file.attrs["config"], "again", options=("--force",))
            self.assertEqual(one.read_bytes(), again.read_bytes())

    def test_the_command_line_replaces_a_table_or_is_replaced(self):
        text = text_of(DRIVEN, TRANSIENT, {"trajectory": 7})
        stops = {key: value for key, value in DRIVEN.items() if key != "R_of_speed"}
        half = {"R_lower": 0.5, "R_of_speed_upper": TABLE}
        cases = (("scene.R=0.5", {"R": 0.5}), ("scene.R_lower=0.5", half), (f"scene.R_of_speed={TABLE}", None))
        for n, (change, law) in enumerate(cases):
            given = text if law else text_of(stops | {"R_lower": 0.3}, TRANSIENT, {"trajectory": 7})
            expected = text_of(stops | law, TRANSIENT, {"trajectory": 7}) if law else text
            one, other = self.run_clatter(given, f"a{n}", options=("--set", change)), self.run_clatter(
                expected, f"b{n}"
            )
            with h5py.File(one) as mine, h5py.File(other) as its:
                np.testing.assert_array_equal(mine["x"][()], its["x"][()])


class Plans(CommandLine):
    def test_a_machine_is_computed_with_its_law_in_computed_units(self):
        machine = {"mass": 0.25, "stiffness": 6400.0, "gap": 3e-3, "force": 40.0, "frequency": 25.0, "R": 0.7}
        law = {"R_exponent": 0.2, "R_reference_speed": "0.5 m/s", "R_below": "1 cm/s"}
        self.write("m.toml", text_of(machine | law, {}, {"extrema": True}, "machine"))
        done = self.clatter("plan", "m.toml")
        for told in ("R_exponent_lower = 0.2", "R_reference_speed_upper = 0.003125", "R_below_lower = 6.25e-05"):
            self.assertIn(told, done.stdout)  # a unit of time is 1/160 s


class Refusals(CommandLine):
    def refused(self, law, words):
        stops = {key: value for key, value in DRIVEN.items() if key != "R_of_speed"}
        self.write("bad.toml", text_of(stops | law, TRANSIENT, {"extrema": True}))
        self.assert_refused(2, words, "run", "bad.toml")

    def test_a_table_has_speeds_that_rise_and_restitutions(self):
        for text, word in (
            ("", "it is empty"),
            ("0.1 0.9", "'0.1 0.9' has no colon"),
            ("curve.csv", "'curve.csv' has no colon"),
            (": 0.9", "a speed is missing"),
            ("0.1:", "a restitution is missing"),
            ("0.1: 0.9, 0.1: 0.8", "speeds must rise"),
            ("1: 0.9, 0.5: 0.8", "the speed 0.5 follows 1"),
            ("-1: 0.9", "the speed -1"),
            ("nan: 0.9", "the speed nan"),
            ("0.1: 1.2", "the restitution 1.2 isn't between 0 and 1"),
            ("0: 0.9, 0.1: 0.1", "a faster impact rebounds more slowly"),
            ("0: 1, 1: 0.8", "grows exponentially"),
            ("0.1 m/s: 0.9", "the unit 'm/s' doesn't fit"),
        ):
            self.refused({"R_of_speed": text}, word)

    def test_one_law_for_each_stop(self):
        self.refused({"R_of_speed": TABLE, "R": 0.5}, "'R' beside 'R_of_speed'")
        self.refused({"R_of_speed_lower": TABLE, "R_exponent": 0.2}, "'R_exponent' beside 'R_of_speed_lower'")
        self.refused({"R_of_speed": TABLE, "R_of_speed_lower": TABLE}, "which stands for both")
        self.refused({"R_of_speed": TABLE, "stop_stiffness": 100.0}, "is soft")
        self.refused({"R_below": 0.1, "stop_stiffness": 100.0}, "'stop_stiffness' conflicts with 'R_below'")

    def test_a_power_law_has_its_speed_and_lets_faster_impacts_rebound_faster(self):
        self.refused({"R": 0.5, "R_exponent": 0.2}, "'R_exponent' without 'R_reference_speed'")
        self.refused({"R": 0.1, "R_exponent": 0.2, "R_reference_speed": 1.0}, "at least p/(1 + p)")
        self.refused({"R": 0.9, "R_exponent": 1.0, "R_reference_speed": 1.0}, ">= 0 and < 1")
        self.refused({"R": 0.9, "R_exponent": 0.2, "R_reference_speed": 0.0}, "R_reference_speed = 0")
        self.refused({"R_below": -0.1}, "R_below = -0.1")


class Branches(LooseMass):
    def followed(self, scene, limits, keys=""):
        text = text_of(scene, {}, {"stability": True, "word": True, "impacts": True})
        (self.scratch / "b.toml").write_text(
            f'{text}[branch]\nalong = "nu"\nrange = {limits}\n{keys}', encoding="utf-8"
        )
        output = self.scratch / "b.h5"
        command = [CLATTER, "branch", self.scratch / "b.toml", "-o", output, "--force"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LONGEST)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(output) as file:
            return {key: value[()] for key, value in file.items() if isinstance(value, h5py.Dataset)}

    def test_a_branch_ends_where_an_impact_comes_down_to_the_threshold(self):
        scene = {"h": 0.1, "f": 1.0, "nu": 0.9, "stop_upper": 1.2, "R": 0.6, "R_below": 0.2}
        found = self.followed(scene | {"R_exponent": 0.2, "R_reference_speed": 1.0}, [0.4, 1.6])
        ends = found["special_kind"] == b"rebound threshold"
        self.assertEqual(ends.sum(), 2)
        np.testing.assert_allclose(found["special_impact_speed"][ends], 0.2, rtol=1e-10)
        self.assertGreaterEqual(found["impact_speed"].min(), 0.2 * (1 - 1e-10))

    def test_motion_that_rests_ends_at_the_threshold_too_and_has_certificates_before(self):
        scene = {"h": 0.13, "f": -1.0, "nu": 0.48, "stiffness": 0.0, "load": -0.894, "stop_lower": -1.244}
        scene |= {"x0": -1.244, "v0": -1.05, "R_lower": 1.0, "R_below_lower": 0.157}
        found = self.followed(scene, [0.34, 0.67])
        self.assertIn(b"rebound threshold", found["special_kind"])
        self.assertTrue(all(b"*" in word for word in found["word"]))
        command = [CLATTER, "certify", self.scratch / "b.h5", "-o", self.scratch / "b.jsonl"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LONGEST)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("not reproduced", done.stderr)
        claimed = (self.scratch / "b.jsonl").read_text(encoding="utf-8").count('"claim":"periodic"')
        self.assertGreater(claimed, 0.7 * len(found["nu"]))  # but for the ends

    def test_a_branch_goes_on_past_the_corners_of_a_table(self):
        table = "0.1: 0.9, 0.6: 0.88, 1.3: 0.62, 2.0: 0.6"
        scene = {"h": 0.05, "f": 1.0, "nu": 1.7, "stop_upper": 0.3, "R_of_speed": table}
        found = self.followed(scene, [1.6, 2.05], "switch = 0\n")
        jumps = np.abs(np.diff(found["multiplier_re"].sum(axis=1)))
        corner = int(jumps.argmax())
        self.assertGreater(jumps[corner], 0.3)
        speeds = found["impact_speed"][corner : corner + 2]
        self.assertLess(abs(speeds - 1.3).max(), 0.02)
        for point in (corner, corner + 1):
            start = {"nu": float(found["nu"][point]), "x0": float(found["x"][point]), "v0": float(found["v"][point])}
            steady = self.steady(scene | start)
            self.assertEqual(steady["status"], 0)
            told = np.poly(found["multiplier_re"][point] + 1j * found["multiplier_im"][point])
            known = np.poly(steady["multiplier_re"] + 1j * steady["multiplier_im"])
            np.testing.assert_allclose(told, known, atol=1e-7)


if __name__ == "__main__":
    unittest.main()
