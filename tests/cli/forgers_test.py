"""Nothing false is proved: certificates of all kinds are edited at random, and clatter-verify proves no false one.

A simulation of our own, which shares nothing with clatter or clatter-verify, tells which edits are surely false: it
follows the motion in doubles, and an edit is false if it contradicts that by more than doubles may be wrong.

Environment: CLATTER and CLATTER_VERIFY, the programs; CLATTER_SOURCE, the source directory; CLATTER_FORGED, the number
of false certificates; CLATTER_SEED, another start of the random numbers.
"""

import collections
import json
import os
import random
import unittest

import numpy as np

import forger_edits
from carrying_scenes import carrying_scenes, carrying_scenes_beside_stops, rubbing_scenes
from certified_runs import VERIFY, certificates_in, certified, random_certificates, verdicts
from command_line import SOURCE, CommandLine
from force_scenes import any_orders
from forger_judge import Judge, Truth, Unreliable
from forger_motion import Flow, Force, Motion
from random_scenes import compliant_scenes, pressing_scenes, random_scenes, rubbed_scenes
from scene_runs import keys_of

FORGED, SEED = int(os.environ.get("CLATTER_FORGED", "700")), int(os.environ.get("CLATTER_SEED", "1"))
FROM_ONE = 40  # forgeries of a certificate
MOST_EVENTS = 60  # of a certificate that is edited

RESTS = """[scene]
f = -1.0
h = 0.1
R = 0.5
[sweep]
nu = "linspace(0.3, 0.9, 7)"
xs = "linspace(0.05, 0.3, 4)"
[observe]
word = true
extrema = true
stability = true
"""

HOUSED = """[scene]
h = 0.05
f = 1.0
loose_mass = 0.2
loose_gap = 0.7
[sweep]
nu = "linspace(0.4, 0.9, 6)"
loose_R = [0.1, 0.4]
[observe]
word = true
extrema = true
"""

WITHIN_ONE_STOP = """[scene]
f = 0.125
h = 0.125
stiffness = -1
stop_lower = -0.5
stop_upper = 0.5
stop_stiffness = 16
stop_damping = 0.1
x0 = 0.53
[sweep]
nu = "linspace(0.4, 1.2, 3)"
[observe]
word = true
extrema = true
"""


class Simulation(unittest.TestCase):
    def test_flights_obey_the_equation_of_motion(self):
        draw = random.Random(SEED)
        for _ in range(100):
            h, k, f, nu, phase, load, sine, cosine = (draw.uniform(0.1, 2) for _ in range(8))
            orders = [{"order": draw.randrange(1, 9), "sin": sine, "cos": cosine}]
            force = Force({"f": f, "nu": nu, "phase": phase, "orders": draw.choice([[], orders])})
            flow, time = Flow(h, k * draw.choice((-1, 1)), force, load), draw.uniform(0, 5)
            (before, x, after), (_, v, _) = flow.at((0.3, 0.7, -0.4), np.array([time - 1e-4, time, time + 1e-4]))
            bend = (before - 2 * x + after) / 1e-8
            self.assertLess(abs(bend - flow.push(time, x, v)), 1e-5 * (1 + abs(bend)))
            self.assertLess(abs((after - before) / 2e-4 - v), 1e-6 * (1 + abs(v)))

    def test_a_chatter_ends_with_its_geometric_series(self):
        """Under next to a constant force: it rises so little that the spring hardly changes."""
        scene = {"h": 0, "k": 1, "f": 1e-6, "nu": 0.5, "load": 1, "phase": 0, "upper": {"position": 0, "R": 0.5}}
        motion = Motion(scene, {"time": 0, "x": 0, "v": 0.01}, 1)
        rest = motion.events[-1]
        self.assertEqual((rest["event"], rest["until"]), ("rest", 1))
        self.assertAlmostEqual(rest["time"], 2 * 0.01 * 0.5 / (1 - 0.5), delta=1e-5)
        self.assertEqual({event["event"] for event in motion.events[:-1]}, {"impact"})

    def test_the_judge_calls_no_truth_false_and_a_plain_lie_false(self):
        scene = {"h": 0.1, "k": 1, "f": 0.1, "nu": 1, "load": 0, "phase": 0, "friction": 2}
        end = {"time": 1, "x": [0.3, 0], "v": [0, 0]}
        stick = {"event": "stick", "time": [0, 0], "until": [1, 0], "x": [0.3, 0]}
        claims = {"claim": "transient", "scene": scene, "start": {"time": 0, "x": 0.3, "v": 0}, "events": [stick]}
        true = {**claims, "end": end}
        truth = Truth(true)
        self.assertIsNone(Judge(truth, true).reason())
        for forgery in ({"events": []}, {"events": [stick, stick]}, {"end": {**end, "x": [0, 0]}}, {"word": "L"}):
            self.assertTrue(Judge(truth, {**true, **forgery}).is_surely_false(), forgery)


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
def scenes_under_orders(count, seed):
    """Keys of scenes whose force has several orders."""
    draw = random.Random(f"orders {seed}")
    few = count // 3 + 1
    scenes = [keys_of(scene) for make in (pressing_scenes, compliant_scenes) for scene in make(few, seed=seed)]
    return [{**keys, **any_orders(draw)} for keys in scenes + carrying_scenes(few, seed=seed)]


