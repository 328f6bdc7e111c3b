"""Stops that move by themselves: closed forms, relations between runs, and what is refused.

Environment: CLATTER, the program.
"""

import math
import unittest

import numpy as np

from command_line import CommandLine
from force_shape_test import BASE
from loose_mass_test import LooseMass

DRIVEN = {"h": 0.05, "f": 0.8, "nu": 1.3, "phase": 0.4, "stop_lower": -0.5, "stop_upper": 0.6, "R": 0.7}
LIMITS = ("x_min", "x_max", "v_min", "v_max")


def moving(lower=(0.0, 0.0), upper=(0.0, 0.0)):
    """The keys of both stops, each by amplitude and phase."""
    keys = {}
    for side, (amplitude, phase) in {"lower": lower, "upper": upper}.items():
        if amplitude:
            keys |= {f"stop_amplitude_{side}": amplitude, f"stop_phase_{side}": phase}
    return keys


def stop_at(scene, side, tau):
    """Place and velocity of a stop."""
    amplitude, phase = scene.get(f"stop_amplitude_{side}", 0.0), scene.get(f"stop_phase_{side}", 0.0)
    theta = scene["nu"] * tau + scene.get("phase", 0.0) + phase
    return scene[f"stop_{side}"] + amplitude * math.sin(theta), amplitude * scene["nu"] * math.cos(theta)


class Motions(LooseMass):
    def compare(self, mine, its, atol, names=("x", "v", "impact_tau", "impact_v_before", "impact_v_after")):
        np.testing.assert_array_equal(mine["impact_stop"], its["impact_stop"])
        for name in names:
            np.testing.assert_allclose(mine[name], its[name], rtol=0, atol=atol, err_msg=name)


