"""Restitution that depends on the speed, as part of random scenes."""

import itertools
import math
import random
from dataclasses import dataclass

import numpy as np

LAWS = tuple(
    pre + law for pre in ("", "loose_") for law in ("R_exponent", "R_reference_speed", "R_below", "R_of_speed")
)
SPEEDS = tuple(
    pre + law + side
    for pre in ("", "loose_")
    for law in ("R_reference_speed", "R_below")
    for side in ("_lower", "_upper")
)
TABLES = tuple(pre + "R_of_speed" + side for pre in ("", "loose_") for side in ("_lower", "_upper"))


@dataclass
class Laws:
    """Of each stop and each wall, beside a plain R."""

    R_exponent_lower: float = 0.0  # 0: R at every speed
    R_exponent_upper: float = 0.0
    R_reference_speed_lower: float = 1.0
    R_reference_speed_upper: float = 1.0
    R_below_lower: float = 0.0
    R_below_upper: float = 0.0
    R_of_speed_lower: tuple = ()  # speeds and their restitutions, in place of R
    R_of_speed_upper: tuple = ()
    loose_R_exponent_lower: float = 0.0
    loose_R_exponent_upper: float = 0.0
    loose_R_reference_speed_lower: float = 1.0
    loose_R_reference_speed_upper: float = 1.0
    loose_R_below_lower: float = 0.0
    loose_R_below_upper: float = 0.0
    loose_R_of_speed_lower: tuple = ()
    loose_R_of_speed_upper: tuple = ()

    def tables_in(self, size):
        """Those of restitution, with speeds so many times as large."""
        return {name: tuple((size * v, R) for v, R in getattr(self, name)) for name in TABLES}

    def R_at(self, side, speed):
        """The restitution of a stop, "_lower" or "_upper", at the speed of an impact."""
        if speed < getattr(self, "R_below" + side):
            return 0.0
        if table := getattr(self, "R_of_speed" + side):
            return float(np.interp(speed, *zip(*table)))
        R, p = getattr(self, "R" + side), getattr(self, "R_exponent" + side)
        return max(p / (1 + p), 1 - (1 - R) * (speed / getattr(self, "R_reference_speed" + side)) ** p) if p else R

    def area_factor(self, side, speed):
        """By how much an impact changes areas of states: R times the derivative of R v by v."""
        R, p = self.R_at(side, speed), getattr(self, "R_exponent" + side)
        for (v, low), (faster, high) in itertools.pairwise(getattr(self, "R_of_speed" + side)):
            if v <= speed < faster and R > 0:
                return R * (R + speed * (high - low) / (faster - v))
        return R * (1 - (1 + p) * (1 - R) if p and R > p / (1 + p) else R)


def logarithmic(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def table(draw):
    """Speeds and restitutions by which a faster impact rebounds faster."""
    v, R = draw.choice([0.0, logarithmic(draw, 0.05, 0.5)]), draw.uniform(0.4, 0.95)
    knots = [(v, R)]
    for _ in range(draw.choice([0, 1, 2, 3])):
        faster = v + logarithmic(draw, 0.2, 2)
        least = faster / (2 * faster - v)  # of R, at which its product with v just rises
        v, R = faster, min(0.95, R * draw.uniform(max(0.7, 1.01 * least), 1.1))
        knots.append((v, R))
    return tuple(knots)


def by_speed(scenes, seed, tables=0.3):
    """The scenes with restitutions that depend on the speed, at one stop or wall or more; a share of them tables."""
    draw = random.Random(f"speed {seed}")
    changed = []
    for scene in scenes:
        laws = {}
        for pre, rigid in (("", "stop_stiffness"), ("loose_", "")):
            for side in ("_lower", "_upper"):
                if rigid and not math.isinf(getattr(scene, rigid + side)) or draw.random() < 0.2:
                    continue
                if draw.random() < tables:
                    laws |= {f"{pre}R{side}": 1.0, f"{pre}R_of_speed{side}": table(draw)}
                elif draw.random() < 0.7:
                    p = draw.choice([0.2, draw.uniform(0.05, 0.5)])
                    R = getattr(scene, f"{pre}R{side}")
                    laws |= {f"{pre}R_exponent{side}": p, f"{pre}R{side}": max(R, p / (1 + p))}
                    laws[f"{pre}R_reference_speed{side}"] = logarithmic(draw, 0.2, 3)
                if draw.random() < 0.4:
                    laws[f"{pre}R_below{side}"] = logarithmic(draw, 1e-3, 0.2)
        changed.append(scene.changed(**laws))
    return changed
