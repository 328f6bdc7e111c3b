"""`--where`: what is mistyped is refused with what to type, and so are conditions that no point meets; names that users
type are the same in files of all kinds, and a component is one that there is.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import shlex
import unittest

import numpy as np

from command_line import SOURCE
from exported_files import ExportedFiles

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
trajectory = 5
impact_log = true
"""
STARTS = """[scene]
h = 0.1
f = -1.0
R = 0.7
xs = -3.0
nu = 1.2
[sweep]
x0 = "linspace(-2.5, 2.5, 5)"
v0 = "linspace(-2, 2, 5)"
[observe]
attractor = true
"""
BRANCH = (SOURCE / "configs" / "branch.toml").read_text(encoding="utf-8")


class Conditions(ExportedFiles):
    def refused(self, condition, words):
        """By all commands, in the same words."""
        for command in ("export", "info", "certify"):
            self.assert_refused(2, words, command, "a.h5", "--where", condition)

    def test_what_is_mistyped_is_told_with_what_to_type(self):
        self.made(SWEEP).close()
        for condition, words in (
            ("impact_speed < 0,4", "--where 'impact_speed < 0,4'; a decimal comma? write 0.4\n"),
            ("impact_speed < 1,500 m/s", "a decimal comma? write 1.500 m/s; thousands? write 1500 m/s\n"),
            ("nu > \u22120.4", "'\u2212' (U+2212) is a typeset minus; type a hyphen, -"),
            ("nu \u2264 1.1", "'\u2264' (U+2264) is a typeset sign; type <="),
            ("nu\u00a0< 1.1", "U+00A0 is a no-break space; type a plain blank"),
            ("word=\u201cLU\u201d", "'\u201c' (U+201C) is a typeset quote; type a straight quote, \""),
            (
                "word=LU or word=-",
                "'or' joins nothing here; all conditions hold at once, so ask twice: --where 'word=LU',",
            ),
            ("nu=1.0 or 1.1", "'or' joins nothing here; a condition compares with one value, as in --where 'nu=1.0'"),
            ("nu=1.0;1.1", "';' joins nothing here; a condition compares with one value"),
            ("1.0 < nu < 1.1", "a condition has one comparison; write --where 'nu > 1.0' --where 'nu < 1.1'"),
            ("1.1 >= nu", "the name comes first; write --where 'nu <= 1.1'"),
            ("nu =< 1.1", "the sign is <=; write --where 'nu <= 1.1'"),
            ("nu <> 1.1", "the sign is !=; write --where 'nu != 1.1'"),
            ("status=peroidic", "no such status; did you mean 'periodic'?"),
        ):
            self.refused(condition, words)

    def test_two_conditions_in_one_argument_are_told_apart_and_what_is_offered_works(self):
        with self.made(SWEEP) as file:
            words, nu = file["impact_word"].asstr()[()], file["nu"][()]
        expected = np.count_nonzero((words == "LU") & (nu < 1.1))
        for joint in (" and ", " AND ", " && ", " & ", ", ", ",", "; "):
            condition = f"word = LU{joint}nu < 1.1"
            self.refused(condition, f"{condition}': '{joint.strip()}' joins nothing here; write --where")
            said = self.clatter("export", "a.h5", "--where", condition).stderr
            rows = self.table("a.h5", *shlex.split(said.split("; write ")[1]))
            self.assertEqual(len(rows), expected, said)

    def test_conditions_that_no_point_meets_are_refused_with_the_values_there_are(self):
        with self.made(SWEEP) as file:
            speed, words = np.fmax.reduce(file["impact_speed"][()], axis=-1), file["impact_word"].asstr()[()]
        extent = f"impact_speed is {np.nanmin(speed):.6g} ... {np.nanmax(speed):.6g}\n"
        alone = f"alone each is met: word=LU by {np.count_nonzero(words == 'LU')}, nu>1.25 by 2\n"
        for where, said in (
            (("impact_speed > 9",), f"--where impact_speed>9: no point of 'a.h5' meets it; {extent}"),
            (("nu > 1.1", "impact_speed > 9"), f"no point of 'a.h5' meets them all; {extent}"),
            (("nu > 7",), "nu is 1 ... 1.3\n"),
            (("word=LLU",), "word is one of LU, -"),
            (("word=lu",), "; did you mean 'LU'?\n"),
            (("word=LU", "nu > 1.25"), alone),
            (("status=aperiodic",), "status is periodic\n"),
        ):
            options = [word for condition in where for word in ("--where", condition)]
            for command in (("export",), ("certify",), ("info", "--max", "period"), ("info", "--ranges", "word")):
                self.assert_refused(2, said, command[0], "a.h5", *command[1:], *options)
            share = self.clatter("info", "a.h5", *options)  # 0 is an answer, and says of what
            self.assertEqual(share.returncode, 0)
            self.assertRegex(share.stdout, r"^.*: 0 of 13 points, 0 %(, \d+ without a value)?; ")
            self.assertIn(said.split("; ", 1)[-1].strip(), share.stdout)

    def test_conditions_that_contradict_each_other_are_an_error_everywhere(self):
        self.made(SWEEP).close()
        for one, other in (
            ("nu < 1.1", "nu > 1.2"),
            ("nu < 1.1", "nu >= 1.1"),
            ("nu = 1.1", "nu < 1.1"),
            ("impact_speed[1] > 2", "impact_speed[1] < 1"),
            ("word = LU", "impact_word = -"),
            ("word = LU", "word != LU"),
            ("status = periodic", "status != periodic"),
        ):
            words = f"--where {other.replace(' ', '')} beside --where {one.replace(' ', '')}: no value meets both"
            for command in (("export",), ("certify",), ("info",), ("info", "--max", "period")):
                self.assert_refused(2, words, command[0], "a.h5", *command[1:], "--where", one, "--where", other)
        for one, other in (("nu <= 1.1", "nu >= 1.1"), ("impact_speed[1] > 1", "impact_speed[-1] < 2")):
            self.assertEqual(self.clatter("export", "a.h5", "--where", one, "--where", other).returncode, 0, one)

    def test_unknown_kinds_of_special_points_are_refused(self):
        self.made(BRANCH, command="branch").close()
        for name in ("kind", "special_kind"):
            said = f"--where {name}=fodl: no such {name}; did you mean 'fold'?\n"
            self.assert_refused(2, said, "export", "a.h5", "--special", "--where", f"{name}=fodl")
        self.assert_refused(2, "kind is one of ", "export", "a.h5", "--special", "--where", "kind=cusp")
        for command in ("export", "info"):
            said = "'kind' is of special points; `clatter export --special` chooses among them\n"
            self.assert_refused(2, said, command, "a.h5", "--where", "kind=fold")

    def test_components_that_there_are_not_are_refused_in_files_of_all_kinds(self):
        self.made(SWEEP).close()
        self.made(BRANCH, "b.h5", "branch").close()
        self.made(STARTS, "c.h5").close()
        stops = "there are impact_speed[-1], impact_speed[1]\n"
        for name, option, result, words in (
            ("a.h5", ("--only",), "impact_speed[2]", stops),
            ("a.h5", ("--only",), "impact_speed[1],impact_speed[2]", "'impact_speed[2]' is no component; " + stops),
            ("a.h5", ("--only",), "period[1]", "'period[1]' is no component of 'period', which has one value a row"),
            ("a.h5", ("--only",), "period[", "'period[' is no column of 'a.h5'; did you mean 'period'?"),
            ("a.h5", ("--samples", "--only"), "x[2]", "'x[2]' is no component of 'x', which has one value a row"),
            ("a.h5", ("--impacts", "--only"), "impact_tau[1]", "is no component of 'impact_tau', which has one value"),
            ("b.h5", ("--only",), "impact_speed[2]", "'impact_speed[2]' is no component of 'impact_speed', which has"),
            ("b.h5", ("--only",), "multiplier_re[2]", "there are multiplier_re[0], multiplier_re[1]\n"),
            ("b.h5", ("--special", "--only"), "impact_speed[1]", "is no component of 'impact_speed', which has one"),
            (
                "c.h5",
                ("--motions", "--only"),
                "motion_word[1]",
                "is no component of 'motion_word', which has one value",
            ),
        ):
            self.assert_refused(2, words, "export", name, *option, result)
        for name, words in (("a.h5", stops), ("b.h5", "is no component of 'impact_speed', which has one value")):
            for option in (
                ("--where", "impact_speed[2] < 1"),
                ("--max", "impact_speed[2]"),
                ("--ranges", "impact_speed[2]"),
            ):
                self.assert_refused(2, words, "info", name, *option)


