"""The energy ledger where terms nearly cancel.

`impulse` is what a stop gives to the mass, by impacts and while it presses, not where friction alone holds the mass.

Environment: CLATTER, the program.
"""

import math
import random
import unittest

import h5py
import numpy as np

from runs import RunTest, quoted, toml


def pressed(constant, force, nu, phase, duration):
    """The integral of max(0, constant + force sin(nu t + phase)), between the zeros of the sum."""

    def whole(begin, end):
        return constant * (end - begin) - force / nu * (math.cos(nu * end + phase) - math.cos(nu * begin + phase))

    instants = [0.0, duration]
    if abs(constant) < abs(force):
        crest = math.asin(-constant / force)
        for angle in (crest, math.pi - crest):
            first = (angle - phase) / nu
            turns = range(math.ceil(-first * nu / (2 * math.pi)), math.ceil((duration - first) * nu / (2 * math.pi)))
            instants += [first + 2 * math.pi * turn / nu for turn in turns]
    instants.sort()
    return sum(max(0.0, whole(*interval)) for interval in zip(instants, instants[1:]))


class Ledger(RunTest):
    def values(self, scene, duration, name, **observe):
        time = {"mode": quoted("transient"), "duration": duration}
        text = toml(scene=scene, time=time, observe={"energy": True} | observe)
        with h5py.File(self.run_clatter(text, name)) as file:
            return {key: data[()] for key, data in file.items() if isinstance(data, h5py.Dataset)}

    def test_friction_that_holds_the_mass_beside_a_stop_is_no_pull_of_the_stop(self):
        found = self.values({"friction": 1, "stop_upper": 0.5, "x0": 0.5}, 10, "pull")
        self.assertEqual(list(found["impulse"]), [0, 0])  # the spring pulls with 0.5, which friction takes

    def test_a_mass_that_friction_holds_on_a_stop_is_pressed_by_turns(self):
        draw = random.Random(9)
        for n in range(30):
            side = draw.choice([-1, 1])
            load, f, nu = draw.uniform(-1, 1), draw.uniform(-2, 2), draw.uniform(0.2, 3)
            phase, duration, place = draw.uniform(-3, 3), draw.uniform(0.5, 40), draw.uniform(-0.5, 0.5)
            scene = {"friction": 4, "load": load, "f": f, "nu": nu, "phase": phase, "x0": place}
            scene |= {"stop_upper" if side > 0 else "stop_lower": place}
            expected = pressed(side * (load - place), side * f, nu, phase, duration)
            found = self.values(scene, duration, f"held{n}")["impulse"]
            at, other = found[int(side > 0)], found[int(side < 0)]
            self.assertAlmostEqual(at, expected, delta=1e-13 * duration, msg=scene)
            self.assertEqual(other, 0)

    def test_chatter_under_friction_in_closed_form(self):
        """A mass without a spring falls onto a stop: each flight rises against a + mu and falls with a - mu."""
        draw = random.Random(10)
        for n in range(20):
            a, R, height = draw.uniform(0.5, 2), draw.uniform(0.2, 1), draw.uniform(0.2, 2)
            mu = a * draw.uniform(0.05, 0.8)
            scene = {"stiffness": 0, "load": a, "friction": mu, "R_upper": R, "stop_upper": height}
            speed = math.sqrt(2 * (a - mu) * height)
            share = R * math.sqrt((a - mu) / (a + mu))  # of the speed from one impact to the next
            flights = R * speed * (1 / (a + mu) + 1 / math.sqrt((a - mu) * (a + mu))) / (1 - share)
            begins = speed / (a - mu) + flights
            found = self.values(scene, begins + 1, f"falls{n}")
            expected = (1 + R) * speed / (1 - share) + a  # and 1 at rest
            self.assertAlmostEqual(found["impulse"][1], expected, delta=1e-12 * expected, msg=scene)

    def test_a_loose_mass_that_weighs_next_to_nothing(self):
        for n, ratio in enumerate([1e-12, 1e-9, 0.1]):
            scene = {"h": 0.02, "f": 0.4, "nu": 1.3, "loose_mass": ratio, "loose_gap": 0.7, "loose_R": 0.8}
            found = self.values(scene | {"loose_v0": 0.3}, 60, f"loose{n}", impact_log=True)
            for wall, impulse in zip((-1, 1), found["impulse"]):
                own = found["impact_stop"] == wall
                self.assertGreater(np.sum(own), 5)
                speeds = np.abs(found["impact_v_before"][own])
                expected = ratio / (1 + ratio) * (1 + 0.8) * speeds.sum()
                self.assertAlmostEqual(impulse, expected, delta=1e-14 * expected)

    def test_a_held_mass_that_its_loose_one_strikes_at_the_start_begins_with_what_that_gives_it(self):
        for n, held in enumerate(({"friction": 0.5}, {"stop_upper": 0.0, "R_upper": 0.0})):
            scene = {"stiffness": 0, "load": 0.4, "loose_mass": 0.5, "loose_lower": -1, "loose_upper": 0.2, **held}
            scene |= {"loose_R_lower": 0.5, "loose_R_upper": 0.4, "loose_x0": 0.2, "loose_v0": 0.3}
            away = -1 if "stop_upper" in held else 1
            scene |= {"loose_lower": -0.2, "loose_x0": -0.2, "loose_v0": -0.3} if away < 0 else {}
            found = self.values(scene, 0.3, f"struck{n}")
            self.assertLess(abs(found["energy_residual"]), 1e-15, scene)

    def test_the_energy_of_a_mass_that_is_pressed_onto_a_soft_stop(self):
        """The residual is rounding of what the force gives and takes, of which the work is what doesn't come back."""
        draw, scenes = random.Random(12), []
        while len(scenes) < 60:
            scene = {"stiffness": draw.choice([1.0, 0.0, draw.uniform(-0.9, 3)]), "h": 10 ** draw.uniform(-3, -0.3)}
            scene |= {"nu": 10 ** draw.uniform(-0.7, 0.7), "f": 10 ** draw.uniform(-3.5, -1)}
            scene |= {"load": 10 ** draw.uniform(0, 1), "stop_upper": draw.choice([0.0, draw.uniform(-1, 1)])}
            scene |= {"stop_stiffness": 10 ** draw.uniform(0.1, 6), "stop_damping": 10 ** draw.uniform(-2, 0)}
            scenes.append(scene | {"x0": scene["stop_upper"]})
        axes = {key: [scene[key] for scene in scenes] for key in scenes[0]}
        text = toml(
            scene={},
            sweep=axes | {"linked": quoted(", ".join(axes))},
            time={"max_periods": 300, "max_impacts": 20000},
            observe={"energy": True, "extrema": True, "impacts": True},
        )
        compared = 0
        with h5py.File(self.run_clatter(text, "soft")) as file:
            for i, scene in enumerate(scenes):
                if file["status"][i] != 0 or file["contact_fraction"][i, 1] != 1:
                    continue
                given_and_taken = 2 * scene["f"] * (file["x_max"][i] - file["x_min"][i])
                self.assertLess(abs(file["energy_residual"][i]), 1e-12 * given_and_taken, scene)
                compared += 1
        self.assertGreater(compared, 40)


if __name__ == "__main__":
    unittest.main()
