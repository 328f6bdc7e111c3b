"""Which motions starts with a loose mass end in: numbers against the words and the sections of the same runs.

Environment: CLATTER, the program.
"""

import math
import random
import unittest

import numpy as np

from loose_mass_follow_test import Followed, text_of

QUIET = {"h": 0.05, "f": 0.02, "nu": 1.0, "loose_mass": 0.02, "loose_gap": 0.4, "loose_R": 0.8}
MANY = {"h": 0.05, "f": 0.2, "nu": 1.2, "loose_mass": 0.05, "loose_gap": 0.4, "loose_R": 0.8}
CHAOS = {**MANY, "nu": 1.0}
PRESSED = {"h": 0.02, "f": 0.05, "nu": 1.3, "loose_mass": 0.05, "loose_gap": 1.9, "loose_R": 0.6, "loose_load": -0.4}
TOLD = {"word": True, "section": 64, "attractor": True, "impact_log": True, "extrema": True, "trajectory": 2}
TIME = {"max_periods": 3000}
STARTS = {"loose_x0": "linspace(-0.3, 0.3, 4)", "loose_v0": "linspace(-0.6, 0.6, 6)"}


def without(scene, *keys):
    return {key: value for key, value in scene.items() if key not in keys}


def response(scene, theta=0.0):
    """The steady x and x' of the main mass alone at a phase of the force."""
    h, f, nu = scene["h"], scene["f"], scene["nu"]
    gain, lag = f / math.hypot(1 - nu * nu, 2 * h * nu), math.atan2(2 * h * nu, 1 - nu * nu)
    return gain * math.sin(theta - lag), gain * nu * math.cos(theta - lag)


class Numbered(Followed):
    def numbered(self, scene, sweep, section="scene", time=TIME, **more):
        return self.observed(without(scene, *sweep), time, sweep, section=section, observe={**TOLD, **more})

    def assert_numbers(self, data, walls="LU"):
        """Numbers count motions by their first points; two points have the same one if a section of the one is among
        those of the other, of the main mass alone if no wall is met in both. Returns word and sections of each."""
        numbers, words = data["attractor"].ravel(), data["impact_word"].ravel()
        self.assertTrue((data["status"] == 0).all())
        states = np.stack([data[f"section_{name}"].reshape(numbers.size, -1) for name in "xvzw"], axis=-1)
        motions = []
        for i, (number, word) in enumerate(zip(numbers, words)):
            size, known = np.nanmax(np.abs(states[i])), 0
            for other, cycle in motions:
                numbers_compared = 4 if set(word) & set(walls) else 2
                apart = np.abs(cycle - states[i][0])[:, :numbers_compared]
                if word == other and np.nanmin(apart.max(axis=1)) < 1e-7 * size:
                    break
                known += 1
            else:
                motions.append((word, states[i]))
            self.assertEqual(number, known, f"start {i}")
        self.assertEqual(list(data["motion_word"]), [word for word, _ in motions])
        self.assertEqual(list(data["motion_points"]), list(np.bincount(numbers)))
        for i, (_, cycle) in enumerate(motions):
            state = [data[f"motion_{name}"][i] for name in "xvzw"]
            self.assertLess(np.nanmin(np.abs(cycle - state).max(axis=1)), 1e-9 * np.nanmax(np.abs(cycle)))
        return motions


