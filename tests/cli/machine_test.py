"""[machine]: a scene in SI is the scene that is scaled by hand, through every command that reads or writes it."""

import json
import re
import subprocess
import unittest

import numpy as np
import xarray

from command_line import SOURCE
from plot_checks import Svg
from stopped_runs import StoppedRuns

DRIVE = """title = "a drive"
[machine]
mass = "500 g"
stiffness = "12.8 kN/m"
damping = "16 N s/m"
force = "-12.8 N"
R = 0.7
gap = "4 mm"
"""
DRIVE_ALONG = DRIVE.replace('"4 mm"', '"3 mm"\nfrequency = "176 rad/s"\nx0 = "2 mm"\nv0 = 0.48')
P = 160.0  # rad/s, of the spring: (12.8 kN/m / 500 g)^(1/2)
M = 0.5  # kg


class Machine(StoppedRuns):
    def run_config(self, config, output, *words):
        result = self.clatter("run", config, "-o", output, "--quiet", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        return xarray.open_dataset(self.directory / output, engine="h5netcdf")

    def test_the_shipped_drive_is_figure_22_in_millimetres(self):
        drive = self.run_config(SOURCE / "configs" / "drive_si.toml", "d.h5")
        figure = self.run_config(SOURCE / "configs" / "fig22.toml", "f.h5")
        self.assertEqual(drive.attrs["source"], "doi:10.5755/j02.mech.32277, Eqs. 1-3")
        np.testing.assert_array_equal(drive.status, figure.status)
        steady = (figure.status == 0).values
        self.assertGreater(steady.sum(), 400)
        # rounding, amplified by the impacts of the transient at most until it has settled: then by none
        np.testing.assert_allclose(1e3 * drive.x_max.values[steady], figure.x_max.values[steady], rtol=1e-12)
        np.testing.assert_allclose(P * drive.period.values[steady], figure.period.values[steady], rtol=1e-12)
        np.testing.assert_allclose(2 * np.pi * drive.frequency / P, figure.nu, rtol=1e-14)

    def test_units_are_those_that_xarray_and_pint_read(self):
        words = ("sweep.frequency=10 Hz, 20 Hz", "observe.trajectory=3", "observe.section=2", "observe.impact_log=true")
        words += ("observe.energy=true", "observe.attractor=true", "sweep.mass=0.4, 0.5", "observe.extrema=true")
        data = self.run_config(self.write("a.toml", DRIVE.replace('mass = "500 g"\n', "")), "a.h5", *sets(words))
        units = {"x_max": "m", "v_max": "m s-1", "tau": "s", "frequency": "Hz", "mass": "kg", "impact_tau": "s"}
        units |= {"work_in": "J", "impulse": "N s", "impact_power": "W", "section_v": "m s-1", "motion_v": "m s-1"}
        units |= {"motion_x": "m", "impact_v_before": "m s-1", "impact_phase": "rad", "status": "1", "attractor": "1"}
        self.assertEqual({name: data[name].attrs["units"] for name in units}, units)
        header = self.clatter("export", "a.h5", "--only", "v_max").stdout
        self.assertIn("# v_max (m s-1): maximum velocity\n", header)
        self.assertRegex(self.clatter("info", "a.h5").stdout, r"  mass +float64  \[mass = 2\] +mass, kg\n")

    def test_impacts_have_their_phase_and_their_velocity_over_the_ground_in_SI(self):
        # a table of 0.5 mm at 20 Hz throws a ball of R = 0.8 once a period: it leaves and lands at gT/2
        config = self.write(
            "a.toml",
            '[machine]\nmass = "3 g"\nstiffness = 0\nload = "-0.02943 N"\nR = 0.8\nstop_lower = 0\nphase = 0.5\n'
            'frequency = "20 Hz"\nbase_amplitude = "0.5 mm"\nv0 = "0.5 m/s"\n[observe]\nimpact_log = true\n',
        )
        data = self.run_config(config, "a.h5")
        omega, landing = 2 * np.pi * 20, 9.81 / 20 / 2
        self.assertEqual(data.impact_v_before_absolute.attrs["units"], "m s-1")
        np.testing.assert_allclose(data.impact_v_before_absolute, [-landing], rtol=1e-11)
        cosine = (1 - 0.8) / (1 + 0.8) * landing / (0.5e-3 * omega)
        np.testing.assert_allclose(np.cos(data.impact_phase), [cosine], rtol=1e-11)
        np.testing.assert_allclose(data.impact_v_before, -landing - 0.5e-3 * omega * cosine, rtol=1e-11)
        turns = 20 * data.impact_tau + (0.5 - data.impact_phase) / (2 * np.pi)
        np.testing.assert_allclose(turns, np.round(turns), atol=1e-14)

    def test_plan_prints_the_scene_that_is_computed(self):
        config = self.write("a.toml", DRIVE)
        words = sets(("machine.frequency=2*pi*20 rad/s", "machine.x0=1 mm", "machine.load=3 N"))
        text = self.clatter("plan", config, *words).stdout
        self.assertRegex(
            text, r"\n  computed as +h = 0\.1, f = -0\.001, nu = 0\.785398\d+, phase = 0, load = 0\.000234"
        )
        self.assertIn("lengths in m, times in 0.00625 s; point 0\n", text)
        for friction in ((), ("machine.friction=1 N", "machine.friction_static=2 N")):
            self.check_computed_scene(config, words + sets(friction))
        without = self.clatter("plan", self.write("c.toml", "[scene]\nxs = 1\n"), "--json").stdout
        self.assertIsNone(json.loads(without)["groups"][0]["computed_as"])

    def check_computed_scene(self, config, words):
        """The scene that plan prints moves as the machine does."""
        scene = json.loads(self.clatter("plan", config, "--json", *words).stdout)["groups"][0]["computed_as"]
        time = scene.pop("unit_of_time")
        lines = "".join(f"{key} = {float(value)!r}\n" for key, value in scene.items())
        observed = ("observe.extrema=true", "observe.energy=true")
        by_hand = self.run_config(self.write("b.toml", f"[scene]\n{lines}"), "b.h5", *sets(observed))
        machine = self.run_config(config, "a.h5", *words, *sets(observed))
        # the same double arithmetic, then one conversion of a few roundings
        np.testing.assert_allclose(machine.v_max, by_hand.v_max / time, rtol=1e-15 * 4)
        np.testing.assert_allclose(machine.work_in, by_hand.work_in * M / time**2, rtol=1e-15 * 8)

    def test_shards_and_directions_and_their_merge(self):
        words = ("sweep.frequency=linspace(24 Hz, 30 Hz, 13)", "sweep.follow=frequency", "sweep.direction=both")
        words = sets((*words, "sweep.damping=16 N s/m, 20 N s/m", "observe.extrema=true", "observe.impact_log=true"))
        config = self.write("a.toml", DRIVE.replace('damping = "16 N s/m"\n', ""))
        whole = self.run_config(config, "whole.h5", *words)
        self.assertEqual(whole.x_max.dims, ("direction", "frequency", "damping"))
        for part in ("0/2", "1/2"):
            name = f"{part[0]}.h5"
            self.assertEqual(self.clatter("run", config, "-o", name, "--shard", part, "-q", *words).returncode, 0)
        self.assertEqual(self.clatter("merge", "-o", "merged.h5", "0.h5", "1.h5").returncode, 0)
        merged, alone = ((self.directory / name).read_bytes() for name in ("merged.h5", "whole.h5"))
        self.assertEqual(merged, alone)

    def test_a_stopped_run_continues_to_the_same_bytes(self):
        axes = '[sweep]\nfrequency = "linspace(20 Hz, 30 Hz, 60)"\ngap = "linspace(0.2 mm, 4 mm, 40)"\n'
        observed = "[observe]\nextrema = true\nimpacts = true\nimpact_log = true\nharmonics = 3\n"
        text = DRIVE.replace('gap = "4 mm"\n', "") + axes + "[time]\nmax_periods = 300\n" + observed
        self.config = self.directory / self.write("a.toml", text)
        whole = self.undisturbed()
        self.in_steps()
        self.assertEqual(self.output.read_bytes(), whole)

    def test_the_configuration_in_a_file_runs_again(self):
        first = self.write("a.ini", "[machine]\nmass = 250 g ; with the bolt\nstiffness = 1 kN/m\ngap = 2 mm\nv0 = 1\n")
        self.run_config(first, "a.h5", "--set", "observe.extrema=true")
        self.write("b.toml", self.clatter("info", "a.h5", "--config").stdout)
        self.run_config("b.toml", "b.h5")
        self.assertEqual((self.directory / "a.h5").read_bytes(), (self.directory / "b.h5").read_bytes())

    def test_accuracy_is_measured(self):
        config = self.write("a.toml", DRIVE + 'frequency = "25 Hz"\n[time]\nwindow = 4\n')
        measured = self.clatter("accuracy", config, "-q", "--rounds", "1")
        self.assertEqual((measured.returncode, measured.stderr), (0, ""))
        self.assertIn("exact in ", measured.stdout)

    def branch(self, config, *changes):
        result = self.clatter("branch", config, "-o", "b.h5", "--force", "--quiet", "--json", *sets(changes))
        self.assertEqual((result.returncode, result.stderr), (0, ""), changes)
        data = xarray.load_dataset(self.directory / "b.h5", engine="h5netcdf")
        return data, [json.loads(line) for line in result.stdout.splitlines()]

    def test_branches_of_a_machine_are_those_of_the_scene_that_is_scaled_by_hand(self):
        # without doubled periods, of whose two phases either may be followed
        scene, _ = self.branch(SOURCE / "configs" / "branch.toml", "branch.switch=1")
        way = ("branch.along=frequency", "branch.range=136 rad/s, 240 rad/s", "branch.switch=1")
        drive, special = self.branch(self.write("a.toml", DRIVE_ALONG), *way, "observe.energy=true")
        speed, power = 1e3 / P, 1e6 / (M * P**3)
        scales = {"frequency": 2 * np.pi / P, "x": 1e3, "x_min": 1e3, "x_max": 1e3, "impact_power": power}
        scales |= dict.fromkeys(("v", "v_min", "v_max", "impact_speed"), speed)
        self.assertGreater(scene.sizes["special"], 5)
        for name in scene.drop_vars("special_stable").variables:  # multipliers of special points lie on the unit circle
            own = name.replace("nu", "frequency") if name.removeprefix("special_") == "nu" else name
            values, expected = drive[own].values, scene[name].values
            if "multiplier" in name:  # infinite in a graze
                values, expected = values / (1 + np.abs(values)), expected / (1 + np.abs(expected))
            if expected.dtype.kind == "f":
                # both solve the same equations to the settings' tolerance of 1e-12, in other units
                np.testing.assert_allclose(
                    values * scales.get(own.removeprefix("special_"), 1), expected, rtol=1e-11, atol=1e-11, err_msg=name
                )
            else:
                np.testing.assert_array_equal(values, expected, err_msg=name)
        units = {"frequency": "Hz", "x": "m", "v_max": "m s-1", "impact_power": "W", "arclength": "1", "word": "1"}
        self.assertEqual({name: drive[name].attrs["units"] for name in units}, units)
        self.assertNotIn("unit mass", drive.impact_power.attrs["long_name"])
        np.testing.assert_array_equal([point["frequency"] for point in special], drive.special_frequency)
        np.testing.assert_array_equal([point["impact_speed"] for point in special], drive.special_impact_speed)

    def test_motion_along_each_key_repeats_in_the_simulator(self):
        ranges = {"mass": "0.3, 0.9", "stiffness": "6 kN/m, 20 kN/m", "damping": "10, 30", "force": "-20 N, -5 N"}
        ranges |= {"gap": "2 mm, 3.4 mm", "load": "0, 2 N", "R": "0.05, 1", "damping_ratio": "0.05, 0.2"}
        ranges |= {"quality": "2, 10", "base_amplitude": "0, 0.1 mm"}
        self.assert_motion_repeats(DRIVE_ALONG, ranges)

    def test_motion_along_each_key_of_soft_stops_repeats_in_the_simulator(self):
        soft = DRIVE_ALONG.replace("R = 0.7", 'stop_stiffness = "400 N/mm"\nstop_damping = 0.1')
        ranges = {"stop_stiffness": "200 kN/m, 900 kN/m", "stop_damping": "0, 0.4", "mass": "0.4, 0.7"}
        self.assert_motion_repeats(soft, ranges | {"gap": "2 mm, 3.4 mm"})

    def assert_motion_repeats(self, drive, ranges):
        config = self.write("a.toml", drive)
        self.write("run.toml", drive.replace("x0", "#").replace("v0", "#"))
        for key, values in ranges.items():
            ratio = {"damping_ratio": "0.1", "quality": "5"}.get(key)
            scene = () if ratio is None else (f"machine.{key}={ratio}",)
            along, _ = self.branch(config, f"branch.along={key}", f"branch.range={values}", *scene)
            inner = np.diff(along.branch, prepend=-1) + np.diff(along.branch, append=-1) == 0  # ends may be grazes
            stable = along.isel(point=np.flatnonzero((along.stable.values == 1) & inner)[::7])
            self.assertGreater(len(np.unique(stable[key])), 2, key)
            axes = [f"sweep.{name}={', '.join(map(repr, stable[name].values))}" for name in (key, "x", "v")]
            axes = [axis.replace("sweep.x=", "sweep.x0=").replace("sweep.v=", "sweep.v0=") for axis in axes]
            period = 2 * np.pi / 176
            time = ("time.mode=transient", f"time.duration={2 * period!r}", "observe.section=2", "observe.energy=true")
            run = self.run_config("run.toml", "r.h5", *sets((*axes, f"sweep.linked={key}, x0, v0", *time)))
            # Newton's method has a tolerance of 1e-12, and stable motion keeps errors within a few times theirs
            repeated = np.repeat(stable.x.values[:, None], 2, axis=1)
            np.testing.assert_allclose(run.section_x.values, repeated, rtol=1e-10, atol=0, err_msg=key)
            np.testing.assert_allclose(run.impact_power, stable.impact_power, rtol=1e-10, atol=1e-15, err_msg=key)

    def test_curves_of_a_machine(self):
        way = ("branch.along=frequency", "branch.range=136 rad/s, 240 rad/s", "branch.curve=fold", "branch.across=mass")
        curve, _ = self.branch(self.write("a.toml", DRIVE_ALONG), *way, "branch.across_range=300 g, 0.7 kg")
        self.assertEqual(curve.mass.attrs["units"], "kg")
        # at the ends of the range of either
        np.testing.assert_allclose([curve.mass[-1], curve.frequency[0]], [0.7, 240 / (2 * np.pi)], rtol=1e-12)
        np.testing.assert_allclose(curve.multiplier_re.max("multiplier"), 1, atol=1e-6)

    def test_pictures_have_units(self):
        words = ("sweep.frequency=linspace(20 Hz, 30 Hz, 11)", "observe.extrema=true", "observe.energy=true")
        words += ("sweep.load=[0 N, 3 N]",)
        self.run_config(self.write("a.toml", DRIVE), "a.h5", *sets(words)).close()
        plot = ["/usr/bin/python3", SOURCE / "scripts" / "plot.py", "a.h5"]
        subprocess.run(plot, cwd=self.directory, check=True, capture_output=True)
        texts = Svg(self.directory / "a.svg").texts()
        for words in (
            r"displacement $x$ (mm)",
            "velocity $x$\N{PRIME} (m s$^{-1}$)",
            "impulse per forcing period",
            "(N s) upper stop",
            "excitation frequency (Hz)",
            "load = 3 N",
        ):
            self.assertIn(words, texts)
        constants = next(text for text in texts if "$m$ = 0.5 kg" in text)
        for words in ("$k$ = 12800 N m$^{-1}$", "gap = 4 mm", "$F$ = \N{MINUS SIGN}12.8 N"):
            self.assertIn(words, re.split(r",\s+", constants))


def sets(changes):
    return [word for change in changes for word in ("--set", change)]


if __name__ == "__main__":
    unittest.main()