class ClosedForms(Motions):
    def ballistic(self, scene, count):
        """The contacts of a ball of weight 1, or of none, with two stops: by the signs of both gaps, and bisection."""
        load, tau = scene.get("load", 0.0), 0.0
        x, v, last, told = scene["x0"], scene["v0"], None, []

        def gap(side, after):
            place = x + v * after + load * after * after / 2
            return (place - stop_at(scene, side, tau + after)[0]) * (1 if side == "lower" else -1)

        while len(told) < count:
            found, step, after = None, 1e-3, 0.0
            while found is None:
                for side in ("lower", "upper"):
                    leaves = side == last and after == 0.0
                    if math.isfinite(scene[f"stop_{side}"]) and not leaves and gap(side, after + step) < 0:
                        low, high = after, after + step
                        for _ in range(80):
                            middle = (low + high) / 2
                            low, high = (low, middle) if gap(side, middle) < 0 else (middle, high)
                        if found is None or high < found[1]:
                            found = side, high
                after += step
            side, after = found
            x, v, tau, last = x + v * after + load * after * after / 2, v + load * after, tau + after, side
            place, speed = stop_at(scene, side, tau)
            before = v - speed
            x, v = place, speed - scene["R"] * before
            told.append((-1 if side == "lower" else 1, tau, before, x))
        return np.array(told)

    def check_ballistic(self, scene, count, atol):
        known = self.ballistic(scene, count)
        data = self.transient(scene, known[-1][1] + 1e-6, 2)
        np.testing.assert_array_equal(data["impact_stop"], known[:, 0])
        np.testing.assert_allclose(data["impact_tau"], known[:, 1], rtol=0, atol=atol)
        np.testing.assert_allclose(data["impact_v_before"], known[:, 2], rtol=0, atol=atol)

    def test_a_particle_between_a_wall_and_one_that_moves_is_that_of_fermi_and_ulam(self):
        scene = {"stiffness": 0.0, "nu": 1.0, "R": 1.0, "stop_lower": 0.0, "stop_upper": 10.0, "x0": 1.0, "v0": 1.7}
        self.check_ballistic({**scene, **moving((0.1, 0.3))}, 24, 1e-12)  # some roundings of such times

    def test_a_ball_flies_between_a_shaken_table_and_a_ceiling(self):
        scene = {"stiffness": 0.0, "load": -1.0, "nu": 2.3, "R": 0.8, "stop_lower": 0.0, "stop_upper": 1.2}
        self.check_ballistic(
            {**scene, "x0": 0.5, "v0": 1.0, **moving((0.35, 0.2))}, 30, 1e-11
        )  # as impacts stretch roundings, 1.4e-13

    def test_a_table_that_falls_faster_than_a_ball_lets_it_go(self):
        amplitude, nu = 0.6, 2.0  # 2.4 times its weight
        scene = {
            "stiffness": 0.0,
            "load": -1.0,
            "nu": nu,
            "R": 0.0,
            "stop_lower": 0.0,
            "x0": 0.0,
            **moving((amplitude, 0)),
        }
        scene |= {"v0": amplitude * nu}
        release = math.asin(1 / (amplitude * nu * nu)) / nu
        x, v = amplitude * math.sin(nu * release), amplitude * nu * math.cos(nu * release)
        data = self.transient(scene, 1.2, 5)
        for tau, told_x, told_v in zip(np.linspace(0, 1.2, 5), data["x"], data["v"]):
            after = max(0.0, tau - release)
            held = min(tau, release)
            known = (amplitude * math.sin(nu * held), amplitude * nu * math.cos(nu * held))
            if after:
                known = (x + v * after - after * after / 2, v - after)
            np.testing.assert_allclose((told_x, told_v), known, atol=1e-14)
        data = self.transient({**scene, "nu": 1.0, "v0": amplitude}, 20.0, 9, time_to_rest=True, extrema=True)
        self.assertEqual(data["time_to_rest"], 0)  # its weight always presses it to the table
        np.testing.assert_allclose(data["x"], amplitude * np.sin(np.linspace(0, 20, 9)), atol=1e-14)
        np.testing.assert_allclose([data[name] for name in LIMITS], amplitude * np.array([-1, 1, -1, 1]), rtol=1e-14)

    def test_a_mass_that_rests_moves_as_its_stop_does(self):
        """For long, too, on a spring that would push it away."""
        for stiffness in (-1.0, 0.0, 1.0):
            scene = {"h": 0.1, "nu": 0.05, "stiffness": stiffness, "load": 2.0, "stop_lower": -1.0, "stop_upper": 1.0}
            scene |= {"R": 0.5, "x0": 0.3, **moving(upper=(0.1, 0.7))}
            data = self.steady(scene, harmonics=2, harmonics_method="exact", extrema=True, impacts=True, energy=True)
            with self.subTest(stiffness):
                self.assertEqual(data["status"], 0)
                self.assertAlmostEqual(data["rest_fraction"][1], 1, delta=1e-14)
                np.testing.assert_allclose(data["x_amplitude"], [1, 0.1, 0], rtol=1e-12, atol=1e-12)
                np.testing.assert_allclose([data[name] for name in LIMITS], [0.9, 1.1, -0.005, 0.005], rtol=1e-12)
                self.assertAlmostEqual(data["impulse"][1], (2.0 - stiffness) * data["period"], delta=1e-11)
                self.assertAlmostEqual(data["work_in"], data["loss_damping"], delta=1e-12)

    def test_without_a_force_a_mass_comes_to_rest_where_no_stop_gets_to(self):
        scene = {"h": 0.05, "nu": 1.3, "stop_lower": -0.5, "stop_upper": 0.6, "R": 0.7, "x0": 0.1, **moving((0.2, 0.0))}
        data = self.steady(scene, extrema=True)
        self.assertEqual((data["status"], data["x_min"], data["x_max"]), (0, 0, 0))
        self.assertAlmostEqual(data["period"], 2 * math.pi / 1.3, delta=1e-14)

    def test_a_soft_stop_that_always_pushes_shakes_the_mass_as_two_springs_do(self):
        h, k, kappa, zeta, nu, b, load = 0.1, 1.0, 50.0, 0.2, 1.7, 0.05, -4.0
        scene = {"h": h, "nu": nu, "load": load, "stop_lower": -0.5, "stop_stiffness": kappa, "stop_damping": zeta}
        data = self.steady(
            {**scene, "x0": -0.6, **moving((b, 0.0))}, harmonics=1, harmonics_method="exact", impacts=True
        )
        damper = 2 * zeta * math.sqrt(kappa)
        pushed = b * (kappa + 1j * nu * damper) / (k + kappa - nu**2 + 1j * nu * (2 * h + damper))
        mean = (load + kappa * -0.5) / (k + kappa)
        np.testing.assert_allclose(data["x_amplitude"], [mean, abs(pushed)], rtol=1e-11)
        self.assertEqual(data["contact_fraction"][0], 1)
        force = kappa * (-0.5 - mean) + abs((kappa + 1j * nu * damper) * (b - pushed))
        self.assertAlmostEqual(data["contact_force_max"][0], force, delta=1e-12)


