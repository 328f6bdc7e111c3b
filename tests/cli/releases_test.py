"""Motion that rests on a stop now and then is told with its period and its impacts, by 60 digits (releases.py).

Environment: CLATTER, the program; CLATTER_RELEASES, COUNT or COUNT:SEED of the random scenes.
"""

import os
import random
import tempfile
import unittest

import numpy as np
from random_scenes import Scene
from releases import LOWER, UPPER, cycle_through
from scene_runs import Program, keys_of

CLATTER = os.environ["CLATTER"]
TIME = 'mode = "steady"\nmax_periods = 2000\n'
OBSERVE = "[observe]\nimpacts = true\nimpact_log = true\nperiod = true\ntrajectory = 2\n"
PERIODIC, GRAZING = 0, 3
MACHINE = Scene(f=1.0, h=0.05, load=-0.3, stop_lower=-0.1, stop_upper=0.05)


def rattling(draw):
    """A scene whose mass rests on its lower stop now and then, mostly chaotic in between."""
    R = draw.uniform(0.5, 0.85)
    return MACHINE.changed(
        h=draw.uniform(0.01, 0.15),
        load=draw.uniform(-0.6, -0.15),
        nu=draw.uniform(1.2, 2.2),
        stiffness=draw.choice([1.0, 1.0, 0.0, 2.0, -0.2]),
        stop_upper=draw.uniform(0.02, 0.2),
        R_lower=R,
        R_upper=R,
    )


class Releases(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.program = Program(CLATTER, folder.name)

    def check(self, scenes, *words):
        """The number of scenes with rests and a period, each of which is right."""
        runs = self.program.run(scenes, TIME, OBSERVE, "--set", "time.max_impacts=1e6", *words)
        checked = 0
        for i, scene in enumerate(scenes):
            rests = runs["rest_fraction"][i]
            if runs["status"][i] not in (PERIODIC, GRAZING) or not rests.sum() > 0 or rests.sum() == 1:
                continue
            with self.subTest(scene=scene):
                cycle = cycle_through(scene, UPPER if rests[1] > 0 else LOWER)
                self.assertIsNotNone(cycle)
                periods, impacts = cycle
                self.assertEqual(runs["period_ratio"][i], periods)
                self.assert_same_impacts(runs.logs[i], scene, periods, impacts)
            checked += 1
        return checked

    def assert_same_impacts(self, log, scene, periods, impacts):
        """Impacts of 60 digits are those of the log, which begins at any section, but for the slowest."""
        log = log[np.abs(log[:, 2]) > 1e-4]
        ours = np.array([impact for impact in impacts if abs(impact[2]) > 1e-4])
        self.assertEqual(len(log), len(ours))
        phases = log[:, 0] * scene.nu / (2 * np.pi)
        off = []
        for first in range(periods):
            times = (ours[:, 0] - first) % periods
            order = np.argsort(times)
            apart = np.abs(times[order] - phases).max() + np.abs(ours[order, 2] - log[:, 2]).max()
            off.append(apart if (ours[order, 1] == log[:, 1]).all() else np.inf)
        self.assertLess(min(off), 1e-8)

    def test_rounding_decides_no_period(self):
        """A mass that comes back to rest by the rounding of its chaotic flights is not periodic for that."""
        scenes = [
            MACHINE.changed(R_lower=0.8, R_upper=0.8, nu=1.625),  # 26 by ball arithmetic; double says 19
            MACHINE.changed(R_lower=0.6, R_upper=0.6, nu=1.575),
            MACHINE.changed(R_lower=0.8, R_upper=0.8, h=0.02, nu=1.675),  # 12, but the last impact was 8e-6 off
            Scene(
                h=0.127, f=1.514, nu=1.015, stiffness=0.0, load=-0.537, stop_lower=-0.2016, stop_upper=0.2016
            ).changed(R_lower=0.76, R_upper=0.76),
        ]
        for words in ([], ["--arch", "scalar"], ["--set", "integrator.effects=all"]):
            self.assertEqual(self.check(scenes, *words), len(scenes))

    def test_starts_are_numbered_by_the_motion_that_is_decided(self):
        scene = MACHINE.changed(R_lower=0.8, R_upper=0.8, nu=1.625)
        fixed = "".join(f"{key} = {value!r}\n" for key, value in keys_of(scene).items() if key != "v0")
        starts = "v0 = [-1.0, -0.3, 0.0, 0.2, 0.7, 1.1]\n"
        runs = self.program.points(f"[scene]\n{fixed}[sweep]\n{starts}", 6, TIME, OBSERVE + "attractor = true\n")
        periods, _ = cycle_through(scene, LOWER)
        self.assertEqual(runs["period_ratio"].tolist(), 6 * [periods])
        self.assertEqual(runs["attractor"].tolist(), 6 * [0])

    def test_random_rests_are_told_as_60_digits_tell_them(self):
        count, _, seed = os.environ.get("CLATTER_RELEASES", "40").partition(":")
        draw = random.Random(int(seed or 4104))
        self.assertGreater(self.check([rattling(draw) for _ in range(int(count))]), int(count) // 8)


if __name__ == "__main__":
    unittest.main()
