"""Forces of other shapes than a sine: closed forms, relations between runs, and what is refused.

Environment: CLATTER, the program.
"""

import cmath
import math
import unittest

import h5py
import numpy as np

from command_line import CommandLine
from force_scenes import SHAPES, Force
from loose_mass_test import LooseMass, matrix, text_of

BOUNCING = {"h": 0.05, "f": 0.6, "nu": 0.9, "phase": 0.4, "stop_lower": -0.6, "stop_upper": 0.9, "R": 0.7}


def shaped(shape, duty=0.5, rise=0.25):
    force = Force(shape, duty, rise)
    return {key: getattr(force, key) for key in force.keys_of_force()}


def order_of(force, n):
    """The complex amplitude of s at the n-th order, mean value of 2 s e^{-i n theta}, by quadrature in each piece."""
    knots = sorted({0.0, 1.0, *force.knots()})
    nodes, weights = np.polynomial.legendre.leggauss(24)
    total = 0j
    for begin, end in zip(knots, knots[1:]):
        for at, weight in zip((begin + end) / 2 + (end - begin) / 2 * nodes, (end - begin) / 2 * weights):
            total += 2 * weight * force.derivatives(at, (begin + end) / 2, 1)[0] * cmath.exp(-2j * math.pi * n * at)
    return total


class ClosedForms(LooseMass):
    def test_each_order_of_the_response_is_that_of_the_order_of_the_force(self):
        for shape in SHAPES:
            for h, nu in ((0.05, 0.37), (1.3, 2.1)):
                with self.subTest(shape, h=h):
                    scene = {"h": h, "f": 0.4, "nu": nu, "phase": 0.0, "xs": 50.0, **shaped(shape, 0.3, 0.2)}
                    data = self.steady(scene, harmonics=6, harmonics_method="exact")
                    force = Force(shape, 0.3, 0.2)
                    for n in range(7):
                        known = 0.4 * order_of(force, n) / (1 - (n * nu) ** 2 + 2j * h * n * nu) / (1 if n else 2)
                        told = data["x_amplitude"][n] if n else abs(data["x_amplitude"][0])
                        self.assertAlmostEqual(told, abs(known), delta=1e-11)

    def test_motion_under_a_square_wave_without_contact_repeats_by_two_exponentials(self):
        h, nu, duty = 0.1, 0.7, 0.35
        period = 2 * math.pi / nu
        up, down = matrix(h, duty * period), matrix(h, (1 - duty) * period)
        rest = np.array([0.4, 0.0])  # the equilibrium under f, and under -f with the other sign
        begin = np.linalg.solve(np.eye(2) - down @ up, down @ (rest - up @ rest) - rest + down @ rest)
        scene = {"h": h, "f": 0.4, "nu": nu, "xs": 9.0, **shaped("square", duty)}
        data = self.steady(scene)
        np.testing.assert_allclose([data["x"][0], data["v"][0]], begin, rtol=1e-11)
        product = np.prod(data["multiplier_re"] + 1j * data["multiplier_im"])
        self.assertAlmostEqual(product.real, math.exp(-2 * h * period), delta=1e-14)

    def test_a_ball_is_pushed_by_pulses(self):
        """Between knots it flies along parabolas, and on the plate it rests until the next pulse lifts it."""
        scene = {"stiffness": 0.0, "f": 3.0, "nu": 2 * math.pi, "load": -1.0, "stop_lower": 0.0, "R": 0.0, "x0": 0.0}
        data = self.transient({**scene, **shaped("pulse", 0.25)}, 3.0, 13)  # lifted for a quarter, then it falls
        lift, speed = 0.5 * 2 * 0.25**2, 2 * 0.25
        falls = speed + math.sqrt(speed**2 + 2 * lift)
        self.assertGreater(falls, 0.75)  # beyond the next pulse, at which it has come so far:
        x = lift + speed * 0.75 - 0.75**2 / 2
        v = speed - 0.75
        np.testing.assert_allclose(data["x"][:5], [0, lift, lift + speed * 0.25 - 0.25**2 / 2, 0.1875, x], atol=1e-14)
        np.testing.assert_allclose(data["v"][4], v, atol=1e-14)

    def test_a_jump_ends_a_rest(self):
        scene = {"h": 0.1, "f": 1.0, "nu": 1.0, "load": 0.0, "stop_lower": 0.2, "R": 0.0, "x0": 0.2, "phase": math.pi}
        data = self.transient({**scene, **shaped("square")}, math.pi, 3)  # pressed for half a period
        np.testing.assert_array_equal(data["x"], [0.2, 0.2, 0.2])
        data = self.transient({**scene, **shaped("square")}, 1.5 * math.pi, 4)
        begin = np.array([0.2 - 1.0, 0.0])  # from the equilibrium under the force
        np.testing.assert_allclose([data["x"][-1] - 1.0, data["v"][-1]], matrix(0.1, math.pi / 2) @ begin, atol=1e-14)


