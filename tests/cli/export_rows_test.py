"""`clatter export` by rows of samples, impacts, motions and special points, and by conditions of --where, against the
file as h5py reads it.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import h5py
import numpy as np

from command_line import SOURCE
from exported_files import ExportedFiles

SWEEP = """[scene]
h = 0.1
f = -1.0
R = 0.7
[sweep]
nu = "linspace(0.8, 1.2, 9)"
xs = [-1.0, -3.0]
[observe]
extrema = true
impacts = true
word = true
trajectory = 5
impact_log = true
"""
STARTS = """[scene]
h = 0.1
f = -1.0
R = 0.7
xs = -3.0
[sweep]
nu = [1.1, 1.4]
x0 = "linspace(-2.5, 2.5, 7)"
v0 = "linspace(-2, 2, 5)"
[observe]
impacts = true
attractor = true
"""


class Rows(ExportedFiles):
    def test_each_sample_has_a_row_with_the_axes_of_its_point(self):
        with self.made(SWEEP) as file:
            rows = self.table("a.h5", "--samples")
            self.assertEqual(list(rows[0]), ["nu", "xs", "tau", "x", "v"])
            self.assertEqual(len(rows), 9 * 2 * 5)
            for name in ("tau", "x", "v"):
                np.testing.assert_array_equal([float(row[name]) for row in rows], file[name][()].ravel())
            np.testing.assert_array_equal([float(row["nu"]) for row in rows], np.repeat(file["nu"][()], 10))
            np.testing.assert_array_equal([float(row["xs"]) for row in rows], np.tile(np.repeat(file["xs"][()], 5), 9))
            one = self.table("a.h5", "--samples", "--where", "nu=1.0", "--where", "xs=-3", "--only", "x")
            self.assertEqual([list(row) for row in one], [["nu", "xs", "x"]] * 5)
            np.testing.assert_array_equal([float(row["x"]) for row in one], file["x"][4, 1])

    def test_conditions_on_axes_results_and_words_choose_points(self):
        with self.made(SWEEP) as file:
            nu, xs = (mesh.ravel() for mesh in np.meshgrid(file["nu"][()], file["xs"][()], indexing="ij"))
            speed = np.fmax.reduce(file["impact_speed"][()], axis=-1).ravel()
            lower = file["impact_speed"][()][..., 0].ravel()
            word, x_max = file["impact_word"].asstr()[()].ravel(), file["x_max"][()].ravel()
            status = file["status"][()].ravel()
            for words, expected in (
                (["impact_speed < 1.0"], speed < 1.0),
                (["impact_speed>=1.0"], speed >= 1.0),
                (["impact_speed[-1] < 1.0"], lower < 1.0),
                (["impact_word=LU"], word == "LU"),
                (["impact_word!=LU"], word != "LU"),
                (["x_max > 1", "nu <= 0.9"], (x_max > 1) & (nu < 0.91)),
                (["nu < 1", "nu > 0.8"], (nu < 0.99) & (nu > 0.81)),
                (["status=periodic", "xs=-3"], (status == 0) & (xs == -3)),
            ):
                options = [word for condition in words for word in ("--where", condition)]
                rows = self.table("a.h5", "--only", "x_max", *options)
                found = {(float(row["nu"]), float(row["xs"])) for row in rows}
                self.assertEqual(found, set(zip(nu[expected], xs[expected])), words)
            chosen = self.clatter("certify", "a.h5", "--where", "nu=1.0", "--where", "impact_word=LU")
            counted = np.sum((np.abs(nu - 1) < 1e-9) & (word == "LU"))
            self.assertRegex(chosen.stderr, f"^{counted} points?: ")

    def test_conditions_that_mean_nothing_are_refused_with_a_way_out(self):
        self.made(SWEEP).close()
        for condition, words in (
            ("nu", "--where 'nu'; expected e.g. nu=1.0, 'impact_speed < 0.4 m/s' or word=LU"),
            ("nu=", "nothing to compare with"),
            ("nu=fast", "'nu' is a number; expected one"),
            ("impact_word<LU", "words are equal or not; write e.g. impact_word=LU"),
            ("v_before<0", "which component? There are v_before[-1], v_before[1]"),
            ("v_before[0]<0", "there are v_before[-1], v_before[1]"),
            ("x_maxx<1", "'x_maxx' is neither an axis nor a result of 'a.h5'; did you mean 'x_max'?"),
            ("x_max<1 m", "the unit 'm' doesn't fit"),
        ):
            self.assert_refused(2, words, "export", "a.h5", "--where", condition)
        self.assert_refused(2, "--samples conflicts with --special", "export", "a.h5", "--samples", "--special")
        self.assert_refused(2, "has no motions of its starts; run its configuration", "export", "a.h5", "--motions")
        self.write("b.toml", SWEEP.replace("trajectory = 5\n", ""))
        self.clatter("run", "b.toml", "-q")
        self.assert_refused(2, "has no trajectories; run its", "export", "b.h5", "--samples")

    def test_each_motion_has_a_row_at_each_value_of_the_parameters(self):
        with self.made(STARTS) as file:
            numbers, nu = file["attractor"][()], file["nu"][()]
            rows = self.table("a.h5", "--motions")
            expected = [
                (nu[i], m, *divmod(np.flatnonzero(numbers[i].ravel() == m)[0], 5))
                for i in range(2)
                for m in sorted(set(numbers[i].ravel()), key=lambda m: np.flatnonzero(numbers[i].ravel() == m)[0])
                if m >= 0
            ]
            self.assertGreater(len(expected), 2)
            self.assertEqual(len(rows), len(expected))
            for row, (value, motion, x, v) in zip(rows, expected):
                self.assertEqual(float(row["nu"]), value)
                self.assertEqual((float(row["x0"]), float(row["v0"])), (file["x0"][x], file["v0"][v]))
                self.assertEqual(int(row["attractor"]), motion)
                self.assertEqual(row["motion_word"], file["motion_word"].asstr()[motion])
                self.assertEqual(float(row["motion_share"]), file["motion_share"][list(nu).index(value), motion])
            some = self.table("a.h5", "--motions", "--where", "nu=1.4", "--only", "motion_word,motion_share")
            self.assertEqual(list(some[0]), ["nu", "x0", "v0", "motion_share", "motion_word"])
            self.assertEqual(len(some), sum(value == 1.4 for value, *_ in expected))

    def test_files_that_contradict_themselves_are_refused(self):
        for name, change in (("attractor", 99), ("motion_points", None)):
            self.made(STARTS).close()
            with h5py.File(self.directory / "a.h5", "r+") as file:
                if change is not None:
                    file[name][0, 0, 0] = change
                else:
                    shorter = file[name][..., :1]
                    del file[name]
                    file.create_dataset(name, data=shorter)
            done = self.clatter("export", "a.h5", "--motions")
            self.assertEqual((done.returncode, done.stdout), (74, ""), (name, done.stderr))

    def test_special_points_of_a_branch_are_chosen_by_its_number(self):
        with self.made((SOURCE / "configs" / "branch.toml").read_text(encoding="utf-8"), command="branch") as file:
            meeting = file["special_branch"][()]
            for number in (0, int(meeting.max())):
                rows = self.table("a.h5", "--special", "--where", f"branch={number}")
                self.assertEqual(len(rows), np.sum(np.any(meeting == number, axis=1)))
                self.assertLess(len(rows), len(meeting))
            rows = self.table("a.h5", "--special", "--where", "kind=graze", "--where", "nu < 1")
            kinds = file["special_kind"].asstr()[()]
            self.assertEqual(len(rows), np.sum((kinds == "graze") & (file["special_nu"][()] < 1)))
            rows = self.table("a.h5", "--where", "branch=0", "--where", "stable=1")
            self.assertEqual(len(rows), np.sum((file["branch"][()] == 0) & (file["stable"][()] == 1)))


if __name__ == "__main__":
    unittest.main()