class Names(ExportedFiles):
    """One name for what files name by what has it; the names in the files are understood as before."""

    def test_a_word_is_a_word_in_files_of_all_kinds(self):
        self.made(SWEEP).close()
        self.made(BRANCH, "b.h5", "branch").close()
        self.made(STARTS, "c.h5").close()
        for name, rows, former in (
            ("a.h5", (), "impact_word"),
            ("b.h5", (), "word"),
            ("b.h5", ("--special",), "special_word"),
            ("c.h5", ("--motions",), "motion_word"),
        ):
            told = [self.table(name, *rows, "--only", word) for word in ("word", former)]
            self.assertEqual(*told)
            self.assertIn(former, told[0][0])
            chosen = [self.table(name, *rows, "--where", f"{word}=LU") for word in ("word", "impact_word", former)]
            self.assertEqual(chosen[0], chosen[1])
            self.assertEqual(chosen[0], chosen[2])
            self.assertTrue(0 < len(chosen[0]) and {row[former] for row in chosen[0]} == {"LU"}, name)
        for name in ("a.h5", "b.h5", "c.h5"):
            ranges = [self.clatter("info", name, "--ranges", word, "--json").stdout for word in ("word", "impact_word")]
            self.assertEqual(*ranges)
            self.assertTrue(json.loads(ranges[0])["lines"], name)

    def test_rows_of_their_own_need_no_beginning_of_names(self):
        with self.made(STARTS, "c.h5") as file:
            self.assertNotIn("impact_word", file)
            numbers, words = file["attractor"][()].ravel(), file["motion_word"].asstr()[()]
            periods = file["motion_period_ratio"][()]
        told = json.loads(self.clatter("info", "c.h5", "--where", "word=LU", "--json").stdout)
        self.assertEqual(told["points"], sum(number >= 0 and words[number] == "LU" for number in numbers))
        told = json.loads(self.clatter("info", "c.h5", "--where", "period_ratio=1", "--json").stdout)
        self.assertEqual(told["points"], sum(number >= 0 and periods[number] == 1 for number in numbers))
        rows = self.table("c.h5", "--motions", "--only", "word,share,points")
        self.assertEqual(list(rows[0]), ["x0", "v0", "motion_points", "motion_share", "motion_word"])
        self.made(SWEEP).close()
        self.assertEqual(*(self.table("a.h5", "--impacts", "--only", name) for name in ("tau", "impact_tau")))
        self.made(BRANCH, "b.h5", "branch").close()
        rows = [self.table("b.h5", "--special", "--only", f"{begin}kind,{begin}nu") for begin in ("", "special_")]
        self.assertEqual(*rows)
        self.assertEqual(list(rows[0][0]), ["special_nu", "special_kind"])

    def test_help_on_a_name_tells_what_files_call_it(self):
        said = self.clatter("help", "word").stdout
        for name in ("impact_word in files of `clatter run`", "motion_word in files of", "special_word in files of"):
            self.assertIn(name, said)
        self.assertIn("typed as    word, in options of clatter", self.clatter("help", "impact_word").stdout)
        for command in ("info", "export", "certify"):
            self.assertIn(
                " word=LU", " ".join(self.clatter("help", command).stdout.split()).replace("or word", " word")
            )


if __name__ == "__main__":
    unittest.main()
