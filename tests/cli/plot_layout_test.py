"""Pictures of many branches, of families over several keys and of many impact words: all that is named can be told
apart, no text lies on another or beyond the picture, and the panels keep their room.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import random
import re
import textwrap
import unittest

import numpy as np

from plot_checks import SVG, Svg, overlapping_texts, texts_beyond, texts_in, texts_with_boxes
from plot_pictures import PlotFolder, choice
from script_runs import run_script

from clatter.plots import attractors, pictures, style
from clatter.plots.branch_names import NAMED, REST
from clatter.plots.data import Output
from clatter.plots.names import short_word

DRIVE = """title = "The vibration drive of the paper in SI, followed over the excitation frequency"
[machine]
mass = "500 g"
stiffness = "12.8 kN/m"
damping = "16 N s/m"
force = "-12.8 N"
R = {R}
gap = "{gap}"
frequency = "26 Hz"
v0 = 0.9
[observe]
energy = true
[branch]
along = "frequency"
range = [5, 50]
switch = {switch}
"""
SCENE = "[scene]\nf = -1.0\nh = 0.1\n"
FAMILY = 'R = [0.5, 0.7]\nxs = [1, 2, 3]\nnu = "linspace(0.8, 1.3, 61)"\n'
SWEEPS = {
    "family": SCENE + "[sweep]\n" + FAMILY + "[observe]\nextrema = true\nimpacts = true\n",
    "ways": SCENE + "[sweep]\n" + FAMILY + 'follow = "nu"\ndirection = "both"\n[observe]\nextrema = true\n',
    "twelve": SCENE + "xs = 1\n[sweep]\nR = 'linspace(0.1, 0.65, 12)'\nnu = 'linspace(0.8, 1.3, 31)'\n"
    "[observe]\nextrema = true\nsection = 2\n",
    "words": SCENE.replace("0.1", "0.05") + "R = 0.8\nxs = -0.4\n[sweep]\nnu = 'linspace(0.1, 1.2, 401)'\n"
    "[time]\nmax_periods = 300\n[observe]\nsection = 40\nword = true\n",
}
MACHINES = {"many": ("0.5 mm", 0.7), "more": ("0.5 mm", 0.75), "most": ("0.45 mm", 0.72)}


class Notes(unittest.TestCase):
    def test_no_word_of_a_note_stands_alone(self):
        """Lines are as few as they can be, and none is a rest of the others."""
        generator = random.Random(67)
        for _ in range(200):
            words = ["x" * generator.randint(1, 9) for _ in range(generator.randint(1, 40))]
            room = generator.randint(20, 90)
            lines = style.even_lines(" ".join(words), room)
            self.assertEqual(" ".join(lines), " ".join(words))
            self.assertEqual(len(lines), len(textwrap.wrap(" ".join(words), room)))
            self.assertLessEqual(max(map(len, lines)), room)
            if len(lines) == 2:
                self.assertLessEqual(len(lines[0]) - len(lines[1]), 10)
        note = "no points of the sweep: a.h5 has no impact_speed, which a run with observe.impacts = true writes"
        with style.own_style():
            figure = style.new_figure(3.0, 6.5)
            style.caption_below(figure, [note])
        self.assertGreater(figure._supxlabel.get_text().split("\n")[-1].count(" "), 3)


class Layout(PlotFolder):
    def setUp(self):
        self.addCleanup(style.use_style)

    def svg(self, *names, arguments=()):
        files = [self.folder / f"{name}.h5" for name in names]
        result = run_script("plot.py", *files, *arguments, "--format", "svg")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return Svg(result.stdout.strip())

    def figure(self, *names, **options):
        """A picture of these files in memory, as the program draws it."""
        options = choice(files=[self.folder / f"{name}.h5" for name in names], backbone=False, **options)
        style.use_style(options.size)
        ((_, figure),) = pictures.pictures(options)
        return figure

    def assert_clear(self, figure, height):
        """No text on another or cut off, the legend below beside no panel, and panels of at least this height."""
        texts = texts_with_boxes(figure)
        self.assertEqual(overlapping_texts(figure, texts), [])
        self.assertEqual(texts_beyond(figure, texts), [])
        legends = [legend.get_window_extent() for legend in figure.legends]
        for axes in figure.axes:
            self.assertFalse([box for box in legends if box.overlaps(axes.get_tightbbox())])
            self.assertGreaterEqual(axes.get_position().height, height)


def legend_below(svg):
    """The entries of the legend of the whole picture."""
    (figure,) = (group for group in svg.root.iter(f"{SVG}g") if group.get("id") == "figure_1")
    return [text for group in figure if group.get("id", "").startswith("legend_") for text in texts_in(group)]


def colours_of(panel):
    """The colour of each branch in a panel."""
    colours = {}
    for group in panel.children("branch "):
        colours.setdefault(group.get("id"), set()).update(
            colour for path in group.iter(f"{SVG}path") for colour in re.findall(r"stroke: (#\w+)", path.get("style"))
        )
    return colours


def lengths_of(figure):
    """How long each branch is drawn, in parts of the sides of all panels."""
    lengths = {}
    for axes in figure.axes:
        for line in axes.get_lines():
            if (line.get_gid() or "").startswith("branch "):
                places = axes.transAxes.inverted().transform(line.get_path().transformed(axes.transData).vertices)
                steps = np.nan_to_num(np.diff(places, axis=0))
                branch = line.get_gid().removeprefix("branch ")
                lengths[branch] = lengths.get(branch, 0.0) + np.hypot(*steps.T).sum()
    return lengths


class Branches(Layout):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, (gap, R) in MACHINES.items():
            cls.make("branch", name, DRIVE.format(gap=gap, R=R, switch=3))

    def numbers(self, name):
        return Output(self.folder / f"{name}.h5").values("branch")

    def test_ten_have_names_and_the_rest_is_one_entry_below_the_panels(self):
        for name in MACHINES:
            count = len(set(self.numbers(name)))
            self.assertGreaterEqual(count, 19)
            svg = self.svg(name)
            legend = legend_below(svg)
            named = [entry for entry in legend if re.search(r", branch \d+$", entry)]
            self.assertEqual(len(named), NAMED)
            self.assertIn(f"{count - NAMED} other branches", legend)
            self.assertEqual([panel.legend() for panel in svg.panels], [[], []])

    def test_no_colour_stands_for_two_named_branches(self):
        for name in MACHINES:
            svg = self.svg(name)
            named = {entry.split(", ")[-1] for entry in legend_below(svg) if ", branch " in entry}
            for panel in svg.panels:
                colours = colours_of(panel)
                self.assertEqual(len(colours), len(set(self.numbers(name))))
                self.assertTrue(all(len(own) == 1 for own in colours.values()))
                own = [colour for branch in named for colour in colours[branch]]
                self.assertEqual(len(set(own)), NAMED)
                others = {colour for branch in colours.keys() - named for colour in colours[branch]}
                self.assertEqual(others, {REST})

    def test_the_longest_have_names(self):
        for name in MACHINES:
            named = {entry.split(", branch ")[-1] for entry in legend_below(self.svg(name)) if ", branch " in entry}
            lengths = lengths_of(self.figure(name))
            self.assertIn("0", named)
            shortest = min(length for branch, length in lengths.items() if branch in named - {"0"})
            longest = max(length for branch, length in lengths.items() if branch not in named)
            self.assertLess(longest, 1.1 * shortest)  # the sides of the panels are a little longer than the branches

    def test_nothing_lies_on_another_and_panels_keep_their_room(self):
        for name in MACHINES:
            self.assert_clear(self.figure(name), 0.3)
            self.assert_clear(self.figure(name, only=("impact_speed",)), 0.45)
        for size, height in (((7.0, 5.0), 0.2), ((5.0, 4.5), 0.18), ((12.0, 6.0), 0.2)):
            self.assert_clear(self.figure("most", size=size), height)

    def test_few_branches_have_their_legend_above(self):
        self.make("branch", "few", DRIVE.format(gap="4 mm", R=0.7, switch=0))
        svg = self.svg("few")
        self.assertEqual(legend_below(svg), [])
        self.assertTrue(svg.panels[0].legend())

    def test_files_of_one_regime_are_named_by_what_differs(self):
        legend = legend_below(self.svg("many", "more")) or self.svg("many", "more").panels[0].legend()
        names = [entry.replace("$", "") for entry in legend if "1/1, LU" in entry]
        self.assertEqual(names, ["R = 0.7: 1/1, LU", "R = 0.75: 1/1, LU"])

    def test_many_files_have_ten_names(self):
        files = [f"file{number}" for number in range(12)]
        for number, name in enumerate(files):
            self.make("branch", name, DRIVE.format(gap="4 mm", R=0.5 + 0.01 * number, switch=0))
        svg = self.svg(*files)
        legend = legend_below(svg)
        self.assertEqual(sum(": 1/1, LU" in entry for entry in legend), NAMED)
        self.assertIn("2 other files", legend)
        self.assert_clear(self.figure(*files), 0.3)


class Families(Layout):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, text in SWEEPS.items():
            cls.make("run", name, text)

    def test_a_family_over_two_keys_has_one_legend_below_all_panels(self):
        svg = self.svg("family")
        entries = [entry.replace("$", "") for entry in legend_below(svg)]
        self.assertEqual(entries[:6], [f"R = {R}, x_s = {xs}" for R in (0.5, 0.7) for xs in (1, 2, 3)])
        self.assertGreater(len(svg.panels), 4)
        self.assertFalse([panel.legend() for panel in svg.panels if panel.legend()])

    def test_a_legend_below_names_each_curve_once(self):
        for name in ("family", "ways"):
            entries = legend_below(self.svg(name))
            self.assertEqual(len(entries), len(set(entries)))
        self.assertEqual(sum(entry.startswith(("up, ", "down, ")) for entry in entries), 12)

    def test_nothing_lies_on_another_and_panels_keep_their_room(self):
        for name, height in (("family", 0.15), ("ways", 0.3)):
            figure = self.figure(name)
            self.assert_clear(figure, height)
            self.assertGreaterEqual(min(axes.get_position().width for axes in figure.axes), 0.25)
        self.assert_clear(self.figure("family", only=("x_max", "x_min"), size=(5.0, 3.5)), 0.3)

    def test_twelve_curves_have_twelve_colours(self):
        for only in ("v_max", "section_x"):
            figure = self.figure("twelve", only=(only,), over="R")
            legend = figure.legends[0] if figure.legends else figure.axes[0].get_legend()
            entries = [text.get_text() for text in legend.get_texts()]
            self.assertEqual(sum("$R$" in entry for entry in entries), 12)
            colours = [line.get_color() for line in figure.axes[0].get_lines() if line.get_label() in entries[:12]]
            self.assertEqual(len(set(colours)), 12)

    def test_names_longer_than_the_picture_are_cut(self):
        names = [f"{place}{'x' * 200}" for place in "ab"]
        for name in names:
            (self.folder / f"{name}.h5").symlink_to(self.folder / "words.h5")
        for size in (None, (5.0, 3.5)):
            figure = self.figure(*names, only=("section_x",), size=size)
            self.assert_clear(figure, 0.3)
            (legend,) = figure.legends
            self.assertEqual([text.get_text()[0] for text in legend.get_texts()], ["a", "b"])

    def test_words_stand_between_the_lines_of_their_changes(self):
        for size in (None, (7.0, 4.0), (4.0, 3.0)):
            figure = self.figure("words", only=("section_x",), size=size)
            axes = figure.axes[0]
            words = [text for text in axes.texts if re.fullmatch(r"[LU*∗$^{}\d]+…?", text.get_text())]
            self.assertGreaterEqual(len(words), 1)
            self.assertEqual(overlapping_texts(figure), [])
            output = Output(self.folder / "words.h5")
            nu, names = output.values("nu"), output.values("impact_word")
            changes = np.flatnonzero(names[1:] != names[:-1])
            places = axes.transData.transform([((nu[i] + nu[i + 1]) / 2, 0) for i in changes])[:, 0]
            self.assertGreater(len(places), 20)
            for text in words:
                box = text.get_window_extent()
                self.assertFalse(np.any((places > box.x0) & (places < box.x1)), text.get_text())
                middle = axes.transData.inverted().transform((box.x0 + box.width / 2, 0))[0]
                self.assertEqual(text.get_text(), short_word(names[np.argmin(np.abs(nu - middle))]))


class Words(unittest.TestCase):
    def test_long_words_have_powers(self):
        for word, shown in (
            ("", ""),
            ("LU", "LU"),
            ("L*U*", "L*U*"),
            ("LLLLLLUUUUUU", "LLLLLLUUUUUU"),
            ("L" * 23 + "U" * 22, "L$^{23}$U$^{22}$"),
            ("LLLUUULLLLLLL*", "L$^{3}$U$^{3}$L$^{6}$L*"),
            ("LU" * 12, "LULULULULULU…"),
        ):
            self.assertEqual(short_word(word), shown)

    def test_words_without_mathematics_stay_so(self):
        self.assertEqual(short_word("$x$"), r"\$x\$")


class Motions(unittest.TestCase):
    def test_those_with_a_name_have_a_colour_each(self):
        chosen = [0, 3, 24, 27, 51, 72]
        colours = attractors.distinct_colours(chosen)
        self.assertEqual(len(set(colours.values())), len(chosen))
        self.assertEqual((colours[0], colours[3]), (style.colour_of(0), style.colour_of(3)))


if __name__ == "__main__":
    unittest.main()
