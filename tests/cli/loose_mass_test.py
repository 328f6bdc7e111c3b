"""A loose mass in a housing: closed forms of its motion, relations between scenes, and what is refused beside it.

Environment: CLATTER, the program.
"""

import functools
import math
import random
import unittest

import h5py
import numpy as np

from runs import RunTest

ATTRACTING = {"h": 0.005, "f": 0.01, "nu": 1.0, "loose_mass": 0.02, "loose_gap": 0.4, "loose_R": 0.8}
SPIRAL = {"h": 0.02, "f": 0.3, "nu": 1.3, "loose_mass": 0.05, "loose_gap": 1.9, "loose_R": 0.6}
QUIET = {"h": 0.05, "f": 0.02, "nu": 1.0, "loose_mass": 0.02, "loose_gap": 0.4, "loose_R": 0.8}
LENGTHS = ("x0", "loose_x0", "loose_gap", "loose_lower", "loose_upper", "base_amplitude")
SPEEDS = ("v0", "loose_v0")
ACCELERATIONS = ("f", "load", "loose_load")


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
    def observed(self, scene, time, observe, section="scene", sweep=None, name="out"):
        """The variables of an output, by name."""
        with h5py.File(self.run_clatter(text_of(scene, time, observe, section, sweep), name)) as file:
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


def drawn(seed):
    """A random scene of moderate numbers."""
    draw = random.Random(seed).uniform
    scene = {"h": draw(0.02, 0.3), "stiffness": draw(0.5, 2), "f": draw(0.3, 1), "nu": draw(0.6, 1.6)}
    scene |= {"phase": draw(0, 6), "load": draw(-0.2, 0.2), "x0": draw(-0.5, 0.5), "v0": draw(-0.5, 0.5)}
    scene |= {"loose_mass": draw(0.01, 0.5), "loose_lower": draw(-1, -0.3), "loose_upper": draw(0.3, 1)}
    scene |= {"loose_R_lower": draw(0.3, 0.8), "loose_R_upper": draw(0.3, 0.8), "loose_load": draw(-0.1, 0.1)}
    return scene | {"loose_x0": draw(-0.3, 0.3), "loose_v0": draw(-0.5, 0.5)}


def scaled(scene, length=1.0, rate=1.0):
    """The same motion in other units."""
    powers = {key: (1, 0) for key in LENGTHS} | {key: (1, 1) for key in SPEEDS} | {"h": (0, 1), "nu": (0, 1)}
    powers |= {key: (1, 2) for key in ACCELERATIONS} | {"stiffness": (0, 2)}
    factors = {key: length**p * rate**q for key, (p, q) in powers.items()}
    return {key: value * factors.get(key, 1) for key, value in scene.items()}


def mirrored(scene):
    swapped = {
        key: scene[key.replace("lower", "UPPER").replace("upper", "lower").replace("UPPER", "upper")] for key in scene
    }
    return {key: -value if key in ACCELERATIONS + SPEEDS + LENGTHS else value for key, value in swapped.items()}


def in_scenes(count=8):
    """Makes a test of a relation that holds for each of so many random scenes."""

    def decorate(test):
        @functools.wraps(test)
        def of_all(self):
            for seed in range(count):
                with self.subTest(seed=seed):
                    test(self, drawn(seed))

        return of_all

    return decorate


