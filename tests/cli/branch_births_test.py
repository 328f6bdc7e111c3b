"""`branch.births`: which births `clatter branch` follows, and what it says of the others.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import unittest

import h5py
import numpy as np
from branch_runs import BRANCH, SCENE, WIDE, BranchRuns
from command_line import SOURCE

ALL = ("symmetry", "flip", "graze")
KINDS = {"symmetry breaking": "symmetry", "flip": "flip", "graze": "graze"}


class Births(BranchRuns):
    def found(self, config, births, *words):
        """The arrays and attributes of a file, by what --set gives the key, and its special points from --json."""
        chosen = () if births is None else ("--set", f"branch.births={births}")
        done = self.clatter("branch", config, "-o", "b.h5", "--force", "--json", *chosen, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "b.h5") as file:
            arrays = {name: values[()] for name, values in file.items() if isinstance(values, h5py.Dataset)}
            return arrays, dict(file.attrs), [json.loads(line) for line in done.stdout.splitlines()], done.stderr

    @staticmethod
    def branches_of(arrays):
        """Each branch by its points: parameter, state and word."""
        parameter = "nu" if "nu" in arrays else "f"
        names = (parameter, "x", "v", "word")
        return [
            tuple(tuple(arrays[name][arrays["branch"] == number]) for name in names)
            for number in np.unique(arrays["branch"])
        ]

    def counts(self, attributes):
        pairs = (word.split() for word in attributes["births_left_out"].split(", "))
        return {kind: int(count) for count, kind in pairs}

    def test_all_births_are_those_without_the_key(self):
        for config in ("branch", "soft_branch", "bouncing_ball_branch"):
            path = SOURCE / "configs" / f"{config}.toml"
            plain, attributes, specials, _ = self.found(path, None)
            self.assertNotIn("births_left_out", attributes)
            self.assertNotIn("births", attributes["config"])
            self.assertNotIn("special_left_out", plain)
            arrays, attributes, same, _ = self.found(path, ", ".join(ALL))
            self.assertEqual(same, specials)
            self.assertIn('births = "symmetry, flip, graze"', attributes["config"])
            for name, values in plain.items():
                np.testing.assert_array_equal(arrays[name], values)

    def test_what_is_followed_is_a_part_of_all_and_the_rest_is_counted(self):
        """A birth of a kind that isn't followed leaves one branch at its special point, and a count."""
        for config in ("branch", "soft_branch", "bouncing_ball_branch"):
            path = SOURCE / "configs" / f"{config}.toml"
            everything = self.branches_of(self.found(path, None)[0])
            for births in ("none", "symmetry", "flip", "graze", "symmetry, flip", "flip, graze"):
                arrays, attributes, specials, said = self.found(path, births)
                some = self.branches_of(arrays)
                self.assertLessEqual(len(set(some)), len(everything))
                self.assertTrue(set(some) <= set(everything), (config, births))
                alone = {kind: 0 for kind in ALL}
                for special, left_out in zip(specials, arrays["special_left_out"]):
                    self.assertEqual(special["left_out"], bool(left_out))
                    if left_out:
                        alone[KINDS[special["kind"]]] += 1
                        self.assertEqual(len(special["branches"]), 1, special)
                self.assertEqual(self.counts(attributes), alone)
                for kind in ALL:
                    if kind not in births:
                        of_kind = [point for point in specials if KINDS.get(point["kind"]) == kind]
                        single = [point for point in of_kind if len(point["branches"]) == 1]
                        self.assertEqual(alone[kind], len(single), (config, births, kind))
                if any(alone.values()):
                    self.assertIn("births that aren't followed: " + attributes["births_left_out"], said)
                else:
                    self.assertNotIn("births", said)

    def test_doubled_and_asymmetric_motion_is_followed_by_its_kind(self):
        ball = SOURCE / "configs" / "bouncing_ball_branch.toml"
        periods = {births: set(self.found(ball, births)[0]["period_ratio"]) for births in ("none", "flip", "symmetry")}
        self.assertEqual(periods["none"], {1.0})
        self.assertEqual(periods["symmetry"], {1.0})
        self.assertTrue({1.0, 2.0, 4.0} <= periods["flip"], periods["flip"])
        plain = SOURCE / "configs" / "branch.toml"
        self.assertEqual(set(self.found(plain, "none")[0]["symmetric"]), {1.0})
        self.assertEqual(set(self.found(plain, "symmetry")[0]["symmetric"]), {0.0, 1.0})

    def test_motion_that_is_born_in_a_graze_lies_on_the_side_of_the_motion_that_grazes(self):
        """Free motion, and motion with an impact on each stop, both exist above the graze and none below it."""
        config = self.write("a.toml", SCENE + BRANCH)
        arrays, attributes, specials, _ = self.found(config, "graze")
        graze = next(point["nu"] for point in specials if point["kind"] == "graze")
        free = arrays["word"] == b"-"
        self.assertGreaterEqual(arrays["nu"][free].min(), graze)
        near = np.abs(arrays["nu"] - graze) < 1e-2
        slow = near & ~free & (arrays["impact_speed"] < 0.3)
        self.assertTrue((near & free).any() and slow.any())
        self.assertGreaterEqual(arrays["nu"][slow].min(), graze)
        self.assertEqual(self.counts(attributes)["graze"], 0)
        arrays, attributes, _, _ = self.found(config, "none")
        self.assertNotIn(b"-", arrays["word"])
        self.assertEqual(self.counts(attributes), {"symmetry": 1, "flip": 0, "graze": 1})

    def test_motion_that_goes_on_beyond_a_graze_is_followed_whatever_is_chosen(self):
        """Below its resonance free motion grows into soft stops, and goes on in contact with them."""
        soft = SCENE.replace("R = 0.7", "stop_stiffness = 10.0").replace("nu = 1.1\nx0 = 2", "nu = 0.5\nx0 = 0")
        config = self.write("a.toml", soft + WIDE.replace("0.5, 2", "0.5, 0.95"))
        arrays, attributes, specials, _ = self.found(config, "none")
        graze = next(point["nu"] for point in specials if point["kind"] == "graze")
        self.assertTrue((arrays["word"][arrays["nu"] < graze - 1e-9] == b"-").all())
        self.assertTrue((arrays["word"][arrays["nu"] > graze + 1e-9] == b"LU").all())
        self.assertEqual(arrays["nu"].max(), 0.95)
        self.assertEqual(self.counts(attributes)["graze"], 0)

    def test_lists_texts_and_ini_say_the_same(self):
        chosen = {
            "a.toml": 'births = ["flip", "symmetry"]\n',
            "b.toml": 'births = "flip, symmetry"\n',
            "c.ini": "births = symmetry, flip\n",
        }
        found = set()
        for name, line in chosen.items():
            text = SCENE + BRANCH + line
            self.write(name, text.replace('"nu"', "nu").replace("[0.85, 1.5]", "0.85, 1.5") if "ini" in name else text)
            found.add(self.found(name, None)[1]["config"])
        for text in ("flip,symmetry", "[symmetry, flip]", '["flip", "symmetry"]'):
            found.add(self.found("a.toml", text)[1]["config"])
        self.assertEqual(len(found), 1)
        self.write("d.toml", SCENE + BRANCH + "births = []\n")
        for name, births in (("d.toml", None), ("a.toml", "none"), ("a.toml", "[]")):
            self.assertIn('births = "none"\n', self.found(name, births)[1]["config"])

    def test_info_tells_what_was_left_out(self):
        config = self.write("a.toml", SCENE + BRANCH)
        self.found(config, "none")
        self.assertRegex(self.clatter("info", "b.h5").stdout, r"births_left_out +1 symmetry, 0 flip, 1 graze\n")
        told = json.loads(self.clatter("info", "b.h5", "--json").stdout)["attributes"]["births_left_out"]
        self.assertEqual(told, "1 symmetry, 0 flip, 1 graze")

    def test_without_generations_the_summary_tells_what_they_would_be(self):
        config = self.write("a.toml", SCENE + BRANCH)
        _, attributes, specials, said = self.found(config, None)
        self.assertIn("births that aren't followed: 1 symmetry, 0 flip, 0 graze", said)
        self.assertEqual([point["kind"] for point in specials if point["left_out"]], ["symmetry breaking"])
        self.assertNotIn("births_left_out", attributes)

    def test_births_that_a_spent_budget_left_waiting_are_counted(self):
        config = self.write("a.toml", SCENE + BRANCH)
        arrays, attributes, _, _ = self.found(config, ", ".join(ALL), "--set", "branch.switch=1")
        points = int((arrays["branch"] == 0).sum())
        self.assertEqual(self.counts(attributes)["symmetry"], 0)
        words = ("--set", "branch.births=symmetry,graze", "--set", "branch.switch=1")
        done = self.clatter("branch", config, "-o", "b.h5", "--force", *words, "--set", f"branch.max_points={points}")
        self.assertEqual(done.returncode, 1)
        self.assertIn("branch.max_points is spent", done.stderr)
        with h5py.File(self.directory / "b.h5") as file:
            self.assertEqual(self.counts(file.attrs)["symmetry"], 1)

    def test_an_output_runs_again_and_its_certificates_know_what_was_left_out(self):
        config = self.write("a.toml", SCENE + BRANCH + 'births = "none"\n')
        arrays, _, _, _ = self.found(config, None)
        self.write("again.toml", self.clatter("info", "b.h5", "--config").stdout)
        again, _, _, _ = self.found("again.toml", None)
        for name, values in arrays.items():
            np.testing.assert_array_equal(again[name], values)
        self.assertEqual(self.clatter("certify", "b.h5", "-o", "b.jsonl").returncode, 0)

    def test_mistakes_are_told_with_their_place_and_the_way_out(self):
        expected = "expected some of symmetry, flip, graze, or none"
        for line, words in (
            ('births = "flop"', ("a.toml:12:10", "the text 'flop'", expected, "did you mean 'flip'?")),
            ('births = ["flip", "fold"]', ("a.toml:12:19", "the text 'fold'", expected)),
            ('births = ["flip", 2]', ("a.toml:12:19", "the number 2", expected)),
            ('births = ["flip", "none"]', ("a.toml:12:19", "the text 'none'", expected)),
            ("births = true", ("a.toml:12:10", "true", expected)),
            ('births = ""', ("a.toml:12:10", "nothing", expected)),
        ):
            done = self.branch(SCENE + BRANCH + line + "\n")
            self.assertEqual(done.returncode, 2, done.stderr)
            for part in words:
                self.assertIn(part, done.stderr)
        self.write("a.toml", SCENE + BRANCH)
        self.assert_refused(2, "the text 'fold'", "branch", "a.toml", "--set", "branch.births=flip, fold")
        self.write("a.toml", SCENE + 'births = "flip"\n')
        self.assert_refused(2, "it belongs in [branch]", "branch", "a.toml")


if __name__ == "__main__":
    unittest.main()
