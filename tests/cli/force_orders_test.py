"""Forces that are sums of sines: closed forms, relations between runs, orders of a table, and what is refused.

Environment: CLATTER, the program.
"""

import math
import unittest

import h5py
import numpy as np

from command_line import CommandLine
from force_shape_test import BASE, BOUNCING, OfOneMotion
from loose_mass_test import LooseMass, text_of

ORDERS = {"f_2": 0.3, "phase_2": 0.7, "f_5": -0.2, "phase_5": -1.1}


class ClosedForms(LooseMass):
    def test_each_order_of_the_response_is_that_of_the_order_of_the_force(self):
        sizes = {1: (0.4, 0.0), 2: (0.3, 0.7), 3: (-0.2, 1.0), 8: (0.5, -2.0)}
        keys = {f"{name}_{j}": value for j in (2, 3, 8) for name, value in zip(("f", "phase"), sizes[j])}
        for h, nu in ((0.05, 0.37), (3e-3, 1 / 3 + 1e-4), (1.3, 2.1)):  # the second beside resonance
            with self.subTest(h=h):
                scene = {"h": h, "f": 0.4, "nu": nu, "stop_upper": 1e4, **keys}
                data = self.steady(scene, harmonics=9, harmonics_method="exact")
                for j in range(1, 10):
                    known = sizes.get(j, (0, 0))[0] / (1 - (j * nu) ** 2 + 2j * h * j * nu)
                    rounding = 1e-11 + 1e-9 * abs(known)
                    self.assertAlmostEqual(data["x_amplitude"][j], abs(known), delta=rounding)

    def test_orders_of_a_table_of_two_lines_are_those_of_a_square_wave(self):
        rows = "period, f; 0, 1; 0.5, 1; 0.5, -1; 1, -1"
        scene = {**BOUNCING, "f": 0.6 * 4 / math.pi}
        for j in (3, 5, 7):
            scene |= {f"f_{j}": scene["f"] / j}
        del (table := {**BOUNCING, "force_table": rows, "force_factor": 0.6, "force_table_harmonics": 7})["f"]
        one, other = self.transient(scene, 40.0), self.transient(table, 40.0)
        self.assertGreater(len(one["impact_tau"]), 10)
        for name in ("x", "v", "impact_tau"):
            np.testing.assert_allclose(one[name], other[name], rtol=0, atol=1e-10)
        time = {"mode": "transient", "duration": 40.0}
        with h5py.File(self.run_clatter(text_of(table, time, {"trajectory": 2}), "told")) as file:
            comment = file.attrs["comment"]
        left_out = 1 - 8 / math.pi**2 * sum(1 / j**2 for j in (1, 3, 5, 7))
        self.assertIn("7 orders", comment)
        self.assertAlmostEqual(float(comment.split("without ")[1].split()[0]), left_out, delta=1e-6)

    def test_the_mean_of_a_table_acts_as_a_load(self):
        """Of a sawtooth that falls from 2 to 0 within the period the orders are 2/(pi j) sin(j theta)."""
        rows = "period, f; 0, 2; 1, 0"
        for factor in (0.6, -0.3):
            scene = {**BOUNCING, "load": 0.1 + factor, "f": factor * 2 / math.pi, "f_2": factor / math.pi}
            table = {**BOUNCING, "load": 0.1, "force_table": rows, "force_factor": factor, "force_table_harmonics": 2}
            del table["f"]
            one, other = self.transient(scene, 30.0), self.transient(table, 30.0)
            np.testing.assert_allclose(one["x"], other["x"], rtol=0, atol=1e-11)

    def test_orders_of_many_rows_come_near_to_the_force_they_are_of(self):
        """Straight lines between values of sines lack a little of them, which falls with the square of the step."""
        shares = np.linspace(0, 1, 2001)
        theta = 2 * math.pi * shares
        force = 0.4 * np.sin(theta) + 0.3 * np.sin(2 * theta + 0.7) - 0.2 * np.sin(5 * theta - 1.1)
        rows = "; ".join(f"{share!r}, {f!r}" for share, f in zip(shares.tolist(), force.tolist()))
        table = {**BOUNCING, "force_table": f"period, f; {rows}", "force_table_harmonics": 8}
        del table["f"]
        one = self.transient({**BOUNCING, "f": 0.4, **ORDERS}, 10.0)
        np.testing.assert_allclose(one["x"], self.transient(table, 10.0)["x"], atol=1e-4)


