"""A picture of a given size has room for its texts and panels, or is refused with the smallest size that has.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import random
import re
import unittest
from unittest import mock

from command_line import SOURCE
from plot_checks import crowded_texts
from plot_pictures import Pictures, choice
from script_runs import run_script

from clatter.plots import pictures, style
from clatter.plots.choice import ChoiceProblem

LOWEST = 0.6  # inches, of a panel that can be read
SHAPES = ((4.72, 3.54), (7.0, 5.0), (3.0, 8.0), (9.0, 9.0))


class Sizes(Pictures):
    def setUp(self):
        self.addCleanup(style.use_style)

    def sized(self, name, size, **options):
        """The picture of a file in this size; None if it has no room there."""
        style.use_style(size)
        try:
            with mock.patch("clatter.plots.room.smallest", return_value=None):  # which takes long to find
                return pictures.single_figure(self.output(name), choice(size=size, **options))
        except ChoiceProblem as problem:
            self.assertIn("fewer panels (--only) need less", str(problem))
        return None

    def assert_room(self, figure, size):
        self.assertEqual(tuple(figure.get_size_inches()), size)
        self.assertEqual(crowded_texts(figure), ([], []))
        panels = [axes for axes in figure.axes if axes.axison and axes.get_label() != "<colorbar>"]
        self.assertGreaterEqual(min(axes.get_position().height for axes in panels) * size[1], LOWEST)
        frames = [axes.get_window_extent() for axes in panels]
        legends = [*figure.legends, *(axes.get_legend() for axes in panels if axes.get_legend())]
        for box in (legend.get_window_extent() for legend in legends):
            self.assertFalse([frame for frame in frames if frame.shrunk(0.99, 0.99).overlaps(box)])

    def test_what_is_drawn_has_room(self):
        drawn = {}
        for name in ("family", "hysteresis", "chaos", "zones", "map", "machine"):
            for size in SHAPES:
                with self.subTest(name, size=size):
                    figure = self.sized(name, size)
                    drawn[name, size] = figure is not None
                    if figure:
                        self.assert_room(figure, size)
        self.assertTrue(all(drawn[name, (9.0, 9.0)] for name in ("family", "hysteresis", "chaos", "zones")))
        self.assertFalse(any(drawn[name, (4.72, 3.54)] for name in ("family", "map", "machine")))

    def test_sizes_drawn_at_random(self):
        generator = random.Random(67)
        for _ in range(12):
            name = generator.choice(("family", "hysteresis", "linear", "basins", "starts", "soft"))
            size = tuple(round(generator.uniform(1.0, 12.0), 1) for _ in range(2))
            with self.subTest(name, size=size):
                if figure := self.sized(name, size):
                    self.assert_room(figure, size)

    def test_the_size_that_is_offered_fits_and_a_smaller_one_does_not(self):
        file = self.folder / "family.h5"
        result = run_script("plot.py", file, "--size", "12x9cm", "-o", self.folder / "small")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertEqual(list(self.folder.glob("small/*")), [])
        self.assertRegex(result.stderr, r"^plot.py: --size 4.72x3.54 \(12x9cm\): its panels are too small to be read; ")
        width, height = map(
            float, re.search(r"--size ([\d.]+)x([\d.]+) \([\d.]+x[\d.]+cm\); fewer", result.stderr).groups()
        )
        self.assertAlmostEqual(width / height, 4 / 3, delta=0.05)
        self.assert_room(self.sized("family", (width, height)), (width, height))
        self.assertIsNone(self.sized("family", (0.9 * width, 0.9 * height)))

    def test_the_size_of_the_guide_fits(self):
        guide = (SOURCE / "scripts" / "README.md").read_text(encoding="utf-8")
        (line,) = [line for line in guide.splitlines() if "--size" in line and line.startswith("scripts/plot.py")]
        self.assertIn("--size 12x9cm", line)
        options = {"only": tuple(re.search(r"--only (\S+)", line)[1].split(",")), "xlim": (0.9, 1.1)}
        figure = self.sized("linear", (12 / 2.54, 9 / 2.54), title="Resonance", **options)
        self.assert_room(figure, (12 / 2.54, 9 / 2.54))

    def test_python_names_its_own_argument(self):
        import clatter

        with self.assertRaisesRegex(clatter.ClatterError, r"^size 3x1.5 .*smallest of this shape that fits is size "):
            clatter.plot(self.folder / "hysteresis.h5", size=(3, 1.5))


if __name__ == "__main__":
    unittest.main()
