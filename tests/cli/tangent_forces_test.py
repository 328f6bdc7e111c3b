"""Forces that touch zero and don't pass it, or are next to nothing, and what is told of a mass that is held for good.

Environment: CLATTER, the program.
"""

import random
import unittest

import h5py
import numpy as np
from random_scenes import logarithmic
from runs import RunTest, toml

PRESSED = {
    "x0": 1.0,
    "loose_mass": 0.1,
    "loose_gap": 0.3,
    "loose_R": 0.5,
    "loose_load": -1,
    "loose_x0": -0.3,
}  # x = -0.1 + 1.1 cos(t / sqrt(1.1)), and the wall's force is that of 1 - cos(t / sqrt(1.1))
HELD = {"h": 0.1, "f": 0.5, "friction": 1, "xs": 1, "x0": 0.2}


class TangentForces(RunTest):
    def test_a_wall_whose_force_touches_zero_keeps_the_loose_mass(self):
        for method in ("exact", "dopri5", "moreau"):
            for duration in (0.1, 1, 20):
                config = toml(
                    scene=PRESSED,
                    time={"mode": "'transient'", "duration": duration, "max_impacts": 1000},
                    observe={"extrema": True, "impacts": True},
                    integrator={"method": f"'{method}'"},
                )
                with h5py.File(self.run_clatter(config, options=["--force"])) as file, self.subTest(method, t=duration):
                    self.assertEqual(file["status"][()], 2)
                    self.assertEqual(file["impact_total"][()], 0)
                    self.assertGreater(file["rest_fraction"][0], 1 - 1e-6)
                    least = -0.1 + 1.1 * np.cos(min(duration / np.sqrt(1.1), np.pi))
                    allowed = 1e-12 if method == "exact" else 1e-5
                    self.assertAlmostEqual(file["x_min"][()], least, delta=allowed)
                    self.assertAlmostEqual(file["x_max"][()], 1, delta=allowed)

    def test_a_mass_that_friction_holds_for_good_has_one_word(self):
        for sticks in (False, True):
            config = toml(
                scene=HELD, observe={"word": True, "word_sticks": sticks, "attractor": True}, sweep={"x0": [0.2]}
            )
            with h5py.File(self.run_clatter(config, options=["--force"])) as file:
                self.assertEqual([file["impact_word"][0], file["motion_word"][0]], [b"(S)"] * 2)

    def ends(self, keys, points, f):
        """What is told of points that have these keys, under a force of this size."""
        sweep = {key: list(values) for key, values in zip(keys, zip(*points))} | {"linked": f"'{', '.join(keys)}'"}
        config = toml(
            scene={"f": f, "stop_upper": "inf"},
            time={"max_impacts": 2000},
            observe={"extrema": True, "word": True},
            sweep=sweep,
        )
        with h5py.File(self.run_clatter(config, options=["--force"])) as file:
            return [file[name][()] for name in ("status", "impact_word", "x_min", "x_max")]

    def test_a_force_of_nothing_lets_a_mass_come_to_rest_on_a_stop_under_friction(self):
        """Its chatter is over once a flight is too short to advance time; beside the force no height is low."""
        draw = random.Random(300)
        keys = "h stiffness load x0 v0 stop_lower R friction nu".split()
        pressed = []
        for _ in range(100):
            place = [draw.choice([0.0, draw.uniform(0, 0.5)]), draw.choice([0.0, 1.0]), -draw.uniform(0.5, 3)]
            start = [draw.uniform(0, 1), draw.uniform(-1, 1), 0.0, draw.uniform(0.1, 0.95)]
            pressed.append([*place, *start, logarithmic(draw, 1e-8, 0.4), draw.uniform(0.3, 3)])
        for f in (0.0, 1e-320, 1e-300, -1e-170, 1e-100, 1e-30):
            status, word, least, greatest = self.ends(keys, pressed, f)
            self.assertEqual(set(zip(status, word)), {(0, b"(L)")}, f)
            np.testing.assert_array_equal([least, greatest], 0)


if __name__ == "__main__":
    unittest.main()
