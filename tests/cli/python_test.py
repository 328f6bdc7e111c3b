"""The Python package: the same values as the program's files, the pictures and pages of the commands, and errors as
exceptions with their place.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import contextlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
import zipfile
from pathlib import Path

import matplotlib
import numpy as np
import xarray
from command_line import CLATTER, SOURCE, CommandLine
from matplotlib import image, pyplot
from script_runs import run_script

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
            shutil.copytree(
                SOURCE / "scripts/clatter", sources / "clatter", ignore=shutil.ignore_patterns("__pycache__")
            )
            shutil.copy(SOURCE / "scripts/pyproject.toml", sources)
            package = {str(path.relative_to(sources)) for path in sources.rglob("clatter/**/*.*")}
            pip = ["/usr/bin/python3", "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--no-index", "-q"]
            result = subprocess.run([*pip, "-w", folder, sources], capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            (wheel,) = Path(folder).glob("*.whl")
            self.assertEqual(wheel.name, f"clatter-{version}-py3-none-any.whl")
            with zipfile.ZipFile(wheel) as content:
                names = set(content.namelist())
                (entries,) = (name for name in names if name.endswith("/entry_points.txt"))
                commands = content.read(entries).decode().split()
            self.assertEqual({name for name in names if not name.startswith("clatter-")}, package)
            self.assertIn("clatter/reports/page.css", package)
            self.assertEqual(commands[1::3], ["clatter-plot", "clatter-report"])

    def test_the_package_installs_in_an_environment_beside_the_libraries_of_the_system(self):
        """As scripts/README.md says for Debian, whose h5py pip doesn't see; nothing is downloaded."""
        with tempfile.TemporaryDirectory() as folder:
            sources, environment = Path(folder) / "scripts", Path(folder) / "venv"
            shutil.copytree(SOURCE / "scripts", sources, ignore=shutil.ignore_patterns("__pycache__"))
            made = subprocess.run(["/usr/bin/python3", "-m", "venv", "--system-site-packages", environment])
            self.assertEqual(made.returncode, 0)
            pip = [environment / "bin/pip", "install", "-q", "--no-deps", "--no-build-isolation", "--no-index", sources]
            installed = subprocess.run(pip, capture_output=True, text=True)
            self.assertEqual(installed.returncode, 0, installed.stderr)
            code = "import clatter; print(clatter.run({'scene': {'xs': 1}, 'observe': {'extrema': True}}).x_max.item())"
            python = {"PATH": "/usr/bin:/bin", "CLATTER": CLATTER, "HOME": folder}
            ran = subprocess.run([environment / "bin/python", "-c", code], env=python, capture_output=True, text=True)
            self.assertEqual((ran.returncode, float(ran.stdout)), (0, 0.0), ran.stderr)
            for command in ("clatter-plot", "clatter-report"):
                helped = subprocess.run([environment / "bin" / command, "--help"], capture_output=True, text=True)
                self.assertEqual(helped.returncode, 0, helped.stderr)


