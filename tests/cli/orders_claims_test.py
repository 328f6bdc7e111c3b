"""Motion under a force of several orders is proved, and nothing false of it.

Environment: CLATTER and CLATTER_VERIFY, the programs.
"""

import copy
import json
import random
import unittest
from pathlib import Path

from branch_orders_test import BOUNCING, RESTING
from certified_runs import VERIFY, certificates_in, random_certificates, verdicts, verified
from command_line import CommandLine
from force_scenes import under_orders
from loose_mass_test import text_of
from random_scenes import carrying_scenes, followed_scenes, slipping_scenes

TURN = "6.283185307179586476925286766559005768394338798"
ERROR = 1e-15


def forced(orders, k, end):
    """From rest at x = 0 over a period under a force of some orders."""
    scene = {"h": 0, "k": k, "f": 0, "nu": 1, "load": 0, "phase": 0, "orders": orders}
    start = {"time": 0, "x": 0, "v": 0}
    whole = {"format": "clatter-certificate-1", "scene": scene, "claim": "transient", "start": start, "events": []}
    return whole | {"end": {"time": TURN, "x": [end[0], ERROR], "v": [end[1], ERROR]}}


def moves(certificate):
    """Whether nothing holds the mass for good, whatever the force is."""
    return any(event["event"] not in ("rest", "stick") for event in certificate["events"])


def shifted(claimed, by):
    return [claimed[0] + by, claimed[1]]


