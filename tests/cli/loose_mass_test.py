"""A loose mass in a housing: closed forms of its motion.

Environment: CLATTER, the program.
"""

import math
import unittest

import h5py
import numpy as np

from runs import RunTest

ATTRACTING = {"h": 0.005, "f": 0.01, "nu": 1.0, "loose_mass": 0.02, "loose_gap": 0.4, "loose_R": 0.8}
SPIRAL = {"h": 0.02, "f": 0.3, "nu": 1.3, "loose_mass": 0.05, "loose_gap": 1.9, "loose_R": 0.6}
QUIET = {"h": 0.05, "f": 0.02, "nu": 1.0, "loose_mass": 0.02, "loose_gap": 0.4, "loose_R": 0.8}


def text_of(scene, time, observe, section="scene", sweep=None):
    """A configuration as text."""
    sections = {section: scene, "sweep": sweep or {}, "time": time, "observe": observe}
    lines = []
    for name, keys in sections.items():
        lines += [f"[{name}]"] * bool(keys)
        for key, value in keys.items():
            lines.append(f"{key} = {str(value).lower() if isinstance(value, bool) else repr(value)}")
    return "\n".join(lines).replace("'", '"') + "\n"


def matrix(h, time):
    """The map of (x, x') over a time of x'' + 2h x' + x = 0, h < 1."""
    rate, decay = math.sqrt(1 - h * h), math.exp(-h * time)
    c, s = decay * math.cos(rate * time), decay * math.sin(rate * time) / rate
    return np.array([[c + h * s, s], [-s, c - h * s]])


def response(scene, theta):
    """The steady x and x' of the main mass alone at a phase of the force."""
    h, nu = scene["h"], scene["nu"]
    gain = scene["f"] / math.hypot(1 - nu * nu, 2 * h * nu)
    theta -= math.atan2(2 * h * nu, 1 - nu * nu)
    return np.array([gain * math.sin(theta), gain * nu * math.cos(theta)])


def flown(scene, state, theta, time):
    """x and x' of the main mass after a time without an impact."""
    free = matrix(scene["h"], time) @ (state - response(scene, theta))
    return free + response(scene, theta + scene["nu"] * time)


def symmetric(scene):
    """x, x' before and after an impact on the upper wall, z' before it, and the phase of the force then, of symmetric
    motion with two impacts a period. All but the phase are linear in the speed c of the loose mass, and x' jumps by
    2 eps c; half a period turns x and x' round, and the size of the response to the force gives c."""
    h, nu, eps, s = (scene[key] for key in ("h", "nu", "loose_mass", "loose_gap"))
    half = math.pi / nu
    free = np.linalg.solve(matrix(h, half) + np.eye(2), [0, 2 * eps])
    w = 2 * (1 + eps) / (1 + scene["loose_R"])
    p, q = half / 2 - free[0], (1 - w + 2 * eps - free[1]) / nu  # response p c - s, and its x' over nu: q c
    amplitude = scene["f"] / math.hypot(1 - nu * nu, 2 * h * nu)
    c = max(np.roots([p * p + q * q, -2 * p * s, s * s - amplitude**2]).real)
    phase = math.atan2(p * c - s, q * c) + math.atan2(2 * h * nu, 1 - nu * nu)
    return c * half / 2 - s, (1 - w) * c, (1 - w + 2 * eps) * c, w * c, phase


class LooseMass(RunTest):
    def observed(self, scene, time, observe, section="scene", sweep=None, name="out", options=()):
        """The variables of an output, by name."""
        with h5py.File(self.run_clatter(text_of(scene, time, observe, section, sweep), name, options=options)) as file:
            return {
                key: value.asstr()[()] if h5py.check_string_dtype(value.dtype) else value[()]
                for key, value in file.items()
                if isinstance(value, h5py.Dataset) and value.dtype.kind in "fiuO"
            }

    def transient(self, scene, duration=30.0, samples=7, kind="scene", **observe):
        asked = {"trajectory": samples, "impact_log": True, **observe}
        return self.observed(scene, {"mode": "transient", "duration": duration}, asked, kind)

    def steady(self, scene, **observe):
        asked = {"impact_log": True, "trajectory": 2, "period": True, "word": True, "stability": True, **observe}
        return self.observed(scene, {"max_periods": 4000, "tolerance": 1e-14}, asked)


