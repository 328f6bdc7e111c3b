"""Forces of other shapes than a sine, as part of random scenes."""

import math
import random
from dataclasses import dataclass

SHAPES = ("square", "pulse", "triangle", "trapezoid", "sawtooth", "half-sine")
WITH_DUTY = ("square", "pulse", "half-sine")


@dataclass
class Force:
    """The shape of a force, and the shares of the period that its parts take."""

    force_shape: str = "sine"
    force_duty: float = 0.5
    force_rise: float = 0.25

    def keys_of_force(self):
        """The keys that its shape has; none of a sine."""
        if self.force_shape == "sine":
            return []
        duty = ["force_duty"] if self.force_shape in WITH_DUTY else []
        return ["force_shape", *duty, *(["force_rise"] if self.force_shape == "trapezoid" else [])]

    def knots(self):
        """Phases, in turns 0 ... 1, between which s has all derivatives."""
        half = self.force_rise / 2
        return {
            "sine": [],
            "triangle": [0.25, 0.75],
            "trapezoid": [half, 0.5 - half, 0.5 + half, 1 - half],
            "sawtooth": [0.0],
        }.get(self.force_shape, [0.0, self.force_duty])

    def derivatives(self, turns, within, count):
        """s and its derivatives by the phase, in rad, at a phase by the course that s has about another one."""
        t, inside = turns - math.floor(within), within - math.floor(within)
        if self.force_shape in ("sine", "half-sine"):
            w = 1.0 if self.force_shape == "sine" else 1 / (2 * self.force_duty)
            size = 1.0 if self.force_shape == "sine" or inside < self.force_duty else 0.0
            return [size * w**k * math.sin(2 * math.pi * w * t + k * math.pi / 2) for k in range(count)]
        slope = 0.0  # by turns
        if self.force_shape in WITH_DUTY:
            s = 1.0 if inside < self.force_duty else -1.0 if self.force_shape == "square" else 0.0
        elif self.force_shape == "sawtooth":
            s, slope = 2 * t - 1, 2.0
        else:
            rise = 0.5 if self.force_shape == "triangle" else self.force_rise
            zero = min((0.0, 0.5, 1.0), key=lambda place: abs(inside - place))
            sign = -1 if zero == 0.5 else 1
            s, slope = sign * 2 / rise * (t - zero), sign * 2 / rise
            if abs(inside - zero) > rise / 2:
                s, slope = (1.0 if inside < 0.5 else -1.0), 0.0
        return [s, slope / (2 * math.pi), *([0.0] * (count - 2))]


def driven(scenes, seed):
    """The scenes under forces of other shapes, none of them shaken."""
    draw = random.Random(f"force {seed}")
    changed = []
    for scene in scenes:
        still = {"stop_amplitude": 0.0, "base_amplitude": 0.0, "stop_phase": 0.0, "f": scene.f or draw.uniform(0.3, 1)}
        shape = draw.choice(SHAPES)
        duty = draw.choice([0.5, draw.uniform(0.05, 0.95)])
        rise = draw.choice([0.5, draw.uniform(0.02, 0.5)])
        changed.append(scene.changed(force_shape=shape, force_duty=duty, force_rise=rise, **still))
    return changed
