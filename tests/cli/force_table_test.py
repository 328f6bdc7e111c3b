"""Forces as they were measured: closed forms, relations between runs, the file that goes into the output, and mistakes.

Environment: CLATTER, the program; CLATTER_SOURCE, the source tree.
"""

import itertools
import math
import random
import unittest

import h5py
import numpy as np

from command_line import SOURCE, CommandLine
from force_scenes import Force, any_table
from force_shape_test import BOUNCING, OfOneMotion, order_of, shaped
from loose_mass_test import LooseMass, text_of

INLINE = "period, f; 0, 1; 0.3, 0.2; 0.3, -0.5; 1, -0.1"


def table_of(force, count):
    """Rows of a shape: `count` even ones, and two at each of its knots."""
    rows = []
    for share in sorted({*(i / count for i in range(count + 1)), *force.knots()}):
        sides = (share + 1e-9,) if share == 0 else (share - 1e-9,) if share == 1 else (share - 1e-9, share + 1e-9)
        for near in sides:
            rows.append((share, force.derivatives(share, near, 1)[0]))
    return "period, f" + "".join(f"; {share!r}, {value!r}" for share, value in rows)


def without(scene, *keys):
    return {key: value for key, value in scene.items() if key not in keys}


class ClosedForms(LooseMass):
    def test_even_rows_of_a_sine_have_the_fundamental_of_their_straight_lines(self):
        """N rows lessen the first order to (N/pi sin(pi/N))^2, 1 - pi^2/(3 N^2) of it, and add orders N - 1, N + 1."""
        scene = {"h": 0.05, "nu": 0.7, "xs": 50.0}
        for count in (6, 40):
            sine = "period, f" + "".join(
                f"; {i / count!r}, {math.sin(2 * math.pi * i / count)!r}" for i in range(count + 1)
            )
            observe = {"harmonics": count + 1, "harmonics_method": "exact"}
            told = self.steady({**scene, "force_table": sine, "force_factor": 0.4}, **observe)["x_amplitude"]
            share = (count / math.pi * math.sin(math.pi / count)) ** 2
            self.assertLess(abs(share - 1 + math.pi**2 / (3 * count**2)), 5 / count**4)
            for n in range(1, count + 2):
                size = share / n**2 if n in (1, count - 1, count + 1) else 0.0
                known = 0.4 * size / abs(1 - (0.7 * n) ** 2 + 0.07j * n)
                self.assertAlmostEqual(told[n], known, delta=1e-13)

    def test_each_order_of_the_response_is_that_of_the_order_of_the_rows(self):
        draw = random.Random(5)
        for h, nu in ((0.05, 0.37), (1.3, 2.1), (0.02, 0.5)):
            rows = any_table(draw)
            scene = {"h": h, "nu": nu, "xs": 50.0, "force_table": rows, "force_factor": -0.4}
            data = self.steady(scene, harmonics=6, harmonics_method="exact")
            force = Force("table", force_table=rows)
            for n in range(7):
                known = 0.4 * order_of(force, n) / (1 - (n * nu) ** 2 + 2j * h * n * nu) / (1 if n else 2)
                told = data["x_amplitude"][n] if n else abs(data["x_amplitude"][0])
                self.assertAlmostEqual(told, abs(known), delta=1e-11)

    def test_without_a_spring_the_velocity_is_the_integral_of_the_straight_lines(self):
        rows = "tau, f; 2, 0; 3, 1; 5, -1; 6, 0"
        scene = {"h": 0.0, "stiffness": 0.0, "nu": 2 * math.pi / 4, "xs": 99.0, "force_table": rows, "v0": 0.1}
        data = self.transient(scene, 4.0, 5)
        np.testing.assert_allclose(data["v"], [0.1, 0.6, 1.1, 0.6, 0.1], atol=1e-13)


