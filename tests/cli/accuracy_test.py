"""`clatter accuracy` as shell scripts and readers of its files meet it: table, JSON, file; every method.

Nothing here depends on how long anything takes: the two variables of times are only looked at for being there.
"""

import math
import re
import unittest

import h5py
import numpy as np
import xarray

from accuracy_runs import SCENE, STEADY, AccuracyRuns, objects
from command_line import SMALL, CommandLine, runs_here

SWEEP = SCENE + '[sweep]\nnu = [0.9, 1.1]\n[time]\nmode = "transient"\nduration = 10\n'
METHODS = ["exact"] * 2 + ["dopri5"] * 11 + ["moreau"] * 5 + ["harmonics_exact"] + ["harmonics_fft"] * 17
REPEATS = ["steady"] * 13 + ["steady_repetition"] * 12
LANES = (1, 48)  # rows of the exact method and of its steady motion in lanes
KEYS = {
    "method",
    "setting",
    "arch",
    "error_contact_time",
    "error_contact_speed",
    "error_extrema",
    "error_harmonics",
    "missed",
    "doubled",
    "ns_per_period",
    "ns_spread",
    "horizon",
    "status",
}
TIMES = {"ns_per_period", "ns_spread"}


def number(value):
    return math.nan if value is None else value


class Accuracy(AccuracyRuns):
    def assert_file_holds(self, name, rows):
        """The file has the numbers of the JSON objects, in their order."""
        with h5py.File(self.directory / name) as file:
            points = max(row["point"] for row in rows) + 1
            count = len(rows) // points
            for key in ("method", "arch"):
                meanings = file[key].attrs["flag_meanings"]
                names = (meanings if isinstance(meanings, str) else meanings.decode()).split()
                self.assertEqual([names[index] for index in file[key]] * points, [row[key] for row in rows])
            for key in rows[0].keys() - {"method", "arch", "point"}:
                expected = np.array([number(row[key]) for row in rows])
                variable = np.array(file[key], dtype=float)
                if key == "setting":
                    variable = np.tile(variable, points)
                elif variable.size == points:  # of the point, not of its rows; coordinates too
                    variable = np.repeat(variable.reshape(points), count)
                np.testing.assert_array_equal(variable.ravel(), expected, key)

    def test_of_one_point_prints_writes_and_repeats_itself(self):
        config = self.write("a.toml", STEADY)
        result = self.accuracy(config, "--json", "--progress", "always")
        *_, bar, output = result.stderr.splitlines()
        self.assertRegex(bar, r"^\[#{30}\] 100 %  183/183 runs  .* runs/s  .* left$")
        self.assertEqual(output, "a.accuracy.h5")
        rows = objects(result.stdout)
        self.assertEqual([row["method"] for row in rows], METHODS + REPEATS)
        for row in rows:
            self.assertLessEqual(KEYS, row.keys())
            self.assertTrue(row["ns_per_period"] > 0 and row["ns_spread"] >= 0, row)
            self.assertEqual(row["horizon"], 3)
            self.assertEqual(row["setting"] is None, row["method"] in ("exact", "harmonics_exact"), row)
            has_contacts, in_lanes = not row["method"].startswith("harmonics"), row["arch"] != "scalar"
            for key in ("error_extrema", "missed", "doubled"):
                self.assertEqual(row[key] is not None, has_contacts, (key, row))
            for key in ("error_contact_time", "error_contact_speed", "rests_missed"):
                self.assertEqual(row[key] is not None, has_contacts and not in_lanes, (key, row))
            self.assertIsNotNone(row["error_harmonics"])
        self.assertEqual([place for place, row in enumerate(rows) if row["arch"] != "scalar"], [*LANES])
        exact = rows[0]
        for key in ("error_contact_time", "error_contact_speed", "error_extrema", "error_harmonics"):
            self.assertLess(exact[key], 1e-13, key)  # roundings of six contracting impacts
        self.assertEqual((exact["missed"], exact["doubled"], exact["simulated_periods"]), (0, 0, 3))
        for lanes in (rows[place] for place in LANES):
            for key in ("error_extrema", "error_harmonics", "error_harmonics_v"):
                self.assertLess(lanes[key], 1e-13, key)
            self.assertEqual((lanes["missed"], lanes["doubled"]), (0, 0))
        self.assertEqual([row["setting"] for row in rows[2:13]], [1 / 10**n for n in range(3, 14)])
        self.assert_file_holds("a.accuracy.h5", rows)
        self.reads_with_named_axes("a.accuracy.h5")
        self.repeats("a.accuracy.h5")

    def reads_with_named_axes(self, name):
        with xarray.open_dataset(self.directory / name, engine="h5netcdf") as file:
            self.assertEqual(dict(file.sizes), {"row": 61})
            for variable in file.variables.values():
                self.assertIn(variable.dims, ((), ("row",)))
                self.assertTrue(variable.attrs["long_name"])
            self.assertEqual(file["method"].attrs["flag_meanings"].split()[:3], ["exact", "dopri5", "moreau"])
            self.assertEqual(file.attrs["clatter_schema"], "clatter/1")

    def repeats(self, name):
        """The configuration in the file gives the same file, but for times; the table has a line a row."""
        self.write("again.toml", self.clatter("info", name, "--config").stdout)
        result = self.accuracy("again.toml", "-v", rounds=1)
        self.assertEqual(result.stderr, "again.accuracy.h5\n")  # no bar without a terminal
        with h5py.File(self.directory / name) as one, h5py.File(self.directory / "again.accuracy.h5") as other:
            self.assertEqual(set(one), set(other))
            self.assertEqual(one.attrs["config"], other.attrs["config"])
            self.assertTrue(np.isnan(other["ns_spread"]).all())  # each row is measured once
            for variable in set(one) - TIMES:
                self.assertEqual(one[variable][()].tobytes(), other[variable][()].tobytes(), variable)
        answer, steady, rows = result.stdout.partition("Harmonics and repeats are those of the ")
        self.assert_answers(answer)
        self.assertTrue(rows.startswith("steady motion, 1 forcing period long"), rows)
        table = rows.splitlines()[1:]
        lines = [line.split() for line in table if re.match(r"[a-z]", line)]
        self.assertEqual([line[0] for line in lines], ["method"] + METHODS + REPEATS)
        self.assertEqual({len(line) for line in lines[1:]}, {len(lines[1])})  # as many columns in each
        self.assertEqual([line[2] for line in lines[1:5]], ["-", "-", "1e-03", "1e-04"])
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 160)

    def assert_answers(self, answer):
        """For each error each method's cheapest setting, none cheaper than once the cheapest; in 80 columns."""
        lines = answer.splitlines()
        self.assertLessEqual(max(map(len, lines)), 80)
        text = " ".join(lines)
        self.assertIn("compared with 50 digits over 3 forcing periods from the start: 6 impacts and 0 rests.", text)
        levels = [line for line in lines if re.match(r" 1e-\d\d ", line)]
        self.assertEqual([line.split()[0] for line in levels], [f"1e-{digits:02}" for digits in range(2, 15, 2)])
        self.assertEqual({len(line) for line in levels}, {80})
        for line in levels:  # no two numbers touch
            self.assertRegex(line, r"^ 1e-\d\d( +(-|(\d+e-\d\d +)?[\d.]+ [num]?s +[\d.e+]+))+$")
        for line in levels[:5]:
            times = [float(ratio) for ratio in re.findall(r" [num]?s +([\d.]+)", line)]
            self.assertEqual(min(times), 1)
        self.assertRegex(text, r"exact in lanes \(\w+\): \de-1\d at [\d.]+ [num]?s a period; ")
        self.assertRegex(text, r"a period; Dormand-Prince takes [\d.]+ times as long for 1e-06")
        self.assertRegex(text, r"(Impacts are missed or invented by|No method misses)")

    def test_without_a_force_tells_turns_in_the_units_of_the_scene(self):
        scene = "[scene]\nxs = 0.5\nR = 0.7\nv0 = 2.0\n"
        short = '[time]\nmode = "transient"\nduration = 10\n'
        for stiffness, turn in (("", "of 2 pi from"), ("stiffness = 4.0\n", "of 3.14159 from")):
            self.write("free.toml", scene + stiffness + short)
            answer = self.accuracy("free.toml", "--force", "-q", "--progress", "never").stdout
            self.assertIn(turn, " ".join(answer.split()))

    def test_of_a_sweep_has_its_axes_before_the_rows(self):
        config = self.write("a.toml", SWEEP)
        result = self.accuracy(config, "--json", "-q", "-o", "sweep.h5")
        self.assertEqual(result.stderr, "")
        self.assertEqual(self.files(), ["a.toml", "sweep.h5"])
        rows = objects(result.stdout)
        self.assertEqual([row["method"] for row in rows], METHODS * 2)  # nothing settles in a transient
        self.assertEqual([row["nu"] for row in rows], [0.9] * 36 + [1.1] * 36)
        self.assertEqual([row["point"] for row in rows], [0] * 36 + [1] * 36)
        self.assert_file_holds("sweep.h5", rows)
        with xarray.open_dataset(self.directory / "sweep.h5", engine="h5netcdf") as file:
            self.assertEqual(dict(file.sizes), {"nu": 2, "row": 36})
            self.assertEqual(file["error_extrema"].dims, ("nu", "row"))
            self.assertEqual(file["horizon"].dims, ("nu",))
            self.assertEqual(file["setting"].dims, ("row",))
            np.testing.assert_array_equal(file["nu"], [0.9, 1.1])
            np.testing.assert_allclose(file["horizon"], np.array([0.9, 1.1]) * 10 / (2 * np.pi), rtol=1e-15)

    def test_that_fails_ends_with_1_and_still_writes_its_file(self):
        config = self.write("a.toml", STEADY + "max_impacts = 1\n")
        rows = objects(self.accuracy(config, "--json", code=1).stdout)
        self.assertEqual(len(rows), 61)
        for row in rows:
            self.assertEqual([row[key] for key in KEYS if key.startswith("error")], [None] * 4)
            self.assertGreaterEqual(row["status"], 16)
            self.assertEqual(row["horizon"], 0)
        self.assert_file_holds("a.accuracy.h5", rows)
        self.assertEqual(self.accuracy(config, "-o", "b.h5", code=1).stdout.count("\n"), 2)
        table = self.accuracy(config, "-v", "-o", "c.h5", code=1).stdout
        self.assertIn("not compared", table)
        self.assertEqual(table.count("  event_budget\n"), 61)

    def test_in_lanes_is_of_the_instruction_set_that_is_named(self):
        config = self.write("a.toml", STEADY + "max_impacts = 1\n")  # which ends soon
        for name in filter(runs_here, ("sse2", "avx2", "avx512")):
            for words, variable in ((("--arch", name), "scalar"), ((), name)):
                rows = objects(self.accuracy(config, "--json", *words, code=1, arch=variable).stdout)
                self.assertEqual(
                    [(place, row["arch"]) for place, row in enumerate(rows) if row["arch"] != "scalar"],
                    [(place, name) for place in LANES],
                )
                self.assert_file_holds("a.accuracy.h5", rows)
        rows = objects(self.accuracy(config, "--json", "--arch", "scalar", code=1).stdout)
        self.assertEqual({row["arch"] for row in rows}, {"scalar"})
        self.assertEqual(len(rows), 59)
        self.assert_file_holds("a.accuracy.h5", rows)

    def test_of_points_that_lanes_leave_to_the_scalar_loop_says_so(self):
        scene = SCENE.replace("h = 0.1\n", "")
        config = self.write("a.toml", scene + "[sweep]\nh = [0.1, 2]\n[time]\nwindow = 1\nmax_periods = 100\n")
        table = self.accuracy(config, "-q", "-v").stdout
        sentence = r"^(exact|steady) +\w+  not in lanes: this motion is left to the scalar loop$"
        self.assertEqual(re.findall(sentence, table, re.MULTILINE), ["exact", "steady"])
        self.assertLess(table.index("h = 2"), table.index("not in lanes"))
        with h5py.File(self.directory / "a.accuracy.h5") as file:
            for key in ("error_extrema", "error_harmonics", "missed", "impacts", "simulated_periods", "ns_per_period"):
                self.assertEqual(np.isnan(file[key][:, list(LANES)]).tolist(), [[False, False], [True, True]], key)
            self.assertLess(file["status"][()].max(), 16)

    def test_with_dry_friction_compares_sticks_and_leaves_out_the_lanes(self):
        scene = "[scene]\nxs = 0.5\nR = 0.7\nh = 0.05\nf = 1.0\nnu = 1.3\nfriction = 0.2\n"
        config = self.write("rough.toml", scene + "[time]\nwindow = 12\n")
        rows = objects(self.accuracy(config, "--json", "-q").stdout)
        self.assertEqual([row["method"] for row in rows], METHODS + REPEATS)
        for place, row in enumerate(rows):
            has_errors = place not in LANES
            self.assertEqual(row["error_harmonics"] is not None, has_errors, row)
            self.assertEqual(row["ns_per_period"] is not None, has_errors, row)
            self.assertLess(row["status"], 16, row)
        exact, tight = rows[0], next(row for row in rows if row["method"] == "dopri5" and row["setting"] == 1e-10)
        for key in ("error_contact_time", "error_contact_speed", "error_rest", "error_extrema", "error_harmonics"):
            self.assertLess(exact[key], 1e-13, key)  # roundings of contracting motion
            self.assertLess(tight[key], 1e-8, key)  # some hundred steps
        for row in (exact, tight):
            self.assertEqual((row["missed"], row["doubled"], row["rests_missed"]), (0, 0, 0))
        self.assertGreater(exact["reference_rests"], 3)
        answer = " ".join(self.accuracy(config, "-q", "-o", "b.h5").stdout.split())
        self.assertRegex(answer, r"from the start: \d+ impacts and \d+ rests, sticks included\.")


