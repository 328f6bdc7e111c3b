"""plot.py draws everything that clatter writes, the same bytes on every run, and refuses the rest in one line."""

import os
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

import h5py
from matplotlib import image
from command_line import LONGEST
from script_runs import run_script, start_script

CLATTER = os.environ["CLATTER"]
SOURCE = Path(os.environ["CLATTER_SOURCE"])
WARNINGS = ("-W", "default::UserWarning", "-W", "default::RuntimeWarning")  # else plot.py is silent about them

# name: (configuration, --set ..., exit code of the run): one of each kind of picture, with few points
KINDS = {
    "ratio": ("fig02", ["sweep.start_period=linspace(1, 6.2, 30)"], 0),
    "free": ("fig05", ["observe.trajectory=201"], 0),
    "period": ("fig07", ["sweep.v0=linspace(-2, -0.1, 30)"], 0),
    "surface": ("fig10", ["sweep.xs=linspace(-1.5, -0.1, 30)"], 0),
    "harmonics": ("fig13", ["sweep.v0=linspace(-2, -0.1, 30)", "observe.harmonics_samples=64"], 0),
    "forced": ("fig16", ["observe.trajectory=201"], 0),
    "extrema": ("fig22", ["sweep.nu=linspace(0.9, 1.1, 21)", "time.max_periods=400"], 0),
    "failed": ("fig22", ["sweep.nu=linspace(0.9, 1.1, 11)", "time.max_impacts=5"], 1),
    "transient": ("transient", ["observe.trajectory=401", "observe.harmonics=3"], 0),
    "followed": ("follow_down", ["sweep.nu=linspace(1.1, 1.0, 6)", "observe.impacts=false"], 0),
    "several": ("fig16", ["sweep.load=logspace(0.01, 1, 7)", "observe.trajectory=101"], 0),
    "numbers": ("fig16", ["observe.trajectory=0", "observe.impact_log=false", "observe.impacts=true"], 0),
    "map": (
        "map_nu_xs",
        [
            "sweep.nu=linspace(0.9, 1.1, 5)",
            "sweep.xs=linspace(3, 5, 4)",
            "time.max_periods=100",
            "observe.extrema=false",
        ],
        0,
    ),
    "cube": (
        "map_nu_xs",
        ["sweep.nu=[0.9, 1]", "sweep.xs=[3, 4]", "sweep.phase=[0, 1]", "time.max_impacts=200", "observe.impacts=false"],
        1,
    ),
    "equal": ("asymmetric", ["sweep.nu=[1, 1]"], 0),
    "equals": ("map_nu_xs", ["sweep.nu=[1, 1]", "sweep.xs=[3, 3]", "time.max_periods=100"], 0),
    "lost": ("map_nu_xs", ["sweep.nu=[0.9, 1, 1.1]", "sweep.xs=[0.1, 0.2]", "time.max_impacts=1"], 1),
    "lost_point": ("fig18", ["time.max_impacts=1"], 1),
    "lost_motion": ("fig18", ["time.max_impacts=1", "observe.trajectory=0"], 1),
    "aperiodic": ("asymmetric", ["sweep.nu=[0.9, 1, 1.1]", "time.max_periods=3"], 0),
    "bare": (
        "asymmetric",
        ["sweep.nu=[0.5, 1, 2]", "observe.extrema=false", "observe.impacts=false", "observe.period=false"],
        0,
    ),
}


def plot(*arguments):
    return run_script("plot.py", *arguments)


