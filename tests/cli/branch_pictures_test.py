"""Pictures of `clatter branch`, with a sweep, zones or a map behind them.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import subprocess
import unittest

from branch_runs import BRANCH, SCENE, WIDE, BranchRuns
from command_line import SOURCE


class BranchPictures(BranchRuns):
    def test_picture_has_branches_special_points_and_a_sweep_behind(self):
        self.branch(SCENE + BRANCH, "-q")
        self.write("s.toml", SCENE.replace("nu = 1.1\n", "") + "[sweep]\nnu = [1.1, 1.3]\n[observe]\nextrema = true\n")
        self.assertEqual(self.clatter("run", "s.toml", "-q").returncode, 0)
        plot = ["/usr/bin/python3", SOURCE / "scripts" / "plot.py", "--format", "svg"]
        files = [(self.directory / "a.branch.h5"), (self.directory / "s.h5")]
        result = subprocess.run([*plot, *files], capture_output=True, text=True, cwd=self.directory)
        self.assertEqual(result.returncode, 0, result.stderr)
        svg = (self.directory / "a.branch+s.svg").read_text(encoding="utf-8")
        for part in ('id="branch 0"', 'id="branch 1"', "<!-- fold -->", "<!-- graze -->", "<!-- sweep -->"):
            self.assertIn(part, svg)

    def test_picture_has_zones_and_the_conservative_motion_behind(self):
        scene = SCENE.replace("xs = -3", "xs = 0.5").replace("nu = 1.1", "nu = 2").replace("x0 = 2\nv0 = 3\n", "")
        self.branch(scene + '[branch]\nalong = "nu"\nrange = [1.3, 4]\n', "-q")
        starts = '[sweep]\nnu = [1.5, 2, 3]\nx0 = "sobol(-0.5, 0.5, 64)"\nv0 = "sobol(-2, 2, 64)"\nlinked = "x0, v0"\n'
        self.write("z.toml", scene.replace("nu = 2\n", "") + starts + "[observe]\nattractor = true\n")
        self.assertEqual(self.clatter("run", "z.toml", "-q").returncode, 0)
        plot = ["/usr/bin/python3", SOURCE / "scripts" / "plot.py", "--format", "svg", "--backbone"]
        files = [self.directory / "z.h5", self.directory / "a.branch.h5"]
        result = subprocess.run([*plot, *files], capture_output=True, text=True, cwd=self.directory)
        self.assertEqual(result.returncode, 0, result.stderr)
        svg = (self.directory / "z+a.branch.svg").read_text(encoding="utf-8")
        for part in (
            'id="soft zone"',
            'id="hard zone"',
            'id="backbone 1"',
            "dotted: conservative motion of the mean speed",
        ):
            self.assertIn(part, svg)
        for other in (SCENE.replace("xs = -3", "stop_upper = 3"), SCENE + "stiffness = 0.9\n"):
            self.assertEqual(self.branch(other + BRANCH, "-q", "--force").returncode, 0)
            result = subprocess.run([*plot, files[1]], capture_output=True, text=True)
            self.assertEqual(result.returncode, 2)
            self.assertIn("--backbone is of branches along nu of one machine", result.stderr)

    def test_picture_of_curves_has_the_map_of_a_sweep_behind(self):
        self.branch(SCENE + WIDE + 'across = "xs"\nacross_range = [2, 6]\ncurve = "fold"\n', "-q")
        scene = SCENE.replace("nu = 1.1\n", "").replace("xs = -3\n", "")
        self.write("m.toml", scene + "[sweep]\nxs = [2, 4, 6]\nnu = [0.5, 1, 2]\n[observe]\nword = true\n")
        self.assertEqual(self.clatter("run", "m.toml", "-q").returncode, 0)
        self.write("s.toml", scene + "xs = 3\n[sweep]\nnu = [0.5, 1]\n[observe]\nword = true\n")
        self.assertEqual(self.clatter("run", "s.toml", "-q").returncode, 0)
        plot = ["/usr/bin/python3", SOURCE / "scripts" / "plot.py", "--format", "svg"]
        files = [(self.directory / "m.h5"), (self.directory / "a.branch.h5")]
        result = subprocess.run([*plot, *files], capture_output=True, text=True, cwd=self.directory)
        self.assertEqual(result.returncode, 0, result.stderr)
        svg = (self.directory / "m+a.branch.svg").read_text(encoding="utf-8")
        for part in ('id="folds 0"', "<!-- folds -->", "<!-- resonant graze -->", "<image"):
            self.assertIn(part, svg)
        result = subprocess.run([*plot, self.directory / "s.h5", files[1]], capture_output=True, text=True)
        self.assertEqual(result.returncode, 2)
        self.assertIn("a map behind curves runs over nu and xs", result.stderr)


if __name__ == "__main__":
    unittest.main()