class Refusals(AccuracyRuns):
    def test_exit_2_with_the_way_out(self):
        config = self.write("a.toml", STEADY)
        followed = self.write("b.toml", SCENE + '[sweep]\nnu = [1, 2]\nfollow = "nu"\n')
        cases = [
            (
                [followed],
                "b.toml: [sweep] follow: an accuracy run starts every point from [scene]; add --set sweep.follow=''",
            ),
            ([config, "-o", config], "the output 'a.toml' is the configuration itself"),
            ([], "CONFIG is missing; write: clatter accuracy CONFIG"),
            ([config, config], "unexpected argument 'a.toml'"),
            ([config, "--jsn"], "unknown option '--jsn'; did you mean '--json'?"),
            ([config, "--json", "-v"], "--json conflicts with --verbose"),
            ([config, "--threads", "2"], "unknown option '--threads'; see `clatter help accuracy`"),
            ([config, "--arch", "avx"], "--arch 'avx'; expected one of scalar, sse2, avx2, avx512"),
            ([config, "--rounds", "0"], "--rounds '0'; expected a whole number from 1 to 1000"),
            ([config, "--rounds", "1e3"], "--rounds '1e3'; expected a whole number from 1 to 1000"),
            ([config, "--progress", "sometimes"], "expected one of auto, always, never"),
            ([config, "-o", "b.h5", "-o", "c.h5"], "'--output' is given twice"),
            ([config, "--set", "integrator.method=dopri"], "did you mean 'dopri5'?"),
        ]
        for words, message in cases:
            with self.subTest(words=words):
                self.assert_refused(2, message, "accuracy", *words)

    def test_a_file_that_cannot_be_written_is_refused_before_the_run(self):
        config = self.write("a.toml", STEADY)
        (self.directory / "folder").mkdir()
        self.assert_refused(74, "there is no directory 'none'", "accuracy", config, "-o", "none/a.h5")
        self.assert_refused(74, "is a directory", "accuracy", config, "-o", "folder")
        self.assert_refused(74, "none.toml: cannot be read", "accuracy", "none.toml")


