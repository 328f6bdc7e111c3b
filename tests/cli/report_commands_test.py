"""Commands that reports show: typed into bash, each gives the numbers that its point has in the file."""

import json
import math
import unittest
from unittest import mock

import numpy as np

from report_runs import NO_PICTURE, ReportRuns, command_at, data_of, in_shell, results_at
from script_runs import run_script

DRIVE = {"mass": 0.5, "stiffness": 12800, "damping": 16, "force": 12.8, "frequency": 25, "R": 0.7, "gap": 4e-3}
BALL = {"load": -1, "stiffness": 0, "R": 0.8, "stop_lower": 0, "x0": 0.1}
FORCED = {"f": -1.0, "h": 0.1, "R": 0.7, "xs": -4.0}
OBSERVE = {"extrema": True, "impacts": True, "period": True, "word": True, "energy": True}


def toml(**sections):
    """A configuration as text; keys of [sweep] aren't repeated in its scene."""
    lines = []
    for name, keys in sections.items():
        lines.append(f"[{name}]")
        for key, value in keys.items():
            if name not in ("scene", "machine") or key not in sections.get("sweep", {}):
                lines.append(f"{key} = {json.dumps(value)}".replace("Infinity", "inf"))
    return "\n".join(lines) + "\n"


class Commands(ReportRuns):
    def setUp(self):
        super().setUp()
        self.without_pictures = mock.patch("clatter.reports.page.picture", return_value=NO_PICTURE)
        self.without_pictures.start()
        self.addCleanup(mock.patch.stopall)

    def check_text(self, name, text, command="run"):
        """Makes the output of a configuration that the user no longer has, and checks it."""
        self.run_config(self.write(f"{name}.toml", text), f"{name}.h5", command=command)
        (self.directory / f"{name}.toml").unlink()
        return self.check(f"{name}.h5")

    def test_linked_axes_are_set_together(self):
        sweep = {"nu": [0.5, 0.75, 1.0], "f": [-1.0, -1.5, -1.7], "linked": "nu, f"}
        data = self.check_text("linked", toml(scene=FORCED, sweep=sweep, observe=OBSERVE))
        self.assertIn("--set scene.nu=1 --set scene.f=-1.7 --set sweep.linked=''", command_at(data, (2,)))

    def test_a_followed_sweep_is_run_again_from_its_start(self):
        nu, linked = {"nu": "linspace(0.95, 1.25, 31)"}, {"f": "linspace(-1, -1.5, 31)", "linked": "nu, f"}
        both = {"follow": "nu", "direction": "both"}
        sweeps = {
            "down": {**nu, "follow": "nu", "direction": "down"},
            "both": {**nu, "R": [0.5, 0.7], **both},
            "linked": {**nu, **linked, "R": [0.5, 0.7], "follow": "nu, f"},
            "second": {**nu, **linked, "follow": "f", "direction": "down"},
            "others": {"R": [0.5, 0.7], "h": [0.1, 0.2], "linked": "R, h", **nu, "follow": "nu"},
            "up_and_down": {"nu": [1.0, 1.1, 1.17, 1.1, 1.0], "R": [0.5, 0.7], "follow": "nu"},
            "twice": {"R": [0.5, 0.7], "nu": [1.0, 1.1, 1.17, 1.1], **both},
        }
        for name, sweep in sweeps.items():
            with self.subTest(name):
                self.check_text(name, toml(scene=FORCED, sweep=sweep, observe=OBSERVE))

    def test_failed_points_and_those_after_them_are_repeated(self):
        for follow in ("", "f"):
            sweep = {"f": [0.3, 0.7, 1.1, 0.5, 0.6], "follow": follow}
            text = toml(scene=BALL, sweep=sweep, time={"max_impacts": 60}, observe=OBSERVE)
            done = self.clatter("run", self.write("ball.toml", text), "-o", f"ball{follow}.h5", "-q")
            self.assertEqual((done.returncode, done.stderr), (1, ""))
            with self.subTest(follow):
                self.check(f"ball{follow}.h5", places=range(5))

    def test_starts_phases_and_keys_of_a_machine_are_set_as_they_are(self):
        starts = {"x0": "sobol(-0.003, 0.003, 8)", "v0": "sobol(-0.1, 0.1, 8)", "phase": "sobol(0, 2*pi, 8)"}
        sweep = {
            "stiffness": "linspace(10 kN/m, 13 kN/m, 3)",
            "gap": [0.004, 0.006],
            **starts,
            "linked": "x0, v0, phase",
        }
        drive = {key: value for key, value in DRIVE.items() if key not in sweep}
        self.check_text("drive", toml(machine=drive, sweep=sweep, observe={**OBSERVE, "attractor": True}))

    def test_axes_with_infinite_values_have_commands_motion_and_pictures(self):
        self.without_pictures.stop()
        soft = {key: value for key, value in FORCED.items() if key != "R"}
        for follow in ("", "stop_stiffness"):
            sweep = {"stop_stiffness": [1e2, 1e4, math.inf], "nu": [0.9, 1.0], "follow": follow}
            with self.subTest(follow):
                data = self.check_text(f"soft{follow}", toml(scene=soft, sweep=sweep, observe=OBSERVE))
                self.assertEqual(run_script("plot.py", f"soft{follow}.h5", cwd=self.directory).stderr, "")
                if not follow:
                    self.assertEqual(data["histories"]["axes"][0], [1e2, 1e4, "inf"])
                    self.assertTrue(all(data["histories"]["records"]))

    def test_branches_of_machines_shaken_scenes_and_soft_stops_start_at_phase_0(self):
        machine, shaken = {**DRIVE, "phase": 1}, {"h": 0.05, "R": 0.6, "xs": 0.3, "stop_amplitude": 0.2, "nu": 1.5}
        soft = {"f": 1, "h": 0.05, "nu": 2, "xs": 0.5, "stop_stiffness": 30, "stop_damping": 0.1, "phase": 2}
        moreau = {"method": "moreau"}  # which branches don't use
        branches = {  # section, its keys, what it is followed along
            "frequency": ("machine", machine, [22, 28]),
            "stiffness": ("machine", machine, [11e3, 14e3]),
            "gap": ("machine", {**machine, "R": 0.1, "gap": 1e-3}, [1e-3, 5e-3]),
            "nu": ("scene", {**FORCED, "nu": 1.1, "phase": 2}, [0.9, 1.3]),
            "stop_amplitude": ("scene", {**shaken, "phase": 1}, [0.1, 0.3]),
            "stop_stiffness": ("scene", soft, [10, 50]),
        }
        for along, (section, keys, limits) in branches.items():
            with self.subTest(along):
                branch = {"along": along, "range": limits, "switch": 1}
                text = toml(**{section: keys}, observe={"frame": "absolute"}, integrator=moreau, branch=branch)
                self.check_text(along, text, command="branch")

    def test_names_of_files_are_single_words_of_the_shell(self):
        self.write("a.toml", toml(scene=FORCED, sweep={"nu": [1.0, 1.1]}, observe=OBSERVE))
        names = ["$(touch made).h5", "it's `one`; two&.h5", "-o x.h5", "line\nbreak.h5", "\udcff ü.h5"]
        for name in names:
            with self.subTest(ascii(name)):
                self.run_config("a.toml", "made.h5")
                (self.directory / "made.h5").rename(self.directory / name)
                data = data_of(self.page("--", name))
                before = (self.directory / name).read_bytes()
                in_shell(command_at(data, (1,)), self.directory)
                np.testing.assert_equal(self.alone(name), results_at(self.directory / name, (1,)))
                self.assertEqual((self.directory / name).read_bytes(), before)
        self.assertNotIn("made", self.files())


if __name__ == "__main__":
    unittest.main()
