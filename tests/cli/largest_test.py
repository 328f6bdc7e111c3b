"""`clatter info --max NAME` and `--min NAME`: where a result is largest, in files of every kind.

The expected points are found by numpy in the values that h5py reads.
"""

import json
import re
import shutil
import unittest

import h5py
import numpy as np

from branch_runs import BRANCH, SCENE
from command_line import SMALL, SOURCE, CommandLine

MAP = """[scene]
f = -1.0
h = 0.1
R = 0.7
[sweep]
nu = "linspace(0.8, 1.3, 11)"
xs = [-0.5, -2, -9]
[observe]
extrema = true
impacts = true
word = true
harmonics = 3
"""
MACHINE = """[machine]
mass = "500 g"
stiffness = "12.8 kN/m"
damping = "16 N s/m"
force = "-12.8 N"
R = 0.7
[sweep]
frequency = "linspace(15 Hz, 40 Hz, 11)"
gap = ["4 mm", "60 mm"]
[observe]
extrema = true
impacts = true
"""
STARTS = """[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -3
[sweep]
nu = [1.1, 1.3]
x0 = "sobol(-3, 3, 16)"
v0 = "sobol(-6, 6, 16)"
linked = "x0, v0"
[time]
max_periods = 300
[observe]
attractor = true
"""
FAILED = 16  # the first status of failed points


