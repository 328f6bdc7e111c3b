"""Random scenes of a main mass that carries a loose one, as keys of [scene]: every effect, also at its end."""

import math
import random

from random_scenes import logarithmic


def walls(draw, keys):
    """Walls as far from the middle on both sides, unequal ones, or one."""
    near, far, kind = logarithmic(draw, 1e-2, 3), logarithmic(draw, 1e-2, 3), draw.random()
    if kind < 0.45:
        keys["loose_gap"] = near
        return -near, near
    low, high = (-near, far) if kind < 0.8 else (near, near + far)
    if kind > 0.9:
        low, high = (low, math.inf) if draw.random() < 0.5 else (-math.inf, high)
    keys |= {key: at for key, at in (("loose_lower", low), ("loose_upper", high)) if math.isfinite(at)}
    return low, high


def loose_start(draw, keys, low, high):
    """Between the walls or on one of them, at rest in the housing or not."""
    inside = max(low, high - 2 if math.isfinite(high) else low), min(high, low + 2 if math.isfinite(low) else high)
    at_wall = [wall for wall in (low, high) if math.isfinite(wall)]
    keys["loose_x0"] = draw.choice([draw.uniform(*inside)] * 3 + at_wall)
    keys["loose_v0"] = draw.choice([0.0, draw.uniform(-1, 1), draw.uniform(-1, 1)])


def carrying(draw):
    """A load or the only wall brings the loose mass back: it chatters, and is pressed and let go."""
    keys = {
        "h": draw.choice([0.0, logarithmic(draw, 1e-3, 0.5), logarithmic(draw, 0.02, 0.3), draw.uniform(1, 2)]),
        "f": draw.choice([-1, 1]) * logarithmic(draw, 0.05, 3),
        "nu": logarithmic(draw, 0.2, 5),
        "phase": draw.choice([0.0, draw.uniform(-3, 3)]),
        "load": draw.choice([0.0, 0.0, draw.uniform(-1, 1)]),
        "stiffness": draw.choice([1.0, 1.0, logarithmic(draw, 0.05, 20)]),
        "x0": draw.uniform(-1, 1),
        "v0": draw.choice([0.0, draw.uniform(-1, 1)]),
        "loose_mass": draw.choice([logarithmic(draw, 1e-3, 0.1), logarithmic(draw, 0.1, 3)]),
        "loose_R": draw.choice([0.0, 1.0, draw.uniform(0.05, 0.6), draw.uniform(0.3, 0.95), draw.uniform(0.3, 0.95)]),
    }
    if draw.random() < 0.3:
        keys |= {
            "loose_R_lower": keys.pop("loose_R"),
            "loose_R_upper": draw.choice([0.0, 1.0, draw.uniform(0.05, 0.95)]),
        }
    low, high = walls(draw, keys)
    load = draw.choice([0.0, 0.0, draw.uniform(-1.5, 1.5)])
    if not math.isfinite(low) or not math.isfinite(high):
        load = logarithmic(draw, 0.05, 1.5) * (1 if math.isfinite(high) else -1)
    keys["loose_load"] = load
    loose_start(draw, keys, low, high)
    if draw.random() < 0.15:
        keys["base_amplitude"] = draw.uniform(0.1, 0.5)
    return keys


def carrying_scenes(count, seed):
    draw = random.Random(f"loose {seed}")
    return [carrying(draw) for _ in range(count)]


def beside_stops(draw, keys):
    """The same between stops of the main mass, rigid or soft, with friction, without a spring or pushed away by it."""
    keys = {name: value for name, value in keys.items() if name != "base_amplitude"}
    sides = draw.choice((("lower",), ("upper",), ("lower", "upper"), ("lower", "upper")))
    for side in sides:
        keys[f"stop_{side}"] = draw.uniform(0.1, 1.2) * (1 if side == "upper" else -1)
        if draw.random() < 0.5:
            keys[f"stop_stiffness_{side}"] = logarithmic(draw, 2, 60)
            keys[f"stop_damping_{side}"] = draw.choice([0.0, draw.uniform(0, 1)])
        else:
            keys[f"R_{side}"] = draw.choice([0.0, 1.0, *(draw.uniform(0.1, 1) for _ in range(4))])
    low, high = keys.get("stop_lower", -math.inf), keys.get("stop_upper", math.inf)
    keys["x0"] = min(max(keys["x0"], low + 0.01), high - 0.01)
    if draw.random() < 0.3:
        keys["stiffness"] = draw.choice([0.0, -draw.uniform(0.05, 0.5)])
    if draw.random() < 0.3:
        keys["friction"] = logarithmic(draw, 0.01, 0.3)
        keys["friction_static"] = keys["friction"] * draw.choice([1.0, draw.uniform(1, 1.5)])
    return keys


def carrying_scenes_beside_stops(count, seed):
    draw = random.Random(f"loose beside stops {seed}")
    return [beside_stops(draw, keys) for keys in carrying_scenes(count, seed)]


def rubbing(draw, keys):
    """The same with dry friction between the loose mass and its housing."""
    keys = {name: value for name, value in keys.items() if name != "base_amplitude"}
    push = max(abs(keys["loose_load"]), abs(keys["f"]) / (1 + keys["loose_mass"]))
    keys["loose_friction"] = keys["loose_mass"] * push * logarithmic(draw, 0.03, 0.7)
    if draw.random() < 0.5:
        keys["loose_friction_static"] = keys["loose_friction"] * draw.uniform(1, 1.5)
    return keys


def rubbing_scenes(count, seed):
    """Half of them between stops of the main mass."""
    draw = random.Random(f"rubbing {seed}")
    scenes = carrying_scenes(count // 2, seed) + carrying_scenes_beside_stops(count - count // 2, seed)
    return [rubbing(draw, keys) for keys in scenes]
