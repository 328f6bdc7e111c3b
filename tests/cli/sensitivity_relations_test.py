"""Derivatives of periodic motion by keys of the scene: `observe.sensitivity`.

They satisfy what the units of length, time and mass demand of them (Euler's theorem on homogeneous functions), and are
the limits of differences of runs. At values at which a formula branches they are those beside them. Scenes are random;
CLATTER_SENSITIVITY is COUNT or COUNT:SEED of them.
"""

import math
import os
import random
import unittest

import numpy as np
from derivatives import OF_MACHINE, OF_SCENE, PERIODIC, RESULTS, SETTLE, SIDES, STARTS, Family, OfScenes
from derivatives import derivative, families, same_motion
from force_scenes import driven
from random_scenes import INF, compliant_scenes, pressing_scenes, random_scenes, rubbed
from restitution_scenes import by_speed
from scene_runs import STEADY, keys_of, machine_keys

COUNT, _, SEED = os.environ.get("CLATTER_SENSITIVITY", "90").partition(":")
COUNT, SEED = int(COUNT), int(SEED or 461)


def drawn(count, seed):
    """Forced scenes of any effects, some that rest, some between soft stops; a third with dry friction."""
    draw = random.Random(f"friction {seed}")
    scenes = random_scenes(count, seed) + pressing_scenes(count // 6, seed) + compliant_scenes(count // 6, seed)
    scenes = [rubbed(draw, scene) if draw.random() < 0.33 else scene for scene in scenes]
    return [scene for scene in scenes if not scene.is_unforced() and abs(scene.f) >= 0.02]


class Relations(OfScenes):
    drawn, count = staticmethod(drawn), COUNT

    def test_the_units_of_length_time_and_mass_may_change(self):
        for scenes in families(self.drawn(self.count, SEED)):
            self.check_scaling(Family(self.program, scenes), scenes, OF_SCENE, 0)
            if any(scene.base_amplitude or scene.stop_amplitude for scene in scenes):
                absolute = Family(self.program, scenes, observe='frame = "absolute"\n')
                self.check_scaling(absolute, scenes, OF_SCENE, 0)
        mass = 0.3
        for scenes in families(self.drawn(self.count // 3, SEED + 1), machine_keys(mass)):
            family = Family(self.program, scenes, f"[machine]\nmass = {mass}\n", machine_keys(mass))
            self.check_scaling(family, scenes, OF_MACHINE, mass)
        self.assertEqual(self.told(), "")
        self.assertGreater(self.compared, 8 * self.count)
        springless = [text for text in self.unknown if "stiffness=0.0," in text]  # free to drift without impacts
        self.assertEqual([text for text in self.unknown if text not in springless], [])
        self.assertLess(len(springless), 0.1 * self.compared)

    def test_they_are_the_limits_of_differences(self):
        """By one key of each scene, from runs that begin on the motion itself; to four orders in the step."""
        sharp = rough = 0
        for n, scenes in enumerate(families(self.drawn(self.count, SEED + 2))):
            frame = 'frame = "absolute"\n' if scenes[0].base_amplitude or scenes[0].stop_amplitude else ""
            family = Family(self.program, scenes, observe=frame)
            key = family.keys[n % len(family.keys)]
            found = [i for i in range(len(scenes)) if family.runs["status"][i] == PERIODIC]
            found = [i for i in found if not math.isnan(family.runs["period"][i])]
            starts = [started(scenes[i], family.runs["x"][i, 0], family.runs["v"][i, 0], frame) for i in found]
            steps = [1e-4 * max(0.05, abs(getattr(scene, attribute(key)))) for scene in starts]
            moved = [[moved_by(s, key, side * d) for side in SIDES] for s, d in zip(starts, steps)]
            kept = [j for j in range(len(found)) if all(map(permitted, moved[j]))]
            if not kept:
                continue
            observe = STEADY + frame + ("word_sticks = true\n" if scenes[0].friction else "")
            sides = {
                side: self.program.run(
                    [moved[j][n] for j in kept], SETTLE, observe, keys_of=lambda s: keys_of_kind(s, starts[0])
                )
                for n, side in enumerate(SIDES)
            }
            for n, j in enumerate(kept):
                i = found[j]
                if key == "stiffness" and scenes[i].stiffness == 0:
                    continue
                by_it = self.compare_differences(family.runs, i, key, sides, n, steps[j], scenes[i])
                sharp += by_it
                rough += by_it if scenes[i].friction else 0
        self.assertEqual(self.told(), "")
        self.assertGreater(sharp, self.count // 2)
        self.assertGreater(rough, self.count // 8)


class OfRestitutionBySpeed(Relations):
    count = COUNT // 2

    @staticmethod
    def drawn(count, seed):
        return by_speed(drawn(count, seed), seed, tables=0)  # they have no derivatives by their speeds


class UnderForcesInPieces(Relations):
    count = COUNT // 2

    @staticmethod
    def drawn(count, seed):
        return driven(drawn(count, seed), seed)


class OfRandomScenes(Relations):
    def test_friction_that_begins(self):
        """Derivatives by the friction at 0, by differences to one side of it."""
        scenes = [scene for scene in drawn(COUNT, SEED + 3) if not scene.stop_amplitude and not scene.friction]
        wanted = STEADY + 'sensitivity = "friction"\n'
        runs, sharp = self.program.run(scenes, SETTLE, wanted), 0
        found = [i for i in range(len(scenes)) if runs["status"][i] == PERIODIC and not math.isnan(runs["period"][i])]
        starts = [started(scenes[i], runs["x"][i, 0], runs["v"][i, 0], "") for i in found]
        steps = [1e-5 * max(0.05, abs(scene.f)) for scene in starts]
        some = [
            self.program.run([s.changed(friction=n * d) for s, d in zip(starts, steps)], SETTLE, STEADY)
            for n in (1, 2, 4)
        ]
        for j, i in enumerate(found):
            sharp += self.compare_begun(runs, i, some, j, steps[j], scenes[i])
        self.assertEqual(self.told(), "")
        self.assertGreater(sharp, COUNT // 4)

    def compare_begun(self, runs, i, some, j, step, scene):
        """How many derivatives the differences to one side confirm."""
        contraction = 1 - abs(complex(runs["multiplier_re"][i, 0], runs["multiplier_im"][i, 0]))
        if not contraction > 1e-2 or not all(same_motion(run, j, runs, i) for run in some):
            return 0
        confirmed = 0
        for result in RESULTS:
            zero, *at = [np.atleast_1d(run[result][k]) for run, k in [(runs, i)] + [(run, j) for run in some]]
            told = np.atleast_1d(derivative(runs, result, "friction")[i])
            slopes = [(value - zero) / (n * step) for n, value in zip((1, 2, 4), at)]
            near, far = 2 * slopes[0] - slopes[1], 2 * slopes[1] - slopes[2]
            for own, one, other, size in zip(told, near, far, np.abs(zero)):
                rounding = 1e-10 * (size + 1e-3) / contraction / step
                if math.isnan(one) or math.isnan(other) or abs(one - other) > 1e-2 * abs(one) + rounding:
                    continue
                allowed = 2 * abs(one - other) + rounding
                self.check(abs(own - one), allowed, f"{result} by friction at 0, {scene}")
                confirmed += allowed < 1e-3 * abs(own)
        return confirmed


def soft(scene, **changes):
    """The scene with soft stops in place of rigid ones."""
    sides = [side for side in ("_lower", "_upper") if math.isfinite(getattr(scene, "stop" + side))]
    stops = {key + side: value for key, value in changes.items() for side in sides}
    return scene.changed(**{f"stop_stiffness{side}": 40.0 for side in sides}, **stops)


def unshaken(scene):
    return scene.changed(stop_amplitude=0.0, base_amplitude=0.0, stop_phase=0.0, f=scene.f or -0.7)


def without_spring(scene):
    """The scene between two stops, which hold it."""
    low = -0.5 if math.isinf(scene.stop_lower) else scene.stop_lower
    high = low + 1.1 if math.isinf(scene.stop_upper) else scene.stop_upper
    return unshaken(scene).changed(stiffness=0.0, stop_lower=low, stop_upper=high)


def dry(scene):
    return unshaken(scene).changed(friction=0.1 * abs(scene.f or 0.7))


# By name: a scene at a value at which a formula branches, the key that has it, the sides to which it may change, a step
SPECIAL = {
    "no damping": (lambda s: s.changed(h=0.0), "h", (1,), 1e-9),
    "no damping nor spring": (lambda s: without_spring(s).changed(h=0.0), "h", (1,), 1e-9),
    "no spring": (lambda s: without_spring(s).changed(h=max(s.h, 0.1)), "stiffness", (-1, 1), 1e-6),
    "no spring nor damping": (lambda s: without_spring(s).changed(h=0.0), "stiffness", (-1, 1), 1e-6),
    "critical damping": (lambda s: unshaken(s).changed(h=1.0, stiffness=1.0), "h", (-1, 1), 1e-9),
    "critical spring": (lambda s: unshaken(s).changed(h=0.5, stiffness=0.25), "stiffness", (-1, 1), 1e-9),
    "critical contact": (lambda s: soft(without_spring(s).changed(h=0.0), stop_damping=1.0), "h", (1,), 1e-9),
    "resonance": (lambda s: unshaken(s).changed(h=0.0, nu=1.0, stiffness=1.0), "nu", (-1, 1), 1e-9),
    "plastic stop": (lambda s: s.changed(R_upper=0.0, stop_stiffness_upper=INF), "R_upper", (1,), 1e-9),
    "elastic stop": (lambda s: s.changed(R_upper=1.0, h=max(s.h, 0.05)), "R_upper", (-1,), 1e-9),
    "undamped contact": (lambda s: soft(s.changed(h=max(s.h, 0.05))), "stop_damping_upper", (1,), 1e-9),
    "no load": (lambda s: s.changed(load=0.0), "load", (-1, 1), 1e-9),
    "stop at 0": (lambda s: s.changed(stop_upper=0.0, x0=min(s.x0, 0.0)), "stop_upper", (-1, 1), 1e-9),
    "stops at rest": (unshaken, "stop_amplitude", (-1, 1), 1e-9),
    "stops at rest, out of phase": (lambda s: unshaken(s).changed(stop_phase=2.0), "stop_amplitude", (-1, 1), 1e-9),
    "base at rest": (unshaken, "base_amplitude", (-1, 1), 1e-9),
    "base at rest, out of phase": (lambda s: unshaken(s).changed(stop_phase=-2.5), "base_amplitude", (-1, 1), 1e-9),
    "stops in phase": (lambda s: unshaken(s).changed(stop_amplitude=0.1), "stop_phase", (-1, 1), 1e-9),
    "base in phase": (lambda s: unshaken(s).changed(base_amplitude=-0.2), "stop_phase", (-1, 1), 1e-9),
    "stops undamped": (lambda s: unshaken(s).changed(stop_amplitude=0.2, h=0.0), "h", (1,), 1e-9),
    "no force beside a base": (lambda s: unshaken(s).changed(base_amplitude=0.3, f=0.0), "f", (-1, 1), 1e-9),
    "no friction": (unshaken, "friction", (1,), 1e-9),
    "equal levels": (lambda s: dry(s).changed(friction_static=dry(s).friction), "friction_static", (1,), 1e-9),
}


class AtSpecialValues(OfScenes):
    def test_derivatives_where_a_formula_branches_are_those_beside(self):
        each = max(9, COUNT // 16)
        known = {}
        for n, (name, (prepared, key, sides, step)) in enumerate(SPECIAL.items()):
            draw = random.Random(f"{SEED} {name}")
            scenes = [scene for scene in random_scenes(12 * each, SEED + 100 + n) if abs(scene.f) >= 0.02]
            scenes = [within_stops(one) for one in map(prepared, scenes) if is_whole(one, key)][:each]
            ways = [step * draw.choice(sides) for _ in scenes]
            near, far = ([within_stops(moved_by(s, key, n * way)) for s, way in zip(scenes, ways)] for n in (1, 2))
            kinds = {}
            for some in zip(scenes, near, far):
                kinds.setdefault(tuple(keys_of(some[1])), []).append(some)
            known[name] = sum(self.compare(zip(*kind), key, name) for kind in kinds.values())
        self.assertEqual(self.told(), "")
        self.assertEqual({name: count for name, count in known.items() if count < 8}, {})

    def compare(self, groups, key, name):
        """How many derivatives by all keys are the limits of those of scenes one and two steps beside."""
        scenes, near, far = groups
        keys = sorted({own for own in keys_of(near[0]) if own not in STARTS} | {key})
        frame = 'frame = "absolute"\n' if "amplitude" in key or "phase" in key else ""
        words = "word_sticks = true\n" if "friction" in keys and key != "friction" else ""
        wanted = f'{STEADY}{frame}{words}sensitivity = "{", ".join(keys)}"\n'
        here, *beside = (
            self.program.run(some, SETTLE, wanted, keys_of=lambda s: keys_of_kind(s, near[0]))
            for some in (scenes, near, far)
        )
        stops = [(s.stop_lower, s.stop_upper) if frame else () for s in scenes]
        return self.compare_limits(here, beside, keys, name, RESULTS, stops)


def is_whole(scene, key):
    """Whether a scene has the stop that a key is of, not beside another one that it would pass."""
    if key.endswith("_upper") and not math.isfinite(scene.stop_upper):
        return False
    rigid = math.isinf(scene.stop_stiffness_upper)
    if (key == "R_upper" and not rigid) or (key == "stop_damping_upper" and rigid):
        return False
    held = math.isfinite(scene.stop_lower) or math.isfinite(scene.stop_upper)
    return held and scene.stop_lower < scene.stop_upper - 0.05 and scene.stop_lower <= scene.x0


def moved_by(scene, key, step):
    return within_stops(scene.changed(**{attribute(key): getattr(scene, attribute(key)) + step}))


def attribute(key):
    """The number of a scene that a key gives."""
    return "f" if key == "force_factor" else key


def permitted(scene):
    sides = ("_lower", "_upper")
    numbers = [getattr(scene, name + side) for name in ("stop_damping",) for side in sides] + [scene.h]
    R = [getattr(scene, "R" + side) for side in sides]
    exponents = [getattr(scene, "R_exponent" + side) for side in sides]
    below = 0 < scene.friction_static < scene.friction
    may_rebound = all(p / (1 + p) <= of <= 1 for of, p in zip(R, exponents))
    has_shape = 0 < scene.force_duty < 1 and 0 < scene.force_rise <= 0.5
    return all(number >= 0 for number in numbers + exponents) and may_rebound and not below and has_shape


def started(scene, x, v, frame):
    """The scene from a state at its forcing phase, which is absolute if a frame is asked for."""
    amplitude, angle = scene.base_amplitude + scene.stop_amplitude, scene.phase + scene.stop_phase
    if frame:
        x, v = x - amplitude * math.sin(angle), v - amplitude * scene.nu * math.cos(angle)
    return within_stops(scene.changed(x0=x, v0=v))


def within_stops(scene):
    """The same scene, its start on a rigid stop that has moved over it."""
    low = scene.stop_lower if math.isinf(scene.stop_stiffness_lower) else -math.inf
    high = scene.stop_upper if math.isinf(scene.stop_stiffness_upper) else math.inf
    return scene.changed(x0=min(max(scene.x0, low), high))


def keys_of_kind(scene, first):
    """The keys of the first scene of a kind, also where a step leaves 0."""
    return {key: getattr(scene, attribute(key)) for key in keys_of(first)}


if __name__ == "__main__":
    unittest.main()
