"""Maps say what they show: scales, colours of whole numbers, reasons for white, numbers of few digits, and no text on
another.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import subprocess
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from command_line import CLATTER
from plot_checks import Svg, overlapping_texts

from clatter.plots import pictures, style
from clatter.plots.data import APERIODIC, FIRST_FAILURE, GRAZING, Output
from clatter.plots.maps import Quantity, white_notes
from clatter.plots.scales import DIGITS, integer_levels, tidy_ticks

FORCED = "[scene]\nf = -1.0\nh = 0.1\nR = 0.8\n"
SCENES = {
    "chatter": FORCED + '[sweep]\nnu = "linspace(0.1, 1, 25)"\nxs = "linspace(0.02, 1.5, 21)"\n'
    "[time]\nmax_periods = 100\n[observe]\nimpacts = true\nword = true\n",
    "multipliers": FORCED + '[sweep]\nnu = "linspace(0.5, 1.5, 16)"\nxs = "linspace(0.1, 2, 12)"\n'
    "[time]\nmax_periods = 100\n[observe]\nstability = true\nenergy = true\nharmonics = 3\nextrema = true\n"
    "period = true\nimpacts = true\n",
    "one_stop": FORCED + '[sweep]\nstop_lower = "linspace(-1.5, -0.1, 12)"\nnu = "linspace(0.5, 3, 17)"\n'
    "[time]\nmax_periods = 100\n[observe]\nimpacts = true\nextrema = true\n",
    "narrow": "title = 'Small results over axes of many digits, under a title that has no room in one line'\n"
    "[scene]\nf = 1e-9\nxs = -1e-8\n[sweep]\nh = 'linspace(0.1, 0.1000005, 9)'\n"
    "nu = 'linspace(1.0000001, 1.0000009, 7)'\n"
    "[observe]\nextrema = true\nharmonics = 2\nenergy = true\n",
    "logarithmic": FORCED.replace("h = 0.1\n", "xs = -2\n") + '[sweep]\nh = "logspace(1e-3, 1, 9)"\n'
    'nu = "logspace(0.1, 10, 8)"\n[time]\nmax_periods = 50\n[observe]\nextrema = true\nharmonics = 2\n',
    "failed": FORCED + '[sweep]\nnu = "linspace(0.1, 1.5, 9)"\nxs = "linspace(0.05, 2, 7)"\n'
    "[time]\nmax_impacts = 200\nmax_periods = 30\n[observe]\nextrema = true\n",
    "square": FORCED + '[sweep]\nnu = "linspace(0.8, 1.2, 60)"\nxs = "linspace(1, 5, 50)"\n'
    "[time]\nmax_periods = 60\n[observe]\nextrema = true\n",
}
NO_CHOICE = SimpleNamespace(
    only=(), along="", over="", at=(), scatter="", size=None, xlim=None, ylim=None, log="", title=None
)


class Maps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = Path(kept.name)
        for name, text in SCENES.items():
            (cls.folder / f"{name}.toml").write_text(text)
            command = [CLATTER, "run", cls.folder / f"{name}.toml", "-o", cls.folder / f"{name}.h5", "-q"]
            code = subprocess.run(command, timeout=300).returncode
            assert code == (1 if name == "failed" else 0), (name, code)
        style.use_style()
        cls.figures = {name: pictures.single_figure(Output(cls.folder / f"{name}.h5"), NO_CHOICE) for name in SCENES}

    def output(self, name):
        return Output(self.folder / f"{name}.h5")

    def figure(self, name):
        return self.figures[name]

    def caption(self, name):
        return self.figure(name)._supxlabel.get_text().replace("\n", " ")

    def test_no_text_lies_on_another(self):
        for name in SCENES:
            with self.subTest(name):
                self.assertEqual(overlapping_texts(self.figure(name)), [])

    def test_every_text_lies_in_the_picture(self):
        for name in SCENES:
            figure = self.figure(name)
            figure.draw_without_rendering()
            for text in [*figure.texts, *(axes.title for axes in figure.axes)]:
                box = text.get_window_extent()
                with self.subTest(name, text=text.get_text()):
                    self.assertGreaterEqual(box.x0, 0)
                    self.assertLessEqual(box.x1, figure.bbox.x1)

    def test_numbers_beside_ticks_have_few_digits(self):
        for name in SCENES:
            for axes in self.figure(name).axes:
                for axis in (axes.xaxis, axes.yaxis):
                    numbers = [label.get_text() for label in axis.get_ticklabels()]
                    digits = [sum(map(str.isdigit, number.split("{10^{")[0])) for number in numbers]
                    self.assertLessEqual(max(digits, default=0), DIGITS, (name, numbers))

    def test_a_map_is_one_image_of_a_few_kilobytes(self):
        for name in SCENES:
            (path, png) = (self.folder / f"{name}.{kind}" for kind in ("svg", "png"))
            for file in (path, png):
                file.write_bytes(pictures.in_format(self.figure(name), file.suffix[1:]))
            panels = [panel for panel in Svg(path).panels if "<colorbar>" not in panel.texts()]
            for panel in panels:
                self.assertLess(len(panel.images()), 2, name)
            maps = sum(bool(axes.images) for axes in self.figure(name).axes)
            self.assertGreaterEqual(sum(len(panel.images()) for panel in panels), maps, name)
            self.assertLess(max(path.stat().st_size, png.stat().st_size), 50_000 + 35_000 * len(panels), name)

    def test_every_aperiodic_cell_has_ink(self):
        output, figure = self.output("square"), self.figure("square")
        loose = output.values("status") == APERIODIC
        self.assertGreater(np.count_nonzero(loose), 20)
        self.assertGreater(np.count_nonzero(~loose), 20)
        pixels, *_ = figure.axes[0].images[1].make_image(figure.canvas.get_renderer())
        ink = pixels[..., 3]
        rows, columns = (np.linspace(0, size, count + 1) for size, count in zip(ink.shape, loose.shape[::-1]))
        for (i, j), is_loose in np.ndenumerate(loose):
            top, bottom = np.ceil(rows[j : j + 2] - 0.5).astype(int)
            left, right = np.ceil(columns[i : i + 2] - 0.5).astype(int)
            self.assertEqual(ink[top:bottom, left:right].max() > 100, is_loose, (i, j))

    def test_whole_numbers_have_a_colour_each_and_chatter_is_clipped(self):
        figure, output = self.figure("chatter"), self.output("chatter")
        names = [axes.get_title() for axes in figure.axes]
        bar = figure.axes[names.index("impacts per period, lower stop") + 1]
        numbers = [label.get_text() for label in bar.get_yticklabels()]
        self.assertEqual(numbers, [str(number) for number in range(len(numbers))])
        greatest = np.nanmax(output.values("impacts_per_period"))
        self.assertGreater(greatest, len(numbers))
        caption = self.caption("chatter")
        self.assertRegex(caption, f"colours of impacts per period end at {len(numbers) - 1}, values at {greatest:g}")

    def test_a_stop_that_is_not_there_is_not_listed(self):
        texts = [axes.get_title() for axes in self.figure("one_stop").axes] + [self.caption("one_stop")]
        self.assertTrue(any("lower stop" in text for text in texts))
        for text in texts:
            self.assertNotIn("upper stop", text)
            self.assertNotIn("both stops", text)

    def test_the_caption_explains_white_black_and_hatched_cells(self):
        self.assertRegex(self.caption("one_stop"), "white: no impact")
        self.assertIn("black: failed", self.caption("failed"))
        self.assertIn("hatched: no period", self.caption("square"))
        self.assertNotIn("white", self.caption("square"))

    def test_reasons_for_white(self):
        status = np.array([[0, APERIODIC], [GRAZING, FIRST_FAILURE]])
        everywhere = np.full((2, 2), np.nan)
        rest = np.array([[True, False], [False, False]])
        for name, values, at_rest, reasons in (
            ("v_before", everywhere, ~rest & rest, ["a stop is just touched", "no impact"]),
            ("lyapunov", everywhere, rest, ["no period", "a stop is just touched", "rest in every period"]),
            ("period", np.where(status == APERIODIC, np.nan, 1.0), ~rest & rest, ["no period"]),
            ("lyapunov", np.ones((2, 2)), rest, []),
            ("lyapunov", np.where(status == FIRST_FAILURE, np.nan, 1.0), rest, []),
        ):
            with self.subTest(name, reasons=reasons):
                notes = white_notes(Quantity(name, "", values, at_rest), status)
                self.assertEqual(notes, [f"white: {reason}" for reason in reasons])

    def test_logarithmic_axes_have_their_points_in_equal_cells(self):
        figure, output = self.figure("logarithmic"), self.output("logarithmic")
        axes = figure.axes[0]
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("log", "log"))
        self.assertEqual(axes.images[0].get_array().shape[:2], output.shape[::-1])
        self.assertAlmostEqual(axes.get_xlim()[0], 1e-3 / 1e3 ** (1 / 16))

    def test_phases_that_go_far_have_cyclic_colours_and_none_for_negligible_amplitudes(self):
        figure, output = self.figure("multipliers"), self.output("multipliers")
        names = [axes.get_title().replace("\n", " ") for axes in figure.axes]
        (place,) = (i for i, name in enumerate(names) if name.startswith("phase of displacement") and "k = 2" in name)
        self.assertEqual(tuple(figure.axes[place + 1].get_ylim()), (-np.pi, np.pi))
        amplitude = np.abs(output.values("x_amplitude"))
        negligible = amplitude[..., 2] <= 1e-12 * np.nanmax(amplitude)
        self.assertTrue(negligible.any())
        opacity = figure.axes[place].images[0].get_array()[..., 3].T
        np.testing.assert_array_equal(opacity == 0, negligible)


class Scales(unittest.TestCase):
    def setUp(self):
        style.use_style()

    def test_levels(self):
        for values, wanted in (
            ([0, 1, 2, 3], (0, 3, False, None)),
            ([1, 1, 1], (1, 1, False, None)),
            ([0, 1 / 3, 1, 2], (0, 2, True, None)),
            ([0.0] * 500 + [1.0] * 500 + [300.0], (0, 1, False, 300.0)),
            (list(range(12)) * 30 + [50], (0, 11, False, 50.0)),
            ([np.nan, 2, 3], (2, 3, False, None)),
        ):
            with self.subTest(values[:6]):
                levels = integer_levels(np.array(values, float), "impacts_per_period")
                found = (levels.first, levels.last, levels.has_gaps, levels.greatest if levels.is_clipped else None)
                self.assertEqual(found, wanted)
        for values, name in (([0.5, 1.5], "x_max"), ([np.nan], "impact_total"), (range(0, 100000, 7), "impact_total")):
            self.assertIsNone(integer_levels(np.array(values, float), name))

    def test_each_level_has_its_colour(self):
        levels = integer_levels(np.array([0, 1 / 3, 1, 2]), "impacts_per_period")
        np.testing.assert_allclose(levels.boundaries, [-0.01, 0.01, 0.99, 1.01, 1.99, 2.01])
        np.testing.assert_allclose(integer_levels(np.arange(3.0)).boundaries, [-0.5, 0.5, 1.5, 2.5])

    def test_ticks(self):
        for low, high, words in (
            (0.5, 1.5, ""),
            (-5.0, 5.0, ""),
            (0.0, 3e-4, ""),
            (0.0, 1e-20, "in $10^{-20}$"),
            (0.0, 123456.0, "in $10^{5}$"),
            (1.0, 1.0 + 5e-7, "\N{MINUS SIGN} 1, in $10^{-7}$"),
            (-1.0 - 3e-8, -1.0, "+ 1, in $10^{-8}$"),
            (1234567.0, 1234568.0, "\N{MINUS SIGN} 1.23456$\\cdot 10^{6}$"),
            (4.99997e-9, 4.99999e-9, "\N{MINUS SIGN} 4.9999$\\cdot 10^{-9}$, in $10^{-14}$"),
        ):
            with self.subTest(low=low, high=high):
                figure = style.new_figure(2, 3)
                axes = figure.subplots()
                axes.set(xlim=(low, high), ylim=(low, high), xlabel="along")
                self.assertEqual(tidy_ticks(axes), {"x": words, "y": words})
                figure.draw_without_rendering()
                self.assertEqual(axes.get_xlabel(), f"along {words}".strip())
                self.assertEqual(axes.get_ylabel(), "")
                ticks = axes.get_xticks()
                numbers = [label.get_text() for label in axes.get_xticklabels()]
                shown = [number for tick, number in zip(ticks, numbers) if low <= tick <= high]
                self.assertEqual(len(set(shown)), len(shown))
                self.assertGreater(len(shown), 1)
                self.assertNotIn("\N{MINUS SIGN}0", shown)
                self.assertLessEqual(max(sum(map(str.isdigit, number)) for number in shown), DIGITS)
                self.assertEqual(overlapping_texts(figure), [])


if __name__ == "__main__":
    unittest.main()
