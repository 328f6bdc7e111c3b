"""Dry friction through every command that reads or writes it, and in pictures.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import unittest

import h5py
import netCDF4
import numpy as np
import xarray

from command_line import CommandLine
from plot_pictures import choice

from clatter.plots import pictures, style
from clatter.plots.attractors import name_of
from clatter.plots.data import Output

SLIDE = """[machine]
mass = "2 kg"
stiffness = "8 N/mm"
damping_ratio = 0.02
force = "20 N"
gap = "6 mm"
R = 0.6
[sweep]
friction = [0, "6 N", "12 N", "18 N"]
frequency = "linspace(2 Hz, 16 Hz, 29)"
[observe]
extrema = true
impacts = true
word = true
word_sticks = true
energy = true
"""
STARTS = """[scene]
f = 0.5
nu = 0.9
R = 0.8
xs = 2
friction = 0.35
friction_static = 0.9
[sweep]
x0 = "linspace(-2, 2, 13)"
v0 = "linspace(-2, 2, 13)"
[observe]
attractor = true
impacts = true
extrema = true
"""


class Sliding(CommandLine):
    def run_text(self, text, output="a.h5", *words):
        result = self.clatter("run", self.write("a.toml", text), "-o", output, "-q", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return self.directory / output


# The force 1 is held from x = -0.05 to 0.05, and lets the mass slip ever less beyond.
CREEP = """[scene]
f = 1
nu = 1
friction = 1.05
stop_upper = inf
[sweep]
x0 = "linspace(-1, 1, 21)"
h = [0.05, 0.1]
[observe]
extrema = true
period = true
attractor = true
"""


class Friction(Sliding):
    def test_a_mass_that_creeps_has_a_status_of_its_own(self):
        with h5py.File(self.run_text(CREEP)) as file:
            status, x = file["status"][()], file["x_max"][()]
            names = dict(zip(file["status"].attrs["flag_values"], file["status"].attrs["flag_meanings"].split()))
            self.assertEqual(names[5], "creeping")
            self.assertEqual([np.count_nonzero(status[:, 0] == kind) for kind in (0, 5)], [5, 16])
            self.assertEqual(np.count_nonzero((status == 0) | (status == 5)), status.size)
            np.testing.assert_allclose(abs(x[status == 5]), 0.05, rtol=1e-14)
            self.assertEqual(sorted(file["motion_mirror"][()].tolist()), [-1, 0, 2])
            self.assertTrue(all(word == b"(S)" for word in file["motion_word"][()]))
        result = self.clatter("run", "a.toml", "-o", "b.h5", "-v")
        self.assertRegex(result.stdout + result.stderr, r"settled: standstill \d+, creep \d+\b")

    def test_a_sweep_over_it_is_the_same_in_shards(self):
        whole = self.run_text(SLIDE)
        shards = [self.run_text(SLIDE, f"{k}.h5", "--shard", f"{k}/3").name for k in range(3)]
        self.assertEqual(self.clatter("merge", "-o", "merged.h5", *shards).returncode, 0)
        self.assertEqual((self.directory / "merged.h5").read_bytes(), whole.read_bytes())

    def test_is_an_axis_with_its_unit_for_every_reader(self):
        path = self.run_text(SLIDE)
        with h5py.File(path) as file:
            self.assertEqual(file["friction"].attrs["units"], "N")
            sticks = file["stick_fraction"][:]
        for engine in ("h5netcdf", "netcdf4"):
            with xarray.open_dataset(path, engine=engine) as data:
                self.assertEqual(data.stick_fraction.dims, ("friction", "frequency"))
                np.testing.assert_array_equal(data.stick_fraction.sel(friction=12.0), sticks[2])
        with netCDF4.Dataset(path) as data:
            self.assertEqual(data["loss_friction"].units, "J")

    def test_the_largest_share_of_time_stuck_and_a_point_by_its_friction(self):
        path = self.run_text(SLIDE)
        with h5py.File(path) as file:
            sticks, place = file["stick_fraction"][:], file["x_max"][:]
        largest = self.clatter("info", path, "--max", "stick_fraction").stdout.splitlines()[1]
        self.assertEqual(np.unravel_index(np.argmax(sticks), sticks.shape), (3, 0))
        self.assertEqual(largest.strip(), f"{sticks[3, 0]:.6g} at friction = 18 N, frequency = 2 Hz, periodic, SS")
        where = ("--where", "friction=12 N", "--where", "frequency=4 Hz")
        row = self.clatter("export", path, "--only", "x_max,stick_fraction", *where).stdout.splitlines()[-1]
        self.assertEqual([float(cell) for cell in row.split(",")], [12, 4, place[2, 4], sticks[2, 4]])

    def test_every_motion_without_a_stick_has_none_in_its_word(self):
        with h5py.File(self.run_text(SLIDE)) as file:
            periodic = file["status"][:] == 0
            words, sticks = file["impact_word"].asstr()[:][periodic], file["stick_fraction"][:][periodic]
        self.assertTrue((sticks > 0).any() and (sticks == 0).any())
        self.assertEqual(["S" in word for word in words], (sticks > 0).tolist())

    def test_the_losses_of_periodic_motion_add_up_to_the_work(self):
        with h5py.File(self.run_text(SLIDE)) as file:
            periodic = file["status"][:] == 0
            work = file["work_in"][:][periodic]
            losses = [file[name][:][periodic] for name in ("loss_damping", "loss_friction")]
            impacts = file["loss_impact"][:][periodic].sum(axis=1)
            drag = file["friction"][:][:, None] * np.ones(periodic.shape)
            way = 2 * (file["x_max"][:] - file["x_min"][:])  # in a period without impacts, at least
            clear = (file["impacts_per_period"][:].sum(axis=2) == 0)[periodic]
        np.testing.assert_allclose(sum(losses) + impacts, work, atol=1e-14 * work.max())
        least = (drag * way)[periodic]
        self.assertTrue((losses[1][clear] >= least[clear] * (1 - 1e-12)).all())
        self.assertGreater((losses[1][clear] <= least[clear] * (1 + 1e-12)).mean(), 0.9)  # most don't turn on the way

    def test_plan_tells_a_mass_that_never_moves(self):
        config = self.write("a.toml", SLIDE)
        words = ("--set", "machine.friction=18 N", "--set", "machine.friction_static=21 N")
        result = self.clatter("plan", config, "--json", *words)
        for group in json.loads(result.stdout)["groups"]:
            effects = {effect["effect"]: effect for effect in group["effects"]}
            self.assertIn(": the mass never moves, since", effects["friction"]["why"])
            self.assertEqual(group["periods"], [group["points"]] * 2)
            self.assertEqual(group["computed_as"]["friction_static"], 21 / 8000)
        with h5py.File(self.run_text(SLIDE.replace('0, "6 N", "12 N", "18 N"', '"20.1 N"'))) as file:
            self.assertTrue((file["stick_fraction"][:] == 1).all() and (file["x_max"][:] == 0).all())

    def test_wrong_levels_are_refused_with_their_place(self):
        config = self.write("a.toml", SLIDE)
        refused = {
            "machine.friction=-2 N": "friction = -2 is out of range; expected >= 0, in N",
            "sweep.friction=6 mm, 9 mm": "the unit 'mm' doesn't fit; expected a force in N",
            "machine.friction_static=10 N": "friction = 18 and friction_static = 10; expected friction <=",
            "machine.stop_amplitude=1 mm": "friction conflicts with 'stop_amplitude'",
        }
        for change, words in refused.items():
            self.assert_refused(2, words, "run", config, "-o", "a.h5", "--set", change)

    def test_help_explains_its_results(self):
        for name, observable in (("stick_fraction", "impacts"), ("loss_friction", "energy")):
            result = self.clatter("help", name)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout, rf"asked for by +observe\.{observable}\n")


class Pictures(Sliding):
    @classmethod
    def setUpClass(cls):
        style.use_style()

    def test_pictures_name_the_band_in_which_a_mass_sticks_and_draw_no_place_of_it(self):
        output = Output(self.run_text(STARTS))
        words = output.values("motion_word").tolist()
        self.assertEqual(sorted(words), ["(S)", "-"])
        self.assertEqual(name_of(output, words.index("(S)")), "held by friction")
        figure = pictures.single_figure(output, choice(only=("attractor",)))
        points = [line.get_gid() for line in figure.axes[0].lines if str(line.get_gid()).startswith("motion ")]
        self.assertEqual(points, [f"motion {words.index('-')}"])

    def test_pictures_name_motion_that_creeps(self):
        output = Output(self.run_text(CREEP))
        creeps = "creeps to where friction holds it"
        names = {name_of(output, motion) for motion in range(3)}
        self.assertEqual(names, {creeps, "held by friction", f"{creeps}, mirrored"})
        many = CREEP.replace("h = [0.05, 0.1]", 'h = "linspace(0.05, 0.1, 9)"').replace("attractor = true", "")
        figure = pictures.single_figure(Output(self.run_text(many)), choice(only=("period_ratio",)))
        shown = [text.get_text() for axes in figure.axes for text in axes.get_yticklabels()]
        self.assertIn("creeping", shown)

    def test_pictures_say_how_large_it_is(self):
        point = SLIDE.replace('friction = [0, "6 N", "12 N", "18 N"]\n', "").replace(
            "[sweep]", 'friction = "6 N"\n[sweep]'
        )
        figure = pictures.single_figure(Output(self.run_text(point)), choice(only=("work_in", "loss_friction")))
        self.assertIn("friction = 6\N{NO-BREAK SPACE}N", figure._suptitle.get_text())
        entries = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        self.assertEqual(entries[:2], ["work", "friction"])
        self.assertEqual(figure.axes[0].get_ylabel(), "energy per forcing period (J)")


if __name__ == "__main__":
    unittest.main()
