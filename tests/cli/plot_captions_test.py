"""A caption is true of everything in its picture: keys in which files differ are named at their curves.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import random
import unittest

from plot_checks import crowded_texts
from plot_pictures import PlotFolder, choice
from script_runs import run_script

from clatter.plots import pictures
from clatter.plots.data import Output
from clatter.plots.names import equation

SCENE = {"h": 0.1, "f": -1.0, "R": 0.7, "xs": -3.0}
START = {"nu": 1.1, "x0": 2.0, "v0": 3.0}
BRANCH = "[observe]\nstability = true\n[branch]\nalong = 'nu'\nrange = [1.0, 1.2]\nlargest_step = 0.1\n"
SWEEP = "[sweep]\nnu = [1.05, 1.1, 1.15]\n[observe]\nextrema = true\nimpacts = true\n"
ZONES = (
    "[sweep]\nnu = [1.05, 1.1, 1.15]\nx0 = 'sobol(-1, 1, 8)'\nv0 = 'sobol(-1, 1, 8)'\nlinked = 'x0, v0'\n"
    "[observe]\nattractor = true\n"
)
MAP = "[sweep]\nnu = [0.4, 0.7, 1.0]\nxs = [0.5, 1.2, 2.0]\n[observe]\nword = true\n"
FOLDS = (
    "[branch]\nalong = 'nu'\nrange = [0.3, 1.3]\nacross = 'xs'\nacross_range = [0.05, 2.05]\n"
    "curve = 'fold'\nswitch = 1\n"
)
OTHERS = {"h": (0.05, 0.12), "f": (-1.1, -0.9), "R": (0.6, 0.75), "xs": (-3.1, -2.9)}  # beside those of SCENE


def text_of(values, rest, title=""):
    return f"title = '{title}'\n[scene]\n" + "".join(f"{key} = {value}\n" for key, value in values.items()) + rest


class Captions(PlotFolder):
    def branch(self, name, title="", **own):
        self.make("branch", name, text_of({**SCENE, **START, **own}, BRANCH, title), codes=(0, 1))

    def sweep(self, name, rest=SWEEP, title="", **own):
        self.make("run", name, text_of({**SCENE, **own}, rest, title))

    def figure(self, *names, **options):
        files = [str(self.folder / f"{name}.h5") for name in names]
        figure = pictures.shared_figure(choice(files=files, backbone=False, **options))
        self.assertEqual(crowded_texts(figure), ([], []))
        return figure

    def told(self, figure):
        """The caption above the picture, and what its curves and notes say, without mathematics."""
        legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]
        entries = [text.get_text() for legend in legends for text in legend.get_texts()]
        notes = figure._supxlabel.get_text() if figure._supxlabel else ""
        return tuple(text.replace("$", "") for text in (figure._suptitle.get_text(), "\n".join([*entries, notes])))

    def assert_true_of_all(self, names, keys, **options):
        """The caption has no value of these keys, and each file's own is beside its curves."""
        caption, curves = self.told(self.figure(*names, **options))
        for name in names:
            output = Output(self.folder / f"{name}.h5")
            for key in keys:
                own = equation(output, key, output.scene[key]).replace("$", "")
                self.assertNotIn(own, caption)
                self.assertIn(own, curves)
        for key in SCENE.keys() - set(keys):
            self.assertIn(equation(output, key, output.scene[key]).replace("$", ""), caption)

    def test_a_sweep_behind_a_branch_of_another_restitution(self):
        self.branch("b", R=0.6)
        self.sweep("s", R=0.8)
        self.assert_true_of_all(["s", "b"], ["R"])

    def test_zones_behind_a_branch_of_another_restitution(self):
        self.branch("b", R=0.6)
        self.sweep("z", ZONES, R=0.8)
        self.assert_true_of_all(["z", "b"], ["R"])

    def test_branches_that_begin_with_other_words(self):
        self.branch("b", R=0.6)
        self.branch("o", R=0.8, nu=1.2, x0=0.0, v0=0.0)
        first, other = (Output(self.folder / f"{name}.h5").values("word")[0] for name in "bo")
        self.assertNotEqual(first, other)
        self.assert_true_of_all(["b", "o"], ["R"])

    def test_a_map_behind_curves_of_another_damping(self):
        self.make("run", "m", text_of({"h": 0.1, "f": -1.0, "R": 0.7}, MAP))
        for h in (0.05, 0.1):
            self.make("branch", f"c{h}", text_of({**SCENE, "nu": 1.1, "xs": 1.6, "h": h}, FOLDS), codes=(0, 1))
        caption, curves = self.told(self.figure("m", "c0.05"))
        self.assertNotIn("h = ", caption)
        self.assertIn("h = 0.05: folds", curves)
        self.assertIn("map: h = 0.1", curves)
        figure = self.figure("m", "c0.05", "c0.1")
        colours = {line.get_label(): line.get_color() for line in figure.axes[0].lines if "folds" in line.get_label()}
        self.assertEqual(len(set(colours.values())), 2)
        self.assertEqual(len(colours), 2)

    def test_two_of_three_files_alike(self):
        for name, R in (("up", 0.6), ("down", 0.6), ("other", 0.8)):
            self.sweep(name, R=R)
        self.assert_true_of_all(["up", "down", "other"], ["R"])
        self.assertIn("up: R = 0.6", self.told(self.figure("up", "down", "other"))[1])

    def test_a_key_that_only_one_file_has(self):
        self.sweep("s")
        self.make("run", "one", text_of({"h": 0.1, "f": -1.0, "R": 0.7, "stop_lower": -3.0}, SWEEP))
        caption, curves = self.told(self.figure("one", "s"))
        self.assertNotIn("x_s", caption)
        self.assertIn("x_s = \N{MINUS SIGN}3", curves)

    def test_keys_that_are_linked_to_the_axis_of_a_family(self):
        rest = "[sweep]\nxs = [-3, -4]\nR = [0.7, 0.5]\nlinked = 'xs, R'\nnu = [1.05, 1.1, 1.15]\n"
        scene = {key: SCENE[key] for key in "hf"}
        self.make("run", "linked", text_of(scene, rest + "[observe]\nextrema = true\n"))
        curves = self.told(self.figure("linked", only=("v_max",)))[1]
        for xs, R in ((3, 0.7), (4, 0.5)):
            self.assertRegex(curves, rf"x_s = \N{{MINUS SIGN}}{xs}, R = {R}|R = {R}, x_s = \N{{MINUS SIGN}}{xs}")

    def test_a_key_that_varies_in_one_file_alone(self):
        self.sweep("s")
        scene = {key: SCENE[key] for key in ("h", "f", "xs")}
        rest = SWEEP.replace("[observe]", "R = [0.5, 0.6, 0.7]\nlinked = 'nu, R'\n[observe]")
        self.make("run", "linked", text_of(scene, rest))
        caption, curves = self.told(self.figure("s", "linked", only=("v_max",)))
        self.assertNotIn("R = ", caption)
        for words in ("R = 0.7", r"R along \nu"):
            self.assertIn(words, curves)

    def test_a_title_that_names_what_differs_is_left_out(self):
        self.branch("b", title="Branches at R = 0.6", R=0.6)
        self.sweep("s", title="Sweep at R = 0.8", R=0.8)
        self.assertNotIn("R = ", self.told(self.figure("s", "b"))[0])
        self.sweep("same", title="Sweep", R=0.6)
        self.assertIn("Branches at", self.told(self.figure("same", "b"))[0])

    def test_where_branches_begin_tells_no_curve_apart(self):
        self.branch("b")
        self.branch("o", nu=1.12)
        self.branch("p", x0=2.1)
        for other in "op":
            self.assertNotIn("(0)", self.told(self.figure("b", other))[1])

    def test_where_a_branch_begins_is_no_property_of_it(self):
        self.branch("b", x0=2.1, v0=0.4)
        self.branch("o", x0=2.1, v0=0.4, R=0.65)
        for names in (["b"], ["b", "o"]):
            self.assertNotIn("(0)", self.told(self.figure(*names))[0])

    def test_a_scene_and_a_machine_share_no_picture(self):
        self.branch("b")
        machine = "[machine]\nmass = 1\nstiffness = 1\ndamping = 0.2\nforce = 1\ngap = 3\nfrequency = 0.17\n"
        along = "[branch]\nalong = 'R'\nrange = [0.6, 0.8]\n"
        self.make("branch", "machine", machine + "R = 0.7\n" + along, codes=(0, 1))
        self.make("branch", "scene", text_of({**SCENE, **START}, along), codes=(0, 1))
        files = [self.folder / f"{name}.h5" for name in ("machine", "scene")]
        result = run_script("plot.py", *files, "-o", self.folder / "drawn")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("[scene] and [machine] in one picture", result.stderr)

    def test_keys_drawn_at_random(self):
        generator = random.Random(67)
        for _ in range(6):
            keys = generator.sample(sorted(OTHERS), generator.randint(1, 2))
            names = generator.choice((["s", "b"], ["b", "o"], ["s", "t"], ["b", "o", "s"]))
            for place, name in enumerate(names):
                own = {key: (SCENE[key], *OTHERS[key])[place] for key in keys}
                (self.branch if name in "bo" else self.sweep)(name, **own)
            with self.subTest(names=names, keys=keys):
                self.assert_true_of_all(names, keys)


if __name__ == "__main__":
    unittest.main()
