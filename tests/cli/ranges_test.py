"""`clatter info --ranges` and `--where`: from where to where a word holds, and the share of points that meet a
condition, against the file as h5py reads it, and other runs.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import re
import unittest

import h5py
import numpy as np
from scipy import stats

from command_line import SOURCE, CommandLine

SWEEP = """[scene]
h = 0.1
f = -1.0
R = 0.7
xs = -3.0
[sweep]
nu = "linspace(1.0, 1.3, 13)"
[observe]
word = true
impacts = true
period = true
"""
MAP = SWEEP.replace("xs = -3.0\n", "").replace("[observe]", "xs = [-1.0, -3.0]\n[observe]\nextrema = true")
SAMPLE = """[machine]
mass = 1.0
stiffness = 2000.0
damping_ratio = 0.1
force = 20.0
frequency = "8 Hz"
[sweep]
R = "sobol(0.5, 0.7, 128)"
gap = "sobol(1 mm, 2 mm, 128)"
linked = "R, gap"
[observe]
impacts = true
word = true
"""


class Ranges(CommandLine):
    def made(self, text, command="run"):
        self.write("a.toml", text)
        done = self.clatter(command, "a.toml", "-q", "-o", "a.h5")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return h5py.File(self.directory / "a.h5")

    def info(self, *words):
        done = self.clatter("info", "a.h5", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return json.loads(done.stdout) if "--json" in words else done.stdout

    def test_words_hold_from_one_point_to_another(self):
        with self.made(SWEEP) as file:
            words, nu = file["impact_word"].asstr()[()], file["nu"][()]
        self.assertEqual(sorted(set(words)), ["-", "LU"])
        last = np.flatnonzero(words == "LU")[-1]
        told = self.info("--ranges", "impact_word")
        self.assertIn(f"\n  LU  nu = 1 ... {nu[last]:g}, {last + 1} points\n", told)
        self.assertIn(f"\n  -   nu = {nu[last + 1]:g} ... 1.3, {len(nu) - last - 1} points\n", told)
        line = self.info("--ranges", "impact_word", "--json")["lines"][0]
        self.assertEqual([part["word"] for part in line["ranges"]], ["LU", "-"])
        self.assertEqual(line["ranges"][1]["from"], {"nu": nu[last + 1]})

    def test_refined_ends_are_where_single_runs_change(self):
        """At the last place the word is still that of the range, and at 2e-9 of the axis beyond it isn't any more."""
        self.made(SWEEP).close()
        for choice in (("--ranges", "impact_word"), ("--where", "impact_word=LU"), ("--where", "impact_speed < 1.5")):
            ranges = self.info(*choice, "--refine", "--json")["lines"][0]["ranges"]
            end = ranges[0]["to"]["nu"]
            self.assertTrue(1.15 < end < 1.175, end)
            for nu, word in ((end, "LU"), (end + 2e-9 * 0.3, "-")):
                self.clatter("run", "a.toml", "-q", "-o", "one.h5", "--set", f"scene.nu={nu!r}")
                with h5py.File(self.directory / "one.h5") as one:
                    self.assertEqual(one["impact_word"].asstr()[()], word, (choice, nu))

    def rig(self, low, high, points):
        frequencies = f"sweep.frequency=linspace({low} Hz, {high} Hz, {points})"
        config = str(SOURCE / "configs" / "rig.toml")
        self.assertEqual(self.clatter("run", config, "-q", "-o", "a.h5", "--set", frequencies).returncode, 0)
        return h5py.File(self.directory / "a.h5")

    def word_at(self, frequency):
        words = ("--set", f"machine.frequency={frequency!r}", "--set", f"sweep.frequency=[{frequency!r}]")
        self.clatter("run", str(SOURCE / "configs" / "rig.toml"), "-q", "-o", "one.h5", "--force", *words)
        with h5py.File(self.directory / "one.h5") as one:
            return one["impact_word"].asstr()[0]

    def test_refined_ranges_meet_or_it_is_told_what_lies_between(self):
        """Between neighbours in the file further words may hold: the ends are where the own ones cease."""
        with self.rig(7.05, 7.35, 7):
            pass
        line = self.info("--ranges", "word", "--refine", "--json")["lines"][0]
        gaps = {gap["after"]: gap for gap in line["gaps"]}
        self.assertTrue(0 < len(gaps) < len(line["ranges"]) - 1)
        for number, (one, other) in enumerate(zip(line["ranges"], line["ranges"][1:])):
            end, begin = one["to"]["frequency"], other["from"]["frequency"]
            self.assertEqual(number in gaps, begin - end > 3e-9 * 0.3)
            if number in gaps:
                self.assertEqual((gaps[number]["from"], gaps[number]["to"]), (one["to"], other["from"]))
                self.assertIn("between two points of the file other words hold: L", gaps[number]["why"])
                for within in (end + 1e-9, begin - 1e-9):
                    self.assertNotIn(self.word_at(within), (one["word"], other["word"]))
        text = self.info("--ranges", "word", "--refine")
        self.assertEqual(text.count("\n   "), len(gaps))
        self.assertNotIn("gaps", self.info("--ranges", "word", "--json")["lines"][0])

    def test_a_count_has_ranges_beside_motion_without_a_period(self):
        """Of which a window has a mean; of longer periods it may be a fraction."""
        with self.rig(23.5, 24.5, 11) as file:
            counts, periods = file["impacts_per_period"][()][:, 1], file["period_ratio"][()]
        told = self.info("--ranges", "impacts_per_period[1]", "--json")["lines"][0]["ranges"]
        self.assertEqual([part["word"] for part in told], ["(aperiodic)", "3/2", "(aperiodic)", "1"])
        self.assertEqual(set(counts[periods == 2]), {1.5})
        self.assertEqual(sum(part["points"] for part in told if part["word"] == "3/2"), np.count_nonzero(periods == 2))
        for name in ("impact_power", "impact_speed[1]", "period"):
            self.assertIn("is neither a name nor a count", self.clatter("info", "a.h5", "--ranges", name).stderr)

    def test_one_point_has_no_ranges(self):
        self.made(SWEEP.replace('[sweep]\nnu = "linspace(1.0, 1.3, 13)"', "nu = 1.1")).close()
        words = "--ranges: 'a.h5' has one point and no axis; sweep a key in [sweep] for ranges along it"
        self.assert_refused(2, words, "info", "a.h5", "--ranges", "word")
        words = "--refine: 'a.h5' has no axis along which ends could move; leave it out"
        self.assert_refused(2, words, "info", "a.h5", "--where", "word=LU", "--refine")
        self.assertIn(": 1 of 1 point, 100 %", self.info("--where", "word=LU"))

    def test_each_value_of_the_other_axis_has_its_ranges(self):
        with self.made(MAP) as file:
            words, xs = file["impact_word"].asstr()[()], file["xs"][()]
            speeds = np.fmax.reduce(file["impact_speed"][()], axis=-1)
        for along, table in (("nu", words.T), ("xs", words)):
            lines = self.info("--ranges", "impact_word", "--along", along, "--json")["lines"]
            self.assertEqual(len(lines), len(table))
            for line, row in zip(lines, table):
                changes = 1 + np.count_nonzero(row[1:] != row[:-1])
                self.assertEqual(len(line["ranges"]), changes)
                self.assertEqual(sum(part["points"] for part in line["ranges"]), len(row))
        self.assertIn("\nat xs = -3\n", self.info("--ranges", "impact_word"))
        told = self.info("--where", "impact_speed < 1.2", "--where", "xs=-3", "--json")
        self.assertEqual(told["points"], np.count_nonzero(speeds[:, xs == -3] < 1.2))
        self.assertEqual(told["of"], words.size)

    def test_a_count_has_ranges_and_other_numbers_ask_for_a_condition(self):
        self.made(MAP).close()
        self.assertIn("  1  nu = 1 ...", self.info("--ranges", "period_ratio"))
        for words, said in (
            (("--ranges", "x_max"), "neither a name nor a count; conditions have ranges, too: --where 'x_max < "),
            (("--ranges", "impacts_per_period"), "has several values a point; name one, e.g. impacts_per_period[1]"),
            (("--ranges", "impact_wrod"), "is no result of points in 'a.h5'; did you mean 'impact_word'?"),
            (("--ranges", "impact_word", "--along", "h"), "'h' is no axis of 'a.h5'; its axes are nu, xs"),
            (("--max", "x_max", "--ranges", "impact_word"), "--max conflicts with --ranges"),
            (("--refine",), "--refine without --ranges or --where"),
            (("--for", "xs"), "--for without --max or --min"),
            (("--in", "rpm"), "'a.h5' has no numbers in such a unit"),
            (("--in", "foo"), "unknown unit 'foo'"),
        ):
            self.assert_refused(2, said, "info", "a.h5", *words)

    def test_the_share_of_a_sample_has_its_binomial_interval(self):
        with self.made(SAMPLE) as file:
            harder = np.fmax.reduce(file["impact_speed"][()], axis=-1)
            gap = file["gap"][()]
        met = harder < 0.28
        told = self.info("--where", "impact_speed < 0.28 m/s", "--json")
        self.assertEqual((told["points"], told["of"], told["failed"]), (met.sum(), 128, 0))
        interval = stats.binomtest(int(met.sum()), 128).proportion_ci(method="exact")
        np.testing.assert_allclose(told["interval"], [interval.low, interval.high], rtol=1e-12)
        extent = told["lines"][0]["ranges"][0]
        self.assertEqual((extent["from"]["gap"], extent["to"]["gap"]), (gap[met].min(), gap[met].max()))
        text = self.info("--where", "impact_speed < 0.28 m/s")
        self.assertRegex(text, rf": {met.sum()} of 128 points, [\d.]+ % \(95 %: [\d.]+ \.\.\. [\d.]+ %\)\n")
        self.assert_refused(2, "which has no neighbours; ask for the share", "info", "a.h5", "--ranges", "impact_word")
        quantiles = self.info("--json")["quantiles"]
        np.testing.assert_allclose(quantiles["impact_speed"]["at"]["0.95"], np.quantile(harder, 0.95), rtol=1e-12)
        self.assertGreater(quantiles["impact_speed"]["at"]["0.5"], quantiles["impact_speed[1]"]["at"]["0.5"])

    def test_branches_have_ranges_that_end_where_they_turn(self):
        with self.made((SOURCE / "configs" / "branch.toml").read_text(encoding="utf-8"), "branch") as file:
            kinds = file["special_kind"].asstr()[()]
            fold = file["special_nu"][()][kinds == "fold"][0]
            words, branch = file["word"].asstr()[()], file["branch"][()]
        lines = self.info("--ranges", "word", "--json")["lines"]
        self.assertEqual([line["at"]["branch"] for line in lines], list(range(branch.max() + 1)))
        first = lines[0]["ranges"]
        self.assertEqual([part["word"] for part in first], ["LU", "LU"])
        self.assertAlmostEqual(first[0]["to"]["nu"], fold, delta=1e-4)
        self.assertEqual(sum(part["points"] for part in first), np.count_nonzero(branch == 0))
        self.assertEqual({part["word"] for line in lines for part in line["ranges"]}, set(words))
        self.assert_refused(2, "special points of branches", "info", "a.h5", "--ranges", "word", "--refine")

    def test_the_largest_of_each_branch(self):
        branch = '[branch]\nalong = "nu"\nrange = [0.9, 1.5]\n[observe]\nimpacts = true\n'
        with self.made(SWEEP[: SWEEP.index("[sweep]")] + "nu = 1.1\n" + branch, "branch") as file:
            of, speed = file["branch"][()], file["impact_speed"][()]
        found = self.info("--max", "impact_speed", "--for", "branch", "--json")["points"]
        self.assertGreater(len(np.unique(of)), 1)
        largest = [np.nanmax(np.nan_to_num(speed[of == number])) for number in np.unique(of)]
        self.assertEqual([entry["value"] for entry in found], largest)
        done = self.clatter("info", "a.h5", "--max", "impact_speed", "--for", "nu")
        self.assertEqual(done.returncode, 2)
        self.assertIn("write --for branch", done.stderr)

    def test_points_of_a_status_that_failed_count_if_it_is_asked_for(self):
        self.write("a.toml", SWEEP + "[time]\nmax_impacts = 30\n")
        self.assertEqual(self.clatter("run", "a.toml", "-q", "-o", "a.h5").returncode, 1)
        with h5py.File(self.directory / "a.h5") as file:
            failed = int((file["status"][()] == 16).sum())
        self.assertTrue(0 < failed < 13)
        self.assertIn(f": {failed} of 13 points, ", self.info("--where", "status=event_budget"))
        done = self.clatter("info", "a.h5", "--where", "status=peroidic")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no such status; did you mean 'periodic'?", done.stderr)

    def test_conditions_take_the_units_of_power_and_work(self):
        with self.made(SAMPLE.replace("impacts = true", "impacts = true\nenergy = true")) as file:
            power = file["impact_power"][()]
        share = f": {(power > 0.45).sum()} of 128 points"
        self.assertTrue(0 < (power > 0.45).sum() < 128)
        for text in ("impact_power > 0.45 W", "impact_power > 450 mW", "impact_power > 0.45 J/s"):
            self.assertIn(share, self.info("--where", text))

    def test_a_shard_is_told_to_be_one(self):
        self.write("a.toml", SWEEP.replace("impacts = true", "impacts = true\nenergy = true"))
        self.assertEqual(self.clatter("run", "a.toml", "-q", "--shard", "0/3", "-o", "a.h5").returncode, 0)
        for words in (("--max", "impact_speed"), ("--ranges", "impact_word")):
            self.assertIn("is shard 0/3 of a sweep; join all", self.clatter("info", "a.h5", *words).stderr)


