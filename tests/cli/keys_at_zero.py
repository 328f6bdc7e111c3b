"""A key at zero gives what it gives at 1e-9, but for 1e-9 times a derivative; and so do the derivatives themselves.

Formulas branch where a key is zero: no damping, no spring, nothing shaken, a stop at zero. Scenes settle with one key
at zero; from where they settled, they are run again so and with the key at 1e-9, and all that is told is compared, the
derivatives by all keys included. A sweep that is followed along the force begins without any or with one of 1e-100.
"""

import math
import random
import tempfile

import numpy as np
from coincidences import IN_LANES, Failures, Way, contracts, differences, machine, run
from random_scenes import carrying_scenes, compliant_scenes, is_beyond_soft, logarithmic, rubbed
from scene_runs import Program, keys_of, numbers, sizes
from starts_on_contacts import alike, bouncing, driven

SMALL = 1e-9
FAINT = 1e-100
LONGEST = 8  # forcing periods; motion that rests once in many stretches changes in between
OBSERVED = IN_LANES + "energy = true\ntrajectory = 2\n"
ANY_SIGN = ("load", "loose_load", "stop_amplitude", "base_amplitude", "stop_phase", "stiffness", "f", "place")
STARTS = ("x0", "v0", "phase", "loose_x0", "loose_v0")


def between_stops(draw):
    """Without friction, and nothing shaken."""
    scene = draw.choice([driven, alike, bouncing])(draw)
    return scene.changed(stop_amplitude=0.0, base_amplitude=0.0, stop_phase=0.0, f=scene.f or 1.0)


def losing(draw, scene):
    """With rigid stops that take energy."""
    return scene.changed(
        **{"R" + side: draw.uniform(0.2, 0.8) for side in ("_lower", "_upper") if of_rigid(scene, side)}
    )


def of_rigid(scene, side):
    return math.isfinite(getattr(scene, "stop" + side)) and math.isinf(getattr(scene, "stop_stiffness" + side))


def moved_to_zero(draw, scene):
    """The scene with one of its stops at 0."""
    stop = draw.choice([stop for stop in (scene.stop_lower, scene.stop_upper) if math.isfinite(stop)])
    moved = scene.shifted(-stop)
    return moved.changed(**{name: 0.0 for name in ("stop_lower", "stop_upper") if getattr(scene, name) == stop})


def with_zero(draw, key, count, seed):
    """A scene that may have the key, which is zero in it."""
    if key == "loose_load":
        return next(iter(carrying_scenes(1, draw.random()))).changed(loose_load=0.0)
    if key.startswith("stop_damping"):
        scene = compliant_scenes(1, draw.random())[0]
        soft = math.isfinite(getattr(scene, "stop_stiffness" + key[-6:]))
        return scene.changed(**{key: 0.0}) if soft else with_zero(draw, "h", count, seed)
    scene = losing(draw, between_stops(draw))
    if key in ("stop_phase", "f"):
        scene = scene.changed(stop_amplitude=draw.choice([-1, 1]) * logarithmic(draw, 0.03, 0.3), stop_phase=1.0)
        if scene.stiffness != 0 and draw.random() < 0.5:
            scene = scene.changed(stop_amplitude=0.0, base_amplitude=scene.stop_amplitude)
    if key == "place":
        return moved_to_zero(draw, rubbed(draw, scene) if draw.random() < 0.5 else scene)
    zeros = {key: 0.0}
    if key in ("h", "stop_amplitude", "load") and draw.random() < 0.3:
        zeros["stiffness"] = 0.0
    if key in ("stiffness", "stop_amplitude", "stop_phase") and draw.random() < 0.3:
        zeros["h"] = 0.0
    if key == "h" and draw.random() < 0.3:
        zeros["stop_amplitude"] = logarithmic(draw, 0.03, 0.3)
    return scene.changed(**zeros)


KEYS = "h load stop_amplitude stiffness place friction base_amplitude stop_phase f loose_load".split()
KEYS += ["h", "stop_damping_lower"]


def zero_scenes(count, seed):
    """(key, scene) of each kind in turn."""
    draw = random.Random(f"zero {seed}")
    return [(KEYS[i % len(KEYS)], with_zero(draw, KEYS[i % len(KEYS)], count, seed)) for i in range(count)]


