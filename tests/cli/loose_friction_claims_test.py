"""Motion with friction in the housing of a loose mass that another simulation tells is proved, and nothing false of it.

Environment: CLATTER and CLATTER_VERIFY, the programs; CLATTER_FORGED, the number of false certificates; CLATTER_SEED,
another start of the random numbers.
"""

import os
import random
import unittest

from certified_runs import VERIFY
from command_line import CommandLine
from forger_housing import HousedMotion
from forger_judge import Judge, Truth, Unreliable
from forgers_test import Forgers

FORGED, SEED = int(os.environ.get("CLATTER_FORGED", "600")), int(os.environ.get("CLATTER_SEED", "1"))
ERROR = 1e-6  # of a claim: doubles tell these motions to less


def drawn(draw):
    """A scene in which the loose mass turns, is held and pressed, beside stops and friction of the main mass or not."""
    mass = draw.choice([0.05, 0.3, 1])
    friction = mass * draw.choice([0.05, 0.2, 0.6]) * draw.uniform(0.5, 1.5)
    loose = {"mass": mass, "R": draw.choice([0, 0.4, 0.7]), "load": draw.choice([0, 0, 0.2, -0.5])}
    loose |= {"friction": friction, "lower": {"position": -draw.uniform(0.2, 1)}}
    if draw.random() < 0.5:
        loose["friction_static"] = friction * draw.uniform(1, 1.5)
    if draw.random() < 0.7:
        loose["upper"] = {"position": draw.uniform(0.2, 1)}
    scene = {"h": draw.choice([0, 0.05, 0.3]), "k": draw.choice([1, 1, 0.5]), "f": draw.uniform(0.3, 2)}
    scene |= {"nu": draw.uniform(0.4, 2), "load": draw.choice([0, 0.2]), "phase": draw.uniform(0, 6), "loose": loose}
    if draw.random() < 0.5:
        for side, sign in (("lower", -1), ("upper", 1)):
            if draw.random() < 0.6:
                rigid = {"R": draw.choice([0, 0.5, 0.8])}
                soft = {"stiffness": draw.uniform(3, 30), "damping": draw.choice([0, 0.1, 0.5])}
                scene[side] = {"position": sign * draw.uniform(0.5, 1.5), **draw.choice([rigid, soft])}
    if draw.random() < 0.25:
        scene["friction"] = draw.uniform(0.02, 0.3)
        scene["friction_static"] = scene["friction"] * draw.choice([1, 1.3])
    return scene


def claimed(scene, start, end):
    """A transient as the simulation tells it."""
    motion = HousedMotion(scene, start, end)
    if len(motion.events) > 60 or any(abs(event.get(name, 1)) < ERROR for event in motion.events for name in "vw"):
        raise Unreliable("rebounds too slow for doubles")
    state = {name: [value, ERROR] for name, value in zip("xvzw", motion.state(end))}
    events = [
        {name: value if isinstance(value, str) else [value, ERROR] for name, value in event.items()}
        for event in motion.events
    ]
    whole = {"format": "clatter-certificate-1", "scene": scene, "claim": "transient", "start": start}
    return whole | {"events": events, "end": {"time": end, **state}}


def certificates(count, seed):
    draw, found = random.Random(f"friction in the housing {seed}"), []
    while len(found) < count:
        start = {"time": 0, "x": draw.uniform(-0.3, 0.3), "v": draw.uniform(-1, 1)}
        start |= {"z": draw.uniform(-0.15, 0.15), "w": draw.choice([0, draw.uniform(-1, 1)])}
        try:
            found.append(claimed(drawn(draw), start, draw.uniform(4, 20)))
        except Unreliable:
            pass
    return found


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
class Claims(CommandLine):
    verdicts_of, surely_false = Forgers.verdicts_of, staticmethod(Forgers.surely_false)

    def test_what_another_simulation_tells_is_proved(self):
        true = certificates(max(60, FORGED // 10), SEED)
        kinds = {event["event"] for certificate in true for event in certificate["events"]}
        self.assertGreaterEqual(kinds, {"turn", "hold", "press", "impact", "reversal", "touch", "separation"})
        told = self.verdicts_of(true, "true.jsonl")
        self.assertGreaterEqual(told.count("proved"), 0.98 * len(true), told)
        self.assertEqual(told.count("refuted"), 0)

    def test_no_forgery_of_it_is_proved(self):
        draw, forgeries = random.Random(SEED), []
        for certificate in certificates(FORGED // 10, SEED + 1000):
            truth = Truth(certificate)
            self.assertIsNone(Judge(truth, certificate).reason())
            forgeries += [self.surely_false(truth, draw) for _ in range(20)]
        forgeries = [forgery for forgery in forgeries if forgery]
        told = self.verdicts_of([forgery for forgery, _, _ in forgeries], "forged.jsonl")
        proved = [(names, reason) for (_, names, reason), verdict in zip(forgeries, told) if verdict == "proved"]
        self.assertEqual(proved, [])
        self.assertGreater(told.count("refuted") + told.count("malformed"), 0.98 * len(told))

    def test_a_claim_off_by_little_is_refuted(self):
        """Each number of the events of friction, by twice its error."""
        forgeries = []
        for certificate in certificates(20, SEED + 2000):
            for at, event in enumerate(certificate["events"]):
                for name in {"time", "until", "z"} & event.keys() if event["event"] in ("turn", "hold") else ():
                    value, error = event[name]
                    if value not in (0, certificate["end"]["time"]):
                        wrong = [*certificate["events"]]
                        wrong[at] = {**event, name: [value + 2 * error, error]}
                        forgeries.append({**certificate, "events": wrong})
        told = self.verdicts_of(forgeries, "off.jsonl")
        self.assertGreater(len(told), 100)
        self.assertEqual(set(told), {"refuted"})

    def test_another_level_of_friction_tells_another_motion(self):
        """A release comes at the static level, and a slide has the other one: neither may be taken for the other."""
        forgeries = []
        for certificate in certificates(40, SEED + 3000):
            events, end = certificate["events"], certificate["end"]["time"]
            cuts = {event["time"][0] for event in events} | {end}
            released = any(event["event"] == "hold" and event["until"][0] not in cuts for event in events)
            turned = any(event["event"] == "turn" for event in events)
            for name, factor, tells in (("friction", 0.99, turned), ("friction_static", 1.01, released)):
                loose = dict(certificate["scene"]["loose"])
                loose.setdefault("friction_static", loose["friction"])
                loose[name] *= factor
                if tells:
                    forgeries.append({**certificate, "scene": {**certificate["scene"], "loose": loose}})
        told = self.verdicts_of(forgeries, "levels.jsonl")
        self.assertGreater(len(told), 30)
        self.assertEqual(told.count("proved"), 0)


del Forgers  # whose tests are its own

if __name__ == "__main__":
    unittest.main()
