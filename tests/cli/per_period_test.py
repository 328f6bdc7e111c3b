"""Work, losses and impulse of points that are compared are per forcing period: a file has them for one period of motion
of period 1, for four of period 4, and for a window of 64 of motion without a period.

The mean power of the losses in impacts, which depends on no period, checks them.
"""

import json
import random
import unittest

import h5py
import numpy as np

from command_line import CommandLine
from plot_pictures import choice
from script_runs import run_script

from clatter.plots import pictures, style
from clatter.plots.data import Output, lacks_period
from clatter.plots.per_period import TOTALS, compared

DRILL = """[machine]
mass = "2 kg"
stiffness = "80 kN/m"
damping_ratio = 0.05
force = "300 N"
R = 0.4
stop_upper = 0
load = "60 N"
[sweep]
frequency = "linspace(40 Hz, 50 Hz, 101)"
[observe]
energy = true
"""
CHAOS = """[scene]
h = 0.05
f = -1.0
R = {R}
xs = {xs}
[sweep]
nu = "{kind}({begin}, {end}, 64)"
[time]
max_periods = 300
[observe]
energy = true
"""
ELASTIC = CHAOS.replace("h = 0.05", "h = 0.1").format(R=1.0, xs=1.0, kind="linspace", begin=1.2, end=1.6)
FAILED = 16  # the first status of failed points