class Relations(OfOneMotion):
    def test_the_rows_of_a_shape_of_straight_lines_give_the_motion_under_that_shape(self):
        for shape in ("square", "pulse", "triangle", "trapezoid", "sawtooth"):
            for count in (1, 7):
                with self.subTest(shape, count=count):
                    force = Force(shape, 0.3, 0.2)
                    table = {"force_table": table_of(force, count), "force_factor": BOUNCING["f"]}
                    self.compare({**BOUNCING, **shaped(shape, 0.3, 0.2)}, {**without(BOUNCING, "f"), **table})

    def test_the_factor_turns_the_force_round_and_the_phase_shifts_it(self):
        scene = without(BOUNCING, "f")
        late = {**scene, "phase": scene["phase"] + 0.25 * 2 * math.pi}
        rows = [(0.0, 0.7), (0.25, -0.4), (0.25, 0.1), (0.6, 0.5), (1.0, 0.2)]
        moved = sorted([((share - 0.25) % 1, value) for share, value in rows[2:4]] + [(0.75, 0.2), (0.75, 0.7)])
        moved = [*moved, (1.0, -0.4)]
        opposite = [(share, -value) for share, value in rows]

        def text(table):
            return "period, f" + "".join(f"; {share!r}, {value!r}" for share, value in table)

        one, other, opposed = (
            {"force_table": text(table), "force_factor": factor}
            for table, factor in ((rows, 1.3), (moved, 1.3), (opposite, -1.3))
        )
        self.compare({**late, **one}, {**scene, **other}, duration=80.0)
        self.compare({**scene, **one}, {**scene, **opposed}, duration=80.0)

    def test_units_and_clocks_say_the_same(self):
        machine = {"mass": 0.4, "stiffness": 300.0, "damping_ratio": 0.05, "stop_upper": 2e-3, "R": 0.7}
        machine |= {"frequency": 5.0}
        one = self.transient(
            {**machine, "force_table": "time (s), force (N); 0, 1; 0.05, -0.5; 0.2, 1"}, 3.0, 9, kind="machine"
        )
        for table in (
            "time (ms), force (kN); 7, 1e-3; 57, -5e-4; 207, 1e-3",
            "phase (deg), force (N); 0, 1; 90, -0.5; 360, 1",
            "phase (rad), force (mN); 0, 1000; 1.5707963267948966, -500; 2*pi, 1000",
            "period, force (N); 0, 1; 0.25, -0.5; 1, 1",
        ):
            with self.subTest(table):
                other = self.transient({**machine, "force_table": table}, 3.0, 9, kind="machine")
                np.testing.assert_allclose(other["x"], one["x"], rtol=0, atol=1e-13)

    def test_general_methods_tell_the_same(self):
        scene = {**without(BOUNCING, "f"), "force_table": INLINE}
        one = self.transient(scene, 12.0)
        text = text_of(scene, {"mode": "transient", "duration": 12.0}, {"trajectory": 7})
        text += '[integrator]\nmethod = "dopri5"\ntolerance = 1e-12\n'
        with h5py.File(self.run_clatter(text, "other")) as file:
            other = {"x": file["x"][()]}
        np.testing.assert_allclose(other["x"], one["x"], rtol=0, atol=1e-8)

    def test_motion_that_a_stop_releases_several_times_in_a_period_comes_back_in_it(self):
        """It is pressed on a stop, shaken hard between both, pressed again, let go for a moment, and pressed again."""
        rows = [(0.0, -2.0), (0.02, -2.0)]
        rows += [
            (0.02 + 0.58 * n / 22, (-1) ** (n + 1) * 4 * (1 + 0.3 * math.sin(1.7 * (n - 1)))) for n in range(1, 23)
        ]
        rows += [(0.64, -2.0), (0.8, -2.0), (0.84, 1.0), (0.86, -2.0), (1.0, -2.0)]
        table = "period, f" + "".join(f"; {share!r}, {value!r}" for share, value in rows)
        compared = 0
        for turns, R in itertools.product((0.0, 0.7, 0.95), (0.5, 0.75)):
            scene = {"nu": 0.06, "h": 0.01, "xs": 0.5, "R": R, "phase": 2 * math.pi * turns, "force_table": table}
            data = self.observed(scene, {"max_periods": 50}, {"period": True, "trajectory": 3}, options=("--force",))
            if data["status"] != 0:
                continue
            compared += 1
            start = {"x0": float(data["x"][0]), "v0": float(data["v"][0])}
            length = float(data["period"])
            again = self.transient({**scene, **start}, length, 3)
            np.testing.assert_allclose(again["x"][-1], start["x0"], atol=1e-9)
        self.assertGreaterEqual(compared, 3)

    def test_an_axis_of_the_factor_has_the_motions_of_its_points(self):
        scene = {**without(BOUNCING, "f"), "force_table": INLINE}
        time, observe = {"mode": "transient", "duration": 20.0}, {"trajectory": 5}
        swept = self.observed(scene, time, observe, sweep={"force_factor": [-0.5, 0.0, 1.2]})
        for i, factor in enumerate([-0.5, 0.0, 1.2]):
            alone = self.observed({**scene, "force_factor": factor}, time, observe, name="alone", options=("--force",))
            np.testing.assert_array_equal(swept["x"][i], alone["x"])

    def test_starts_have_no_mirror_images_unless_the_force_has(self):
        odd = "period, f; 0, 0.6; 0.5, 0.6; 0.5, -0.6; 1, -0.6"
        for rows in (odd, INLINE):
            scene = {"h": 0.05, "nu": 0.9, "xs": 0.8, "R": 0.7, "force_table": rows}
            axes = {"x0": [-0.3, 0.3], "v0": [-1.0, 1.0], "phase": [0.0, math.pi]}
            swept = self.observed(
                scene, {"max_periods": 500}, {"extrema": True}, sweep=axes, name="all", options=("--force",)
            )
            for index in np.ndindex(2, 2, 2):
                own = {key: values[i] for (key, values), i in zip(axes.items(), index)}
                alone = self.observed(
                    {**scene, **own}, {"max_periods": 500}, {"extrema": True}, name="one", options=("--force",)
                )
                np.testing.assert_allclose(swept["x_max"][index], alone["x_max"], atol=1e-9, err_msg=str(own))


