"""Branches of motion under a force that is a sum of sines.

Environment: CLATTER, the program.
"""

import math
import unittest

import h5py
import numpy as np

from branch_sets import Sets
from command_line import CLATTER, CommandLine
from followed_branches import BranchCampaign
from force_scenes import under_orders
from loose_mass_test import text_of
from random_scenes import followed_scenes, rubbing_scenes, slipping_scenes

BOUNCING = {"h": 0.06, "f": 0.7, "nu": 0.9, "load": -0.2, "stop_lower": -0.6, "R_lower": 0.7}
BOUNCING |= {"f_2": 0.3, "phase_2": 0.7, "f_5": -0.2, "phase_5": -1.1}
RESTING = {"h": 0.03, "f": 1.6, "nu": 0.5, "load": -1.0, "stiffness": 0.0, "stop_lower": 0.0, "R_lower": 0.3}
RESTING |= {"f_2": 0.8, "phase_2": 0.4, "f_3": 0.3}


class OfOrders(CommandLine):
    def followed(self, scene, along, limits, observe=None, branch=None, section="scene"):
        """The arrays of branches along a key."""
        observed = {"extrema": True, "stability": True, "impacts": True, "harmonics": 1} | (observe or {})
        text = text_of(scene, {"max_periods": 2000}, observed, section)
        keys = {"along": along, "range": list(limits), "max_points": 600} | (branch or {})
        lines = "".join(f"{key} = {value!r}\n" for key, value in keys.items()).replace("'", '"')
        self.write("a.toml", f"{text}[branch]\n{lines}")
        done = self.clatter("branch", "a.toml", "-o", "a.h5", "-q", "--force")
        self.assertTrue((self.directory / "a.h5").exists(), done.stderr)
        with h5py.File(self.directory / "a.h5") as file:
            return {key: values[()] for key, values in file.items() if isinstance(values, h5py.Dataset)}

    def state_after(self, scene, periods, name="r"):
        """x and v after some forcing periods, and the extrema on the way."""
        time = {"mode": "transient", "duration": periods * 2 * math.pi / scene["nu"]}
        self.write(f"{name}.toml", text_of(scene, time, {"extrema": True, "trajectory": 2}))
        self.clatter("run", f"{name}.toml", "-o", f"{name}.h5", "-q", "--force")
        with h5py.File(self.directory / f"{name}.h5") as file:
            return [float(file[key][-1]) for key in ("x", "v")] + [float(file[key][()]) for key in ("x_min", "x_max")]

    def at_point(self, scene, found, along, point):
        state = {"x0": float(found["x"][point]), "v0": float(found["v"][point]), "phase": 0.0}
        return {**scene, along: float(found[along][point]), **state}

    def assert_motions(self, scene, found, along, most=7):
        """Points come back after their period, and the sum of their multipliers is that of small changes of starts."""
        points = np.flatnonzero(np.isfinite(found["x"]))
        largest = np.hypot(found["multiplier_re"], found["multiplier_im"]).max(axis=1)
        seen = 0
        for point in points[:: max(1, len(points) // most)]:
            start, periods = self.at_point(scene, found, along, point), float(found["period_ratio"][point])
            if not largest[point] < 100:
                continue
            x, v, low, high = self.state_after(start, periods)
            allowed = 1e-9 * (1 + largest[point]) * (1 + abs(x) + abs(v))
            where = f"{along} = {start[along]}"
            self.assertLess(max(abs(x - start["x0"]), abs(v - start["v0"])), allowed, where)
            self.assertLess(abs(low - found["x_min"][point]), allowed, where)
            self.assertLess(abs(high - found["x_max"][point]), allowed, where)
            seen += 1
            is_beside = np.any(np.abs(found["special_" + along] - start[along]) < 1e-3)  # of a graze, beside which
            if b"*" in found["word"][point] or is_beside:  # no change is small
                continue
            change, trace = 1e-6, 0.0
            for i, key in enumerate(("x0", "v0")):
                ends = [self.state_after({**start, key: start[key] + by}, periods)[i] for by in (change, -change)]
                trace += (ends[0] - ends[1]) / (2 * change)
            known = found["multiplier_re"][point].sum()
            self.assertLess(abs(trace - known), 1e-5 * (1 + largest[point]) ** 2, where)
        self.assertGreater(seen, 3)


class ClosedForms(OfOrders):
    def test_motion_without_impacts_is_the_sum_of_the_responses(self):
        sizes = {1: (0.4, 0.0), 2: (0.3, 0.7), 3: (-0.2, 1.0)}
        scene = {
            "h": 0.05,
            "f": 0.4,
            "nu": 0.7,
            "load": 0.3,
            "stop_upper": 1e4,
            "f_2": 0.3,
            "phase_2": 0.7,
            "f_3": -0.2,
            "phase_3": 1.0,
        }
        theta = np.linspace(0, 2 * math.pi, 20001)
        for stiffness in (1.0, 1.7):
            found = self.followed({**scene, "stiffness": stiffness}, "nu", (0.25, 1.5))
            self.assertTrue(np.all(found["word"] == b"-"))
            for point in range(0, len(found["nu"]), 7):
                nu = found["nu"][point]
                parts = {
                    j: size * np.exp(1j * phase) / (stiffness - (j * nu) ** 2 + 2j * 0.05 * j * nu)
                    for j, (size, phase) in sizes.items()
                }
                x = 0.3 / stiffness + sum((part * np.exp(1j * j * theta)).imag for j, part in parts.items())
                np.testing.assert_allclose(found["x_max"][point], x.max(), atol=1e-6)
                np.testing.assert_allclose(found["x_min"][point], x.min(), atol=1e-6)

    def test_no_step_passes_over_a_resonance_with_an_order(self):
        """Which is at a third of the natural frequency."""
        scene = {"h": 1e-4, "f": 0.1, "nu": 0.3, "f_3": 0.1, "stop_upper": 1e6, "x0": 0.0, "v0": 0.1}
        found = self.followed(scene, "nu", (0.3, 0.37), branch={"period": 1})
        known = 0.1 / (2 * 1e-4)  # 500
        self.assertGreater(found["x_max"].max(), 0.3 * known)


class Relations(OfOrders):
    def test_orders_of_size_0_leave_a_sine(self):
        sine = {key: value for key, value in BOUNCING.items() if not key.endswith(("_2", "_5"))}
        one, other = (self.followed({**sine, **more}, "nu", (0.7, 1.1)) for more in ({}, {"f_2": 0.0, "f_7": 0.0}))
        self.assertEqual(list(one["special_kind"]), list(other["special_kind"]))
        for name in ("special_nu", "special_impact_speed"):
            np.testing.assert_allclose(one[name], other[name], rtol=1e-9)

    def test_an_even_order_of_the_other_sign_has_the_mirror_image(self):
        own = {"load": 0.2, "stop_upper": 0.6, "R_upper": 0.7, "f_2": -0.3}
        mirrored = {key: value for key, value in BOUNCING.items() if not key.endswith("_lower")} | own
        one, other = (self.followed(scene, "nu", (0.7, 1.1)) for scene in (BOUNCING, mirrored))
        self.assertEqual(list(one["special_kind"]), list(other["special_kind"]))
        self.assertGreater(len(one["special_kind"]), 1)
        np.testing.assert_allclose(one["special_nu"], other["special_nu"], rtol=1e-10)
        np.testing.assert_allclose(one["special_x_max"], -other["special_x_min"], rtol=1e-8)

    def test_the_first_order_of_displacement_is_greatest_where_that_is_told(self):
        found = self.followed(BOUNCING, "nu", (0.7, 1.1))
        (point,) = np.flatnonzero(found["special_kind"] == b"maximum harmonic")
        state = {"x0": float(found["special_x"][point]), "v0": float(found["special_v"][point])}
        aside, sizes = 2e-4, []
        for nu in found["special_nu"][point] + np.array([-aside, 0, aside]):
            self.write("m.toml", text_of({**BOUNCING, **state, "nu": float(nu)}, {}, {"harmonics": 1}))
            self.clatter("run", "m.toml", "-o", "m.h5", "-q", "--force")
            with h5py.File(self.directory / "m.h5") as file:
                sizes.append(float(file["x_amplitude"][1]))
        below, above = sizes[1] - sizes[0], sizes[1] - sizes[2]
        self.assertGreater(min(below, above), 0)
        self.assertLess(abs(below - above), 0.05 * (below + above))

    def test_a_shift_of_the_phase_leaves_the_motion(self):
        """By half a turn it is the opposite of the odd orders."""
        odd = {key: -BOUNCING[key] for key in ("f", "f_5")}
        one = self.followed(BOUNCING, "nu", (0.8, 1.0))
        for changes in ({"phase": 0.4}, odd):
            other = self.followed({**BOUNCING, **changes}, "nu", (0.8, 1.0))
            np.testing.assert_allclose(one["special_nu"], other["special_nu"], rtol=1e-10)
            np.testing.assert_allclose(one["special_x_max"], other["special_x_max"], rtol=1e-8)

    def test_points_are_motions_along_each_key_of_an_order(self):
        for along, limits in (("nu", (0.7, 1.1)), ("f_2", (0.0, 0.6)), ("phase_5", (-2.0, 0.5)), ("f", (0.4, 1.0))):
            with self.subTest(along):
                found = self.followed(BOUNCING, along, limits)
                self.assert_motions(BOUNCING, found, along)

    def test_a_branch_begins_with_an_order_of_size_0(self):
        scene = {key: value for key, value in BOUNCING.items() if key not in ("f_2", "phase_2")}
        for start in (scene, {**scene, "f_2": 0.0}):
            found = self.followed(start, "f_2", (0.0, 0.3))
            self.assert_motions(scene, found, "f_2")

    def test_soft_stops_are_touched(self):
        scene = {**BOUNCING, "stop_stiffness_lower": 60.0, "stop_damping_lower": 0.1}
        del scene["R_lower"]
        found = self.followed(scene, "nu", (0.75, 1.05))
        self.assert_motions(scene, found, "nu")

    def test_motion_rests_between_releases_of_one_period(self):
        for orders in ({}, {"f_2": 1.6, "phase_2": 2.2}):
            scene = {**RESTING, **orders}
            found = self.followed(scene, "nu", (0.4, 1.0), branch={"period": 1})
            self.assertIn(b"L*L*" if orders else b"L*", found["word"])
            self.assert_motions(scene, found, "nu")

    def test_symmetric_motion_stays_so_along_an_odd_order(self):
        scene = {"h": 0.1, "f": -1.0, "nu": 1.1, "R": 0.7, "xs": 3.0, "f_3": 0.2, "x0": 2.0, "v0": 3.0}
        found = self.followed(scene, "f_3", (0.0, 0.4))
        self.assertTrue(np.all(found["symmetric"][found["branch"] == 0] == 1))
        np.testing.assert_allclose(found["x_max"], -found["x_min"], atol=1e-9)
        found = self.followed({**scene, "f_2": 0.1}, "f_3", (0.0, 0.4))
        self.assertTrue(np.all(np.isnan(found["symmetric"])))


class Campaigns(CommandLine):
    def test_points_of_random_branches_are_motions(self):
        scenes = under_orders(followed_scenes(14, 5), 5)
        campaign = BranchCampaign(CLATTER, scenes)
        self.assertEqual(campaign.failures, [])
        self.assertGreater(campaign.points, 100)

    def test_points_under_friction_are_motions(self):
        scenes = under_orders(slipping_scenes(16, 7), 7) + under_orders(rubbing_scenes(10, 8), 8)
        campaign = BranchCampaign(CLATTER, scenes)
        self.assertEqual(campaign.failures, [])
        self.assertGreater(campaign.points, 100)

    def test_a_set_is_found_from_any_of_its_branches_and_as_a_machine(self):
        found = Sets(CLATTER, under_orders(followed_scenes(6, 6), 6)).failures
        self.assertEqual(found.report(), "")
        self.assertGreater(found.compared, 4)


if __name__ == "__main__":
    unittest.main()
