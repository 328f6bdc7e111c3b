"""Harmonics of the place of a loose mass in its housing, z, and of z'.

Environment: CLATTER, the program.
"""

import math
import unittest

import numpy as np

from loose_mass_beside_stops_test import with_own_events
from loose_mass_relations_test import drawn, in_scenes, mirrored, pushed_as_by_base, scaled
from loose_mass_test import ATTRACTING, QUIET, LooseMass, symmetric

LETTERS = "xvzw"
TRANSIENT = {"mode": "transient", "duration": 20.0}
STEADY = {"max_periods": 4000, "tolerance": 1e-14}
FRAMES = ("relative", "absolute")


def coefficients(data, letter):
    """Complex ones: z = Z_0 + 2 Re sum Z_k e^{ik Omega tau}."""
    waves = data[f"{letter}_amplitude"][1:] / 2 * np.exp(1j * data[f"{letter}_phase"][1:])
    return np.concatenate([data[f"{letter}_amplitude"][:1], waves])


def waves_of(data, times):
    """e^{-ik Omega tau} at each time, shape [harmonic, time]."""
    return np.exp(-1j * np.outer(np.arange(len(data["harmonic"])) * data["base_frequency"], times))


def trapezoids(data, letter):
    """The integrals over the samples of a trajectory by the trapezoidal rule, over its length."""
    parts = waves_of(data, data["tau"]) * data[letter]
    return (parts.sum(axis=1) - (parts[:, 0] + parts[:, -1]) / 2) / (len(data["tau"]) - 1)


def errors_of(data, letter, steps):
    """How far the trapezoidal rule of so many steps may be off: h^2/8 times the variation of the slope, as of z, whose
    slope jumps, or h/2 times that of the values, as of z', which jumps; over the length."""
    length = data["tau"][-1]
    h, sample, rates = length / steps, data["tau"][1], np.arange(len(data["harmonic"])) * data["base_frequency"]
    w = np.abs(data["w"]).sum() * sample
    jumps = np.abs(np.diff(data["w"])).sum() + abs(data["w"][-1] - data["w"][0])
    if letter == "w":
        return h / 2 * (jumps + rates * w) / length
    return h**2 / 8 * (jumps + 2 * rates * w + rates**2 * np.abs(data["z"]).sum() * sample) / length


class HousingHarmonics(LooseMass):
    drawn = staticmethod(drawn)

    def exact(self, scene, time, highest=6, kind="scene", **observe):
        asked = {"harmonics": highest, "harmonics_method": "exact", **observe}
        return self.observed(scene, time, asked, kind)

    def sampled(self, scene, time, samples, highest=6):
        return self.observed(scene, time, {"harmonics": highest, "harmonics_samples": samples})

    def assert_same(self, one, other, letters, factors=(1, 1), tolerance=1e-10):
        """`other` has the coefficients of `one`, times a factor each."""
        for letter, factor in zip(letters, factors):
            expected = factor * coefficients(one, letter)
            allowed = tolerance * np.abs(expected).max()
            np.testing.assert_allclose(coefficients(other, letter), expected, atol=allowed, rtol=0, err_msg=letter)


