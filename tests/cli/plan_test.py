"""`clatter plan`: text, JSON and warnings, and that `run -v` and the guide say the same."""

import json
import re
import unittest

from command_line import SMALL, SOURCE, CommandLine


class Plan(CommandLine):
    def plan(self, text, *words):
        config = self.write("p.toml", text)
        result = self.clatter("plan", config, "--json", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.files(), ["p.toml"])  # runs nothing, writes nothing
        return json.loads(result.stdout)

    def test_groups_add_up_and_give_their_reasons(self):
        plan = self.plan(SMALL, "--threads", "3")
        self.assertEqual((plan["schema"], plan["points"], plan["threads"]), ("clatter-plan/1", 5, 3))
        self.assertEqual(plan["dimensions"], [[{"key": "nu", "length": 5, "first": 0.5, "last": 1.5}]])
        self.assertEqual(plan["observed"], ["extrema", "period"])
        self.assertEqual([group["points"] for group in plan["groups"]], [4, 1])  # only nu = 1 reaches the stops
        without, with_stops = ({e["effect"]: e for e in group["effects"]} for group in plan["groups"])
        self.assertEqual(
            list(without),
            ["damping", "forcing", "resonance", "load", "lower stop", "upper stop", "dissipation", "chatter and rest"],
        )
        self.assertFalse(without["upper stop"]["required"])
        self.assertRegex(without["upper stop"]["why"], r"^\|x\| <= \S+ < 4 for all time: out of reach$")
        self.assertTrue(with_stops["upper stop"]["required"])
        self.assertFalse(with_stops["chatter and rest"]["required"])
        self.assertEqual(plan["groups"][0]["periods"], [4, 4])  # the closed form, one period observed at each
        self.assertLess(*plan["groups"][1]["periods"])
        self.assertEqual(plan["output_bytes"], 5 * 8 + 5 * (1 + 8 + 8 + 8 + 8 * 8))  # the axis, the results
        self.assertEqual(plan["estimated_log_bytes"], 0)
        self.assertEqual(plan["warnings"], [])

    def test_says_the_same_before_a_verbose_run(self):
        config = self.write("a.toml", SMALL)
        text = self.clatter("plan", config, "--threads", "1").stdout
        run = self.clatter("run", config, "-v", "--threads", "1").stderr
        without_times = [line for line in text.splitlines() if " s on " not in line and not line.startswith("memory ")]
        self.assertGreater(len(without_times), 20)
        for line in without_times:
            self.assertIn(line, run)

    def test_an_impact_log_is_estimated_and_said_to_be(self):
        logged = SMALL + "impact_log = true\n"
        plan = self.plan(logged)
        self.assertGreater(plan["estimated_log_bytes"], 0)
        self.assertGreater(plan["memory_bytes"], plan["estimated_log_bytes"])
        text = self.clatter("plan", self.write("p.toml", logged)).stdout
        self.assertRegex(text, r"(?m)^output .* before compression, the impact log by an estimate$")
        self.assertRegex(text, r"(?m)^memory .*MiB, by an estimate of the impact log: \S+ ")

    def test_warns_of_unintended_settings(self):
        far = self.plan(SMALL, "--set", "scene.xs=6")["warnings"]
        self.assertEqual(len(far), 2)
        self.assertRegex(far[0], r"^the lower stop is never reached .* 5 < 6 .*; if impacts are meant, move it nearer")
        nothing = self.plan(SMALL, "--set", "observe.extrema=false", "--set", "observe.period=false")["warnings"]
        self.assertTrue(any("nothing is observed" in warning for warning in nothing), nothing)
        lasting = self.plan(SMALL, "--set", "scene.h=0", "--set", "scene.R=1", "--set", "sweep.nu=1.3")["warnings"]
        self.assertTrue(any("never fades" in warning for warning in lasting), lasting)

    def test_a_large_sweep_is_sampled_and_that_is_said(self):
        large = ("--set", "sweep.x0=linspace(-1, 1, 2000)", "--set", "sweep.nu=linspace(0.5, 1.5, 600)")
        said = "examined 1000000 of 1200000 points; counts are estimates"
        self.assertIn(f"\n{'':20}{said}\n", self.clatter("plan", self.write("p.toml", SMALL), *large).stdout)
        for follow in ((), ("--set", "sweep.follow=nu")):
            plan = self.plan(SMALL, *large, *follow)
            self.assertEqual((plan["points"], plan["sampled_points"]), (1200000, 1000000))
            self.assertEqual(sum(group["points"] for group in plan["groups"]), 1200000)
        self.assertEqual([group["points"] for group in plan["groups"]], [2000, 1198000])  # the first ones of branches
        self.assertNotIn("examined", self.clatter("plan", self.write("p.toml", SMALL)).stdout)

    def test_refuses_the_mistakes_that_run_refuses_and_plans_a_part(self):
        config = self.write("p.toml", SMALL)
        huge = ("--set", "sweep.x0=linspace(-1, 1, 1000000)", "--set", "observe.trajectory=10000000")
        run = self.clatter("run", config, *huge)
        self.assertEqual(run.returncode, 74, run.stderr)
        self.assertRegex(run.stderr, r"^clatter: not enough disk space: the results take \S+ TiB beside 'p\.h5', .*\n$")
        for words in ((), ("--json",)):
            plan = self.clatter("plan", config, *huge, *words)
            told = [re.sub(r"\S+ \S+ are free", "some are free", said) for said in (plan.stderr, run.stderr)]
            self.assertEqual((plan.returncode, plan.stdout, told[0]), (run.returncode, "", told[1]))
        part = self.plan(SMALL, *huge, "--shard", "999999/1000000")
        self.assertEqual((part["shard"], part["points"]), ("999999/1000000", 5))

    def test_shards_are_parts_of_the_whole(self):
        whole = self.plan(SMALL)
        self.assertIsNone(whole["shard"])
        self.assertIsNone(whole["sampled_points"])
        parts = [self.plan(SMALL, "--shard", f"{number}/2") for number in range(2)]
        self.assertEqual([part["points"] for part in parts], [3, 2])
        self.assertEqual(sum(group["points"] for part in parts for group in part["groups"]), 5)
        self.assertEqual(
            sum(part["output_bytes"] for part in parts), whole["output_bytes"] + 2 * 5 * 8
        )  # their numbers, and the axis in each
        config = self.write("p.toml", SMALL)
        text = self.clatter("plan", config, "--shard", "1/2").stdout
        self.assertIn("\npoints              2 of 5, shard 1/2\n", text)
        self.assertIn(
            "\npoints              2 of 5, shard 1/2\n", self.clatter("run", config, "-v", "--shard", "1/2").stderr
        )
        self.assert_refused(2, "--shard '2/2'; expected K/N", "plan", config, "--shard", "2/2")

    def test_a_followed_branch_knows_its_first_start_only(self):
        plan = self.plan(SMALL, "--set", "sweep.follow=nu")
        self.assertEqual(plan["follow"], "nu")
        self.assertEqual([group["points"] for group in plan["groups"]], [1, 4])
        reasons = {e["effect"]: e["why"] for e in plan["groups"][1]["effects"]}
        self.assertIn("isn't known yet", reasons["lower stop"])

    def test_both_directions_are_twice_the_points(self):
        for direction, points in (("down", 5), ("both", 10)):
            plan = self.plan(SMALL, "--set", "sweep.follow=nu", "--set", f"sweep.direction={direction}")
            self.assertEqual((plan["points"], plan["direction"]), (points, direction))
            self.assertEqual([group["points"] for group in plan["groups"]], [1, points - 1])

    def test_savings_are_those_of_the_ladder(self):
        """The guide of scene has the ladder: for each effect that is left out, the share of time with it kept in."""
        guide = (SOURCE / "src" / "scene" / "README.md").read_text(encoding="utf-8")
        ladder = guide.split("<!-- begin: effects ladder -->")[1].split("<!-- end -->")[0]
        measured = {}
        for row in ladder.strip().splitlines()[2:]:
            cells = [cell.strip() for cell in row.strip("|").split("|")]
            if cells[7] not in ("–", "same"):
                measured.setdefault(cells[1], []).append(round(1 - float(cells[7]), 2))
        plans = [
            self.plan(SMALL, "--set", "scene.h=0", "--set", "scene.xs=0.5"),
            self.plan(
                SMALL, "--set", "scene.h=0", "--set", "scene.f=0", "--set", "scene.v0=1", "--set", "scene.xs=0.5"
            ),
            self.plan(SMALL, "--set", "scene.xs=6"),
        ]
        told = {}
        for reason in (reason for plan in plans for group in plan["groups"] for reason in group["effects"]):
            if reason["saves"][1] > 0:
                told["both stops" if reason["effect"].endswith("stop") else reason["effect"]] = reason["saves"]
        self.assertEqual(set(told), {"damping", "forcing", "resonance", "both stops"})
        for effect, (least, most) in told.items():
            self.assertEqual([min(measured[effect]), max(measured[effect])], [least, most], effect)

    def test_the_guide_shows_the_plan_of_a_figure(self):
        guide = (SOURCE / "src" / "plan" / "README.md").read_text(encoding="utf-8")
        shown = guide.split("$ clatter plan configs/fig22.toml\n")[1].split("```")[0].splitlines()
        plan = self.clatter("plan", str(SOURCE / "configs" / "fig22.toml")).stdout.splitlines()
        self.assertEqual(len(shown), len(plan))
        for ours, theirs in zip(plan, shown):
            # what differs from machine to machine
            if " s on " not in ours and not ours.startswith(("memory ", "merge ")):
                self.assertEqual(ours, theirs)


if __name__ == "__main__":
    unittest.main()
