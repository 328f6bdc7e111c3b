"""Files of scenes that pictures once drew wrongly, and the base of the tests of these pictures.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""


from plot_checks import Svg, crowded_texts
from plot_pictures import PlotFolder, choice
from script_runs import run_script

from clatter.plots import pictures
from clatter.plots.data import Output

SOFT = "[scene]\nf = -1.0\nh = 0.1\n{}[observe]\ntrajectory = 801\nimpact_log = true\n"
STEADY = "[scene]\nf = -1.0\nh = 0.1\nR = 0.7\n"
RUNAWAY = "[scene]\nf = 0.5\nh = 0.1\nload = 0.3\nstiffness = -1\nstop_upper = 0.5\nR = 0.7\n"
CONFIGURATIONS = {
    "soft": SOFT.format("xs = 0.5\nstop_stiffness = 20\nstop_damping = 0.1\n"),
    "rigid": SOFT.format("xs = 0.5\nR = 0.7\n"),
    "mixed": SOFT.format("xs = 0.5\nstop_stiffness_lower = 20\nR_upper = 0.7\n"),
    "stiffer": SOFT.format("xs = 0.5\n[sweep]\nstop_stiffness = [20, inf]\n"),
    "base": "[scene]\nh = 0.1\nxs = 0.5\nR = 0.7\nbase_amplitude = 1\n[sweep]\nnu = 'linspace(0.8, 1.2, 9)'\n"
    "[observe]\nsection = 8\n",
    "stops": "[scene]\nh = 0.1\nxs = 0.5\nR = 0.7\nstop_amplitude = 1\nnu = 0.9\n[observe]\nsection = 8\n",
    "free": "[scene]\nxs = 1\nv0 = 2\n[sweep]\nR = [0.7, 0.8, 0.9]\n[time]\nmode = 'transient'\nduration = 20\n"
    "[observe]\nimpacts = true\nsection = 5\n",
    "runaway": RUNAWAY + "[sweep]\nx0 = 'linspace(-1, 0.4, 29)'\n[observe]\nextrema = true\n",
    "runaways": RUNAWAY + "[sweep]\nx0 = 'linspace(-1, 0.4, 9)'\nv0 = 'linspace(-1, 1, 7)'\n"
    "[observe]\nextrema = true\nattractor = true\n",
    "escapes": RUNAWAY + "[sweep]\nx0 = 'linspace(-3, 0.4, 29)'\nnu = 'linspace(0.5, 2, 7)'\n"
    "[observe]\nextrema = true\nword = true\nperiod = true\n",
    "gaps": STEADY + "xs = -3\n[sweep]\nnu = 'linspace(0.84, 1.1, 53)'\n[time]\nmax_periods = 200\n"
    "[observe]\nperiod = true\nimpacts = true\nword = true\n",
    "bumpers": "[scene]\nf = -1.0\nh = 0.1\nxs = 0.5\nstop_damping = 0.1\n"
    "[sweep]\nstop_stiffness = 'logspace(1, 1e3, 61)'\n[observe]\nextrema = true\nperiod = true\n",
    "unsorted": STEADY + "xs = -1\n[sweep]\nnu = [0.5, 1.5, 0.7, 1.3, 0.6, 1.0]\n"
    "[observe]\nextrema = true\nimpact_log = true\nstability = true\nsection = 2\n",
    "path": STEADY
    + "xs = -4\n[sweep]\nnu = [1.0, 1.1, 1.2, 1.3, 1.15, 1.05]\nfollow = 'nu'\n[observe]\nextrema = true\n",
    "twins": STEADY + "xs = 1.45\nnu = 0.67\n[sweep]\nx0 = 'linspace(-1.4, 1.4, 8)'\nv0 = 'linspace(-2, 2, 7)'\n"
    "[observe]\nattractor = true\nword = true\n",
    "far": STEADY + "xs = 20\n[sweep]\nnu = 'linspace(0.5, 1.5, 5)'\n[observe]\nimpacts = true\nimpact_log = true\n",
    "far_map": STEADY.replace("h = 0.1\n", "")
    + "xs = 20\n[sweep]\nnu = 'linspace(0.5, 1.5, 8)'\nh = 'linspace(0.1, 0.2, 7)'\n"
    "[observe]\nimpacts = true\n",
    "far_point": STEADY + "xs = 20\n[observe]\nimpacts = true\nimpact_log = true\n",
    "speeds": STEADY + "xs = -3\n[sweep]\nnu = 'linspace(0.9, 1.1, 41)'\n[time]\nmax_periods = 200\n"
    "[observe]\nimpacts = true\nextrema = true\n",
}
MACHINE = """[machine]
mass = "500 g"
stiffness = "12.8 kN/m"
damping_ratio = 0.1
force = "-12.8 N"
R = 0.7
"""
EVERYTHING = (
    "[observe]\nextrema = true\nharmonics = 2\nimpacts = true\nimpact_log = true\nperiod = true\nenergy = true\n"
)
CONFIGURATIONS |= {
    "machine": MACHINE + "gap = '2 mm'\n[sweep]\nfrequency = 'linspace(20 Hz, 30 Hz, 9)'\n" + EVERYTHING,
    "machine_point": MACHINE + "gap = '2 mm'\nfrequency = '25 Hz'\n[observe]\ntrajectory = 401\nimpact_log = true\n",
    "machine_log": MACHINE + "gap = '2 mm'\nfrequency = '25 Hz'\n[observe]\nimpact_log = true\nsection = 4\n",
    "machine_map": MACHINE + "[sweep]\nfrequency = 'linspace(20 Hz, 30 Hz, 8)'\ngap = 'linspace(1 mm, 4 mm, 7)'\n"
    "[time]\nmax_periods = 100\n[observe]\nextrema = true\n",
    "large": MACHINE.replace('force = "-12.8 N"\n', "")
    + "gap = '2 m'\n[sweep]\nforce = 'linspace(1 kN, 60 kN, 7)'\nfrequency = [24, 25]\n"
    "[observe]\nextrema = true\n",
    "dampers": MACHINE.replace("damping_ratio = 0.1\n", "") + "gap = '2 mm'\nfrequency = '25 Hz'\n[sweep]\n"
    "damping_ratio = [0.05, 0.1, 0.2]\n[observe]\nextrema = true\n",
    "damped_stops": MACHINE.replace("R = 0.7\n", "stop_stiffness = '1 MN/m'\nstop_damping = '20 N s/m'\n")
    + "gap = '2 mm'\nfrequency = '25 Hz'\n[observe]\nextrema = true\n",
}
FAILS = ("runaway", "runaways", "escapes")  # runs with points that escape


class ScenePictures(PlotFolder):
    """Tests of pictures of these files."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, text in CONFIGURATIONS.items():
            cls.make("run", name, text, codes=(0, 1) if name in FAILS else (0,))
        branch = (
            STEADY + "xs = -3\nnu = 1.05\n[observe]\nstability = true\n[branch]\nalong = 'nu'\nrange = [0.9, 1.1]\n"
        )
        cls.make("branch", "branch", branch, codes=(0, 1))

    def output(self, name):
        return Output(self.folder / f"{name}.h5")

    def figure(self, name, **options):
        """The picture of a file, whose texts lie apart and within it."""
        figure = pictures.single_figure(self.output(name), choice(**options))
        self.assertEqual(crowded_texts(figure), ([], []), name)
        return figure

    def draw(self, *names, arguments=()):
        files = [self.folder / f"{name}.h5" for name in names]
        result = run_script("plot.py", *files, *arguments, "--format", "svg", "-o", self.folder / "drawn")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        (path,) = result.stdout.splitlines()
        return Svg(path)

    def caption(self, figure):
        return figure._supxlabel.get_text().replace("\n", " ")
