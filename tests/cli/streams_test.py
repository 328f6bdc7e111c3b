"""A configuration from standard input, and results that don't go to standard output."""

import os
import subprocess
import unittest

from command_line import CLATTER, LONGEST, SANITIZED, SMALL, CommandLine
from faulty_calls import shim_for

SMALL_INI = SMALL.replace('nu = "linspace(0.5, 1.5, 5)"', "nu = linspace(0.5, 1.5, 5)  ; an axis")


class StandardInput(CommandLine):
    def piped(self, text, *words):
        return subprocess.run(
            [CLATTER, *words], cwd=self.directory, input=text.encode(), capture_output=True, timeout=LONGEST
        )

    def assert_piped_refused(self, code, words, text, *command):
        result = self.piped(text, *command)
        self.assertEqual((result.returncode, result.stdout), (code, b""), result.stderr)
        self.assertIn(words, result.stderr.decode())
        self.assertEqual(self.files(), [])

    def test_gives_the_same_file_as_a_file_of_the_same_text(self):
        result = self.piped(SMALL, "run", "-", "-o", "piped.h5")
        self.assertEqual((result.returncode, result.stdout), (0, b""), result.stderr)
        self.assertRegex(result.stderr.decode(), r"^5 points, 0 failed, [0-9.e-]+ s, piped\.h5\n$")
        result = self.piped(SMALL_INI, "run", "--ini", "-", "-o", "ini.h5")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.clatter("run", self.write("small.toml", SMALL))
        bytes_of = {name: (self.directory / name).read_bytes() for name in ("piped.h5", "ini.h5", "small.h5")}
        self.assertEqual(bytes_of["piped.h5"], bytes_of["small.h5"])
        self.assertEqual(bytes_of["ini.h5"], bytes_of["small.h5"])

    def test_takes_changes_and_goes_on_like_a_file(self):
        result = self.piped(SMALL, "run", "-", "-o", "a.h5", "--set", "scene.xs=-1", "--set", "time.max_impacts=1")
        self.assertEqual(result.returncode, 1, result.stderr)
        shard = self.piped(SMALL, "run", "-", "-o", "b.h5", "--shard", "0/2")
        self.assertEqual(shard.returncode, 0, shard.stderr)
        plan = self.piped(SMALL, "plan", "-")
        self.assertEqual((plan.returncode, plan.stderr), (0, b""))
        self.assertIn(b"nu (5 from 0.5 to 1.5)", plan.stdout)

    def test_needs_a_name_for_the_output(self):
        words = "a configuration from stdin has no name to give the output; name it with -o FILE.h5"
        for command in (["run", "-"], ["run", "-", "--shard", "0/2"], ["accuracy", "-"]):
            self.assert_piped_refused(2, words, SMALL, *command)

    def test_mistakes_name_it_with_line_and_column(self):
        self.assert_piped_refused(2, "stdin:2:6: xs = 0 is out of range", "[scene]\nxs = 0\n", "run", "-", "-o", "a.h5")
        self.assert_piped_refused(2, "; read as TOML; for INI give --ini", SMALL_INI, "run", "-", "-o", "a.h5")
        self.assert_piped_refused(
            2, "stdin:3:6: expected a number", "[scene]\nf = 1 ; INI\nxs = a\n", "plan", "-", "--ini"
        )
        self.assert_piped_refused(2, "stdin:1:1: 'xs' is missing", "", "run", "-", "-o", "a.h5")
        self.assert_piped_refused(2, "stdin:1:1: more than 1 MiB", "#" * 2000000, "run", "-", "-o", "a.h5")
        self.assert_piped_refused(
            74, "stdin: cannot be read: it holds NUL bytes", "[scene]\0", "run", "-", "-o", "a.h5"
        )

    def test_that_is_a_directory_is_refused(self):
        folder = os.open(self.directory, os.O_RDONLY)
        self.addCleanup(os.close, folder)
        result = subprocess.run([CLATTER, "plan", "-"], stdin=folder, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (74, "clatter: stdin: cannot be read: Is a directory\n"))

    def test_warnings_name_it(self):
        result = self.piped(SMALL + "[time]\nduration = 9\n", "run", "-", "-o", "a.h5")
        self.assertTrue(result.stderr.startswith(b"stdin:13:1: warning: 'duration' has no effect"), result.stderr)

    def test_a_file_of_that_name_has_a_path(self):
        self.write("-", SMALL)
        result = self.clatter("run", "./-", "-o", "a.h5")
        self.assertEqual(result.returncode, 0, result.stderr)


class Ini(CommandLine):
    def test_is_told_by_the_option_if_the_name_does_not(self):
        self.write("a.cfg", SMALL_INI)
        self.assert_refused(2, "; read as TOML; for INI give --ini, or a name that ends in .ini", "run", "a.cfg")
        self.assertEqual(self.clatter("run", "a.cfg", "--ini").returncode, 0)
        self.assertIn("a.h5", self.files())

    @unittest.skipIf(SANITIZED, "a sanitizer has comparisons of its own")
    def test_the_work_of_a_long_file_grows_as_its_length(self):
        """40 000 keys took nine seconds: each was compared with all before it. Here comparisons are counted."""
        library = shim_for(self)

        def comparisons(keys, ending):
            text = "[scene]\n" + "".join(f"k{i:06} = 1\n" for i in range(keys))
            told = self.directory / "comparisons"
            shim = {"LD_PRELOAD": library, "CLATTER_COMPARISONS": str(told)}
            result = self.clatter("plan", self.write("long" + ending, text), environment=shim)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(":2:1: unknown key 'k000000' in [scene]", result.stderr)
            return int(told.read_text())

        for ending in (".ini", ".toml"):
            few, many = comparisons(2000, ending), comparisons(16000, ending)
            self.assertGreater(few, 2000)
            self.assertLess(many, 12 * few)  # n log n is 10.2, n^2 is 64


class StandardOutput(CommandLine):
    def test_takes_no_results(self):
        config = self.write("a.toml", SMALL)
        words = "-o - is no file, and HDF5 can't go to standard output; name a file (./- for one called -)"
        for command in (
            ["run", config, "-o", "-"],
            ["run", config, "-o-"],
            ["run", config, "--output=-"],
            ["accuracy", config, "-o", "-"],
            ["merge", "-o", "-", "a.h5"],
        ):
            self.assert_refused(2, words, *command)
        self.assertEqual(self.clatter("run", config, "-o", "./-").returncode, 0)
        self.assertIn("-", self.files())


if __name__ == "__main__":
    unittest.main()
