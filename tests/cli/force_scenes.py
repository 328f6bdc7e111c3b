"""Forces of other shapes than a sine, as part of random scenes."""

import itertools
import math
import random
from dataclasses import dataclass

SHAPES = ("square", "pulse", "triangle", "trapezoid", "sawtooth", "half-sine")
WITH_DUTY = ("square", "pulse", "half-sine")
ORDERS = (2, 3, 5)  # that scenes may have beside the first


@dataclass
class Force:
    """The shape of a force, and the shares of the period that its parts take."""

    force_shape: str = "sine"
    force_duty: float = 0.5
    force_rise: float = 0.25
    force_table: str = ""  # of the shape "table": rows of a share of the period and the force, the first at 0
    f_2: float = 0.0
    f_3: float = 0.0
    f_5: float = 0.0
    phase_2: float = 0.0
    phase_3: float = 0.0
    phase_5: float = 0.0

    def orders(self):
        """Further ones of a sine: number, size and phase."""
        every = [(j, getattr(self, f"f_{j}"), getattr(self, f"phase_{j}")) for j in ORDERS]
        return [order for order in every if order[1]]

    def pace(self):
        """The fastest frequency of its parts, over that of the force."""
        swing = 1 / (2 * self.force_duty) if self.force_shape == "half-sine" else 1
        return max([swing, *(j for j, _, _ in self.orders())])

    def keys_of_force(self):
        """The keys that its shape has; none of a single sine."""
        if self.force_shape == "table":
            return ["force_table"]
        if self.force_shape == "sine":
            return [key for j, _, _ in self.orders() for key in (f"f_{j}", f"phase_{j}")]
        duty = ["force_duty"] if self.force_shape in WITH_DUTY else []
        return ["force_shape", *duty, *(["force_rise"] if self.force_shape == "trapezoid" else [])]

    def rows(self):
        """The rows of its table."""
        return [tuple(map(float, row.split(","))) for row in self.force_table.split(";")[1:]]

    def knots(self):
        """Phases, in turns 0 ... 1, between which s has all derivatives."""
        if self.force_shape == "table":
            return sorted({share for share, _ in self.rows() if share < 1})
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
        if self.force_shape == "table":
            ends = itertools.pairwise(self.rows())
            (begin, low), (end, high) = next(pair for pair in ends if pair[0][0] <= inside < pair[1][0])
            slope = (high - low) / (end - begin)
            return [low + slope * (t - begin), slope / (2 * math.pi), *([0.0] * (count - 2))]
        if self.force_shape in ("sine", "half-sine"):
            w = 1.0 if self.force_shape == "sine" else 1 / (2 * self.force_duty)
            size = 1.0 if self.force_shape == "sine" or inside < self.force_duty else 0.0
            waves = [(w, size, 0.0), *((j, size / self.f, phase) for j, size, phase in self.orders())]
            return [
                sum(size * w**k * math.sin(2 * math.pi * w * t + phase + k * math.pi / 2) for w, size, phase in waves)
                for k in range(count)
            ]
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


def any_table(draw):
    """Rows of a random force of size 1, some of them at one time."""
    shares = sorted({0.0, 1.0, *(draw.uniform(0.01, 0.99) for _ in range(draw.randrange(1, 7)))})
    counts = [1 if share in (0.0, 1.0) else draw.choice([1, 1, 2]) for share in shares]
    rows = [(share, draw.uniform(-1, 1)) for share, count in zip(shares, counts) for _ in range(count)]
    return "period, f" + "".join(f"; {share!r}, {force!r}" for share, force in rows)


def any_orders(draw):
    """Sizes and phases of one, two or three further orders."""
    some = draw.sample(ORDERS, draw.randrange(1, 4))
    sizes = {f"f_{j}": draw.choice([-1, 1]) * draw.uniform(0.1, 0.8) for j in some}
    return {**sizes, **{f"phase_{j}": draw.choice([0.0, draw.uniform(-3, 3)]) for j in some}}


def under_orders(scenes, seed):
    """The scenes with further orders of their force."""
    draw = random.Random(f"orders {seed}")
    return [scene.changed(**any_orders(draw)) for scene in scenes]


def driven(scenes, seed):
    """The scenes under forces of other shapes, shaken only under those of several orders."""
    draw = random.Random(f"force {seed}")
    changed = []
    for scene in scenes:
        still = {"stop_amplitude": 0.0, "base_amplitude": 0.0, "stop_phase": 0.0, "f": scene.f or draw.uniform(0.3, 1)}
        shape = draw.choice(SHAPES)
        duty = draw.choice([0.5, draw.uniform(0.05, 0.95)])
        rise = draw.choice([0.5, draw.uniform(0.02, 0.5)])
        shaped = {"force_shape": shape, "force_duty": duty, "force_rise": rise}
        if draw.random() < 0.3:
            shaped = {"force_shape": "table", "force_table": any_table(draw)}
        elif draw.random() < 0.3:
            shaped = any_orders(draw)
            still = {"f": still["f"]}
        changed.append(scene.changed(**shaped, **still))
    return changed
