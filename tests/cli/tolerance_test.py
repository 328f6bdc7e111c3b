"""Tolerance studies: any axis may be a sample of a range, `clatter info` tells quantiles over it, and pictures draw
points."""

import json
import unittest

import h5py
import numpy as np

from command_line import CommandLine

SHARES = ("0.05", "0.25", "0.5", "0.75", "0.95")
STUDY = """title = "a study"
[machine]
mass = "0.2 kg"
stiffness = "2 N/mm"
damping_ratio = 0.03
force = "8 N"
frequency = "26 Hz"
[sweep]
R = "sobol(0.5, 0.7, 64)"
gap = "sobol(1.4 mm, 1.6 mm, 64)"
linked = "R, gap"
[observe]
extrema = true
impacts = true
period = true
"""


class Tolerances(CommandLine):
    def study(self, text=STUDY):
        self.assertIn(self.clatter("run", self.write("a.toml", text), "-q", "--force").returncode, (0, 1))
        return h5py.File(self.directory / "a.h5")

    def told(self, *words):
        result = self.clatter("info", "a.h5", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_a_sample_fills_its_box_evenly_and_in_its_order(self):
        """Sobol's sequence of two dimensions has one point in each elementary interval, but for its first one, 0."""
        with self.study() as file:
            u, v = (file["R"][()] - 0.5) / 0.2, (file["gap"][()] - 1.4e-3) / 2e-4
            self.assertEqual(file.attrs["sampled_axes"], "R gap")
        for cells in ((8, 8), (64, 1), (1, 64), (16, 4)):
            places = {(int(x * cells[0]), int(y * cells[1])) for x, y in zip(u + 1e-12, v + 1e-12)}
            self.assertGreaterEqual(len(places), 63, cells)

    def test_a_point_of_a_sample_is_that_of_a_run_alone(self):
        with self.study() as file:
            for i in (0, 17, 63):
                change = ("sweep.R", f"[{float(file['R'][i])!r}]"), ("sweep.gap", f"[{float(file['gap'][i])!r}]")
                words = [word for key, value in change for word in ("--set", f"{key}={value}")]
                self.assertEqual(self.clatter("run", "a.toml", "-q", "-o", f"{i}.h5", *words).returncode, 0)
                with h5py.File(self.directory / f"{i}.h5") as alone:
                    for name in ("x_max", "impact_speed", "status"):
                        np.testing.assert_array_equal(alone[name][0], file[name][i])

    def test_quantiles_are_those_of_numpy(self):
        with self.study() as file:
            told = json.loads(self.told("--json"))["quantiles"]
            self.assertEqual(set(told) & {"R", "gap", "status", "settling_estimate"}, set())
            columns = {name: file[name][()] for name in ("x_min", "x_max", "period_ratio")}
            columns |= {f"impact_speed[{stop}]": file["impact_speed"][:, i] for i, stop in enumerate((-1, 1))}
        for name, values in columns.items():
            known = values[~np.isnan(values)]
            self.assertEqual(told[name]["points"], len(known))
            own = [told[name]["at"][share] for share in SHARES]
            np.testing.assert_allclose(own, np.quantile(known, [float(share) for share in SHARES]), rtol=1e-15)
        self.assertEqual(told["impact_speed[1]"]["units"], "m s-1")
        text = self.told()
        self.assertIn("Quantiles over R, gap\n", text)
        self.assertRegex(text, r"\n  x_max +1\.4\d+ .* mm, 64 points\n")

    def test_points_that_failed_or_have_no_value_do_not_count(self):
        self.study().close()
        with h5py.File(self.directory / "a.h5", "r+") as file:
            values, status = file["x_max"][()], file["status"][()]
            values[:10], status[10:20] = np.nan, 18
            file["x_max"][...], file["status"][...] = values, status
        told = json.loads(self.told("--json"))["quantiles"]["x_max"]
        self.assertEqual(told["points"], 44)
        self.assertEqual(told["at"]["0.5"], np.median(values[20:]))

    def test_other_sweeps_have_none(self):
        with self.study(
            STUDY.replace("sobol(0.5, 0.7, 64)", "linspace(0.5, 0.7, 64)").replace("sobol(1", "linspace(1")
        ):
            self.assertNotIn("uantiles", self.told())
            self.assertNotIn("quantiles", json.loads(self.told("--json")))
        crossed = STUDY.replace('frequency = "26 Hz"\n', "").replace(
            "[sweep]\n", '[sweep]\nfrequency = ["25 Hz", "26 Hz"]\n'
        )
        with self.study(crossed):
            self.assertIn("Quantiles over R, gap: only for a sweep without other axes\n", self.told())

    def test_one_sampled_parameter_beside_fixed_ones(self):
        alone = STUDY.replace('gap = "sobol(1.4 mm, 1.6 mm, 64)"\nlinked = "R, gap"\n', "").replace(
            "[sweep]", 'gap = "1.5 mm"\n[sweep]'
        )
        with self.study(alone) as file:
            self.assertEqual(file.attrs["sampled_axes"], "R")
            self.assertGreaterEqual(len(set(np.floor((file["R"][()] - 0.5 + 1e-13) * 320))), 63)


if __name__ == "__main__":
    unittest.main()
