"""`clatter branch`: its file, its text and JSON, and every way in which it refuses.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import math
import os
import subprocess
import unittest

import h5py
import numpy as np
import xarray
from branch_runs import BRANCH, SCENE, WIDE, BranchRuns
from command_line import CLATTER, SOURCE


class Branch(BranchRuns):
    def test_the_file_is_there_even_if_nobody_reads_the_special_points(self):
        self.write("a.toml", SCENE + BRANCH)
        reader, writer = os.pipe()
        os.close(reader)
        command = [CLATTER, "branch", "a.toml", "-q"]
        ended = subprocess.run(command, cwd=self.directory, stdout=writer, stderr=subprocess.PIPE, check=False)
        os.close(writer)
        self.assertNotEqual(ended.returncode, 0)
        with h5py.File(self.directory / "a.branch.h5") as data:
            self.assertGreater(len(data["special"]), 0)

    def special_points(self, text):
        return [json.loads(line) for line in self.branch(text, "--json", "-q").stdout.splitlines()]

    def test_file_has_points_and_special_points_that_tools_read(self):
        result = self.branch(SCENE + BRANCH)
        self.assertEqual(result.returncode, 0, result.stderr)
        with xarray.open_dataset((self.directory / "a.branch.h5")) as data:
            self.assertEqual(data["nu"].dims, ("point",))
            self.assertEqual(data["multiplier_re"].dims, ("point", "multiplier"))
            inside = np.hypot(data["multiplier_re"], data["multiplier_im"]).max("multiplier") < 1
            np.testing.assert_array_equal(inside, data["stable"] == 1)
            self.assertEqual(set(data["branch"].values), {0, 1})
            for branch in (0, 1):
                self.assertTrue((np.diff(data["arclength"].values[data["branch"] == branch]) >= 0).all())
            kinds = [kind if isinstance(kind, str) else kind.decode() for kind in data["special_kind"].values]
            fold = kinds.index("fold")
            self.assertAlmostEqual(float(data["special_nu"][fold]), 1.42486182628998, 13)
            self.assertLessEqual(float(data["nu"].max()), 1.5)

    def test_json_is_an_object_a_special_point(self):
        lines = self.branch(SCENE + BRANCH, "--json", "-q").stdout.splitlines()
        special = [json.loads(line) for line in lines]
        graze = next(point for point in special if point["kind"] == "graze")
        self.assertAlmostEqual(graze["nu"], 1.11687761860245, 13)
        self.assertEqual((graze["impact_speed"], graze["branches"], graze["period_ratio"]), (0.0, [0, 1], 1))

    def test_a_scene_is_symmetric_about_any_place(self):
        """Without a spring about the middle between the stops; with one, about the equilibrium under the load."""
        free = "[scene]\nh = 0.15\nf = 1.0\nnu = 0.63\nR = 0.6\nstiffness = {k}\nload = {load}\n"
        place = "stop_lower = {low}\nstop_upper = {high}\nx0 = {x0}\nv0 = 0.75\n"
        along = '[branch]\nalong = "nu"\nrange = [0.3, 1.2]\n'

        def special(k, middle):
            scene = (free + place).format(k=k, load=k * middle, low=middle - 0.85, high=middle + 0.85, x0=middle + 0.1)
            return self.special_points(scene + along)

        for k in (0.0, 0.25):
            centred, moved = special(k, 0.0), special(k, 0.25)
            self.assertEqual([point["kind"] for point in moved], [point["kind"] for point in centred])
            self.assertIn("symmetry breaking", [point["kind"] for point in centred])
            for one, other in zip(moved, centred):
                self.assertAlmostEqual(one["nu"], other["nu"], 9)
        # where a program of ball arithmetic finds them
        breaking = [point["nu"] for point in special(0.0, 0.25) if point["kind"] == "symmetry breaking"]
        for nu in (0.60994, 1.09648):
            self.assertLess(min(abs(found - nu) for found in breaking), 1e-5)

    def test_a_birth_that_newtons_method_cannot_reach_is_told(self):
        """The doubled branch ran through its birth, and came back along itself."""
        scene = (
            "[scene]\nh = 0.012422456791107025\nf = 3.4407047434145754\nnu = 1.6049849352607084\n"
            "load = 0.10520776169880675\nstiffness = 0.0\nstop_lower = -0.7378796478300281\n"
            "stop_upper = 1.1962377546723115\nR_upper = 0.5032224512422416\nstop_stiffness_lower = 44.57910896155104\n"
            "x0 = 0.7051670808842366\nv0 = 2.602532375847595\n[observe]\nenergy = true\n"
        )
        along = '[branch]\nalong = "stop_upper"\nrange = [0.5981188773361558, 2.392475509344623]\n'
        special = self.special_points(scene + along)
        flip = next(point for point in special if point["kind"] == "flip" and point["word"] == "LUU")
        self.assertAlmostEqual(flip["stop_upper"], 1.22701534, 8)
        self.assertEqual([point["kind"] for point in special].count("graze"), 1)

    def test_a_fold_in_the_first_step_of_a_branch_is_told(self):
        scene = (
            "[scene]\nh = 0.07348171131018699\nf = 0.7744553861214791\nnu = 0.5428592602346645\n"
            "stop_lower = -0.3850112765699967\nstop_upper = 0.24644200708264635\n"
            "stop_stiffness = 302.41480489265393\nstop_damping = 0.11322410680103415\n"
            "base_amplitude = -0.05515689488862529\nx0 = -0.05352519760842442\nv0 = -0.04996595917614489\n"
        )
        along = '[branch]\nalong = "stop_damping"\nrange = [0.03396723204031024, 0.33967232040310247]\nswitch = 1\n'
        special = self.special_points(scene + along)
        folds = [point["stop_damping"] for point in special if point["kind"] == "fold"]
        self.assertLess(min(abs(fold - 0.206102720677506) for fold in folds), 1e-9)

    def test_ini_and_set_say_the_same_as_toml(self):
        plain = self.branch(SCENE + BRANCH, "-q").stdout
        ini = (SCENE + BRANCH).replace('"', "").replace("[0.85, 1.5]", "0.85, 1.5")
        self.write("b.ini", ini)
        self.assertEqual(self.clatter("branch", "b.ini", "-q").stdout, plain)
        words = ("--set", "branch.along=nu", "--set", "branch.range=0.85, 1.5")
        self.write("c.toml", SCENE)
        self.assertEqual(self.clatter("branch", "c.toml", "-q", *words).stdout, plain)

    def test_output_names_its_configuration_which_runs_again(self):
        self.branch(SCENE + BRANCH, "-q")
        config = self.clatter("info", "a.branch.h5", "--config").stdout
        self.write("again.toml", config)
        self.assertEqual(self.clatter("branch", "again.toml", "-q").returncode, 0)
        with h5py.File((self.directory / "a.branch.h5")) as one, h5py.File(
            (self.directory / "again.branch.h5")
        ) as other:
            np.testing.assert_array_equal(one["x"][:], other["x"][:])

    def test_curves_have_both_parameters_and_end_in_special_points_of_their_own(self):
        result = self.branch(SCENE + WIDE + 'across = "xs"\nacross_range = [0.05, 6]\ncurve = "fold"\n', "--json", "-q")
        self.assertEqual(result.returncode, 0, result.stderr)
        points = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual({point["kind"] for point in points}, {"fold", "resonant graze"})
        for point in points:
            self.assertEqual(list(point)[:3], ["kind", "nu", "xs"])
        fold = next(point for point in points if point["kind"] == "fold")
        self.assertAlmostEqual(fold["nu"], 1.42486182628998, 13)
        self.assertEqual(fold["xs"], 3)
        with xarray.open_dataset((self.directory / "a.branch.h5")) as data:
            self.assertEqual(data["xs"].dims, ("point",))
            self.assertEqual(data["special_xs"].dims, ("special",))
            self.assertGreaterEqual(float(data["xs"].min()), 0.05)
            np.testing.assert_allclose(data["multiplier_re"].max("multiplier"), 1, rtol=0, atol=1e-5)

    def test_curves_need_no_range_across(self):
        result = self.branch(SCENE + WIDE + 'across = "R"\ncurve = "fold"\n', "-q")
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File((self.directory / "a.branch.h5")) as file:
            np.testing.assert_allclose(file["multiplier_re"][:].max(axis=1), 1, rtol=0, atol=1e-5)
            self.assertEqual((file["R"][0], file["R"][-1]), (0, 1))
            self.assertTrue((np.diff(file["R"][:]) > 0).all())

    def test_curves_without_a_point_to_begin_with_say_so(self):
        result = self.branch(SCENE + BRANCH + 'across = "xs"\ncurve = "flip"\n')
        self.assertEqual(result.returncode, 1)
        self.assertIn("the branch has no flip; widen branch.range", result.stderr)
        self.assertFalse((self.directory / "a.branch.h5").exists())

    def test_motion_that_rests_is_followed_to_its_chatter_limit(self):
        scene = SCENE.replace("xs = -3", "xs = 0.4").replace("nu = 1.1", "nu = 0.3").replace("x0 = 2", "x0 = 0")
        result = self.branch(scene + BRANCH.replace("0.85, 1.5", "0.2, 1"), "--json", "-q")
        self.assertEqual(result.returncode, 0, result.stderr)
        limit = json.loads(result.stdout.splitlines()[-1])
        self.assertEqual((limit["kind"], limit["word"]), ("chatter limit", "L*U*"))
        self.assertEqual(limit["multipliers"], [[0, 0], [0, 0]])
        with xarray.open_dataset((self.directory / "a.branch.h5")) as data:
            self.assertTrue((data["stable"] == 1).all())
            self.assertTrue((data["symmetric"] == 1).all())

    def test_a_bouncing_ball_has_its_fold_and_its_flip(self):
        self.clatter("branch", SOURCE / "configs" / "bouncing_ball_branch.toml", "-o", "ball.h5", "-q")
        with xarray.open_dataset(self.directory / "ball.h5") as data:
            kinds = [kind if isinstance(kind, str) else kind.decode() for kind in data["special_kind"].values]
            found = {kind: float(data["special_f"][kinds.index(kind)]) for kind in ("fold", "flip")}
            self.assertEqual(set(kinds), {"fold", "flip"})  # the impact speed is constant: it has no maxima
        low = math.pi * 0.2 / 1.8
        self.assertAlmostEqual(found["fold"], low, 14)
        self.assertAlmostEqual(found["flip"], math.hypot(low, 2 * 1.64 / 1.8**2), 14)

    def test_between_soft_stops_the_resonance_bends_over_and_no_branch_is_followed_twice(self):
        result = self.clatter("branch", SOURCE / "configs" / "soft_branch.toml", "--json", "-q")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        special = [json.loads(line) for line in result.stdout.splitlines()]
        folds = [point["nu"] for point in special if point["kind"] == "fold" and point["word"] == "LU"]
        self.assertTrue(2.9 < max(folds) < 3 and 1.7 < min(folds) < 1.75, folds)
        # asymmetric motion leads from one loss of symmetry to another, where the same branch would begin again
        breaking = [point for point in special if point["kind"] == "symmetry breaking" and point["word"] == "LLUU"]
        self.assertEqual([len(point["branches"]) for point in breaking], [2, 2])
        self.assertEqual(breaking[0]["branches"], breaking[1]["branches"])

    def test_stiffness_and_amplitudes_are_parameters_like_others(self):
        near = SCENE.replace("xs = -3", "xs = 0.5").replace("nu = 1.1", "nu = 2").replace("x0 = 2", "x0 = 0.1")
        for key, more, bounds in (
            ("stiffness", "", "[0.5, 1.5]"),
            ("stop_amplitude", "", "[0, 0.2]"),
            ("base_amplitude", "stiffness = 0.0\n", "[-0.05, 0.1]"),
        ):
            branch = f'[branch]\nalong = "{key}"\nrange = {bounds}\n'
            result = self.branch(near + more + branch, "-q", "--force")
            self.assertEqual(result.returncode, 0, result.stderr)
            with h5py.File(self.directory / "a.branch.h5") as file:
                self.assertEqual([min(file[key][:]), max(file[key][:])], json.loads(bounds))

    def test_mistakes_are_told_with_their_place_and_the_way_out(self):
        for text, words in (
            (SCENE, ("a.toml: no branch.along and branch.range", "--set branch.along=nu")),
            (SCENE + "[branch]\nrange = [1, 2]\n", ("a.toml:9:2", "without 'along'")),
            (SCENE + '[branch]\nalong = "nu"\n', ("a.toml:9:2", "without 'range'")),
            (SCENE + '[branch]\nalong = "x0"\nrange = [1, 2]\n', ("a.toml:10:9", "expected one of mass, h, stiffness")),
            (SCENE + '[branch]\nalong = "nu"\nrange = [2, 1]\n', ("a.toml:11:9", "two numbers, the lower first")),
            (SCENE + '[branch]\nalong = "nu"\nrange = 2\n', ("a.toml:11:9", "two numbers, the lower first")),
            (SCENE + '[branch]\nalong = "nu"\nrange = [-1, 1]\n', ("a.toml:11:9", "nu = -1", "> 0")),
            (SCENE + "[branch]\nmax_points = 9\n", ("a.toml:9:2", "without 'along'")),
            (SCENE + '[branch]\nalong = "xs"\nrange = [-4, -1]\n', ("a.toml:11:9", "two numbers above 0")),
            (SCENE + BRANCH + 'across = "xs"\n', ("a.toml:12:1", "'across' without 'curve'")),
            (SCENE + BRANCH + 'curve = "fold"\n', ("a.toml:12:1", "'curve' without 'across'")),
            (SCENE + BRANCH + "across_range = [1, 2]\n", ("a.toml:12:1", "'across_range' without 'across'")),
            (SCENE + BRANCH + 'across = "nu"\ncurve = "fold"\n', ("a.toml:12:10", "expected another key")),
            (
                SCENE + BRANCH.replace('"nu"', '"xs"') + 'across = "stop_upper"\ncurve = "fold"\n',
                ("change the same quantity",),
            ),
            (
                SCENE + BRANCH.replace('"nu"', '"R_lower"').replace("1.5", "0.9") + 'across = "R"\ncurve = "fold"\n',
                ("change the same",),
            ),
            (SCENE + BRANCH + 'across = "xs"\ncurve = "cusp"\n', ("a.toml:13:9", "fold, flip, symmetry breaking")),
            (
                SCENE + BRANCH + 'across = "R"\ncurve = "fold"\nacross_range = [0.5, 2]\n',
                ("a.toml:14:16", "across_range has R = 2", "0 ... 1"),
            ),
            (SCENE.replace("nu = 1.1\n", "") + "[sweep]\nnu = [1, 2]\n" + BRANCH, ("a.toml:9:1", "both [sweep] and")),
            (SCENE.replace("x0 = 2\n", "") + "[sweep]\nx0 = [1, 2]\n" + BRANCH, ("axis x0", "give that in [scene]")),
        ):
            result = self.branch(text)
            self.assertEqual(result.returncode, 2, text)
            for part in words:
                self.assertIn(part, result.stderr)
            self.assertFalse((self.directory / "a.branch.h5").exists())

    def test_starts_that_cannot_be_followed_say_what_to_set(self):
        for code, text, part in (
            (2, SCENE.replace("f = -1.0", "f = 0"), "set scene.f"),
            (1, SCENE.replace("nu = 1.1", "nu = 0.9") + "[time]\nmax_periods = 60\n", "settles on no periodic motion"),
        ):
            result = self.branch(text + BRANCH)
            self.assertEqual(result.returncode, code)
            self.assertIn(part, result.stderr)
            self.assertFalse((self.directory / "a.branch.h5").exists())

    def test_curves_that_have_no_branch_to_begin_on_say_why(self):
        uneven = SCENE.replace("xs = -3", "stop_lower = -3\nstop_upper = 2.9")
        spent = "the branch has no fold up to its end at nu = "
        for code, text, part in (
            (2, uneven + WIDE + 'across = "xs"\ncurve = "fold"\n', "moves both stops, which aren't symmetric"),
            (
                2,
                SCENE.replace("xs = -3", "stop_upper = 3") + WIDE + 'across = "stop_lower"\ncurve = "fold"\n',
                "no stop",
            ),
            (1, SCENE + WIDE + 'across = "xs"\ncurve = "fold"\nmax_points = 30\n', spent),
            (2, SCENE + WIDE + 'across = "xs"\nacross_range = [4, 5]\ncurve = "fold"\n', "outside branch.across_range"),
        ):
            result = self.branch(text)
            self.assertEqual(result.returncode, code, text)
            self.assertIn(part, result.stderr)
            self.assertFalse((self.directory / "a.branch.h5").exists())

    def test_a_budget_that_is_spent_is_told_with_the_last_point_and_the_file_is_written(self):
        result = self.branch(SCENE + BRANCH + "max_points = 20\n")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"branch 0 stops at nu = [\d.]+: branch.max_points is spent")
        with h5py.File((self.directory / "a.branch.h5")) as file:
            self.assertEqual(len(file["nu"]), 20)
        resting = SCENE.replace("xs = -3", "xs = 0.4").replace("nu = 1.1", "nu = 0.3").replace("x0 = 2", "x0 = 0")
        for scene in (SCENE, resting):
            for points in (2, 3):
                text = scene + BRANCH.replace("0.85", "0.2") + f"max_points = {points}\n"
                self.assertEqual(self.branch(text, "-q").returncode, 1)
                with h5py.File((self.directory / "a.branch.h5")) as file:
                    self.assertEqual(len(file["nu"]), points, text)

    def test_a_branch_meets_soft_stops(self):
        soft = SCENE.replace("R = 0.7", "stop_stiffness = 100.0\nstop_damping = 0.1")
        result = self.branch(soft + BRANCH, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        special = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertIn("fold", [point["kind"] for point in special])
        with h5py.File(self.directory / "a.branch.h5") as file:
            self.assertGreater(np.max(file["x_max"]), 3.0)  # beyond the stop
            self.assertTrue(np.all(file["impact_power"][...] >= 0))
            self.assertGreater(np.max(file["impact_power"]), 0)

    def test_curves_of_motion_that_meets_soft_stops_run_over_their_numbers(self):
        soft = SCENE.replace("R = 0.7", "stop_stiffness = 100.0\nstop_damping = 0.1")
        across = 'across = "stop_stiffness"\nacross_range = [50, 200]\ncurve = "fold"\n'
        result = self.branch(soft + BRANCH + across, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        special = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertIn(100.0, [point["stop_stiffness"] for point in special if point["kind"] == "fold"])
        with h5py.File(self.directory / "a.branch.h5") as file:
            self.assertEqual({50.0, 200.0} - set(file["stop_stiffness"][...]), set())

    def test_what_soft_stops_do_not_have_is_refused_with_the_way_out(self):
        soft = SCENE.replace("R = 0.7", "stop_stiffness = 100.0")
        for scene, branch, message in (
            (soft, '[branch]\nalong = "R"\nrange = [0.5, 1]\n', "R has no effect on a soft stop; take stop_damping"),
            (SCENE, '[branch]\nalong = "stop_stiffness"\nrange = [5, 90]\n', "give scene.stop_stiffness"),
        ):
            self.write("a.toml", scene + branch)
            self.assert_refused(2, message, "branch", "a.toml")

    def test_along_the_load_a_branch_begins_at_none_without_a_spring(self):
        """A load of 0 once had no derivative, since its response was left out. Loads of both signs mirror."""
        scene = "[scene]\nstiffness = 0\nload = 0\nh = 0.05\nf = 1.0\nR = 0.7\nxs = 0.5\nnu = 2.0\n"
        branch = '[branch]\nalong = "load"\nrange = [-0.2, 0.2]\n'
        result = self.branch(scene + branch, "-q")
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File(self.directory / "a.branch.h5") as file:
            load, v_max, v_min, speed = (file[name][()] for name in ("load", "v_max", "v_min", "impact_speed"))
        order = np.argsort(load)
        self.assertEqual((load.min(), load.max()), (-0.2, 0.2))
        for own, other in ((speed, speed), (v_max, -v_min)):
            mirrored = np.interp(-load[order], load[order], other[order])
            np.testing.assert_allclose(own[order], mirrored, rtol=1e-4)

    def test_other_outputs_are_not_overwritten(self):
        self.write("a.toml", SCENE + "[observe]\nextrema = true\n" + BRANCH)
        self.assertEqual(self.clatter("run", "a.toml", "-o", "a.h5", "-q").returncode, 0)
        result = self.clatter("branch", "a.toml", "-o", "a.h5")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("`clatter run`, this is one of `clatter branch`", result.stderr)


if __name__ == "__main__":
    unittest.main()
