"""Stops that move by themselves: relations between runs, of scenes that are drawn at random.

Environment: CLATTER, the program.
"""

import math
import random
import unittest

import numpy as np

from force_scenes import any_orders
from stop_motion_test import DRIVEN, LIMITS, Motions, moving, stop_at

STRETCHED = 1e-12  # some thousand roundings of 1, as which impacts stretch one; the scenes drawn here take 5e-14


def drawn(index):
    """A scene, and whether it may rest: kinds of stops, springs and forces are drawn."""
    draw = random.Random(index)
    soft = draw.random() < 0.4
    scene = {
        "h": draw.choice([0.0, 0.03, 0.2, 1.4]),
        "f": draw.choice([0.0, draw.uniform(0.2, 1.5)]),
        "nu": draw.choice([0.4, 1.0, 1.7, 5.0]) * draw.uniform(0.9, 1.1),
        "phase": draw.uniform(-3, 3),
        "stop_lower": -draw.uniform(0.3, 0.8),
        "stop_upper": draw.uniform(0.3, 0.8),
        "load": draw.choice([0.0, draw.uniform(-1, 1)]),
        "stiffness": draw.choice([1.0, 1.0, 1.0, 0.0, -0.3]),
    }
    if soft:
        scene |= {"stop_stiffness": draw.choice([5.0, 400.0]), "stop_damping": draw.choice([0.0, 0.3])}
    else:
        scene |= {"R": draw.choice([0.0, 0.4, 0.8, 1.0])}
    scene |= {"x0": draw.uniform(-0.1, 0.1), "v0": draw.uniform(-1, 1)}
    if scene["f"] and index % 3 == 0:
        scene |= any_orders(random.Random(f"orders {index}"))
    return scene, draw


