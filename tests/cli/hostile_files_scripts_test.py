"""plot.py and regress.sh refuse HDF5 files that lead to values elsewhere: they refuse each before a value is read,
open nothing but the file itself, and wait for nothing."""

import os
import re
import shutil
import signal
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py

from command_line import CLATTER, LONGEST, SMALL, SOURCE
from crafted_files import (
    CHANGES,
    REASONS,
    SECRET,
    claim,
    hide_variables,
    impact_words,
    make_surroundings,
    require_trace,
)
from script_runs import run_script

PYTHON = "/usr/bin/python3"
TOLD = {  # what the program says of each, which looks at it first
    **{name: words for name, words in REASONS.items() if name != "hidden_storage"},
    "schema": "not one of clatter's",
    "claimed": "its 'status' is longer than a file of its size can hold",
    "long_words": "cannot be read: ",
}
CASES = {
    **CHANGES,
    "schema": lambda file, folder: file.attrs.__setitem__("clatter_schema", "\x1b[2J"),
    "claimed": lambda file, folder: claim("status", (1 << 28,), file),
    "hidden": CHANGES["external_link"],
    "long_words": impact_words(dtype=h5py.string_dtype(), data=["L" * 256] * 5),
}
# Programs that look at one file after the other: as plot.py reads it, and as regress.sh tabulates it.
TRACED = """
import os, pathlib, sys
scripts, marks, *paths = sys.argv[1:]
sys.path.insert(0, scripts)
def each():
    for path in map(pathlib.Path, paths):
        try:
            os.open(f"{marks}/{path.stem}", os.O_RDONLY)
        except FileNotFoundError:
            yield path
"""
READS = """
from clatter.plots import data
for path in each():
    try:
        data.Output(path)
    except data.FileProblem:
        pass
"""
TABULATES = """
import regress
for path in each():
    sys.argv[1:] = ["table", str(path.parent), str(path.parent), "1e-9", path.stem]
    regress.main()
"""


class ForeignFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = Path(kept.name)
        (cls.folder / "small.toml").write_text(SMALL)
        output = cls.folder / "sound.h5"
        subprocess.run([CLATTER, "run", cls.folder / "small.toml", "-q", "-o", output], check=True, timeout=LONGEST)
        make_surroundings(cls.folder)
        cls.crafted = cls.folder / "crafted"
        cls.crafted.mkdir()
        for name, change in CASES.items():
            path = cls.crafted / f"{name}.h5"
            shutil.copy(output, path)
            with h5py.File(path, "r+") as file:
                change(file, cls.folder)
            if name == "hidden":
                hide_variables(path)
        content = output.read_bytes()
        texts = content.index(b"GCOL") + 64  # after the header and the first text, a block that a disk lost
        (cls.crafted / "zeros.h5").write_bytes(content[:texts] + bytes(128) + content[texts + 128 :])
        os.mkfifo(cls.crafted / "fifo.h5")
        cls.program = cls.folder / "clatter"  # has the same output ready for every configuration
        cls.program.write_text(f'#!/bin/sh\n[ "$1" = info ] && exec "{CLATTER}" "$@"\ncp "{output}" "$4"\n')
        cls.program.chmod(cls.program.stat().st_mode | stat.S_IXUSR)

    def expected(self):
        yield from ((self.crafted / f"{name}.h5", words) for name, words in TOLD.items())
        yield self.crafted / "zeros.h5", "heap"
        yield self.crafted / "fifo.h5", "not a regular file"

    def run_to_its_end(self, *words, clatter=None):
        """Ends all that it has started when it waits: else they would wait for ever."""
        program = subprocess.Popen(
            words,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
            env={**os.environ, "CLATTER": str(clatter or self.program)},
        )
        try:
            out, err = program.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            os.killpg(program.pid, signal.SIGKILL)
            program.communicate()
            raise
        return subprocess.CompletedProcess(words, program.returncode, out, err)

    def test_the_secret_would_be_read(self):
        with h5py.File(self.crafted / "external.h5") as file:
            self.assertEqual(file["x_max"][()].tobytes().decode(), SECRET[:33] + SECRET[: 8 * 5 - 33])

    def test_plot_and_report_refuse_them_in_one_line(self):
        before = sorted(self.crafted.iterdir())
        page = self.folder / "page.html"
        for script, name, options in (("plot.py", "plot.py", ()), ("report.py", "clatter-report", ("-o", page))):
            for path, words in self.expected():
                with self.subTest(path.stem, script=script):
                    result = run_script(script, path, *options, timeout=LONGEST)
                    self.assertEqual((result.returncode, result.stdout), (74, ""), result.stderr)
                    self.assertTrue(result.stderr.startswith(f"{name}: {path}"), result.stderr)
                    self.assertIn(words, result.stderr)
                    self.assertRegex(
                        result.stderr, "; (copy it again, or run its configuration again|[a-z]+ an? .*)\n$"
                    )
                    self.assertEqual(result.stderr.count("\n"), 1)
                    self.assertEqual(sorted(self.crafted.iterdir()), before)
                    self.assertFalse(page.exists())

    def test_without_the_program_they_are_refused_too(self):
        environment = {**os.environ, "CLATTER": str(self.folder / "none")}
        for path, _ in self.expected():
            if path.stem in ("zeros", "long_words"):
                continue  # HDF5 reads the first until its time is over, and the second is sound but for its length
            with self.subTest(path.stem):
                result = run_script("plot.py", path, environment=environment, timeout=LONGEST)
                self.assertEqual((result.returncode, result.stdout), (74, ""), result.stderr)
                self.assertRegex(result.stderr, f"^plot.py: {re.escape(str(path))}: [^\n]+\n$")

    def test_regress_finds_them_in_the_baseline(self):
        result = self.run_to_its_end(SOURCE / "scripts" / "regress.sh", self.crafted)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertNotIn(SECRET[:20], result.stdout + result.stderr)
        rows = {line.split()[0]: line for line in result.stdout.splitlines()}
        for path, words in self.expected():
            with self.subTest(path.stem):
                row = rows[path.stem]
                self.assertEqual(row.split()[1:7], ["-", "-", "-", "-", "-", "differs"])
                self.assertIn("can't be read: ", row)
                self.assertIn(words, row)

    def test_regress_waits_for_no_text(self):
        for name in ("fig22.txt", "SHA256SUMS"):
            baseline = self.folder / f"text_{name}"
            baseline.mkdir()
            (baseline / "fig21.txt").write_text("")
            os.mkfifo(baseline / name)
            result = self.run_to_its_end(SOURCE / "scripts" / "regress.sh", baseline)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(f"{baseline / name} isn't a regular file", result.stderr)

    def test_nothing_but_the_file_is_opened(self):
        require_trace()
        paths = [path for path, _ in self.expected()]
        for words in (READS, TABULATES):
            calls = self.traced(words, paths)
            self.assertNotIn("h5diff", "".join(line for lines in calls.values() for line in lines))
            for path in paths:
                with self.subTest(path.stem, words=words):
                    inside = {line.split('"')[1] for line in calls[path.stem] if f'"{self.folder}' in line}
                    self.assertEqual(inside - {CLATTER}, set() if path.stem == "fifo" else {str(path)})

    def traced(self, program, paths):
        """The calls that open or start something, by the stem of the file that a Python program is at. It tries to
        open a mark before each file, so that one process does for all."""
        trace, marks = self.folder / "trace", self.folder / "marks"
        tracing = ("strace", "-f", "-qq", "-o", trace, "-e", "trace=open,openat,openat2,execve")
        words = (*tracing, PYTHON, "-c", TRACED + program, SOURCE / "scripts", marks, *paths)
        self.run_to_its_end(*words, clatter=CLATTER)
        calls = {}
        for line in trace.read_text().splitlines():
            if f'"{marks}/' in line:
                lines = calls.setdefault(line.split(f'"{marks}/')[1].split('"')[0], [])
            elif calls:
                lines.append(line)
        self.assertEqual(list(calls), [path.stem for path in paths])
        return calls


if __name__ == "__main__":
    unittest.main()
