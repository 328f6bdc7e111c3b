"""The Python module: the same values as the program's files, and errors as exceptions with their place.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
import warnings
import zipfile
from pathlib import Path

import numpy as np
import xarray
from command_line import SOURCE, CommandLine

sys.path.insert(0, str(SOURCE / "scripts"))
import clatter  # noqa: E402  (it stands in the folder of the line above)

SWEEP = {"scene": {"h": 0.1, "f": -1.0, "xs": 4.0}, "sweep": {"nu": [0.9, 1.0, 1.1]}, "observe": {"extrema": True}}


class Module(CommandLine):
    def test_run_gives_the_values_of_the_programs_file(self):
        config = SOURCE / "configs" / "fig22.toml"
        self.assertEqual(self.clatter("run", config, "-o", "a.h5", "--set", "scene.R=0.8", "-q").returncode, 0)
        data = clatter.run(config, scene={"R": 0.8})
        with xarray.open_dataset(self.directory / "a.h5") as expected:
            xarray.testing.assert_identical(data, expected.load())

    def test_dictionaries_and_arrays_are_configurations_to_the_last_bit(self):
        nu = np.linspace(0.9, 1.1, 7) / 3 * 3
        data = clatter.run(SWEEP | {"title": 'of "Python"\n', "sweep": {"nu": nu}})
        np.testing.assert_array_equal(data.nu, nu)
        self.assertEqual(data.attrs["title"], 'of "Python"\n')
        np.testing.assert_array_equal(clatter.run(SWEEP, sweep={"nu": nu}).x_max, data.x_max)
        self.assertEqual(clatter.run(SWEEP, sweep={"nu": "linspace(1, 2, 4)"}, observe={"word": True}).nu.size, 4)

    def test_units_stand_in_texts_and_lists_of_texts(self):
        machine = {"mass": "250 g", "stiffness": 1000.0, "gap": "2 mm", "force": 3, "R": 0.7}
        config = {"machine": machine, "sweep": {"frequency": ["10 Hz", "20 Hz"]}, "observe": {"extrema": True}}
        data = clatter.run(config)
        np.testing.assert_array_equal(data.frequency, [10, 20])
        self.assertEqual(data.v_max.attrs["units"], "m s-1")
        np.testing.assert_array_equal(clatter.run(config, sweep={"frequency": ["10 Hz", "20 Hz"]}).x_max, data.x_max)

    def test_output_is_kept_if_it_is_named(self):
        data = clatter.run(SWEEP, output=self.directory / "kept.h5", threads=1)
        with xarray.open_dataset(self.directory / "kept.h5") as kept:
            np.testing.assert_array_equal(kept.x_max, data.x_max)

    def test_plan_is_the_programs(self):
        def but_for_times(value):
            if isinstance(value, dict):
                return {key: but_for_times(item) for key, item in value.items() if "seconds" not in key}
            return [but_for_times(item) for item in value] if isinstance(value, list) else value

        config = SOURCE / "configs" / "fig22.toml"
        expected = json.loads(self.clatter("plan", config, "--json").stdout)
        self.assertEqual(but_for_times(clatter.plan(config)), but_for_times(expected))

    def test_branches_have_points_and_special_points(self):
        data = clatter.branch(SOURCE / "configs" / "branch.toml", branch={"switch": 0})
        self.assertEqual(data.nu.dims, ("point",))
        self.assertIn("fold", data.special_kind.values.astype(str))

    def test_mistakes_name_the_key_of_a_dictionary_or_the_place_in_a_file(self):
        with self.assertRaises(clatter.ConfigError) as caught:
            clatter.run(SWEEP | {"scene": {"h": 0.1, "xs": 0.0}})
        self.assertEqual((caught.exception.key, caught.exception.file), ("scene.xs", None))
        self.assertTrue(str(caught.exception).startswith("scene.xs: "), str(caught.exception))
        with self.assertRaises(clatter.ConfigError) as caught:
            clatter.run(SWEEP, scene={"R": 2})
        self.assertEqual((caught.exception.key, caught.exception.exit_code), ("scene.R", 2))
        self.write("a.toml", "[scene]\nxs = 1\nnuu = 2\n")
        with self.assertRaises(clatter.ConfigError) as caught:
            clatter.run(self.directory / "a.toml")
        self.assertEqual((caught.exception.line, caught.exception.column, caught.exception.key), (3, 1, None))
        self.assertEqual(Path(caught.exception.file), self.directory / "a.toml")

    def test_other_failures_are_errors_with_the_exit_code(self):
        with self.assertRaises(clatter.ClatterError) as caught:
            clatter.run(self.directory / "none.toml")
        self.assertNotIsInstance(caught.exception, clatter.ConfigError)
        self.assertEqual(caught.exception.exit_code, 74)
        with self.assertRaisesRegex(clatter.ClatterError, "settles on no periodic motion"):
            clatter.branch(SOURCE / "configs" / "branch.toml", scene={"nu": 0.9}, time={"max_periods": 60})
        for wrong, error in (({"scene": 1}, TypeError), ({"scene": {"nu": {1, 2}}}, TypeError)):
            with self.assertRaises(error):
                clatter.run(SWEEP, **wrong)
        with self.assertRaisesRegex(TypeError, r"output = {'compression': 4}: expected the path of a file to keep"):
            clatter.run(SWEEP, output={"compression": 4})
        with self.assertRaisesRegex(TypeError, "5: expected the path of a configuration, or a dictionary"):
            clatter.run(5)
        with self.assertRaisesRegex(clatter.ConfigError, r"^'xs' is missing in \[scene\]"):  # and no place of a file
            clatter.run({})
        with self.assertRaisesRegex(ValueError, "put it into the configuration"):
            clatter.run(SWEEP, sweep={"nu": np.linspace(0.9, 1.1, 10_000)})

    def test_points_that_fail_and_warnings_of_the_program_are_warnings(self):
        with self.assertWarnsRegex(clatter.ClatterWarning, "event_budget: 3"):
            data = clatter.run(SWEEP | {"time": {"max_impacts": 1}, "scene": {"h": 0.1, "f": -1.0, "xs": 0.5}})
        self.assertTrue(np.isnan(data.x_max).all())
        with self.assertWarnsRegex(clatter.ClatterWarning, "integrator.step: warning: 'step' has no effect"):
            clatter.run(SWEEP | {"integrator": {"step": 0.01}})
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            clatter.run(SWEEP)

    def test_the_wheel_holds_the_module_in_the_programs_version(self):
        version = re.search(r"clatter VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
        self.assertEqual(clatter.__version__, version)
        with tempfile.TemporaryDirectory() as folder:
            sources = Path(folder) / "scripts"  # pip builds beside the sources
            (sources / "clatter").mkdir(parents=True)
            for path in (SOURCE / "scripts" / "pyproject.toml", *(SOURCE / "scripts" / "clatter").glob("*.py")):
                (sources / path.relative_to(SOURCE / "scripts")).write_bytes(path.read_bytes())
            pip = ["/usr/bin/python3", "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--no-index", "-q"]
            result = subprocess.run([*pip, "-w", folder, sources], capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            (wheel,) = Path(folder).glob("*.whl")
            self.assertEqual(wheel.name, f"clatter-{version}-py3-none-any.whl")
            modules = {name for name in zipfile.ZipFile(wheel).namelist() if name.endswith(".py")}
            self.assertEqual(modules, {f"clatter/{path.name}" for path in (SOURCE / "scripts/clatter").glob("*.py")})


if __name__ == "__main__":
    unittest.main()