class Relations(Motions):
    def test_stops_that_move_alike_are_stops_of_one_frame(self):
        for index in range(24):
            scene, draw = drawn(index)
            b, lead = draw.uniform(0.02, 0.25), draw.uniform(-3, 3)
            theta = scene["phase"] + lead
            together = {**scene, "stop_amplitude": b, "stop_phase": lead}
            together["x0"] -= b * math.sin(theta)
            together["v0"] -= b * scene["nu"] * math.cos(theta)
            apart = {**scene, **moving((b, lead), (b, lead))}
            with self.subTest(index, **apart):
                duration = 12.0
                asked = {"extrema": True, "impacts": True, "energy": True}
                mine = self.transient(apart, duration, 9, **asked)
                its = self.transient(together, duration, 9, **asked, frame="absolute")
                self.compare(mine, its, STRETCHED)
                size = 1 + abs(mine["work_in"]) + mine["loss_damping"] + np.sum(mine["loss_impact"])
                self.assertLess(abs(mine["energy_residual"]), 1e-11 * size)
                for name in (*LIMITS, "rest_fraction", "impact_speed", "loss_impact", "impulse"):
                    np.testing.assert_allclose(mine[name], its[name], rtol=0, atol=STRETCHED, err_msg=name)
                if "stop_stiffness" in scene:
                    np.testing.assert_allclose(mine["contact_force_max"], its["contact_force_max"], rtol=1e-7)

    def test_steady_motion_is_that_of_one_frame(self):
        for index, own in enumerate(({"R": 0.7}, {"R": 0.0}, {"stop_stiffness": 60.0, "stop_damping": 0.1})):
            scene = {key: value for key, value in DRIVEN.items() if key != "R"} | own
            asked = {"extrema": True, "harmonics": 5, "harmonics_method": "exact", "impacts": True, "section": 3}
            mine = self.steady({**scene, **moving((0.1, 0.7), (0.1, 0.7))}, **asked)
            its = self.steady({**scene, "stop_amplitude": 0.1, "stop_phase": 0.7}, **asked, frame="absolute")
            with self.subTest(index):
                self.assertEqual((mine["status"], mine["impact_word"]), (0, its["impact_word"]))
                self.assertGreater(len(mine["impact_tau"]), 0)
                names = ("period", "x_amplitude", "multiplier_re", "multiplier_im", "impact_v_before", "impact_speed")
                for name in (*names, *LIMITS, "rest_fraction", "section_x", "section_v"):
                    np.testing.assert_allclose(mine[name], its[name], rtol=0, atol=STRETCHED, err_msg=name)

    def test_attractors_are_those_of_one_frame(self):
        """Also where an axis of parameters continues them."""
        scene = {"h": 0.02, "f": 0.5, "stop_lower": -0.7, "stop_upper": 0.8, "R": 0.8, "phase": 0.0}
        b, lead = 0.1, 0.6
        shift, speed = b * math.sin(lead), b * math.cos(lead)
        time = {"max_periods": 3000, "tolerance": 1e-12}
        sweep = {"nu": "[1.3, 1.33]", "x0": "[-0.5, 0.0, 0.5]", "v0": "[-1.0, 0.2, 1.1]"}
        mine = self.observed(
            {**scene, **moving((b, lead), (b, lead))}, time, {"attractor": True, "word": True}, sweep=sweep
        )
        moved = {"nu": sweep["nu"], "x0": f"[{', '.join(str(x - shift) for x in (-0.5, 0.0, 0.5))}]"}
        for i, nu in enumerate((1.3, 1.33)):
            starts = {**moved, "nu": f"[{nu}]", "v0": f"[{', '.join(str(v - nu * speed) for v in (-1.0, 0.2, 1.1))}]"}
            its = self.observed(
                {**scene, "stop_amplitude": b, "stop_phase": lead},
                time,
                {"attractor": True, "word": True},
                sweep=starts,
            )
            self.assertEqual(mine["motion_count"][i], its["motion_count"][0])
            np.testing.assert_array_equal(mine["impact_word"][i], its["impact_word"][0])
            same = [[a == b for b in mine["attractor"][i].ravel()] for a in mine["attractor"][i].ravel()]
            its_same = [[a == b for b in its["attractor"][0].ravel()] for a in its["attractor"][0].ravel()]
            self.assertEqual(same, its_same)

    def test_a_mirror_image_has_its_stops_exchanged(self):
        for index in range(100, 112):
            scene, draw = drawn(index)
            lower, upper = (draw.uniform(0.02, 0.15), draw.uniform(-3, 3)), (
                draw.uniform(0.02, 0.15),
                draw.uniform(-3, 3),
            )
            mirror = {**scene, "stop_lower": -scene["stop_upper"], "stop_upper": -scene["stop_lower"]}
            for key in ("f", "load", "x0", "v0", *(key for key in scene if key.startswith("f_"))):
                mirror[key] = -scene[key]
            with self.subTest(index, lower=lower, upper=upper, **scene):
                mine = self.transient({**scene, **moving(lower, upper)}, 12.0, 9)
                its = self.transient({**mirror, **moving((-upper[0], upper[1]), (-lower[0], lower[1]))}, 12.0, 9)
                for name in ("x", "v", "impact_v_before", "impact_v_after", "impact_stop"):
                    its[name] = -its[name]
                self.compare(mine, its, STRETCHED)

    def test_a_motion_goes_on_from_where_it_is(self):
        for index in range(200, 212):
            scene, draw = drawn(index)
            scene |= moving(
                (draw.uniform(0.02, 0.15), draw.uniform(-3, 3)), (draw.uniform(0.02, 0.15), draw.uniform(-3, 3))
            )
            with self.subTest(index, **scene):
                whole = self.transient(scene, 10.0, 3)
                if "R" in scene and abs(whole["x"][1] - stop_at(scene, "lower", 5.0)[0]) < 1e-6:
                    continue  # it rests there, to rounding
                rest = {**scene, "x0": whole["x"][1], "v0": whole["v"][1], "phase": scene["phase"] + 5.0 * scene["nu"]}
                later = self.transient(rest, 5.0, 2)
                np.testing.assert_allclose(
                    (later["x"][1], later["v"][1]), (whole["x"][2], whole["v"][2]), atol=STRETCHED
                )

    def test_multipliers_are_the_derivatives_of_a_period(self):
        for scene in (
            {**DRIVEN, **moving((0.1, 0.7))},
            {**DRIVEN, "h": 0.2, **moving((0.1, 0.7), (0.05, -1.0))},
            {
                "stiffness": 0.0,
                "load": -1.0,
                "nu": 2.0,
                "R": 0.6,
                "stop_lower": 0.0,
                "x0": 0.4,
                "v0": 1.5,
                **moving((0.29, 0.0)),
            },
        ):
            data = self.steady(scene)
            with self.subTest(**scene):
                self.assertEqual(data["status"], 0)
                self.assertGreater(len(data["impact_tau"]), 0)
                turned = (scene.get("phase", 0.0), data["x"][0], data["v"][0])
                columns, small = [], 1e-6
                for x, v in ((small, 0), (0, small)):
                    ends = []
                    for sign in (1, -1):
                        start = {**scene, "phase": turned[0], "x0": turned[1] + sign * x, "v0": turned[2] + sign * v}
                        end = self.transient(start, float(data["period"]), 2)
                        ends.append(np.array([end["x"][1], end["v"][1]]))
                    columns.append((ends[0] - ends[1]) / (2 * small))
                known = np.sort_complex(np.linalg.eigvals(np.array(columns).T))
                told = np.sort_complex(data["multiplier_re"] + 1j * data["multiplier_im"])
                # differences over 1e-6 of ends that are known to 1e-15, and what bends over that way
                np.testing.assert_allclose(told, known, rtol=0, atol=1e-8)

    def test_a_base_that_carries_stops_which_move_back_leaves_them_where_they_are(self):
        """Then only the spring and the damper are shaken, which is a force on the ground (eq. 69)."""
        h, nu, b, f = 0.1, 1.4, 0.15, 0.6
        scene = {"h": h, "nu": nu, "stop_lower": -0.4, "stop_upper": 0.5, "R": 0.7, "x0": 0.1, "v0": 0.2}
        force = f + b * (1 + 2j * h * nu)
        ground = {**scene, "f": abs(force), "phase": math.atan2(force.imag, force.real)}
        shaken = {**scene, "f": f, "base_amplitude": b, **moving((-b, 0.0), (-b, 0.0)), "v0": 0.2 - b * nu}
        mine = self.transient(shaken, 20.0, 9, frame="absolute", extrema=True)
        its = self.transient(ground, 20.0, 9, extrema=True)
        self.compare(mine, its, STRETCHED)
        for name in LIMITS:
            self.assertAlmostEqual(mine[name], its[name], delta=STRETCHED)

    def test_a_point_is_the_same_alone_and_in_a_sweep(self):
        scene = {key: value for key, value in DRIVEN.items() if key != "nu"} | {"stop_phase_lower": 0.7}
        sweep = {"nu": "[1.1, 1.3]", "stop_amplitude_lower": "[0.0, 0.1, 0.2]"}
        time = {"max_periods": 4000, "tolerance": 1e-14}
        data = self.observed(scene, time, {"extrema": True}, sweep=sweep)
        self.assertEqual(data["x_max"].shape, (2, 3))
        for i, nu in enumerate((1.1, 1.3)):
            for j, amplitude in enumerate((0.0, 0.1, 0.2)):
                alone = self.observed({**scene, "nu": nu, "stop_amplitude_lower": amplitude}, time, {"extrema": True})
                for name in LIMITS:
                    self.assertEqual(data[name][i, j], alone[name], (name, nu, amplitude))


if __name__ == "__main__":
    unittest.main()
