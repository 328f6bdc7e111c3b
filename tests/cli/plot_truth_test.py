"""Pictures draw what happened: contacts that last, impacts at their greatest speed, points that escaped, axes in any
order, mirror images.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import re
import unittest

import h5py
import numpy as np

from command_line import SOURCE
from plot_checks import Svg
from plot_pictures import choice
from scene_pictures import ScenePictures

from clatter.plots import pictures
from clatter.plots.attractors import basin_kinds, name_of
from clatter.plots.data import ESCAPED
from clatter.plots.motion import motion


class Contacts(ScenePictures):
    def test_velocity_goes_on_at_a_soft_stop_and_jumps_at_a_rigid_one(self):
        for name, point, jumps in (
            ("soft", (), []),
            ("rigid", (), [-1, 1]),
            ("mixed", (), [1]),
            ("stiffer", (0,), []),
            ("stiffer", (1,), [-1, 1]),
        ):
            with self.subTest(name, point=point):
                output = self.output(name)
                tau, x, v = motion(output, point)
                times, sides, before, after = output.impacts(point)
                self.assertEqual(sorted(set(sides.tolist())), [-1, 1])
                jump = np.flatnonzero((np.diff(tau) == 0) & (np.abs(np.diff(v)) > 1e-6))
                wanted = [side in jumps for side in sides]
                np.testing.assert_array_equal(tau[jump], times[wanted])
                np.testing.assert_array_equal(v[jump], before[wanted])
                np.testing.assert_array_equal(v[jump + 1], after[wanted])
                touches = np.searchsorted(tau, times)  # each on the stop, at the speed before
                np.testing.assert_array_equal(x[touches], np.where(sides < 0, -0.5, 0.5))
                np.testing.assert_array_equal(v[touches], before)

    def test_no_line_is_upright_at_a_touch(self):
        for name, rigid in (("soft", ()), ("rigid", (-1, 1)), ("mixed", (1,))):
            with self.subTest(name):
                upright = int(np.isin(self.output(name).values("impact_stop"), rigid).sum())
                self.assertEqual(upright > 0, bool(rigid))
                picture = self.draw(name, arguments=["--only", "trajectory"])
                plane, history = picture.panels[1], picture.panels[2]
                for panel in (plane, history):
                    self.assertEqual(sum(map(uprights, panel.curves())), upright)
                self.assertEqual(len(picture.panels[3].legend()), 2)  # both stops, in the panel of the touches

    def test_the_shipped_motion_between_soft_stops_has_no_spike(self):
        picture = Svg(SOURCE / "configs" / "soft_history.svg")
        self.assertEqual([sum(map(uprights, panel.curves())) for panel in picture.panels[:3]], [0, 0, 0])


def uprights(curve):
    """Upright segments of a curve in SVG that are longer than a line is thick."""
    (path, *_) = [part for part in curve.iter() if str(part.tag).endswith("}path")]
    corners = np.array(re.findall(r"[ML] (\S+) (\S+)", path.get("d")), float)
    steps = np.abs(np.diff(corners, axis=0))
    is_frame_line = len(corners) == 2
    return 0 if is_frame_line else int(np.count_nonzero((steps[:, 0] < 1e-3) & (steps[:, 1] > 3)))


class Speeds(ScenePictures):
    def test_the_larger_speed_of_both_stops_lies_over_a_branch(self):
        output = self.output("speeds")
        speeds = output.values("impact_speed")
        first = np.nanmax(np.abs(output.values("v_before")), axis=1)
        fastest = np.fmax(*speeds.T)
        self.assertTrue((fastest > 1.001 * first).any())  # the first impact isn't always the fastest
        files = [str(self.folder / f"{name}.h5") for name in ("branch", "speeds")]
        figure = pictures.shared_figure(choice(files=files, only=("impact_speed",), backbone=False))
        (points,) = [line for line in figure.axes[0].lines if line.get_gid() == "sweep"]
        np.testing.assert_array_equal(points.get_ydata(), fastest)
        self.assertNotIn("impact_speed", self.caption(figure))

    def test_a_sweep_without_it_has_no_curve_and_the_caption_says_why(self):
        older = self.folder / "older.h5"
        older.write_bytes((self.folder / "speeds.h5").read_bytes())
        with h5py.File(older, "a") as file:
            del file["impact_speed"]
        picture = self.draw("branch", "older", arguments=["--only", "impact_speed"])
        self.assertNotIn("sweep", picture.panels[0].legend())
        said = " ".join(picture.texts())
        self.assertIn("no points of the sweep: older.h5 has no impact_speed", said)
        self.assertIn("observe.impacts = true", said)

    def test_each_stop_has_its_curve(self):
        figure = self.figure("speeds", only=("impact_speed",))
        self.assertEqual(figure.axes[0].get_ylabel(), "speed of the fastest impact")
        entries = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        self.assertEqual(entries[:2], ["lower stop", "upper stop"])


class Points(ScenePictures):
    def test_a_section_of_a_shaken_scene_is_taken_once_a_forcing_period(self):
        for axes, symbol in zip(self.figure("base").axes, ("$x$", "$x$\N{PRIME}")):
            self.assertEqual(axes.get_ylabel(), f"{symbol} once a forcing period, relative")
        self.assertEqual(self.figure("stops").axes[0].get_xlabel(), "displacement $x$, relative once a forcing period")
        self.assertEqual(self.figure("free").axes[1].get_ylabel(), "$x$\N{PRIME} on the way up")

    def test_transients_count_impacts_in_the_observed_time(self):
        labels = [axes.get_ylabel() for axes in self.figure("free").axes]
        self.assertIn("impacts in the observed time", labels)
        self.assertNotIn("forcing period", " ".join(labels) + self.caption(self.figure("free")))
        self.assertEqual(self.output("gaps")["impacts_per_period"].long_name, "impacts per forcing period")

    def test_a_point_that_escaped_has_not_failed(self):
        status = self.output("runaway").values("status")
        self.assertEqual(sorted(set(status.tolist())), [0, ESCAPED])
        entries = [text.get_text() for text in self.figure("runaway").axes[0].get_legend().get_texts()]
        self.assertEqual(entries, ["escaped"])
        names = [name for name, _, points in basin_kinds(self.output("runaways")) if points.any()]
        self.assertEqual(names[-1], "escaped")
        figure = self.figure("escapes")
        texts = [text.get_text() for axes in figure.axes for text in axes.get_yticklabels()]
        self.assertIn("escaped", texts)
        self.assertNotIn("failed", " ".join(texts) + self.caption(figure))
        self.assertIn("olive: escaped", self.caption(figure))
        entries = [text.get_text() for text in self.figure("runaways").axes[1].get_yticklabels()]
        self.assertIn("escaped", entries)

    def test_a_constant_says_at_how_many_points_it_is_one(self):
        ratios = self.output("bumpers").values("period_ratio")
        self.assertEqual(set(ratios.tolist()), {0.0, 1.0})  # 0: none
        words = f"period of the motion in forcing periods = 1 at {np.count_nonzero(ratios)} of 61 points"
        self.assertIn(words, self.caption(self.figure("bumpers")))

    def test_an_axis_in_any_order_is_joined_in_its_own(self):
        figure = self.figure("unsorted")
        lines = [line for axes in figure.axes for line in axes.lines if line.get_linestyle() != "None"]
        lines = [line for line in lines if len(line.get_xdata()) > 4]
        self.assertGreater(len(lines), 6)
        for line in lines:
            self.assertTrue((np.diff(line.get_xdata()) >= 0).all(), line.get_xdata())
        output = self.output("unsorted").in_increasing_order()
        for place, nu in enumerate(output.values("nu")):
            index = int(np.flatnonzero(self.output("unsorted").values("nu") == nu)[0])
            self.assertEqual(output.values("v_max")[place], self.output("unsorted").values("v_max")[index])
            for own, file in zip(output.impacts((place,)), self.output("unsorted").impacts((index,))):
                np.testing.assert_array_equal(own, file)
        turned = self.figure("path").axes[0].lines[0].get_xdata()
        self.assertEqual(turned.tolist(), [1.0, 1.1, 1.2, 1.3, 1.15, 1.05])  # followed that way

    def test_no_line_joins_symmetric_motion_with_other_motion(self):
        values = self.output("gaps").values("symmetric")
        self.assertEqual(set(values[np.isfinite(values)].tolist()), {0.0, 1.0})
        axes = self.figure("gaps", only=("symmetric",)).axes[0]
        for line in axes.lines:
            step = np.diff(line.get_ydata())
            self.assertFalse((np.isfinite(step) & (step != 0)).any() and line.get_linestyle() != "None")
        self.assertEqual([text.get_text() for text in axes.get_yticklabels()], ["no", "yes"])

    def test_mirror_images_have_names_of_their_own(self):
        output = self.output("twins")
        names = [name_of(output, number) for number in range(len(output.values("motion")))]
        (pair,) = [(i, int(j)) for i, j in enumerate(output.values("motion_mirror")) if 0 <= j < i]
        self.assertEqual([names[number] for number in pair], ["1/1, LU, mirrored", "1/1, LU"])
        self.assertEqual(len(set(names)), len(names))
        figure = self.figure("twins", only=("word",))
        self.assertIn("a motion and its mirror image have one regime", self.caption(figure))


if __name__ == "__main__":
    unittest.main()
