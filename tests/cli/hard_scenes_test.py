"""The hard scenes, tests/hard/hard_scenes.jsonl: proved by clatter-verify, written again with the same bytes, scored.

Environment: CLATTER and CLATTER_VERIFY, the programs; CLATTER_SOURCE, the source directory; CLATTER_VERIFIED: all
scenes are proved and written, not only those that take less than a second.
"""

import importlib.util
import json
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

from certified_runs import VERIFY, verified
from command_line import CLATTER, LONGEST, SOURCE, CommandLine

IS_LONG = "CLATTER_VERIFIED" in os.environ
SCENES = SOURCE / "tests" / "hard" / "hard_scenes.jsonl"
PAGE = (SOURCE / "tests" / "hard" / "README.md").read_text(encoding="utf-8").replace("\\|", "|")
SCORE = SOURCE / "scripts" / "score_solver.py"

SLOW = (  # beginnings of names of those that take clatter-verify a second and more
    *("graze, missed", "near_elastic", "second_contact, let go for 1e-6", "second_contact, let go for 1e-8"),
    *("close_stops, 2e-12", "damping", "scales, nu = 1e-3", "no_spring, h = 100", "soft_stops, zeta", "long"),
)
QUICK_SETS = ("graze", "tangent_release", "chatter_cut_by_end", "resonance", "last_instant", "soft_stops", "long")


def lines():
    return SCENES.read_text(encoding="utf-8").splitlines(keepends=True)


def name_of(line):
    return json.loads(line)["name"]


def undecided():
    """The names of the scenes that the page says are undecided."""
    return re.findall(r"^\| `(\w+, .*?)` \|", PAGE, re.MULTILINE)


def score_solver():
    spec = importlib.util.spec_from_file_location("score_solver", SCORE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class HardScenes(CommandLine):
    @unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
    def test_all_scenes_are_proved_but_those_that_the_page_names(self):
        chosen = [line for line in lines() if IS_LONG or not name_of(line).startswith(SLOW)]
        self.write("chosen.jsonl", "".join(chosen))
        found = verified(self.directory / "chosen.jsonl")
        expected = {name_of(line) for line in chosen} & set(undecided())
        self.assertEqual((found["refuted"], found["malformed"]), (0, 0), found["claims"])
        self.assertEqual({claim["place"] for claim in found["claims"]}, expected, found["claims"])
        self.assertEqual(found["proved"], len(chosen) - len(expected))

    def test_they_are_written_again_with_the_same_bytes(self):
        program = Path(CLATTER).parents[2] / "tests" / "hard_scenes"
        sets = () if IS_LONG else QUICK_SETS
        result = subprocess.run([program, *sets], capture_output=True, text=True, timeout=LONGEST)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        expected = [line for line in lines() if not sets or name_of(line).split(",")[0] in sets]
        self.assertTrue(result.stdout == "".join(expected), "tests/hard/README.md says how to write them again")

    def test_the_page_has_each_set_with_its_number_of_scenes(self):
        names = [name_of(line) for line in lines()]
        self.assertEqual(len(names), len(set(names)))
        counted = {}
        for name in names:
            counted[name.split(",")[0]] = counted.get(name.split(",")[0], 0) + 1
        told = re.findall(r"^\| `(\w+)` \| (\d+) \|", PAGE, re.MULTILINE)
        self.assertEqual({name: int(count) for name, count in told}, counted)
        self.assertIn(f" {len(names)} scenes ", PAGE)
        self.assertLessEqual(set(undecided()), set(names))

    def test_numbers_have_30_digits_and_events_at_most_10000(self):
        for line in lines():
            certificate = json.loads(line)
            self.assertLessEqual(len(certificate["events"]), 10000)
            for value, error in (certificate["end"]["x"], *(event["time"] for event in certificate["events"])):
                self.assertLessEqual(error, 1e-29 * max(abs(float(value)), 0.1), (certificate["name"], value))


class ScoreSolver(CommandLine):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.module = score_solver()
        cls.scenes = [json.loads(line) for line in lines()]

    def contacts(self, certificate):
        events = [event for event in certificate["events"] if event["event"] in ("impact", "touch")]
        return [(event["stop"], float(event["time"][0]), float(event["v"][0])) for event in events]

    def wrong(self, certificate, change=lambda contacts: contacts, shift=0.0):
        """What is wrong with a solver that returns the motion of a scene with some changes."""
        end = certificate["end"]
        state = float(end["x"][0]) + shift, float(end["v"][0])
        return self.module.score(certificate, lambda *scene: (change(self.contacts(certificate)), state))

    def test_the_motion_itself_is_right_in_every_scene(self):
        self.assertEqual({one["name"]: self.wrong(one) for one in self.scenes if self.wrong(one)}, {})

    def test_a_wrong_solver_is_wrong_in_every_scene(self):
        for one in self.scenes:
            end = one["end"]["time"]
            self.assertTrue(self.wrong(one, shift=2 * max(abs(float(one["end"]["x"][0])), 1)), one["name"])
            if not self.contacts(one):
                continue
            for change in (
                lambda contacts: contacts[1:],
                lambda contacts: [*contacts, ("upper", end, 1.0)],
                lambda contacts: [(stop, time + 1e-3 * end, v) for stop, time, v in contacts],
                lambda contacts: [("lower" if stop == "upper" else "upper", time, v) for stop, time, v in contacts],
                lambda contacts: [(stop, time, -v) for stop, time, v in contacts],
            ):
                if one["events"][-1]["event"] != "rest":  # any contact is a part of it
                    self.assertTrue(self.wrong(one, change), one["name"])

    def test_a_solver_without_end_is_wrong(self):
        def never_ends(*_):
            raise TimeoutError("no end")

        self.assertEqual(self.module.score(self.scenes[0], never_ends), "no end")

    def test_it_prints_what_scipy_gets_right(self):
        result = subprocess.run(
            [sys.executable, SCORE, SCENES, "graze_from_rest"], capture_output=True, text=True, timeout=LONGEST
        )
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"(?m)^graze_from_rest, 1e-2 past +right$")
        self.assertRegex(
            result.stdout, r"(?m)^graze_from_rest, 1e-12 past +impact on the upper stop at 2\.09\d+: found"
        )
        self.assertRegex(result.stdout, r"\nright in \d of 4\n$")

    def test_without_scipy_it_says_so_in_a_line(self):
        (self.directory / "scipy.py").write_text("raise ImportError\n", encoding="utf-8")
        environment = {**os.environ, "PYTHONPATH": str(self.directory)}
        result = subprocess.run([sys.executable, SCORE, SCENES], env=environment, capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^score_solver.py: SciPy isn't installed; .*\n$")


if __name__ == "__main__":
    unittest.main()
