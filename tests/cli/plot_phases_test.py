"""plot.py draws impacts over their forcing phases if it is asked to.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import subprocess
import unittest

import numpy as np
from matplotlib.colors import to_hex

from command_line import CLATTER
from plot_checks import crowded_texts
from plot_pictures import PlotFolder, choice
from script_runs import run_script

from clatter.plots import pictures, style
from clatter.plots.data import Output
from clatter.plots.empty import EMPTY

LOG = "[time]\nmax_periods = 300\n[observe]\nimpact_log = true\n"
BALL = "[scene]\nstiffness = 0\nload = -1\nstop_lower = 0\nR = 0.8\nv0 = 2.8\n"
TWO_STOPS = "[scene]\nf = -1.0\nh = 0.1\nR = 0.7\n"
CONFIGURATIONS = {
    "ball": BALL + "[sweep]\nf = 'linspace(1.1, 1.5, 9)'\n" + LOG,
    "table": BALL + "base_amplitude = 0.8\n" + LOG,
    "two_stops": TWO_STOPS + "xs = -3\nnu = 0.9\n" + LOG,
    "map": TWO_STOPS + "[sweep]\nnu = 'linspace(0.5, 1, 8)'\nxs = 'linspace(0.5, 3, 7)'\n" + LOG,
    "free": "[scene]\nxs = 1\nv0 = 2\n" + LOG,
    "far": TWO_STOPS + "xs = 20\nnu = 0.9\n" + LOG,
}


class Phases(PlotFolder):
    configurations = CONFIGURATIONS

    def output(self, name):
        return Output(self.folder / f"{name}.h5")

    def figure(self, name, **options):
        figure = pictures.single_figure(self.output(name), choice(only=("impact_phase",), **options))
        self.assertEqual(crowded_texts(figure), ([], []))
        return figure

    def assert_quarters(self, axes):
        self.assertEqual(axes.get_xlim(), (0.0, 2 * np.pi))
        self.assertEqual([text.get_text() for text in axes.get_xticklabels()], ["0", "π/2", "π", "3π/2", "2π"])
        np.testing.assert_allclose(axes.get_xticks(), np.arange(5) * np.pi / 2)
        self.assertEqual(axes.get_xlabel(), r"forcing phase of the impact $\theta$ (rad)")

    def test_impacts_of_a_sweep_have_the_colour_of_their_parameter(self):
        output, figure = self.output("ball"), self.figure("ball")
        axes, bar = figure.axes
        (points,) = axes.collections
        expected = np.column_stack([output.values("impact_phase"), output.values("impact_v_before")])
        self.assertGreater(len(expected), 9)
        np.testing.assert_array_equal(points.get_offsets(), expected)
        along = np.repeat(output.values("f"), output.values("impact_count"))
        np.testing.assert_array_equal(points.get_array(), along)
        self.assertEqual(bar.get_ylabel(), "force amplitude $f$")
        self.assertEqual(axes.get_ylabel(), "velocity before impact $x$′$^{{-}}$")
        self.assert_quarters(axes)

    def test_impacts_of_a_point_have_the_colour_of_their_stop(self):
        output, figure = self.output("two_stops"), self.figure("two_stops")
        (axes,) = figure.axes
        sides = output.values("impact_stop")
        for side, colour in ((-1, style.BLUE), (1, style.VERMILION)):
            (line,) = (
                line for line in axes.lines if to_hex(line.get_color()) == to_hex(colour) and len(line.get_xdata()) > 1
            )
            np.testing.assert_array_equal(line.get_xdata(), output.values("impact_phase")[sides == side])
            np.testing.assert_array_equal(line.get_ydata(), output.values("impact_v_before")[sides == side])
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()], ["lower stop", "upper stop"])
        self.assert_quarters(axes)

    def test_impacts_of_a_map_and_of_one_of_its_lines(self):
        output = self.output("map")
        (axes,) = self.figure("map").axes
        drawn = sum(len(line.get_xdata()) for line in axes.lines)
        self.assertEqual(drawn, len(output.values("impact_phase")))
        part = output.at("xs", 2)
        points = self.figure("map", at=[("xs", output.values("xs")[2])]).axes[0].collections[0]
        np.testing.assert_array_equal(points.get_offsets()[:, 0], part.values("impact_phase"))
        counts, kept = output.values("impact_count"), output.values("impact_phase")
        begin = counts.ravel()[: 3 * 7 + 2].sum()  # nu[3], xs[2]
        own = part.values("impact_phase")[part.values("impact_count")[:3].sum() :][: counts[3, 2]]
        np.testing.assert_array_equal(own, kept[begin : begin + counts[3, 2]])

    def test_velocities_over_a_shaken_table_are_those_that_the_ground_sees(self):
        output, figure = self.output("table"), self.figure("table")
        (axes,) = figure.axes
        (line,) = (line for line in axes.lines if len(line.get_xdata()))
        np.testing.assert_array_equal(line.get_ydata(), output.values("impact_v_before_absolute"))
        self.assertEqual(axes.get_ylabel(), "velocity before impact $x$′$^{{-}}$, absolute")

    def test_several_files_have_a_colour_each(self):
        names = [self.folder / f"{name}.h5" for name in ("ball", "again")]
        text = CONFIGURATIONS["ball"].replace("R = 0.8", "R = 0.7")
        (self.folder / "again.toml").write_text(text)
        subprocess.run([CLATTER, "run", self.folder / "again.toml", "-o", names[1], "-q"], check=True, timeout=300)
        figure = pictures.shared_figure(choice(files=names, only=("impact_phase",)))
        (axes,) = figure.axes
        self.assertEqual(len({line.get_color() for line in axes.lines}), 2)
        texts = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertEqual(texts, ["$R$ = 0.8", "$R$ = 0.7"])

    def test_a_panel_without_impacts_or_phases_says_so(self):
        for name, words in (("free", "no force"), ("far", "no impacts")):
            with self.subTest(name):
                found = self.figure(name).findobj(lambda artist: artist.get_gid() == EMPTY)
                self.assertEqual([text.get_text() for text in found], [words])

    def test_nothing_else_is_drawn_differently(self):
        figure = pictures.single_figure(self.output("ball"), choice())
        self.assertNotIn("phase", " ".join(axes.get_xlabel() for axes in figure.axes))

    def test_a_file_without_a_log_says_what_there_is(self):
        (self.folder / "plain.toml").write_text(BALL + "f = 1\n[observe]\nextrema = true\n")
        words = [CLATTER, "run", self.folder / "plain.toml", "-o", self.folder / "plain.h5", "-q"]
        subprocess.run(words, check=True, timeout=300)
        result = run_script("plot.py", self.folder / "plain.h5", "--only", "impact_phase")
        self.assertEqual(result.returncode, 2)
        self.assertIn("'impact_phase' is no result", result.stderr)


if __name__ == "__main__":
    unittest.main()
