"""A loose mass beside stops, soft stops and dry friction of the main mass: relations between motions of random scenes.

Environment: CLATTER, the program.
"""

import math
import random
import unittest

import numpy as np

from loose_mass_relations_test import ACCELERATIONS, LENGTHS, SPEEDS, Relations, drawn

OWN = {  # powers of length and of rate in the units of keys
    "stop_lower": (1, 0),
    "stop_upper": (1, 0),
    "stop_stiffness_lower": (0, 2),
    "stop_stiffness_upper": (0, 2),
    "stop_damping_lower": (0, 0),
    "stop_damping_upper": (0, 0),
    "friction": (1, 2),
    "friction_static": (1, 2),
}


def with_own_events(seed):
    """A random scene with a loose mass, in which something meets the main mass, too."""
    scene = drawn(seed)
    random_numbers = random.Random(f"{seed} beside stops")
    draw = random_numbers.uniform
    scene |= {"stop_lower": draw(-1, -0.55), "stop_upper": draw(0.55, 1), "R_lower": draw(0.3, 0.8)}
    scene |= {"R_upper": draw(0.3, 0.8), "stiffness": random_numbers.choice([scene["stiffness"], 0.0])}
    for side in ("lower", "upper"):
        if random_numbers.random() < 0.4:
            scene |= {f"stop_stiffness_{side}": draw(5, 50), f"stop_damping_{side}": draw(0, 1)}
            del scene[f"R_{side}"]
    if random_numbers.random() < 0.4:
        scene["friction"] = draw(0.02, 0.1)
        scene["friction_static"] = scene["friction"] * draw(1, 1.5)
    return scene


def scaled(scene, length=1.0, rate=1.0):
    """The same motion in other units."""
    powers = {key: (1, 0) for key in LENGTHS} | {key: (1, 1) for key in SPEEDS} | {"h": (0, 1), "nu": (0, 1)}
    powers |= {key: (1, 2) for key in ACCELERATIONS} | {"stiffness": (0, 2)} | OWN
    factors = {key: length**p * rate**q for key, (p, q) in powers.items()}
    return {key: value * factors.get(key, 1) for key, value in scene.items()}


def mirrored(scene):
    other_side = {"lower": "upper", "upper": "lower"}
    turned = ACCELERATIONS + SPEEDS + LENGTHS + ("stop_lower", "stop_upper")
    swapped = {}
    for key, value in scene.items():
        stem, _, side = key.rpartition("_")
        swapped[f"{stem}_{other_side[side]}" if side in other_side else key] = -value if key in turned else value
    return swapped


class BesideStops(Relations):
    def of_scenes(self, check, count=24):
        for seed in range(count):
            scene = with_own_events(seed)
            with self.subTest(seed=seed, scene=scene):
                check(scene)

    def test_w_is_the_rate_of_z(self):
        """Between impacts; and 0 as long as a wall presses the loose mass."""
        pressed = 0

        def check(scene):
            nonlocal pressed
            data = self.transient(scene, samples=6001)
            step = data["tau"][1]
            walls = np.isin(data["z"], (scene["loose_lower"], scene["loose_upper"]))
            stays = walls[:-2] & walls[1:-1] & walls[2:]
            pressed += stays.sum()
            np.testing.assert_array_equal(data["w"][1:-1][stays], 0.0)
            rate = (data["z"][2:] - data["z"][:-2]) / (2 * step)
            times = data["tau"][1:-1]
            nearest = np.abs(times[:, None] - data["impact_tau"][None, :]).min(axis=1, initial=math.inf)
            clear = nearest > 1.5 * step
            self.assertGreater(clear.mean(), 0.5)
            np.testing.assert_allclose(data["w"][1:-1][clear], rate[clear], atol=0.02)

        self.of_scenes(check)
        self.assertGreater(pressed, 1000)

    def test_a_mirrored_scene_moves_the_other_way(self):
        self.of_scenes(
            lambda scene: self.assert_same(self.transient(scene, 12.0), self.transient(mirrored(scene), 12.0), side=-1)
        )

    def test_units_of_length_and_time_change_nothing(self):
        def check(scene):
            one, other = self.transient(scene, 12.0), self.transient(scaled(scene, 0.03, 7.0), 12.0 / 7.0)
            self.assert_same(one, other, length=0.03, rate=7.0)

        self.of_scenes(check)

    def test_a_run_that_is_continued_is_one_run(self):
        def check(scene):
            whole, first = self.transient(scene, 12.0), self.transient(scene, 6.0, 4)
            start = {"x0": first["x"][-1], "v0": first["v"][-1], "phase": scene["phase"] + 6.0 * scene["nu"]}
            start |= {"loose_x0": first["z"][-1], "loose_v0": first["w"][-1]}
            second = self.transient({**scene, **{key: float(value) for key, value in start.items()}}, 6.0, 4)
            for name in "xvzw":
                joined = np.concatenate([first[name][:-1], second[name]])
                np.testing.assert_allclose(joined, whole[name], rtol=1e-8, atol=1e-8, err_msg=name)

        self.of_scenes(check)


# The relations without stops are run where they stand.
def load_tests(loader, _tests, _pattern):
    names = [name for name in vars(BesideStops) if name.startswith("test_")]
    return unittest.TestSuite(map(BesideStops, names))


if __name__ == "__main__":
    unittest.main()