class Relations(OfOneMotion):
    def test_an_order_alone_is_a_sine_of_a_multiple_of_the_frequency(self):
        for j in (2, 3, 8):
            for h in (0.05, 1.2):
                nu = j * 0.31
                size = 2 * math.hypot(1 - nu * nu, 2 * h * nu)  # so that the response reaches the stops
                alone = {**BOUNCING, "h": h, "f": 0.0, "nu": 0.31, f"f_{j}": size, f"phase_{j}": 0.2}
                sine = {**BOUNCING, "h": h, "f": size, "nu": nu, "phase": j * BOUNCING["phase"] + 0.2}
                with self.subTest(j, h=h):
                    self.compare(alone, sine, duration=25 / nu)

    def test_a_shift_of_the_phase_turns_each_order_by_so_many_times_as_much(self):
        alone = {**BOUNCING, "f": 0.0, "f_2": 2.0, "phase_2": 0.3, "f_3": 3.0}
        turned = {**alone, "phase": 0.0, "phase_2": 0.3 + 2 * BOUNCING["phase"], "phase_3": 3 * BOUNCING["phase"]}
        self.compare(alone, turned)

    def test_the_opposite_of_a_force_has_each_order_half_a_turn_later(self):
        one = {**BOUNCING, **ORDERS}
        other = {**one, "f": -one["f"], "f_2": -0.3, "f_5": 0.2, "load": 0.0, "stop_lower": -0.9, "stop_upper": 0.6}
        mine, its = self.transient(one, 40.0, 9), self.transient(other, 40.0, 9)
        self.assertGreater(len(mine["impact_tau"]), 10)
        np.testing.assert_allclose(mine["x"], -its["x"], atol=1e-10)

    def test_what_is_shaken_adds_a_part_to_the_first_order(self):
        """Of a base b nu^2 sin(theta + phase), of the stops -b (1 - nu^2) sin - 2 h nu b cos of that."""
        amplitude, shift = 0.3, 0.9
        scene = {**BOUNCING, **ORDERS}
        h, nu = scene["h"], scene["nu"]
        for key, part in (
            ("base_amplitude", amplitude * nu**2),
            ("stop_amplitude", amplitude * (nu**2 - 1 - 2j * h * nu)),
        ):
            shaken = {**scene, key: amplitude, "stop_phase": shift}
            first = scene["f"] + part * np.exp(1j * shift)
            lead = float(np.angle(first))
            turned = {f"phase_{j}": scene[f"phase_{j}"] - j * lead for j in (2, 5)}
            still = {**scene, **turned, "f": float(abs(first)), "phase": scene["phase"] + lead}
            with self.subTest(key):
                self.compare(shaken, still)

    def test_orders_of_size_0_leave_a_sine(self):
        self.compare(BOUNCING, {**BOUNCING, "f_2": 0.0, "phase_2": 0.4})

    def test_all_methods_tell_the_same(self):
        self.compare_methods({**BOUNCING, **ORDERS})

    def test_a_machine_has_the_motion_of_its_scene(self):
        mass, length, rate = 0.4, 3e-3, 70.0
        force = mass * rate**2 * length
        machine = {"mass": mass, "stiffness": mass * rate**2, "damping_ratio": 0.05, "phase": 0.4, "R": 0.7}
        machine |= {"force": 0.6 * force, "frequency": 0.9 * rate / (2 * math.pi)}
        machine |= {"force_2": 0.3 * force, "phase_2": 0.7, "force_5": -0.2 * force, "phase_5": -1.1}
        machine |= {"stop_lower": -0.6 * length, "stop_upper": 0.9 * length}
        one = self.transient({**BOUNCING, **ORDERS}, 20.0)
        other = self.transient(machine, 20.0 / rate, kind="machine")
        np.testing.assert_allclose(other["x"], length * one["x"], atol=1e-10 * length)

    def test_axes_of_an_order_have_the_motions_of_their_points(self):
        axes = {"f_2": [-0.3, 0.0, 0.4], "phase_2": [0.0, 2.0]}
        scene, time = {**BOUNCING, "f_5": 0.2}, {"mode": "transient", "duration": 20.0}
        swept = self.observed(scene, time, {"trajectory": 5}, sweep=axes)
        for index in np.ndindex(3, 2):
            own = {key: values[i] for (key, values), i in zip(axes.items(), index)}
            alone = self.observed({**scene, **own}, time, {"trajectory": 5}, name="alone", options=("--force",))
            np.testing.assert_array_equal(swept["x"][index], alone["x"])

    def test_starts_have_mirror_images_under_odd_orders_alone(self):
        """Whether or not the program knows of them."""
        scene = {"h": 0.05, "f": 0.4, "nu": 0.9, "xs": 0.8, "R": 0.7}
        axes = {"phase": [0.0, math.pi], "x0": [-0.3, 0.3], "v0": [-1.0, 1.0]}
        for orders in ({"f_3": 0.4}, {"f_2": 0.4}):
            swept = self.observed({**scene, **orders}, {"max_periods": 900}, {"extrema": True}, sweep=axes)
            for index in np.ndindex(2, 2, 2):
                own = {key: values[i] for (key, values), i in zip(axes.items(), index)}
                alone = {**scene, **orders, **own}
                told = self.observed(alone, {"max_periods": 900}, {"extrema": True}, name="one", options=("--force",))
                np.testing.assert_allclose(swept["x_max"][index], told["x_max"], atol=1e-9, err_msg=str(own))
            if "f_3" in orders:
                np.testing.assert_allclose(swept["x_max"], -swept["x_min"][::-1, ::-1, ::-1], atol=1e-9)