class Pictures(CommandLine):
    """clatter.plot and clatter.report, of an output of three points."""

    def setUp(self):
        super().setUp()
        self.file = self.directory / "a.h5"
        self.data = clatter.run(SWEEP, output=self.file)

    def python(self, code, **environment):
        """A new interpreter that sees the package, runs the code here, and says nothing."""
        done = subprocess.run(
            ["/usr/bin/python3", "-c", code],
            cwd=self.directory,
            env={"PATH": "/usr/bin:/bin", "PYTHONPATH": SOURCE / "scripts", **environment},
            capture_output=True,
            text=True,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def curves(self, figure):
        """The points of each curve by its name in the legend, of all panels."""
        lines = [line for axes in figure.axes for line in axes.lines if len(line.get_xdata()) == len(self.data.nu)]
        return {line.get_label(): np.array(line.get_data()) for line in lines}

    def test_a_figure_holds_the_values_of_the_file(self):
        figure = clatter.plot(self.file, only="extrema")
        curves = self.curves(figure)
        for name, label in (("x_min", r"$x_{\min}$"), ("x_max", r"$x_{\max}$")):
            np.testing.assert_array_equal(curves[label], [self.data.nu, self.data[name]])
        self.assertEqual(len(figure.axes), 2)
        self.assertEqual(self.files(), ["a.h5"])

    def test_choices_are_those_of_the_command(self):
        figure = clatter.plot(
            str(self.file), only=["v_max"], xlim=(0.8, 1.2), ylim=(-1, 9.5), size=(4, 3), title="$ own", log="x"
        )
        (axes,) = figure.axes
        self.assertEqual((axes.get_xlim(), axes.get_ylim(), axes.get_xscale()), ((0.8, 1.2), (-1.0, 9.5), "log"))
        self.assertEqual(figure.get_size_inches().tolist(), [4.0, 3.0])
        self.assertIn("own", figure._suptitle.get_text())
        clatter.run(SWEEP, sweep={"xs": [3, 4, 5], "nu": [0.9, 1.0, 1.1]}, output=self.directory / "map.h5")
        part = self.curves(
            clatter.plot(self.directory / "map.h5", only="x_max", along="nu", at={"xs": np.float64(4.1)})
        )
        (points,) = part.values()
        np.testing.assert_array_equal(points, [self.data.nu, self.data.x_max])
        family = self.curves(clatter.plot(self.directory / "map.h5", only="x_max", over="xs"))
        self.assertEqual(len(family), 3)

    def test_files_over_one_axis_share_a_figure(self):
        other = self.directory / "b.h5"
        data = clatter.run(SWEEP, scene={"xs": 5}, output=other)
        curves = self.curves(clatter.plot([self.file, other], only="x_max"))
        np.testing.assert_array_equal([points[1] for points in curves.values()], [self.data.x_max, data.x_max])
        clatter.run(SWEEP, sweep={"nu": 1, "xs": [4, 5]}, output=other)
        with self.assertRaisesRegex(clatter.ClatterError, "^these files share no picture: .*; plot one by one$"):
            clatter.plot([self.file, other])

    def test_a_figure_is_the_commands_in_a_program_of_any_style_which_stays_as_it_is(self):
        done = run_script("plot.py", self.file, "--format", "png", cwd=self.directory)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        style = {
            "font.size": 30,
            "axes.grid": True,
            "xtick.labelsize": "medium",
            "figure.dpi": 50,
            "lines.linewidth": 9,
        }
        with matplotlib.rc_context(style):
            before = dict(matplotlib.rcParams)
            figure, drawn = clatter.plot(self.file), io.BytesIO()
            figure.savefig(drawn)
            self.assertEqual(dict(matplotlib.rcParams), before)
        self.assertEqual(pyplot.get_fignums(), [])
        drawn.seek(0)
        np.testing.assert_array_equal(image.imread(drawn), image.imread(self.directory / "a.png"))

    def test_to_import_loads_no_library_and_to_plot_needs_no_display(self):
        libraries = "print({'numpy', 'xarray', 'h5py', 'matplotlib'} & set(sys.modules))"
        self.assertEqual(self.python(f"import clatter, sys; {libraries}"), "set()\n")
        code = "import clatter; print(len(clatter.plot('a.h5', only='x_max').axes))"
        self.assertEqual(self.python(code, MPLBACKEND="tkagg"), "1\n")

    def test_a_library_that_is_missing_is_told_with_the_extra_that_brings_it(self):
        for call, library, extra in (("plot", "matplotlib", "plot"), ("report", "h5py", "report")):
            code = f"""import sys; sys.modules[{library!r}] = None
import clatter
try: clatter.{call}('a.h5')
except ImportError as error: print(error)"""
            self.assertRegex(self.python(code), rf"^import of {library} .*; pip install 'clatter\[{extra}\]', or .*\n$")
            (self.directory / f"{library}.py").write_text("raise ImportError('nothing')")
            environment = {**os.environ, "PYTHONPATH": str(self.directory)}
            command = [SOURCE / "scripts" / f"{call}.py", self.file]
            done = subprocess.run(command, env=environment, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, rf"^\S+: nothing; pip install 'clatter\[{extra}\]', or .*\n$")

    def test_mistakes_are_errors_in_one_line_by_the_names_of_arguments(self):
        for choice, words in (
            ({"only": "x_maxx"}, "only: 'x_maxx' is no result in .*; did you mean 'x_max'[?]"),
            ({"along": "xs"}, "along: 'xs' is no axis of this file, which has nu"),
            ({"at": {"nu": 2}}, "at nu=2: beyond the axis, which goes from 0.9 to 1.1"),
            ({"size": (700, 1)}, "argument size: '700.0x1.0' is no size; .*"),
            ({"xlim": (1, 1)}, "argument xlim: '1.0,1.0' is no pair of limits; .*"),
            ({"log": "z"}, "argument log: .*'z'.*"),
        ):
            with self.subTest(choice):
                with self.assertRaisesRegex(clatter.ClatterError, rf"^{words}$") as caught:
                    clatter.plot(self.file, **choice)
                self.assertEqual(caught.exception.exit_code, 2)
        for draw in (clatter.plot, lambda file: clatter.report(file, self.directory / "a.html")):
            with self.assertRaisesRegex(clatter.ClatterError, "^none.h5: no such file; .*$") as caught:
                draw("none.h5")
            self.assertEqual(caught.exception.exit_code, 74)
            for wrong in (5, [], [None]):
                with self.assertRaisesRegex(TypeError, "expected the path of an output, or a list of them$"):
                    draw(wrong)
        for wrong in ({"only": 5}, {"at": 1}, {"at": {"nu": "x"}}, {"xlim": 1}, {"size": ("a", "b")}):
            with self.assertRaisesRegex(TypeError, "^(only|at|xlim|size) = .*: expected .*$"):
                clatter.plot(self.file, **wrong)

    def test_a_report_is_the_commands_page_and_replaces_no_other_file(self):
        environment = {"PATH": "/usr/bin:/bin", "CLATTER": CLATTER}
        words = ("-o", "command.html", "--title", "Own & only")
        done = run_script("report.py", "a.h5", *words, cwd=self.directory, environment=environment)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with contextlib.chdir(self.directory):
            page = clatter.report("a.h5", "page.html", title="Own & only")
        self.assertEqual(page, Path("page.html"))
        page = self.directory / page
        self.assertEqual(page.read_bytes(), (self.directory / "command.html").read_bytes())
        self.assertIn("<h1>Own &amp; only</h1>", page.read_text(encoding="utf-8"))
        clatter.report([self.file, self.file], page, histories=False)
        self.assertEqual(page.read_text(encoding="utf-8").count("<section class=file"), 2)
        own = self.directory / "own.html"
        own.write_text("<p>mine</p>", encoding="utf-8")
        for file, says in (
            (own, "own.html: is no report, so it is kept; name another"),
            (self.file, "a.h5: .*in HTML"),
        ):
            kept = file.read_bytes()
            with self.assertRaisesRegex(clatter.ClatterError, says):
                clatter.report(self.file, file)
            self.assertEqual(file.read_bytes(), kept)


if __name__ == "__main__":
    unittest.main()
