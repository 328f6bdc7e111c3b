"""A warning of anything that looks unintended appears once, on stderr, before the run, and the run goes on."""

import json
import unittest

import h5py
import numpy as np
from command_line import SMALL, SOURCE, CommandLine

TRANSIENT = ["--set", "time.mode=transient", "--set", "time.duration=20"]
FREE = ["--set", "scene.f=0", "--set", "scene.v0=-3", "--set", "observe.period=false"]
NO_STOPS = ["--set", "scene.stop_lower=-inf", "--set", "scene.stop_upper=inf"]
IDLE = [  # a setting without effect, and what it stands beside
    ("time.duration=9", []),
    ("time.window=16", TRANSIENT),
    ("time.max_periods=3", TRANSIENT),
    ("time.tolerance=1e-3", TRANSIENT),
    ("integrator.theta=1", []),
    ("integrator.step=0.1", ["--set", "integrator.method=dopri5"]),
    ("integrator.tolerance=1e-3", ["--set", "integrator.method=moreau"]),
    ("integrator.effects=all", ["--set", "integrator.method=dopri5", *TRANSIENT]),
    ("observe.harmonics_samples=64", []),
    ("observe.harmonics_samples=64", ["--set", "observe.harmonics=3", "--set", "observe.harmonics_method=exact"]),
    ("observe.harmonics_method=exact", []),
    ("scene.nu=3", FREE),
    ("scene.phase=1", FREE),
    ("scene.nu=3", [*FREE, "--set", "integrator.method=moreau"]),
    ("scene.R=0.5", ["--set", "scene.R=1", *NO_STOPS]),
    ("time.max_impacts=1", ["--set", "scene.R=1", *NO_STOPS]),
    ("scene.R_lower=0.5", ["--set", "scene.stop_lower=-inf"]),
]


