"""A loose mass that rubs on its housing: relations between the motions of random scenes, what it is refused by, and two
methods that share no arc.

Environment: CLATTER, the program.
"""

import math
import random
import unittest

import h5py
import numpy as np

import loose_mass_relations_test as relations
from loose_mass_test import LooseMass


def rubbing(seed):
    """A random scene in which friction stops and holds the loose mass every now and then."""
    scene, draw = relations.drawn(seed), random.Random(1000 + seed)
    scene["loose_friction"] = scene["loose_mass"] * draw.uniform(0.02, 0.12)
    if draw.random() < 0.5:
        scene["loose_friction_static"] = scene["loose_friction"] * draw.uniform(1, 1.5)
    return scene


class Relations(relations.Relations):
    drawn = staticmethod(rubbing)
    # of a mass without friction, or not of random scenes
    test_the_lightest_loose_mass_is_a_ball_between_shaken_walls = None
    test_100000_elastic_impacts_keep_the_energy = None
    test_a_sweep_has_the_motions_of_its_points_with_any_number_of_threads = None

    @relations.in_scenes(4)
    def test_dopri5_tells_the_same(self, scene):
        time, observe = {"mode": "transient", "duration": 15.0}, {"trajectory": 7, "energy": True}
        one = self.observed(scene, time, observe)
        text = relations.text_of(scene, time, observe) + '[integrator]\nmethod = "dopri5"\ntolerance = 1e-12\n'
        with h5py.File(self.run_clatter(text, "other")) as other:
            for name in ("x", "v", "z", "w", "loss_friction", "work_in"):
                np.testing.assert_allclose(other[name], one[name], atol=1e-8, err_msg=name)

    @relations.in_scenes(6)
    def test_steady_motion_comes_back_and_has_no_work_left(self, scene):
        asked = {"energy": True, "trajectory": 2, "period": True, "impact_log": True}
        steady = self.observed(scene, {"max_periods": 4000}, asked)
        if steady["status"] != 0:
            return
        names = {"x0": "x", "v0": "v", "loose_x0": "z", "loose_v0": "w"}
        start = {key: float(steady[name][0]) for key, name in names.items()}
        after = self.transient({**scene, **start}, float(steady["period"]), 2)
        for key, name in names.items():
            self.assertAlmostEqual(after[name][-1], start[key], delta=1e-7)
        losses = steady["loss_damping"] + steady["loss_friction"] + steady["loss_impact"].sum()
        self.assertAlmostEqual(float(steady["work_in"]), float(losses), delta=1e-7)

    @relations.in_scenes()
    def test_steady_motion_is_where_a_long_transient_ends(self, scene):
        steady = self.observed(scene, {"max_periods": 4000}, {"trajectory": 2, "period": True})
        if steady["status"] != 0:
            return
        turn, turns = 2 * math.pi / scene["nu"], 1000
        periods = round(float(steady["period"]) / turn)
        run = self.transient(scene, turns * turn, turns + 1)
        last = np.array([run[name][-periods:] for name in "xvzw"]).T
        apart = np.abs(last - [float(steady[name][0]) for name in "xvzw"]).max(axis=1)
        self.assertLess(apart.min(), 1e-8)


class ClosedForms(LooseMass):
    HELD = {"h": 0.05, "f": 0.3, "nu": 1.2, "loose_mass": 0.2, "loose_gap": 0.4, "loose_R": 0.6, "loose_x0": 0.1}

    def test_held_for_good_both_are_one_mass(self):
        data = self.observed({**self.HELD, "loose_friction": 1.0}, {}, {"extrema": True, "word": True, "energy": True})
        both = 1.2
        gain = 0.3 / np.hypot(1 - both * 1.2**2, 2 * 0.05 * 1.2)
        np.testing.assert_allclose((data["x_max"], data["y_max"]), (gain, gain + 0.1), rtol=1e-9)
        np.testing.assert_allclose((data["z_min"], data["z_max"]), 0.1, rtol=1e-15)
        self.assertEqual(data["loss_friction"], 0)
        self.assertEqual(data["impact_word"], "-")

    def test_held_for_good_a_change_grows_as_that_of_one_mass(self):
        """Its place in the housing stays, and its speed there is lost."""
        data = self.observed({**self.HELD, "loose_friction": 1.0}, {}, {"stability": True})
        roots = np.roots([1.2, 2 * 0.05, 1])
        expected = [1, *np.exp(roots * 2 * math.pi / 1.2), 0]
        told = data["multiplier_re"] + 1j * data["multiplier_im"]
        np.testing.assert_allclose(np.sort_complex(told), np.sort_complex(expected), atol=1e-12)

    def test_it_slides_once_the_acceleration_is_above_the_friction_over_the_mass(self):
        scene = {**self.HELD, "f": 0.02}
        gain = 0.02 / np.hypot(1 - 1.2 * 1.2**2, 2 * 0.05 * 1.2)
        level = 0.2 * gain * 1.2**2  # eps times the largest acceleration
        for share, slides in ((0.99, True), (1.01, False)):
            start = {"loose_friction": share * level}
            data = self.observed({**scene, **start}, {}, {"energy": True, "extrema": True})
            self.assertEqual(data["loss_friction"] > 0, slides, share)


if __name__ == "__main__":
    unittest.main()