class OfOneMotion(LooseMass):
    def compare(self, one, other, atol=1e-10, duration=40.0):
        mine, its = self.transient(one, duration, 9), self.transient(other, duration, 9)
        self.assertGreater(len(mine["impact_tau"]), 3)
        for name in ("x", "v", "impact_tau", "impact_v_before"):
            np.testing.assert_allclose(mine[name], its[name], rtol=0, atol=atol)

    def compare_methods(self, scene):
        """General methods come near to the exact one, the nearer the shorter their steps."""
        one = self.transient(scene, 12.0)

        def off(method):
            time = {"mode": "transient", "duration": 12.0}
            text = text_of(scene, time, {"trajectory": 7}) + f"[integrator]\n{method}\n"
            with h5py.File(self.run_clatter(text, "other", options=("--force",))) as other:
                return np.abs(other["x"][()] - one["x"]).max()

        self.assertLess(off('method = "dopri5"\ntolerance = 1e-12'), 1e-8)
        coarse, fine = (off(f'method = "moreau"\nstep = {step}') for step in (1e-3, 1e-5))
        self.assertLess(fine, 1e-2)
        self.assertLess(fine, coarse / 10)


class Relations(OfOneMotion):
    def test_a_square_wave_is_twice_the_pulse_less_its_half(self):
        for duty in (0.5, 0.2):
            pulse = {**BOUNCING, "f": 2 * BOUNCING["f"], "load": -BOUNCING["f"]}
            self.compare({**BOUNCING, **shaped("square", duty)}, {**pulse, **shaped("pulse", duty)})

    def test_a_trapezoid_that_rises_for_half_of_the_period_is_a_triangle(self):
        self.compare({**BOUNCING, **shaped("triangle")}, {**BOUNCING, **shaped("trapezoid", rise=0.5)})

    def test_a_trapezoid_that_hardly_rises_is_a_square_wave(self):
        self.compare(
            {**BOUNCING, **shaped("square")}, {**BOUNCING, **shaped("trapezoid", rise=1e-9)}, atol=1e-5, duration=12.0
        )

    def test_the_opposite_of_a_square_wave_is_one_of_the_other_duty_later(self):
        later = {**BOUNCING, "phase": BOUNCING["phase"] - 2 * math.pi * 0.3, **shaped("square", 0.7)}
        self.compare({**BOUNCING, "f": -BOUNCING["f"], **shaped("square", 0.3)}, later)

    def test_all_methods_tell_the_same(self):
        for shape in SHAPES:
            with self.subTest(shape):
                scene = {**BOUNCING, **shaped(shape, 0.3, 0.1)}
                self.compare_methods(scene)

    def test_a_machine_has_the_motion_of_its_scene(self):
        mass, length, rate = 0.4, 3e-3, 70.0
        machine = {"mass": mass, "stiffness": mass * rate**2, "damping_ratio": 0.05, "phase": 0.4, "R": 0.7}
        machine |= {"force": 0.6 * mass * rate**2 * length, "frequency": 0.9 * rate / (2 * math.pi)}
        machine |= {"stop_lower": -0.6 * length, "stop_upper": 0.9 * length, **shaped("half-sine", 0.3)}
        one = self.transient({**BOUNCING, **shaped("half-sine", 0.3)}, 20.0)
        other = self.transient(machine, 20.0 / rate, kind="machine")
        np.testing.assert_allclose(other["x"], length * one["x"], atol=1e-10 * length)

    def test_an_axis_of_the_duty_has_the_motions_of_its_points(self):
        duties = [0.2, 0.35, 0.5]
        del (scene := {**BOUNCING, **shaped("pulse")})["force_duty"]
        time = {"mode": "transient", "duration": 20.0}
        swept = self.observed(scene, time, {"trajectory": 5}, sweep={"force_duty": duties})
        for i, duty in enumerate(duties):
            alone = self.observed(
                {**scene, "force_duty": duty}, time, {"trajectory": 5}, name="alone", options=("--force",)
            )
            np.testing.assert_array_equal(swept["x"][i], alone["x"])

    def test_starts_have_no_mirror_images_under_pulses_though_the_first_point_has_no_force(self):
        scene = {"h": 0.05, "nu": 0.9, "xs": 0.8, "R": 0.7, **shaped("pulse", 0.3)}
        axes = {"f": [0.0, 0.6], "phase": [0.0, math.pi], "x0": [-0.3, 0.3], "v0": [-1.0, 1.0]}
        swept = self.observed(scene, {"max_periods": 500}, {"extrema": True}, sweep=axes)
        for index in np.ndindex(2, 2, 2, 2):
            own = {key: values[i] for (key, values), i in zip(axes.items(), index)}
            alone = self.observed(
                {**scene, **own}, {"max_periods": 500}, {"extrema": True}, name="one", options=("--force",)
            )
            np.testing.assert_allclose(swept["x_max"][index], alone["x_max"], atol=1e-9, err_msg=str(own))


