"""plot.py draws what accuracy costs in time: files as `clatter accuracy` writes them, made by hand here."""

import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

import h5py
import numpy as np
from matplotlib import image

SOURCE = Path(os.environ["CLATTER_SOURCE"])
sys.path.insert(0, str(SOURCE / "scripts"))

from clatter.plots import accuracy as plot_accuracy  # noqa: E402  (from the source tree)
from clatter.plots import data, style  # noqa: E402
from synthetic_accuracy import MOTION, RESULTS, SyntheticAccuracy  # noqa: E402


def plot(*arguments):
    return subprocess.run(
        ["/usr/bin/python3", SOURCE / "scripts" / "plot.py", *arguments], capture_output=True, text=True
    )


def make_accuracies(folder):
    """name: the output, written to name.h5"""
    accuracies = {
        "scalar": SyntheticAccuracy(),
        "sweep": SyntheticAccuracy(nu=[0.9, 1.0, 1.1]),
        "transient": SyntheticAccuracy(steady=False),
        "map": SyntheticAccuracy(nu=[0.9, 1.0], h=[0.1, 0.2, 0.3]),
        "faultless": SyntheticAccuracy(),
        "dead": SyntheticAccuracy(h=[0.1, 0.2]),
    }
    scalar, sweep, faultless, dead = (accuracies[name] for name in ("scalar", "sweep", "faultless", "dead"))
    for name in MOTION:
        scalar.results[name][scalar.rows("exact")] = 0.0
        scalar.results[name][scalar.rows("dopri5", 1e-13)] = np.nan
        dead.results[name][:] = np.nan
    dead.status[:] = 17
    for name in ("error_harmonics", "error_harmonics_v"):
        dead.results[name][:] = np.nan
    sweep.status[1, sweep.rows("moreau", 1e-2)[1]] = 16
    for name in RESULTS:
        sweep.results[name][1, sweep.rows("moreau", 1e-2)[1]] = np.nan
    for name in ("missed", "doubled"):
        faultless.results[name][:] = 0.0
    faultless.results["ns_spread"][:] = np.nan
    for name, accuracy in accuracies.items():
        accuracy.write(folder / f"{name}.h5")
    return accuracies


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.kept.name)
        cls.accuracies = make_accuracies(cls.folder)
        style.use_style()
        cls.result = plot(*(cls.folder / f"{name}.h5" for name in cls.accuracies))

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def svg(self, name):
        return xml.etree.ElementTree.parse(self.folder / f"{name}.svg").getroot()

    def words(self, name):
        """The texts of a picture: matplotlib draws letters as paths, and says in comments what they are."""
        return (self.folder / f"{name}.svg").read_text(encoding="utf-8").split("<!-- ")[1:]

    def says(self, name, text):
        return any(text in word.split(" -->")[0] for word in self.words(name))

    def marks(self, name, group):
        """Number of symbols in a curve of a picture; None without the curve."""
        found = [element for element in self.svg(name).iter() if element.get("id") == group]
        self.assertLess(len(found), 2, group)
        return sum(element.tag.endswith("}use") for element in found[0].iter()) if found else None

    def test_every_output_is_drawn_beside_its_file(self):
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))
        self.assertEqual(
            self.result.stdout.split(),
            [str(self.folder / f"{name}.{kind}") for name in self.accuracies for kind in ("svg", "png")],
        )
        for name in self.accuracies:
            with self.subTest(name):
                pixels = image.imread(self.folder / f"{name}.png")[..., :3]
                self.assertGreater((pixels[::2, ::2, 0] < 0.9).mean(), 0.005)

    def test_panels_are_those_that_have_something_to_show(self):
        for name, panels in (
            ("scalar", "time samples steady"),
            ("sweep", "time samples steady"),
            ("transient", "time samples"),
            ("map", "time samples steady"),
            ("dead", "time"),
        ):
            with self.subTest(name):
                found = [element.get("id") for element in self.svg(name).iter()]
                self.assertEqual(
                    [part for part in found if part and part.startswith("panel-")],
                    [f"panel-{part}" for part in panels.split()],
                )
        self.assertTrue(self.says("dead", "no method has an error"))
        self.assertFalse(self.says("scalar", "no method has an error"))

    def test_curves_have_a_symbol_for_each_setting_that_has_an_error(self):
        curves = {
            "exact": 1,
            "exact_lanes": 1,
            "dopri5": 11,
            "moreau": 5,
            "harmonics_fft": 17,
            "harmonics_fft_v": 17,
            "steady": 12,
            "steady_repetition": 12,
        }
        for name, differences in (
            ("scalar", {"dopri5": 10}),
            ("sweep", {}),
            ("map", {}),
            ("dead", dict.fromkeys(curves)),
            ("transient", {"steady": None, "steady_repetition": None}),
        ):
            for curve, count in (curves | differences).items():
                with self.subTest(name, curve=curve):
                    self.assertEqual(self.marks(name, curve), count)

    def test_faulty_rows_are_hollow_and_the_legend_says_why(self):
        missed, failed = "impacts missed or doubled", ", or failed"
        for name, hollow in (("scalar", (1, 1)), ("sweep", (1, 2)), ("faultless", (0, 0))):
            with self.subTest(name):
                self.assertEqual(tuple(self.marks(name, f"{curve}-hollow") for curve in ("dopri5", "moreau")), hollow)
                self.assertEqual(self.says(name, missed), name != "faultless")
                self.assertEqual(self.says(name, failed), name == "sweep")

    def test_notes_explain_the_picture(self):
        for name, floor, points, bars in (
            ("scalar", True, "", True),
            ("sweep", False, "cost of 3 points", True),
            ("map", False, "cost of 6 points", True),
            ("faultless", False, "", False),
        ):
            with self.subTest(name):
                self.assertEqual(self.says(name, "are drawn there"), floor)
                self.assertEqual(self.says(name, "worst error and median cost of"), bool(points))
                self.assertTrue(self.says(name, points))
                self.assertEqual(self.says(name, "interquartile"), bars)
                self.assertTrue(self.says(name, "Accuracy and time."))
                self.assertFalse(self.says(name, "Fig. 22."))

    def test_a_second_run_gives_the_same_bytes(self):
        again = self.folder / "again"
        self.assertEqual(plot(self.folder / "sweep.h5", "-o", again).returncode, 0)
        for kind in ("svg", "png"):
            self.assertEqual((again / f"sweep.{kind}").read_bytes(), (self.folder / f"sweep.{kind}").read_bytes())

    def test_help_and_refusals_say_which_files(self):
        (self.folder / "text.h5").write_text("no HDF5\n")
        self.assertIn("'clatter run', 'clatter accuracy' or 'clatter branch'", " ".join(plot("--help").stdout.split()))
        self.assertIn("is not an HDF5 file; name an output of clatter", plot(self.folder / "text.h5").stderr)

    def test_labels_cover_nothing(self):
        for name in ("scalar", "sweep", "transient", "map"):
            figure = plot_accuracy.accuracy_figure(data.Output(self.folder / f"{name}.h5"))
            figure.draw_without_rendering()
            for axes in figure.axes:
                boxes = [text.get_window_extent() for text in axes.texts]
                for place, box in enumerate(boxes):
                    with self.subTest(name, text=axes.texts[place].get_text()):
                        self.assertTrue(axes.bbox.contains(box.x0, box.y0) and axes.bbox.contains(box.x1, box.y1))
                        self.assertEqual(box.count_overlaps(boxes), 1)  # itself
                        for line in axes.get_lines():
                            pixels = line.get_transform().transform(np.column_stack(line.get_data()))
                            self.assertFalse(box.padded(-0.5).count_contains(pixels[np.isfinite(pixels).all(axis=1)]))
            texts = [text.get_text() for text in figure.axes[0].texts]
            for label in ["exact", *(f"1e\N{MINUS SIGN}{power}" for power in range(1, 13))]:
                self.assertIn(label, texts, name)


