"""Scenes whose branches, begun again from any of them, weren't found again.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import h5py
import numpy as np
from branch_runs import BranchRuns

BRANCH = """[observe]
energy = true
harmonics = 1
[branch]
along = "nu"
range = {range}
switch = 1
max_points = 600
"""

# the static level is above the kinetic one by 1 %, so that a slip of 1e-3 rad is none that vanishes
JUMPS = """[scene]
h = 0.17743837866951162
f = -1
nu = 0.5264097722304993
x0 = 0.19036235537812213
v0 = 0.026243823788743237
xs = -0.3485277211006261
R = 0.7288451335189721
friction = 0.021308915683151755
friction_static = 0.021541929085281308
"""

# free motion is its own mirror image about load/k, and the stops aren't: it comes to strike one of them
ONE_STOP = """[scene]
h = 0.0023970382606918555
f = 1
nu = 0.5390296850558294
load = -0.07365620977549783
stiffness = 2.096265732216818
x0 = 0.4177648075074954
v0 = -0.5291994992203153
xs = -0.4778689699045581
R = 0.7626577758686119
friction = 0.5544974134244918
"""

# a short slip between two sticks vanishes at the crest of the force
CREST = """[scene]
h = 0.001478305233628189
f = 1
nu = 0.5315609229137362
x0 = 0.8375008566005799
v0 = -0.7094379732092639
stop_upper = 0.9241311975124595
R = 0.9036603900241116
friction = 0.36745169806863787
"""

# beside a stiff soft stop motion folds 5e-11 of the range after a graze
FOLD_BESIDE_GRAZE = """[scene]
h = 0.03593360157158237
f = -0.22372216389684152
nu = 0.6797629704210698
load = -1.006364392652622
x0 = -0.32146086870707413
v0 = -0.07178870282236582
stop_lower = -1.1929299619149805
stop_stiffness_lower = 37231.97884553893
stop_upper = 0.2809268661148733
R_upper = 0.0
"""

# a renewal of the contact with a soft stop turns into a touch, whose speed is the root of the way from there
TURNS = """[scene]
h = 1.181575169307932
f = 1.0
nu = 0.43037762016426456
phase = 3.1286615961674844
load = -0.9458717841483248
x0 = -0.9612220166380254
stop_lower = -0.9612220166380254
stop_stiffness_lower = 203.2681675527201
stop_damping_lower = 0.003381159141370056
"""

# asymmetric motion is born, and runs so much across the parameter that this changes by 1e-12 in the first steps
ACROSS = """[machine]
mass = 0.37
x0 = 2.147137404309376
v0 = 0.5802992555816624
stop_lower = -1.5657029915474288
stop_upper = 2.1576509940931703
R = 0.8150280890540336
friction = 0.18311884278818127
damping = 0.012118441288088712
force = 0.37
stiffness = 0.37
load = 0.1095103804709622
frequency = 0.12979368846023617
[observe]
harmonics = 1
[branch]
along = "frequency"
range = [0.11032463519120074, 0.1492627417292716]
switch = 1
"""


class BranchSet(BranchRuns):
    def found(self, output, *words):
        """The special points but the maxima, and the middle point of each branch."""
        done = self.clatter("branch", "a.toml", "-o", output, "--force", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / output) as file:
            kinds, values, branch = (file[name][()] for name in ("special_kind", "special_nu", "branch"))
        specials = sorted((kind.decode(), nu) for kind, nu in zip(kinds, values) if not kind.startswith(b"max"))
        points = [np.flatnonzero(branch == number) for number in range(branch.max() + 1)]
        return specials, points

    def assert_specials(self, found, expected):
        self.assertEqual([kind for kind, _ in found], [kind for kind, _ in expected])
        np.testing.assert_allclose([nu for _, nu in found], [nu for _, nu in expected], rtol=1e-9)

    def check(self, scene, interval, expected):
        self.write("a.toml", scene + BRANCH.format(range=interval))
        specials, points = self.found("all.h5")
        self.assert_specials(specials, expected)
        for of_branch in points:
            middle = f"point={of_branch[len(of_branch) // 2]}"
            self.assert_specials(self.found("again.h5", "--from", "all.h5", "--where", middle)[0], expected)
        return points

    def test_where_the_static_level_is_above_the_kinetic_one_a_short_slip_is_none_that_vanishes(self):
        expected = [
            ("crossing-sliding", 0.5275853035950),
            ("fold", 0.5173709186764),
            ("graze", 0.5085136105028),
            ("grazing-sliding", 0.4939310583708),
            ("switching-sliding", 0.5294036592743),
        ]
        self.assertEqual(len(self.check(JUMPS, [0.447448306395924, 0.605371238065075], expected)), 3)

    def test_free_motion_that_is_its_mirror_image_comes_to_one_stop_alone(self):
        expected = [("graze", 0.5065019172799), ("graze", 0.5726730594020)]
        self.check(ONE_STOP, [0.458175232297455, 0.619884137814204], expected)

    def test_a_branch_ends_in_the_release_at_the_crest_of_the_force_and_not_in_dozens_of_points_beside_it(self):
        expected = [("crossing-sliding", 0.5026178270090), ("release tangency", 0.5014645923342)]
        points = self.check(CREST, [0.451826784476676, 0.611295061350797], expected)
        self.assertLess(len(points[1]), 20)

    def test_a_fold_just_after_a_graze_of_a_soft_stop_is_told_of_both_ways(self):
        expected = [
            ("flip", 0.6140099039698),
            ("flip", 0.6555859839821),
            ("fold", 0.5996036218894),
            ("fold", 0.6572171635645),
            ("graze", 0.5996036218999),
            ("graze", 0.6572171586372),
        ]
        self.check(FOLD_BESIDE_GRAZE, [0.577798524857909, 0.78172741598423], expected)

    def test_no_fold_is_told_where_a_touch_begins_across_the_parameter(self):
        expected = [("graze", 0.4811002758114), ("graze", 0.4811167203046)]
        self.check(TURNS, [0.365820977139625, 0.494934263188904], expected)

    def test_no_maximum_is_told_at_a_birth_whatever_the_step_is(self):
        self.write("a.toml", ACROSS)
        for step in ("0.02", "0.01", "0.005"):
            self.assertEqual(
                self.clatter(
                    "branch", "a.toml", "-o", "b.h5", "-q", "--force", "--set", f"branch.largest_step={step}"
                ).returncode,
                0,
            )
            with h5py.File(self.directory / "b.h5") as file:
                kinds, at = file["special_kind"][()], file["special_frequency"][()]
            birth = at[kinds == b"symmetry breaking"][0]
            self.assertAlmostEqual(birth, 0.118319460630663, 12)
            self.assertEqual(list(kinds[np.abs(at - birth) < 1e-9]), [b"symmetry breaking"], step)


if __name__ == "__main__":
    unittest.main()