class Derivatives(LooseMass):
    def test_by_a_share_they_are_limits_of_differences_if_the_section_lies_on_the_knot_that_it_moves(self):
        scene = {"f": 0.6, "h": 0.05, "nu": 0.9, "xs": 0.8, "R": 0.7}
        housed = {**scene, "loose_mass": 0.1, "loose_gap": 0.4, "loose_R": 0.6}
        for own, key, share, phase in (
            ({**scene, "force_shape": "square"}, "force_duty", 0.3, 2 * math.pi * 0.3),
            ({**scene, "force_shape": "half-sine"}, "force_duty", 0.6, 2 * math.pi * 0.6),
            ({**scene, "force_shape": "trapezoid", "xs": 5.0}, "force_rise", 0.3, 0.3 * math.pi),
            ({**without_stops(housed), "force_shape": "square"}, "force_duty", 0.3, 2 * math.pi * 0.3),
        ):
            with self.subTest(own):
                own = {**own, "phase": phase}
                told = self.steady({**own, key: share}, sensitivity=key, extrema=True)
                self.assertEqual(told["status"], 0)
                step = 1e-5
                low, high = (self.steady({**own, key: share + side * step}, extrema=True) for side in (-1, 1))
                for result in ("x_min", "x_max"):
                    slope = (high[result] - low[result]) / (2 * step)
                    self.assertAlmostEqual(told[f"d_{result}_d_{key}"], slope, delta=1e-4 * (1 + abs(slope)))


def without_stops(scene):
    return {key: value for key, value in scene.items() if key not in ("xs", "R")}


BASE = "[scene]\nf = 1\nxs = 1\n"


class Refused(CommandLine):
    def test_what_no_shape_goes_with_is_refused_with_its_remedy(self):
        square = BASE + 'force_shape = "square"\n'
        for text, words in (
            (square + "base_amplitude = 0.2\n", ("base_amplitude", "leave out one of them")),
            (square + "stop_amplitude = 0.2\n", ("stop_amplitude", "leave out one of them")),
            (square + '[branch]\nalong = "nu"\nrange = [0.5, 1.5]\n', ("branch", "sweep.follow")),
            (square + '[observe]\nsensitivity = "force_rise"\n', ("force_rise", "leave it out")),
            (square + '[observe]\nsensitivity = "base_amplitude"\n', ("base_amplitude", "leave it out")),
            (square + '[observe]\nsensitivity = "force_factor"\n', ("force_factor", "leave it out")),
            (BASE + 'force_shape = "squares"\n', ("square", "half-sine")),
            (BASE + '[sweep]\nforce_shape = ["square", "pulse"]\n', ("force_shape", "one run for each")),
            (square + "force_duty = 1\n", ("force_duty", "> 0 and < 1")),
            (square + "force_duty = 0\n", ("force_duty", "> 0 and < 1")),
            (BASE + 'force_shape = "trapezoid"\nforce_rise = 0.6\n', ("force_rise", "<= 0.5")),
        ):
            with self.subTest(text=text):
                self.write("bad.toml", text)
                command = "branch" if "[branch]" in text else "run"
                for word in words:
                    self.assert_refused(2, word, command, "bad.toml", "-o", "bad.h5")

    def test_a_share_that_the_shape_has_not_is_warned_of(self):
        for line, remedy in (("force_duty = 0.3", "pulse"), ("force_rise = 0.3", "trapezoid")):
            self.write("a.toml", BASE + f'force_shape = "triangle"\n{line}\n[observe]\nextrema = true\n')
            told = self.clatter("plan", "a.toml")
            self.assertIn(line.split(" ")[0], told.stdout + told.stderr)
            self.assertIn(remedy, told.stdout + told.stderr)


if __name__ == "__main__":
    unittest.main()