class Largest(CommandLine):
    def run_text(self, text, name="a", *words):
        self.assertIn(self.clatter("run", self.write(f"{name}.toml", text), "-q", *words).returncode, (0, 1))
        return f"{name}.h5"

    def told(self, *words):
        result = self.clatter("info", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        return result.stdout

    def points(self, path, name, option="--max"):
        told = json.loads(self.told(path, option, name, "--json"))
        self.assertEqual(told["extreme"], option[2:])
        return told["points"]

    def values(self, path, name):
        with h5py.File(self.directory / path) as file:
            return file[name][()]

    def test_the_five_largest_and_smallest_of_a_sweep_with_all_their_digits(self):
        path = self.run_text(MAP)
        nu, xs = self.values(path, "nu"), self.values(path, "xs")
        values, words = self.values(path, "x_max"), self.values(path, "impact_word")
        for option, sign in (("--max", -1), ("--min", 1)):
            order = np.argsort(sign * values.ravel(), kind="stable")[:5]
            points = self.points(path, "x_max", option)
            self.assertEqual([point["value"] for point in points], values.ravel()[order].tolist())
            for point, index in zip(points, order):
                i, j = np.unravel_index(index, values.shape)
                self.assertEqual(point["at"], {"nu": nu[i], "xs": xs[j]})
                self.assertEqual((point["component"], point["status"]), ({}, "periodic"))
                self.assertEqual(point.get("impact_word", ""), words[i, j].decode())

    def test_a_point_counts_once_by_its_best_component(self):
        path = self.run_text(MAP)
        for name, dimension in (("impact_speed", "stop"), ("x_amplitude", "harmonic"), ("v_before", "stop")):
            values, parts = self.values(path, name), self.values(path, dimension)
            best = np.nanmax(np.where(np.isnan(values), -np.inf, values), axis=-1).ravel()
            order = np.argsort(-best, kind="stable")[:5]
            points = self.points(path, name)
            self.assertEqual([point["value"] for point in points], best[order].tolist())
            for point, index in zip(points, order):
                own = values.reshape(-1, len(parts))[index]
                self.assertEqual(point["component"], {dimension: parts[np.nanargmax(own)]})

    def test_one_component_by_its_name(self):
        path = self.run_text(MAP)
        values = self.values(path, "impact_speed")[..., 0].ravel()
        points = self.points(path, "impact_speed[-1]")
        self.assertEqual([point["value"] for point in points], np.sort(values[~np.isnan(values)])[::-1][:5].tolist())
        self.assertEqual({point["component"]["stop"] for point in points}, {-1})

    def test_failed_points_and_missing_values_never_win(self):
        path = self.run_text(MAP)
        order = np.argsort(-self.values(path, "x_max").ravel(), kind="stable")
        with h5py.File(self.directory / path, "r+") as file:
            status, values = file["status"][()], file["x_max"][()]
            status.ravel()[order[0]], values.ravel()[order[1]] = FAILED, np.nan
            file["status"][...], file["x_max"][...] = status, values
        self.assertEqual([point["value"] for point in self.points(path, "x_max")], values.ravel()[order[2:7]].tolist())

    def test_equal_values_are_listed_in_the_order_of_the_file(self):
        path = self.run_text(MAP)
        with h5py.File(self.directory / path, "r+") as file:
            values = np.zeros(file["x_max"].shape)
            values.ravel()[[30, 7, 12]] = 1.0
            file["x_max"][...] = values
        nu, xs = self.values(path, "nu"), self.values(path, "xs")
        expected = [(nu[i // 3], xs[i % 3]) for i in (7, 12, 30, 0, 1)]
        self.assertEqual([tuple(point["at"].values()) for point in self.points(path, "x_max")], expected)

    def test_fewer_than_five(self):
        path = self.run_text(SMALL.replace(", 5)", ", 3)"))
        self.assertEqual(len(self.points(path, "x_max")), 3)
        with h5py.File(self.directory / path, "r+") as file:
            file["x_max"][...] = np.nan
        self.assertEqual(self.points(path, "x_max"), [])
        self.assertEqual(self.told(path, "--max", "x_max"), "no point has a value of x_max, maximum displacement\n")

    def test_linked_axes_and_directions_are_told(self):
        text = SMALL.replace("xs = -4.0\n", "").replace(
            '5)"', '5)"\nxs = [-2, -3, -4, -5, -6]\nlinked = "nu, xs"\nfollow = "nu"\ndirection = "both"'
        )
        path = self.run_text(text)
        for point in self.points(path, "x_max"):
            self.assertEqual(list(point["at"]), ["direction", "nu", "xs"])
            index = self.values(path, "nu").tolist().index(point["at"]["nu"])
            self.assertEqual(self.values(path, "xs")[index], point["at"]["xs"])
            self.assertEqual(
                self.values(path, "x_max")[0 if point["at"]["direction"] > 0 else 1, index], point["value"]
            )

    def test_a_single_point(self):
        path = self.run_text("[scene]\nxs = 1\nv0 = 2\n[observe]\nextrema = true\n")
        self.assertEqual(self.told(path, "--max", "x_max"), "largest x_max, maximum displacement\n  1, periodic\n")

    def test_of_a_machine_with_units_as_in_pictures(self):
        path = self.run_text(MACHINE)
        text = self.told(path, "--max", "impact_speed")
        first = self.points(path, "impact_speed")[0]
        frequency, gap = first["at"]["frequency"], first["at"]["gap"]
        self.assertEqual(
            text.splitlines()[1],
            f"  {first['value']:.6g} m/s at frequency = {frequency:.10g} Hz, gap = {1e3 * gap:.10g} mm, "
            f"stop = {first['component']['stop']:.0f}, {first['status']}",
        )
        self.assertRegex(self.told(path, "--max", "x_max"), r"(?m)^  [\d.]+ mm at ")  # none as long as 0.1 m
        with h5py.File(self.directory / path, "r+") as file:
            file["x_max"][0, 0] = 0.25
        self.assertRegex(self.told(path, "--max", "x_max"), r"\n  0\.25 m at .*\n(  0\.\d+ m at .*\n){4}$")

    def test_motions_and_their_shares(self):
        path = self.run_text(STARTS)
        shares, nu = self.values(path, "motion_share"), self.values(path, "nu")
        points = self.points(path, "motion_share")
        self.assertEqual([point["value"] for point in points], sorted(shares.max(axis=1), reverse=True))
        for point in points:
            i, motion = np.flatnonzero(nu == point["at"]["nu"])[0], int(point["component"]["motion"])
            self.assertEqual(shares[i, motion], point["value"])
        counts, words = self.values(path, "motion_points"), self.values(path, "motion_word")
        points = self.points(path, "motion_points")
        self.assertEqual([point["value"] for point in points], sorted(counts, reverse=True)[:5])
        for point in points:
            self.assertEqual(point.get("motion_word", ""), words[int(point["at"]["motion"])].decode())

    def test_branches_and_their_special_points(self):
        self.write("a.toml", SCENE + "[observe]\nenergy = true\n" + BRANCH)
        self.assertEqual(self.clatter("branch", "a.toml", "-q").returncode, 0)
        path = "a.branch.h5"
        values = self.values(path, "impact_power")
        best = int(np.argmax(values))
        first = self.points(path, "impact_power")[0]
        self.assertEqual((first["value"], first["at"]["nu"]), (values[best], self.values(path, "nu")[best]))
        self.assertEqual(first["at"]["branch"], self.values(path, "branch")[best])
        self.assertEqual(first["stable"], "stable" if self.values(path, "stable")[best] else "unstable")
        self.assertEqual(first["word"], self.values(path, "word")[best].decode())
        special = self.values(path, "special_impact_power")
        first = self.points(path, "special_impact_power")[0]
        self.assertEqual(first["value"], special.max())
        self.assertEqual(first["special_kind"], self.values(path, "special_kind")[np.argmax(special)].decode())

    def test_of_periodic_motion_alone(self):
        """The fastest impacts of the guide's rig are those of motion without a period."""
        rig = SOURCE / "configs" / "rig.toml"
        self.assertEqual(self.clatter("run", rig, "-o", "rig.h5", "-q").returncode, 0)
        speed = np.nanmax(np.nan_to_num(self.values("rig.h5", "impact_speed"), nan=-1), axis=1)
        status, frequency = self.values("rig.h5", "status"), self.values("rig.h5", "frequency")
        self.assertEqual({point["status"] for point in self.points("rig.h5", "impact_speed")}, {"aperiodic"})
        told = json.loads(self.told("rig.h5", "--max", "impact_speed", "--periodic", "--json"))["points"]
        order = [i for i in np.argsort(-speed, kind="stable") if status[i] == 0][:5]
        self.assertEqual([point["value"] for point in told], speed[order].tolist())
        self.assertEqual([point["at"]["frequency"] for point in told], frequency[order].tolist())
        self.assertRegex(self.told("rig.h5", "--max", "impact_speed"), r"\n  0\.4576\d+ m/s at frequency = 21\.25 Hz")
        self.assertRegex(
            self.told("rig.h5", "--max", "impact_speed", "--periodic"),
            r"\n  0\.4552\d+ m/s at frequency = 23\.4 Hz, stop = -1, periodic, LULULUU",
        )
        words = "--periodic without --max or --min; it chooses among their points"
        self.assert_refused(2, words, "info", "rig.h5", "--periodic")

    def test_the_guide_shows_what_is_printed(self):
        words = ("run", SOURCE / "configs" / "harvester.toml", "-o", "harvester.h5", "-q")
        self.assertEqual(self.clatter(*words).returncode, 0)
        guide = (SOURCE / "apps" / "clatter" / "README.md").read_text(encoding="utf-8")
        self.assertIn(self.told("harvester.h5", "--max", "impact_speed"), guide)

    def test_files_of_accuracy_have_no_points(self):
        text = SMALL.partition("[sweep]")[0].replace("xs = -4.0", "xs = -0.5")
        config = self.write("a.toml", text + "[time]\nwindow = 1\nmax_impacts = 1\n")
        self.assertEqual(self.clatter("accuracy", config, "-q").returncode, 1)
        words = ("info", "a.accuracy.h5", "--max", "error_extrema")
        self.assert_refused(2, "'a.accuracy.h5' holds what accuracy costs, by method", *words)

    def test_wrong_names(self):
        path = self.run_text(MAP + "impact_log = true\n")
        for name, words in (
            ("x_mx", "--max: 'x_mx' is no result in 'a.h5'; did you mean 'x_max'?"),
            ("zzzz", "--max: 'zzzz' is no result in 'a.h5'; there are impact_total, simulated_periods, "),
            ("impact_word", "--max: 'impact_word' in 'a.h5' holds words; numbers are in: impact_total, "),
            ("status", "--max: 'status' in 'a.h5' holds words; "),
            ("nu", "--max: 'nu' in 'a.h5' is an axis; "),
            ("stop", "--max: 'stop' in 'a.h5' is an axis; "),
            ("impact_tau", "has a value for each impact, not for each point; `clatter export --impacts` prints them"),
            ("impact_speed[0]", "is no component of 'impact_speed'; there are impact_speed[-1], impact_speed[1]"),
            ("x_max[0]", "'x_max[0]' is no component of 'x_max', which has one value for each point"),
        ):
            with self.subTest(name):
                self.assert_refused(2, words, "info", path, "--max", name)
        self.assert_refused(2, "--max conflicts with --min", "info", path, "--max", "x_max", "--min", "x_max")
        self.assert_refused(2, "--max conflicts with --config", "info", path, "--max", "x_max", "--config")

    def test_a_file_that_contradicts_itself_is_refused(self):
        path = self.run_text(SMALL)
        shutil.copy(self.directory / path, self.directory / "forged.h5")
        with h5py.File(self.directory / "forged.h5", "r+") as file:
            del file["nu"]
            file["nu"] = np.ones(2)
            file["nu"].make_scale("nu")
        result = self.clatter("info", "forged.h5", "--max", "x_max")
        self.assertIn(result.returncode, (0, 74), result.stderr)  # without this axis, or not at all
        self.assertTrue(result.returncode or not re.search(r"nu = ", result.stdout))


if __name__ == "__main__":
    unittest.main()
