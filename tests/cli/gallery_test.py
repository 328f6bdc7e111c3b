"""The pictures that the guides show are those that scripts/gallery.sh makes of shipped configurations.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import os
import re
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from command_line import SOURCE
from plot_checks import SVG, Svg
from script_runs import run_script

GALLERY = SOURCE / "scripts" / "gallery.sh"

# In place of plot.py beside gallery.sh: has the test run it, in one interpreter for all pictures.
ASKS = """#!/bin/bash
cd "$(dirname "$0")"
printf '%s\\0' "$OLDPWD" "$@" > request
{ read -r code; cat >&2; } < answer
exit "$code"
"""


def make_gallery(folder):
    """Runs gallery.sh in a tree of its own and draws what it asks for."""
    with tempfile.TemporaryDirectory() as name:
        scripts = Path(name) / "scripts"
        scripts.mkdir()
        (scripts / "gallery.sh").symlink_to(GALLERY)
        (scripts.parent / "configs").symlink_to(SOURCE / "configs")
        (scripts / "plot.py").write_text(ASKS)
        (scripts / "plot.py").chmod(0o755)
        for pipe in ("request", "answer"):
            os.mkfifo(scripts / pipe)
        command = ["bash", "-c", 'scripts/gallery.sh "$0"; code=$?; : > scripts/request; exit $code', folder]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        process = subprocess.Popen(command, cwd=scripts.parent, start_new_session=True, **pipes)
        try:
            while words := (scripts / "request").read_text().split("\0")[:-1]:  # an empty request is the last
                result = run_script("plot.py", *words[1:], cwd=words[0])
                (scripts / "answer").write_text(f"{result.returncode}\n{result.stderr}")
            out, err = process.communicate()
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)  # it waits for answers
            raise
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def places(panel):
    """The coordinates of all lines, markers and ticks of a panel, in points."""
    lines = (re.findall(r"-?[\d.]+", path.get("d")) for curve in panel.curves() for path in curve.iter(f"{SVG}path"))
    marks = ((use.get("x"), use.get("y")) for use in panel.group.iter(f"{SVG}use") if use.get("y"))
    return np.array([float(number) for part in (*lines, *marks) for number in part])


class Gallery(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = Path(kept.name)
        cls.result = make_gallery(cls.folder)

    def test_it_makes_all_pictures_of_the_guides_and_no_other(self):
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))
        made = {path.name for path in self.folder.iterdir()}
        self.assertEqual(made, {path.name for path in SOURCE.glob("configs/*.svg")})
        guides = [(SOURCE / name).read_text(encoding="utf-8") for name in ("README.md", "configs/README.md")]
        shown = {name for guide in guides for name in re.findall(r"!\[[^]]*\]\((?:configs/)?([\w.]+)\)", guide)}
        self.assertEqual(made, shown)

    def test_the_pictures_of_the_guides_say_and_hold_the_same(self):
        for path in self.folder.iterdir():
            with self.subTest(path.name):
                new, kept = Svg(path), Svg(SOURCE / "configs" / path.name)
                self.assertEqual(new.texts(), kept.texts())
                self.assertEqual([len(p.curves()) for p in new.panels], [len(p.curves()) for p in kept.panels])
                self.assertEqual([len(p.images()) for p in new.panels], [len(p.images()) for p in kept.panels])
                self.assertLess(path.stat().st_size, 300_000)

    def test_the_pictures_of_the_guides_have_their_lines_and_ticks_at_the_same_places(self):
        """But those of chaos, whose last digits are those of a machine."""
        compared = 0
        for path in self.folder.iterdir():
            new, kept = Svg(path), Svg(SOURCE / "configs" / path.name)
            if "aperiodic" in kept.texts() or any(panel.images() for panel in kept.panels):
                continue
            for mine, theirs in zip(new.panels, kept.panels):
                with self.subTest(path.name):
                    np.testing.assert_allclose(places(mine), places(theirs), atol=0.05)  # points
                    compared += len(places(mine))
        self.assertGreater(compared, 5000)

    def test_wrong_command_lines(self):
        for words, message in ((["--nonsense"], "unknown option"), (["a", "b"], "one directory at most")):
            result = subprocess.run([GALLERY, *words], capture_output=True, text=True, cwd=self.folder)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main()
