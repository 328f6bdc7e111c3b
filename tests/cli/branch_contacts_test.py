"""Contacts that appear and vanish along a branch, so near to each other that a step leaps over them."""

import unittest

import h5py
import numpy as np
from branch_runs import BranchRuns

# Drifts onto a soft stop; of a motion over four periods one contact vanishes 4e-10 beyond its flip. The damper lets go
# of the mass as soon as it stands, but for rounding, once it hardly touches the stop.
HARDLY_TOUCHES = """[scene]
h = 0.19296272573272397
f = -1.1450085394184557
nu = 0.3985951159316171
phase = -2.300255796310338
load = 0.15069725029287895
stiffness = 0.0
x0 = -0.9739345668369341
v0 = 0.7995746497631004
stop_upper = -0.040575695941214296
stop_stiffness_upper = 1824.8842229937757
stop_damping_upper = 0.0048485742627800985
[time]
max_periods = 600
[observe]
impacts = true
[branch]
along = "nu"
range = [0.33880584854187457, 0.45838438332135967]
switch = 1
max_points = 3000
"""
# The branch with a contact turns 5e-14 beside the graze.
TURNS_BESIDE = """[scene]
h = 0.012750263638347886
f = 0.905488098801044
nu = 0.5300149074288455
phase = 1.3797673043696639
stiffness = 1.2398716224085058
x0 = -1.6985283891843688
v0 = -1.7521646305511642
stop_upper = 0.8820520419643458
stop_stiffness_upper = 41752.82470252221
stop_damping_upper = 0.0
[time]
max_periods = 600
[observe]
impacts = true
[branch]
along = "nu"
range = [0.45051267131451866, 0.6095171435431723]
switch = 1
max_points = 3000
"""
# Motion over seven periods that rests up to nu = 2.20331891, and again from 2.20331927 on.
RESTS_TWICE = """[scene]
h = 0.002335876010485675
f = -1.0
nu = 2.2033186088268626
phase = 0.0
load = 0.27036368159186586
stiffness = 3.474670827070414
x0 = -0.653799441547595
v0 = -0.2922543362385541
stop_lower = -0.653799441547595
R_lower = 0.35965965308933445
stop_upper = -0.16041342021551916
R_upper = 0.8967392426866754
[time]
max_periods = 600
[branch]
along = "nu"
range = [1.8728208175028331, 2.533816400150892]
"""


class BranchContacts(BranchRuns):
    def grazes_and_folds(self, *words):
        """Of the branches, and the points in the middle of each."""
        done = self.clatter("branch", *words, "-o", "b.h5", "--force", "-q")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "b.h5") as file:
            kinds, at, branch = file["special_kind"][()], file["special_nu"][()], file["branch"][()]
        points = [np.flatnonzero(branch == number) for number in range(branch.max() + 1)]
        return [np.sort(at[kinds == kind]) for kind in (b"graze", b"fold")], [of[len(of) // 2] for of in points]

    def check(self, text, grazes, folds, again):
        """Begun with any of the branches, of which some have daughters of their own."""
        name = self.write("a.toml", text)
        found, middles = self.grazes_and_folds(name)
        for values, right in zip(found, (grazes, folds)):
            np.testing.assert_allclose(values, right, rtol=0, atol=3e-13)
        (self.directory / "b.h5").rename(self.directory / "all.h5")
        for number in again:
            found, _ = self.grazes_and_folds(name, "--from", "all.h5", "--where", f"point={middles[number]}")
            for values, right in zip(found, (grazes, folds)):
                for value in right:
                    self.assertLess(np.abs(values - value).min(), 3e-13, (number, values))
            self.assertGreater(np.abs(np.subtract.outer(*found)).min(), 1e-5, number)

    def test_a_motion_that_hardly_touches_a_stop_ends_in_its_graze(self):
        grazes = (0.35247379741778, 0.38207889177003, 0.38207889336151)
        self.check(HARDLY_TOUCHES, grazes, (0.3519374620002,), (1, 3, 4))

    def test_a_turn_that_nothing_tells_from_a_graze_is_no_fold(self):
        grazes = (0.4591852984863957, 0.50975738357246, 0.53413853378428)
        self.check(TURNS_BESIDE, grazes, (0.55905601244812,), (0, 3, 4))

    def test_motion_that_rests_ends_before_a_gap_in_whatever_steps(self):
        for step in (0.02, 2e-3, 1e-3, 1e-4):
            name = self.write("a.toml", RESTS_TWICE)
            (grazes, _), _ = self.grazes_and_folds(name, "--set", f"branch.largest_step={step}")
            np.testing.assert_allclose(grazes, (2.2033180985267,), rtol=1e-13)
            with h5py.File(self.directory / "b.h5") as file:
                limits = np.sort(file["special_nu"][()][file["special_kind"][()] == b"chatter limit"])
            np.testing.assert_allclose(limits, (2.2033180711412, 2.2033189121283), rtol=1e-13)


if __name__ == "__main__":
    unittest.main()
