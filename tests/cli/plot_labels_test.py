"""A label says whose key, which unit and which extreme it means, a logarithmic scale what it leaves out, and a panel
why it is empty.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import re
import unittest

import numpy as np

from plot_pictures import NO_CHOICE
from scene_pictures import ScenePictures
from script_runs import run_script

from clatter.plots import pictures
from clatter.plots.names import equation, label


class Labels(ScenePictures):
    def test_stops_of_infinite_stiffness_are_rigid(self):
        for name, words in (("stop_stiffness", "rigid stops"), ("stop_stiffness_upper", "rigid upper stop")):
            self.assertEqual(equation(self.output("stiffer"), name, np.inf), words)
        self.assertEqual(equation(self.output("path"), "stop_upper", np.inf), "no upper stop")

    def test_a_followed_axis_is_told_by_any_of_its_keys(self):
        linked = "[scene]\nh = 0.1\nxs = 4\n[sweep]\nnu = [0.9, 1.0]\nf = [1, 2]\nlinked = 'nu, f'\nfollow = 'f'\n"
        self.make("run", "linked", linked + "[observe]\nextrema = true\n")
        self.assertEqual(self.output("linked").follow, "nu")

    def test_one_extreme_is_named_as_such(self):
        for name, words in (("v_max", "maximum"), ("v_min", "minimum"), ("x_max", "maximum"), ("x_min", "minimum")):
            axes = self.figure("path", only=(name,)).axes[0]
            self.assertTrue(axes.get_ylabel().startswith(words), axes.get_ylabel())
        self.assertEqual(self.figure("path", only=("x_min", "x_max")).axes[0].get_ylabel(), "displacement $x$")
        self.assertTrue(
            self.figure("speeds", only=("v_before",)).axes[0].get_ylabel().startswith("velocity before impact")
        )

    def test_a_logarithmic_scale_names_what_it_leaves_out(self):
        figure = self.figure("path", only=("x_min", "x_max", "v_max"), log="y")
        legend = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        self.assertIn(r"$x_{\max}$", legend)
        self.assertNotIn(r"$x_{\min}$", legend)
        self.assertTrue(self.caption(figure).endswith(r"at 0 and below, so not on a logarithmic axis: $x_{\min}$"))
        self.assertGreater(figure.axes[0].get_ylim()[0], 0)
        figure = self.figure("path", only=("x_min",), log="y")
        self.assertEqual(empty_texts(figure), ["nothing above 0"])
        self.assertNotIn("logarithmic", self.caption(self.figure("path", only=("x_max",), log="y")))

    def test_a_map_on_logarithmic_axes_refuses_values_at_0_and_below(self):
        result = run_script("plot.py", self.folder / "twins.h5", "--log", "x", "-o", self.folder / "drawn")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, r"^plot.py: --log x: x0 begins at -1.4, .*; leave 'x' out\n$")

    def test_every_panel_of_a_machine_has_its_unit(self):
        without = ("harmonic", "impacts per", "share of time", "period in forcing")
        for name in ("machine", "machine_point", "machine_log", "large"):
            for axes in self.figure(name).axes:
                for words in (axes.get_xlabel(), axes.get_ylabel()):
                    if axes.axison and words and not words.startswith(without):
                        self.assertRegex(words, r"\((mm|m|s|Hz|J|W|N|N\Ws|m\Ws\$\^{-1}\$|s\$\^{-1}\$|rad)\)", name)
        log = self.figure("machine_log").axes
        self.assertEqual(log[0].get_xlabel(), "displacement $x$ (mm) once a forcing period")
        self.assertEqual(log[1].get_xlabel(), "time $t$ (s)")
        self.assertIn("(m\N{NO-BREAK SPACE}s$^{-1}$)", log[1].get_ylabel())

    def test_short_lengths_are_in_millimetres(self):
        history = self.figure("machine_point").axes[0]
        self.assertEqual(history.get_ylabel(), "displacement $x$ (mm)")
        self.assertEqual(numbers_beside(history), [-2.0, -1.0, 0.0, 1.0, 2.0])
        self.assertLess(np.abs(history.lines[0].get_ydata()).max(), 0.0021)  # the data are those of the file
        figure = self.figure("machine_map")
        self.assertEqual(figure.axes[0].get_ylabel(), "gap (mm)")
        self.assertLessEqual({1.0, 2.0, 3.0, 4.0}, set(numbers_beside(figure.axes[0])))
        titles = [axes.get_title().split("\n")[0] for axes in figure.axes]
        bar = figure.axes[titles.index(r"maximum $x_{\max}$ (mm)") + 1]
        self.assertEqual(max(numbers_beside(bar)), 4.0)
        self.assertIn("gap = 2\N{NO-BREAK SPACE}mm", self.figure("machine")._suptitle.get_text())
        large = self.figure("large").axes[0]
        self.assertEqual(large.get_ylabel(), "displacement $x$ (m)")
        self.assertEqual(max(numbers_beside(large)), 2.0)

    def test_a_machine_is_labelled_by_its_own_keys(self):
        figure = self.figure("dampers")
        self.assertEqual(figure.axes[0].get_xlabel(), "damping ratio")
        for name in ("machine", "machine_point", "dampers", "machine_map"):
            figure = self.figure(name)
            texts = [axes.get_xlabel() + axes.get_ylabel() + axes.get_title() for axes in figure.axes]
            texts += [figure._suptitle.get_text(), self.caption(figure)]
            for words in ("$h$", r"\tau", "x_s", r"\nu", "xs", "tau", "damping_ratio"):
                self.assertNotIn(words, " ".join(texts), name)
        self.assertIn("damping ratio = 0.1", self.figure("machine")._suptitle.get_text())
        heading = self.figure("damped_stops")._suptitle.get_text()
        self.assertIn(
            "damping of the stops = 20\N{NO-BREAK SPACE}N\N{NO-BREAK SPACE}s\N{NO-BREAK SPACE}m$^{-1}$", heading
        )

    def test_a_sensitivity_says_of_which_result_to_which_key(self):
        machine = "[machine]\nmass = 0.2\nstiffness = 2000\ndamping_ratio = 0.03\nforce = 8\nR = 0.6\ngap = 0.0015\n"
        sweep = "[sweep]\nfrequency = 'linspace(24.5, 50, 9)'\n[observe]\nimpacts = true\nenergy = true\n"
        self.make("run", "sens", machine + sweep + "sensitivity = 'gap, stiffness, damping_ratio'\n")
        scene = "[scene]\nf = -1\nh = 0.1\nR = 0.7\nxs = 0.5\n[sweep]\nnu = [0.9, 1]\n"
        self.make("run", "units", scene + "[observe]\nimpacts = true\nsensitivity = 'R, xs'\n")
        for file, name, words in (
            ("sens", "d_impact_speed_d_gap", "sensitivity of the impact speed to the gap"),
            ("sens", "d_impact_speed_d_stiffness", "sensitivity of the impact speed to $k$"),
            ("sens", "d_impact_power_d_gap", "sensitivity of the power lost in impacts to the gap"),
            ("sens", "d_period_d_damping_ratio", "sensitivity of $T$ to the damping ratio"),
            ("sens", "d_x_max_d_stiffness", r"sensitivity ∂$x_{\max}$/∂$k$"),
            ("units", "d_impact_speed_d_xs", "sensitivity of the impact speed to $x_s$"),
            ("units", "d_x_max_d_R", r"sensitivity ∂$x_{\max}$/∂$R$"),
        ):
            with self.subTest(name):
                told = label(self.output(file), name)
                self.assertEqual(told.split(" (")[0], words)
        drawn = self.figure("sens", only=("d_impact_speed_d_gap", "d_impact_speed_d_stiffness"))
        shown = [axes.get_ylabel().replace("\n", " ") for axes in drawn.axes]
        self.assertIn("speed to the gap (", shown[0])
        self.assertIn("speed to $k$ (", shown[1])
        point = scene.replace("[sweep]\nnu = [0.9, 1]\n", "nu = 0.9\n")
        self.make("run", "point", point + "[observe]\nimpacts = true\nsensitivity = 'R'\n")
        texts = [text.get_text() for axes in self.figure("point").axes for text in axes.texts]
        words = "sensitivity of the speed of the fastest impact to the restitution"
        self.assertTrue(any(text.startswith(words) for text in texts), texts)
        self.assertFalse(any("impact_speed" in text for text in texts), texts)

    def test_starts_at_0_are_not_told(self):
        for name in ("machine", "large", "dampers"):
            self.assertNotIn("(0)", self.figure(name)._suptitle.get_text())
        text = "[scene]\nf = 1\nh = 0.1\nxs = 3\nv0 = 0.5\n[sweep]\nnu = [0.9, 1]\n[observe]\nextrema = true\n"
        self.make("run", "started", text)
        heading = self.figure("started")._suptitle.get_text()
        self.assertIn("(0)$ = 0.5", heading)
        self.assertNotIn("(0)$ = 0\n", heading + "\n")

    def test_no_key_with_an_underscore_is_in_a_caption(self):
        scene = "[machine]\nmass = 10\nstiffness = 4e4\ndamping_ratio = 0.005\nforce = 5\nloose_gap = '5 mm'\n"
        text = scene + "loose_R = 0.6\nloose_mass = 0.5\nloose_v0 = 0.1\n[sweep]\nfrequency = [9.9, 10]\n"
        self.make("run", "damper", text + "[time]\nmax_periods = 50\n[observe]\nextrema = true\n")
        heading = self.figure("damper")._suptitle.get_text()
        plain = re.sub(r"\$[^$]*\$", "", heading)
        self.assertNotRegex(plain, r"\w_\w")
        self.assertIn("damping ratio = 0.005", plain)
        counts = [line.count(" = ") for line in heading.split("\n") if " = " in line]
        self.assertLessEqual(max(counts) - min(counts), 2, heading)  # none stands alone in its line

    def test_a_panel_of_impacts_begins_with_the_motion(self):
        text = "[scene]\nf = -1\nh = 0.1\nR = 0.7\nxs = -3\nnu = 0.9\n[time]\nmax_periods = 200\nwindow = {}\n"
        for window, shown in ((5, 5), (20, 20), (64, 20)):
            self.make("run", "short", text.format(window) + "[observe]\ntrajectory = 801\nimpact_log = true\n")
            self.assertEqual(int(self.output("short").values("status")), 1)
            figure = self.figure("short")
            tau = self.output("short").values("tau")
            ends = {axes.get_xlim() for axes in figure.axes if axes.get_ylabel().startswith("velocity before")}
            ((begin, end),) = ends
            self.assertEqual(end, tau[-1])
            self.assertAlmostEqual(begin, tau[-1] - shown * 2 * np.pi / 0.9, delta=1e-9 * tau[-1])
            self.assertGreaterEqual(begin, 0)

    def test_the_frame_cuts_no_marker_of_an_impact(self):
        text = "[scene]\nf = -1\nh = 0.1\nR = 0.7\nxs = -3\nnu = 0.9\n[time]\nmax_periods = 200\nwindow = 20\n"
        for more, panels in (("", 1), ("trajectory = 801\n", 3)):
            self.make("run", "ends", text + "[observe]\nimpact_log = true\n" + more)
            figure, found = pictures.single_figure(self.output("ends"), NO_CHOICE), 0
            for axes in figure.axes:
                marked = [line for line in axes.lines if line.get_marker() in "^v." and axes.get_xlabel()[:4] == "time"]
                found += bool(marked)
                for line in marked:
                    places = axes.transData.transform(np.column_stack(line.get_data()))[:, 0]
                    half = line.get_markersize() / 2 * figure.dpi / 72
                    self.assertLessEqual(line.get_clip_box().x0, places.min() - half)
                    self.assertGreaterEqual(line.get_clip_box().x1, places.max() + half)
            self.assertEqual(found, panels)

    def test_a_few_states_of_a_section_are_seen(self):
        text = "[scene]\nf = -1\nh = 0.1\nR = 0.7\nxs = 0.5\nnu = 1.4\n[observe]\nsection = {}\n"
        for count in (1, 4):
            self.make("run", "states", text.format(count))
            (line,) = [line for line in self.figure("states").axes[0].lines if len(line.get_xdata())]
            self.assertGreaterEqual(line.get_markersize(), 8)  # of ".", a disc of half of that

    def test_an_empty_panel_says_that_there_are_no_impacts(self):
        for name, options in (
            ("far", {"only": ("impact_log", "impact_count")}),
            ("far", {"only": ("v_before",)}),
            ("far", {"only": ("impact_speed",)}),
            ("far_map", {"only": ("v_before",)}),
            ("far_point", {}),
        ):
            with self.subTest(name, **options):
                self.assertEqual(empty_texts(self.figure(name, **options)), ["no impacts"])
        self.assertEqual(empty_texts(self.figure("speeds")), [])
        texts = self.draw("far_point", arguments=["--only", "v_before"]).texts()
        self.assertIn("no impacts", texts)


def empty_texts(figure):
    """What the panels without anything say."""
    return [text.get_text() for axes in figure.axes for text in axes.texts if text.get_gid() == "empty"]


def numbers_beside(axes):
    """The numbers beside the ordinate within its limits."""
    low, high = axes.get_ylim()
    pairs = zip(axes.get_yticks(), axes.get_yticklabels())
    texts = [text.get_text() for place, text in pairs if low - 1e-12 <= place <= high + 1e-12]
    return [float(text.replace("\N{MINUS SIGN}", "-")) for text in texts]


if __name__ == "__main__":
    unittest.main()
