"""Shared by the tests of the command line: the program in a directory of its own."""

import os
import pathlib
import re
import signal
import subprocess
import tempfile
import unittest

CLATTER = os.environ["CLATTER"]
SOURCE = pathlib.Path(os.environ.get("CLATTER_SOURCE", pathlib.Path(__file__).parents[2]))

SANITIZED = os.environ.get("CLATTER_FAULTS") == ""  # such a program takes other memory, and can't have its calls fail

SMALL = """title = "a small sweep"
[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -4.0
[sweep]
nu = "linspace(0.5, 1.5, 5)"
[observe]
extrema = true
period = true
"""


def runs_here(name):
    """Whether this machine has an instruction set, as Linux reports."""
    flags = set(re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)[1].split())
    needed = {"avx2": "avx2 fma", "avx512": "avx512f avx512dq avx512cd avx512bw avx512vl"}
    return set(needed.get(name, "").split()) <= flags


def handled_signals(process):
    """Those of SIGINT and SIGTERM that a process handles; none once it has ended."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
    caught = int(re.search(r"^SigCgt:\s*(\w+)$", status, re.MULTILINE)[1], 16)
    return {number for number in (signal.SIGINT, signal.SIGTERM) if caught >> (number - 1) & 1}


class CommandLine(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def clatter(self, *words, environment=None):
        return subprocess.run(
            [CLATTER, *words],
            cwd=self.directory,
            capture_output=True,
            text=True,
            timeout=300,
            env={**os.environ, **(environment or {})},
        )

    def write(self, name, text):
        (self.directory / name).write_text(text, encoding="utf-8")
        return name

    def files(self):
        return sorted(path.name for path in self.directory.iterdir())

    def assert_refused(self, code, words, *command):
        """The command ends with this code and one line on stderr that says why; nothing on stdout, no new file."""
        before = self.files()
        result = self.clatter(*command)
        self.assertEqual(result.returncode, code, (command, result.stderr))
        self.assertIn(words, result.stderr, command)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertEqual(result.stdout, "", command)
        self.assertEqual(self.files(), before, command)
