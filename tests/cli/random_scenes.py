"""Random scenes of all effects together, and the same motion written in other ways."""

import itertools
import math
import random
from dataclasses import dataclass

from force_scenes import ORDERS, Force
from restitution_scenes import LAWS, SPEEDS, Laws, logarithmic

INF = math.inf
SIZES = ("f", *(f"f_{j}" for j in ORDERS))  # of the force


@dataclass
class Scene(Laws, Force):
    """A scene in units of its own; stops at infinity aren't there, those of infinite stiffness are rigid."""

    h: float = 0.0
    f: float = 0.0
    nu: float = 1.0
    phase: float = 0.0
    load: float = 0.0
    stiffness: float = 1.0
    stop_lower: float = -INF
    stop_upper: float = INF
    R_lower: float = 1.0
    R_upper: float = 1.0
    x0: float = 0.0
    v0: float = 0.0
    stop_amplitude: float = 0.0
    base_amplitude: float = 0.0
    stop_stiffness_lower: float = INF
    stop_stiffness_upper: float = INF
    stop_damping_lower: float = 0.0
    stop_damping_upper: float = 0.0
    stop_phase: float = 0.0
    friction: float = 0.0
    friction_static: float = 0.0  # 0: as large as the friction
    loose_mass: float = 0.0
    loose_lower: float = -INF
    loose_upper: float = INF
    loose_R_lower: float = 1.0
    loose_R_upper: float = 1.0
    loose_load: float = 0.0
    loose_x0: float = 0.0
    loose_v0: float = 0.0

    def changed(self, **values):
        return Scene(**{**self.__dict__, **values})

    def mirrored(self):
        def swapped(name):
            return getattr(self, name + "_upper"), getattr(self, name + "_lower")

        changes = {name: 0.0 - getattr(self, name) for name in (*SIZES, "load", "x0", "v0")}
        changes |= {name: -getattr(self, name) for name in ("stop_amplitude", "base_amplitude")}
        changes |= {name: 0.0 - getattr(self, name) for name in ("loose_load", "loose_x0", "loose_v0")}
        changes["stop_lower"], changes["stop_upper"] = -self.stop_upper, -self.stop_lower
        changes["loose_lower"], changes["loose_upper"] = -self.loose_upper, -self.loose_lower
        for name in ("R", "stop_stiffness", "stop_damping", "loose_R", *LAWS):
            changes[name + "_lower"], changes[name + "_upper"] = swapped(name)
        return self.changed(**changes)

    def scaled(self, size):
        names = (*SIZES, "load", "x0", "v0", "stop_lower", "stop_upper", "stop_amplitude", "base_amplitude")
        names += ("friction", "friction_static")
        names += ("loose_lower", "loose_upper", "loose_load", "loose_x0", "loose_v0", *SPEEDS)
        return self.changed(**{name: size * getattr(self, name) for name in names}, **self.tables_in(size))

    def shifted(self, place):
        moved = {name: getattr(self, name) + place for name in ("x0", "stop_lower", "stop_upper")}
        return self.changed(load=self.load + self.stiffness * place, **moved)

    def in_time(self, faster):
        """The same motion in units of time that are shorter by so much."""
        changes = {name: getattr(self, name) / faster for name in ("h", "nu", "v0", "loose_v0", *SPEEDS)}
        squares = (*SIZES, "load", "stiffness", "stop_stiffness_lower", "stop_stiffness_upper")
        squares += ("friction", "friction_static", "loose_load")
        changes |= {name: getattr(self, name) / faster**2 for name in squares}
        return self.changed(**changes, **self.tables_in(1 / faster))

    def turned(self):
        """The same motion of stops or base, half a turn ahead with the other sign."""
        changes = {name: -getattr(self, name) for name in ("stop_amplitude", "base_amplitude")}
        return self.changed(stop_phase=self.stop_phase + math.pi, **changes)

    def is_unforced(self):
        return self.f == 0 and self.stop_amplitude == 0 and self.base_amplitude == 0