class ClosedForms(LooseMass):
    def test_symmetric_motion_attracts_from_rest(self):
        x, before, after, w, _ = symmetric(ATTRACTING)
        known = (0.180585488325042, -0.0492816268556546, -0.034497138798958, 0.418893828273064)
        np.testing.assert_allclose((x, before, after, w), known, rtol=1e-13)
        data = self.steady(ATTRACTING, extrema=True, impacts=True)
        self.assertEqual(data["status"], 0)
        self.assertEqual(sorted(data["impact_word"]), ["L", "U"])
        np.testing.assert_allclose(data["period"], 2 * math.pi, rtol=1e-15)
        np.testing.assert_array_equal(data["impacts_per_period"], [1, 1])
        side = data["impact_stop"]
        np.testing.assert_allclose(data["impact_v_before"], side * w, rtol=1e-12)
        np.testing.assert_allclose(data["impact_v_after"], -0.8 * side * w, rtol=1e-12)
        limits = (data["z_min"], data["z_max"], data["y_min"], data["y_max"])
        np.testing.assert_allclose(limits, (-0.4, 0.4, -x - 0.4, x + 0.4), rtol=1e-12)
        start = np.array([data["x"][0], data["v"][0]])
        struck = flown(ATTRACTING, start, 0.0, data["impact_tau"][0])
        np.testing.assert_allclose(struck, side[0] * np.array([x, before]), rtol=1e-12, atol=1e-12)
        later = flown(ATTRACTING, side[0] * np.array([x, after]), data["impact_tau"][0], math.pi)
        np.testing.assert_allclose(later, -side[0] * np.array([x, before]), rtol=1e-12)
        self.check_product(ATTRACTING, data)

    def check_product(self, scene, data):
        """Between impacts areas shrink by damping alone, and each impact takes R^2 of them."""
        multipliers = data["multiplier_re"] + 1j * data["multiplier_im"]
        self.assertEqual(multipliers.shape, (4,))
        expected = math.exp(-2 * scene["h"] * data["period"]) * scene["loose_R"] ** (2 * len(data["impact_tau"]))
        np.testing.assert_allclose(np.prod(multipliers), expected, rtol=1e-11)
        return np.abs(multipliers)

    def test_a_spiral_leads_away_from_unstable_symmetric_motion(self):
        x, before, after, w, phase = symmetric(SPIRAL)
        self.assertAlmostEqual(w, 2.123117, delta=1e-6)
        for v0, loose_v0 in ((before, w), (after, -0.6 * w)):  # before the impact, and after it
            start = {"phase": phase, "x0": x, "v0": v0, "loose_x0": 1.9, "loose_v0": loose_v0}
            data = self.steady({**SPIRAL, **start})
            np.testing.assert_allclose(data["impact_v_before"], data["impact_stop"] * w, rtol=1e-11)
            moduli = self.check_product(SPIRAL, data)
            np.testing.assert_allclose(moduli[:2], 1.056775, atol=6e-7)
            self.assertNotEqual(data["multiplier_im"][0], 0)

    def test_it_stays_clear_of_its_walls_or_strikes_them_for_ever(self):
        steady = self.steady(QUIET, extrema=True)
        self.assertEqual((steady["status"], len(steady["impact_tau"]), steady["y_max"]), (0, 0, 0))
        np.testing.assert_allclose(steady["x_max"], 0.2, rtol=1e-12)
        turns = 2 * math.pi
        self.assertEqual(len(self.transient(QUIET, 4000 * turns)["impact_tau"]), 0)
        times = self.transient({**QUIET, "loose_v0": 1e-4}, 4000 * turns)["impact_tau"]
        self.assertGreater(np.sum(times > 3990 * turns), 15)

    def test_sections_and_samples_are_of_one_motion(self):
        data = self.transient(SPIRAL, 12 * 2 * math.pi / 1.3, samples=13, section=5)
        for name in "xvzw":
            np.testing.assert_allclose(data[f"section_{name}"], data[name][:5], rtol=1e-11, atol=1e-11)

    def test_harmonics_are_those_of_the_samples(self):
        data = self.steady(ATTRACTING, harmonics=3, trajectory=20001)
        for name in "xv":
            spectrum = 2 * np.fft.rfft(data[name][:-1])[1:4] / 20000
            np.testing.assert_allclose(data[f"{name}_amplitude"][1:], np.abs(spectrum), atol=1e-5)


if __name__ == "__main__":
    unittest.main()