class Numbers(Numbered):
    def test_a_loose_mass_that_floats_and_one_that_strikes(self):
        x, v = response(QUIET)
        scene = {**QUIET, "x0": x, "v0": v}
        data = self.numbered(scene, {"loose_x0": "linspace(0.02, 0.38, 5)", "loose_v0": [-v, 0.1, 0.5]})
        motions = self.assert_numbers(data)
        self.assertEqual([word for word, _ in motions], ["-", "LU"])
        np.testing.assert_array_equal(data["attractor"], [[0, 1, 1]] * 5)
        self.assertEqual(len(set(data["section_z"][:, 0, 0])), 5)  # the places of the band
        np.testing.assert_array_equal(data["motion_mirror"], [0, 1])
        np.testing.assert_array_equal(data["motion_symmetric"], [1, 1])
        np.testing.assert_array_equal(data["motion_period_ratio"], [1, 1])
        self.assertEqual(list(data["motion_regime"]), ["0/1", "1/1"])

    def test_motions_that_coexist_and_their_mirror_images(self):
        data = self.numbered(MANY, STARTS)
        words = [word for word, _ in self.assert_numbers(data)]
        self.assertTrue({"LUU", "LLU"} <= set(words))
        for i, mirror in enumerate(data["motion_mirror"]):
            other = words[mirror].translate(str.maketrans("LU", "UL"))
            self.assertEqual(len(other), len(words[i]))
            self.assertIn(other, words[i] + words[i])
            self.assertEqual(data["motion_mirror"][mirror], i)
        self.assertNotEqual(data["motion_mirror"][words.index("LUU")], words.index("LUU"))

    def test_mirrored_starts_end_in_mirrored_motions(self):
        count = 9  # of other counts some transients are so long that rounding decides where they end
        places, speeds = np.linspace(-0.35, 0.3, count), np.linspace(-0.5, 0.6, count)[::-1]
        for load in (0.0, 0.3):  # of the main mass, whose equilibrium it shifts
            starts = [(load, x, v, p) for x, v, p in zip(places, speeds, np.linspace(0, 6, count))]
            starts += [(x0, -x, -v, p + math.pi) for x0, x, v, p in starts]
            sweep = dict(zip(("x0", "loose_x0", "loose_v0", "phase"), (list(map(float, key)) for key in zip(*starts))))
            data = self.numbered({**MANY, "load": load}, {**sweep, "linked": ", ".join(sweep)})
            numbers, half = data["attractor"], len(places)
            self.assertTrue((numbers >= 0).all())
            np.testing.assert_array_equal(data["motion_mirror"][numbers[:half]], numbers[half:])
            self.assertGreater(data["motion_word"].size, 2)

    def test_uneven_walls_have_a_middle(self):
        scene = {**without(MANY, "loose_gap"), "loose_lower": -0.1, "loose_upper": 0.7}
        one, other = self.numbered(MANY, STARTS), self.numbered(scene, {**STARTS, "loose_x0": "linspace(0, 0.6, 4)"})
        np.testing.assert_array_equal(one["attractor"], other["attractor"])
        np.testing.assert_array_equal(one["motion_mirror"], other["motion_mirror"])
        np.testing.assert_allclose(one["motion_z"] + 0.3, other["motion_z"], atol=1e-9)

    def test_motion_without_a_period_is_one_motion(self):
        data = self.numbered(CHAOS, STARTS, time={"max_periods": 300})
        self.assertTrue((data["status"] == 1).all())
        self.assertTrue((data["attractor"] == 0).all())
        self.assertEqual((data["motion_period_ratio"][0], data["motion_mirror"][0]), (0, 0))

    def test_a_loose_mass_that_a_wall_presses(self):
        data = self.numbered(PRESSED, {"loose_x0": [-1.9, -1.0, 1.0], "loose_v0": [-0.2, 0.0, 0.2]})
        motions = self.assert_numbers(data)
        self.assertEqual([word for word, _ in motions], ["(L)"])
        self.assertEqual((data["motion_z"][0], data["motion_w"][0]), (-1.9, 0))
        self.assertTrue(np.isnan(data["motion_symmetric"][0]))

    def test_a_shaken_base_and_either_frame(self):
        scene = {**without(MANY, "f"), "f": 0.05, "base_amplitude": 0.15}
        relative = self.numbered(scene, STARTS)
        self.assert_numbers(relative)
        absolute = self.numbered(scene, STARTS, frame="absolute")
        self.assert_numbers(absolute)
        np.testing.assert_array_equal(relative["attractor"], absolute["attractor"])
        np.testing.assert_allclose(absolute["motion_v"] - relative["motion_v"], 0.15 * 1.2, rtol=1e-9)
        led = self.numbered({**scene, "stop_phase": 1.1}, STARTS)
        self.assert_numbers(led)

    def test_a_machine_in_SI(self):
        mass, rate, length = 0.35, 90.0, 2e-3
        machine = {"mass": mass, "stiffness": mass * rate**2, "damping": 2 * MANY["h"] * mass * rate}
        machine |= {"force": MANY["f"] * mass * length * rate**2, "frequency": MANY["nu"] * rate / (2 * math.pi)}
        machine |= {"loose_mass": MANY["loose_mass"] * mass, "loose_gap": 0.4 * length, "loose_R": 0.8}
        starts = {"loose_x0": [x * length for x in (-0.3, -0.1, 0.1, 0.3)]}
        starts |= {"loose_v0": [v * length * rate for v in (-0.6, -0.36, -0.12, 0.12, 0.36, 0.6)]}
        one, other = self.numbered(MANY, STARTS), self.numbered(machine, starts, "machine")
        np.testing.assert_array_equal(one["attractor"], other["attractor"])
        np.testing.assert_allclose(other["motion_z"], length * one["motion_z"], rtol=1e-8)
        np.testing.assert_allclose(other["motion_w"], length * rate * one["motion_w"], rtol=1e-8)
        self.assert_numbers(other)


