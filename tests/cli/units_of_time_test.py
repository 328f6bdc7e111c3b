"""Rounding is judged alike in all units of time, and over flights of any length.

Where rounding decides which impacts follow, motion is grazing. That is proved from bounds of how differences of motions
grow, in which displacements and velocities are compared: without a spring, or with next to none, no unit of time is the
natural one but that of the force, and differences grow as the time in a flight, not exponentially.

Environment: CLATTER, the program; CLATTER_COINCIDENCES, COUNT or COUNT:SEED of the random scenes.
"""

import math
import os
import random
import tempfile
import unittest

import numpy as np
from coincidences import IN_LANES, SETTLE, contracts, multipliers, multipliers_apart, of_seed, run
from keys_at_zero import LONGEST, between_stops, losing
from random_scenes import compliant_scenes, is_beyond_soft, rubbed
from scene_runs import Program, numbers
from starts_on_contacts import bouncing

CLATTER = os.environ["CLATTER"]
COUNT, SEED = of_seed(os.environ.get("CLATTER_COINCIDENCES"), 30, 640)

# h, nu, x0, v0, upper stop, R below and above; the multipliers of the motion without a spring, but for rounding.
BETWEEN_STOPS = [
    (0.2958632253802645, 1.617904993702697, -0.22263653779489395, -0.006994727279789337, 0.22395146252190584)
    + (0.26255858579293945, 0.4174459638814544, -0.540864),
    (0.02969655907120912, 1.527584322830543, -0.13293048617998543, -0.004654503630009299, 0.1418904159242447)
    + (0.3897551038189436, 0.34292781057875005, -0.614533),
]


class Units(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.program = Program(CLATTER, folder.name)

    def test_a_weak_spring_makes_no_motion_graze(self):
        for h, nu, x0, v0, stop, below, above, multiplier in BETWEEN_STOPS:
            sweep = f"[scene]\nh = {h!r}\nf = 1\nnu = {nu!r}\nx0 = {x0!r}\nv0 = {v0!r}\nxs = {stop!r}\n"
            sweep += f"R_lower = {below!r}\nR_upper = {above!r}\n[sweep]\nstiffness = [1e-15, 1e-12, 1e-9, 0]\n"
            runs = self.program.points(sweep, 4, SETTLE, IN_LANES)
            self.assertEqual(set(runs["status"]), {0})
            np.testing.assert_allclose(runs["multiplier_re"][:, 0], multiplier, atol=3e-6)
            np.testing.assert_allclose(runs["multiplier_re"][:, 1], 0, atol=1e-8)

    def test_a_ball_may_fly_for_many_periods(self):
        """From an impact at the phase theta it flies for n periods T: cos(theta) = n T g (1 - R) / (2 f (1 + R)). With
        f sin(theta) = g (1 + R^2) / (1 + R)^2 the trace of its map is 0, and the determinant R^2."""
        for R in (0.9, 0.5):
            flights = [1, 2, 5, 12, 20, 30, 45, 60]
            cosine = [math.pi * n * (1 - R) / (1 + R) for n in flights]
            sine = (1 + R**2) / (1 + R) ** 2
            columns = {
                "f": [math.hypot(c, sine) for c in cosine],
                "phase": [math.atan2(sine, c) for c in cosine],
                "v0": [2 * math.pi * n * R / (1 + R) for n in flights],
            }
            lists = "".join(f"{key} = {numbers(values)}\n" for key, values in columns.items())
            scene = f"[scene]\nstiffness = 0\nload = -1\nstop_lower = 0\nstop_upper = inf\nR = {R}\n"
            runs = self.program.points(
                f'{scene}[sweep]\n{lists}linked = "f, phase, v0"\n', len(flights), SETTLE, IN_LANES
            )
            with self.subTest(R=R):
                self.assertEqual(set(zip(runs["status"], runs["impact_word"])), {(0, b"L")})
                np.testing.assert_array_equal(runs["period_ratio"], flights)
                np.testing.assert_allclose(runs["multiplier_re"], 0, atol=1e-9)
                np.testing.assert_allclose(np.abs(runs["multiplier_im"]), R, atol=1e-9)

    def settled(self, scenes):
        """Those scenes whose motion contracts, from where they settled, and is clear of all stops there. Motion of more
        periods rests once in many stretches, in between which last digits grow."""
        runs = run(self.program, scenes, IN_LANES + "trajectory = 2\n")
        for i, scene in enumerate(scenes):
            begun = scene.changed(x0=float(runs["x"][i, 0]), v0=float(runs["v"][i, 0]))
            clear = scene.stop_lower + 1e-6 < begun.x0 < scene.stop_upper - 1e-6 and not is_beyond_soft(begun)
            if contracts(runs, i) and clear and runs["period_ratio"][i] <= LONGEST:
                yield begun

    def test_motion_without_a_spring_is_told_alike_in_all_units(self):
        draw = random.Random(f"units {SEED}")
        kinds = [
            lambda: losing(draw, between_stops(draw)),
            lambda: bouncing(draw),
            lambda: rubbed(draw, losing(draw, between_stops(draw))),
            lambda: compliant_scenes(1, draw.random())[0],
        ]
        scenes = [kinds[i % len(kinds)]().changed(stiffness=0.0) for i in range(COUNT)]
        begun = list(self.settled(scenes))
        self.assertGreater(len(begun), COUNT // 5)
        reference = run(self.program, begun, IN_LANES)
        for faster in (1e-4, 1e-2, 1e2, 1e4):
            runs = run(self.program, [scene.in_time(faster) for scene in begun], IN_LANES)
            for i, scene in enumerate(begun):
                with self.subTest(faster=faster, scene=scene):
                    for name in ("status", "impact_word", "period_ratio"):
                        self.assertEqual(runs[name][i], reference[name][i], name)
                    np.testing.assert_allclose(runs["x_max"][i], reference["x_max"][i], atol=1e-9)
                    apart = multipliers_apart(multipliers(runs, i), multipliers(reference, i))
                    self.assertLess(apart, 1e-5)


if __name__ == "__main__":
    unittest.main()