MACHINE = '[machine]\nmass = 1\nstiffness = 100\ngap = 0.1\nfrequency = "2 Hz"\n'
RUN = "[observe]\nextrema = true\n"
ROWS = "# a comment; 1, 2\ntime (ms), force (N)\n0, 3\n100, -2\r\n\n400, 3\n"


class Files(CommandLine):
    def setUp(self):
        super().setUp()
        (self.directory / "rig").mkdir()

    def test_an_output_holds_the_table_and_runs_again_without_the_file(self):
        self.write("rig/force.csv", ROWS)
        self.write("rig/a.toml", MACHINE + 'force_table = "force.csv"\n' + RUN)
        told = self.clatter("run", "rig/a.toml", "-o", "a.h5", "-v")
        self.assertIn("stretched by 1.25 to the period of frequency", told.stderr)
        with h5py.File(self.directory / "a.h5") as file:
            self.assertIn("measured over 0.4 s, stretched by 1.25", file.attrs["comment"])
            x, text = file["x_max"][()], file.attrs["config"]
        self.assertIn("'''\ntime (ms), force (N)\n0, 3\n100, -2\n400, 3\n'''", text)
        (self.directory / "rig/force.csv").unlink()
        self.write("again.toml", self.clatter("info", "a.h5", "--config").stdout)
        self.clatter("run", "again.toml", "-o", "b.h5")
        with h5py.File(self.directory / "b.h5") as file:
            self.assertEqual(file["x_max"][()], x)
            self.assertEqual(file.attrs["config"], text)
        self.assertEqual((self.directory / "a.h5").read_bytes(), (self.directory / "b.h5").read_bytes())

    def test_the_table_of_a_sweep_in_shards_is_that_of_the_whole(self):
        self.write("force.csv", ROWS)
        self.write("a.toml", MACHINE + 'force_table = "force.csv"\n[sweep]\nforce_factor = [1, 2, 3]\n' + RUN)
        self.clatter("run", "a.toml", "-o", "whole.h5")
        for k in (0, 1):
            self.clatter("run", "a.toml", "--shard", f"{k}/2", "-o", f"part{k}.h5")
        self.clatter("merge", "part0.h5", "part1.h5", "-o", "merged.h5")
        with h5py.File(self.directory / "whole.h5") as whole, h5py.File(self.directory / "merged.h5") as merged:
            np.testing.assert_array_equal(whole["x_max"], merged["x_max"])
            self.assertEqual(whole.attrs["comment"], merged.attrs["comment"])

    def test_a_name_on_the_command_line_counts_from_here_and_replaces_the_force_of_the_file(self):
        self.write("force.csv", ROWS)
        self.write("rig/a.toml", MACHINE + "force = 3\n" + RUN)
        self.clatter("run", "rig/a.toml", "--set", "machine.force_table=force.csv", "-o", "a.h5")
        self.write("rig/b.ini", MACHINE + "force_table = time (ms), force (N); 0, 3 ; 100, -2; 400, 3\n" + RUN)
        self.clatter("run", "rig/b.ini", "-o", "b.h5")
        self.clatter("run", "rig/b.ini", "--set", "machine.force=3", "-o", "c.h5")
        self.write("rig/a.toml", MACHINE + 'force_table = "not there.csv"\n' + RUN)
        self.clatter("run", "rig/a.toml", "--set", "machine.force=3", "-o", "d.h5")
        self.assertEqual((self.directory / "c.h5").read_bytes(), (self.directory / "d.h5").read_bytes())
        with h5py.File(self.directory / "a.h5") as a, h5py.File(self.directory / "b.h5") as b, h5py.File(
            self.directory / "c.h5"
        ) as c:
            self.assertEqual(a["x_max"][()], b["x_max"][()])
            self.assertNotEqual(a["x_max"][()], c["x_max"][()])

    def test_a_hundred_thousand_rows_are_computed(self):
        count = 100000
        rows = [f"{i},{math.sin(2 * math.pi * i / (count - 1)):.9f}" for i in range(count)]
        self.write("force.csv", "tau,f\n" + "\n".join(rows) + "\n")
        scene = '[scene]\nh = 0.1\nxs = 9\nnu = 0.8\nforce_table = "force.csv"\n'
        self.write("a.toml", scene + "[time]\nmax_periods = 40\n" + RUN)
        self.clatter("run", "a.toml", "-o", "a.h5")
        with h5py.File(self.directory / "a.h5") as file:
            self.assertAlmostEqual(file["x_max"][()], 1 / abs(1 - 0.64 + 0.16j), delta=1e-3)
        self.write("again.toml", self.clatter("info", "a.h5", "--config").stdout)
        self.clatter("plan", "again.toml")
        self.write("force.csv", "tau,f\n" + "\n".join([*rows, f"{count},0"]) + "\n")
        self.assert_refused(2, "100001 rows; expected at most 100000", "run", "a.toml", "-o", "b.h5")

    def test_the_shipped_table_is_made_by_its_formula(self):
        noise = random.Random(1)
        lines = (SOURCE / "configs/feeder.csv").read_text(encoding="utf-8").splitlines()
        for i, line in enumerate(lines[2:-1]):
            time, force = map(float, line.split(","))
            self.assertAlmostEqual(time, 0.4 * i)
            self.assertAlmostEqual(force, 12 * math.sin(math.pi * i / 50) ** 4 + noise.gauss(0, 0.1), delta=6e-4)
        self.assertEqual(len(lines), 53)