class Refused(CommandLine):
    def test_what_no_orders_go_with_is_refused_with_its_remedy(self):
        order = BASE + "f_3 = 0.2\n"
        table = '[scene]\nxs = 1\nforce_table = "period, f; 0, 1; 0.5, -1; 1, 1"\n'
        for text, words in (
            (order + '[observe]\nsensitivity = "f_2"\n', ("f_2", "leave it out")),
            (order + '[observe]\nsensitivity = "phase_2"\n', ("phase_2", "leave it out")),
            (order + 'force_shape = "square"\n', ("'f_3' beside 'force_shape' = 'square'", "leave one of them out")),
            (table + "f_3 = 0.2\n", ("'f_3' beside 'force_table'", "leave one of them out")),
            (table + "phase_3 = 0.2\n", ("'phase_3' beside 'force_table'", "leave one of them out")),
            (table + "force_table_harmonics = 9\n", ("force_table_harmonics", "8")),
            (table + '[branch]\nalong = "nu"\nrange = [0.5, 1]\n', ("leave out force_table",)),
            (BASE + "f_9 = 0.2\n", ("f_9", "f_2")),
            (BASE + "f_1 = 0.2\n", ("f_1",)),
            (BASE + "force_2 = 0.2\n", ("force_2", "f_2")),
            ("[machine]\nmass = 1\nforce_2 = 3\n", ("'force_2' without 'frequency'",)),
        ):
            with self.subTest(text=text):
                self.write("bad.toml", text)
                command = "branch" if "[branch]" in text else "run"
                for word in words:
                    self.assert_refused(2, word, command, "bad.toml", "-o", "bad.h5")

    def test_a_key_without_effect_is_warned_of(self):
        for line, remedy in (("phase_2 = 0.3", "without 'f_2'"), ("force_table_harmonics = 3", "without force_table")):
            self.write("a.toml", BASE + f"{line}\n[observe]\nextrema = true\n")
            told = self.clatter("plan", "a.toml")
            self.assertIn(remedy, told.stdout + told.stderr)

    def test_growth_at_a_resonance_with_an_order_is_told(self):
        for order, escapes in (("f_3", True), ("f_2", False)):
            scene = {"h": 0.0, "f": 0.4, "nu": 1 / 3, "stop_lower": -math.inf, "stop_upper": math.inf, order: 0.2}
            self.write("a.toml", text_of(scene, {}, {"extrema": True}))
            self.clatter("run", "a.toml", "-o", "a.h5", "-q", "--force")
            with h5py.File(self.directory / "a.h5") as file:
                status = file["status"]
                told = dict(zip(status.attrs["flag_values"], status.attrs["flag_meanings"].split()))[status[()]]
            self.assertEqual(told == "escaped", escapes, order)

    def test_the_plan_names_the_orders(self):
        self.write("a.toml", BASE + "f_3 = 0.25\nf_8 = -0.5\n[observe]\nextrema = true\n")
        self.assertIn("of orders 1, 3 and 8", self.clatter("plan", "a.toml").stdout)


if __name__ == "__main__":
    unittest.main()