class ClosedForms(HousingHarmonics):
    def test_symmetric_motion_has_triangles_less_the_response_to_its_impacts(self):
        """y runs to and fro between -(x + s) and x + s, and x answers the force and two impacts a period."""
        x, before, after, _, phase = symmetric(ATTRACTING)
        data = self.exact(ATTRACTING, STEADY, 9)
        h, f, s = (ATTRACTING[key] for key in ("h", "f", "loose_gap"))
        k = np.arange(1, 10, 2)
        on_upper = np.exp(-1j * k * phase)  # the impact on the upper wall, at nu = 1 from the phase 0 on
        jumps = 2 * (after - before) * on_upper / (2 * math.pi)
        of_x = (jumps + np.where(k == 1, -0.5j * f, 0)) / (1 - k**2 + 2j * h * k)
        of_z = 4 * (x + s) / (math.pi * k) ** 2 * on_upper - of_x
        np.testing.assert_allclose(coefficients(data, "x")[k], of_x, atol=1e-12)
        np.testing.assert_allclose(coefficients(data, "z")[k], of_z, atol=1e-12)
        np.testing.assert_allclose(coefficients(data, "w")[k], 1j * k * of_z, atol=1e-11)
        np.testing.assert_allclose(coefficients(data, "z")[::2], 0, atol=1e-13)

    def test_a_mass_that_a_wall_always_presses_stays_in_its_place(self):
        pressed = {"h": 0.1, "f": 0.2, "nu": 0.9, "loose_mass": 0.5, "loose_lower": -0.3, "loose_upper": 0.7}
        pressed |= {"loose_load": -3.0, "loose_x0": -0.3, "loose_R": 0.5}
        for time in (STEADY, TRANSIENT):
            for data in (self.exact(pressed, time, 3), self.sampled(pressed, time, 64, 3)):
                np.testing.assert_allclose(coefficients(data, "z"), [-0.3, 0, 0, 0], atol=2e-16)
                np.testing.assert_allclose(coefficients(data, "w"), 0, atol=2e-16)
                self.assertGreater(data["x_amplitude"][1], 0.1)

    def test_one_that_floats_has_the_harmonics_of_the_main_mass(self):
        for place in (0.0, 0.1):
            for data in (
                self.exact(scene := {**QUIET, "loose_x0": place}, STEADY, 3),
                self.sampled(scene, STEADY, 64, 3),
            ):
                np.testing.assert_allclose(coefficients(data, "z"), [place, *-coefficients(data, "x")[1:]], atol=1e-13)
                np.testing.assert_allclose(coefficients(data, "w")[1:], -coefficients(data, "v")[1:], atol=1e-13)

    @in_scenes(24)
    def test_periodic_motion_follows_from_its_impacts(self, scene):
        """y is a parabola between impacts, which alone change y': by the share of the heavier mass in that of z'."""
        data = self.exact({**scene, "loose_load": 0.0}, STEADY, 200, impact_log=True, impacts=True, period=True)
        if data["status"] != 0 or np.any(data["rest_fraction"] > 0):
            return
        jumps = (data["impact_v_after"] - data["impact_v_before"]) / (1 + scene["loose_mass"])
        rates = np.arange(1, 201) * data["base_frequency"]
        of_y = -(waves_of(data, data["impact_tau"])[1:] @ jumps) / rates**2 / data["period"]
        expected = of_y - coefficients(data, "x")[1:]
        np.testing.assert_allclose(coefficients(data, "z")[1:], expected, atol=1e-12)
        np.testing.assert_allclose(coefficients(data, "w")[1:] / rates, 1j * expected, atol=1e-12)

    def test_without_a_loose_mass_there_are_none(self):
        data = self.exact({"h": 0.1, "f": -1.0, "R": 0.7, "xs": 0.5}, {})
        self.assertIn("x_amplitude", data)
        self.assertFalse({"z_amplitude", "z_phase", "w_amplitude", "w_phase"} & set(data))


class Samples(HousingHarmonics):
    """Against the trajectory, and by both methods."""

    def check(self, scene, time, **more):
        data = self.exact(scene, time, trajectory=40001, impacts=True, **more)
        sampled = self.sampled(scene, time, 2**14)
        for letter in "zw":
            told, allowed = coefficients(data, letter), errors_of(data, letter, 40000) + 1e-13
            np.testing.assert_array_less(np.abs(trapezoids(data, letter) - told), allowed, letter)
            ends = abs(data[letter][-1] - data[letter][0]) / 2**15  # of the two, samples have one
            allowed = errors_of(data, letter, 2**14) + ends + 1e-13
            np.testing.assert_array_less(np.abs(coefficients(sampled, letter) - told), allowed, letter)
        return data

    @in_scenes(12)
    def test_transients_have_the_harmonics_of_their_samples(self, scene):
        self.check(scene, TRANSIENT)

    @in_scenes(12)
    def test_steady_motion_has_the_harmonics_of_its_samples(self, scene):
        self.check(scene, {"max_periods": 1000, "window": 20})

    def test_motion_beside_stops_and_friction_has_the_harmonics_of_its_samples(self):
        pressed = 0
        for seed in range(16):
            scene = with_own_events(seed)
            with self.subTest(seed=seed, scene=scene):
                data = self.check(scene, TRANSIENT)
                pressed += np.any(data["wall_rest_fraction"] > 0)
                self.check(scene, {"max_periods": 200, "window": 10})
        self.assertGreater(pressed, 2)

    def test_by_steps_errors_fall_with_them(self):
        scene = drawn(3)
        exact = self.exact(scene, TRANSIENT)
        for method, key, settings, most in (
            ("dopri5", "tolerance", (1e-8, 1e-11), (1e-6, 1e-9)),
            ("moreau", "step", (1e-3, 1e-4), (0.1, 0.01)),
        ):
            for setting, allowed in zip(settings, most):
                text = {"harmonics": 6, "harmonics_method": "exact"}
                options = ("--set", f"integrator.method={method}", "--set", f"integrator.{key}={setting}")
                data = self.observed(scene, TRANSIENT, text, options=options)
                for letter in "zw":
                    off = np.abs(coefficients(data, letter) - coefficients(exact, letter)).max()
                    self.assertLess(off, allowed, (method, setting, letter))