class Refused(CommandLine):
    def check(self, *command):
        done = self.clatter(*command)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_outputs_can_be_used_again(self):
        """Shards merge, and the complete configuration runs; a certificate isn't made."""
        self.write(
            "a.toml",
            BASE
            + "h = 0.1\nR = 0.5\nstop_amplitude_lower = 0.1\n[sweep]\nnu = [1.1, 1.2]\n[observe]\nextrema = true\n",
        )
        for shard in ("0/2", "1/2"):
            self.check("run", "a.toml", "--shard", shard, "-o", f"s{shard[0]}.h5", "-q")
        self.check("merge", "s0.h5", "s1.h5", "-o", "a.h5")
        self.write("b.toml", self.clatter("info", "a.h5", "--config").stdout)
        self.check("run", "b.toml", "-o", "b.h5", "-q")
        told = self.clatter("certify", "a.h5", "-o", "a.jsonl")
        self.assertIn("between stops that move by themselves", told.stdout + told.stderr)

    def test_a_plan_tells_how_stops_move(self):
        self.write("a.toml", BASE + "stiffness = 4.0\nR = 0.5\nstop_amplitude_lower = 0.1\nstop_phase = 0.5\n")
        told = " ".join(self.clatter("plan", "a.toml").stdout.split())
        for words in ("impacts, stops that move", "stop_amplitude_lower = 0.1, stop_phase_lower = 0.5"):
            self.assertIn(words, told)

    def test_the_command_line_lets_stops_move_alike_or_by_themselves(self):
        self.write("a.toml", BASE + "stop_amplitude = 0.1\n[observe]\nextrema = true\n")
        told = self.clatter("run", "a.toml", "-o", "a.h5", "--set", "scene.stop_amplitude_lower=0.2")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertNotIn("stop_amplitude = 0.1", self.clatter("info", "a.h5", "--config").stdout)

    def test_what_is_not_known_of_such_stops_is_refused_with_its_remedy(self):
        apart = BASE + "stop_amplitude_lower = 0.1\n"
        for text, words in (
            (apart + "friction = 0.1\n", ("friction", "leave out one of them")),
            (apart + "loose_mass = 0.1\nloose_gap = 0.2\n", ("loose_mass", "leave out one of them")),
            (apart + 'force_shape = "square"\n', ("force_shape", "leave out one of them")),
            (apart + "stop_amplitude = 0.1\n", ("stop_amplitude_lower", "stop_amplitude")),
            (apart + '[integrator]\nmethod = "dopri5"\n', ("dopri5", "leave it out")),
            (apart + '[observe]\nsensitivity = "R"\n', ("sensitivity", "leave it out")),
            (apart + '[branch]\nalong = "nu"\nrange = [0.5, 1.5]\n', ("[branch]", "stop_amplitude")),
            (BASE + "stop_amplitude_upper = 2.5\n", ("come together", "smaller amplitudes")),
            (apart + "stop_amplitude_upper = 1.95\nstop_phase_upper = 3.0\n", ("come together", "smaller amplitudes")),
            (apart + "x0 = -0.95\nphase = 1.5707\n", ("x0 = -0.95", "-0.9")),
            (
                "[scene]\nf = 1\nnu = 1\nstop_lower = -1\nstop_amplitude_upper = 0.1\n",
                ("without that stop", "stop_upper"),
            ),
        ):
            with self.subTest(text):
                self.write("bad.toml", text)
                command = "branch" if "[branch]" in text else "run"
                for word in words:
                    self.assert_refused(2, word, command, "bad.toml", "-o", "bad.h5")


if __name__ == "__main__":
    unittest.main()