class PerPeriod(CommandLine):
    def setUp(self):
        super().setUp()
        style.use_style()

    def ran(self, text, name="a", code=0):
        self.write(f"{name}.toml", text)
        result = self.clatter("run", f"{name}.toml", "-o", f"{name}.h5", "-q", "--force")
        self.assertEqual(result.returncode, code, result.stderr)
        return Output(self.directory / f"{name}.h5")

    def info(self, *words):
        result = self.clatter("info", "a.h5", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def assert_as_the_power_says(self, output):
        """Of every point the losses in impacts of a forcing period are the mean power times its length."""
        each = compared(output)
        frequency = output.parameter("frequency" if output.is_si else "nu")
        period = 1 / frequency if output.is_si else 2 * np.pi / frequency
        known = output.values("status") < FAILED
        lost = each.values("loss_impact").sum(axis=-1)[known]
        np.testing.assert_allclose(lost, (output.values("impact_power") * period)[known], rtol=1e-12, atol=1e-300)

    def test_a_longer_period_is_no_spike(self):
        output = self.ran(DRILL)
        for name in ("work_in", "loss_damping"):
            total, each = output.values(name), compared(output).values(name)
            self.assertGreater(total.max(), 2.5 * np.median(total))  # of period 4
            self.assertLess(each.max(), 1.4 * np.median(each))
        self.assert_as_the_power_says(output)
        axes = pictures.figure_of(pictures.members_of(output), choice(only=("work_in",))).axes[0]
        drawn = np.concatenate([line.get_ydata() for line in axes.lines])
        self.assertLess(np.nanmax(drawn), 1.4 * np.nanmedian(drawn))
        self.assertEqual(axes.get_ylabel().replace("\n", " "), "work of force and load per forcing period (J)")

    def test_the_largest_isn_t_that_which_was_observed_longest(self):
        output = self.ran(CHAOS.format(R=0.7, xs=1.5, kind="linspace", begin=0.4, end=0.8))
        self.assertTrue(lacks_period(output.values("status")).any())
        for option, best in (("--max", np.argmax), ("--min", np.argmin)):
            for name in TOTALS:
                if name not in output:
                    continue
                told = json.loads(self.info(option, name, "--json"))
                values = compared(output).values(name)
                values = values if values.ndim == 1 else (values.max if best is np.argmax else values.min)(axis=1)
                place = int(best(values))
                self.assertEqual(told["points"][0]["at"]["nu"], output.values("nu")[place])
                np.testing.assert_allclose(told["points"][0]["value"], values[place], rtol=1e-14)
                self.assertIn("per forcing period", told["result"]["long_name"])
        self.assertTrue(
            self.info("--max", "work_in").startswith("largest work_in, work of the force and the load per ")
        )
        with h5py.File(self.directory / "a.h5") as file:  # which keeps its numbers
            self.assertIn("in the observed time", file["work_in"].attrs["long_name"])

    def test_quantiles_of_a_sample(self):
        output = self.ran(CHAOS.format(R=0.7, xs=1.5, kind="sobol", begin=0.4, end=0.8))
        told = json.loads(self.info("--json"))["quantiles"]
        for name in ("work_in", "loss_damping"):
            median = np.median(compared(output).values(name))
            self.assertAlmostEqual(told[name]["at"]["0.5"] / median, 1.0, delta=1e-13)
            self.assertEqual(told[name]["per"], "forcing period")
        self.assertNotIn("per", told["impact_power"])
        self.assertRegex(self.info(), r"work_in .* per forcing period, 64 points")

    def test_what_a_file_does_not_tell_stays_a_total(self):
        output = self.ran(ELASTIC)  # no loss tells its period
        self.assertTrue((output.values("impulse") > 0).any())
        np.testing.assert_array_equal(compared(output).values("work_in"), output.values("work_in"))
        self.assertIn("in the observed time", self.info("--max", "work_in"))
        members = pictures.members_of(output)
        axes = pictures.figure_of(members, choice(only=("work_in",))).axes[0]
        self.assertIn("in the observed time", axes.get_ylabel().replace("\n", " "))
        with_period = self.ran(ELASTIC.replace("energy", "period = true\nenergy"))
        ratio = with_period.values("period_ratio")
        expected = with_period.values("work_in") / np.where(ratio > 0, ratio, 64)
        np.testing.assert_array_equal(compared(with_period).values("work_in"), expected)
        self.assertIn("per forcing period", self.info("--max", "work_in"))

    def test_transients_and_single_points_keep_their_totals(self):
        text = CHAOS.format(R=0.7, xs=1.5, kind="linspace", begin=0.4, end=0.8)
        output = self.ran(text.replace("max_periods = 300", "mode = 'transient'\nduration = 30"))
        np.testing.assert_array_equal(compared(output).values("work_in"), output.values("work_in"))
        self.assertIn("in the observed time", self.info("--max", "work_in"))
        single = self.ran(DRILL.replace("[sweep]\n", "").replace('"linspace(40 Hz, 50 Hz, 101)"', "45"))
        members = pictures.members_of(single)
        self.assertIs(members[0].output.values("work_in"), single.values("work_in"))

    def test_a_page_compares_them_likewise(self):
        output = self.ran(CHAOS.format(R=0.7, xs=1.5, kind="linspace", begin=0.4, end=0.8))
        made = run_script("report.py", self.directory / "a.h5", "--no-histories", "-o", self.directory / "a.html")
        self.assertEqual(made.returncode, 0)
        page = (self.directory / "a.html").read_text(encoding="utf-8")
        self.assertIn(
            f"<td>work_in per forcing period</td><td class=number>{compared(output).values('work_in').min()!r}", page
        )

    def test_scenes_drawn_at_random(self):
        generator, seen = random.Random(67), set()
        for _ in range(10):
            begin = generator.uniform(0.3, 1.0)
            text = CHAOS.format(
                R=generator.uniform(0.3, 0.95),
                xs=generator.uniform(0.1, 3),
                kind="linspace",
                begin=begin,
                end=begin + 0.4,
            )
            for change in ("", "stop_stiffness = 50\nstop_damping = 0.2\n", "load = 0.2\n", "friction = 0.1\n"):
                own = (
                    text.replace("R = ", change + "R = ")
                    if "stiff" not in change
                    else text.replace("[sweep]", f"{change}[sweep]")
                )
                own = "\n".join(
                    line for line in own.splitlines() if not ("stiff" in change and line.startswith("R = "))
                )
                output = self.ran(own + "\n")
                with self.subTest(own):
                    self.assert_as_the_power_says(output)
                    told = json.loads(self.info("--max", "loss_damping", "--json"))
                    best = np.nanmax(compared(output).values("loss_damping"))
                    self.assertAlmostEqual(told["points"][0]["value"] / best, 1.0, delta=1e-13)
                seen |= set(output.values("status").tolist())
        self.assertLessEqual({0, 1}, seen)


if __name__ == "__main__":
    unittest.main()
