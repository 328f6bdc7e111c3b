"""Sweeps with `follow` of which some points have no force: the phase of the force goes on by nu tau all the same.

Environment: CLATTER, the program.
"""

import math
import random
import unittest

import h5py
import numpy as np

from runs import RunTest, quoted, toml

OBSERVE = {"trajectory": 3, "extrema": True, "impacts": True}
STARTS = {"x0": "x", "v0": "v", "loose_x0": "z", "loose_v0": "w"}
NEXT_TO_NONE = 1e-300  # a force that moves nothing, and whose periods are counted


def drawn(draw):
    """A scene with a spring and stops, or a loose mass, all of whose forces are in [sweep]."""
    scene = {"h": draw.choice([0.0, draw.uniform(0.01, 0.3)]), "nu": draw.uniform(0.3, 2.5), "v0": draw.uniform(-1, 1)}
    scene["phase"] = draw.choice([0.0, draw.uniform(-3, 3)])
    scene["stiffness"] = draw.choice([1.0, draw.uniform(0.3, 3)])
    if draw.random() < 0.3:
        return scene | {"loose_mass": 0.1, "loose_gap": draw.uniform(0.3, 1), "loose_R": 0.7, "loose_v0": 0.4}
    scene |= {"xs": draw.uniform(0.3, 1), "load": draw.choice([0.0, draw.uniform(-0.3, 0.3)])}
    if draw.random() < 0.3:
        return scene | {"friction": 0.02, "R": 0.8}
    return scene | draw.choice([{"R": draw.uniform(0.3, 1)}, {"stop_stiffness": 50.0, "stop_R": 0.8}])


def in_machine(scene, mass, forces):
    """The same motion of a mass in kg, and its forces in N."""
    values = dict(scene)
    values["frequency"], values["damping"] = values.pop("nu") / (2 * math.pi), 2 * mass * values.pop("h")
    for key in ("stiffness", "stop_stiffness", "load", "friction", "loose_mass"):
        if key in values:
            values[key] *= mass
    if "xs" in values:
        values["gap"] = values.pop("xs")
    return values | {"mass": mass}, [mass * force for force in forces]


class OfForce(RunTest):
    def values(self, scene, sweep, time, name, section="scene", **observe):
        sections = {"sweep": sweep} if sweep else {}
        text = toml(scene=scene, **sections, time=time, observe=OBSERVE | observe)
        with h5py.File(self.run_clatter(text.replace("[scene]", f"[{section}]"), name)) as file:
            return {key: data[()] for key, data in file.items() if isinstance(data, h5py.Dataset)}

    def chain(self, scene, forces, time, name, key="f", **more):
        return self.values(scene, {key: forces, "follow": quoted(key)}, time, name, **more)

    def assert_same(self, one, other, text, names=("x", "v", "x_min", "x_max", "impact_total")):
        for name in names:
            np.testing.assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-9, err_msg=f"{name}: {text}")

    def test_the_phase_goes_on_without_a_force(self):
        scene, time = {"nu": 0.5, "xs": 1, "R": 0.7, "v0": 0.3}, {"mode": quoted("transient"), "duration": 5}
        found = self.chain(scene, [0, 0.3], time, "phase")
        alone = {"f": 0.3, "phase": 2.5, "x0": float(found["x"][0, -1]), "v0": float(found["v"][0, -1])}
        self.assert_same(
            {key: data[1] for key, data in found.items()}, self.values(scene | alone, {}, time, "alone"), ""
        )
        self.assertAlmostEqual(found["x_max"][1], 0.34246045273370807, delta=1e-14)

    def test_no_force_is_the_limit_of_a_small_one(self):
        draw = random.Random(64)
        for n in range(12):
            scene, time = drawn(draw), {"mode": quoted("transient"), "duration": draw.uniform(2, 30)}
            force = draw.choice([-1, 1]) * draw.uniform(0.1, 0.4)
            forces, small = [force, 0, force, 0, -force], [force, NEXT_TO_NONE, force, NEXT_TO_NONE, -force]
            one, other = (self.chain(scene, some, time, f"{n} {some is small}") for some in (forces, small))
            self.assert_same(one, other, scene)
            machine, newtons = in_machine(scene, 0.25, forces)
            found = self.chain(machine, newtons, time, f"machine {n}", key="force", section="machine")
            self.assert_same(found, one, machine)

    def test_shaken_scenes_go_on_with_the_phase_of_the_shaking(self):
        for n, (key, phase) in enumerate([("base_amplitude", 0.0), ("base_amplitude", 1.2), ("stop_amplitude", -2.0)]):
            scene = {"nu": 0.7, "h": 0.05, "xs": 0.5, "R": 0.8, "v0": 0.4, "stop_phase": phase}
            time = {"mode": quoted("transient"), "duration": 7}
            one, other = (
                self.chain(scene, [0.2, least, 0.3], time, f"{n} {least}", key=key) for least in (0, NEXT_TO_NONE)
            )
            self.assert_same(one, other, scene)

    def test_steady_motion_begins_at_the_phase_in_which_that_without_a_force_ended(self):
        for n, (nu, xs, R) in enumerate([(0.5, 1.0, 0.7), (0.7, 0.6, 1.0), (1.9, 0.25, 1.0)]):
            scene, time = {"nu": nu, "xs": xs, "R": R, "v0": 0.5}, {"max_periods": 400}
            found = self.chain(scene | {"h": 0.0}, [0, 0.4], time, f"steady {n}")
            phase = nu * 2 * math.pi * found["simulated_periods"][0]
            alone = {"f": 0.4, "phase": phase, "x0": float(found["x"][0, -1]), "v0": float(found["v"][0, -1])}
            alone = self.values(scene | alone, {}, time, f"alone {n}")
            self.assert_same({key: data[1] for key, data in found.items()}, alone, scene)

    def test_attractors_are_known_by_their_states_at_phase_0(self):
        scene, time = {"nu": 0.6, "xs": 0.5, "R": 0.6, "h": 0.0, "v0": 0.3}, {"max_periods": 2000}
        found = self.chain(scene, [0, 0.9, 0, 0.9], time, "chain", attractor=True, word=True)
        alone = self.values(scene | {"f": 0.9}, {}, time, "alone", attractor=True, word=True)
        self.assertEqual(list(found["status"]), [0, 0, 0, 0])
        self.assertEqual(list(found["attractor"][[0, 2]]), [-1, -1])  # free motion attracts nothing
        for number in found["attractor"][[1, 3]]:
            self.assertEqual(found["motion_word"][number], alone["motion_word"][0])
            for name in ("motion_x", "motion_v"):
                self.assertAlmostEqual(found[name][number], alone[name][0], delta=1e-9)


if __name__ == "__main__":
    unittest.main()