class Warnings(CommandLine):
    def run_ok(self, *words):
        result = self.clatter("run", *words)
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        return result.stderr.splitlines()

    def values(self, name):
        with h5py.File(self.directory / name) as file:
            return {variable: file[variable][()] for variable in file}

    def test_settings_without_effect_change_nothing_but_are_named(self):
        config = self.write(
            "a.toml",
            SMALL.replace('nu = "linspace(0.5, 1.5, 5)"', "h = [0.1, 0.2]")
            .replace("h = 0.1\n", "")
            .replace("xs = -4.0", "xs = -1.0"),
        )
        for setting, beside in IDLE:
            with self.subTest(setting=setting, beside=beside):
                without = self.run_ok(config, "-o", "without.h5", *beside)
                self.assertEqual(len(without), 1, without)
                said = self.run_ok(config, "-o", "with.h5", *beside, "--set", setting)
                self.assertEqual(len(said), 2, said)
                name = setting.split("=")[0].split(".")[1]
                self.assertTrue(said[0].startswith(f"--set {setting}: warning: '{name}' has no effect "), said[0])
                one, other = self.values("without.h5"), self.values("with.h5")
                self.assertEqual(list(one), list(other))
                for variable, values in one.items():
                    np.testing.assert_array_equal(values, other[variable], variable)

    def test_warnings_have_line_and_column_come_once_and_end_with_0(self):
        text = SMALL + '[time]\nwindow = 16\nmode = "transient"\nduration = 9\n'
        for name in ("a.toml", "a.ini"):
            self.write(name, text)
            expected = f"{name}:13:1: warning: 'window' has no effect in a transient; "
            for options in ([], ["-v"]):
                said = self.run_ok(name, *options)
                self.assertEqual(sum(line.startswith(expected) for line in said), 1, said)
                self.assertEqual(sum("no effect" in line for line in said), 1, said)
            self.assertEqual(self.run_ok(name, "-q"), [])  # errors only

    def test_plan_says_the_same(self):
        config = self.write("a.toml", SMALL + "[time]\nduration = 9\n")
        result = self.clatter("plan", config)
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r"^a.toml:13:1: warning: 'duration' has no effect [^\n]+\n$")
        self.assertNotIn("warning", result.stdout)
        as_json = self.clatter("plan", config, "--json")
        self.assertEqual(as_json.stderr, "")
        self.assertRegex(json.loads(as_json.stdout)["warnings"][0], "^a.toml:13:1: 'duration' has no effect ")

    def test_a_run_that_observes_nothing_is_told_once(self):
        config = self.write("a.toml", "[scene]\nxs = 1\nf = 1\n")
        for options in ([], ["-v"]):
            said = self.run_ok(config, *options)
            self.assertEqual(
                [line for line in said if "nothing is observed" in line],
                [
                    "a.toml:1:1: warning: nothing is observed: the file will hold only status, impacts "
                    "and periods; write e.g. extrema = true in [observe]"
                ],
            )
        said = self.clatter("plan", config).stderr
        self.assertEqual(said.count("nothing is observed"), 1, said)

    def test_a_value_twice_on_an_axis_is_told_where_it_crosses(self):
        config = self.write("a.toml", SMALL)
        twice = ["--set", "sweep.nu=0.8, 0.8"]
        self.assertRegex(self.run_ok(config, *twice)[0], r"^--set sweep.nu=0.8, 0.8: warning: nu = 0.8 again, ")
        self.assertEqual(len(self.run_ok(config, *twice, "--set", "sweep.follow=nu")), 1)
        self.assertEqual(
            len(self.run_ok(config, *twice, "--set", "sweep.h=0.1, 0.2", "--set", "sweep.linked=nu, h")), 1
        )

    def test_accuracy_warns_of_its_own_choices(self):
        config = self.write(
            "a.toml",
            '[scene]\nxs = 1\nv0 = 1\nnu = 2\n[time]\nmode = "transient"\nduration = 1\n'
            "window = 9\n[integrator]\ntheta = 1\n",
        )
        result = self.clatter("accuracy", config, "--rounds", "1", "--json", "--arch", "scalar")
        self.assertEqual(result.returncode, 0, result.stderr)
        said = [line for line in result.stderr.splitlines() if "warning" in line]
        self.assertEqual(
            [line.split(" has ")[0] for line in said], ["a.toml:4:1: warning: 'nu'", "a.toml:8:1: warning: 'window'"]
        )
        quiet = self.clatter("accuracy", config, "--rounds", "1", "--json", "--arch", "scalar", "-q")
        self.assertEqual(quiet.stderr, "")

    def test_defaults_and_the_configuration_of_an_output_give_none(self):
        for name, words in (("d.toml", ["defaults"]), ("d.ini", ["defaults", "--ini"])):
            self.write(name, self.clatter(*words).stdout)
            self.assertEqual(len(self.run_ok(name)), 1)
        config = self.write("a.toml", SMALL)
        self.run_ok(config)
        self.write("again.toml", self.clatter("info", "a.h5", "--config").stdout)
        self.assertEqual(len(self.run_ok("again.toml")), 1)

    def test_the_configurations_that_come_along_give_none(self):
        for config in sorted((SOURCE / "configs").iterdir()):
            if config.suffix in (".toml", ".ini"):
                result = self.clatter("plan", str(config))
                self.assertEqual(result.returncode, 0)
                self.assertNotIn(config.name, result.stderr)


class CommandLineWins(CommandLine):
    def test_set_comes_before_the_file_and_verbose_says_so(self):
        config = self.write("a.toml", SMALL)
        cases = [
            ("sweep.R=0.5,0.6", "--set sweep.R=0.5,0.6 in place of 'R', a.toml:5:1"),
            ("scene.nu=1.2", "--set scene.nu=1.2 in place of 'nu', a.toml:8:1"),
            (
                "scene.stop_upper=5",
                "--set scene.stop_upper=5 in place of 'xs', a.toml:6:1, which stays as 'stop_lower'",
            ),
            ("scene.R_lower=0.5", "--set scene.R_lower=0.5 in place of 'R', a.toml:5:1, which stays as 'R_upper'"),
        ]
        for setting, note in cases:
            with self.subTest(setting):
                said = self.clatter("run", config, "--set", setting, "-v")
                self.assertEqual(said.returncode, 0, said.stderr)
                self.assertEqual(said.stderr.splitlines().count(note), 1, said.stderr)
                self.assertNotIn(note, self.clatter("run", config, "--set", setting).stderr)
                self.assertIn(note, self.clatter("plan", config, "--set", setting).stderr)
        self.write("b.toml", SMALL.replace("xs = -4.0", "stop_upper = 5.0\nstop_lower = -4.0"))
        said = self.clatter("run", "b.toml", "--set", "scene.xs=-3", "-v").stderr
        self.assertIn("--set scene.xs=-3 in place of 'stop_lower', b.toml:7:1\n", said)
        self.assertIn("--set scene.xs=-3 in place of 'stop_upper', b.toml:6:1\n", said)


if __name__ == "__main__":
    unittest.main()
