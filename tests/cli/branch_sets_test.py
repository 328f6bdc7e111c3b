"""Sets of branches that were once found in part are found whole, whichever branch they are begun with.

Environment: CLATTER, the program.
"""

import tomllib
import unittest
from pathlib import Path

from branch_sets import Sets, parameter_of
from command_line import CLATTER, CommandLine

import h5py

KEPT = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))["set"]


class BranchSets(CommandLine):
    def specials(self, text):
        self.write("a.toml", text)
        self.clatter("branch", "a.toml", "-o", "b.h5", "-q")
        with h5py.File(self.directory / "b.h5") as file:
            kinds, values = file["special_kind"][()], file[f"special_{parameter_of(text)}"][()]
        return [(kind.decode(), value) for kind, value in zip(kinds, values)]

    def test_each_has_its_special_points(self):
        for kept in KEPT:
            with self.subTest(kept["why"]):
                found = self.specials(kept["text"])
                for kind, at in kept["has"]:
                    self.assertTrue([a for k, a in found if k == kind and abs(a - at) <= 1e-11 * at], (kind, at))
                self.assertFalse([kind for kind, _ in found if kind in kept.get("has_no", ())])

    def test_each_is_found_from_any_of_its_branches(self):
        for kept in KEPT:
            with self.subTest(kept["why"]):
                failures = Sets(CLATTER, (), [kept["text"]]).failures
                self.assertEqual(failures.report(), "")
                self.assertGreater(failures.compared, 0)


if __name__ == "__main__":
    unittest.main()
