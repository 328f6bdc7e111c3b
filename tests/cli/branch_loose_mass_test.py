"""Branches of motion with a loose mass: the file, starts from files, on a shaken base and in SI too, and refusals.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import math
import unittest

import h5py
import numpy as np
from branch_runs import BranchRuns

SCENE = "[scene]\nh = 0.02\nf = 0.3\nnu = 1.2\nloose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6\nloose_v0 = 0.5\n"
PRESSED = "loose_mass = 0.5\nloose_lower = -0.1\nloose_upper = 1\nloose_R = 0.3\nloose_load = -0.5"
ALONG = '[branch]\nalong = "nu"\nrange = [1.15, 1.3]\n'
OBSERVED = "[observe]\nextrema = true\nstability = true\nperiod = true\n"
OF_LOOSE = ("z", "w", "y_min", "y_max", "z_min", "z_max")
MASS, STIFFNESS, SIZE = 0.25, 800.0, 1e-3  # of a machine that does the same
RATE = math.sqrt(STIFFNESS / MASS)
MACHINE = (
    f"[machine]\nmass = {MASS}\nstiffness = {STIFFNESS}\ndamping_ratio = 0.02\nforce = {0.3 * STIFFNESS * SIZE!r}\n"
    f"frequency = {1.2 * RATE / (2 * math.pi)!r}\nloose_mass = {0.05 * MASS!r}\nloose_gap = {1.9 * SIZE!r}\n"
    f"loose_R = 0.6\nloose_v0 = {0.5 * SIZE * RATE!r}\n"
)
MACHINE_ALONG = '[branch]\nalong = "frequency"\n' + "range = [{!r}, {!r}]\n".format(
    *(nu * RATE / (2 * math.pi) for nu in (1.15, 1.3))
)


class BranchLooseMass(BranchRuns):
    def followed(self, text, *words):
        done = self.branch(text, "--force", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "a.branch.h5") as data:
            return {name: values[()] for name, values in data.items() if isinstance(values, h5py.Dataset)}

    def test_the_file_has_four_multipliers_and_the_loose_mass(self):
        done = self.branch(SCENE + ALONG, "--json", "-q")
        special = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([point["kind"] for point in special], ["Neimark-Sacker"])
        self.assertEqual(len(special[0]["multipliers"]), 4)
        self.assertAlmostEqual(math.hypot(*special[0]["multipliers"][0]), 1, 9)
        self.assertTrue({"z", "w"} <= set(special[0]))
        with h5py.File(self.directory / "a.branch.h5") as data:
            self.assertEqual(data["multiplier_re"].shape, (len(data["nu"]), 4))
            for name in OF_LOOSE:
                self.assertEqual(len(data[name]), len(data["nu"]))
                self.assertIn("label", data[name].attrs)
            np.testing.assert_allclose(data["z_max"], 1.9, rtol=1e-12)
            stable = data["nu"][()] < special[0]["nu"] - 1e-9
            np.testing.assert_array_equal(data["stable"][()] == 1, stable)

    def test_a_machine_has_the_branch_of_its_scene(self):
        scene, machine = self.followed(SCENE + ALONG), self.followed(MACHINE + MACHINE_ALONG)
        self.assertEqual(list(scene["special_kind"]), list(machine["special_kind"]))
        np.testing.assert_allclose(machine["special_frequency"] * 2 * math.pi / RATE, scene["special_nu"], rtol=1e-9)
        for name, unit in (("z", SIZE), ("w", SIZE * RATE), ("y_max", SIZE), ("impact_speed", SIZE * RATE)):
            np.testing.assert_allclose(machine["special_" + name] / unit, scene["special_" + name], rtol=1e-6)

    def test_a_branch_begins_with_a_point_of_a_sweep(self):
        for text, along in ((SCENE, ALONG), (SCENE.replace("f = 0.3", "f = 0.1\nbase_amplitude = 0.3"), ALONG)):
            text = text.replace("nu = 1.2\n", "") + OBSERVED + "[sweep]\nnu = [1.18, 1.2]\n" + along
            self.write("s.toml", text.replace(along, ""))
            self.assertEqual(self.clatter("run", "s.toml", "-o", "s.h5", "-q", "--force").returncode, 0)
            self.write("a.toml", text)
            done = self.clatter(
                "branch", "a.toml", "--from", "s.h5", "--where", "nu=1.2", "-o", "a.h5", "-q", "--force"
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(self.directory / "a.h5") as branch, h5py.File(self.directory / "s.h5") as sweep:
                at = np.flatnonzero(branch["nu"][()] == 1.2)
                self.assertEqual(len(at), 1)
                for name in ("x_min", "x_max", "v_min", "v_max", *OF_LOOSE[2:]):
                    self.assertAlmostEqual(branch[name][at[0]], sweep[name][1], 8, name)
                np.testing.assert_allclose(branch["multiplier_re"][at[0]], sweep["multiplier_re"][1], atol=1e-7)

    def test_an_unstable_point_of_a_branch_gives_that_branch_again(self):
        first = self.followed(SCENE + ALONG)
        point = int(np.flatnonzero(first["stable"] == 0)[-1])
        words = ("--from", "a.branch.h5", "--where", f"point={point}", "-o", "b.h5", "--force", "-q")
        done = self.clatter("branch", "a.toml", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "b.h5") as again:
            np.testing.assert_allclose(again["special_nu"], first["special_nu"], rtol=1e-10)
            self.assertIn(first["nu"][point], again["nu"][()])

    def test_what_can_not_be_followed_is_told_with_the_way_out(self):
        def along(key, low, high, scene=SCENE):
            return f'{scene}[branch]\nalong = "{key}"\nrange = [{low}, {high}]\n'

        uneven = SCENE.replace("loose_gap = 1.9", "loose_lower = -1.9\nloose_upper = 1.5")
        pressed = SCENE.replace("loose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6", PRESSED).replace(
            "h = 0.02", "h = 0.1"
        )
        bare = "[scene]\nf = 1.0\nnu = 1.2\nxs = 1\nR = 0.7\n"
        for text, code, words in (
            (along("R", 0.5, 0.9), 2, ("a.toml:10:9", "loose_R")),
            (along("xs", 0.5, 0.9), 2, ("loose_mass", "loose_gap")),
            (along("friction", 0.1, 0.2), 2, ("loose_mass", "friction")),
            (along("loose_mass", 0, 0.1), 2, ("a.toml:11:9", "no loose mass", "above 0")),
            (along("stiffness", -1, 2), 2, ("no spring", "one side of 0")),
            (along("loose_gap", 1, 2, bare), 2, ("without 'loose_mass'",)),
            (along("loose_gap", 1, 2, uneven), 2, ("loose_lower or loose_upper",)),
            (along("loose_lower", -2, 2, uneven), 2, ("upper wall",)),
            (along("loose_upper", -2, 2, uneven), 2, ("lower wall",)),
            (along("loose_x0", 0, 1), 2, ("expected one of",)),
            (SCENE + ALONG + 'across = "f"\ncurve = "fold"\n', 1, ("has no fold", "branch.range")),
            (SCENE.replace("loose_v0 = 0.5\n", "") + ALONG, 1, ("no wall", "loose_v0")),
            (pressed + ALONG, 1, ("presses", "follow")),
        ):
            with self.subTest(text=text):
                self.write("a.toml", text)
                done = self.clatter("branch", "a.toml", "-o", "c.h5")
                self.assertEqual(done.returncode, code, done.stderr)
                for word in words:
                    self.assertIn(word, done.stderr)
                self.assertFalse((self.directory / "c.h5").exists())


if __name__ == "__main__":
    unittest.main()