class Methods(CommandLine):
    def test_all_write_the_same_variables_of_the_same_shapes(self):
        config = self.write("a.toml", SMALL + "harmonics = 3\nimpacts = true\ntrajectory = 11\n")
        shapes, largest = {}, {}
        for method in ("exact", "dopri5", "moreau"):
            result = self.clatter(
                "run",
                config,
                "-q",
                "-o",
                "a.accuracy.h5",
                f"--set=integrator.method={method}",
                "--set",
                "time.tolerance=1e-9",
            )
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""), method)
            with h5py.File(self.directory / "a.accuracy.h5") as file:
                shapes[method] = {name: (file[name].shape, file[name].dtype) for name in file}
                largest[method] = file["x_max"][()]
        self.assertIn("v_amplitude", shapes["exact"])
        self.assertEqual(shapes["dopri5"], shapes["exact"])
        self.assertEqual(shapes["moreau"], shapes["exact"])
        # the defaults: a tolerance of 1e-10, and a thousand steps a period; and that they were other methods
        np.testing.assert_allclose(largest["dopri5"], largest["exact"], rtol=1e-7)
        np.testing.assert_allclose(largest["moreau"], largest["exact"], rtol=1e-2)
        self.assertFalse(np.array_equal(largest["dopri5"], largest["exact"]))
        self.assertFalse(np.array_equal(largest["moreau"], largest["exact"]))


if __name__ == "__main__":
    unittest.main()
