"""A contact that falls on the stroboscopic section counts once, whatever rounding says.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import math
import unittest

import h5py
import numpy as np

from command_line import CommandLine, runs_here

ARCHITECTURES = ("scalar", *(name for name in ("sse2", "avx2", "avx512") if runs_here(name)))

# A ball on a table that moves up and down, elastic: it leaves the table at the phase pi/2 with the speed pi, and is
# back a period later, for any f. Its map has the trace 2 - 4 f.
BALL = """[scene]
stiffness = 0
load = -1
phase = "pi/2"
stop_lower = 0
stop_upper = inf
v0 = "pi"
[sweep]
f = "linspace(0.1, 0.9, 33)"
[observe]
impacts = true
word = true
stability = true
"""

# Masri & Caughey (1966): both stops once a period, at the speed u; the power is (1 - R^2) u^2 / (2 pi).
SPEED = 0.9836947527862134
BETWEEN = """[scene]
h = 0.1
f = 1
R = 0.5
xs = 0.5
phase = {phase!r}
x0 = -0.5
v0 = 0.4918473763931067
[observe]
impacts = true
impact_log = true
word = true
stability = true
energy = true
"""

TWO_MOTIONS = """[scene]
f = -1.0
nu = 2.855948996184263
h = 0.035593802328735186
stop_stiffness = 2757.974780787301
stop_damping = 0.0
stop_lower = -0.08543452249855045
stop_upper = 0.11296679969106241
x0 = -0.0750806201310269
v0 = -0.1657886122332095
[time]
max_periods = 2000
max_impacts = 300000
[observe]
period = true
word = true
"""

# At the section the mass sticks 1e-15 m beside the stop at 0.
SPOOL = """[machine]
mass = 0.0003361185937456267
stiffness = 1488.578099595049
force = 2.033654850633301
load = {load!r}
frequency = 250.064
friction = 1
stop_lower = {shift!r}
stop_upper = {upper!r}
x0 = {shift!r}
R = 0.3
[observe]
impacts = true
word = true
word_sticks = true
period = true
"""


class ContactOnSection(CommandLine):
    def run_on(self, arch, text, name="scene"):
        done = self.clatter(
            "run", self.write(f"{name}.toml", text), "--force", "-q", environment={"CLATTER_ARCH": arch}
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return h5py.File(self.directory / f"{name}.h5")

    def test_an_elastic_ball_strikes_the_table_once_a_period(self):
        for arch in ARCHITECTURES:
            with self.subTest(arch=arch), self.run_on(arch, BALL) as file:
                f = file["f"][()]
                self.assertEqual([word.decode() for word in file["impact_word"][()]], ["L"] * f.size)
                np.testing.assert_array_equal(file["impacts_per_period"][:, 0], 1.0)
                np.testing.assert_array_equal(file["status"][()], 0)
                np.testing.assert_allclose(file["multiplier_re"][:, 0], 1 - 2 * f, atol=1e-9)
                np.testing.assert_allclose(file["multiplier_im"][:, 0], 2 * np.sqrt(f * (1 - f)), atol=1e-9)

    def test_motion_that_strikes_a_stop_at_the_section_has_the_power_of_the_closed_form(self):
        for arch in ARCHITECTURES:
            for late in (0.0, 1e-15, -1e-15, 1e-14, -1e-14, 1e-12, -1e-12, 1e-10, -1e-10, 1e-6):
                with self.subTest(arch=arch, late=late), self.run_on(
                    arch, BETWEEN.format(phase=4.765596808014069 + late)
                ) as file:
                    self.assertEqual(file["impact_word"][()].decode(), "LU")
                    self.assertEqual(file["status"][()], 0)
                    np.testing.assert_array_equal(file["impacts_per_period"][()], [1, 1])
                    power = 0.75 * SPEED**2 / (2 * math.pi)
                    self.assertAlmostEqual(file["impact_power"][()] / power, 1, delta=1e-11)
                    product = file["multiplier_re"][0] * file["multiplier_re"][1]
                    self.assertAlmostEqual(product, 0.5**4 * math.exp(-0.4 * math.pi), delta=1e-12)
                    self.assertEqual(file["impact_tau"].size, 2)
                    last = file["impact_tau"][-1]
                    self.assertLessEqual(last, 2 * math.pi * (1 + 1e-12))
                    if abs(late) < 1e-13:  # it counts at the end of the period
                        self.assertAlmostEqual(last, 2 * math.pi, delta=1e-11)

    def test_a_certificate_of_another_word_is_not_reproduced(self):
        """Between these stops rounding decides which of two motions, mirror images but for them, a start ends in."""
        for arch in ARCHITECTURES:
            with self.subTest(arch=arch):
                with self.run_on(arch, TWO_MOTIONS) as file:
                    word = file["impact_word"][()].decode()
                done = self.clatter("certify", "scene.h5")
                if done.returncode == 0:
                    _, certificate, _ = map(json.loads, done.stdout.splitlines())
                    self.assertEqual(certificate["word"], word)
                else:
                    self.assertEqual(done.returncode, 1, done.stderr)
                    self.assertIn("1 not reproduced", done.stderr)
                    self.assertEqual(done.stdout, "")

    def test_a_mass_that_sticks_beside_0_has_the_period_it_has_elsewhere(self):
        for shift in (0.0, 0.001):
            load = 0.6064131049344343 + 1488.578099595049 * shift
            text = SPOOL.format(load=load, shift=shift, upper=0.001016 + shift)
            with self.subTest(shift=shift), self.run_on("scalar", text) as file:
                self.assertEqual(file["impact_word"][()].decode(), "LLLLSUS")
                self.assertEqual(file["period_ratio"][()], 1)


if __name__ == "__main__":
    unittest.main()