@unittest.skipUnless(VERIFY, "without Arb there is no clatter-verify")
class OrdersClaims(CommandLine):
    def verdicts_of(self, certificates):
        self.write("told.jsonl", "".join(json.dumps(one) + "\n" for one in certificates))
        return verdicts(self.directory / "told.jsonl")

    def branch(self, scene, limits, **keys):
        """Certificates of the points and the special points of branches, and what is left out of them."""
        lines = "".join(f"{key} = {value!r}\n" for key, value in {"along": "nu", "range": list(limits), **keys}.items())
        observed = {"extrema": True, "stability": True, "impacts": True}
        self.write("b.toml", text_of(scene, {}, observed) + "[branch]\n" + lines.replace("'", '"'))
        self.clatter("branch", "b.toml", "-o", "b.h5", "-q", "--force")
        self.clatter("certify", "b.h5", "-o", "b.jsonl", "--force")
        return certificates_in(self.directory / "b.jsonl")

    def test_motion_without_stops_is_that_of_the_closed_form(self):
        """Without a spring A sin(j tau) moves a mass by A/j (tau - sin(j tau)/j); at the resonance k = j^2 it has
        -A tau cos(j tau)/(2j), and B cos(j tau) has B tau sin(j tau)/(2j)."""
        with self.subTest("resonance"):
            at = forced(
                [{"order": 3, "sin": 0.6, "cos": 0.4}], 9, ("-0.62831853071795864769", "1.25663706143591729539")
            )
            self.assertEqual(self.verdicts_of([at]), ["proved"])
        drift = [{"order": 2, "sin": 1.5, "cos": 0.3}, {"order": 4, "sin": 0.5}, {"order": 1, "cos": 0.7}]
        told = forced(drift, 0, ("5.49778714378213816731", "0"))  # 2 pi (1.5/2 + 0.5/4)
        false = copy.deepcopy(told)
        false["end"]["x"][0] = "5.497787143782138"
        false["end"]["x"][1] = 1e-17
        self.assertEqual(self.verdicts_of([told, false]), ["proved", "refuted"])

    def test_random_runs_are_proved_and_none_under_another_force(self):
        scenes = under_orders(followed_scenes(14, 21), 21) + under_orders(carrying_scenes(4, 22), 22)
        draw = random.Random(23)
        for file in random_certificates(self.directory, scenes):
            told = verified(file)
            self.assertEqual(told["refuted"], 0)
            self.assertGreaterEqual(told["proved"], 9 * told["undecided"])
            certificates = [one for one in certificates_in(file) if one["scene"].get("orders") and moves(one)]
            self.assertGreater(len(certificates), 6)
            for one in certificates:
                order = draw.choice(one["scene"]["orders"])
                number = draw.choice([name for name in ("sin", "cos") if name in order])
                order[number] += draw.choice([-1, 1]) * 1e-4
            self.assertNotIn("proved", self.verdicts_of(certificates))

    def test_branches_and_their_special_points_are_proved(self):
        certificates = self.branch(BOUNCING, (0.7, 1.1))
        special = [one["kind"] for one in certificates if one["claim"] == "special"]
        self.assertEqual(special, ["graze", "fold"])
        self.assertEqual(set(self.verdicts_of(certificates[:: max(1, len(certificates) // 30)])), {"proved"})
        along = self.branch({**BOUNCING, "nu": 0.86}, (0.1, 0.6), along="f_2")
        special = [one for one in along if one["claim"] == "special"]
        self.assertGreater(len(special), 0)
        self.assertEqual(set(self.verdicts_of(special)), {"proved"})
        for one in special:
            self.assertEqual([order["order"] for order in one["slopes"]["orders"]], [2])
            one["scene"]["orders"][0]["sin"] += 1e-6
        self.assertNotIn("proved", self.verdicts_of(special))

    def test_rests_end_where_one_phase_of_a_period_lets_go(self):
        certificates = self.branch(RESTING, (0.45, 0.55), period=1)[::20]
        self.assertTrue(all("released" in one["start"] for one in certificates))
        self.assertEqual(set(self.verdicts_of(certificates)), {"proved"})
        for one in certificates:
            one["scene"]["orders"][0]["sin"] *= 1 + 1e-6
        self.assertEqual(set(self.verdicts_of(certificates)), {"refuted"})

    def test_a_stop_lets_go_at_several_phases_of_a_period(self):
        twice = self.branch({**RESTING, "f_2": 1.6, "phase_2": 2.2}, (0.45, 0.55), period=1)[::40]
        self.assertEqual({one["word"] for one in twice}, {"L*L*"})
        self.assertEqual(set(self.verdicts_of(twice)), {"proved"})
        for one in twice:
            length = 6.283185307179586 / one["scene"]["nu"]
            later = [{**event, "time": shifted(event["time"], length)} for event in one["events"]]
            later = [
                {**event, "until": shifted(event["until"], length)} if "until" in event else event for event in later
            ]
            one["periods"], one["events"], one["word"] = 2, one["events"] + later, "L*L*L*L*"
        self.assertEqual(set(self.verdicts_of(twice)), {"refuted"})

    def test_mirrored_motion_rests_at_phases_of_both_stops(self):
        """Of which that on the other stop, half a period later, may have another number there."""
        special = json.loads(Path(__file__).with_suffix(".json").read_text(encoding="utf-8"))
        self.assertEqual(self.verdicts_of([special]), ["proved"])

    def test_a_release_is_the_nearest_to_a_time(self):
        """Also to one half a turn from another phase, which is as near on both sides."""
        scene = {"h": 0.1, "k": 0, "f": 0, "nu": 1, "load": 0, "phase": 0, "orders": [{"order": 2, "sin": 1}]}
        scene["lower"] = {"position": 0, "R": 0.5}
        end = {"time": 0.1, "x": [0.00033, 1e-4], "v": [0.0099, 1e-3]}
        whole = {"format": "clatter-certificate-1", "scene": scene, "claim": "transient", "events": [], "end": end}
        told = [{**whole, "start": {"time": time, "released": "lower"}} for time in (0, 1e-3, -1e-3)]
        self.assertEqual(self.verdicts_of(told), ["proved"] * 3)
        told = {**whole, "start": {"time": 0, "released": "lower"}, "end": {**end, "x": [0.0004, 1e-5]}}
        self.assertEqual(self.verdicts_of([told]), ["refuted"])

    def test_sticks_end_where_the_push_exceeds_friction(self):
        draw, scenes = random.Random(31), under_orders(slipping_scenes(24, 31), 31)
        for file in random_certificates(self.directory, scenes):
            told = verified(file)
            self.assertEqual(told["refuted"], 0)
            self.assertGreaterEqual(told["proved"], 9 * told["undecided"])
            sticks = [one for one in certificates_in(file) if any(event["event"] == "stick" for event in one["events"])]
            sticks = [one for one in sticks if moves(one)]
            self.assertGreater(len(sticks), 4)
            for one in sticks:
                event = draw.choice([event for event in one["events"] if event["event"] == "stick"])
                event["until"] = shifted(event["until"], draw.choice([-1, 1]) * 1e-4)
            self.assertNotIn("proved", self.verdicts_of(sticks))


if __name__ == "__main__":
    unittest.main()
