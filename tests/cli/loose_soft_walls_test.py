"""Soft walls of a loose mass: relations between the motions of random scenes, and their results.

Environment: CLATTER, the program.
"""

import math
import random
import unittest

import h5py
import numpy as np

import loose_friction_test as friction
import loose_mass_relations_test as relations
from loose_mass_test import LooseMass, text_of


def softened(scene, seed):
    """The scene with one soft wall, or two."""
    draw = random.Random(2000 + seed)
    for side in draw.choice((("lower",), ("upper",), ("lower", "upper"), ("lower", "upper"))):
        del scene[f"loose_R_{side}"]
        scene[f"loose_wall_stiffness_{side}"] = math.exp(draw.uniform(0, 6))
        scene[f"loose_wall_damping_{side}"] = draw.choice([0.0, draw.uniform(0, 0.4), draw.uniform(0, 1.5)])
    return scene


def stored(scene, z):
    """The energy that soft walls store."""
    sides = (("lower", -1), ("upper", 1))
    depths = {f"loose_wall_stiffness_{side}": sign * (z - scene[f"loose_{side}"]) for side, sign in sides}
    return sum(scene.get(key, 0.0) * max(0.0, depth) ** 2 / 2 for key, depth in depths.items())


class Soft:
    # of rigid walls, or not of random scenes
    test_the_lightest_loose_mass_is_a_ball_between_shaken_walls = None
    test_between_close_walls_both_masses_move_as_one = None
    test_100000_elastic_impacts_keep_the_energy = None
    test_a_sweep_has_the_motions_of_its_points_with_any_number_of_threads = None

    @relations.in_scenes()
    def test_forces_losses_and_growth_balance(self, scene):
        data = self.transient(scene, samples=2, energy=True)
        k, eps = scene["stiffness"], scene["loose_mass"]
        energy = (data["v"] ** 2 + k * data["x"] ** 2 + eps * (data["v"] + data["w"]) ** 2) / 2
        energy = energy + [stored(scene, z) for z in data["z"]]
        losses = data["loss_damping"] + data["loss_impact"].sum() + data.get("loss_friction", 0.0)
        np.testing.assert_allclose(data["work_in"] - losses, energy[1] - energy[0], atol=1e-11)
        self.assertLess(abs(data["energy_residual"]), 1e-11)

    @relations.in_scenes()
    def test_momentum_grows_by_the_loads_alone(self, scene):
        scene.update(h=0.0, f=0.0, stiffness=1e-14)
        data, eps = self.transient(scene), scene["loose_mass"]
        momentum = data["v"] + eps * (data["v"] + data["w"])
        grown = momentum[0] + (scene["load"] + eps * scene["loose_load"]) * data["tau"]
        np.testing.assert_allclose(momentum, grown, atol=1e-10)


class Relations(Soft, relations.Relations):
    @staticmethod
    def drawn(seed):
        return softened(relations.drawn(seed), seed)


class RelationsOfRubbing(Soft, friction.Relations):
    @staticmethod
    def drawn(seed):
        return softened(friction.rubbing(seed), seed)