class Relations(LooseMass):
    def assert_same(self, one, other, *, length=1.0, rate=1.0, side=1, shift=0.0, tolerance=1e-10):
        """Two runs are one motion, in other units of length and time, mirrored, or shifted."""
        self.assertGreater(len(one["impact_tau"]), 1)
        np.testing.assert_array_equal(other["impact_stop"], side * one["impact_stop"])
        expected = {name: side * length * one[name] + (shift if name == "x" else 0) for name in "xz"}
        speeds = ("v", "w", "impact_v_before", "impact_v_after")
        expected |= {name: side * length * rate * one[name] for name in speeds}
        expected |= {name: one[name] / rate for name in ("tau", "impact_tau")}
        for name, values in expected.items():
            np.testing.assert_allclose(other[name], values, atol=tolerance * np.abs(values).max(), err_msg=name)

    @in_scenes()
    def test_a_mirrored_scene_moves_the_other_way(self, scene):
        self.assert_same(self.transient(scene), self.transient(mirrored(scene)), side=-1)

    @in_scenes()
    def test_units_of_length_and_time_change_nothing(self, scene):
        one = self.transient(scene)
        other = self.transient(scaled(scene, 0.03, 7.0), 30.0 / 7.0)
        self.assert_same(one, other, length=0.03, rate=7.0)

    @in_scenes()
    def test_a_machine_is_its_scene_in_SI(self, scene):
        mass = 0.35
        si = scaled(scene, 2e-3, 90.0)
        walls = ("loose_R_lower", "loose_R_upper", "loose_load")
        machine = {key: si[key] for key in (*LENGTHS, *SPEEDS, *walls, "phase") if key in si}
        machine |= {"mass": mass, "stiffness": si["stiffness"] * mass, "damping": 2 * si["h"] * mass}
        machine |= {"force": si["f"] * mass, "load": si["load"] * mass, "frequency": si["nu"] / (2 * math.pi)}
        machine |= {"loose_mass": f"{1e3 * mass * si['loose_mass']!r} g"}
        one = self.transient(scene, energy=True)
        other = self.transient(machine, 30.0 / 90.0, kind="machine", energy=True)
        self.assert_same(one, other, length=2e-3, rate=90.0)
        unit = mass * (2e-3 * 90.0) ** 2
        for name in ("work_in", "loss_damping", "loss_impact"):
            np.testing.assert_allclose(other[name], unit * one[name], rtol=1e-9, atol=1e-12 * unit)

    @in_scenes()
    def test_a_load_shifts_the_main_mass(self, scene):
        pushed = {"load": scene["load"] + 0.7 * scene["stiffness"], "x0": scene["x0"] + 0.7}
        self.assert_same(self.transient(scene), self.transient({**scene, **pushed}), shift=0.7)

    @in_scenes()
    def test_a_run_that_is_continued_is_one_run(self, scene):
        whole, first = self.transient(scene), self.transient(scene, 15.0, 4)
        start = {"x0": first["x"][-1], "v0": first["v"][-1], "phase": scene["phase"] + 15.0 * scene["nu"]}
        start |= {"loose_x0": first["z"][-1], "loose_v0": first["w"][-1]}
        second = self.transient({**scene, **{key: float(value) for key, value in start.items()}}, 15.0, 4)
        second["impact_tau"] = second["impact_tau"] + 15.0
        for name in (*"xvzw", "impact_tau", "impact_v_before", "impact_stop"):
            kept = first[name][:-1] if name in "xvzw" else first[name]
            joined = np.concatenate([kept, second[name]])
            np.testing.assert_allclose(joined, whole[name], rtol=1e-9, atol=1e-9, err_msg=name)

    @in_scenes()
    def test_a_shaken_base_is_a_force(self, scene):
        b, k, nu, theta = 0.4, scene["stiffness"], scene["nu"], scene["phase"]
        base, cosine = scene["f"] + b * k, 2 * b * scene["h"] * nu
        pushed = {"f": math.hypot(base, cosine), "phase": theta + math.atan2(cosine, base)}
        pushed |= {"x0": scene["x0"] + b * math.sin(theta), "v0": scene["v0"] + b * nu * math.cos(theta)}
        one, other = self.transient({**scene, **pushed}), {**scene, "base_amplitude": b}
        self.assert_same(one, self.transient(other, frame="absolute"))
        relative = self.transient(other)
        np.testing.assert_allclose(relative["x"], one["x"] - b * np.sin(theta + nu * one["tau"]), atol=1e-10)
        np.testing.assert_allclose(relative["z"], one["z"], atol=1e-10)

    @in_scenes()
    def test_the_lightest_loose_mass_is_a_ball_between_shaken_walls(self, scene):
        scene.update(stiffness=1.0, load=0.0, loose_mass=1e-11)
        scene["x0"], scene["v0"] = (float(value) for value in response(scene, scene["phase"]))
        gain = math.hypot(scene["x0"], scene["v0"] / scene["nu"])
        ball = {"stiffness": 0.0, "load": scene["loose_load"], "nu": scene["nu"], "base_amplitude": gain}
        ball |= {"phase": math.atan2(scene["x0"], scene["v0"] / scene["nu"]), "x0": scene["loose_x0"]}
        ball |= {"v0": scene["loose_v0"]}
        for side in ("lower", "upper"):
            ball |= {f"R_{side}": scene[f"loose_R_{side}"], f"stop_{side}": scene[f"loose_{side}"]}
        one, other = self.transient(scene), self.transient(ball)
        for name, of_ball in (("z", "x"), ("w", "v")):
            np.testing.assert_allclose(one[name], other[of_ball], atol=1e-7)
        fast, fast_balls = (np.abs(data["impact_v_before"]) > 0.05 for data in (one, other))  # not those in a chatter
        for name in ("impact_tau", "impact_v_before", "impact_stop"):
            np.testing.assert_allclose(one[name][fast], other[name][fast_balls], atol=1e-7)

    @in_scenes(4)
    def test_between_close_walls_both_masses_move_as_one(self, scene):
        total = 1 + scene["loose_mass"]
        single = {key: scene[key] / total for key in ("h", "stiffness", "f")}
        single |= {key: scene[key] for key in ("nu", "phase", "x0", "v0")} | {"stop_lower": -math.inf}
        single["load"] = (scene["load"] + scene["loose_mass"] * scene["loose_load"]) / total
        one = self.observed(single, {"mode": "transient", "duration": 20.0}, {"trajectory": 21})
        for gap in (1e-2, 1e-3, 1e-4, 1e-5):
            start = {"loose_lower": -gap, "loose_upper": gap, "loose_x0": 0.0, "loose_v0": 0.0}
            x = self.transient({**scene, **start}, 20.0, 21)["x"]
            self.assertLess(np.abs(x - one["x"]).max(), 2 * gap)

    @in_scenes(6)
    def test_multipliers_are_those_of_neighbouring_runs(self, scene):
        steady = self.steady(scene)
        if steady["status"] != 0:
            return
        names, step = {"x0": "x", "v0": "v", "loose_x0": "z", "loose_v0": "w"}, 1e-6

        def after_a_period(**start):
            data = self.transient({**scene, **start}, float(steady["period"]), 2)
            return np.array([data[name][-1] for name in names.values()])

        start = {key: float(steady[name][0]) for key, name in names.items()}
        np.testing.assert_allclose(after_a_period(**start), list(start.values()), atol=1e-10)
        pairs = [[after_a_period(**{**start, key: start[key] + d}) for d in (step, -step)] for key in names]
        jacobian = np.array([(more - less) / (2 * step) for more, less in pairs]).T
        told = np.poly(steady["multiplier_re"] + 1j * steady["multiplier_im"])
        np.testing.assert_allclose(told, np.poly(jacobian), atol=1e-5)

    @in_scenes()
    def test_forces_losses_and_growth_balance(self, scene):
        data = self.transient(scene, samples=2, energy=True)
        k, eps = scene["stiffness"], scene["loose_mass"]
        energy = (data["v"] ** 2 + k * data["x"] ** 2 + eps * (data["v"] + data["w"]) ** 2) / 2
        losses = data["loss_damping"] + data["loss_impact"].sum()
        np.testing.assert_allclose(data["work_in"] - losses, energy[1] - energy[0], atol=1e-12)
        self.assertLess(abs(data["energy_residual"]), 1e-12)
        for i, (side, key) in enumerate(((-1, "loose_R_lower"), (1, "loose_R_upper"))):
            R, speeds = scene[key], data["impact_v_before"][data["impact_stop"] == side]
            lost = eps / (1 + eps) * (1 - R * R) * np.sum(speeds**2) / 2
            np.testing.assert_allclose(data["loss_impact"][i], lost, rtol=1e-9, atol=1e-13)

    @in_scenes()
    def test_energies_count_from_after_an_impact_at_the_start(self, scene):
        data = self.transient({**scene, "loose_x0": scene["loose_upper"], "loose_v0": 0.7}, energy=True)
        self.assertLess(abs(data["energy_residual"]), 1e-12)

    @in_scenes()
    def test_momentum_grows_by_the_loads_alone(self, scene):
        scene.update(h=0.0, f=0.0, stiffness=1e-14, loose_R_lower=1.0, loose_R_upper=1.0)
        data, eps = self.transient(scene), scene["loose_mass"]
        momentum = data["v"] + eps * (data["v"] + data["w"])
        grown = momentum[0] + (scene["load"] + eps * scene["loose_load"]) * data["tau"]
        np.testing.assert_allclose(momentum, grown, atol=1e-10)

    def test_100000_elastic_impacts_keep_the_energy(self):
        scene = {"h": 0.0, "f": 0.0, "loose_mass": 0.3, "loose_gap": 0.05, "x0": 1.0, "v0": 0.5, "loose_v0": 0.7}
        data = self.transient(scene, 4e4, 101)
        self.assertGreater(len(data["impact_tau"]), 100000)
        energy = (data["v"] ** 2 + data["x"] ** 2 + 0.3 * (data["v"] + data["w"]) ** 2) / 2
        np.testing.assert_allclose(energy, energy[0], rtol=1e-11)

    def test_a_sweep_has_the_motions_of_its_points_with_any_number_of_threads(self):
        masses, time = [0.02, 0.05, 0.2], {"mode": "transient", "duration": 30.0}
        observe = {"extrema": True, "impacts": True}
        scene = {key: value for key, value in SPIRAL.items() if key != "loose_mass"}
        text = text_of(scene, time, observe, sweep={"loose_mass": masses})
        one, two = (self.run_clatter(text, f"{n}", threads=n).read_bytes() for n in (1, 2))
        self.assertEqual(one, two)
        swept = self.observed(scene, time, observe, sweep={"loose_mass": masses})
        for i, mass in enumerate(masses):
            alone = self.observed({**scene, "loose_mass": mass}, time, observe)
            for name in ("x_max", "y_min", "z_max", "impact_speed"):
                np.testing.assert_array_equal(swept[name][i], alone[name])


if __name__ == "__main__":
    unittest.main()
