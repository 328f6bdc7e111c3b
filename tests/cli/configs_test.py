"""Every configuration in configs/ runs, gives what it observes, and the INI twin gives the same bytes."""

import os
import re
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

import h5py
import numpy as np

CLATTER = os.environ["CLATTER"]
SI = ("m", "m s-1", "s", "s-1", "Hz", "J", "W", "N", "N s", "kg")  # of the results of a machine, and of its frequency
CONFIGS = Path(os.environ["CLATTER_SOURCE"]) / "configs"
ALWAYS = ("status", "impact_total", "simulated_periods")
OBSERVED = {  # variables of each [observe] key
    "extrema": ("x_min", "x_max", "v_min", "v_max"),
    "harmonics": ("harmonic", "x_amplitude", "x_phase", "v_amplitude", "v_phase", "base_frequency"),
    "impacts": ("impacts_per_period", "v_before", "v_after", "impact_speed", "rest_fraction"),
    "impact_log": ("impact_count", "impact_tau", "impact_stop", "impact_v_before", "impact_v_after", "impact_phase"),
    "trajectory": ("tau", "x", "v"),
    "section": ("section_x", "section_v"),
    "word": ("impact_word", "regime", "symmetric"),
    "period": ("period", "period_ratio"),
    "energy": ("work_in", "loss_damping", "loss_impact", "impulse", "energy_residual", "impact_power"),
    "stability": ("multiplier", "multiplier_re", "multiplier_im", "lyapunov"),
}
PLOTTED = {  # what each of the paper's figures needs, with its axes and number of points
    **dict.fromkeys((2, 3), (("velocity_ratio", "period", "eigenfrequency"), ("start_period",), 400)),
    **dict.fromkeys((4, 5, 6), (("tau", "x", "v", "x_amplitude", "v_amplitude"), (), 1)),
    7: (("period",), ("v0",), 591),
    **dict.fromkeys(range(8, 12), (("v_before", "v_after"), ("xs",), 300)),
    **dict.fromkeys((12, 13), (("x_amplitude", "v_amplitude"), ("v0",), 591)),
    **dict.fromkeys(range(14, 20), (("tau", "x", "v", "impact_tau", "impact_v_before"), (), 1)),
    **dict.fromkeys(range(20, 24), (("x_min", "x_max"), ("nu",), 501)),
}


class Configs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.runs = {}
        for config in sorted([*CONFIGS.glob("*.toml"), *CONFIGS.glob("*.ini")]):
            output = Path(cls.folder.name) / f"{config.name}.h5"
            command = [CLATTER, "run", config, "-o", output, "--progress", "never"]
            cls.runs[config] = (subprocess.run(command, capture_output=True, text=True), output)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_configuration_runs(self):
        for config, (result, output) in self.runs.items():
            with self.subTest(config.name):
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(output.is_file())

    def test_every_output_holds_its_observables_and_nothing_else(self):
        for config, (_, output) in self.runs.items():
            with self.subTest(config.name), h5py.File(output) as file:
                observe = tomllib.loads(file.attrs["config"])["observe"]
                for key, names in OBSERVED.items():
                    for name in names:
                        self.assertEqual(name in file, bool(observe[key]), name)
                self.assertEqual("stop" in file, bool(observe["impacts"] or observe["energy"]))
                for name in ALWAYS:
                    self.assertIn(name, file)

    def test_every_result_has_a_long_name_and_a_unit(self):
        for config, (_, output) in self.runs.items():
            units = ("1", "rad", *(SI if "[machine]" in config.read_text(encoding="utf-8") else ()))
            with h5py.File(output) as file:
                for name, variable in file.items():
                    if str(variable.attrs.get("NAME", b"")).find("netCDF dimension but not") < 0:
                        with self.subTest(f"{config.name}: {name}"):
                            self.assertTrue(variable.attrs["long_name"])
                            self.assertIn(variable.attrs["units"], units)

    def test_no_point_fails(self):
        for config, (_, output) in self.runs.items():
            with self.subTest(config.name), h5py.File(output) as file:
                self.assertLess(np.max(file["status"][()]), 16)

    def test_the_paper_has_all_its_figures(self):
        names = {config.name for config in self.runs}
        self.assertLessEqual({f"fig{number:02d}.toml" for number in range(2, 24)} | {"fig22.ini"}, names)

    def test_each_figure_says_which_it_is_and_holds_its_curves(self):
        for config, (_, output) in self.runs.items():
            number = re.fullmatch(r"fig(\d\d)\.(toml|ini)", config.name)
            if not number:
                continue
            variables, axes, points = PLOTTED[int(number[1])]
            with self.subTest(config.name), h5py.File(output) as file:
                self.assertEqual(file.attrs["source"], f"doi:10.5755/j02.mech.32277, Fig. {int(number[1])}")
                self.assertEqual(tuple(dim[0].name[1:] for dim in file["status"].dims), axes)
                self.assertEqual(file["status"].size, points)
                for name in variables:
                    self.assertTrue(np.isfinite(file[name][()]).any(), name)

    def test_the_ini_twin_gives_the_same_bytes(self):
        _, toml = self.runs[CONFIGS / "fig22.toml"]
        _, ini = self.runs[CONFIGS / "fig22.ini"]
        with h5py.File(toml) as one, h5py.File(ini) as other:
            self.assertEqual(one.attrs["config"], other.attrs["config"])
        self.assertEqual(toml.read_bytes(), ini.read_bytes())

    def test_a_sweep_followed_up_and_down_shows_two_branches(self):
        # between the folds the amplitude depends on where the sweep comes from: hysteresis of the impacting resonance
        ends = {}
        for name in ("follow_up", "follow_down"):
            with h5py.File(self.runs[CONFIGS / f"{name}.toml"][1]) as file:
                order = np.argsort(file["nu"][()])
                ends[name] = file["nu"][()][order], file["x_max"][()][order]
        up, down = ends["follow_up"], ends["follow_down"]
        np.testing.assert_allclose(up[0], down[0], rtol=1e-15)  # linspace from either end differs by an ulp
        apart = np.abs(up[1] - down[1]) > 0.5
        self.assertGreater(apart.sum(), 20)
        self.assertFalse(apart[0] or apart[-1])

    def test_hysteresis_in_one_sweep_is_that_of_the_sweeps_up_and_down(self):
        """Chaos leaves the sweep, by its rounding, on one of two motions that are mirror images of each other."""

        def extrema(file, branch=slice(None)):
            return np.sort([file["x_max"][branch], -file["x_min"][branch]], axis=0)

        with h5py.File(self.runs[CONFIGS / "hysteresis.toml"][1]) as both:
            self.assertEqual(both["direction"][()].tolist(), [1, -1])
            for name, way in (("follow_up", extrema(both, 0)), ("follow_down", extrema(both, 1)[:, ::-1])):
                with h5py.File(self.runs[CONFIGS / f"{name}.toml"][1]) as file:
                    periodic = file["status"][()] == 0
                    self.assertGreater(periodic.sum(), 200)
                    np.testing.assert_allclose(way[:, periodic], extrema(file)[:, periodic], rtol=1e-9)


if __name__ == "__main__":
    unittest.main()
