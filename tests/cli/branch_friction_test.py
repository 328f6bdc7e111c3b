"""Branches under dry friction: what runs do beside their special points, in SI too, and what can't be followed.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import math
import unittest

import h5py
import numpy as np
from branch_runs import BranchRuns

FREE = "[scene]\nh = 0.05\nf = 1.0\nnu = {nu}\nstop_lower = -inf\nstop_upper = inf\nfriction = {mu}\n"
STOPS = "[scene]\nh = 0.05\nf = 1.0\nnu = 1.3\nR = 0.7\nxs = -0.5\nfriction = 0.2\n"
ALONG = '[branch]\nalong = "{along}"\nrange = [{low}, {high}]\n'


class BranchFriction(BranchRuns):
    def special_points(self, text):
        done = self.branch(text, "--json", "-q", "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def stick_fractions(self, scene, key, values):
        """Of steady motion at each value of a key: the part of its time in which friction holds the mass."""
        observe = "[observe]\nimpacts = true\n"
        axis = f"[sweep]\n{key} = {[float(value) for value in values]!r}\n"
        scene = "".join(line + "\n" for line in scene.splitlines() if not line.startswith(f"{key} ="))
        self.write("b.toml", scene + observe + axis)
        done = self.clatter("run", "b.toml", "-o", "b.h5", "-q", "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "b.h5") as data:
            return data["stick_fraction"][()]

    def test_runs_stick_on_one_side_of_a_special_point(self):
        """The branch and the run see the same instant at which friction begins to hold the mass."""
        for scene, along, low, high in (
            (FREE.format(nu=0.8, mu=0.3), "friction", 0.2, 0.95),
            (FREE.format(nu=0.8, mu=0.6), "nu", 0.2, 0.9),
        ):
            special = [
                point
                for point in self.special_points(scene + ALONG.format(along=along, low=low, high=high))
                if point["kind"] in ("crossing-sliding", "grazing-sliding")
            ]
            self.assertGreaterEqual(len(special), 1, (scene, along))
            for point in special:
                at, off = point[along], 2e-4
                fractions = self.stick_fractions(scene, along, [at - off, at + off])
                self.assertEqual(sorted(fractions > 0), [False, True], (point, fractions))

    def test_a_reversal_becomes_a_stick_where_the_push_is_at_the_level(self):
        """Without a damper the mass turns at the amplitude of Den Hartog, where the force is known in closed form."""
        nu = 0.8
        scene = FREE.format(nu=nu, mu=0.2).replace("0.05", "0.0")
        special = self.special_points(scene + ALONG.format(along="friction", low=0.1, high=0.9))
        at = next(point["friction"] for point in special if point["kind"] == "crossing-sliding")
        V, U = 1 / (1 - nu**2), math.sin(math.pi / nu) / (nu * (1 + math.cos(math.pi / nu)))
        turn = math.sqrt(V**2 - (at * U) ** 2)
        # sin of the phase is turn/V there, as what friction and the free motion add cancels
        push = turn - turn / V  # of spring and force, back
        self.assertAlmostEqual(push, at, 10)

    def test_the_place_map_of_a_stick_is_of_one_number(self):
        self.special_points(STOPS + ALONG.format(along="nu", low=1.29, high=1.31))
        with h5py.File(self.directory / "a.branch.h5") as data:
            k = int(np.argmin(np.abs(data["nu"][()] - 1.3)))
            self.assertEqual(data["nu"][k], 1.3)
            np.testing.assert_allclose(data["multiplier_re"][k], [0.267959696315445, 0], rtol=0, atol=1e-13)
            self.assertEqual(data["word"][k], b"LU")

    def test_a_run_from_where_a_stick_vanishes_ends(self):
        """The push is at the level there, to rounding, and a slip is shorter than the time can tell."""
        machine = "[machine]\nmass = 0.25\nstiffness = 800\ngap = 0.003\nforce = 4\nfrequency = 6.672819015715544\n"
        machine += "damping_ratio = 0.05\nR = 0.7\nfriction = 1.5\nv0 = 0.00014554962017277815\n"
        x = -0.0020131515510718274
        axis = f"[sweep]\nx0 = {[x + k * math.ulp(x) for k in range(-8, 9)] + [x * (1 + 1e-9)]}\n"
        self.write("b.toml", f'{machine}{axis}[time]\nmode = "transient"\nduration = 0.6\n[observe]\ntrajectory = 9\n')
        done = self.clatter("run", "b.toml", "-o", "b.h5", "-q", "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "b.h5") as file:
            np.testing.assert_allclose(file["x"][:-1], np.tile(file["x"][-1], (17, 1)), rtol=0, atol=1e-9)

    def test_words_have_letters_for_sticks(self):
        """With word_sticks the words of a branch are those of runs of its points."""
        observe = "[observe]\nword = true\nword_sticks = {}\n"
        along = ALONG.format(along="nu", low=1.29, high=1.31)
        for shown, word in (("true", "LSU"), ("false", "LU")):
            special = self.special_points(STOPS.replace("1.3", "1.305") + along + observe.format(shown))
            self.assertTrue(all(("S" in point["word"]) == (shown == "true") for point in special), special)
            with h5py.File(self.directory / "a.branch.h5") as data:
                self.assertEqual(set(data["word"][()]), {word.encode()})
        self.write("b.toml", STOPS + observe.format("true"))
        self.assertEqual(self.clatter("run", "b.toml", "-o", "b.h5", "-q", "--force").returncode, 0)
        with h5py.File(self.directory / "b.h5") as data:
            self.assertEqual(data["impact_word"][()], b"LSU")

    def test_motion_beyond_a_flip_with_a_stick_is_what_runs_find(self):
        """A branch of motion over two periods is reached through one that is born with a stick."""
        scene = "[scene]\nh = 0\nf = 1\nnu = 1.28\nstop_lower = -0.2035\nstop_upper = 0.2757\nR = 0.45\n"
        observe = "[observe]\nword = true\nenergy = true\n"
        scene += "x0 = 0.07\nv0 = 0.13\nfriction = 0.2325\n"
        self.special_points(scene + ALONG.format(along="nu", low=1.23, high=1.3) + "switch = 1\n" + observe)
        with h5py.File(self.directory / "a.branch.h5") as data:
            of_two = np.flatnonzero((data["word"][()] == b"LLULU") & (data["stable"][()] == 1))
            nus, powers = data["nu"][()][of_two], data["impact_power"][()][of_two]
            states = np.column_stack([data[name][()][of_two] for name in ("x", "v")])
        self.assertGreater(len(of_two), 5)
        for nu, (x, v), power in list(zip(nus, states, powers))[1:-1:3]:
            changed = scene.replace("nu = 1.28", f"nu = {float(nu)!r}")
            changed = changed.replace("x0 = 0.07", f"x0 = {float(x)!r}").replace("v0 = 0.13", f"v0 = {float(v)!r}")
            self.write("b.toml", changed + observe)
            done = self.clatter("run", "b.toml", "-o", "b.h5", "-q", "--force")
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(self.directory / "b.h5") as data:
                self.assertEqual((data["status"][()], data["impact_word"][()]), (0, b"LLULU"))
                self.assertAlmostEqual(data["impact_power"][()], power, 10)

    def test_branches_in_si_are_those_of_the_scene(self):
        """Mass 1 kg, stiffness 1 N/m: the units are those of the scene."""
        machine = (
            "[machine]\nmass = 1.0\nstiffness = 1.0\ndamping = 0.1\nforce = 1.0\n"
            f"frequency = {1.3 / (2 * math.pi)!r}\nR = 0.7\ngap = 0.5\nfriction = 0.2\n"
        )
        one = self.special_points(STOPS + ALONG.format(along="friction", low=0.05, high=0.4))
        other = self.special_points(machine + ALONG.format(along="friction", low=0.05, high=0.4))
        self.assertGreaterEqual(len(one), 1)
        self.assertEqual([point["kind"] for point in one], [point["kind"] for point in other])
        for a, b in zip(one, other):
            self.assertAlmostEqual(a["friction"], b["friction"], 11)

    def test_a_scene_off_the_centre_has_the_same_special_points(self):
        """Places count from the middle of a symmetric scene, so halves of its motion are halves anywhere."""
        moved = STOPS.replace("xs = -0.5", "stop_lower = 0.5\nstop_upper = 1.5\nload = 1.0\nx0 = 1.0")
        along = ALONG.format(along="nu", low=1.0, high=1.6)
        one, other = self.special_points(STOPS + along), self.special_points(moved + along)
        self.assertIn("symmetry breaking", [point["kind"] for point in one])
        self.assertEqual([point["kind"] for point in one], [point["kind"] for point in other])
        for a, b in zip(one, other):
            self.assertAlmostEqual(a["nu"], b["nu"], 9)

    def test_motion_jumps_beyond_the_end_of_a_branch(self):
        """With a static level above friction a mass that just doesn't slip back at once sticks for long."""
        scene = FREE.format(nu=0.8, mu=0.1) + "friction_static = 0.2\n"
        special = self.special_points(scene + ALONG.format(along="nu", low=0.2, high=0.9))
        ends = [point for point in special if point["kind"] == "switching-sliding"]
        self.assertEqual(len(ends), 1, special)
        self.assertEqual(ends[0]["branches"], [0])
        at = ends[0]["nu"]
        with h5py.File(self.directory / "a.branch.h5") as data:
            x, v = (data[name][data["special_nu"][()] == at][0] for name in ("special_x", "special_v"))
        # from rest a run ends in the motion that sticks sooner, which is another one
        from_there = scene + f"x0 = {float(x)!r}\nv0 = {float(v)!r}\n"
        before, beyond = self.stick_fractions(from_there, "nu", [at + 1e-6, at - 1e-6])
        self.assertEqual(before, 0)
        self.assertGreater(beyond, 0.01)

    def test_it_says_what_cannot_be_followed(self):
        nu = ALONG.format(along="nu", low=1.2, high=1.4)
        for text, words in (
            (STOPS.replace("0.2", "1.6") + nu, "for good"),
            (STOPS.replace("0.2", "0") + ALONG.format(along="friction", low=0, high=0.4), "no dry friction"),
            (STOPS + "friction_static = 0.25\n" + ALONG.format(along="friction", low=0.1, high=0.4), "friction_static"),
        ):
            done = self.branch(text, "-q")
            self.assertNotEqual(done.returncode, 0, text)
            self.assertIn(words, done.stderr)
            self.assertFalse((self.directory / "a.branch.h5").exists(), text)


if __name__ == "__main__":
    unittest.main()
