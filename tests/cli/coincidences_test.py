"""Where events coincide, runs that write one motion in two ways agree.

Environment: CLATTER, the program; CLATTER_COINCIDENCES, COUNT or COUNT:SEED of the random scenes.
"""

import math
import os
import tempfile
import unittest

import numpy as np
from branch_sets import Sets, branching_scenes
from coincidences import IN_LANES, SETTLE, of_seed
from keys_at_zero import Zeros, zero_scenes
from random_scenes import carrying_scenes
from scene_runs import Program, complex_of, numbers
from starts_on_contacts import ARCHES, Contacts, mixed_scenes

CLATTER = os.environ["CLATTER"]
AT_ONCE = 250
COUNT, SEED = of_seed(os.environ.get("CLATTER_COINCIDENCES"), 32, 6400)


class Coincidences(unittest.TestCase):
    maxDiff = None

    def parts(self):
        for first in range(0, COUNT, AT_ONCE):
            yield min(AT_ONCE, COUNT - first), SEED + first // AT_ONCE

    def test_a_start_on_a_contact_is_one_between(self):
        self.check_contacts(mixed_scenes)

    def test_a_start_with_the_loose_mass_at_a_wall_is_one_between(self):
        self.check_contacts(lambda count, seed: carrying_scenes(max(8, count // 4), seed))

    def check_contacts(self, drawn):
        compared, told = 0, []
        for count, seed in self.parts():
            found = Contacts(CLATTER, drawn(count, seed), seed).failures
            compared += found.compared
            told.append(found.report())
        self.assertEqual("\n".join(filter(None, told)), "")
        self.assertGreater(compared, COUNT // 2)

    def test_a_key_at_zero_gives_what_it_gives_beside_zero(self):
        compared, told = 0, []
        for count, seed in self.parts():
            found = Zeros(CLATTER, zero_scenes(count, seed), seed).failures
            compared += found.compared
            told.append(found.report())
        self.assertEqual("\n".join(filter(None, told)), "")
        self.assertGreater(compared, COUNT // 4)

    def test_branches_begun_again_from_any_of_a_set_are_that_set(self):
        compared, told = 0, []
        for count, seed in self.parts():
            found = Sets(CLATTER, branching_scenes(max(12, count // 4), seed)).failures
            compared += found.compared
            told.append(found.report())
        self.assertEqual("\n".join(filter(None, told)), "")
        self.assertGreater(compared, 5)


class TextbookBall(unittest.TestCase):
    """A ball on a table that is shaken by a force: the orbit of one impact a period, in closed form.

    From a contact at theta it leaves with v, comes back after T = 2 pi with v / R, and cos(theta) brings it there:
    v = R T g / (1 + R), cos(theta) = T g (1 - R) / (2 f (1 + R)). The derivative of the map from impact to impact has
    the determinant R^2 and the trace 1 + R^2 - (1 + R)^2 f sin(theta) / g.
    """

    maxDiff = None

    @staticmethod
    def orbits(R):
        """f, phase, v0 and trace of the stable ones."""
        period = 2 * math.pi
        for f in np.linspace(0.1, 0.9, 33):
            cosine = period * (1 - R) / (2 * f * (1 + R))
            if not cosine <= 1:
                continue
            theta = math.acos(cosine)
            trace = 1 + R**2 - (1 + R) ** 2 * f * math.sin(theta)
            if abs(trace) < 0.98 * (1 + R**2):
                yield float(f), theta, R * period / (1 + R), trace

    def differences(self, R, arch):
        orbits = list(self.orbits(R))
        self.assertTrue(orbits)
        f, phase, v0, traces = zip(*orbits)
        sweep = f"[scene]\nstiffness = 0\nload = -1\nstop_lower = 0\nstop_upper = inf\nR = {R}\n[sweep]\n"
        sweep += f'f = {numbers(f)}\nphase = {numbers(phase)}\nv0 = {numbers(v0)}\nlinked = "f, phase, v0"\n'
        with tempfile.TemporaryDirectory() as folder:
            runs = Program(CLATTER, folder).points(sweep, len(f), SETTLE, IN_LANES, "--arch", arch)
        for i, trace in enumerate(traces):
            told = (runs["status"][i], runs["impact_word"][i].decode(), *runs["impacts_per_period"][i])
            both = [complex_of(runs, i, which) for which in (0, 1)]
            off = [runs["impact_speed"][i, 0] - v0[i] / R, sum(both) - trace, np.prod(both) - R**2]
            if told != (0, "L", 1, 0) or not np.abs(off).max() < 1e-7:
                yield f"R = {R}, f = {f[i]}, phase = {phase[i]}, v0 = {v0[i]}, --arch {arch}: {told}, {both}"

    def test_it_is_told_of_a_start_on_its_impact(self):
        told = [text for R in (1.0, 0.95, 0.9, 0.7) for arch in ARCHES for text in self.differences(R, arch)]
        self.assertEqual("\n".join(told), "")


if __name__ == "__main__":
    unittest.main()