def drawn(draw):
    """A scene of any effects, also at their ends."""

    def stop():
        if draw.random() < 0.4:
            return 1.0, logarithmic(draw, 1, 1e5), draw.choice([0.0, logarithmic(draw, 1e-3, 1.5)])
        R = draw.choice([draw.uniform(0.1, 0.95), draw.uniform(0.3, 0.9), 0.0, 1.0, 1 - logarithmic(draw, 0.01, 0.1)])
        return R, INF, 0.0

    scene = Scene()
    weak = draw.random() < 0.2  # nearly nothing but the load
    scene.stiffness = draw.choice([1.0, 1.0, logarithmic(draw, 0.1, 10), -logarithmic(draw, 0.01, 0.3), 0.0])
    scene.h = draw.choice([0.0, logarithmic(draw, 1e-3, 0.5), logarithmic(draw, 1e-3, 0.5), draw.uniform(0.5, 2)])
    scene.f = draw.choice([-1, 1]) * draw.choice([1.0, logarithmic(draw, 0.03, 3)])
    scene.nu = logarithmic(draw, 0.3, 3)
    scene.phase = draw.choice([0.0, draw.uniform(-math.pi, math.pi)])
    scene.load = draw.choice([0.0, draw.uniform(-0.5, 0.5), draw.uniform(-2, 2)])
    if weak:
        small = [0.0, 1e-12, 1e-8, 1e-5, 1e-3]
        scene.stiffness, scene.h, scene.f = draw.choice(small), draw.choice(small), draw.choice(small)
        scene.load = draw.choice([-1, 1]) * draw.uniform(0.3, 3)
    gap = logarithmic(draw, 0.2, 3)
    middle = draw.choice([0.0, draw.uniform(-0.5, 0.5)])
    scene.R_lower, scene.stop_stiffness_lower, scene.stop_damping_lower = stop()
    scene.R_upper, scene.stop_stiffness_upper, scene.stop_damping_upper = stop()
    scene.stop_lower, scene.stop_upper = middle - gap / 2, middle + gap / 2
    only = draw.choice(["both", "both", "lower", "upper"])
    if weak:
        only = "lower" if scene.load < 0 else "upper"
    if only == "upper":
        scene.stop_lower, scene.R_lower = -INF, 1.0
        scene.stop_stiffness_lower, scene.stop_damping_lower = INF, 0.0
    if only == "lower":
        scene.stop_upper, scene.R_upper = INF, 1.0
        scene.stop_stiffness_upper, scene.stop_damping_upper = INF, 0.0
    low, high = max(scene.stop_lower, middle - 2), min(scene.stop_upper, middle + 2)
    scene.x0 = draw.choice([draw.uniform(low, high)] * 4 + [low, high])
    if math.isfinite(scene.stop_stiffness_lower) and draw.random() < 0.2:
        scene.x0 = low - draw.uniform(0, 0.2)
    scene.v0 = draw.choice([0.0, draw.uniform(-2, 2), draw.uniform(-2, 2)])
    if not weak and draw.random() < 0.15 and scene.stiffness != 0:
        scene.base_amplitude = draw.uniform(0.1, 0.5)
        scene.f = draw.choice([0.0, scene.f])
    elif not weak and draw.random() < 0.15:
        scene.stop_amplitude = draw.uniform(0.05, 0.3)
    if scene.base_amplitude or scene.stop_amplitude:
        scene.stop_phase = random.Random(scene.v0).choice([0.0, scene.phase, 2.0, -2.5])
    return scene


def random_scenes(count, seed):
    draw = random.Random(seed)
    return [drawn(draw) for _ in range(count)]


def rubbed(draw, scene):
    """The scene with dry friction, up to nearly as much as holds the mass; not between stops that move."""
    if scene.stop_amplitude:
        return scene
    force = max(abs(scene.f), abs(scene.base_amplitude * scene.stiffness), abs(scene.load) / 10) or 1.0
    friction = force * draw.choice([draw.uniform(0.02, 0.7), draw.uniform(0.02, 0.7), logarithmic(draw, 1e-6, 1)])
    static = draw.choice([0.0, friction, friction * draw.uniform(1, 1.6)])
    return scene.changed(friction=friction, friction_static=static)


def rough_scenes(count, seed):
    """Those of `random_scenes`, a quarter of them with dry friction."""
    draw = random.Random(f"friction {seed}")
    scenes = random_scenes(count, seed)
    return [rubbed(draw, scene) if draw.random() < 0.25 else scene for scene in scenes]


def rubbed_scenes(count, seed):
    """Those of `random_scenes` that may have dry friction, all with it."""
    draw = random.Random(f"friction {seed}")
    return [rubbed(draw, scene) for scene in random_scenes(count, seed) if not scene.stop_amplitude]


def compliant(draw):
    """Strongly damped soft stops: contacts that are interrupted, and a mass that a load presses into one."""
    gap = logarithmic(draw, 0.1, 2)
    scene = Scene(h=draw.choice([0.0, logarithmic(draw, 1e-3, 0.5)]), nu=draw.uniform(1, 8), f=draw.uniform(0.3, 8))
    scene.stop_lower = -gap
    scene.stop_stiffness_lower, scene.stop_damping_lower = logarithmic(draw, 1.2, 100), draw.uniform(0.5, 5)
    scene.load = -draw.uniform(0, 1) * (1 + gap)
    scene.x0, scene.v0 = draw.uniform(-gap, 0.4 * gap), draw.uniform(-2, 2)
    if draw.random() < 0.5:
        scene.stop_upper = gap * draw.uniform(0.5, 2)
        scene.stop_stiffness_upper, scene.stop_damping_upper = logarithmic(draw, 1.2, 100), draw.uniform(0.5, 5)
    elif draw.random() < 0.5:
        scene.load = -gap - scene.f * draw.uniform(0.3, 1.5)
    return scene