class Relations(HousingHarmonics):
    @in_scenes()
    def test_a_mirrored_scene_has_the_opposite_harmonics(self, scene):
        one, other = self.exact(scene, TRANSIENT), self.exact(mirrored(scene), TRANSIENT)
        self.assert_same(one, other, "zw", (-1, -1))

    @in_scenes()
    def test_units_of_length_and_time_change_nothing(self, scene):
        one = self.exact(scene, TRANSIENT)
        other = self.exact(scaled(scene, 0.03, 7.0), {**TRANSIENT, "duration": 20.0 / 7.0})
        self.assert_same(one, other, "zw", (0.03, 0.03 * 7.0))

    @in_scenes(4)
    def test_a_machine_has_them_in_SI(self, scene):
        mass, si = 0.35, scaled(scene, 2e-3, 90.0)
        same = ("x0", "v0", "phase", "loose_x0", "loose_v0", "loose_lower", "loose_upper", "loose_load")
        machine = {key: si[key] for key in (*same, "loose_R_lower", "loose_R_upper")}
        machine |= {"mass": mass, "stiffness": si["stiffness"] * mass, "damping": 2 * si["h"] * mass}
        machine |= {"force": si["f"] * mass, "load": si["load"] * mass, "frequency": si["nu"] / (2 * math.pi)}
        machine |= {"loose_mass": f"{1e3 * mass * si['loose_mass']!r} g"}
        one = self.exact(scene, TRANSIENT)
        other = self.exact(machine, {**TRANSIENT, "duration": 20.0 / 90.0}, kind="machine")
        self.assert_same(one, other, "zw", (2e-3, 2e-3 * 90.0))

    @in_scenes()
    def test_a_load_shifts_the_main_mass_alone(self, scene):
        pushed = {"load": scene["load"] + 0.7 * scene["stiffness"], "x0": scene["x0"] + 0.7}
        self.assert_same(self.exact(scene, TRANSIENT), self.exact({**scene, **pushed}, TRANSIENT), "zw")

    @in_scenes()
    def test_a_shaken_base_is_a_force_and_no_frame_changes_them(self, scene):
        b = 0.4
        one = self.exact(pushed_as_by_base(scene, b), TRANSIENT)
        for frame in FRAMES:
            self.assert_same(one, self.exact({**scene, "base_amplitude": b}, TRANSIENT, frame=frame), "zw")
        for frame in FRAMES:
            steady = self.exact({**scene, "base_amplitude": b}, STEADY, frame=frame)
            if steady["status"] == 0:
                rates = np.arange(7) * steady["base_frequency"]
                self.assert_same(
                    {
                        **steady,
                        "w_amplitude": rates * steady["z_amplitude"],
                        "w_phase": steady["z_phase"] + math.pi / 2,
                    },
                    steady,
                    "w",
                )

    def test_a_sweep_has_the_harmonics_of_its_points(self):
        scene = {key: value for key, value in ATTRACTING.items() if key != "loose_mass"}
        masses = [0.0, 0.02, 0.05]
        swept = self.observed(scene, TRANSIENT, {"harmonics": 3}, sweep={"loose_mass": masses})
        for name in ("z_amplitude", "z_phase", "w_amplitude", "w_phase"):
            self.assertTrue(np.isnan(swept[name][0]).all(), name)  # there is none
            for i, mass in enumerate(masses[1:], 1):
                alone = self.observed({**scene, "loose_mass": mass}, TRANSIENT, {"harmonics": 3})
                np.testing.assert_array_equal(swept[name][i], alone[name])


if __name__ == "__main__":
    unittest.main()
