"""Derivatives of periodic motion by keys of the scene, `observe.sensitivity`, against closed forms and branches."""

import cmath
import math
import os
import subprocess
import unittest

import h5py
import numpy as np

from derivatives import by_each
from runs import RunTest, quoted, toml

CLATTER = os.environ["CLATTER"]
STARTS = {"x0", "v0", "phase"}
PERIODIC, GRAZING = 0, 3


def symmetric_motion(h, f, nu, R, xs):
    """Impact speed V of symmetric motion with one impact on each stop (Masri and Caughey 1966), k = 1; complex."""
    root, turn = cmath.sqrt(1 - h * h), math.pi / nu
    decay, sine = cmath.exp(-h * turn), cmath.sin(root * turn) / root
    a, b, c = (decay * (cmath.cos(root * turn) + sign * h * sine) for sign in (1, 0, -1))
    b = decay * sine
    amplitude = f / cmath.sqrt((1 - nu * nu) ** 2 + (2 * h * nu) ** 2)
    kappa = (1 + R) / (1 + c + b * b / (1 + a))
    beta, gamma = b * kappa / (1 + a), (kappa - R) / nu
    square = beta * beta + gamma * gamma
    return (beta * xs + cmath.sqrt(amplitude * amplitude * square - (gamma * xs) ** 2)) / square


def slipping_amplitude(f, nu, friction):
    """Of undamped motion with k = 1 under dry friction, without stops and without a stick (Den Hartog 1931)."""
    V, turn = f / (1 - nu * nu), math.pi / nu
    U = cmath.sin(turn) / (nu * (1 + cmath.cos(turn)))
    return cmath.sqrt(V * V - (friction * U) ** 2)


def newton(of, *unknowns):
    """The zero of two functions of two complex unknowns near a guess."""
    x, y = unknowns
    for _ in range(12):
        step = 1e-7
        (p, q), (px, qx), (py, qy) = of(x, y), of(x + step, y), of(x, y + step)
        px, qx, py, qy = (px - p) / step, (qx - q) / step, (py - p) / step, (qy - q) / step
        determinant = px * qy - py * qx
        x, y = x - (p * qy - q * py) / determinant, y - (q * px - p * qx) / determinant
    return x, y


def sticking_amplitude(f, nu, stiffness, friction, friction_static):
    """Of undamped motion without stops that sticks once on each side: let go at -X, it slips up to X."""

    def missed(X, length):
        begin = cmath.asin((friction_static - stiffness * X) / f)
        root, response = cmath.sqrt(stiffness), f / (stiffness - nu * nu)
        free_x, free_v = friction / stiffness - X - response * cmath.sin(begin), -response * nu * cmath.cos(begin)
        cosine, sine, end = cmath.cos(root * length), cmath.sin(root * length), begin + nu * length
        x = response * cmath.sin(end) + free_x * cosine + free_v * sine / root - friction / stiffness
        return x - X, response * nu * cmath.cos(end) - free_x * root * sine + free_v * cosine

    return newton(missed, 1.1, 4.85)[0]


def thrown_speed(f, nu, friction, friction_static, gap):
    """Of a block between walls that catch it, at which it strikes one after the other has let it go."""

    def missed(end, speed):
        begin = cmath.asin(friction_static / f)
        time = (end - begin) / nu
        v = f / nu * (cmath.cos(begin) - cmath.cos(end)) - friction * time
        x = (
            f / nu * cmath.cos(begin) * time
            - f / nu**2 * (cmath.sin(end) - cmath.sin(begin))
            - friction * time**2 / 2
        )
        return x - gap, v - speed

    return newton(missed, 2.0, 0.6)[1]


