"""Special points at which branches of unlike symmetry meet, begun from each of the branches.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import h5py
import numpy as np
from branch_runs import BranchRuns

# slips from stick to stick between stops that they don't reach at first; the static level is above the kinetic one
LOSES_SYMMETRY = """[scene]
h = 0
f = -1
nu = 0.49228489068678294
load = 0.05170805338189138
stiffness = 0.8264959735356587
x0 = -1.2511665018844327
v0 = 0.3177823915825593
stop_lower = -1.7312950438117964
stop_upper = 1.8564210094246476
R = 0.30308811577708933
friction = 0.40023496851674345
friction_static = 0.4621445852326061
[branch]
along = "nu"
range = [0.4184421570837655, 0.5661276242898003]
switch = 1
"""

FOLDS = """[scene]
h = 0.007804817831676159
f = 1
nu = 0.9295026292064217
x0 = 0.8266331030766094
v0 = 0.9879245483117878
stop_lower = -1.8212552340261075
stop_upper = 1.8212552340261075
R = 0.3879898482165406
[branch]
along = "nu"
range = [0.7900772348254584, 1.0689280235873848]
switch = 1
max_points = 20000
births = ["symmetry"]
largest_step = 5e-4
"""

# a fold was told in the step before that in which the motion of four forcing periods comes to that of two
DOUBLED = """[scene]
h = 0.034731673905856686
f = 1
nu = 2.620588624650308
x0 = 0.03616036794890751
v0 = 0.2914443451777624
stop_lower = -0.11195125775332598
stop_upper = 0.11195125775332598
R = 0.6202937854264949
[branch]
along = "nu"
range = [2.2275003309527617, 3.013676918347854]
switch = 1
max_points = 20000
births = ["symmetry", "flip"]
largest_step = 5e-4
"""

# in SI; a branch ends in the release tangency at which a slip vanishes, as the root of the way to there
SLIP_VANISHES = """[machine]
mass = 0.37
x0 = -0.003120899881538297
v0 = 0.00804241067660616
stop_lower = -0.3307440930770681
stop_upper = 0.3307440930770681
R = 0.38604089057256563
friction = 0.03730269417854476
force = -0.37
stiffness = 1.0999998050881608
frequency = 0.10438658800697143
[branch]
along = "frequency"
range = [0.0887285998059257, 0.12004457620801713]
"""


class Meetings(BranchRuns):
    def found(self, text, *words):
        """The special points but maxima, each with the branches that meet there."""
        self.branch(text, "-o", "b.h5", "--force", "-q", *words)
        with h5py.File(self.directory / "b.h5") as file:
            names = ("kind", "nu" if "nu" in file else "frequency", "branch")
            points = zip(*(file[f"special_{name}"][()] for name in names))
            return sorted((kind.decode(), nu, set(of) - {-1}) for kind, nu, of in points if b"maximum" not in kind)

    def test_a_branch_ends_in_its_birth_and_in_symmetric_motion_from_whichever_it_is_begun(self):
        """The birth is where both halves of the motion become one. The fold beside it was told for it 2e-7 off, and
        motion whose halves are alike at a change of halts was taken to go on without symmetry.
        """
        expected = {
            "crossing-sliding": [0.502649435991606, 0.514097840851462],
            "graze": [0.531801223431447],
            "symmetry breaking": [0.503412032138166],
        }
        points = self.found(LOSES_SYMMETRY)
        (self.directory / "b.h5").rename(self.directory / "all.h5")
        with h5py.File(self.directory / "all.h5") as file:
            branch = file["branch"][()]
        self.assertEqual(branch.max(), 4)
        for number in range(branch.max() + 1):
            middle = np.flatnonzero(branch == number)[np.sum(branch == number) // 2]
            again = self.found(LOSES_SYMMETRY, "--from", "all.h5", "--where", f"point={middle}")
            for kinds in (points, again):
                for kind, values in expected.items():
                    np.testing.assert_allclose([nu for k, nu, _ in kinds if k == kind], values, rtol=0, atol=1e-11)
                self.assertEqual({kind for kind, _, _ in kinds}, set(expected))
            with h5py.File(self.directory / "b.h5") as file:
                self.assertEqual(np.sum(np.diff(file["branch"][()]) > 0), 4)

    def test_no_fold_is_told_where_a_branch_is_born_or_its_slip_vanishes(self):
        for text, values in (
            (FOLDS, [0.899700332625]),
            (DOUBLED, [2.978862097317]),
            (SLIP_VANISHES, [0.090097663507698]),
        ):
            folds = [nu for kind, nu, _ in self.found(text) if kind == "fold"]
            np.testing.assert_allclose(folds, values, rtol=0, atol=1e-11)


if __name__ == "__main__":
    unittest.main()
