"""plot.py chooses the kind of a picture by what the file holds; each has its elements, and no text lies on another.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import subprocess
import unittest

import h5py
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from command_line import CLATTER
from plot_checks import overlapping_texts, texts_beyond, texts_with_boxes
from plot_pictures import CONFIGURATIONS, Pictures, choice
from script_runs import run_script

from clatter.plots import pictures
from clatter.plots.choice import ChoiceProblem, members_of
from clatter.plots.scales import integer_levels, is_constant, shown_values


class Kinds(Pictures):
    def test_no_text_lies_on_another_or_goes_beyond_the_picture(self):
        for name in CONFIGURATIONS:
            with self.subTest(name):
                figure = self.figure(name)
                texts = texts_with_boxes(figure)
                self.assertGreater(len(texts), 3)
                self.assertEqual(overlapping_texts(figure, texts), [])
                self.assertEqual(texts_beyond(figure, texts), [])

    def test_texts_beyond_the_picture_are_found(self):
        figure = self.figure("linear")
        self.addCleanup(figure.text(0.98, 0.5, "far to the right").remove)
        self.assertEqual(texts_beyond(figure), ["far to the right"])

    def test_overlapping_texts_are_found(self):
        figure = self.figure("linear")
        self.addCleanup(figure.text(0.5, 0.5, "one").remove)
        self.addCleanup(figure.text(0.505, 0.5, "other").remove)
        self.assertIn(("one", "other"), overlapping_texts(figure))

    def test_bifurcation_diagram_of_sections(self):
        picture = self.draw("section")
        x, v = picture.panels[:2]
        for panel, name in ((x, "x once a forcing period"), (v, "x′ once a forcing period")):
            self.assertEqual(len(panel.images()), 1)  # all points
            self.assertTrue(any(text.replace("$", "") == name for text in panel.texts()), panel.texts())
        self.assertTrue({"multiplier near −1", "multiplier near +1"} & set(x.legend()))
        words = set(self.output("section").values("impact_word").tolist())
        self.assertTrue(set(x.texts()) & (words - {"-", ""}))
        # lines between neighbours with different words
        changes = np.count_nonzero(np.diff([hash(word) for word in self.output("section").values("impact_word")]))
        figure = self.figure("section")
        upright = [
            line for line in figure.axes[0].lines if len(line.get_xdata()) == 2 and np.ptp(line.get_xdata()) == 0
        ]
        self.assertEqual(len(upright), changes)
        self.assertGreater(changes, 1)

    def test_every_state_of_a_section_is_a_point(self):
        figure = self.figure("section")
        (points,) = (line for line in figure.axes[0].lines if line.get_rasterized())
        values = self.output("section").values("section_x")
        self.assertEqual(len(points.get_xdata()), np.isfinite(values).sum())
        self.assertEqual(sorted(points.get_ydata()), sorted(values[np.isfinite(values)]))

    def test_bifurcation_diagram_of_impacts(self):
        (panel,) = self.draw("impacts").panels
        self.assertEqual(panel.legend(), ["lower stop", "upper stop"])
        figure = self.figure("impacts")
        points = sum(len(line.get_xdata()) for line in figure.axes[0].lines if line.get_rasterized())
        self.assertEqual(points, len(self.output("impacts").values("impact_tau")))

    def test_chaos_has_its_section_and_its_last_periods_with_impacts(self):
        output = self.output("chaos")
        figure = self.figure("chaos")
        history, phase_plane, _, impacts, section = figure.axes
        (points,) = (line for line in section.lines if line.get_rasterized())
        self.assertEqual(len(points.get_xdata()), 500)
        motion, marks = (line for line in history.lines if len(line.get_xdata()) > 2)
        begin = output.values("tau")[-1] - 20 * 2 * np.pi / 0.9
        self.assertGreaterEqual(motion.get_xdata()[0], begin)
        self.assertLess(motion.get_linewidth(), 1)
        self.assertEqual(len(marks.get_xdata()), np.count_nonzero(output.values("impact_tau") >= begin))
        self.assertGreaterEqual(impacts.get_xlim()[0], begin)
        self.assertEqual(len(self.draw("chaos").panels), 5)

    def test_family_has_a_curve_for_each_value(self):
        picture = self.draw("family")
        names = ["$R = 0.3$", "$R = 0.6$", "$R = 0.9$"]
        for panel in picture.panels:
            self.assertEqual(
                [text.replace("$", "") for text in panel.legend()[:3]], [n.replace("$", "") for n in names]
            )
        extrema = self.figure("family").axes[0]
        curves = [line for line in extrema.lines if np.isfinite(np.asarray(line.get_ydata(), float)).sum() > 10]
        self.assertEqual(len(curves), 6)  # minimum and maximum
        self.assertEqual(len({line.get_color() for line in curves}), 3)

    def test_hysteresis_is_two_curves_in_one_picture(self):
        (x, v) = self.draw("hysteresis").panels
        self.assertEqual(x.legend()[:2], ["up", "down"])
        self.assertEqual(v.legend()[:2], ["up", "down"])

    def test_files_over_the_same_axis_share_a_picture(self):
        text = (self.folder / "hysteresis.toml").read_text().replace('"both"', '"{}"')
        for way in ("up", "down"):
            (self.folder / f"{way}.toml").write_text(text.format(way))
            command = [CLATTER, "run", self.folder / f"{way}.toml", "-o", self.folder / f"{way}.h5", "-q"]
            subprocess.run(command, check=True)
        picture = self.draw("up", "down")
        self.assertEqual(picture.panels[0].legend()[:2], ["up", "down"])  # the names of the files
        self.assertTrue((self.folder / "up+down.svg").is_file())
        files = [self.folder / f"{name}.h5" for name in ("up", "uneven")]
        result = run_script("plot.py", *files, "--format", "svg")  # one over an axis, one over two
        self.assertEqual(result.stdout.split(), [str(path.with_suffix(".svg")) for path in files])

    def test_files_of_different_scenes_are_named_by_what_differs(self):
        for R in ("0.5", "0.8"):
            command = [CLATTER, "run", self.folder / "linear.toml", "-o", self.folder / f"R{R}.h5", "-q"]
            subprocess.run([*command, "--set", "scene.xs=1.2", "--set", f"scene.R={R}"], check=True)
        legend = self.draw("R0.5", "R0.8").panels[0].legend()[:2]
        self.assertEqual([text.replace("$", "") for text in legend], ["R = 0.5", "R = 0.8"])

    def test_basins_have_a_colour_and_a_name_for_each_motion_and_its_state(self):
        basins = pictures.single_figure(self.output("basins"), choice(only=("attractor",))).axes[0]
        output = self.output("basins")
        (points,) = [image for image in basins.images]
        colours = {tuple(pixel) for pixel in points.get_array().reshape(-1, 4).tolist()}
        self.assertEqual(len(colours), 2)
        states = [(line.get_gid(), *map(float, (*line.get_xdata(), *line.get_ydata()))) for line in basins.lines]
        x, v = output.values("motion_x"), output.values("motion_v")
        self.assertEqual(states, [(f"motion {i}", x[i], v[i]) for i in range(2)])
        shares = np.bincount(output.values("attractor").ravel()) / output.values("attractor").size
        names = [f"no impacts, {100 * shares[0]:.0f} %", f"1/1 symmetric, LU, {100 * shares[1]:.0f} %"]
        picture = self.draw("basins")
        self.assertEqual([text for panel in picture.panels for text in panel.texts() if text in names], names)
        self.assertIn("periods until settled", [text for panel in picture.panels for text in panel.texts()])
        self.assertFalse(overlapping_texts(self.figure("basins")))

    def test_starts_along_one_dimension_are_points(self):
        figure = self.figure("starts")
        output, basins = self.output("starts"), figure.axes[0]
        for number, line in enumerate(basins.lines):
            mine = output.values("attractor") == number
            self.assertEqual(line.get_xdata().tolist(), output.values("x0")[mine].tolist())
            self.assertEqual(line.get_ydata().tolist(), output.values("v0")[mine].tolist())
        self.assertEqual(len(basins.lines), 2)
        self.assertEqual(len(figure.axes[1].collections[0].get_offsets()), 64)
        self.assertFalse(overlapping_texts(figure))

    def test_zones_are_stacked_shares_with_names(self):
        output = self.output("zones")
        figure = self.figure("zones")
        panel = figure.axes[0]
        tops = np.max([patch.get_data().values.max() for patch in panel.patches])
        self.assertAlmostEqual(tops, 1.0)
        words = [text.get_text() for text in panel.texts]
        self.assertEqual(sorted(set(words)), ["hard", "quiet", "soft"])
        strips = {name: [c for c in panel.collections if c.get_gid() == name] for name in ("soft", "hard", "quiet")}
        several = (output.values("motion_share") > 0).sum(axis=1) > 1
        self.assertTrue((several == (output.values("motion_count") > 1)).all())
        runs = np.count_nonzero(np.diff(np.concatenate([[0], several.astype(int)])) == 1)
        self.assertEqual(len(strips["hard"]), runs)
        self.assertEqual(len(strips["quiet"]), 1)
        self.assertFalse(overlapping_texts(figure))

    def test_a_motion_has_one_colour_in_all_pictures_of_a_file(self):
        output = self.output("zones")
        low, high = (pictures.single_figure(output, choice(at=(("nu", nu),))).axes[0] for nu in (1.2, 1.4))
        colours = [{line.get_label().split(",")[0]: line.get_color() for line in axes.lines} for axes in (low, high)]
        self.assertEqual(colours[0], colours[1])
        self.assertEqual(len(colours[0]), 2)

    def test_map_is_images_and_names_regimes(self):
        picture = self.draw("map")
        titles = [text for panel in picture.panels for text in panel.texts()]
        for title in ("regime, impacts on a stop / forcing periods", "kind of motion", "symmetric motion"):
            self.assertIn(title, " ".join(titles))  # in lines
        names = {name.replace("inf", "∞") for name in self.output("map").values("regime").ravel().tolist()}
        self.assertGreater(len(names & set(titles)), 3)
        self.assertLess((self.folder / "map.svg").stat().st_size, 600_000)
        self.assertFalse([path for path in picture.root.iter() if path.tag == "{http://www.w3.org/2000/svg}pattern"])

    def test_a_map_shows_each_value_where_its_point_lies(self):
        for name in ("map", "uneven"):
            output = self.output(name)
            axes = pictures.single_figure(output, choice(only=("x_max",))).axes[0]
            image = axes.images[0]
            pixels, values = image.get_array(), output.values("x_max")
            bar = ScalarMappable(Normalize(values.min(), values.max()), "viridis")
            for i, nu in enumerate(output.values("nu")):
                for j, xs in enumerate(output.values("xs")):
                    x, y = axes.transAxes.inverted().transform(axes.transData.transform((nu, xs)))
                    row, column = int(y * pixels.shape[0]), int(x * pixels.shape[1])
                    wanted = bar.to_rgba(values[i, j], bytes=True)
                    self.assertEqual(pixels[row, column].tolist(), list(wanted), (name, nu, xs))

    def test_a_hatch_is_one_image(self):
        output = self.output("map")
        self.assertTrue((output.values("status") == 1).any())
        axes = pictures.single_figure(output, choice(only=("x_max",))).axes[0]
        self.assertEqual(len(axes.images), 2)
        self.assertEqual(len(axes.collections), 0)

    def test_a_constant_is_a_line_and_no_panel(self):
        picture = self.draw("linear")
        labels = " ".join(picture.texts())
        self.assertIn("impacts per forcing period, both stops = 0", labels)
        self.assertNotIn("share of time at rest\n", labels)
        output = self.output("linear")
        self.assertTrue(is_constant(output.values("x_amplitude")[:, 0], 1.0))
        phases = shown_values(output, "x_phase")
        self.assertTrue(np.isfinite(phases[:, 1]).all())
        self.assertTrue(np.isnan(phases[:, 2]).all())  # of nothing

    def test_chatter_does_not_flatten_a_map(self):
        values = np.ones((50, 50))
        values[:5], values[5:9] = 80.0, 2.0
        levels = integer_levels(values)
        self.assertEqual((levels.first, levels.last, levels.has_gaps, levels.greatest), (1, 2, False, 80.0))
        self.assertFalse(integer_levels(values[5:]).is_clipped)
        self.assertIsNone(integer_levels(values + 0.5))  # no counts
        self.assertRegex(" ".join(self.draw("map").texts()), r"colours of impacts per period end at \d+, values at \d+")

    def test_a_stop_that_is_not_there_is_not_listed(self):
        texts = " ".join(self.draw("one_stop").texts())
        self.assertIn("no upper stop", texts)
        self.assertNotIn("inf", texts)

    def test_motion_within_a_soft_stop_is_in_view(self):
        output = self.output("soft")
        axes = self.figure("soft").axes[0]
        self.assertGreater(output.values("x_max").max(), 1.2)
        self.assertGreater(axes.get_ylim()[1], output.values("x_max").max())
        self.assertLess(axes.get_ylim()[0], output.values("x_min").min())

    def test_a_point_has_a_table_of_what_there_is(self):
        texts = self.draw("point").texts()
        for text in ("velocity before the first impact, lower stop", str(self.output("point").values("impact_word"))):
            self.assertIn(text, texts)
        self.assertFalse([text for text in texts if ", upper stop" in text or "R_+" in text])
        self.assertIn("2/1", texts)
        self.assertEqual(len(self.draw("numbers").panels), 1)
        texts = self.draw("chatter").texts()  # its exponent is minus infinity
        self.assertIn("∞/1", texts)
        self.assertFalse([text for text in texts if "inf" in text or "Lyapunov" in text])

    def test_phases_of_nothing_are_not_drawn(self):
        figure = self.figure("linear_point")
        panels = {axes.get_ylabel(): axes for axes in figure.axes}
        for quantity in ("displacement $\\varphi_k$", "velocity $\\varphi$\N{PRIME}$_k$"):
            marks = next(line for line in panels[f"phase of {quantity} (rad)"].lines if line.get_marker() == "o")
            self.assertEqual(np.isfinite(marks.get_ydata()).tolist(), [False, True, False, False, False])

    def test_many_markers_are_an_image_in_vector_formats(self):
        command = [CLATTER, "run", self.folder / "impacts.toml", "-o", self.folder / "dense.h5", "-q"]
        settings = ("sweep.nu=linspace(0.84, 1, 3001)", "observe.period=true", "observe.impact_log=false")
        subprocess.run([*command, *(word for setting in settings for word in ("--set", setting))], check=True)
        (panel,) = self.draw("dense", arguments=["--only", "period_ratio"]).panels
        self.assertEqual(len(panel.images()), 1)

    def test_choices(self):
        output = self.output("cube")
        self.assertEqual([m.title for m in members_of(output)], [""])
        self.assertEqual(members_of(output)[0].output.axes, ("R", "nu"))
        (held,) = members_of(output, at=[("R", 0.75)])
        self.assertEqual((held.output.axes, held.output.scene["R"]), (("nu", "xs"), 0.8))
        np.testing.assert_array_equal(held.output.values("x_max"), output.values("x_max")[1])
        family = members_of(output, along="nu", over="R", at=[("xs", 3)])
        self.assertEqual([m.title.replace("$", "") for m in family], ["R = 0.3", "R = 0.8"])
        np.testing.assert_array_equal(family[1].output.values("x_max"), output.values("x_max")[1, :, 3])
        (turned,) = members_of(output, along="xs", at=[("R", 0.3)])
        self.assertEqual(turned.output.axes, ("xs", "nu"))
        np.testing.assert_array_equal(turned.output.values("x_max"), output.values("x_max")[0].T)

    def test_impacts_follow_their_points(self):
        with h5py.File(self.folder / "impacts.h5") as file:
            counts, tau = file["impact_count"][()], file["impact_tau"][()]
        first = np.cumsum(counts) - counts
        for index in (0, 40, 80):
            times, *_ = self.output("impacts").at("nu", index).impacts(())
            np.testing.assert_array_equal(times, tau[first[index] : first[index] + counts[index]])

    def test_views(self):
        picture = ("--size", "12x9cm", "--xlim", "0.9,1.1", "--ylim", "-5,5", "--title", "My $own", "--only", "x_max")
        svg = self.draw("linear", arguments=picture)
        self.assertEqual(svg.root.get("width"), f"{12 / 2.54 * 72:.6f}".rstrip("0") + "pt")
        self.assertIn("My $own", " ".join(svg.texts()).replace("\\", ""))
        axes = pictures.single_figure(self.output("linear"), choice(xlim=(0.9, 1.1), ylim=(-5, 5), log="x")).axes[0]
        self.assertEqual((axes.get_xlim(), axes.get_ylim(), axes.get_xscale()), ((0.9, 1.1), (-5, 5), "log"))

    def test_wrong_choices(self):
        for name, arguments, words in (
            ("cube", ["--only", "x_maxx"], "--only: 'x_maxx' is no result in .*; did you mean 'x_max'?"),
            ("cube", ["--only", "zzz"], "--only: 'zzz' is no result in .*; there are .*x_min"),
            ("cube", ["--only", "x_max,"], "'x_max,' has an empty name"),
            ("cube", ["--along", "nuu"], "--along: 'nuu' is no axis of this file, which has R, nu, xs"),
            ("cube", ["--over", "h"], "--over: 'h' is no axis of this file"),
            ("cube", ["--over", "nu", "--along", "nu"], "--along and --over both name 'nu'"),
            ("linear", ["--over", "nu"], "--over nu: no axis is left to draw along"),
            ("map", ["--over", "nu"], "--over nu: 21 curves; at most 12"),
            ("cube", ["--at", "nu=3"], "--at nu=3: beyond the axis, which goes from 0.8 to 1.2"),
            ("cube", ["--at", "h=3"], "--at: 'h' is no axis of this file"),
            ("cube", ["--at", "nu"], "'nu' is no AXIS=VALUE"),
            ("cube", ["--at", "nu=inf"], "'nu=inf' is no AXIS=VALUE"),
            ("cube", ["--size", "7"], "'7' is no size; write WxH in inches, 1 to 100"),
            ("cube", ["--size", "0x4"], "'0x4' is no size"),
            ("cube", ["--xlim", "1"], "'1' is no pair of limits; write A,B"),
            ("cube", ["--ylim", "1,1"], "'1,1' is no pair of limits"),
            ("cube", ["--ylim", "a,b"], "'a,b' is no A,B"),
            ("cube", ["--log", "z"], "argument --log: invalid choice: 'z'"),
        ):
            with self.subTest(arguments):
                self.assertRegex(self.refuse(name, *arguments), words.replace("?", r"\?"))
        with self.assertRaises(ChoiceProblem):
            members_of(self.output("linear"), over="nu")


if __name__ == "__main__":
    unittest.main()
