"""Derivatives of periodic motion of a loose mass that rubs on its housing, beside stops and friction of the main mass,
too.

Environment: CLATTER, the program; CLATTER_SENSITIVITY, COUNT or COUNT:SEED of random scenes.
"""

import random
import unittest

import loose_mass_beside_stops_sensitivity_test as beside_stops_test
from loose_mass_sensitivity_test import carrying


def rubbing(draw):
    """A scene in which friction stops and holds the loose mass every now and then."""
    scene = carrying(draw) if draw.random() < 0.5 else beside_stops_test.beside_stops(draw)
    scene["loose_friction"] = scene["loose_mass"] * draw.uniform(0.02, 0.3)
    if draw.random() < 0.5:
        scene["loose_friction_static"] = scene["loose_friction"] * draw.uniform(1.05, 1.5)
    return scene


def drawn(count, seed):
    draw = random.Random(f"{seed} rubbing")
    return [rubbing(draw) for _ in range(4 * count)]  # of many kinds


class Rubbing(beside_stops_test.BesideStops):
    drawn = staticmethod(drawn)


def load_tests(loader, _tests, _pattern):
    return loader.loadTestsFromTestCase(Rubbing)


if __name__ == "__main__":
    unittest.main()
