"""`clatter branch --from`: branches from points of outputs of `clatter run` and `clatter branch`.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import h5py
import numpy as np
from branch_runs import BRANCH, SCENE, BranchRuns

SWEPT = SCENE.replace("nu = 1.1\n", "").replace("R = 0.7\n", "")
AXES = '[sweep]\nnu = "linspace(1.0, 1.4, 5)"\nR = [0.6, 0.7]\n'
OBSERVED = "[observe]\nword = true\nperiod = true\n"
HAMMER = (
    "[machine]\nmass = 0.4\nstiffness = 9000.0\ndamping = 6.0\nforce = 55.0\nR = 0.65\nstop_upper = 0.002\n{}"
    "[branch]\nalong = 'frequency'\nrange = [20.0, 40.0]\n"
)


class From(BranchRuns):
    def arrays(self, name):
        with h5py.File(self.directory / name) as file:
            return {key: values[()] for key, values in file.items() if isinstance(values, h5py.Dataset)}

    def attributes(self, name):
        with h5py.File(self.directory / name) as file:
            return dict(file.attrs)

    def done(self, *words):
        result = self.clatter(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def assert_same_branches(self, one, other):
        first, second = self.arrays(one), self.arrays(other)
        self.assertEqual(first.keys(), second.keys())
        del first["special_stable"]  # multipliers of special points lie on the unit circle
        for name, values in first.items():
            if values.dtype.kind in "fiu":
                of_both = [values, second[name]]
                if "multiplier" in name:  # beyond all bounds in a graze
                    of_both = [some / (1 + np.abs(some)) for some in of_both]
                np.testing.assert_allclose(*of_both, rtol=1e-8, atol=1e-8, err_msg=name)
            else:
                np.testing.assert_array_equal(second[name], values, name)

    def run_file(self, text=SWEPT + AXES + OBSERVED, name="run"):
        self.write(f"{name}.toml", text)
        self.done("run", f"{name}.toml", "-q", "--force")

    def test_a_point_of_a_run_is_the_scene_there(self):
        self.run_file()
        self.write("a.toml", SCENE + BRANCH)
        for nu, ratio in ((1.2, 0.6), (1.4, 0.7)):
            where = ("--where", f"nu={nu}", "--where", f"R={ratio}")
            said = self.done("branch", "a.toml", "--from", "run.h5", *where, "-o", "from.h5", "--force").stderr
            self.assertIn(f"starts from 'run.h5' at nu = {nu}, R = {ratio}, period 1\n", said)
            self.done(
                "branch", "a.toml", "-o", "set.h5", "--set", f"scene.nu={nu}", "--set", f"scene.R={ratio}", "--force"
            )
            self.assert_same_branches("set.h5", "from.h5")

    def test_the_configuration_in_the_output_holds_the_start_and_runs_again(self):
        self.run_file()
        self.write("a.toml", SCENE + BRANCH)
        self.done("branch", "a.toml", "--from", "run.h5", "--where", "nu=1.2", "--where", "R=0.6", "-q", "-o", "b.h5")
        config = self.write("again.toml", self.done("info", "b.h5", "--config").stdout)
        for line in ("nu = 1.2\n", "R = 0.6\n", "period = 1\n"):
            self.assertIn(line, (self.directory / config).read_text())
        self.done("branch", config, "-q", "-o", "again.h5")
        for name, values in self.arrays("b.h5").items():
            np.testing.assert_array_equal(self.arrays("again.h5")[name], values)
        self.done("certify", "b.h5", "--sample", "20", "-o", "b.jsonl")

    def test_a_point_is_run_as_its_sweep_runs_it(self):
        """Down from the resonance the motion keeps its impacts, and up to it the free motion goes on beside it."""
        words = {}
        for direction in ("up", "down", "both"):
            sweep = f'[sweep]\nnu = "linspace(1.3, 1.6, 31)"\nfollow = "nu"\ndirection = "{direction}"\n'
            text = SCENE.replace("nu = 1.1\n", "").replace("x0 = 2\nv0 = 3", "x0 = 0\nv0 = 0") + sweep
            self.run_file(text.replace('nu = "linspace(1.3, 1.6, 31)"', 'nu = "linspace(1.0, 1.6, 61)"') + OBSERVED)
            run = self.arrays("run.h5")
            self.write("a.toml", SCENE + BRANCH.replace("1.5", "1.7"))
            ways = (("1", 0), ("-1", 1)) if direction == "both" else ((None, None),)
            for way, row in ways:
                where = ("--where", f"direction={way}") if way else ()
                result = self.done(
                    "branch", "a.toml", "--from", "run.h5", "--where", "nu=1.37", *where, "-q", "-o", "b.h5", "--force"
                )
                found, at = self.arrays("b.h5"), int(np.argmin(np.abs(run["nu"] - 1.37)))
                begun = np.flatnonzero((np.abs(found["nu"] - 1.37) < 1e-12) & (found["branch"] == 0))[0]
                told = run["impact_word"][at] if row is None else run["impact_word"][row, at]
                self.assertEqual(found["word"][begun], told, (direction, way, result.stderr))
                words[direction, way] = told
        self.assertEqual(len(set(words.values())), 2, words)
        self.assertEqual(words["up", None], words["both", "1"])

    def test_an_unstable_point_of_a_branch_gives_that_branch_again(self):
        self.write("a.toml", SCENE + BRANCH)
        self.done("branch", "a.toml", "-q", "-o", "first.h5")
        first = self.arrays("first.h5")
        unstable = np.flatnonzero((first["stable"] == 0) & (first["branch"] == 0))
        point = int(unstable[len(unstable) // 2])
        nu = float(first["nu"][point])
        self.done("branch", "a.toml", "--from", "first.h5", "--where", f"point={point}", "-q", "-o", "again.h5")
        again = self.arrays("again.h5")
        for name in ("special_kind", "special_word"):
            self.assertEqual(sorted(first[name]), sorted(again[name]))
        for kind in set(first["special_kind"]):
            places = [sorted(of["special_nu"][of["special_kind"] == kind]) for of in (first, again)]
            np.testing.assert_allclose(*places, rtol=0, atol=1e-10)
        begun = np.flatnonzero((again["nu"] == nu) & (again["branch"] == 0))[0]
        for name in ("x", "v", "multiplier_re"):
            np.testing.assert_allclose(again[name][begun], first[name][point], rtol=1e-9)
        self.assertEqual(again["stable"][begun], 0)

    def test_a_point_of_a_branch_is_the_nearest_one_and_several_are_listed(self):
        """Between its graze and its fold there are two motions with impacts, and the free one."""
        self.write("a.toml", SCENE + BRANCH)
        self.done("branch", "a.toml", "-q", "-o", "first.h5")
        first = self.arrays("first.h5")
        result = self.clatter("branch", "--from", "first.h5", "--where", "nu=1.3", "-o", "b.h5")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"'first.h5' has 3 such points; choose one by --where point=N: \d+ \(branch 0")
        result = self.done("branch", "--from", "first.h5", "--where", "nu=1.3", "--where", "branch=1", "-o", "b.h5")
        free = first["branch"] == 1
        nearest = first["nu"][free][np.argmin(np.abs(first["nu"][free] - 1.3))]
        self.assertIn(f"branch 1, nu = {nearest:.9g}, period 1\n", result.stderr)
        self.assertIn(nearest, self.arrays("b.h5")["nu"])

    def test_a_configuration_may_follow_another_parameter(self):
        """From a point of a branch along nu the motion is followed along R, and has its multipliers there."""
        self.write("a.toml", SCENE + BRANCH)
        self.done("branch", "a.toml", "-q", "-o", "first.h5")
        first = self.arrays("first.h5")
        point = int(np.flatnonzero(first["stable"] == 0)[5])
        self.write("b.toml", SCENE + "[branch]\nalong = 'R'\nrange = [0.6, 0.8]\n")
        self.done("branch", "b.toml", "--from", "first.h5", "--where", f"point={point}", "-q", "-o", "b.h5")
        along = self.arrays("b.h5")
        begun = np.flatnonzero((along["R"] == 0.7) & (along["branch"] == 0))[0]
        np.testing.assert_allclose(along["multiplier_re"][begun], first["multiplier_re"][point], rtol=1e-9)
        self.assertIn(f"nu = {float(first['nu'][point])!r}\n", self.attributes("b.h5")["config"])

    def test_a_curve_gives_its_points_too(self):
        curve = BRANCH.replace("0.85, 1.5", "0.5, 2") + 'across = "xs"\nacross_range = [2.5, 3.5]\ncurve = "graze"\n'
        self.write("a.toml", SCENE + curve)
        self.done("branch", "a.toml", "-q", "-o", "curve.h5")
        curve = self.arrays("curve.h5")
        result = self.clatter("branch", "--from", "curve.h5", "--where", "xs=9", "-o", "b.h5")
        self.assertEqual(result.returncode, 2)
        self.assertIn(f"expected nu = {float(curve['nu'].min())!r} ... ", result.stderr)

    def test_a_machine_starts_from_its_points(self):
        self.write("run.toml", HAMMER.format("") + OBSERVED + "[sweep]\nforce = [50.0, 55.0, 60.0]\n")
        self.write(
            "run.toml", (self.directory / "run.toml").read_text().replace("force = 55.0\n", "frequency = 25.0\n", 1)
        )
        self.done("run", "run.toml", "-q")
        self.write("a.toml", HAMMER.format("frequency = 30.0\n"))
        self.done("branch", "a.toml", "--from", "run.h5", "--where", "force=60", "-q", "-o", "from.h5")
        there = ("--set", "machine.frequency=25", "--set", "machine.force=60")
        self.done("branch", "a.toml", *there, "-q", "-o", "set.h5")
        self.assert_same_branches("set.h5", "from.h5")

    def test_shaken_stops_and_phases_of_the_start_are_kept(self):
        shaken = SWEPT.replace("f = -1.0", "f = -0.7\nbase_amplitude = 0.4\nphase = 1.1")
        self.run_file(shaken + AXES + OBSERVED)
        self.write("a.toml", shaken + "nu = 1.1\nR = 0.7\n" + BRANCH)
        where = ("--where", "nu=1.4", "--where", "R=0.6")
        self.done("branch", "a.toml", "--from", "run.h5", *where, "-q", "-o", "from.h5")
        self.done("branch", "a.toml", "--set", "scene.nu=1.4", "--set", "scene.R=0.6", "-q", "-o", "set.h5")
        self.assert_same_branches("set.h5", "from.h5")

    def test_without_a_configuration_that_of_the_output_is_taken(self):
        self.run_file(SWEPT.replace("h = 0.1", "h = 0.1\nnu = 1.2") + "[sweep]\nR = [0.6, 0.7]\n" + BRANCH)
        self.done("branch", "--from", "run.h5", "--where", "R=0.6", "-q")
        self.write("a.toml", SCENE + BRANCH)
        self.done("branch", "a.toml", "--set", "scene.R=0.6", "--set", "scene.nu=1.2", "-q", "-o", "set.h5")
        self.assert_same_branches("set.h5", "run.branch.h5")
        result = self.done(
            "branch", "--from", "run.h5", "--where", "R=0.6", "--set", "branch.range=1, 1.3", "-o", "c.h5"
        )
        self.assertIn("R = 0.6, period 1", result.stderr)
        self.assertEqual(self.arrays("c.h5")["nu"].max(), 1.3)

    def test_axes_that_the_branch_runs_along_or_that_are_starts_take_the_values_of_the_point(self):
        """The configuration of a sweep needs no other one, whatever its axes are."""
        self.write("a.toml", SCENE + BRANCH)
        along = ("--set", "branch.along=nu", "--set", "branch.range=0.85, 1.5")
        self.run_file(SWEPT + AXES.replace("R = [0.6, 0.7]", "R = 0.7") + 'follow = "nu"\n' + OBSERVED)
        self.done("branch", "--from", "run.h5", "--where", "nu=1.1", *along, "-q", "-o", "from.h5")
        self.done("branch", "a.toml", "-q", "-o", "set.h5")
        self.assert_same_branches("set.h5", "from.h5")
        starts = '[sweep]\nx0 = "sobol(-2, 2, 5)"\nv0 = "sobol(-3, 3, 5)"\nlinked = "x0, v0"\n'
        self.run_file(SCENE.replace("x0 = 2\nv0 = 3\n", "") + starts + OBSERVED)
        for start in self.arrays("run.h5")["x0"]:
            where = ("--where", f"x0={float(start)!r}")
            self.done("branch", "--from", "run.h5", *where, *along, "-q", "-o", "from.h5", "--force")
            self.assert_same_branches("set.h5", "from.h5")

    def test_a_damping_given_in_another_way_than_the_branch_runs_along_is_kept(self):
        quality = HAMMER.replace("damping = 6.0", "quality = 10.0")
        self.write("run.toml", quality.format("frequency = 25.0\n") + OBSERVED)
        self.done("run", "run.toml", "-q")
        self.write(
            "a.toml",
            quality.format("frequency = 25.0\n").replace(
                "'frequency'\nrange = [20.0, 40.0]", "'damping'\nrange = [5.0, 7.0]"
            ),
        )
        self.done("branch", "a.toml", "--from", "run.h5", "-q", "-o", "from.h5")
        self.done("branch", "a.toml", "-q", "-o", "set.h5")
        self.assert_same_branches("set.h5", "from.h5")

    def test_what_cannot_be_a_start_is_refused_with_the_way_out(self):
        self.run_file(
            SWEPT.replace("xs = -3", "xs = -4") + "[sweep]\nnu = [0.9, 0.96, 1.2]\nR = [0.7, 0.8]\n" + OBSERVED
        )
        config = SCENE.replace("xs = -3", "xs = -4") + BRANCH
        self.write("a.toml", config)
        self.write("other.toml", config.replace("h = 0.1", "h = 0.11"))
        self.write("machine.toml", HAMMER.format("frequency = 25.0\n"))
        self.write("none.toml", SCENE)
        place = ("--from", "run.h5", "--where", "nu=1.2", "--where", "R=0.7")
        statuses = self.arrays("run.h5")["status"]
        self.assertEqual(statuses[1, 0], 1)  # aperiodic
        for code, words, *command in (
            (2, "CONFIG is missing", "branch"),
            (2, "name that with --from FILE.h5", "branch", "a.toml", "--where", "nu=1.2"),
            (
                2,
                "has 2 such points; choose one, e.g. by --where R=0.7 (2 values, 0.7 ... 0.8)",
                *("branch", "a.toml"),
                *place[:4],
            ),
            (2, "--where nu=0.9 (3 values, 0.9 ... 1.2) and --where R=0.7", "branch", "a.toml", *place[:2]),
            (2, "the nearest are 1.2 and 0.96", "branch", "a.toml", "--from", "run.h5", "--where", "nu=1.1"),
            (2, "at nu = 0.96, R = 0.7 is aperiodic", "branch", "a.toml", *place[:2], "--where", "nu=0.96", *place[4:]),
            (2, "other.toml: scene.h is 0.11, and in 'run.h5' it is 0.1,", "branch", "other.toml", *place),
            (2, "--from 'run.h5' scene.nu=1.2: scene.nu beside machine.mass", "branch", "machine.toml", *place),
            (2, "none.toml: no branch.along and branch.range", "branch", "none.toml", *place),
            (2, "run.h5: no branch.along and branch.range", "branch", *place),
            (
                2,
                "no point of 'run.h5' meets them all; period_ratio is ",
                "branch",
                "a.toml",
                *place,
                "--where",
                "period_ratio > 99",
            ),
            (2, "outside branch.range", "branch", "a.toml", *place, "--set", "branch.range=1.3, 1.5"),
            (2, "is the one of --from", "branch", "a.toml", *place, "-o", "run.h5"),
            (74, "'nothing.h5'", "branch", "a.toml", "--from", "nothing.h5"),
        ):
            self.assert_refused(code, words, *command, "-q")
        self.done("branch", "a.toml", "-q")
        for words, *where in (
            ("expected nu = ", "--where", "nu=3"),
            ("or point = 0 ... ", "--where", "point=9999"),
            ("holds branches; expected nu = ", "--where", "R=0.7"),
        ):
            self.assert_refused(2, words, "branch", "a.toml", "--from", "a.branch.h5", *where, "-o", "b.h5")


if __name__ == "__main__":
    unittest.main()