class WhereFormulasBranch(RunTest):
    """Values of closed forms in 40 digits, and of runs at 1e-9, at keys that are 0."""

    def slopes(self, key, name, **scene):
        text = toml(scene=scene, observe={"impacts": True, "sensitivity": quoted(key)})
        with h5py.File(self.run_clatter(text, name)) as file:
            self.assertEqual(file["status"][()], PERIODIC)
            return file["d_impact_speed_d_" + key][()]

    def test_damping_that_begins_without_a_spring(self):
        ball = {"stiffness": 0, "f": 1, "nu": 1, "xs": 2, "R": 0.6, "v0": 1}
        np.testing.assert_allclose(self.slopes("h", "ball", **ball), -2.197990726852018, rtol=1e-11)

    def test_stops_that_begin_to_move_against_the_force(self):
        scene = {"h": 0.1, "f": -1, "nu": 1.3, "xs": 0.5, "R": 0.7}
        found = self.slopes("stop_amplitude", "moves", **scene)
        np.testing.assert_allclose(found, [-2.3478175, 0.6096951], rtol=1e-6)


class ClosedForms(RunTest):
    def run_at(self, values, name="out", **sections):
        keys = ", ".join(key for key in values if key not in STARTS)
        sections.setdefault("observe", {}).update(sensitivity=quoted(keys), extrema=True, impacts=True, energy=True)
        return h5py.File(self.run_clatter(toml(scene=values, **sections), name))

    def test_symmetric_motion_with_one_impact_on_each_stop(self):
        for n, (h, nu, R) in enumerate([(0.0, 2.0, 0.6), (0.3, 1.1, 0.9), (0.02, 2.2, 0.5), (0.05, 2.0, 0.7)]):
            values = {"h": h, "f": 1.0, "nu": nu, "R": R, "xs": 0.4}
            V, slopes = symmetric_motion(**values).real, by_each(symmetric_motion, values)
            with self.run_at(values, f"impacts{n}") as file:
                np.testing.assert_allclose(file["impact_speed"], [V, V], rtol=1e-12)
                for key, slope in slopes.items():
                    np.testing.assert_allclose(file["d_impact_speed_d_" + key], [slope, slope], rtol=1e-10)
                    power = {"nu": (1 - R * R) * V * V / (2 * math.pi), "R": -R * V * V * nu / math.pi}.get(key, 0)
                    power += (1 - R * R) * V * slope * nu / math.pi
                    np.testing.assert_allclose(file["d_impact_power_d_" + key], power, rtol=1e-10)
                    self.assertEqual(file["d_x_max_d_" + key][()], 1.0 if key == "xs" else 0.0)
                    self.assertEqual(file["d_x_min_d_" + key][()], -1.0 if key == "xs" else 0.0)
                    period = -2 * math.pi / nu**2 if key == "nu" else 0.0
                    np.testing.assert_allclose(file["d_period_d_" + key], period, rtol=1e-14)

    def test_motion_that_meets_no_stop(self):
        def greatest(h, f, nu, load, stiffness):
            return load / stiffness + f / cmath.sqrt((stiffness - nu * nu) ** 2 + (2 * h * nu) ** 2)

        values = {"h": 0.1, "f": 0.7, "nu": 0.8, "load": 0.2, "stiffness": 1.6}
        with self.run_at(values, sweep={"xs": [9.0]}) as file:
            for key, slope in by_each(greatest, values).items():
                np.testing.assert_allclose(file["d_x_max_d_" + key][0], slope, rtol=1e-11)
                least = 2 * {"load": 1 / 1.6, "stiffness": -0.2 / 1.6**2}.get(key, 0.0) - slope
                np.testing.assert_allclose(file["d_x_min_d_" + key][0], least, rtol=1e-11)
                self.assertTrue(np.isnan(file["d_impact_speed_d_" + key]).all())
                self.assertEqual(file["d_impact_power_d_" + key][0], 0.0)

    def test_what_begins_to_move_is_in_absolute_displacements(self):
        scene = {"h": 0.05, "f": 1.0, "nu": 1.3, "R": 0.6, "stop_lower": -0.5, "stop_upper": 0.7, "stop_phase": 0.7}
        for key in ("base_amplitude", "stop_amplitude"):
            observe = {"frame": quoted("absolute"), "sensitivity": quoted(key), "extrema": True}
            with h5py.File(
                self.run_clatter(toml(scene=scene, sweep={key: [-1e-4, 0.0, 1e-4]}, observe=observe))
            ) as file:
                for end in ("x_min", "x_max"):
                    less, _, more = file[end][()]
                    np.testing.assert_allclose(file[f"d_{end}_d_{key}"][1], (more - less) / 2e-4, rtol=1e-6)

    def test_a_mass_that_stands_on_a_stop_moves_with_it(self):
        values = {"h": 0.1, "f": 0.5, "nu": 0.8, "load": 2.0, "stop_upper": 1.0, "R": 0.5}
        with self.run_at(values) as file:
            self.assertEqual(file["d_x_max_d_stop_upper"][()], 1.0)
            self.assertEqual(file["d_x_max_d_load"][()], 0.0)
            self.assertEqual(file["d_impact_power_d_load"][()], 0.0)

    def test_slips_without_a_stick(self):
        """A static level that no turn comes near changes nothing, nor does the load change more than the middle."""
        for n, (nu, friction) in enumerate([(0.8, 0.3), (1.3, 0.2)]):
            values = {"f": 1.0, "nu": nu, "friction": friction}
            amplitude = slipping_amplitude(**values).real
            also = {"load": 0.1, "friction_static": friction + 0.01, "x0": 0.1 + amplitude, "stop_upper": 9.0}
            with self.run_at({**values, **also}, f"slips{n}", time={"max_periods": 3000}) as file:
                np.testing.assert_allclose(file["x_max"], 0.1 + amplitude, rtol=1e-11)
                for key, slope in by_each(slipping_amplitude, values).items():
                    np.testing.assert_allclose(file["d_x_max_d_" + key], slope, rtol=1e-9)
                    np.testing.assert_allclose(file["d_x_min_d_" + key], -slope, rtol=1e-9)
                np.testing.assert_allclose([file["d_x_max_d_load"][()], file["d_x_min_d_load"][()]], 1.0, rtol=1e-10)
                self.assertEqual(file["d_x_max_d_friction_static"][()], 0.0)

    def test_friction_that_begins(self):
        """A square wave -sgn x' acts on the damped oscillator: half a period of its response begins at -y and ends at
        y, and at 1 above it is free motion."""
        for n, (h, nu) in enumerate([(0.1, 0.7), (0.02, 1.4), (0.6, 1.0)]):
            root, turn = math.sqrt(1 - h * h), math.pi / nu
            decay, sine = math.exp(-h * turn), math.sin(root * turn) / root
            a, b, d = (decay * (math.cos(root * turn) + h * sine), decay * sine, decay * math.cos(root * turn))
            flight = np.array([[a, b], [-b, d - h * b]])
            slope = 1 - np.linalg.solve(flight + np.eye(2), [2.0, 0.0])[0]
            values = {"h": h, "f": 1.0, "nu": nu, "friction": 0.0}
            with self.run_at(values, f"begins{n}", sweep={"xs": [20.0]}) as file:
                np.testing.assert_allclose(file["d_x_max_d_friction"][0], slope, rtol=1e-9)
                np.testing.assert_allclose(file["d_x_min_d_friction"][0], -slope, rtol=1e-9)

    def test_stuck_for_good_the_mass_stays(self):
        values = {"f": 0.3, "nu": 0.9, "friction": 0.5, "x0": 0.1, "h": 0.1, "stop_upper": 9.0}
        with self.run_at(values, "stuck") as file:
            self.assertEqual(file["status"][()], PERIODIC)
            self.assertEqual([file["d_x_max_d_friction"][()], file["d_x_max_d_f"][()]], [0.0, 0.0])

    def test_slips_that_end_in_sticks(self):
        for n, (nu, k, kinetic, static) in enumerate([(0.5, 1.0, 0.5, 0.55), (0.4, 1.0, 0.6, 0.7)]):
            values = {"f": 1.0, "nu": nu, "stiffness": k, "friction": kinetic, "friction_static": static}
            amplitude = sticking_amplitude(**values).real
            with self.run_at({**values, "stop_upper": 9.0}, f"sticks{n}") as file:
                np.testing.assert_allclose([file["x_max"][()], -file["x_min"][()]], amplitude, rtol=1e-12)
                for key, slope in by_each(sticking_amplitude, values).items():
                    np.testing.assert_allclose(file["d_x_max_d_" + key], slope, rtol=1e-10)
                    np.testing.assert_allclose(file["d_x_min_d_" + key], -slope, rtol=1e-10)

    def test_friction_holds_on_stops_and_follows_its_static_level(self):
        """Without that key it is the friction, and changes with it."""
        values = {"f": 1.0, "nu": 1.0, "friction": 0.2, "friction_static": 0.3, "gap": 0.5}
        for n, static in enumerate([0.3, 0.2]):
            values["friction_static"] = static
            slopes, speed = by_each(thrown_speed, values), thrown_speed(**values).real
            scene = {**values, "stiffness": 0.0, "R": 0.0, "stop_lower": -0.2, "stop_upper": 0.3, "x0": -0.2}
            del scene["gap"]
            if static == 0.2:
                del scene["friction_static"]
                slopes["friction"] += slopes.pop("friction_static")
            slopes["stop_upper"] = slopes.pop("gap")
            slopes["stop_lower"] = -slopes["stop_upper"]
            with self.run_at(scene, f"thrown{n}") as file:
                np.testing.assert_allclose(file["impact_speed"], speed, rtol=1e-12)
                for key, slope in slopes.items():
                    np.testing.assert_allclose(file["d_impact_speed_d_" + key], [slope, slope], rtol=1e-10)
                    power = speed * slope * values["nu"] / math.pi
                    power += speed**2 / (2 * math.pi) if key == "nu" else 0.0
                    np.testing.assert_allclose(file["d_impact_power_d_" + key], power, rtol=1e-10)

    def test_ways_to_give_the_damping_are_related(self):
        """c = 2 zeta (k m)^(1/2) = (k m)^(1/2)/Q, and a mass changes the damping ratio of a damper, and no other."""
        mass, stiffness, zeta = 0.3, 700.0, 0.07
        scene = {"mass": mass, "stiffness": stiffness, "force": 9.0, "frequency": 9.5, "R": 0.7, "gap": 4e-3}
        natural = math.sqrt(stiffness * mass)
        ways = {"damping_ratio": zeta, "quality": 1 / (2 * zeta), "damping": 2 * zeta * natural}
        slopes = {}
        for way, value in ways.items():
            observe = {"sensitivity": quoted(f"mass, {way}"), "impacts": True}
            text = toml(scene={}, machine={**scene, way: value}, observe=observe).replace("[scene]\n", "")
            with h5py.File(self.run_clatter(text, way)) as file:
                slopes[way] = {key: file["d_impact_speed_d_" + key][0] for key in ("mass", way)}
                self.assertEqual(file["d_impact_speed_d_mass"].attrs["units"], "m s-1/kg")
        of_damper = slopes["damping"]["damping"]
        np.testing.assert_allclose(slopes["damping_ratio"]["damping_ratio"], of_damper * 2 * natural, rtol=1e-9)
        np.testing.assert_allclose(slopes["quality"]["quality"], -of_damper * natural * (2 * zeta) ** 2, rtol=1e-9)
        along = of_damper * zeta * math.sqrt(stiffness / mass)  # the damper that a ratio adds with the mass
        np.testing.assert_allclose(slopes["damping_ratio"]["mass"], slopes["damping"]["mass"] + along, rtol=1e-8)

    def test_they_are_the_slopes_of_branches(self):
        """Of polynomials through seven points of a branch; where the impact speed is greatest the slope is 0."""
        scene = {"h": 0.1, "f": -1.0, "R": 0.7, "xs": -3.0}
        text = toml(scene={**scene, "nu": 1.2}, branch={"along": quoted("nu"), "range": [0.9, 1.5]})
        (self.scratch / "b.toml").write_text(text + "[observe]\nextrema = true\n", encoding="utf-8")
        words = [CLATTER, "branch", self.scratch / "b.toml", "-o", self.scratch / "b.h5", "-q"]
        subprocess.run(words, check=True, capture_output=True)
        with h5py.File(self.scratch / "b.h5") as file:
            found = {
                name: file[name][()]
                for name in ("arclength", "nu", "x", "v", "impact_speed", "x_max", "stable", "branch")
            }
            greatest = file["special_kind"][()] == b"maximum impact_speed"
            top = [float(file["special_" + name][greatest][0]) for name in ("nu", "x", "v")]
        compared = 0
        for i in range(3, len(found["nu"]) - 3, 4):
            near = slice(i - 3, i + 4)
            if len(set(found["branch"][near])) > 1 or not (found["stable"][near] != 0).all():
                continue

            def slope_of(name, near=near, i=i):
                along = found["arclength"][near] - found["arclength"][i]
                return np.polynomial.Polynomial.fit(along, found[name][near], 6).deriv()(0.0)

            slopes = self.slopes_from(scene, found["nu"][i], found["x"][i], found["v"][i])
            for name in ("impact_speed", "x_max"):
                if found["impact_speed"][i] == 0 and name == "impact_speed":
                    continue
                expected = slope_of(name) / slope_of("nu")
                np.testing.assert_allclose(slopes[name], expected, rtol=1e-4, atol=1e-6, err_msg=f"{name}, {i}")
                compared += 1
        self.assertGreater(compared, 20)
        self.assertLess(abs(self.slopes_from(scene, *top)["impact_speed"]), 1e-6)

    def slopes_from(self, scene, nu, x, v):
        values = {**scene, "nu": float(nu), "x0": float(x), "v0": float(v)}
        with self.run_at(values, "slopes", time={"max_periods": 400}) as file:
            self.assertEqual(file["status"][()], PERIODIC)
            faster = int(np.nan_to_num(file["impact_speed"], nan=-1).argmax())
            return {"impact_speed": file["d_impact_speed_d_nu"][faster], "x_max": file["d_x_max_d_nu"][()]}

    def test_none_at_a_graze_and_the_status_says_so(self):
        """The stop is a few roundings off an extremum of the response to the force."""
        grazing = 0
        for n in range(24):
            nu, h = 0.4 + 0.08 * n, 0.03 * (1 + n % 4)
            dynamic, friction = 1 - nu**2, 2 * h * nu
            square = dynamic**2 + friction**2
            place = (1 + (n % 5 - 2) * 2.0**-52) / math.sqrt(square)
            values = {"h": h, "f": 1.0, "nu": nu, "R": 0.7, "stop_upper": place}
            values |= {"x0": -friction / square, "v0": nu * dynamic / square}
            with self.run_at(values, f"graze{n}", time={"max_periods": 400}) as file:
                if file["status"][()] == GRAZING:
                    grazing += 1
                    self.assertTrue(math.isnan(file["d_x_max_d_stop_upper"][()]))
                    self.assertTrue(math.isnan(file["d_x_max_d_h"][()]))
        self.assertGreater(grazing, 3)

    def test_none_without_a_period_or_a_force(self):
        chaos = {"h": 0.01, "f": 1.0, "nu": 0.6, "R": 0.9, "xs": 0.2}
        free = {"h": 0.0, "R": 1.0, "xs": 1.0, "x0": 0.5}
        for name, values in (("chaos", chaos), ("free", free)):
            text = toml(scene=values, observe={"sensitivity": quoted("R, h"), "extrema": True})
            with h5py.File(self.run_clatter(text, name)) as file:
                self.assertTrue(math.isnan(file["d_x_max_d_R"][()]), name)


if __name__ == "__main__":
    unittest.main()