class Along(Numbered):
    def test_a_floating_mass_keeps_its_number_while_it_has_room(self):
        values = np.linspace(0.9, 1.1, 21)
        sweep = {key: [] for key in ("nu", "x0", "v0", "loose_x0", "loose_v0")}
        has_room = []
        for nu in values:
            scene = {**QUIET, "f": 0.045, "nu": float(nu)}
            x, v = response(scene)
            has_room.append(math.hypot(x, v / nu) < 0.4)
            start = (x, v, -x, -v) if has_room[-1] else (0.0, 0.0, 0.1, 0.2)
            for key, value in zip(sweep, (float(nu), *start)):
                sweep[key].append(value)
        scene = {**QUIET, "f": 0.045}
        data = self.numbered(scene, {**sweep, "linked": ", ".join(sweep)}, time={"max_periods": 300})
        has_room = np.array(has_room)
        np.testing.assert_array_equal(data["impact_word"] == "-", has_room)
        first = np.argmin(has_room)  # the first without room
        self.assertEqual(set(data["attractor"][:first]), {0})
        after = data["attractor"][first:][has_room[first:]]
        self.assertEqual(len(set(after)), 1)
        self.assertNotEqual(after[0], 0)

    def test_periodic_motion_keeps_its_number(self):
        values = [float(nu) for nu in np.linspace(1.15, 1.25, 11)]
        data = self.numbered({**MANY, "f": 0.1}, {"nu": values, "loose_v0": [-0.4, 0.1, 0.5]})
        self.assertEqual(set(data["impact_word"].ravel()), {"LU"})
        self.assertEqual(set(data["attractor"].ravel()), {0})

    def test_both_ways_of_a_followed_sweep_are_two_starts(self):
        sweep = {"nu": "linspace(1.0, 1.3, 13)", "follow": "nu", "direction": "both"}
        data = self.numbered({**MANY, "f": 0.1, "loose_v0": 0.3}, sweep)
        same = (np.abs(data["section_z"][0, :, 0] - data["section_z"][1, :, 0]) < 1e-9) & (data["status"] == 0).all(
            axis=0
        )
        np.testing.assert_array_equal(data["attractor"][0][same], data["attractor"][1][same])
        self.assertGreater(same.sum(), 3)


