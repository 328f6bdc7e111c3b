"""Shared by the tests of scripts/regress.sh: runs of it, programs that have outputs ready for it, and its table."""

import os
import shutil
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py

from command_line import CLATTER, LONGEST, SOURCE, runs_here

FIGURES = {f"fig{number:02d}" for number in range(2, 24)}
ARCHES = list(filter(runs_here, ("scalar", "sse2", "avx2", "avx512")))
TABLE = ["output", "points", "variables", "largest", "where", "h5diff", "verdict", "differences"]


class RegressRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.outputs = Path(folder.name) / "outputs"
        result = cls.regress(cls.outputs, "--write", "h5", CLATTER_ARCH=ARCHES[-1])
        assert result.returncode == 0, result.stderr

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    @staticmethod
    def regress(*words, **environment):
        return subprocess.run(
            [SOURCE / "scripts" / "regress.sh", *words],
            capture_output=True,
            text=True,
            timeout=LONGEST,
            env={**os.environ, "CLATTER": CLATTER, **environment},
        )

    def program(self, **commands):
        """A clatter that has all outputs ready, but for those that it makes by a shell command, from "$@". It checks
        files, too: else an interpreter would be started to read each of them."""
        path = self.folder / "clatter"
        others = "\n".join(f"*/{name}.toml) {command} ;;" for name, command in commands.items())
        path.write_text(
            f"""#!/bin/sh
[ "$1" = run ] || exec "{CLATTER}" "$@"
case "$2" in
{others}
*) name=${{2##*/}}; cp "{self.outputs}/${{name%.toml}}.h5" "$4" ;;
esac
"""
        )
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    def changed(self, **settings):
        """A clatter that runs some configurations with another setting."""
        return self.program(**{name: f""""{CLATTER}" "$@" --set '{setting}'""" for name, setting in settings.items()})

    def edited(self, **edits):
        """A baseline of the figures, which every one has to have, and of other outputs that are edited."""
        baseline = self.folder / "baseline"
        baseline.mkdir()
        for name in FIGURES | edits.keys():
            shutil.copy(self.outputs / f"{name}.h5", baseline)
        for name, edit in edits.items():
            with h5py.File(baseline / f"{name}.h5", "r+") as file:
                edit(file)
        return baseline

    def rows(self, result):
        header, *lines = result.stdout.splitlines()
        self.assertEqual(header.split(), TABLE)
        return {row[0]: row[1:] for row in (line.split(maxsplit=7) for line in lines)}

    def assert_all_agree(self, result):
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        rows = self.rows(result)
        self.assertLessEqual(FIGURES, rows.keys())
        self.assertEqual({row[5] for row in rows.values()}, {"agrees"})
        self.assertEqual(result.stderr, f"{len(rows)} of {len(rows)} agree within 1e-09\n")
        return rows

    def assert_differ(self, result, **expected):
        """These outputs differ, each with these words in its line, and no other."""
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        rows = self.rows(result)
        self.assertLessEqual(FIGURES, rows.keys())
        self.assertEqual(
            {name: row[5] for name, row in rows.items() if row[5] != "agrees"},
            dict.fromkeys(expected, "differs"),
            result.stdout,
        )
        for name, words in expected.items():
            self.assertIn(words, rows[name][6], name)
        self.assertEqual(
            result.stderr.splitlines()[-1], f"{len(rows) - len(expected)} of {len(rows)} agree within 1e-09"
        )

    def assert_refused(self, result, words):
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertIn(words, result.stderr)