class Points(CommandLine):
    def made(self, *names):
        for name in names:
            done = self.clatter("run", str(SOURCE / "configs" / f"{name}.toml"), "-q", "-o", "a.h5")
            self.assertEqual(done.returncode, 0, done.stderr)
        return h5py.File(self.directory / "a.h5")

    def test_the_largest_for_each_value_of_an_axis(self):
        with self.made("harvester") as file:
            speeds = np.fmax.reduce(file["impact_speed"][()], axis=-1)
            amplitudes, gaps = file["base_amplitude"][()], file["gap"][()]
            axis = file["impact_speed"].attrs["coordinates"] if "coordinates" in file["impact_speed"].attrs else ""
        self.assertEqual(axis, "")
        words = ("info", "a.h5", "--max", "impact_speed", "--for", "base_amplitude")
        points = json.loads(self.clatter(*words, "--json").stdout)["points"]
        best = speeds.reshape(len(amplitudes), len(gaps))
        self.assertEqual([point["value"] for point in points], list(np.nanmax(best, axis=1)))
        self.assertEqual([point["at"]["gap"] for point in points], list(gaps[np.nanargmax(best, axis=1)]))
        self.assertEqual(len(self.clatter(*words).stdout.splitlines()), 1 + len(amplitudes))
        some = json.loads(self.clatter(*words, "--where", "gap < 30 mm", "--json").stdout)["points"]
        self.assertTrue(all(point["at"]["gap"] < 0.03 for point in some))
        self.assert_refused(2, "'h' is no axis of 'a.h5'", *words[:4], "--for", "h")

    def test_frequencies_in_the_unit_that_is_asked_for(self):
        self.made("rig").close()
        told = self.clatter("info", "a.h5", "--max", "impact_speed", "--in", "rpm").stdout
        hertz = self.clatter("info", "a.h5", "--max", "impact_speed").stdout
        pairs = zip(re.findall(r"frequency = ([\d.]+) rpm", told), re.findall(r"frequency = ([\d.]+) Hz", hertz))
        self.assertEqual(len([pair for pair in pairs if np.isclose(float(pair[0]), 60 * float(pair[1]))]), 5)
        self.assertNotIn("Hz", told)
        self.assert_refused(2, "--in without text for people", "info", "a.h5", "--json", "--in", "rpm")

    def test_info_lists_the_motions_that_starts_end_in(self):
        sweep = ("--set", "sweep.x0=linspace(-3, 3, 9)", "--set", "sweep.v0=linspace(-3, 3, 9)")
        observe = ("--set", "observe.impacts=true")
        config = str(SOURCE / "configs" / "basins.toml")
        self.assertEqual(self.clatter("run", config, "-q", "-o", "a.h5", *sweep, *observe).returncode, 0)
        with h5py.File(self.directory / "a.h5") as file:
            words, points = file["motion_word"].asstr()[()], file["motion_points"][()]
            speeds = file["impact_speed"][()].reshape(81, -1)[file["motion_example"][()]]
        told = self.clatter("info", "a.h5").stdout.split("Motions that the starts end in\n")[1].splitlines()
        self.assertEqual(len(told), len(words))
        for line in told:
            number, word, _, period, share, *_ = line.split()
            self.assertEqual((word, period), (words[int(number)], "1"))
            self.assertAlmostEqual(float(share), 100 * points[int(number)] / 81, places=2)
        motions = json.loads(self.clatter("info", "a.h5", "--json").stdout)["motions"]
        self.assertEqual([motion["points"] for motion in motions], list(points))
        for motion, speed in zip(motions, np.fmax.reduce(speeds, axis=-1)):
            self.assertEqual(motion["impact_speed"], None if np.isnan(speed) else speed)


if __name__ == "__main__":
    unittest.main()
