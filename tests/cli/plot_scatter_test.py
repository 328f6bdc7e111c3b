"""Dots over any key that is swept, along an axis of its own or linked to another, coloured by impact word.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import h5py
import numpy as np

from plot_checks import crowded_texts
from plot_pictures import PlotFolder, choice
from script_runs import run_script

import clatter
from clatter.plots import pictures
from clatter.plots.choice import members_of
from clatter.plots.data import Output, lacks_period
from clatter.plots.names import NO_CONTACT

MACHINE = "[machine]\nmass = '500 g'\nstiffness = '12.8 kN/m'\ndamping = '16 N s/m'\nforce = '12.8 N'\n"
OBSERVED = "[time]\nmax_periods = 300\n[observe]\nimpacts = true\nextrema = true\nword = true\nenergy = true\n"
CONFIGURATIONS = {
    "sample": MACHINE + "frequency = '25 Hz'\n[sweep]\ngap = 'sobol(0.3 mm, 5 mm, 256)'\n"
    "R = 'sobol(0.6, 0.8, 256)'\nlinked = 'gap, R'\n" + OBSERVED,
    "grid": "[scene]\nf = -1\nh = 0.1\n[sweep]\nR = [0.5, 0.7]\nnu = 'linspace(0.8, 1.2, 9)'\n"
    "xs = [0.5, 1, 2]\nlinked = ''\n" + OBSERVED,
    "linked": "[scene]\nf = -1\nh = 0.1\n[sweep]\nR = [0.5, 0.6, 0.7]\nnu = 'linspace(0.8, 1.2, 9)'\n"
    "xs = [2, 1, 0.5]\nlinked = 'R, xs'\n" + OBSERVED,
    "starts": "[scene]\nf = -1\nh = 0.1\nR = 0.7\nxs = 3\nnu = 1.2\n[sweep]\nx0 = 'sobol(-3, 3, 64)'\n"
    "v0 = 'sobol(-6, 6, 64)'\nlinked = 'x0, v0'\n[observe]\nattractor = true\nextrema = true\n",
}


class Scatter(PlotFolder):
    configurations = CONFIGURATIONS

    def output(self, name):
        return Output(self.folder / f"{name}.h5")

    def figure(self, name, **options):
        figure = pictures.single_figure(self.output(name), choice(**options))
        self.assertEqual(crowded_texts(figure), ([], []))
        return figure

    def dots(self, axes):
        """The dots of a panel, as sorted pairs, and their colours: {(x, y): colour}."""
        found = {}
        for line in axes.get_lines():
            if line.get_marker() == "o" and line.get_linestyle() == "None" and len(line.get_xdata()):
                found |= dict.fromkeys(zip(line.get_xdata(), line.get_ydata()), line.get_markerfacecolor())
        return found

    def assert_dots(self, axes, keys, values):
        known = np.isfinite(values)
        pairs = set(zip(keys[known].ravel().tolist(), values[known].ravel().tolist()))
        self.assertEqual(set(self.dots(axes)), pairs)

    def test_a_key_that_is_linked_to_an_axis_is_drawn_along(self):
        output = self.output("sample")
        for key, option in (("R", "along"), ("R", "scatter"), ("gap", "along"), ("gap", "scatter")):
            figure = self.figure("sample", only=("impact_speed",), **{option: key})
            label = "restitution" if key == "R" else "gap (mm)"
            for axes, part in zip(figure.axes, range(2)):
                self.assertTrue(axes.get_xlabel().startswith(label), axes.get_xlabel())
                self.assert_dots(axes, output.values(key), output.values("impact_speed")[:, part])

    def test_each_word_has_its_colour(self):
        output = self.output("sample")
        words, loose = output.values("impact_word"), lacks_period(output.values("status"))
        axes = self.figure("sample", only=("v_max",), scatter="R").axes[0]
        colours = self.dots(axes)
        of_words = {}
        for R, v_max, word, is_loose in zip(output.values("R"), output.values("v_max"), words, loose):
            kind = "aperiodic" if is_loose else "no impacts" if word in NO_CONTACT else word
            of_words.setdefault(kind, set()).add(colours[R, v_max])
        self.assertGreaterEqual(len(of_words), 4)
        self.assertTrue(all(len(own) == 1 for own in of_words.values()), of_words)
        self.assertEqual(len(set.union(*of_words.values())), len(of_words))
        entries = {text.get_text() for text in axes.get_legend().get_texts()}
        self.assertEqual(entries, set(of_words))

    def test_symmetry_is_so_or_not(self):
        """Over a key and in colours: two names, and no numbers between them."""
        self.assertGreater(len(np.unique(self.output("sample").values("symmetric"))), 1)
        figure = self.figure("sample", scatter="gap")
        (axes,) = (axes for axes in figure.axes if axes.get_ylabel() == "symmetric motion")
        self.assertEqual([text.get_text() for text in axes.get_yticklabels()], ["no", "yes"])
        self.make("run", "told", CONFIGURATIONS["starts"].replace("attractor = true", "word = true"))
        with h5py.File(self.folder / "told.h5", "r+") as file:
            file["symmetric"][::2] = 0
        figure = self.figure("told", only=("symmetric",))
        (bar,) = (axes for axes in figure.axes if axes.get_label() == "<colorbar>")
        self.assertEqual([text.get_text() for text in bar.get_yticklabels()], ["no", "yes"])

    def test_axes_that_cross_are_scattered_too(self):
        output = self.output("grid")
        for key in ("R", "nu", "xs"):
            figure = self.figure("grid", only=("v_max", "impact_power"), scatter=key)
            for axes, name in zip(figure.axes, ("v_max", "impact_power")):
                self.assert_dots(axes, output.parameter(key), output.values(name))
            self.assertNotIn("R = " if key != "R" else "x_s = ", figure._suptitle.get_text())

    def test_at_holds_an_axis_first(self):
        output = self.output("grid")
        axes = self.figure("grid", only=("v_max",), scatter="nu", at=[("R", 0.7)]).axes[0]
        part = output.at("R", 1)
        self.assert_dots(axes, part.parameter("nu"), part.values("v_max"))

    def test_a_linked_key_holds_its_axis_and_leads_a_map(self):
        output = self.output("linked")
        (held,) = members_of(output, at=[("xs", 1.0)])
        self.assertEqual(held.output.axes, ("nu",))
        np.testing.assert_array_equal(held.output.values("v_max"), output.values("v_max")[1])
        self.assertEqual((held.output.scene["R"], held.output.scene["xs"]), (0.6, 1.0))
        family = members_of(output, along="nu", over="xs")
        self.assertTrue(family[0].title.replace("$", "").startswith("x_s = 2"), family[0].title)
        (along,) = members_of(output, along="xs", at=[("nu", 1.0)])
        self.assertEqual((along.output.axes, along.output.values("xs").tolist()), (("xs",), [2, 1, 0.5]))

    def test_impacts_and_totals_follow_their_points(self):
        output = self.output("grid")
        (member,) = members_of(output, scatter="xs")
        self.assertEqual(member.output.values("work_in").shape, (output.values("status").size,))
        (held,) = members_of(output, at=[("R", 0.5), ("xs", 0.5)])
        np.testing.assert_array_equal(
            member.output.values("work_in").reshape(2, 9, 3)[0, :, 0], held.output.values("work_in")
        )

    def test_starts_are_dots_over_one_of_them_if_it_is_named(self):
        output = self.output("starts")
        axes = self.figure("starts", only=("v_max",), along="v0").axes[0]
        self.assertTrue(axes.get_xlabel().startswith("initial velocity"))
        self.assertIn(set(output.values("v0")), [set(line.get_xdata()) for line in axes.get_lines()])

    def test_no_stop_that_varies_is_a_line(self):
        axes = self.figure("sample", only=("x_max",), scatter="R").axes[0]
        self.assertFalse([line for line in axes.get_lines() if line.get_linestyle() != "None"])

    def test_the_command_and_python_choose_it(self):
        result = run_script("plot.py", self.folder / "sample.h5", "--scatter", "R", "--format", "svg")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        figure = clatter.plot(self.folder / "sample.h5", scatter="R", only="v_max")
        self.assertTrue(figure.axes[0].get_xlabel().startswith("restitution"))

    def test_wrong_choices(self):
        for words, message in (
            (["--scatter", "h"], "--scatter: 'h' isn't swept in this file; there are "),
            (["--scatter", "R", "--over", "nu"], "--scatter R conflicts with --over"),
            (["--scatter", "R", "--along", "nu"], "--scatter R conflicts with --along"),
        ):
            result = run_script("plot.py", self.folder / "grid.h5", *words, "-o", self.folder / "none")
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main()
