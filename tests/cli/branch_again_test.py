"""Branches that meet: whichever of them `clatter branch` begins with, it finds the others.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import h5py
import numpy as np
from branch_runs import BranchRuns
from command_line import SOURCE

ASYMMETRIC = """[scene]
h = 0.1
f = 1
nu = 1.2
xs = 0.5
R = 0.7
x0 = 0.2
[branch]
along = "nu"
range = [0.8, 1.5]
switch = 1
"""

# soft stops, each with a damper of its own; motion over two periods comes to one graze from both sides
TWICE = """[scene]
h = 0.20109019556620272
f = 1.648028596082789
nu = 3.6742693872108214
load = -0.3018040671361333
stiffness = 2.5199765025347447
stop_lower = -0.20618175416401538
stop_upper = 0.20618175416401538
stop_stiffness_lower = 7.249642284575347
stop_stiffness_upper = 7.249642284575347
stop_damping_lower = 0.21164094458845611
stop_damping_upper = 0.3450430629638616
x0 = 0.015885937676509643
v0 = 0.5301008600725304
[branch]
along = "f"
range = [0.8240142980413945, 3.296057192165578]
switch = 1
"""


# beside a rigid stop; motion over two periods is born at the flip at nu = 2.67162574
DOUBLED = """[scene]
h = 0.1
f = 1
nu = 2.6
stop_upper = 0
R = 0.7
x0 = -0.2
[observe]
energy = true
harmonics = 1
[branch]
along = "nu"
range = [1.5, 3]
switch = 1
"""

# LLUULUU of two periods ends in a graze of LUU, beyond which LLUU goes on
GRAZES_TWICE = """[scene]
h = 0.16639281766151268
f = 1.8425921343457292
nu = 2.3257529424554106
x0 = -0.026820966225948196
v0 = -0.9313357144148431
stop_upper = 0.19420429296600822
stop_lower = -0.28728411181600266
R = 0.4677859438378786
[branch]
along = "nu"
range = [1.3954517654732463, 3.721204707928657]
"""


# symmetric motion that loses its symmetry at a gap of 3.71911298, where its equations are singular to the last bit
LOOSE = """[scene]
h = 0.009977222968911197
nu = 0.9549620781608761
f = 0.2542376484133708
loose_mass = 0.007567974344389645
loose_R = 0.3756606673845394
loose_x0 = -1.2767332804879405
loose_v0 = 0.9650007879542244
x0 = -3.03539911226158
v0 = 3.6713401068968765
loose_gap = 5.186327373077845
[time]
max_periods = 3000
[branch]
along = "loose_gap"
range = [2.5931636865389227, 8.298123796924553]
switch = 1
max_points = 600
"""

# between soft stops; LLLL and LLL of two periods meet in a graze, 6e-7 of the range beside that of LL of one period
GRAZES_BESIDE = """[scene]
h = 0.017075095858361887
f = 0.9742630849421126
nu = 0.6298549588765149
stiffness = -1.2489728204775683
stop_lower = -0.950392301776988
stop_upper = 0.950392301776988
stop_stiffness_lower = 510.7458701659793
stop_stiffness_upper = 510.7458701659793
x0 = 0.18457228479306642
v0 = 1.036476811676004
[branch]
along = "stiffness"
range = [-1.8734592307163525, -0.6244864102387842]
switch = 1
max_points = 600
"""

# in SI; LUUUULUUUU is born at a flip of LUUUU, beside which rounding decides how its harmonic changes
IN_SI = """[machine]
mass = 0.37
phase = 0.0
x0 = 0.2957505896439485
v0 = 0.0
stop_lower = -0.4158861590239731
stop_stiffness_lower = 14.722482174112114
stop_damping_lower = 1.2146384004392865
stop_upper = 0.46630964169303324
stop_stiffness_upper = 9426.336795040419
stop_damping_upper = 0.0
damping = 0.001174967219616693
force = -0.37
stiffness = -0.01853700018651587
load = 0.16890215442661569
frequency = 0.07122432371916212
[observe]
energy = true
harmonics = 1
[branch]
along = "frequency"
range = [0.060540675161287805, 0.08190797227703643]
switch = 1
max_points = 600
"""

# a slip between two sticks vanishes just at the crest of the force, where rounding decides what else is no motion there
AT_CREST = """[{section}]
{unit}phase = 0.0
x0 = 0.4044273592572536
v0 = 0.5297350587291192
stop_lower = -1.3714669177152927
R_lower = 0.4115305362196191
stop_upper = 1.3714669177152927
R_upper = 0.4115305362196191
load = 0.0
[observe]
harmonics = 1
[branch]
along = "{along}"
switch = 1
max_points = 600
"""
OF_SCENE = """h = 0.0
f = 1
nu = 0.3157538814984172
stiffness = 1.0
friction = 0.02373261707344434
"""
OF_MACHINE = """mass = 0.37
damping = 0.0
force = 0.37
stiffness = 0.37
frequency = 0.05025379104092566
friction = 0.008781068317174404
"""

# free motion that is its own mirror image, beside a single stop out of reach: both of its halves begin to turn at once
BOTH_HALVES = """[scene]
h = 0.0
f = -1
nu = 0.5646666869213239
stiffness = 2.3918801393133364
x0 = 1.5231124708146542
v0 = 0.6240157532954864
stop_upper = 1.8196261146287198
R_upper = 0.557553046398686
friction = 0.10076018181371069
[branch]
along = "nu"
range = [0.47996668388312536, 0.6493666899595225]
switch = 1
max_points = 600
"""


class BranchAgain(BranchRuns):
    def found(self, parameter, *words):
        """Each branch: word, period, symmetry, and the ends of its range of the parameter."""
        done = self.clatter("branch", *words, "-o", "b.h5", "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        branches = []
        with h5py.File(self.directory / "b.h5") as file:
            for number in np.unique(file["branch"][()]):
                of_branch = file["branch"][()] == number
                values = file[parameter][()][of_branch]
                names = tuple(file[name][()][of_branch][of_branch.sum() // 2] for name in ("word", "period_ratio"))
                branches.append((*names, file["symmetric"][()][of_branch][0] == 1, values.min(), values.max()))
        return sorted(branches)

    def assert_same(self, one, other):
        self.assertEqual([branch[:3] for branch in one], [branch[:3] for branch in other])
        for a, b in zip(one, other):
            np.testing.assert_allclose(a[3:], b[3:], atol=2e-4)  # a point aside of a birth, or just in it

    def test_the_motion_that_a_branch_was_born_on_is_followed_both_ways(self):
        found = self.found("nu", self.write("a.toml", ASYMMETRIC))
        self.assertEqual([branch[1:3] for branch in found], [(1.0, False), (1.0, True)])
        np.testing.assert_allclose(found[1][3:], (0.8, 1.5), rtol=1e-15)
        np.testing.assert_allclose(found[0][3:], (1.1531337, 1.3790584), atol=1e-4)
        below = self.found("nu", self.write("b.toml", ASYMMETRIC.replace("nu = 1.2", "nu = 0.9")))
        self.assert_same(found, below)

    def test_a_graze_of_motion_over_two_periods_is_one_in_whichever_period_it_comes(self):
        found = self.found("f", self.write("a.toml", TWICE))
        self.assertEqual(len(found), 7)
        with h5py.File(self.directory / "b.h5") as file:
            self.assertLess(np.bincount(file["branch"][()]).max(), 200)
            grazes = np.sort(file["special_f"][()][file["special_kind"][()] == b"graze"])
        self.assertGreater(np.diff(grazes).min(), 1e-6)

    def test_slow_contacts_are_none_that_vanish_where_a_motion_beside_grazes(self):
        done = self.clatter("branch", self.write("a.toml", GRAZES_BESIDE), "-o", "b.h5", "-q")
        self.assertIn("max_points", done.stderr)
        with h5py.File(self.directory / "b.h5") as file:
            at, kind, met = (file[f"special_{name}"][()] for name in ("stiffness", "kind", "branch"))
            first = [
                file["word"][()][file["branch"][()] == number][0] for number in range(file["branch"][()].max() + 1)
            ]
        near = np.flatnonzero((kind == b"graze") & (np.abs(at + 1.0222487) < 1e-6))
        met = [sorted(first[number] for number in met[row] if number >= 0) for row in near[np.argsort(at[near])]]
        self.assertEqual(met, [[b"LLL", b"LLLL"], [b"L", b"LL"]])
        own, other = np.sort(at[near])
        self.assertAlmostEqual(other, -1.02224832543, 10)
        self.assertTrue(-1.02224923 < own < -1.02224904, own)

    def test_no_maximum_is_told_where_a_branch_is_born(self):
        found = self.found("nu", self.write("a.toml", DOUBLED))
        with h5py.File(self.directory / "b.h5") as file:
            kinds, values = file["special_kind"][()], file["special_nu"][()]
        flip = values[kinds == b"flip"].min()
        self.assertAlmostEqual(flip, 2.6716257426, places=9)
        self.assertIn(2.0, [branch[1] for branch in found])
        maxima = values[[kind.startswith(b"maximum") for kind in kinds]]
        self.assertEqual(len(maxima), 5)
        self.assertGreater(np.abs(maxima - flip).min(), 1e-2)

    def test_in_si_no_maximum_is_told_where_a_branch_is_born(self):
        self.found("frequency", self.write("a.toml", IN_SI))
        with h5py.File(self.directory / "b.h5") as file:
            kinds, values, words = (file[f"special_{name}"][()] for name in ("kind", "frequency", "word"))
        flip = values[(kinds == b"flip") & (words == b"LUUUU")][0]
        self.assertAlmostEqual(flip, 0.07390793925941, 12)
        near = kinds[np.abs(values - flip) < 1e-9]
        self.assertEqual(list(near), [b"flip"])

    def test_beside_its_birth_a_branch_has_no_fold_however_short_its_steps_are(self):
        path = self.write("a.toml", DOUBLED.replace("[1.5, 3]", "[2.5, 2.75]"))
        for step in ("0.02", "1e-3", "1e-4"):
            for birth in ("1e-12", "1e-11"):
                words = ("--set", f"branch.largest_step={step}", "--set", f"branch.tolerance={birth}")
                self.found("nu", path, *words, "--set", "branch.max_points=30000")
                with h5py.File(self.directory / "b.h5") as file:
                    self.assertNotIn(b"fold", file["special_kind"][()], (step, birth))

    def test_motion_over_two_periods_that_ends_in_a_graze_of_one_leads_to_what_goes_on_beyond(self):
        words = [branch[0] for branch in self.found("nu", self.write("a.toml", GRAZES_TWICE))]
        for word in (b"LUU", b"LLUU", b"LLUULUU", b"LLUUU", b"LLLUUU"):
            self.assertIn(word, words)

    def test_rounding_does_not_decide_whether_a_loose_mass_loses_its_symmetry(self):
        found = self.found("loose_gap", self.write("a.toml", LOOSE))
        self.assertIn((b"LU", 1.0, False), [branch[:3] for branch in found])
        with h5py.File(self.directory / "b.h5") as file:
            gaps, stable = file["loose_gap"][()], file["stable"][()]
            asymmetric = (file["symmetric"][()] == 0) & (file["word"][()] == b"LU")
        born = asymmetric & (gaps > 3.0) & (gaps < 3.719)
        self.assertGreater(born.sum(), 10)
        self.assertTrue(stable[born].all())

    def specials(self, parameter, scale=1.0):
        with h5py.File(self.directory / "b.h5") as file:
            kinds, values = file["special_kind"][()], file[f"special_{parameter}"][()] * scale
        return list(zip(kinds, values))

    def test_a_slip_that_vanishes_at_the_crest_of_the_force_is_a_release_tangency_in_any_units(self):
        turn = 2 * np.pi
        for section, unit, along, scale in (
            ("scene", OF_SCENE, "nu", 1.0),
            ("machine", OF_MACHINE, "frequency", turn),
        ):
            text = AT_CREST.format(section=section, unit=unit, along=along)
            words = ("--set", f"branch.range=[{0.26839 / scale!r}, {0.36312 / scale!r}]")
            self.found(along, self.write("a.toml", text), *words)
            specials = self.specials(along, scale)
            kinds = b"maximum harmonic,grazing-sliding,switching-sliding,crossing-sliding,release tangency"
            self.assertEqual([kind for kind, _ in specials], [*kinds.split(b","), b"grazing-sliding"], section)
            values = [value for _, value in specials[-2:]]
            np.testing.assert_allclose(values, (0.3351399839334, 0.343543197101), rtol=1e-11)

    def test_halves_of_free_motion_that_change_at_once_in_a_scene_with_one_stop_do_so_either_way(self):
        found = self.found("nu", self.write("a.toml", BOTH_HALVES))
        (self.directory / "b.h5").rename(self.directory / "all.h5")
        with h5py.File(self.directory / "all.h5") as file:
            branch = file["branch"][()]
        self.assertEqual(len(found), 3)
        for number in range(3):
            points = np.flatnonzero(branch == number)
            again = self.found("nu", "a.toml", "--from", "all.h5", "--where", f"point={points[len(points) // 2]}")
            self.assert_same(found, again)
            (first, a), (second, b) = sorted(self.specials("nu"))
            self.assertEqual((first, second), (b"grazing-sliding", b"switching-sliding"), number)
            np.testing.assert_allclose((a, b), (0.58611434973554, 0.5027470584411), rtol=1e-11)

    def test_each_branch_leads_to_the_others(self):
        for config in ("branch", "soft_branch"):
            path = SOURCE / "configs" / f"{config}.toml"
            words = ("--set", "branch.switch=2", "--set", "branch.births=symmetry, graze")
            all_of_them = self.found("nu", path, *words)
            (self.directory / "b.h5").rename(self.directory / "all.h5")
            with h5py.File(self.directory / "all.h5") as file:
                branch = file["branch"][()]
            for number in np.unique(branch):
                points = np.flatnonzero(branch == number)
                middle = points[len(points) // 2]
                again = self.found("nu", path, *words, "--from", "all.h5", "--where", f"point={middle}")
                self.assert_same(all_of_them, again)


if __name__ == "__main__":
    unittest.main()
