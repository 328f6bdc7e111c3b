"""plot.py takes values with units, which the program reads, and draws a curve for each of several values of an axis.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

from command_line import CLATTER
from script_runs import run_script

import clatter
from clatter.plots.choice import members_of
from clatter.plots.data import Output
from clatter.plots.options import choices

MACHINE = """[machine]
mass = "500 g"
stiffness = "12.8 kN/m"
damping = "16 N s/m"
force = "-12.8 N"
[sweep]
gap = "linspace(2 mm, 5 mm, 8)"
frequency = "linspace(10 Hz, 40 Hz, 16)"
[observe]
extrema = true
"""
CUBE = """[scene]
f = -1.0
h = 0.1
[sweep]
R = [0.3, 0.8]
nu = "linspace(0.8, 1.2, 9)"
xs = "linspace(2, 4, 9)"
[observe]
extrema = true
"""


class Units(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = Path(kept.name)
        for name, text in (("machine", MACHINE), ("cube", CUBE)):
            (cls.folder / f"{name}.toml").write_text(text)
            words = [CLATTER, "run", cls.folder / f"{name}.toml", "-o", cls.folder / f"{name}.h5", "-q"]
            subprocess.run(words, check=True)

    def path(self, name):
        return self.folder / f"{name}.h5"

    def members(self, name, *words):
        chosen = choices([self.path(name)], words)
        return members_of(Output(self.path(name)), chosen.along, chosen.over, chosen.at)

    def values(self, name, *variables):
        with h5py.File(self.path(name)) as file:
            return [file[variable][()] for variable in variables]

    def refuse(self, name, *words, environment=None):
        result = run_script("plot.py", self.path(name), *words, "-o", self.folder / "no", environment=environment)
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        return result.stderr

    def test_a_value_with_a_unit_is_the_same_as_in_the_unit_of_the_file(self):
        gap, x_max = self.values("machine", "gap", "x_max")
        place = int(np.argmin(np.abs(gap - 0.0031)))
        for value in ("3.1 mm", "0.31 cm", "0.0031"):
            (member,) = self.members("machine", "--at", f"gap={value}")
            self.assertEqual(member.output.axes, ("frequency",))
            np.testing.assert_array_equal(member.output.values("x_max"), x_max[place])

    def test_several_values_of_an_axis_are_a_curve_each(self):
        gap, x_max = self.values("machine", "gap", "x_max")
        places = [int(np.argmin(np.abs(gap - wanted))) for wanted in (0.002, 0.0041)]
        for words in (("--at", "gap=2 mm,4.1 mm"), ("--at", "gap=2 mm", "--at", "gap=0.0041")):
            members = self.members("machine", *words)
            self.assertEqual(len(members), 2)
            for member, place in zip(members, places):
                self.assertEqual(member.output.axes, ("frequency",))
                self.assertEqual(member.output.scene["gap"], gap[place])
                np.testing.assert_array_equal(member.output.values("x_max"), x_max[place])

    def test_of_three_axes_the_others_are_held_or_drawn_along(self):
        xs, x_max = self.values("cube", "xs", "x_max")
        members = self.members("cube", "--at", "xs=2,4", "--at", "R=0.8")
        self.assertEqual([member.output.axes for member in members], [("nu",), ("nu",)])
        for member, place in zip(members, (0, len(xs) - 1)):
            np.testing.assert_array_equal(member.output.values("x_max"), x_max[1, :, place])
        along_xs = self.members("cube", "--at", "nu=0.8,1,1.2", "--along", "xs")
        self.assertEqual([member.output.axes for member in along_xs], [("xs",)] * 3)
        self.assertEqual(len(self.members("cube", "--at", "nu=1,1", "--at", "R=0.3")), 1)

    def test_a_picture_of_the_family_has_their_names(self):
        figure = clatter.plot(self.path("machine"), only="x_max", at={"gap": ["2 mm", 0.005]}, xlim=("15 Hz", "30 Hz"))
        axes = figure.axes[0]
        self.assertEqual(axes.get_xlim(), (15.0, 30.0))
        legend = " ".join(text.get_text() for text in axes.get_legend().get_texts())
        self.assertIn("= 2\N{NO-BREAK SPACE}mm", legend)
        self.assertIn("= 5\N{NO-BREAK SPACE}mm", legend)

    def test_limits_with_units(self):
        plain = clatter.plot(self.path("machine"), only="x_max", at={"gap": 0.004}, ylim=(0.0, 0.003)).axes[0]
        given = clatter.plot(self.path("machine"), only="x_max", at={"gap": 0.004}, ylim=("0", "3 mm")).axes[0]
        self.assertEqual(plain.get_ylim(), given.get_ylim())
        turned = clatter.plot(self.path("machine"), only="x_max", at={"gap": 0.004}, xlim=("40*pi rad/s", "30 Hz"))
        self.assertEqual(turned.axes[0].get_xlim(), (20.0, 30.0))
        maps = clatter.plot(
            self.path("machine"), only=["x_max", "x_min"], xlim=("2 mm", "3 mm"), ylim=("10 Hz", "20 Hz")
        )
        self.assertEqual(
            [axes.get_xlim() for axes in maps.axes if axes.get_label() != "<colorbar>"], [(0.002, 0.003)] * 2
        )

    def test_wrong_units(self):
        for name, words, message in (
            ("machine", ["--at", "gap=3 Hz"], "--at gap: the unit 'Hz' doesn't fit: it is in m"),
            ("machine", ["--at", "gap=3 foo"], "'3 foo': unknown unit 'foo'"),
            ("cube", ["--at", "xs=3 mm"], "--at xs: the unit 'mm' doesn't fit: it has none; give numbers alone"),
            ("machine", ["--along", "frequency", "--at", "gap=0.004", "--xlim", "1 mm,2 mm"], "--xlim: the unit 'mm'"),
            ("cube", ["--at", "R=0.3", "--xlim", "1 Hz,2 Hz"], "doesn't fit the axis 'excitation frequency'"),
            ("machine", ["--xlim", "10 Hz,0.01"], "give both limits units of one kind, or none"),
            ("machine", ["--xlim", "10 Hz,1 mm"], "give both limits units of one kind, or none"),
            ("machine", ["--at", "gap=2 mm,5 mm", "--along", "gap"], "--along gap: --at chooses values of it"),
        ):
            with self.subTest(words):
                self.assertIn(message, self.refuse(name, *words))

    def test_without_the_program_numbers_alone_are_understood(self):
        nowhere = {**os.environ, "CLATTER": str(self.folder / "nothing")}
        message = self.refuse("machine", "--at", "gap=3 mm", environment=nowhere)
        self.assertIn("units can't be understood without the program clatter; write numbers alone", message)
        with mock.patch.dict(os.environ, CLATTER=str(self.folder / "nothing")):
            (member,) = self.members("machine", "--at", "gap=0.003")
            self.assertEqual(member.output.axes, ("frequency",))

    def test_a_file_without_units_takes_numbers_alone(self):
        shutil.copy(self.path("machine"), self.path("old"))
        with h5py.File(self.path("old"), "r+") as file:
            for name in file:
                file[name].attrs.pop("units", None)
        self.assertIn("it has none; give numbers alone", self.refuse("old", "--at", "gap=3 mm"))


if __name__ == "__main__":
    unittest.main()
