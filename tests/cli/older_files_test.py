"""Files of release 0.2.0: outputs are read, a journal and shards are refused with what to do.

tests/release_0.2.0/README.md says how that release made them.
"""

import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np
from command_line import SOURCE, CommandLine

KEPT = SOURCE / "tests" / "release_0.2.0"
SHARDS = ("small.0-of-2.h5", "small.1-of-2.h5")


class OlderFiles(CommandLine):
    def setUp(self):
        super().setUp()
        for path in KEPT.iterdir():
            shutil.copy(path, self.directory)

    def bytes_of(self, name):
        return (self.directory / name).read_bytes()

    def test_are_of_that_release(self):
        for name in ("small.h5", "branch.h5", *SHARDS):
            with h5py.File(self.directory / name) as file:
                self.assertEqual((file.attrs["clatter_version"], file.attrs["clatter_schema"]), ("0.2.0", "clatter/1"))
        self.assertIn(b"0.2.0", self.bytes_of("large.h5.journal")[:200])

    def test_of_a_run_has_the_variables_and_values_of_this_program(self):
        config = self.clatter("info", "--config", "small.h5").stdout
        self.write("again.toml", config)
        self.assertEqual(self.clatter("run", "again.toml", "-q").returncode, 0)
        with h5py.File(self.directory / "small.h5") as old, h5py.File(self.directory / "again.h5") as new:
            self.assertLessEqual(set(old), set(new))
            for name in old:
                self.assertEqual(old[name].dtype, new[name].dtype, name)
                if old[name].dtype.kind == "f":
                    has = np.ones(old[name].shape, bool)
                    if name.endswith("_phase") and name.replace("phase", "amplitude") in old:
                        has = old[name.replace("phase", "amplitude")][()] > 1e-9  # else it is that of rounding
                    np.testing.assert_allclose(
                        old[name][()][has], new[name][()][has], rtol=1e-9, atol=1e-12, err_msg=name
                    )
                elif name not in ("impact_word", "regime"):  # "-" in place of an empty text
                    np.testing.assert_array_equal(old[name], new[name], err_msg=name)

    def test_of_runs_and_branches_are_read_by_every_command(self):
        for words in (
            ("info", "small.h5"),
            ("info", "--check", "small.h5"),
            ("info", "small.h5", "--max", "x_max"),
            ("export", "small.h5"),
            ("certify", "small.h5", "-o", "small.jsonl"),
            ("info", "branch.h5"),
            ("export", "branch.h5", "--special"),
            ("branch", "branch.toml", "--from", "small.h5", "--where", "nu=1.1", "-o", "from.h5"),
        ):
            result = self.clatter(*words)
            self.assertEqual(result.returncode, 0, (words, result.stderr))
        for name in ("small.h5", "branch.h5"):
            for script in ("plot.py", "report.py"):
                output = self.directory / f"{name}.{script}.html"
                command = [sys.executable, SOURCE / "scripts" / script, self.directory / name, "-o", output]
                drawn = subprocess.run(command, capture_output=True, text=True)
                self.assertEqual(drawn.returncode, 0, drawn.stderr)
                self.assertTrue(output.exists())

    def test_of_a_run_is_replaced_when_its_configuration_runs_again(self):
        result = self.clatter("run", "small.toml")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_journal_is_refused_with_what_to_do_and_stays(self):
        before = self.bytes_of("large.h5.journal")
        result = self.clatter("run", "large.toml")
        self.assertEqual(result.returncode, 74)
        self.assertRegex(
            result.stderr,
            r"'large\.h5\.journal' has the finished points of another run; run that again to complete it, begin anew "
            r"with --restart, or [^\n]*-o[^\n]*:\n(.*\n)*.*program: 0\.2\.0",
        )
        self.assertEqual(self.bytes_of("large.h5.journal"), before)
        self.assertNotIn("large.h5", self.files())
        self.assertEqual(self.clatter("run", "large.toml", "--restart").returncode, 0)
        self.assertNotIn("large.h5.journal", self.files())

    def test_shards_are_refused_with_what_to_do_and_stay(self):
        before = [self.bytes_of(name) for name in SHARDS]
        result = self.clatter("merge", "-o", "merged.h5", *SHARDS)
        self.assertEqual(result.returncode, 74)
        self.assertRegex(
            result.stderr, r"'small\.0-of-2\.h5' was written by clatter 0\.2\.0 .*; merge with the program that ran"
        )
        self.assertEqual([self.bytes_of(name) for name in SHARDS], before)
        self.assertNotIn("merged.h5", self.files())
        self.assertEqual(self.clatter("info", SHARDS[0]).returncode, 0)


if __name__ == "__main__":
    unittest.main()
