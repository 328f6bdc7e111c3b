"""A contact that falls on the stroboscopic section counts once, whatever rounding says.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import math
import random
import unittest

import numpy as np

from scene_runs import numbers
from section_runs import ARCHITECTURES, SectionRuns

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

# Started on the contact of a loose mass with its upper wall, whose instant a repeat knows to 2e-11.
AT_WALL = """[scene]
h = 0.004714136466759241
f = 1
nu = 0.3788350011145729
x0 = 0.8473262353112411
v0 = -0.2972062657772536
loose_mass = 0.00552989685086747
loose_R = 0.5905463961306159
loose_x0 = 2.7906249450446614
loose_v0 = -0.4572250519550655
loose_lower = 0.0
loose_upper = 2.7906249450446614
[sweep]
phase = {phases}
[observe]
impacts = true
word = true
stability = true
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


# Without a spring and a load, what friction and a stop that takes all leave of a drift just touches the stop.
TOUCHING = """[scene]
h = 1.3624291968558035
f = -0.4302328379882873
nu = 1.3667133584030076
stiffness = 0
x0 = 0.1
v0 = 1
stop_lower = -0.14
stop_upper = 0.13753842955603268
R_upper = 0
friction = 0.16402757632721277
[sweep]
phase = "linspace(0, 6, 61)"
[observe]
word = true
stability = true
"""

# The section falls into the chatter before a rest, under dry friction.
RESTING = """[scene]
h = 0.004393983116743453
f = 1
nu = 0.6901860784684432
phase = 2.4396100162658794
x0 = 0.3426117537545702
v0 = -6.418748442359656e-08
xs = 0.3426117537545702
R = 0.4822594183194273
friction = 0.25094344695650295
friction_static = 0.2695299116220043
[observe]
period = true
word = true
stability = true
extrema = true
"""

# The spring pushes away, so differences grow, and an impact falls on the section.
PUSHED = """[scene]
h = 1.2789816137916914
f = 1
nu = 0.6168788609007022
phase = {phase!r}
stiffness = -0.013943075856218914
x0 = 1.3357405414356462
v0 = -0.09735920898090801
stop_lower = -inf
stop_upper = 1.3357405414356462
R_upper = 0.9491864839579807
[observe]
period = true
word = true
stability = true
"""

# Of seven periods, whose sections 50 digits tell; a touch of the upper stop falls on one of them.
LONG = """[scene]
h = 0.0087249928297371
f = 7.21860320588062
nu = 4.968396161551015
phase = {phase!r}
load = -1.314301614747237
x0 = 0.41848203830390907
v0 = 1.5089397841454633
stop_lower = -0.534302578048116
stop_stiffness_lower = 83.36453902938992
stop_damping_lower = 3.58397163689816
stop_upper = 0.41848203830390907
stop_stiffness_upper = 50.04006275102643
stop_damping_upper = 4.926592433602558
[time]
max_periods = 600
[observe]
period = true
word = true
stability = true
"""


class ContactOnSection(SectionRuns):
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

    def test_harmonics_of_the_velocity_are_those_of_the_displacement_from_any_section_on(self):
        harmonics = 'harmonics = 3\nharmonics_method = "exact"\n'
        for late in (0.0, 1e-15, -1e-15, 1e-13, -1e-13, 1e-12, -1e-12, 1e-10, -1e-10):
            text = BETWEEN.format(phase=4.765596808014069 + late) + harmonics
            with self.subTest(late=late), self.run_on("scalar", text) as file:
                np.testing.assert_allclose(file["v_amplitude"][()], np.arange(4) * file["x_amplitude"][()], atol=1e-13)

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

    def test_a_drift_that_a_stop_has_ended_meets_it_without_speed(self):
        """So it has no impact, wherever a section divides the way to the stop."""
        with self.run_on("scalar", TOUCHING) as file:
            told = set(zip(file["status"][()], file["impact_word"][()]))
            self.assertEqual(told, {(0, b"(U)")})

    def test_a_slip_that_ends_just_at_a_stop_rests_there(self):
        """v0^2 = 2 friction (stop - x0) without any other force, and up to a hundred sections on the way."""
        draw, ways = random.Random(64), []
        while len(ways) < 200:
            friction, way = 10 ** draw.uniform(-4, 0), 10 ** draw.uniform(-1, 2)
            stop = draw.choice([0.0, 1.0, draw.uniform(-1, 5)])
            speed = math.sqrt(2 * friction * way)
            if speed / friction < 200 * math.pi:
                ways.append((stop - way, stop, speed, friction))
        x0, stop, v0, friction = (numbers(values) for values in zip(*ways))
        sweep = f"x0 = {x0}\nstop_upper = {stop}\nv0 = {v0}\nfriction = {friction}\n"
        scene = "[scene]\nstiffness = 0\nf = 0\nR = 0.5\n"
        linked = 'linked = "x0, stop_upper, v0, friction"\n'
        with self.run_on("scalar", f"{scene}[sweep]\n{sweep}{linked}[observe]\nword = true\n") as file:
            told = zip(ways, file["status"][()], file["impact_word"][()])
            self.assertEqual([each for each in told if each[1:] != (0, b"(U)")], [])

    def test_a_section_within_the_chatter_before_a_rest_under_friction_changes_nothing(self):
        """In 50 digits, too, which decide the period of such motion."""
        with self.run_on("scalar", RESTING) as file:
            told = [file[name][()] for name in ("status", "impact_word", "period_ratio", "x_min", "x_max")]
            self.assertEqual(told, [0, b"L*U*", 1, -0.3426117537545702, 0.3426117537545702])
            np.testing.assert_array_equal(file["multiplier_re"][()], 0)

    def test_motion_pushed_away_from_the_middle_that_begins_just_beside_an_impact_is_periodic(self):
        multipliers = []
        for late in (-1e-6, -1e-12, -1e-13, 0.0, 1e-13, 1e-12, 3e-12, 1e-6):
            with self.subTest(late=late), self.run_on("scalar", PUSHED.format(phase=3.123746643560396 + late)) as file:
                self.assertEqual(file["status"][()], 0)
                self.assertEqual(file["impact_word"][()].decode(), "U")
                self.assertEqual(file["period_ratio"][()], 2)
                multipliers.append(file["multiplier_re"][0])
        np.testing.assert_allclose(multipliers, multipliers[0], atol=1e-7)

    def test_a_touch_on_a_section_of_a_long_period_counts_once(self):
        for late in (0.0, 0.3, -0.3):
            with self.subTest(late=late), self.run_on("scalar", LONG.format(phase=-2.3559059098058412 + late)) as file:
                self.assertEqual(file["period_ratio"][()], 7)
                self.assertEqual(sorted(file["impact_word"][()].decode()), sorted("LLULULULULULU"))
                self.assertAlmostEqual(file["multiplier_re"][0], -0.890984343, 6)

    def test_a_contact_with_a_wall_counts_once_beside_the_section(self):
        for arch in ARCHITECTURES:
            phases = [2.333371513769045 + beside for beside in (0, 1e-14, -1e-13, 1e-12, -1e-12, 1e-11, 1e-8)]
            with self.run_on(arch, AT_WALL.format(phases=numbers(phases))) as file:
                self.assertEqual(set(file["impact_word"][()]), {b"LU"}, arch)
                np.testing.assert_allclose(np.nanmax(file["multiplier_re"][()], axis=1), 0.3118471919, rtol=1e-9)


if __name__ == "__main__":
    unittest.main()