class Zeros:
    """Runs scenes with a key at zero and beside it, and keeps the differences."""

    def __init__(self, program, keyed, seed=0):
        self.keyed, self.failures, self.draw = keyed, Failures(), random.Random(f"zeros {seed}")
        with tempfile.TemporaryDirectory() as folder:
            self.program = Program(program, folder)
            kinds = {}
            for i, (key, scene) in enumerate(keyed):
                kinds.setdefault((key, *keys_of(scene)), []).append(i)
            for number, ((key, *_), points) in enumerate(kinds.items()):
                self.compare(key, points, machine() if number % 3 == 2 else Way())
            for i, (_, scene) in enumerate(keyed):
                if i % 4 == 0 and not scene.is_unforced():
                    self.follow(i, scene)

    @staticmethod
    def with_key(way, key):
        """The way in which the key is written, also where it is zero."""

        def keys(scene):
            names = [key] if key != "place" else []
            explicit = scene.changed(**{name: 1.0 for name in names if getattr(scene, name) == 0})
            values = way.keys_of(explicit)
            own = {"h": "damping", "f": "force"}.get(key, key) if way.mass != 1 else key
            if names and getattr(scene, key) == 0:
                values[own] = 0.0
            return values

        return Way(way.section, keys, way.mass)

    def compare(self, key, points, way):
        way = self.with_key(way, key)
        scenes = [self.keyed[i][1] for i in points]
        names = [name for name in way.keys_of(scenes[0]) if name not in STARTS]
        observe = f"{OBSERVED}sensitivity = \"{', '.join(names)}\"\n"
        settled = run(self.program, scenes, observe, way=way)
        found = [k for k in range(len(points)) if contracts(settled, k) and settled["period_ratio"][k] <= LONGEST]
        found = [k for k in found if not is_slight(settled, k, scenes[k])]
        begun = [self.at(scenes[k], settled, k) for k in found]
        found = [k for k, scene in zip(found, begun) if scene]
        begun = [scene for scene in begun if scene]
        if not begun:
            return
        sign = self.draw.choice([-1, 1]) if key in ANY_SIGN else 1

        def beside(step):
            step *= sign * SMALL
            changed = [scene.shifted(step) if key == "place" else scene.changed(**{key: step}) for scene in begun]
            return run(self.program, changed, observe, way=way)

        zero, near, farther = run(self.program, begun, observe, way=way), beside(1), beside(2)
        for j, k in enumerate(found):
            self.failures.compared += 1
            for text in self.told(near, zero, farther, j):
                both = way.configuration(begun[j], observe)
                self.failures.add(
                    f"{key} at zero", points[k], text.replace(" for ", f" at {key} = {SMALL}, and at 0 "), both
                )

    @staticmethod
    def told(near, zero, farther, j):
        """What differs from the value beside zero and from that on the straight line through two beside it: a result
        that changes fast differs by more than rounding.
        """
        for runs in (near, zero, farther):  # a load takes the symmetry; the residual is rounding
            runs.values.pop("symmetric", None), runs.values.pop("energy_residual", None)
        plain = [name for name in zero.values if not name.startswith("d_")]
        slopes = sorted(set(zero.values) - set(plain))
        stretched = max(np.nan_to_num(np.abs(near[name][j])).max() for name in slopes)
        line = on_line(near, farther)
        told, off_line = (
            differences(runs, j, only(zero, plain), j, allowed=1e-6 + 10 * SMALL * stretched) for runs in (near, line)
        )
        told = [text for text in told if text.split()[0] in {other.split()[0] for other in off_line}]
        if near["impact_word"][j] != zero["impact_word"][j]:
            return told
        size = sizes(zero, "x")[j] + sizes(zero, "v")[j]
        for name in slopes:
            mine, its = np.atleast_1d(near[name][j]), np.atleast_1d(zero[name][j])
            unknown = np.isnan(mine) & np.isnan(its)
            off = np.minimum(np.abs(mine - its), np.abs(np.atleast_1d(line[name][j]) - its))
            far = off > 1e-4 * (np.abs(its) + size)
            if np.any(np.isnan(mine) != np.isnan(its)) or (stretched < 1e3 * (1 + size) and np.any(far & ~unknown)):
                told.append(f"{name} {mine} for {its}")
        return told

    @staticmethod
    def at(scene, runs, k):
        """The scene from where it settled; None if a stop may count that place as another."""
        begun = scene.changed(x0=float(runs["x"][k, 0]), v0=float(runs["v"][k, 0]))
        if scene.loose_mass:
            begun = begun.changed(loose_x0=float(runs["z"][k, 0]), loose_v0=float(runs["w"][k, 0]))
            clear = scene.loose_lower < begun.loose_x0 < scene.loose_upper
            return begun if clear else None
        clear = scene.stop_lower + 1e-6 < begun.x0 < scene.stop_upper - 1e-6
        return begun if clear and not is_beyond_soft(begun) else None

    def follow(self, i, scene):
        """A followed transient ends alike after a point without a force and after one with a faint one."""
        time = 'mode = "transient"\nduration = 3.7\n'
        fixed = "".join(f"{key} = {value!r}\n" for key, value in keys_of(scene).items() if key != "f")
        ends = []
        for first in (0.0, FAINT):
            sweep = f'[scene]\n{fixed}[sweep]\nf = {numbers([first, scene.f])}\nfollow = "f"\n'
            observe = "[observe]\nextrema = true\nimpact_log = true\ntrajectory = 2\n"
            ends.append(self.program.points(sweep, 2, time, observe))
            text = f"# clatter run FILE\n{sweep}[time]\n{time}{observe}"
        self.failures.compared += 1
        for name in ("x_min", "x_max", "x", "v"):
            mine, its = np.array(ends[0][name][1], float), np.array(ends[1][name][1], float)
            if not np.allclose(mine, its, rtol=1e-7, atol=1e-9, equal_nan=True):
                self.failures.add("follow from no force", i, f"{name} {mine}, after f = {FAINT} {its}", text)


def is_slight(runs, i, scene):
    """Whether a contact lasts by rounding alone. Without spring and load a mass comes ever nearer to the graze of its
    soft stop: no motion with a contact repeats, as the stop only pushes; and without one it may be anywhere. The push
    is lost in the rounding of the velocity at a speed of 1e-5 of that already.
    """
    slight = 1e-5 if scene.stiffness == scene.load == 0 else 1e-7
    return bool(np.any(runs["impact_speed"][i] < slight * sizes(runs, "v")[i]))


def on_line(near, farther):
    """The runs at zero, if all numbers changed by as much from there to `near` as from there to `farther`."""
    values = {}
    for name, mine in near.values.items():
        its = farther.values[name]
        is_number = getattr(mine, "dtype", None) == float and mine.shape == getattr(its, "shape", None)
        with np.errstate(invalid="ignore"):  # -inf: the exponent of motion that rests
            values[name] = 2 * mine - its if is_number else mine
    return type(near)(values, near.logs)


def only(runs, names):
    """The runs with some of their results."""
    return type(runs)({name: runs[name] for name in names}, runs.logs)