class Reductions(unittest.TestCase):
    def front(self, *points):
        return plot_accuracy.pareto_front(*np.array(points, float).T)

    def test_front_of_points_that_no_other_beats(self):
        self.assertEqual(self.front((1, 9), (2, 5), (3, 7), (4, 1), (5, 1)), [0, 1, 3])
        self.assertEqual(self.front((4, 1), (2, 5), (3, 7), (1, 9)), [3, 1, 0])
        self.assertEqual(self.front((3, 3), (1, 1), (2, 2)), [1])
        self.assertEqual(self.front((2, 5), (2, 4)), [1])
        self.assertEqual(self.front((2, 5), (1, 5)), [1])
        self.assertEqual(self.front((2, 5), (2, 5), (3, 5)), [0, 1])
        self.assertEqual(plot_accuracy.pareto_front(np.array([]), np.array([])), [])

    def test_worst_and_median_leave_out_missing_values(self):
        values = np.array([[1.0, np.nan, np.nan], [3.0, 5.0, np.nan], [2.5, 6.0, np.nan]])
        np.testing.assert_array_equal(plot_accuracy.worst(values), [3.0, 6.0, np.nan])
        np.testing.assert_array_equal(plot_accuracy.medians(values), [2.5, 5.5, np.nan])

    def read(self, accuracy, method, cost="ns_per_period"):
        with tempfile.TemporaryDirectory() as folder:
            accuracy.write(Path(folder) / "accuracy.h5")
            return plot_accuracy.curve(data.Output(Path(folder) / "accuracy.h5"), method, MOTION, cost)

    def test_a_curve_has_the_worst_error_and_the_median_time_over_the_points(self):
        accuracy = SyntheticAccuracy(nu=[0.9, 1.0, 1.1])
        row = accuracy.rows("moreau", 1e-3)
        for name, values in (
            ("error_contact_time", (1e-5, np.nan, 2e-5)),
            ("error_contact_speed", (np.nan,) * 3),
            ("error_extrema", (3e-6, 7e-5, 1e-6)),
            ("ns_per_period", (10.0, 70.0, 30.0)),
            ("ns_spread", (2.0, 3.0, np.nan)),
            ("doubled", (0.0, np.nan, 0.0)),
        ):
            accuracy.results[name][row] = np.array(values)[:, None]
        found = self.read(accuracy, "moreau")
        place = list(found.setting).index(1e-3)
        self.assertEqual((found.error[place], found.cost[place], found.spread[place]), (7e-5, 30.0, 2.5))
        np.testing.assert_array_equal(found.setting, np.sort(accuracy.setting[accuracy.rows("moreau")[1]])[::-1])
        np.testing.assert_array_equal(found.wrong, [True, False, False, False, False])
        self.assertFalse(found.failed.any())

    def test_lanes_stand_apart_from_the_scalar_loop(self):
        accuracy = SyntheticAccuracy(steady=False)
        accuracy.results["missed"][accuracy.rows("exact", arch="avx512")] = 1.0
        with tempfile.TemporaryDirectory() as folder:
            accuracy.write(Path(folder) / "accuracy.h5")
            output = data.Output(Path(folder) / "accuracy.h5")
        scalar, lanes = (
            plot_accuracy.curve(output, "exact", ("error_extrema",), "ns_per_period", in_lanes=in_lanes)
            for in_lanes in (False, True)
        )
        self.assertEqual((lanes.cost.tolist(), lanes.error.tolist(), lanes.hollow.tolist()), ([120.0], [5e-15], [True]))
        self.assertEqual((len(scalar), scalar.hollow.tolist()), (1, [False]))
        self.assertGreater(scalar.cost[0], 500)

    def test_one_faulty_point_makes_the_row_faulty(self):
        accuracy = SyntheticAccuracy(nu=[0.9, 1.0, 1.1])
        accuracy.results["missed"][accuracy.rows("dopri5")] = 0.0
        accuracy.results["doubled"][accuracy.rows("dopri5")] = 0.0
        accuracy.results["missed"][2, accuracy.rows("dopri5", 1e-5)[1]] = 1.0
        accuracy.status[1, accuracy.rows("dopri5", 1e-7)[1]] = 16
        accuracy.status[1, accuracy.rows("dopri5", 1e-8)[1]] = 1
        found = self.read(accuracy, "dopri5")
        np.testing.assert_allclose(found.setting[found.wrong], [1e-5])
        np.testing.assert_allclose(found.setting[found.failed], [1e-7])
        np.testing.assert_allclose(found.setting[found.hollow], [1e-5, 1e-7])

    def test_small_errors_stand_at_the_floor_and_rows_without_one_are_left_out(self):
        accuracy = SyntheticAccuracy()
        for name in MOTION:
            accuracy.results[name][accuracy.rows("dopri5", 1e-11)] = 1e-25
            accuracy.results[name][accuracy.rows("dopri5", 1e-12)] = 0.0
            accuracy.results[name][accuracy.rows("dopri5", 1e-13)] = np.nan
        found = self.read(accuracy, "dopri5")
        self.assertEqual((len(found), found.floored), (10, True))
        np.testing.assert_array_equal(found.error[-2:], [1e-17, 1e-17])
        self.assertGreater(found.error[-3], 1e-12)
        self.assertFalse(self.read(accuracy, "moreau").floored)
        self.assertEqual(len(self.read(SyntheticAccuracy(steady=False), "steady", "simulated_periods")), 0)

    def test_the_front_leaves_out_hollow_points(self):
        accuracy = SyntheticAccuracy()
        accuracy.results["ns_per_period"][accuracy.rows("moreau", 1e-1)] = 1.0  # cheapest, but it missed impacts
        with tempfile.TemporaryDirectory() as folder:
            accuracy.write(Path(folder) / "accuracy.h5")
            figure = plot_accuracy.accuracy_figure(data.Output(Path(folder) / "accuracy.h5"))
        front = next(line for line in figure.axes[0].get_lines() if line.get_gid() == "pareto-front")
        self.assertEqual(front.get_xdata().tolist(), accuracy.results["ns_per_period"][accuracy.rows("exact")].tolist())

    def test_slopes_of_first_and_second_order(self):
        with tempfile.TemporaryDirectory() as folder:
            SyntheticAccuracy().write(Path(folder) / "accuracy.h5")
            figure = plot_accuracy.accuracy_figure(data.Output(Path(folder) / "accuracy.h5"))
        axes = next(axes for axes in figure.axes if axes.get_gid() == "panel-samples")
        lines = {line.get_gid(): line for line in axes.get_lines()}
        for order in (1, 2):
            (first, last), (high, low) = lines[f"slope-{order}"].get_data()
            self.assertAlmostEqual(np.log(low / high) / np.log(last / first), -order)
            self.assertIn(f"slope \N{MINUS SIGN}{order}", [text.get_text() for text in axes.texts])
        np.testing.assert_allclose(lines["harmonics_exact"].get_ydata(), 2e-16, rtol=0.9)

    def test_settings_in_few_letters(self):
        for value, text in ((1e-3, "1e-3"), (1e-13, "1e-13"), (3e-2, "3e-2"), (2.5e-4, "2.5e-4"), (0.1, "1e-1")):
            self.assertEqual(plot_accuracy.short(value), text.replace("-", "\N{MINUS SIGN}"))

    def test_a_run_is_no_accuracy_run(self):
        accuracy = SyntheticAccuracy(nu=[0.9, 1.0])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "accuracy.h5"
            accuracy.write(path)
            output = data.Output(path)
            self.assertTrue(output.is_accuracy)
            self.assertEqual((output.axes, output.shape), (("nu",), (2,)))
            with h5py.File(path, "a") as file:
                del file["ns_per_period"]
            self.assertFalse(data.Output(path).is_accuracy)


if __name__ == "__main__":
    unittest.main()
