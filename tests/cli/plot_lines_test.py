"""A line joins points of one motion: it ends where the impact word or the period changes, or the mirror image swaps;
of derivatives also where symmetry is lost.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import random
import unittest

import numpy as np

from plot_pictures import PlotFolder, choice

from clatter.plots import pictures
from clatter.plots.data import Output, lacks_period

DRIVE = "[machine]\nmass = '500 g'\nstiffness = '12.8 kN/m'\ndamping = '16 N s/m'\nforce = '-12.8 N'\nR = 0.7\n"
ALL = (
    "[time]\nmax_periods = 1000\n[observe]\nextrema = true\nimpacts = true\nperiod = true\nword = true\nenergy = true\n"
)
LINKED = "[sweep]\nnu = {}\nphase = {}\nlinked = 'nu, phase'\n"
SIDES = [1.29 + 0.01 * i for i in range(8)]  # nu of motion LU that isn't symmetric


class Lines(PlotFolder):
    def output(self, text):
        self.make("run", "a", text)
        return Output(self.folder / "a.h5")

    def joined(self, output, only):
        """The pairs of neighbours that a line of any panel of these results joins, by their places on the axis."""
        along, found = output.values(output.axes[0]), set()
        for axes in pictures.single_figure(output, choice(only=only)).axes:
            for line in axes.get_lines():
                x, y = np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)
                if line.get_linestyle() == "None" or len(x) < 3:
                    continue
                drawn = np.isfinite(y[1:]) & np.isfinite(y[:-1])
                found |= {
                    (int(np.argmin(np.abs(along - x[i]))), int(np.argmin(np.abs(along - x[i + 1]))))
                    for i in np.flatnonzero(drawn)
                }
        return found

    def assert_one_motion(self, output, only, least):
        words, ratios = output.values("impact_word"), output.values("period_ratio")
        joined = self.joined(output, only)
        for one, other in joined:
            self.assertEqual((words[one], ratios[one]), (words[other], ratios[other]))
        same = (words[1:] == words[:-1]) & (ratios[1:] == ratios[:-1])
        self.assertGreaterEqual(len(joined), least)
        self.assertTrue(joined <= {(i, i + 1) for i in np.flatnonzero(same)})

    def test_words_of_few_points(self):
        sweep = "gap = '0.5 mm'\n[sweep]\nfrequency = 'linspace(8 Hz, 20 Hz, 49)'\n"
        output = self.output(DRIVE + sweep + ALL)
        words = output.values("impact_word")
        self.assertIn("LLUU", words)
        self.assert_one_motion(output, ("impact_speed", "v_max", "impact_power"), 25)

    def test_counts_of_impacts_stand_for_words(self):
        sweep = "gap = '0.5 mm'\n[sweep]\nfrequency = 'linspace(8 Hz, 20 Hz, 49)'\n"
        with_words = self.output(DRIVE + sweep + ALL)
        expected = self.joined(with_words, ("v_max",))
        without = self.output(DRIVE + sweep + ALL.replace("word = true\n", ""))
        self.assertNotIn("impact_word", without)
        self.assertEqual(self.joined(without, ("v_max",)), expected)

    def test_the_mirror_image(self):
        scene = "[scene]\nh = 0.05\nf = -1\nR = 0.7\nxs = 0.5\n"
        sides = [
            0,
            0,
            np.pi,
            np.pi,
            0,
            np.pi,
            0,
            0,
        ]  # of the force at the start: half a period later is the mirror image
        same = {(i, i + 1) for i in range(7) if sides[i] == sides[i + 1]}
        for observe in ("extrema = true\n", "impacts = true\nword = true\n"):
            for phases, expected in ((sides, same), ([0] * 8, {(i, i + 1) for i in range(7)})):
                text = scene + LINKED.format(SIDES, phases) + "[time]\nmax_periods = 1000\n[observe]\n" + observe
                output = self.output(text)
                if "v_max" in output:
                    turned = np.abs(output.values("v_max")) < np.abs(output.values("v_min"))
                    self.assertEqual(len(set(turned)), len(set(phases)))
                only = ("v_max",) if "v_max" in output else ("impact_speed",)
                self.assertEqual(self.joined(output, only), expected)

    def test_no_line_ends_at_a_mirror_where_there_is_none(self):
        sweep = "[sweep]\nload = 'linspace(-0.05, 0.05, 21)'\n"  # from more on one side to more on the other
        scene = "[scene]\nh = 0.05\nf = -1\nR = 0.7\nxs = 0.5\nnu = 2\n"
        output = self.output(scene + sweep + "[observe]\nextrema = true\n")
        sides = output.values("v_max") + output.values("v_min")
        self.assertLess(sides.min() * sides.max(), 0)
        self.assertEqual(self.joined(output, ("v_max",)), {(i, i + 1) for i in range(20)})

    def test_derivatives_jump_where_symmetry_is_lost(self):
        machine = "[machine]\nmass = 0.2\nstiffness = 2000\ndamping_ratio = 0.03\nforce = 8\nR = 0.6\ngap = 0.0015\n"
        sweep = "[sweep]\nfrequency = 'linspace(24.5, 50, 40)'\n"
        derived = "stability = true\nsensitivity = 'gap, stiffness'\n"
        results = ("d_impact_power_d_gap", "d_impact_speed_d_gap", "d_impact_speed_d_stiffness", "multiplier_re")
        output = self.output(machine + sweep + ALL + derived)
        symmetric, words = output.values("symmetric"), output.values("impact_word")
        lost = {(i, i + 1) for i in np.flatnonzero((symmetric[1:] != symmetric[:-1]) & (words[1:] == words[:-1]))}
        self.assertTrue(lost)
        for name in results:
            found = self.joined(output, (name,))
            self.assertEqual(found & lost, set(), name)
            self.assertGreater(len(found), 30)
        self.assertEqual(self.joined(output, ("impact_power",)) & lost, lost)  # it is continuous
        by_derivatives = self.joined(output, ("d_impact_power_d_gap",))
        without = self.output(machine + sweep + "[observe]\nextrema = true\nimpacts = true\nenergy = true\n" + derived)
        self.assertNotIn("symmetric", without)
        self.assertEqual(self.joined(without, ("d_impact_power_d_gap",)), by_derivatives)

    def test_transients_are_one_motion(self):
        scene = "[scene]\nh = 0.05\nf = 0\nR = 0.7\nxs = 0.5\n[sweep]\nv0 = 'linspace(0.1, 3, 15)'\n"
        output = self.output(
            scene + "[time]\nmode = 'transient'\nduration = 9\n[observe]\nextrema = true\nimpacts = true\n"
        )
        self.assertGreater(len(np.unique(output.values("impacts_per_period")[:, 0])), 2)
        self.assertEqual(self.joined(output, ("v_max",)), {(i, i + 1) for i in range(14)})

    def test_scenes_drawn_at_random(self):
        generator = random.Random(67)
        for _ in range(8):
            scene = {"h": 0.1, "f": -1, "R": generator.uniform(0.4, 0.9), "xs": generator.uniform(0.1, 3)}
            count, begin = generator.randint(20, 120), generator.uniform(0.2, 1.2)
            sweep = f"[sweep]\nnu = 'linspace({begin}, {begin + 0.6}, {count})'\n"
            text = "[scene]\n" + "".join(f"{key} = {value}\n" for key, value in scene.items()) + sweep + ALL
            with self.subTest(scene=scene, count=count):
                output = self.output(text)
                self.assertTrue((~lacks_period(output.values("status"))).any())
                self.assert_one_motion(output, ("x_max", "v_max", "impact_speed", "impact_power"), 0)


if __name__ == "__main__":
    unittest.main()
