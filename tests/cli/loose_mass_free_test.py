"""A loose mass on a machine that no force moves: where it comes to a standstill, and what never does.

Environment: CLATTER, the program.
"""

import math
import random
import unittest

import h5py

import loose_mass_beside_stops_test as beside
from loose_friction_test import rubbing
from loose_mass_relations_test import drawn, in_scenes
from loose_mass_test import LooseMass, text_of

PERIODIC, APERIODIC = 0, 1


def free(seed):
    """A random scene that a weight or friction brings to a standstill, whatever else there is."""
    scene = random.Random(f"{seed} kind").choice([drawn, rubbing, beside.with_own_events])(seed)
    draw = random.Random(f"{seed} free")
    scene["f"], scene["h"] = 0.0, draw.uniform(0.05, 0.4)
    if draw.random() < 0.7:
        scene["loose_load"] = draw.choice([-1, 1]) * draw.uniform(0.2, 3)
    elif "loose_friction" not in scene:
        scene["loose_friction"] = scene["loose_mass"] * draw.uniform(0.02, 0.5)
    return scene


class Standstill(LooseMass):
    ASKED = {"trajectory": 2, "attractor": True, "extrema": True}
    drawn = staticmethod(free)

    @in_scenes(40)
    def test_it_is_where_a_long_transient_ends(self, scene):
        steady = self.observed(scene, {"max_periods": 4000}, self.ASKED)
        self.assertEqual(steady["status"], PERIODIC)
        end = self.transient(scene, 600.0, 2)
        for name in "xvzw":
            self.assertAlmostEqual(float(steady[name][0]), float(end[name][-1]), delta=1e-9, msg=name)
        self.assertLess(float(steady["x_max"] - steady["x_min"]), 1e-9)

    @in_scenes(12)
    def test_methods_that_know_no_closed_form_tell_the_same(self, scene):
        steady = self.observed(scene, {"max_periods": 4000}, self.ASKED)
        rest = {'effects = "all"': 1e-12, 'method = "dopri5"\ntolerance = 1e-12': 1e-9}  # dopri5 has errors of its own
        for method, tolerance in rest.items():
            text = text_of(scene, {"max_periods": 400, "tolerance": tolerance}, self.ASKED)
            text += f"[integrator]\n{method}\n"
            with h5py.File(self.run_clatter(text, "other")) as other:
                self.assertEqual(other["status"][()], PERIODIC, method)
                for name in "xz":
                    self.assertAlmostEqual(float(steady[name][0]), other[name][0], delta=1e3 * tolerance, msg=method)


