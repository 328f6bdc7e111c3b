"""Derivatives of periodic motion with a loose mass beside stops, soft stops and friction of the main mass.

Environment: CLATTER, the program; CLATTER_SENSITIVITY, COUNT or COUNT:SEED of random scenes.
"""

import random
import unittest

import numpy as np

from derivatives import LEVELS
from loose_mass_sensitivity_test import OfRandomScenes, carrying
from loose_mass_sensitivity_test import machine_of as loose_machine_of


def beside_stops(draw):
    """A scene with a loose mass whose main mass meets something, too."""
    scene = {key: value for key, value in carrying(draw).items() if key not in ("base_amplitude", "stop_phase")}
    scene |= {"stop_lower": -draw.uniform(0.2, 0.6), "stop_upper": draw.uniform(0.2, 0.6)}
    scene["stiffness"] = draw.choice([scene["stiffness"], scene["stiffness"], 0.0, -0.2])
    for side in ("lower", "upper"):
        scene[f"R_{side}"] = draw.uniform(0.2, 0.9)
        if draw.random() < 0.3:
            del scene[f"R_{side}"]
            scene |= {f"stop_stiffness_{side}": draw.uniform(5, 50), f"stop_damping_{side}": draw.uniform(0, 1)}
    if draw.random() < 0.4:
        scene["friction"] = draw.uniform(0.02, 0.15)
        scene["friction_static"] = scene["friction"] * draw.choice([1.0, draw.uniform(1, 1.5)])
    return scene


def drawn(count, seed):
    draw = random.Random(f"{seed} beside stops")
    return [beside_stops(draw) for _ in range(4 * count)]  # of many kinds


NOT_LOOKED_AT = -1
OF_OWN = ("stop_stiffness_lower", "stop_stiffness_upper", *LEVELS)


def machine_of(mass):
    """As that of a loose mass alone, with the stiffness of stops and friction."""
    of_loose = loose_machine_of(mass)

    def machine(scene):
        return {key: mass * value if key in OF_OWN else value for key, value in of_loose(scene).items()}

    return machine


class BesideStops(OfRandomScenes):
    drawn = staticmethod(drawn)
    machine_of = staticmethod(machine_of)
    unconfirmed = 3
    part = 1.0  # second derivatives may jump between the steps, where something else begins to be met
    test_a_mirrored_scene_has_mirrored_ones = None

    def check_scaling(self, family, *arguments):
        """A loose mass that no wall meets may be anywhere, and nothing has a derivative."""
        strikes = [bool(set(word.decode()) & set("lu")) for word in family.runs["impact_word"]]
        family.runs["status"][~np.array(strikes)] = NOT_LOOKED_AT
        super().check_scaling(family, *arguments)


def load_tests(loader, _tests, _pattern):
    return loader.loadTestsFromTestCase(BesideStops)


if __name__ == "__main__":
    unittest.main()