def compliant_scenes(count, seed):
    draw = random.Random(seed)
    return [compliant(draw) for _ in range(count)]


def close_scenes(count, seed):
    """Rigid stops that are close to each other, so that a step passes both."""
    draw = random.Random(seed)
    scenes = []
    for _ in range(count):
        scene = Scene(h=draw.choice([0.0, logarithmic(draw, 1e-3, 0.5)]), nu=logarithmic(draw, 0.3, 3))
        scene.f, scene.load = draw.choice([-1, 1]) * logarithmic(draw, 0.03, 3), draw.uniform(-1, 1)
        scene.stop_lower = draw.uniform(-0.5, 0.5)
        scene.stop_upper = scene.stop_lower + logarithmic(draw, 0.01, 0.2)
        scene.R_lower, scene.R_upper = draw.uniform(0.5, 1), draw.uniform(0.5, 1)
        scene.x0 = draw.uniform(scene.stop_lower, scene.stop_upper)
        scene.v0 = draw.choice([-1, 1]) * draw.uniform(0.5, 2)
        scenes.append(scene)
    return scenes


def pressing_scenes(count, seed):
    """A fast force, and a load that presses the mass on a stop: chatter that contracts errors, and flights that stretch
    them again."""
    draw = random.Random(seed)
    scenes = []
    for _ in range(count):
        scene = Scene(h=draw.choice([0.0, logarithmic(draw, 1e-3, 0.5)]), nu=logarithmic(draw, 2, 12), stop_lower=0.0)
        scene.f, scene.phase = logarithmic(draw, 0.3, 3), draw.uniform(-math.pi, math.pi)
        scene.load, scene.R_lower = -scene.f * draw.uniform(0.2, 1.3), 1 - logarithmic(draw, 0.01, 0.6)
        scene.x0, scene.v0 = draw.uniform(0, 0.3), draw.uniform(-1, 1)
        scenes.append(scene)
    return scenes


def followed_scenes(count, seed):
    """Forced ones, at rest in the ground's frame."""
    draw = random.Random(seed)
    scenes = []
    while len(scenes) < count:
        scene = drawn(draw)
        if abs(scene.f) > 1e-2 and not scene.base_amplitude and not scene.stop_amplitude and scene.h > 1e-3:
            scenes.append(scene)
    return scenes


def slipping_scenes(count, seed):
    """Dry friction between rigid stops that the mass reaches or not; its static level is the other one, or above it."""
    draw = random.Random(seed)
    scenes = []
    for _ in range(count):
        scene = Scene(h=draw.choice([0.0, logarithmic(draw, 1e-3, 0.3)]), nu=logarithmic(draw, 0.3, 3))
        scene.f, scene.stiffness = draw.choice([-1, 1]), draw.choice([1.0, 1.0, logarithmic(draw, 0.2, 3)])
        scene.load, gap = draw.choice([0.0, 0.0, draw.uniform(-0.3, 0.3)]), logarithmic(draw, 0.3, 6)
        middle = draw.choice([0.0, scene.load / scene.stiffness])
        scene.stop_lower, scene.stop_upper = middle - gap / 2, middle + gap / 2
        scene.R_lower = scene.R_upper = draw.uniform(0.3, 0.95)
        if draw.random() < 0.3:
            scene.stop_lower, scene.R_lower = -INF, 1.0
        scene.x0, scene.v0 = draw.uniform(middle - gap / 2, middle + gap / 2), draw.uniform(-1, 1)
        scene.friction = logarithmic(draw, 0.02, 0.6)
        if draw.random() < 0.2:
            scene.friction_static = scene.friction * draw.uniform(1, 1.5)
        scenes.append(scene)
    return scenes


def rubbing_scenes(count, seed):
    """Dry friction as between rigid stops, of which one or both are soft."""
    draw = random.Random(seed)
    scenes = slipping_scenes(count, seed)
    for scene in scenes:
        stiffness, damping = logarithmic(draw, 1, 300), draw.choice([0.0, logarithmic(draw, 0.01, 1)])
        for side in draw.choice([("_lower", "_upper"), ("_lower", "_upper"), ("_upper",), ("_lower",)]):
            if math.isfinite(getattr(scene, "stop" + side)):
                setattr(scene, "stop_stiffness" + side, stiffness)
                setattr(scene, "stop_damping" + side, damping)
                setattr(scene, "R" + side, 1.0)
    return scenes