def start_plot(*arguments, warnings=()):
    return start_script("plot.py", *arguments, options=warnings)


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.kept.name)
        for name, (config, settings, code) in KINDS.items():
            sets = [part for setting in settings for part in ("--set", setting)]
            command = [CLATTER, "run", SOURCE / "configs" / f"{config}.toml", "-o", cls.folder / f"{name}.h5", *sets]
            result = subprocess.run([*command, "--progress", "never"], capture_output=True, text=True)
            assert result.returncode == code, (name, result.returncode, result.stderr)
        cls.files = [cls.folder / f"{name}.h5" for name in KINDS]
        cls.result = start_plot(*cls.files, warnings=WARNINGS)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def test_every_kind_is_drawn_beside_its_file(self):
        self.assertEqual(self.result.returncode, 0, self.result.stderr)
        self.assertEqual(self.result.stderr, "")
        pictures = [str(self.folder / f"{name}.{kind}") for name in KINDS for kind in ("svg", "png")]
        self.assertEqual(self.result.stdout.split(), pictures)

    def test_pictures_show_something(self):
        for name in KINDS:
            with self.subTest(name):
                pixels = image.imread(self.folder / f"{name}.png")[..., :3]
                self.assertGreater(pixels.size, 3 * 500 * 500)
                self.assertGreater((pixels[::2, ::2, 0] < 0.9).mean(), 0.005)
                drawing = xml.etree.ElementTree.parse(self.folder / f"{name}.svg")
                self.assertGreater(sum(1 for element in drawing.iter() if element.tag.endswith("}path")), 20)

    def test_warnings_of_libraries_are_not_the_users(self):
        command = [CLATTER, "run", SOURCE / "configs" / "fig18.toml", "-o", self.folder / "unseen.h5"]
        command += ["--set", "title=\N{SNOWMAN}\u632f"]
        subprocess.run(command, check=True, capture_output=True)
        self.assertIn("missing from current font", start_plot(self.folder / "unseen.h5", warnings=WARNINGS).stderr)
        self.assertEqual(start_plot(self.folder / "unseen.h5").stderr, "")

    def test_a_second_run_gives_the_same_bytes(self):
        names = ("free", "extrema", "followed")
        again = self.folder / "new" / "folder"
        result = plot(*(self.folder / f"{name}.h5" for name in names), "-o", again)
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in names:
            for kind in ("svg", "png"):
                with self.subTest(f"{name}.{kind}"):
                    self.assertEqual(
                        (again / f"{name}.{kind}").read_bytes(), (self.folder / f"{name}.{kind}").read_bytes()
                    )

    def test_copies_by_other_programs_give_the_same_bytes(self):
        for command in (["nccopy", "-k", "nc4"], ["h5repack", "-m", "1", "-f", "GZIP=6"]):
            folder = self.folder / command[0]
            folder.mkdir()
            copies = [folder / f"{name}.h5" for name in ("free", "map")]
            for copy in copies:
                subprocess.run([*command, self.folder / copy.name, copy], check=True, timeout=LONGEST)
            result = plot(*copies, "--format", "svg")
            self.assertEqual(result.returncode, 0, result.stderr)
            for copy in copies:
                self.assertEqual(
                    copy.with_suffix(".svg").read_bytes(), (self.folder / f"{copy.stem}.svg").read_bytes(), command
                )

    def test_pdf_only(self):
        for turn, run in (("one", plot), ("two", start_plot)):
            result = run(self.folder / "ratio.h5", "-o", self.folder / turn, "--format", "pdf")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual([file.name for file in (self.folder / turn).iterdir()], ["ratio.pdf"])
        self.assertEqual(*((self.folder / turn / "ratio.pdf").read_bytes() for turn in ("one", "two")))

    def test_files_may_follow_the_formats(self):
        ratio, free = self.folder / "ratio.h5", self.folder / "free.h5"
        for words, names in (
            (["--format", "pdf", ratio], ["ratio.pdf"]),
            (["--format", "svg", "pdf", ratio], ["ratio.svg", "ratio.pdf"]),
            ([ratio, "--format", "pdf", "svg"], ["ratio.pdf", "ratio.svg"]),
            ([ratio, "--format", "pdf", free], ["ratio.pdf", "free.pdf"]),
        ):
            with self.subTest(words):
                folder = self.folder / "formats"
                result = plot("-o", folder, *words)
                self.assertEqual(result.stdout.split(), [str(folder / name) for name in names], result.stderr)

    def test_files_that_are_not_clatters_are_refused_in_one_line(self):
        (self.folder / "text.h5").write_text("no HDF5\n")
        with h5py.File(self.folder / "foreign.h5", "w") as file:
            file["nu"] = [1.0, 2.0]
        with h5py.File(self.folder / "later.h5", "w") as file:
            file.attrs["clatter_schema"] = "clatter/2"
        (self.folder / "folder.h5").mkdir()
        os.mkfifo(self.folder / "pipe.h5")
        with h5py.File(self.folder / "damaged.h5", "w") as file:
            file.attrs.update({"clatter_schema": "clatter/1", "config": "no = configuration ="})
            file["status"] = [0]
        for name, reason in (
            ("pipe.h5", "not a regular file"),
            ("damaged.h5", "damaged ("),
            ("missing.h5", "no such file"),
            ("text.h5", "is not an HDF5 file; "),
            ("folder.h5", "a folder"),
            ("foreign.h5", "not one of clatter's"),
            ("later.h5", "not one of clatter's"),
        ):
            with self.subTest(name):
                result = plot(self.folder / name)
                self.assertEqual(result.returncode, 74)
                self.assertEqual(result.stderr.count("\n"), 1)
                self.assertIn(f"{self.folder / name}: ", result.stderr)
                self.assertIn(reason, result.stderr)

    def test_an_empty_name_is_refused_in_one_line(self):
        result = plot("")
        self.assertEqual(result.returncode, 74)
        self.assertRegex(result.stderr, r"^plot.py: '': an empty name; .*\n$")

    def test_a_folder_that_cannot_be_made_is_an_error(self):
        result = plot(self.folder / "ratio.h5", "-o", self.folder / "ratio.h5" / "inside")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (74, 1))

    def test_wrong_command_lines(self):
        for arguments in (
            [],
            ["--nonsense", "a.h5"],
            ["a.h5", "--format", "gif"],
            ["a.h5", "--form", "svg"],
            ["--format", "a.h5"],
            ["a.h5", "--format", "svg", "gif"],
            ["--format", "svg"],
        ):
            with self.subTest(arguments):
                result = plot(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertRegex(result.stderr, "^plot.py: [^\n]+; see --help\n$")

    def test_help(self):
        result = plot("--help")
        self.assertEqual(result.returncode, 0)
        for option in ("--output", "--format", "FILE.h5", "74"):
            self.assertIn(option, result.stdout)


if __name__ == "__main__":
    unittest.main()
