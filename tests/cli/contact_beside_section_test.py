"""A contact just beside the section, or in a chatter there, is told as it is elsewhere.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import numpy as np

from section_runs import ARCHITECTURES, SectionRuns

# Started on one of the last impacts of a chatter, which changes the velocity by as little as other digits do.
IN_CHATTER = """[scene]
h = 1.2440021130988383
f = 1
nu = 0.34684042129831383
phase = {phase!r}
load = -0.21593529589229954
stiffness = 3.4166308488997794
x0 = -0.3386140876299618
v0 = {v0!r}
stop_lower = -0.3386140876299618
R_lower = 0.4271790919494374
stop_upper = 0.3386140876299618
R_upper = 1
[observe]
impacts = true
energy = true
impact_log = true
"""

# An impact 1e-12 before the section in the middle of two periods, with a force far faster than the spring.
FAST = """[scene]
f = 1.420218683353993
nu = 2.990999595377999
phase = {phase!r}
load = -0.9465593852990681
stiffness = 0.008373068009154674
x0 = 0
v0 = 0.7466482663076476
stop_lower = 0
R_lower = 0.5570643151095679
[observe]
word = true
stability = true
"""


class ContactBesideSection(SectionRuns):
    def test_a_start_within_a_chatter_counts_its_impacts_once(self):
        impulses, impacts = [], []
        for phase, v0 in ((0.0, 0.1), (-1.4312914999277142, 1.2938477239647594e-07), (-1.43129149, 1e-7)):
            with self.run_on("scalar", IN_CHATTER.format(phase=phase, v0=v0)) as file:
                impulses.append(file["impulse"][0])
                impacts.append(file["impacts_per_period"][0])
        np.testing.assert_allclose(impulses, impulses[0], rtol=1e-9)
        self.assertEqual(impacts, [17, 17, 17])

    def test_an_impact_just_before_a_section_within_the_period_is_no_graze(self):
        for arch in ARCHITECTURES:
            for late in (0, 1e-13, -1e-13, 3e-13, 1e-12, -1e-12, 1e-11, 0.1):
                with self.subTest(late=late), self.run_on(arch, FAST.format(phase=0.3956919432535936 + late)) as file:
                    self.assertEqual((file["status"][()], file["impact_word"][()]), (0, b"LL"), arch)
                    np.testing.assert_allclose(file["multiplier_re"][()], -0.15769962, atol=1e-7)


if __name__ == "__main__":
    unittest.main()