def carrying_scenes(count, seed):
    """A loose mass, mostly light, between two walls, alike or not, or before one that a load drives it to."""
    draw = random.Random(seed)
    scenes = []
    for _ in range(count):
        scene = Scene(h=logarithmic(draw, 2e-3, 0.2), nu=logarithmic(draw, 0.3, 3), f=draw.choice([-1, 1]))
        scene.stiffness = draw.choice([1.0, 1.0, logarithmic(draw, 0.3, 3)])
        scene.load, scene.loose_mass = draw.choice([0.0, draw.uniform(-0.5, 0.5)]), logarithmic(draw, 5e-3, 0.5)
        scene.phase, scene.loose_R_lower = draw.choice([0.0, draw.uniform(-math.pi, math.pi)]), draw.uniform(0.3, 0.95)
        scene.loose_R_upper = draw.choice([scene.loose_R_lower, draw.uniform(0.3, 0.95)])
        detuning = math.hypot(scene.stiffness - scene.nu**2, 2 * scene.h * scene.nu)
        gap = draw.uniform(0.5, 4) / max(0.05, detuning)
        scene.loose_lower, scene.loose_upper = draw.choice([(-gap, gap), (-gap, gap), (0.0, gap), (-gap, 2 * gap)])
        scene.loose_load = draw.choice([0.0, 0.0, draw.uniform(-0.2, 0.2)])
        if draw.random() < 0.25:
            scene.loose_lower, scene.loose_upper, scene.loose_load = 0.0, INF, -logarithmic(draw, 0.05, 0.5)
        scene.loose_x0 = draw.uniform(scene.loose_lower, min(scene.loose_upper, scene.loose_lower + 2 * gap))
        scene.x0, scene.v0, scene.loose_v0 = draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)
        scenes.append(scene)
    return scenes


def bumping_scenes(count, seed):
    """Those with stops of the main mass, rigid and soft, held by a spring or not."""
    draw = random.Random(seed)
    scenes = []
    for scene in carrying_scenes(count, seed):
        scene.stiffness = draw.choice([scene.stiffness, scene.stiffness, 0.0, -draw.uniform(0.1, 0.5)])
        reach = logarithmic(draw, 0.1, 1) / max(
            0.1, math.hypot(scene.stiffness - scene.nu**2, 2 * scene.h * scene.nu)
        )
        scene.stop_lower, scene.stop_upper = -reach, draw.choice([reach, 2 * reach])
        if scene.stiffness > 0 and draw.random() < 0.3:
            scene.stop_lower = -INF
        for side in ("lower", "upper"):
            kappa, zeta = draw.uniform(2, 50) * max(1, scene.nu**2), draw.choice([0.0, draw.uniform(0.02, 0.7)])
            if not math.isfinite(getattr(scene, f"stop_{side}")):
                continue
            soft = draw.random() < 0.4
            changes = {"stop_stiffness": kappa, "stop_damping": zeta} if soft else {"R": draw.uniform(0.3, 0.95)}
            scene = scene.changed(**{f"{key}_{side}": value for key, value in changes.items()})
        low = max(-1, scene.stop_lower)
        scenes.append(scene.changed(x0=draw.uniform(low, min(1, scene.stop_upper))))
    return scenes


def weak_scenes():
    """A mass that a load presses on a stop, all else from nothing to as strong as the load; one stop and two."""
    strengths = (0.0, 1e-12, 1e-8, 1e-4, 1e-2, 1.0)
    scenes = []
    for i, (k, h, f) in enumerate(itertools.product(strengths, repeat=3)):
        scene = Scene(stiffness=k, h=h, f=f, nu=(0.7, 1.0, 1.9)[i % 3], load=-1.5, stop_lower=0.0, x0=0.3, v0=-1.0)
        scene.R_lower = scene.R_upper = (0.3, 0.5, 0.7)[i // 3 % 3]
        scenes += [scene, scene.changed(stop_upper=(0.4, 0.31)[i % 2])]
    return [s if math.isfinite(s.stop_upper) else s.changed(R_upper=1.0) for s in scenes]


def is_beyond_soft(s):
    return x_beyond(s.x0, s.stop_lower, s.stop_stiffness_lower, -1) or x_beyond(
        s.x0, s.stop_upper, s.stop_stiffness_upper, 1
    )


def x_beyond(x, stop, stiffness, sign):
    return math.isfinite(stiffness) and sign * (x - stop) >= 0
