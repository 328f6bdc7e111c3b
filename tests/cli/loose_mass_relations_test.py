"""A loose mass in a housing: relations between the motions of random scenes, and its balances of energy and momentum.

Environment: CLATTER, the program.
"""

import functools
import math
import random
import unittest

import numpy as np

from loose_mass_test import SPIRAL, LooseMass, response, text_of

LENGTHS = ("x0", "loose_x0", "loose_gap", "loose_lower", "loose_upper", "base_amplitude")
SPEEDS = ("v0", "loose_v0")
ACCELERATIONS = ("f", "load", "loose_load")
LEVELS = ("loose_friction", "loose_friction_static")  # forces that a mirror leaves
STIFFNESSES = ("loose_wall_stiffness_lower", "loose_wall_stiffness_upper")
RESTITUTIONS = tuple(f"loose_R{law}_{side}" for law in ("", "_exponent") for side in ("lower", "upper"))
THRESHOLDS = tuple(f"loose_R_{law}_{side}" for law in ("reference_speed", "below") for side in ("lower", "upper"))


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
    powers |= {key: (1, 1) for key in THRESHOLDS}
    powers |= {key: (1, 2) for key in ACCELERATIONS + LEVELS} | {key: (0, 2) for key in ("stiffness", *STIFFNESSES)}
    factors = {key: length**p * rate**q for key, (p, q) in powers.items()}
    return {key: value * factors.get(key, 1) for key, value in scene.items()}


def mirrored(scene):
    swapped = {
        key.replace("lower", "UPPER").replace("upper", "lower").replace("UPPER", "upper"): scene[key] for key in scene
    }
    return {key: -value if key in ACCELERATIONS + SPEEDS + LENGTHS else value for key, value in swapped.items()}


def pushed_as_by_base(scene, b):
    """The scene on the ground, with the force of a base that moves by b sin(nu tau + phase)."""
    k, nu, theta = scene["stiffness"], scene["nu"], scene["phase"]
    base, cosine = scene["f"] + b * k, 2 * b * scene["h"] * nu
    pushed = {"f": math.hypot(base, cosine), "phase": theta + math.atan2(cosine, base)}
    start = {"x0": scene["x0"] + b * math.sin(theta), "v0": scene["v0"] + b * nu * math.cos(theta)}
    return {**scene, **pushed, **start}


def in_scenes(count=5):
    """Makes a test of a relation that holds for each of so many random scenes."""

    def decorate(test):
        @functools.wraps(test)
        def of_all(self):
            for seed in range(count):
                with self.subTest(seed=seed):
                    test(self, self.drawn(seed))

        return of_all

    return decorate


class Relations(LooseMass):
    drawn = staticmethod(drawn)

    @staticmethod
    def R_at(scene, key, speeds):
        """The restitution of a wall at the speeds of impacts."""
        return np.full(len(speeds), scene[key])

    def assert_same(self, one, other, *, length=1.0, rate=1.0, side=1, shift=0.0, tolerance=1e-10):
        """Two runs are one motion, in other units of length and time, mirrored, or shifted."""
        self.assertGreater(len(one["impact_tau"]), 1)
        np.testing.assert_array_equal(other["impact_stop"], side * one["impact_stop"])
        expected = {name: side * length * one[name] + (shift if name == "x" else 0) for name in "xz"}
        speeds = ("v", "w", "impact_v_before", "impact_v_after")
        expected |= {name: side * length * rate * one[name] for name in speeds}
        expected |= {name: one[name] / rate for name in ("tau", "impact_tau")}
        for name, values in expected.items():
            np.testing.assert_allclose(other[name], values, atol=tolerance * np.nanmax(np.abs(values)), err_msg=name)

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
        same = (
            *RESTITUTIONS,
            *THRESHOLDS,
            "loose_wall_damping_lower",
            "loose_wall_damping_upper",
            "loose_load",
            "phase",
        )
        machine = {key: si[key] for key in (*LENGTHS, *SPEEDS, *same) if key in si}
        machine |= {"mass": mass, "stiffness": si["stiffness"] * mass, "damping": 2 * si["h"] * mass}
        machine |= {"force": si["f"] * mass, "load": si["load"] * mass, "frequency": si["nu"] / (2 * math.pi)}
        machine |= {key: si[key] * mass for key in LEVELS + STIFFNESSES if key in si}
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
        b, nu, theta = 0.4, scene["nu"], scene["phase"]
        one, other = self.transient(pushed_as_by_base(scene, b)), {**scene, "base_amplitude": b}
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
            ball |= {f"stop_{side}": scene[f"loose_{side}"]}
        ball |= {key.removeprefix("loose_"): value for key, value in scene.items() if key.startswith("loose_R")}
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
        losses = data["loss_damping"] + data["loss_impact"].sum() + data.get("loss_friction", 0.0)
        np.testing.assert_allclose(data["work_in"] - losses, energy[1] - energy[0], atol=1e-12)
        self.assertLess(abs(data["energy_residual"]), 1e-12)
        for i, (side, key) in enumerate(((-1, "loose_R_lower"), (1, "loose_R_upper"))):
            speeds = np.abs(data["impact_v_before"][data["impact_stop"] == side])
            R = self.R_at(scene, key, speeds)
            lost = eps / (1 + eps) * np.sum((1 - R * R) * speeds**2) / 2
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
