"""Pictures of a loose mass: both masses in one history, its place in the housing in the phase plane.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import numpy as np
from plot_pictures import Pictures


class Housing(Pictures):
    def lines(self, axes, title):
        return [line for line in axes.lines if line.get_label() == title]

    def test_history_has_both_masses_and_the_walls_that_one_carries(self):
        output = self.output("housing")
        tau, x, v, z, w = (output.values(name) for name in ("tau", "x", "v", "z", "w"))
        places, plane, velocities = self.figure("housing").axes[:3]
        for axes, main, loose in ((places, x, x + z), (velocities, v, v + w)):
            for title, values in (("main mass", main), ("loose mass", loose)):
                (line,) = self.lines(axes, title)
                np.testing.assert_array_equal(line.get_xdata(), tau)
                np.testing.assert_array_equal(line.get_ydata(), values)
        walls = self.lines(places, "its walls")
        self.assertEqual([line.get_ydata()[0] - x[0] for line in walls], [-1.5, 2.1])
        for line in walls:  # the loose mass stays between them
            above = np.sign(line.get_ydata()[0] - (x + z)[0])
            self.assertTrue(np.all(above * (line.get_ydata() - (x + z)) >= -1e-12))
        self.assertEqual(
            (places.get_ylabel(), velocities.get_ylabel()), ("displacements $x$, $y$", "velocities $x$′, $y$′")
        )
        self.assertEqual(
            (plane.get_xlabel(), plane.get_ylabel()), ("place in the housing $z$", "velocity in the housing $z$′")
        )

    def test_plane_has_both_sides_of_each_impact_on_its_wall(self):
        output = self.output("housing")
        _, sides, before, after = output.impacts(())
        line = self.figure("housing").axes[1].lines[0]
        states = set(zip(line.get_xdata(), line.get_ydata()))
        self.assertGreater(len(sides), 4)
        for side, *velocities in zip(sides, before, after):
            for velocity in velocities:
                self.assertIn((-1.5 if side < 0 else 2.1, velocity), states)

    def test_impacts_are_those_on_walls_in_words_and_symbols(self):
        texts = " ".join(self.draw("housings").texts())
        for words in ("lower wall", "upper wall", "velocity at impact", "largest modulus", "smallest modulus"):
            self.assertIn(words, texts)
        self.assertNotRegex(texts, "(lower|upper) stop")
        labels = [axes.get_ylabel().replace("\n", " ") for axes in self.figure("housings").axes]
        self.assertIn("velocity at impact $z$′", labels)
        self.assertIn("displacement $y$ of the loose mass", labels)


if __name__ == "__main__":
    unittest.main()
