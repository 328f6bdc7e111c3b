"""`time_to_rest`: when a stop or dry friction holds the mass for good, against closed forms and relations of runs.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import math
import unittest

import h5py
import numpy as np

from command_line import CommandLine

OBSERVE = '[time]\nmode = "transient"\nduration = {}\n[observe]\ntime_to_rest = true\n'
BALL = "[scene]\nstiffness = 0\nload = -1.0\nstop_lower = 0\nR = {}\nx0 = 1.0\n"
SLIDE = "[scene]\nxs = 9.0\nfriction = {}\nx0 = 1.0\n"


class TimeToRest(CommandLine):
    def rest(self, text, duration=63.0, *words):
        self.write("a.toml", text + OBSERVE.format(duration))
        done = self.clatter("run", "a.toml", "-q", "--force", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with h5py.File(self.directory / "a.h5") as file:
            return file["time_to_rest"][()]

    def test_a_ball_rests_when_its_bounces_have_summed_up(self):
        for restitution in (0.0, 0.5, 0.9):
            expected = math.sqrt(2) * (1 + restitution) / (1 - restitution)
            self.assertAlmostEqual(self.rest(BALL.format(restitution)) / expected, 1, delta=1e-12)
        self.assertTrue(math.isnan(self.rest(BALL.format(0.9), 20.0)))  # bounces go on for 26.9
        self.assertTrue(math.isnan(self.rest(BALL.format(1.0))))

    def test_friction_takes_twice_its_level_from_the_amplitude_of_each_half_swing(self):
        for friction, swings in ((0.15, 3), (0.3, 2), (0.07, 7), (1.5, 0)):
            self.assertAlmostEqual(self.rest(SLIDE.format(friction)), swings * math.pi, delta=1e-12)
        self.assertTrue(math.isnan(self.rest("[scene]\nxs = 9.0\nh = 0.2\nx0 = 1.0\n")))  # never quite

    def test_of_a_machine_it_is_in_seconds(self):
        """Of 2 kg on 8 N/m, 2 rad/s; 1.2 N are 0.15 of the spring's force at 1 m."""
        machine = "[machine]\nmass = 2.0\nstiffness = 8.0\nfriction = 1.2\ngap = 9.0\nx0 = 1.0\n"
        self.assertAlmostEqual(self.rest(machine), 3 * math.pi / 2, delta=1e-12)
        with h5py.File(self.directory / "a.h5") as file:
            self.assertEqual(file["time_to_rest"].attrs["units"], "s")

    def test_under_a_force_it_must_have_rested_for_a_period(self):
        stuck = "[scene]\nxs = 9.0\nfriction = 0.5\nf = 0.1\nx0 = {}\n"
        self.assertEqual(self.rest(stuck.format(0.3)), 0)
        self.assertTrue(math.isnan(self.rest(stuck.format(0.3), 6.0)))  # less than 2 pi
        late = self.rest(stuck.format(2.0))
        self.assertTrue(0 < late < 63)
        self.assertEqual(self.rest(stuck.format(2.0), late + 6.4), late)
        self.assertTrue(math.isnan(self.rest(stuck.format(2.0), late + 6.2)))

    def test_a_loose_mass_that_a_wall_presses_all_the_time_makes_the_slide_heavier(self):
        """Its weight is held up by the load, so that the slide swings about 0, by (1 + eps)^(1/2) more slowly."""
        pressed = "loose_mass = 0.1\nloose_lower = 0\nloose_load = -5\nload = 0.5\nloose_R = 0.5\n"
        for friction, swings in ((0.15, 3), (0.3, 2)):
            expected = swings * math.pi * math.sqrt(1.1)
            self.assertAlmostEqual(self.rest(SLIDE.format(friction) + pressed), expected, delta=1e-12)

    def test_a_loose_mass_must_be_at_rest_too(self):
        held = "[scene]\nxs = 9.0\nfriction = 0.5\nx0 = 0.3\nloose_mass = 0.1\nloose_gap = 1\n"
        self.assertEqual(self.rest(held), 0)  # which nothing moves in its housing
        self.assertTrue(math.isnan(self.rest(held + "loose_v0 = 1e-3\n")))
        falls = held + "loose_load = -0.1\nloose_R = 0.4\n"  # and bounces, too slowly to move the slide: friction
        self.assertTrue(math.isnan(self.rest(falls, 5.0)))
        after = self.rest(falls)
        self.assertAlmostEqual(self.rest(falls, after + 1), after, delta=1e-12)
        self.assertTrue(math.isnan(self.rest(falls, after - 1e-3)))

    def test_rests_between_impacts_are_none_for_good(self):
        resting = "[scene]\nstop_lower = 0\nR = 0\nload = -0.5\nf = {}\nx0 = 1.0\n"
        self.assertTrue(math.isnan(self.rest(resting.format(1.0))))
        pressed = self.rest(resting.format(0.4))
        self.assertTrue(0 < pressed < 63)

    def test_soft_stops_hold_no_mass_and_friction_does(self):
        soft = "[scene]\nstop_lower = 0\nstop_stiffness = 100\nstop_damping = 0.2\nload = -0.5\nx0 = 1.0\nh = 0.1\n"
        self.assertTrue(math.isnan(self.rest(soft)))
        self.assertTrue(0 < self.rest(soft + "friction = 0.1\n") < 63)

    def test_a_sweep_has_the_values_of_its_points_on_any_instruction_set(self):
        sweep = BALL.replace("R = {}\n", "") + '[sweep]\nR = "linspace(0, 0.9, 24)"\n'
        values = self.rest(sweep)
        restitution = np.linspace(0, 0.9, 24)
        np.testing.assert_allclose(values, math.sqrt(2) * (1 + restitution) / (1 - restitution), rtol=1e-12)
        np.testing.assert_array_equal(self.rest(sweep, 63.0, "--arch", "scalar"), values)
        self.assertEqual(self.rest(BALL.format(0.9)), values[-1])

    def test_certificates_compare_it(self):
        self.rest(SLIDE.format(0.15))
        done = self.clatter("certify", "a.h5", "-o", "a.jsonl")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "a.h5", "r+") as file:
            file["time_to_rest"][()] = 9.0
        done = self.clatter("certify", "a.h5")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("time_to_rest", done.stderr)

    def test_where_it_means_nothing_it_is_warned_of_or_refused(self):
        self.write("a.toml", "[scene]\nxs = 1\nf = 1\n[observe]\ntime_to_rest = true\n")
        said = self.clatter("run", "a.toml").stderr
        self.assertIn("'time_to_rest' has no effect without mode = \"transient\"", said)
        self.assertIn("rests for good", self.clatter("help", "time_to_rest").stdout)


if __name__ == "__main__":
    unittest.main()
