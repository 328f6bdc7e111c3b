"""`clatter certify` holds each result of an output against the motion that it certifies.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import itertools
import json
import shutil
import unittest

import h5py
import numpy as np

from command_line import SOURCE, CommandLine

# results that tell how the run came to its motion or how far rounding was off, and those of the whole sweep
NOT_OF_THE_MOTION = {
    "impact_total",
    "simulated_periods",
    "settling_estimate",
    "settling_periods",
    "energy_residual",
    "motion_points",
    "motion_example",
    "motion_count",
    "motion_share",
    "motion_share_low",
    "motion_share_high",
}
EVERYTHING = """[observe]
extrema = true
impacts = true
impact_log = true
period = true
word = true
stability = true
energy = true
harmonics = 3
trajectory = 16
section = 2
settling = true
sensitivity = "nu, h"
"""
STEADY = "[scene]\nf = -1.0\nh = 0.1\nR = 0.7\nxs = -0.5\n[sweep]\nnu = [0.6, 1.0, 1.1]\n" + EVERYTHING
TRANSIENT = """[scene]
f = 1.0
h = 0.1
R = 0.5
xs = 0.5
[sweep]
v0 = [0.25, 0.5]
[time]
mode = "transient"
duration = 20.5
[observe]
extrema = true
impact_log = true
trajectory = 8
"""
LOOSE = """[scene]
f = 0.5
h = 0.05
nu = 1.3
loose_mass = 0.1
loose_lower = -0.7
loose_upper = 0.7
loose_R = 0.6
[observe]
extrema = true
word = true
stability = true
energy = true
"""
# half of the starts are mirror images of the others, and not run: their results are those of the others, mirrored
STARTS = """[scene]
f = 0.5
h = 0.1
R = 0.8
nu = 1.2
xs = 0.4
[sweep]
v0 = "linspace(-1, 1, 6)"
phase = "linspace(0, pi, 2)"
[observe]
extrema = true
attractor = true
"""
# settles through a long chaos, so that each instruction set may come to another motion
CHAOS = """[scene]
f = -1.0
nu = 2.855948996184263
h = 0.035593802328735186
stop_stiffness = 2757.974780787301
stop_damping = 0.0
stop_lower = -0.08543452249855045
stop_upper = 0.11296679969106241
x0 = -0.0750806201310269
v0 = -0.1657886122332095
[time]
max_periods = 2000
max_impacts = 300000
[observe]
extrema = true
"""


class Reproduced(CommandLine):
    def run_text(self, text, *words):
        result = self.clatter("run", self.write("a.toml", text), "-q", "-o", "a.h5", "--force", *words)
        self.assertIn(result.returncode, (0, 1), result.stderr)

    def certify(self, code=0, file="a.h5"):
        """The certificates, and what is said on stderr."""
        result = self.clatter("certify", file)
        self.assertEqual(result.returncode, code, result.stderr)
        return [line for line in map(json.loads, result.stdout.splitlines()) if "claim" in line], result.stderr

    def require_compared(self, prefix=""):
        """Changes each result of a.h5, and sees that the change is named; those of one point at a time."""
        with h5py.File(self.directory / "a.h5") as file:
            points = file[prefix + ("kind" if prefix else "arclength" if "arclength" in file else "status")].shape
            over = [
                name
                for name, variable in file.items()
                if name not in NOT_OF_THE_MOTION
                and variable.attrs.get("CLASS") != b"DIMENSION_SCALE"
                and (variable.shape[: len(points)] == points or self.is_over(variable, "impact", "motion"))
                and (name.startswith(prefix) if prefix else not name.startswith("special_"))
            ]
        self.assertGreater(len(over), 4)
        for name in over:
            with self.subTest(name):
                shutil.copy(self.directory / "a.h5", self.directory / "b.h5")
                with h5py.File(self.directory / "b.h5", "a") as file:
                    self.change(file[name])
                _, said = self.certify(1, "b.h5")
                named = "motion_.*" if name == "attractor" else name
                self.assertRegex(said, rf"[1-9]\d* not reproduced \((.*, )?\d+ {named}[,)]")

    @staticmethod
    def is_over(variable, *dimensions):
        """Whether a variable has one of these dimensions alone."""
        names = [dimension[0].name.strip("/") if len(dimension) else "" for dimension in variable.dims]
        return len(names) == 1 and names[0] in dimensions

    @staticmethod
    def change(variable):
        """Changes the first number that isn't 0 or rounding, else the first of all, or the first text."""
        values = np.asarray(variable[()])
        sizes = np.abs(values) if values.dtype.kind == "f" else np.zeros(values.shape)
        large = np.argwhere(sizes > (1e-3 * np.nanmax(sizes) if np.isfinite(sizes).any() else np.inf))
        place = tuple(large[0]) if len(large) else (0,) * values.ndim
        value = values[place]
        if values.dtype.kind == "f":
            variable[place] = value + 1e-5 * abs(value) if len(large) else 1.0
        elif values.dtype.kind in "iu":
            variable[place] = value + 1 if value < 1 else value - 1
        else:
            variable[place] = value + b"L"

    def test_every_result_of_steady_motion_is_compared(self):
        self.run_text(STEADY)
        self.assertEqual(len(self.certify()[0]), 3)
        self.require_compared()

    def test_every_result_of_a_transient_is_compared(self):
        self.run_text(TRANSIENT)
        self.assertEqual(len(self.certify()[0]), 2)
        self.require_compared()

    def test_every_result_with_a_loose_mass_is_compared(self):
        self.run_text(LOOSE)
        self.assertEqual(len(self.certify()[0]), 1)
        self.require_compared()

    def test_attractors_and_mirror_images_are_compared(self):
        self.run_text(STARTS)
        self.assertEqual(len(self.certify()[0]), 12)
        self.require_compared()

    def test_every_result_of_a_branch_and_its_special_points_is_compared(self):
        text = (SOURCE / "configs/branch.toml").read_text(encoding="utf-8")
        done = self.clatter("branch", self.write("b.toml", text), "-q", "-o", "a.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("not reproduced", self.certify()[1])
        for prefix in ("", "special_"):
            self.require_compared(prefix)

    def test_a_small_change_of_an_extremum_is_seen(self):
        self.run_text(STEADY)
        with h5py.File(self.directory / "a.h5", "a") as file:
            file["x_max"][1] *= 1 + 1e-10
        self.assertIn("1 not reproduced (1 x_max)", self.certify(1)[1])

    def test_other_results_of_a_point_without_a_claim_are_not_asked(self):
        self.run_text("[scene]\nxs = 1\nv0 = 2\n[observe]\nextrema = true\n")
        with h5py.File(self.directory / "a.h5", "a") as file:
            file["x_max"][()] = 7.0
        self.assertIn("1 without a claim (1 without a force)", self.certify()[1])

    def test_motion_settles_as_it_did_for_the_file(self):
        """Whatever was observed, with the instruction set of the file."""
        found = set()
        for arch, observed in itertools.product(("scalar", "sse2", "avx2"), ("", "word = true\nstability = true\n")):
            text = self.write("a.toml", CHAOS + observed)
            done = self.clatter("run", text, "-q", "-o", "a.h5", "--force", "--arch", arch)
            if done.returncode == 2:
                continue  # this machine lacks it
            with h5py.File(self.directory / "a.h5") as file:
                self.assertEqual(file.attrs["instruction_set"], "avx2 or avx512" if arch == "avx2" else arch)
                x_min = file["x_min"][()]
            (certificate,), said = self.certify()
            self.assertIn("1 certificate (1 periodic)", said)
            self.assertLessEqual(abs(certificate["x_min"][0] - x_min), certificate["x_min"][1] + 1e-15)
            found.add((arch, x_min))
        self.run_text(CHAOS)
        with h5py.File(self.directory / "a.h5", "a") as file:
            file.attrs["instruction_set"] = "vsx\x1b"
            file["x_min"][()] = 0.0
        self.assertTrue(
            self.certify(1)[1].endswith("; the file was computed with vsx\\x1b, which this machine lacks\n")
        )
        self.assertEqual(len(found), len({arch for arch, _ in found}))
        self.assertGreater(len({x_min for _, x_min in found}), 1)  # else the scene tells nothing


if __name__ == "__main__":
    unittest.main()
