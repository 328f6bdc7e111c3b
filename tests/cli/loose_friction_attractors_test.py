"""Which motions starts of a loose mass end in beside dry friction, of its housing or of the main mass: numbers against
the words and the sections of the same runs.

Environment: CLATTER, the program.
"""

import random
import unittest

import numpy as np

from loose_mass_attractors_test import MANY, STARTS, Numbered, without

RUBBING = {**MANY, "loose_friction": 0.001, "loose_friction_static": 0.0012}


class Numbers(Numbered):
    def assert_told(self, data, walls="LU"):
        """As without friction. Of motion that no wall meets the speed in the housing is compared, too."""
        motions = self.assert_numbers(data, walls)
        numbers, words = data["attractor"].ravel(), data["impact_word"].ravel()
        for number in set(numbers):
            same = (numbers == number) & ~np.array([bool(set(word) & set(walls)) for word in words])
            cycles = data["section_w"].reshape(numbers.size, -1)[same]
            for cycle in cycles:
                self.assertLess(np.nanmin(np.abs(cycle - cycles[0][0])), 1e-7)
        return motions

    def test_starts_of_any_scene(self):
        starts = {"loose_x0": [-0.2, 0.15], "loose_v0": [-0.5, 0.4], "v0": [-0.7, 0.0, 0.6]}
        told, several, floating = 0, 0, 0
        for seed in range(24):
            draw = random.Random(seed)
            scene = {"h": draw.uniform(0.05, 0.2), "f": draw.uniform(0.1, 0.8), "nu": draw.uniform(0.7, 1.8)}
            scene |= {"loose_mass": draw.uniform(0.02, 0.3), "loose_gap": draw.uniform(0.3, 0.8)}
            scene |= {"loose_R": draw.uniform(0.3, 0.8), "loose_load": draw.choice([0.0, -0.05])}
            if draw.random() < 0.7:
                scene["loose_friction"] = scene["loose_mass"] * draw.uniform(0.02, 0.3)
            beside = draw.random() < 0.5
            if beside:
                scene |= {"xs": draw.uniform(0.3, 1), "R": draw.uniform(0.3, 0.8)}
            if draw.random() < 0.5 or "loose_friction" not in scene:
                scene["friction"] = draw.uniform(0.01, 0.1)
            with self.subTest(seed=seed, scene=scene):
                data = self.numbered(scene, starts)
                if (data["status"] == 0).all():
                    walls = "lu" if beside or "friction" in scene else "LU"
                    motions = self.assert_told(data, walls)
                    told, several = told + 1, several + (len(motions) > 1)
                    floating += any(not set(word) & set(walls) for word, _ in motions)
        self.assertGreater(told, 12)
        self.assertGreater(several, 2)
        self.assertGreater(floating, 0)

    def test_wherever_friction_holds_the_loose_mass_it_is_one_motion(self):
        """That of both masses as one."""
        scene = {**MANY, "f": 0.02, "loose_friction": 0.2}
        data = self.numbered(scene, {"loose_x0": "linspace(-0.35, 0.35, 5)", "v0": [0.0, 0.01]})
        motions = self.assert_told(data)
        self.assertEqual([word for word, _ in motions], ["-"])
        self.assertEqual(len(set(data["section_z"][:, 0, 0])), 5)
        np.testing.assert_array_equal((data["motion_mirror"], data["motion_symmetric"]), [[0], [1]])
        both = 1 + scene["loose_mass"]
        gain = scene["f"] / (1 - both * scene["nu"] ** 2 + 2j * scene["h"] * scene["nu"])
        found = (data["motion_x"][0], data["motion_v"][0], data["motion_w"][0])
        np.testing.assert_allclose(found, (gain.imag, scene["nu"] * gain.real, 0), atol=1e-12)

    def test_wherever_it_slides_between_far_walls_it_is_one_motion(self):
        scene = {**without(MANY, "loose_gap"), "loose_gap": 9.0, "loose_friction": 0.005}
        data = self.numbered(scene, {"loose_x0": "linspace(-3, 3, 4)", "loose_v0": [0.0, 0.3]})
        motions = self.assert_told(data)
        self.assertEqual([word for word, _ in motions], ["-"])
        self.assertGreater(np.nanmax(np.abs(data["section_w"])), 0.01)

    def test_friction_of_the_main_mass_that_holds_both_for_good(self):
        scene = {**MANY, "friction": 0.4, "loose_friction": 0.01}
        data = self.numbered(scene, {"loose_x0": [-0.3, 0.0, 0.2], "x0": [-0.1, 0.0, 0.15], "loose_v0": [0.0, 0.4]})
        self.assertEqual((data["motion_word"].tolist(), set(data["attractor"].ravel())), (["(S)"], {0}))

    def test_a_motion_keeps_its_number_along_the_frequency(self):
        values = [float(nu) for nu in np.linspace(1.15, 1.25, 11)]
        for scene in ({**RUBBING, "f": 0.1}, {**MANY, "f": 0.1, "friction": 0.01}):
            data = self.numbered(scene, {"nu": values, "loose_v0": [-0.4, 0.1, 0.5]})
            for word in set(data["impact_word"].ravel()):
                self.assertEqual(len(set(data["attractor"][data["impact_word"] == word])), 1, word)

    def test_motions_that_coexist_and_their_mirror_images(self):
        data = self.numbered(RUBBING, STARTS)
        words = [word for word, _ in self.assert_told(data)]
        for i, mirror in enumerate(data["motion_mirror"]):
            if mirror >= 0:
                other = words[mirror].translate(str.maketrans("LU", "UL"))
                self.assertIn(other, words[i] + words[i])
                self.assertEqual(data["motion_mirror"][mirror], i)
        self.assertGreater(len(words), 1)


if __name__ == "__main__":
    unittest.main()