class Results(LooseMass):
    SCENE = {"h": 0.05, "f": 0.5, "nu": 1.2, "loose_mass": 0.2, "loose_gap": 0.6, "loose_wall_stiffness": 30.0}
    TIME = {"mode": "transient", "duration": 40.0}

    def test_a_restitution_is_the_damping_that_has_it(self):
        R = 0.6
        loss = -math.log(R)
        low, high = 0.0, 1.0
        for _ in range(60):
            zeta = (low + high) / 2
            lost = 2 * zeta * math.acos(zeta) / math.sqrt(1 - zeta * zeta)
            low, high = (zeta, high) if lost < loss else (low, zeta)
        one = self.transient(self.SCENE | {"loose_wall_R": R})
        other = self.transient(self.SCENE | {"loose_wall_damping": zeta})
        for name in "xvzw":
            np.testing.assert_allclose(other[name], one[name], atol=1e-9)

    def test_a_damping_with_a_unit_is_a_coefficient(self):
        mass, kappa, eps = 0.5, 400.0, 0.25
        machine = {"mass": mass, "stiffness": 50.0, "damping": 0.4, "force": 2.0, "frequency": 1.7}
        machine |= {"loose_mass": eps * mass, "loose_gap": 0.02, "loose_wall_stiffness": kappa}
        reduced = mass * eps / (1 + eps)
        coefficient = 2 * 0.3 * math.sqrt(kappa * reduced)
        one = self.transient(machine | {"loose_wall_damping": 0.3}, 10.0, kind="machine")
        other = self.transient(machine | {"loose_wall_damping": f"{coefficient!r} N s/m"}, 10.0, kind="machine")
        self.assertGreater(len(one["impact_tau"]), 3)
        for name in "xvzw":
            np.testing.assert_allclose(other[name], one[name], atol=1e-12)

    def test_contact_with_walls_has_its_time_and_its_force(self):
        asked = {"impacts": True, "trajectory": 400001, "word": True}
        data = self.observed(self.SCENE | {"loose_wall_damping": 0.1}, self.TIME, asked)
        z, w, gap = data["z"], data["w"], self.SCENE["loose_gap"]
        damper = 2 * 0.1 * math.sqrt(30.0 * 0.2 / 1.2)
        for i, sign in enumerate((-1, 1)):
            force = np.where(sign * z > gap, 30.0 * (sign * z - gap) + damper * sign * w, 0.0)
            self.assertAlmostEqual(data["contact_force_max"][i], force.max(), delta=1e-3 * force.max())
            self.assertAlmostEqual(data["contact_fraction"][i], np.mean(force > 0), delta=1e-4)

    def test_beside_stops_the_walls_have_results_of_their_own(self):
        scene = self.SCENE | {"stop_upper": 0.5, "R_upper": 0.7}
        data = self.observed(scene, self.TIME, {"impacts": True, "impact_log": True})
        self.assertNotIn("contact_fraction", data)
        for i, side in enumerate((-2, 2)):
            counted = np.count_nonzero(data["impact_stop"] == side)
            self.assertEqual(data["wall_impacts_per_period"][i], counted)
        self.assertGreater(data["wall_contact_fraction"].min(), 0)
        self.assertGreater(data["wall_contact_force_max"].min(), 0)

    def test_without_a_force_a_load_comes_to_rest_in_the_wall_that_balances_it(self):
        eps, kappa, load = 0.3, 30.0, -0.4
        scene = {"f": 0.0, "h": 0.1, "x0": 0.5, "loose_mass": eps, "loose_lower": -0.5, "loose_upper": 0.7}
        scene |= {"loose_load": load, "loose_wall_stiffness": kappa, "loose_wall_damping": 0.2}
        data = self.observed(scene, {}, {"extrema": True})
        self.assertEqual(data["status"], 0)
        np.testing.assert_allclose((data["z_min"], data["z_max"]), -0.5 + eps * load / kappa, atol=1e-9)
        np.testing.assert_allclose((data["x_min"], data["x_max"]), eps * load, atol=1e-9)

    def test_the_configuration_of_a_file_is_read_again(self):
        text = text_of(self.SCENE | {"loose_wall_R": 0.6}, self.TIME, {"extrema": True})
        one = self.run_clatter(text, "one")
        with h5py.File(one) as file:
            again = self.run_clatter(file.attrs["config"], "again")
        self.assertEqual(one.read_bytes(), again.read_bytes())

    def test_masses_that_friction_lets_go_as_one_from_a_soft_wall_share_the_jump_of_the_force(self):
        """They gain the momentum that the force gives less the kinetic friction, though they part at once."""
        scene = {"h": 0.0, "stiffness": 0.0, "f": -1.0, "friction": 0.3, "friction_static": 0.4}
        scene |= {"loose_mass": 0.5, "loose_lower": -0.2, "loose_upper": 0.2, "loose_wall_stiffness_lower": 40.0}
        release, time = math.asin(0.4), 0.2
        gained = math.cos(release) - math.cos(release + time) - 0.3 * time
        for depth in (0.0005, 0.0002):
            own = {**scene, "loose_x0": -0.2 - depth, "loose_friction": 0.03}
            data = self.transient(own, release + time, 2)
            self.assertGreater(abs(data["w"][-1]), 1e-4)
            momentum = data["v"][-1] + 0.5 * (data["v"][-1] + data["w"][-1])
            self.assertAlmostEqual(momentum, -gained, delta=1e-13)

    def test_a_start_may_lie_beyond_a_soft_wall(self):
        data = self.observed(self.SCENE | {"loose_x0": 0.7}, self.TIME, {"trajectory": 5})
        self.assertEqual(data["z"][0], 0.7)


if __name__ == "__main__":
    unittest.main()