class Forgers(CommandLine):
    def true_certificates(self, scenes, seed):
        """Certificates of all kinds, written by clatter certify."""
        kinds = (random_scenes, pressing_scenes, compliant_scenes, rubbed_scenes, carrying_scenes)
        kinds += (carrying_scenes_beside_stops, rubbing_scenes, scenes_under_orders)
        for make in kinds:
            place = self.directory / f"{make.__name__}_{seed}"
            for file in random_certificates(place, make(scenes, seed=seed)):
                yield from certificates_in(file)

    def shipped_certificates(self):
        for name, text in (("rests", RESTS), ("housed", HOUSED), ("within", WITHIN_ONE_STOP)):
            result = self.clatter("run", self.write(f"{name}.toml", text), "-q", "-o", f"{name}.h5")
            self.assertIn(result.returncode, (0, 1), result.stderr)
            certified(self.directory / f"{name}.h5", self.directory / f"{name}.jsonl")
            yield from certificates_in(self.directory / f"{name}.jsonl")
        for name in ("branch", "optimal"):
            self.clatter("branch", SOURCE / f"configs/{name}.toml", "-q", "-o", f"{name}.h5")
            certified(self.directory / f"{name}.h5", self.directory / f"{name}.jsonl", "--sample", "12")
            yield from certificates_in(self.directory / f"{name}.jsonl")

    @staticmethod
    def truths(certificates, draw):
        """Certificates that the simulation agrees with, and some of the same motions from other starts."""
        for certificate in certificates:
            candidates = [certificate]
            for _ in range(2):
                try:
                    candidates.append(forger_edits.moved(certificate, Truth(certificate), draw))
                except Unreliable:
                    pass
            for candidate in candidates:
                try:
                    truth = Truth(candidate)
                except Unreliable:
                    continue
                if Judge(truth, candidate).reason() is None:
                    yield truth

    def verdicts_of(self, certificates, name):
        file = self.directory / name
        file.write_text("".join(json.dumps(one) + "\n" for one in certificates), encoding="utf-8")
        return verdicts(file)

    def test_no_false_certificate_is_proved(self):
        draw, count, seed, edits = random.Random(SEED), 0, SEED, collections.Counter()
        pool = list(self.shipped_certificates())
        while count < FORGED:
            pool += self.true_certificates(max(8, min(FORGED // 300, 100)), seed)
            pool = [certificate for certificate in pool if len(certificate["events"]) <= MOST_EVENTS]
            draw.shuffle(pool)
            truths = list(self.truths(pool, draw))
            of_truths = self.verdicts_of([truth.certificate for truth in truths], "true.jsonl")
            self.assertGreater(of_truths.count("proved"), 0.95 * len(truths))  # doubles tell where some of them start
            forgeries = [self.surely_false(truth, draw) for truth in truths for _ in range(FROM_ONE)]
            forgeries = [one for one in forgeries if one][: FORGED - count]
            found = self.verdicts_of([forgery for forgery, _, _ in forgeries], "forged.jsonl")
            proved = [forgery for forgery, verdict in zip(forgeries, found) if verdict == "proved"]
            kinds = collections.Counter(reason for _, _, reason in proved)
            self.assertEqual(len(proved), 0, f"{kinds}; the first one: {json.dumps(proved[:1])}")
            self.assertNotIn("bug", found)
            self.assertGreater(found.count("refuted") + found.count("malformed"), 0.95 * len(found))
            count += len(forgeries)
            seed += 1
            edits.update(name for _, names, _ in forgeries for name in names)
            pool = []
        drawn = {edit.__name__ for edit in forger_edits.LISTS + forger_edits.MEMBERS}
        self.assertEqual(drawn - edits.keys(), set())

    @staticmethod
    def surely_false(truth, draw):
        """A forgery, its edits, and why it is false; None if this isn't sure."""
        forgery, names = forger_edits.forged(truth.certificate, draw)
        try:
            reason = Judge(truth, forgery).reason()
        except Unreliable:
            return None
        return (forgery, names, reason) if reason else None


if __name__ == "__main__":
    unittest.main()