class BesideStops(Numbered):
    """Words tell walls, l and u, from stops."""

    FLOATING = {"h": 0.05, "f": 0.6, "xs": 0.3, "R": 0.7, "loose_mass": 0.05, "loose_gap": 1.0, "loose_R": 0.6}

    def test_a_loose_mass_floats_beside_impacts_of_the_main_one(self):
        scene = {**self.FLOATING, "nu": 0.9}
        data = self.numbered(scene, {"loose_x0": [-0.4, 0.0, 0.4], "loose_v0": [0.0, 0.8]})
        self.assertTrue((data["status"][:, 0] == 0).all())
        self.assertEqual(len(set(data["impact_word"][:, 0])), 1)
        self.assertRegex(data["impact_word"][0, 0], "^[LU]+$")
        self.assertEqual(len(set(data["section_z"][:, 0, 0])), 3)  # the places of the band
        self.assertEqual(set(data["attractor"][:, 0]), {0})
        self.assertFalse({0} & set(data["attractor"][:, 1]))

    def test_it_floats_beside_motion_without_a_period(self):
        data = self.numbered({**self.FLOATING, "nu": 1.2}, {"loose_x0": [-0.4, 0.0, 0.4], "loose_v0": [0.0, 0.8]})
        self.assertTrue((data["status"] == 1).all())
        np.testing.assert_array_equal(data["attractor"], [[0, 1]] * 3)

    def test_it_keeps_the_number_of_the_main_mass_along_the_frequency(self):
        for values in ("linspace(0.88, 0.92, 5)", "linspace(1.15, 1.25, 6)"):
            data = self.numbered(self.FLOATING, {"nu": values, "loose_x0": [-0.2, 0.2]})
            self.assertEqual(set(data["attractor"].ravel()), {0})

    def test_starts_of_any_scene(self):
        starts = {"loose_x0": [-0.2, 0.15], "loose_v0": [-0.5, 0.4], "v0": [-0.7, 0.0, 0.6]}
        told = 0
        for seed in range(12):
            draw = random.Random(seed)
            scene = {"h": draw.uniform(0.05, 0.2), "f": draw.uniform(0.3, 1), "nu": draw.uniform(0.7, 1.8)}
            scene |= {
                "stiffness": draw.choice([1.0, 0.3, 0.0]),
                "xs": draw.uniform(0.3, 1),
                "R": draw.uniform(0.3, 0.8),
            }
            scene |= {"loose_mass": draw.uniform(0.02, 0.3), "loose_gap": draw.uniform(0.3, 0.8)}
            scene |= {"loose_R": draw.uniform(0.3, 0.8), "loose_load": draw.choice([0.0, -0.1])}
            if draw.random() < 0.5:
                del scene["R"]
                scene |= {"stop_stiffness": draw.uniform(5, 100), "stop_damping": draw.uniform(0, 1)}
            with self.subTest(seed=seed, scene=scene):
                data = self.numbered(scene, starts)
                if (data["status"] == 0).all():
                    self.assert_numbers(data, "lu")
                    told += 1
        self.assertGreater(told, 5)

    def test_mirrored_starts_end_in_mirrored_motions(self):
        scene = {**MANY, "xs": 0.5, "R": 0.7}
        places, speeds = np.linspace(-0.35, 0.3, 8), np.linspace(-0.5, 0.6, 8)[::-1]
        starts = [(x, v, p) for x, v, p in zip(places, speeds, np.linspace(0, 6, 8))]
        starts += [(-x, -v, p + math.pi) for x, v, p in starts]
        sweep = dict(zip(("loose_x0", "loose_v0", "phase"), (list(map(float, key)) for key in zip(*starts))))
        data = self.numbered(scene, {**sweep, "linked": ", ".join(sweep)})
        numbers = data["attractor"]
        self.assertTrue((numbers >= 0).all())
        np.testing.assert_array_equal(data["motion_mirror"][numbers[:8]], numbers[8:])


class Bytes(Numbered):
    def test_every_way_to_run_a_sweep_gives_the_same_bytes(self):
        sweep = {**STARTS, "nu": "linspace(1.1, 1.2, 3)"}
        text = text_of(without(MANY, "nu"), TIME, sweep, observe={"attractor": True, "word": True})
        self.assert_same_bytes(text)


if __name__ == "__main__":
    unittest.main()
