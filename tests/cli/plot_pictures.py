"""Files of every kind, for the tests of their pictures.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import subprocess
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

from command_line import CLATTER
from plot_checks import Svg
from script_runs import run_script

from clatter.plots import pictures, style
from clatter.plots.data import Output

FORCED = "[scene]\nf = -1.0\nh = 0.1\n"
ALONG_NU = '[sweep]\nnu = "linspace(0.84, 1.0, 81)"\n'
CONFIGURATIONS = {
    "section": FORCED + "R = 0.7\nxs = -3\n" + ALONG_NU + "[time]\nmax_periods = 300\n"
    "[observe]\nsection = 40\nword = true\nstability = true\n",
    "impacts": FORCED + "R = 0.7\nxs = -3\n" + ALONG_NU + "[time]\nmax_periods = 300\n[observe]\nimpact_log = true\n",
    "chaos": FORCED + "R = 0.7\nxs = -3\nnu = 0.9\n[time]\nmax_periods = 200\n"
    "[observe]\nsection = 500\ntrajectory = 1601\nimpact_log = true\n",
    "family": FORCED + "xs = -3\n" + '[sweep]\nR = [0.3, 0.6, 0.9]\nnu = "linspace(1, 1.2, 21)"\n'
    "[observe]\nextrema = true\nimpacts = true\n",
    "hysteresis": FORCED + 'R = 0.7\nxs = -4\n[sweep]\nnu = "linspace(0.8, 1.3, 101)"\nfollow = "nu"\n'
    'direction = "both"\n[observe]\nextrema = true\n',
    "map": FORCED + 'R = 0.7\n[sweep]\nnu = "linspace(0.3, 1.3, 21)"\nxs = "linspace(0.1, 2, 17)"\n'
    "[time]\nmax_periods = 200\n"
    "[observe]\nextrema = true\nimpacts = true\nperiod = true\nword = true\nstability = true\n",
    "uneven": FORCED + 'R = 0.7\n[sweep]\nnu = [0.3, 0.5, 0.6, 0.65, 0.8, 1.0, 1.4]\nxs = "logspace(0.1, 10, 9)"\n'
    "[observe]\nextrema = true\n",
    "cube": FORCED + '[sweep]\nR = [0.3, 0.8]\nnu = "linspace(0.8, 1.2, 9)"\nxs = "linspace(2, 4, 8)"\n'
    "[observe]\nextrema = true\n",
    "one_stop": FORCED + 'R = 0.6\n[sweep]\nstop_upper = [0.0, inf]\nnu = "linspace(0.5, 1.5, 21)"\n'
    "[observe]\nextrema = true\n",
    "soft": FORCED + 'xs = 1\nstop_stiffness = 20\n[sweep]\nnu = "linspace(0.5, 1.5, 21)"\n[observe]\nextrema = true\n',
    "linear": FORCED + 'xs = 20\n[sweep]\nnu = "linspace(0.5, 1.5, 21)"\n[observe]\nextrema = true\nharmonics = 2\n'
    "impacts = true\n",
}
OBSERVED = "[observe]\nextrema = true\nimpacts = true\nharmonics = 4\nharmonics_method = 'exact'\nstability = true\n"
CONFIGURATIONS |= {
    "point": FORCED + "nu = 0.8\nstop_lower = -0.5\nR_lower = 0.6\nR_upper = 0.9\n" + OBSERVED + "word = true\n",
    "linear_point": FORCED + "nu = 0.8\nxs = 20\n" + OBSERVED,
    "numbers": FORCED + "nu = 0.8\nxs = 0.5\n[observe]\nword = true\n",
    "chatter": FORCED + "nu = 0.05\nxs = 0.2\nR = 0.7\n[observe]\nword = true\nstability = true\n",
}
CONFIGURATIONS["machine"] = (
    "[machine]\nmass = '500 g'\nstiffness = '12.8 kN/m'\ndamping = '16 N s/m'\nforce = '-12.8 N'\nR = 0.7\n"
    "gap = '4 mm'\n[sweep]\nfrequency = 'linspace(20 Hz, 30 Hz, 21)'\nload = ['0 N', '3 N']\n"
    "[observe]\nextrema = true\nenergy = true\n"
)
STARTS = '[sweep]\n{}x0 = "{}(-3, 3, {})"\nv0 = "{}(-6, 6, {})"\n'
STEADY = FORCED + "R = 0.7\nxs = -3\n"
CONFIGURATIONS |= {
    "basins": STEADY
    + "nu = 1.2\n"
    + STARTS.format("", "linspace", 24, "linspace", 20)
    + "[observe]\nattractor = true\nsettling = true\n",
    "starts": STEADY
    + "nu = 1.2\n"
    + STARTS.format('linked = "x0, v0"\n', "sobol", 64, "sobol", 64)
    + "[observe]\nattractor = true\nsettling = true\n",
    "zones": STEADY
    + STARTS.format('nu = "linspace(0.9, 1.5, 25)"\nlinked = "x0, v0"\n', "sobol", 32, "sobol", 32)
    + "[time]\nmax_periods = 300\n[observe]\nattractor = true\n",
}
CONFIGURATIONS |= {
    "housing": "[scene]\nh = 0.02\nf = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_R = 0.6\nloose_v0 = 0.6\n"
    "loose_lower = -1.5\nloose_upper = 2.1\n[time]\nmode = 'transient'\nduration = 30\n"
    "[observe]\ntrajectory = 601\nimpact_log = true\n",
    "housings": "[scene]\nh = 0.005\nnu = 1.0\nloose_mass = 0.02\nloose_R = 0.8\nloose_gap = 0.4\nloose_v0 = 1e-3\n"
    "[sweep]\nf = 'linspace(0.008, 0.011, 7)'\n[time]\nmax_periods = 2000\n"
    "[observe]\nextrema = true\nimpacts = true\nstability = true\n",
}
NO_CHOICE = SimpleNamespace(
    only=(), along="", over="", at=(), scatter="", size=None, xlim=None, ylim=None, log="", title=None
)


def choice(**options):
    return SimpleNamespace(**{**vars(NO_CHOICE), **options})


class PlotFolder(unittest.TestCase):
    """A folder for tests, in which the program has made files."""

    configurations = {}  # name: text, each run once for all tests

    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = Path(kept.name)
        for name, text in cls.configurations.items():
            cls.make("run", name, text)
        style.use_style()

    @classmethod
    def make(cls, command, name, text, codes=(0,)):
        """NAME.toml and what a command of the program makes of it, NAME.h5."""
        (cls.folder / f"{name}.toml").write_text(text)
        words = [CLATTER, command, cls.folder / f"{name}.toml", "-o", cls.folder / f"{name}.h5", "-q", "--force"]
        done = subprocess.run(words, capture_output=True, text=True, timeout=300)
        if done.returncode not in codes:
            raise AssertionError(f"{name}: {done.returncode}, {done.stderr}")


class Pictures(PlotFolder):
    """Tests of pictures of these files."""

    configurations = CONFIGURATIONS

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.drawn, cls.figures = {}, {}

    def draw(self, *names, arguments=()):
        """The picture of these files, by the program; the same picture is drawn once for all tests."""
        key = (names, tuple(arguments))
        if key not in self.drawn:
            files = (self.folder / f"{name}.h5" for name in names)
            result = run_script("plot.py", *files, *arguments, "--format", "svg")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            (path,) = result.stdout.split()
            self.drawn[key] = Svg(path)
        return self.drawn[key]

    def figure(self, name):
        """The picture of a file without any choice, drawn once for all tests, which leave it as it is."""
        if name not in self.figures:
            self.figures[name] = pictures.single_figure(self.output(name), NO_CHOICE)
        return self.figures[name]

    def output(self, name):
        return Output(self.folder / f"{name}.h5")

    def refuse(self, name, *arguments):
        result = run_script("plot.py", self.folder / f"{name}.h5", *arguments, "-o", self.folder / "refused")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertFalse((self.folder / "refused").exists())
        return result.stderr.splitlines()[-1]