class ClosedForms(LooseMass):
    ASKED = {"trajectory": 2, "period": True, "extrema": True}
    WEIGHED = {"h": 0.2, "f": 0.0, "load": 0.3, "stiffness": 2.0, "loose_mass": 0.4, "loose_lower": -0.5}
    WEIGHED |= {"loose_upper": 0.7, "loose_R": 0.6, "loose_load": -1.5, "loose_v0": 1.0}

    def ended(self, max_periods=400, **changes):
        return self.observed({**self.WEIGHED, **changes}, {"max_periods": max_periods}, self.ASKED)

    def assert_escapes(self, **changes):
        with self.assertRaisesRegex(AssertionError, "1 failed .escaped: 1"):
            self.ended(**changes)

    def test_both_masses_hang_in_the_spring(self):
        end = self.ended()
        self.assertEqual(end["status"], PERIODIC)
        self.assertAlmostEqual(float(end["x"][0]), (0.3 - 0.4 * 1.5) / 2, delta=1e-11)
        self.assertEqual(float(end["z"][0]), -0.5)

    def test_a_load_lays_both_on_a_stop(self):
        end = self.ended(stop_lower=-0.1, R=0.5)
        self.assertEqual((float(end["x"][0]), float(end["z"][0]), float(end["v"][0])), (-0.1, -0.5, 0))

    def test_a_soft_stop_gives_way_by_its_share(self):
        end = self.ended(stop_lower=-0.1, stop_stiffness_lower=6.0, stop_damping_lower=0.2)
        self.assertAlmostEqual(float(end["x"][0]), (0.3 - 0.6 - 6 * 0.1) / 8, delta=1e-11)

    def test_friction_in_the_housing_keeps_it_where_it_is(self):
        """The force on the loose mass is below the static level from the start on."""
        end = self.ended(loose_friction=1.0, loose_x0=0.3, loose_v0=0.0, loose_load=-0.5, load=0.0, x0=0.1)
        self.assertAlmostEqual(float(end["x"][0]), -0.4 * 0.5 / 2, delta=1e-11)
        self.assertAlmostEqual(float(end["z"][0]), 0.3, delta=1e-15)

    def test_without_damping_both_vibrate_as_one_mass(self):
        """The weight is more than vibration can lift."""
        end = self.ended(h=0.0, loose_x0=-0.5, loose_v0=0.0, load=0.0, loose_load=-3.0, x0=-0.6 - 0.2)
        self.assertEqual(end["status"], PERIODIC)
        self.assertAlmostEqual(float(end["period"]), 2 * math.pi * math.sqrt(1.4 / 2), delta=1e-12)
        self.assertAlmostEqual(float(end["x_max"] - end["x_min"]), 0.4, delta=1e-12)

    def test_friction_of_the_main_mass_ends_undamped_motion(self):
        end = self.ended(h=0.0, friction=0.2)
        force = 0.3 - 0.6 - 2 * float(end["x"][0])
        self.assertEqual(end["status"], PERIODIC)
        self.assertEqual((float(end["v"][0]), float(end["w"][0]), float(end["z"][0])), (0, 0, -0.5))
        self.assertLessEqual(abs(force), 0.2)

    def test_what_loses_nothing_never_stands(self):
        end = self.ended(h=0.0, loose_R=1.0, max_periods=200)
        self.assertEqual(end["status"], APERIODIC)
        self.assertGreater(float(end["x_max"] - end["x_min"]), 0.1)

    def test_a_loose_mass_without_weight_comes_to_no_end(self):
        """Each impact leaves it a share of its speed, and takes as much longer."""
        end = self.ended(loose_load=0.0, max_periods=200)
        self.assertEqual(end["status"], APERIODIC)

    def test_without_a_spring_the_load_carries_both_away(self):
        for load, stop in ((0.7, {"stop_lower": -3.0}), (0.5, {"stop_upper": 3.0})):  # more than the weight, or less
            with self.subTest(load=load):
                self.assert_escapes(stiffness=0.0, load=load, **stop)
                held = self.ended(stiffness=0.0, load=load, friction=0.15, **stop)
                self.assertEqual((held["status"], float(held["v"][0])), (PERIODIC, 0))

    def test_an_unstable_spring_drives_both_off_or_lays_them_on_a_stop(self):
        unstable = {"stiffness": -1.0, "x0": -0.5, "v0": 0.0, "load": 0.0, "R": 0.5}
        self.assert_escapes(**unstable, stop_upper=2.0)
        end = self.ended(**unstable, stop_lower=-2.0)
        self.assertEqual((end["status"], float(end["x"][0])), (PERIODIC, -2.0))

    def test_momentum_carries_both_away_without_spring_and_damper(self):
        """Whatever their impacts are; without momentum they stay."""
        afloat = {"h": 0.0, "stiffness": 0.0, "load": 0.0, "loose_load": 0.0}
        self.assert_escapes(**afloat)
        self.assertEqual(self.ended(**afloat, v0=-1.0, loose_v0=3.5, max_periods=200)["status"], APERIODIC)

    def test_a_section_is_that_of_a_force(self):
        data = self.observed(self.WEIGHED, {}, {"section": 3})
        self.assertTrue(all(math.isnan(x) for x in data["section_x"].ravel()))


if __name__ == "__main__":
    unittest.main()