class Refused(CommandLine):
    def refused(self, rows, *words, head=MACHINE, more=""):
        with self.subTest(rows):
            self.write("force.csv", rows)
            self.write("bad.toml", head + 'force_table = "force.csv"\n' + more + RUN)
            for word in words:
                self.assert_refused(2, word, "run", "bad.toml", "-o", "bad.h5")

    def test_a_row_that_is_wrong_is_told_with_its_line(self):
        head = "time (ms), force (N)\n"
        for rows, words in (
            (head + "0, 1\n3, 2\n2, 1\n", ("force.csv:4:1", "2 follows 3", "must not fall")),
            (head + "0, 1\n", ("one row", "closes the period")),
            (head, ("no row",)),
            ("", ("no rows",)),
            (head + "0, 1\n1, nan\n2, 1\n", ("force.csv:3:1", "nan")),
            (head + "0, 1\n1, inf\n2, 1\n", ("force.csv:3:1", "finite")),
            (head + "0, 1\n1, one\n2, 1\n", ("force.csv:3:1", "one")),
            (head + "0, 1\n1\n2, 1\n", ("force.csv:3:1", "one column")),
            (head + "0, 1\n1, 2, 3\n2, 1\n", ("force.csv:3:1", "more than two")),
            (head + "0, 0\n1, 0\n", ("all forces are 0",)),
            (head + "0, 0\n1, 2\n1, 3\n1, 4\n2, 1\n", ("force.csv:5:1", "three rows")),
            (head + "0, 0\n0, 2\n2, 1\n", ("force.csv:3:1", "from the last row to the first")),
            (head + "0, 0\n1, 2\n1, 1\n", ("force.csv:4:1", "from the last row to the first")),
            (head + "0; 1\n1; 2\n", ("force.csv:2:1", "a comma between")),
            (head + "1, 0\n1, 1\n", ("all rows have one time",)),
            (head + "0, 0\n1, 1\n1.0000000000001, 1\n2, 0\n", ("force.csv:4:1", "a jump")),
            ("0, 1\n1, 2\n2, 1\n", ("force.csv:1:1", "no head", "'time (ms)'")),
            ("time (N), force (N)\n0, 1\n1, 2\n", ("'N' doesn't fit", "a time in s")),
            ("time (ms), force (mm)\n0, 1\n1, 2\n", ("'mm' doesn't fit", "a force in N")),
            ("time, force (N)\n0, 1\n1, 2\n", ("'time' has no unit",)),
            ("tau, f\n0, 1\n1, 2\n", ("'tau'", "'time (ms)'")),
            ("period (s), force (N)\n0, 1\n1, 2\n", ("'s' doesn't fit", "without unit")),
            ("phase (deg), force (N)\n0, 1\n180, 2\n", ("force.csv:3:1", "0 to 360 deg")),
            ("period, force (N)\n0.2, 1\n1, 2\n", ("force.csv:2:1", "0 to 1")),
        ):
            self.refused(rows, *words)

    def test_what_no_table_goes_with_is_refused_with_its_remedy(self):
        for more, words in (
            ("force = 3\n", ("'force' beside 'force_table'", "force_factor")),
            ('force_shape = "square"\n', ("'force_shape' beside 'force_table'",)),
            ("force_duty = 0.3\n", ("'force_duty' beside 'force_table'",)),
            ("base_amplitude = 0.01\n", ("base_amplitude", "leave out one of them")),
            ('[observe]\nsensitivity = "force"\n[output]\n', ("'force'", "name 'force_factor'")),
            ('[observe]\nsensitivity = "force_duty"\n[output]\n', ("'force_duty'", "leave it out")),
            ('[branch]\nalong = "frequency"\nrange = ["1 Hz", "3 Hz"]\n', ("force_table", "sweep.follow")),
        ):
            self.write("force.csv", ROWS)
            text = MACHINE + 'force_table = "force.csv"\n' + more
            self.write("bad.toml", text if "[" in more else text + RUN)
            for word in words:
                command = "branch" if "[branch]" in text else "run"
                self.assert_refused(2, word, command, "bad.toml", "-o", "bad.h5")
        self.refused(ROWS, "without 'frequency'", head=MACHINE.replace('frequency = "2 Hz"\n', ""))

    def test_a_start_on_a_free_vibration_has_no_force(self):
        text = "[scene]\nxs = 1\nstart_period = 5\n" + f'force_table = "{INLINE}"\n' + RUN
        self.write("bad.toml", text)
        self.assert_refused(2, "'start_period' beside 'force_table'", "run", "bad.toml", "-o", "bad.h5")

    def test_a_file_that_is_not_there_is_told_where_it_is_named(self):
        self.write("bad.toml", MACHINE + 'force_table = "nothing.csv"\n' + RUN)
        self.assert_refused(2, "bad.toml:6:15: 'force_table': nothing.csv", "run", "bad.toml", "-o", "bad.h5")

    def test_a_row_within_a_configuration_is_told_with_its_words(self):
        rows = "period, force (N)\n0, 1\n0.5, inf\n1, 1\n"
        self.write("bad.toml", MACHINE + f"force_table = '''\n{rows}'''\n" + RUN)
        self.assert_refused(2, "bad.toml:6:15: 'force_table': '0.5, inf': 'inf'", "run", "bad.toml", "-o", "bad.h5")


if __name__ == "__main__":
    unittest.main()
