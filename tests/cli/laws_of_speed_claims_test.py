"""Motion under a restitution that depends on the speed is proved, and nothing false of it.

Certificates are written from closed forms in 60 digits, of a ball that bounces under a constant force, and by clatter
of random scenes. Environment: CLATTER and CLATTER_VERIFY, the programs; CLATTER_FORGED, the number of false
certificates; CLATTER_SEED, another start of the random numbers.
"""

import collections
import copy
import os
import random
import unittest
from decimal import Decimal, localcontext

from certified_runs import VERIFY, certificates_in, certified_scenes
from claimed_events import holder_of_R, speed_in
from command_line import CommandLine
from forger_judge import Judge, Truth, Unreliable
from forgers_test import Forgers
from laws_of_speed import LAWS, kinks, law_of, share

FORGED, SEED = int(os.environ.get("CLATTER_FORGED", "300")), int(os.environ.get("CLATTER_SEED", "1"))
ERROR = 1e-15


def text(number):
    return format(number, ".45f")


def bounces(law, speed, count, load="1"):
    """A ball that leaves a stop at a speed: a transient of so many impacts, up to the top of the next flight."""
    with localcontext() as context:
        context.prec = 60
        g, v, time, events = Decimal(load), Decimal(speed), Decimal(0), []
        for _ in range(count):
            time += 2 * v / g
            impact = {"event": "impact", "stop": "lower", "time": [text(time), ERROR], "v": [text(-v), ERROR]}
            events.append(impact)
            v *= share(law, v, Decimal)
            if v == 0:
                break
        end = time + (v / g if v else 1)
        if v == 0:
            end = Decimal(int(end) + 1)
            events.append({"event": "rest", "stop": "lower", "time": [text(time), ERROR], "until": [text(end), ERROR]})
        end = Decimal(text(end))
        height = v * (end - time) - g * (end - time) ** 2 / 2 if v else v
        last = {"time": text(end), "x": [text(height), ERROR], "v": [text(v - g * (end - time) if v else v), ERROR]}
    return certificate_of(law, speed, load, events, last)


def certificate_of(law, speed, load, events, end):
    scene = {"h": 0, "k": 0, "f": 0, "nu": 1, "load": "-" + load, "phase": 0}
    scene["lower"] = {"position": 0, "restitution": law}
    start = {"time": 0, "x": 0, "v": speed}
    whole = {"format": "clatter-certificate-1", "scene": scene, "claim": "transient", "start": start}
    return whole | {"events": events, "end": end}


def sum_of_bounces(law, speed):
    """The time that all bounces from a speed take, under the load 1, in closed form from the 2000th one on, where the
    speed v w^p of a power law falls so little that Euler and Maclaurin's first terms tell the sum."""
    with localcontext() as context:
        context.prec = 60
        v, time, p = Decimal(speed), Decimal(0), Decimal(law["exponent"])
        for _ in range(2000):
            time += 2 * v
            v *= share(law, v, Decimal)
        taken = 1 - share(law, v, Decimal)
        return time + 2 * (v / (taken * (1 - p)) - p * v / 2)


def chatter(law, speed, listed, error=1e-9):
    """A ball that comes to rest after infinitely many bounces, of which some are listed."""
    begun = bounces(law, speed, listed)
    total = sum_of_bounces(law, speed)
    end = str(int(total) + 2)
    until = [text(total), error]
    last = {"event": "chatter", "stop": "lower", "time": begun["events"][-1]["time"], "until": until}
    rest = {"event": "rest", "stop": "lower", "time": until, "until": [end, 0]}
    state = {"time": end, "x": [0, ERROR], "v": [0, ERROR]}
    return certificate_of(law, speed, "1", begun["events"] + [last, rest], state)


def numbers_of(law):
    """The places of the numbers of a law."""
    for name, value in law.items():
        if name == "table":
            yield from (("table", row, column) for row in range(len(value)) for column in range(2))
        else:
            yield (name,)


def with_another(law, place, factor):
    law = copy.deepcopy(law)
    *way, last = place
    holder = law
    for step in way:
        holder = holder[step]
    exact = isinstance(holder[last], str)
    changed = Decimal(holder[last]) * Decimal(factor)
    holder[last] = format(changed, "f") if exact else float(changed)
    return law


def tells(certificate, event, law):
    """Whether an impact sees that its stop has another law."""
    before = law_of(holder_of_R(certificate["scene"], event))
    speed = abs(Decimal(event[speed_in(event)][0]))
    off = Decimal(max(event[speed_in(event)][1], 1e-12))
    return abs(share(law, speed, Decimal) - share(before, speed, Decimal)) * speed > 1000 * off


def holders(certificate):
    """The places of the laws in a scene."""
    loose = certificate["scene"].get("loose", {})
    rigid = [certificate["scene"].get(side, {}) for side in ("lower", "upper")]
    return [one for one in [*rigid, loose, loose.get("lower", {}), loose.get("upper", {})] if "restitution" in one]


def forgeries_of_laws(certificate, factors=("0.995", "1.004")):
    """Certificates with another number of a law that one of the impacts before the end sees, errors as they are."""
    for at in range(len(holders(certificate))):
        for place in numbers_of(holders(certificate)[at]["restitution"]):
            for factor in factors:
                forged = copy.deepcopy(certificate)
                holder = holders(forged)[at]
                law = holder["restitution"] = with_another(holder["restitution"], place, factor)
                if not is_law(law):
                    continue
                impacts = [event for event in certificate["events"][:-1] if event["event"] == "impact"]
                seen = (event for event in impacts if holder_of_R(forged["scene"], event) is holder)
                if any(tells(certificate, event, law) for event in seen):
                    yield forged


def is_law(law):
    knots = [(Decimal(v), Decimal(R)) for v, R in law.get("table", [])]
    rises = all(one[0] < other[0] for one, other in zip(knots, knots[1:]))
    return rises and all(R <= 1 for _, R in knots) and Decimal(law.get("R", 0)) <= 1


STOPS = {
    "power": "R = {R}\nR_exponent = {p}\nR_reference_speed = {V}\n",
    "threshold": "R = {R}\nR_below = {below}\n",
    "power above a threshold": "R = {R}\nR_exponent = {p}\nR_reference_speed = {V}\nR_below = {below}\n",
    "table": 'R_of_speed = "{v0}: {R}, {v1}: {R1}, {v2}: {R2}"\n',
    "table from 0": 'R_of_speed = "0: {R2}, {v2}: {R}"\n',
    "table above a threshold": 'R_of_speed = "{v0}: {R1}, {v1}: {R}, {v2}: {R2}"\nR_below = {below}\n',
    "one of each": "R_lower = {R1}\nR_below_lower = {below}\nR_upper = {R}\nR_exponent_upper = {p}\n"
    "R_reference_speed_upper = {V}\n",
}
WALLS = {name: law.replace("R_", "loose_R_").replace("R =", "loose_R =") for name, law in STOPS.items()}


def rebounds_rise(knots):
    """Whether faster impacts rebound faster, as clatter wants it."""
    lines = [(v, R, (R_there - R) / (faster - v)) for (v, R), (faster, R_there) in zip(knots, knots[1:])]
    ends = [(faster, R_there, line[2]) for line, (faster, R_there) in zip(lines, knots[1:])]
    return all(R + v * rise > 0 for v, R, rise in lines + ends)


def drawn_law(draw, form):
    while True:
        v0, v1, v2 = sorted(draw.uniform(0.02, 1.5) for _ in range(3))
        R, R1, R2 = (draw.uniform(0.4, 0.9) for _ in range(3))
        tables = ((v0, R), (v1, R1), (v2, R2)), ((0, R2), (v2, R)), ((v0, R1), (v1, R), (v2, R2))
        if all(map(rebounds_rise, tables)):
            break
    p, V, below = draw.choice([0.1, 0.2, 0.3]), draw.uniform(0.3, 2), draw.uniform(0.01, 0.3)
    return form.format(v0=v0, v1=v1, v2=v2, R=R, R1=R1, R2=R2, p=p, V=V, below=below)


def drawn_scene(draw, housed):
    """Numbers of a scene; the places of the stops say whether they are alike."""
    scene = {"f": draw.uniform(0.3, 1.5), "h": draw.choice([0.02, 0.1, 0.3]), "nu": draw.uniform(0.4, 2.5)}
    scene |= {"load": draw.choice([0.0, 0.3]), "x0": draw.uniform(-0.1, 0.1), "v0": draw.uniform(-0.5, 0.5)}
    if housed:
        return scene | {"loose_mass": draw.uniform(0.05, 0.4), "loose_lower": -0.4, "loose_upper": draw.uniform(0.3, 1)}
    gap = draw.uniform(0.1, 0.8)
    return scene | {"stop_lower": -gap, "stop_upper": draw.choice([gap, draw.uniform(0.1, 0.8)])}


TIMES = {
    "steady": "max_periods = 600\n",
    "transient": 'mode = "transient"\nduration = 20\n',
}


class Laws(CommandLine):
    verdicts_of, surely_false = Forgers.verdicts_of, staticmethod(Forgers.surely_false)

    def drawn_certificates(self, count, seed, forms, housed=False, fixed=""):
        """Those of scenes under each law, so many each; and their laws' names."""
        draw = random.Random(f"laws of speed {seed}")
        for name, form in forms.items():
            for kind, time in TIMES.items():
                for turn in range(2):
                    place = self.directory / f"{name} {kind} {turn} {seed} {housed} {bool(fixed)}".replace(" ", "_")
                    place.mkdir()
                    scenes = [drawn_scene(draw, housed) for _ in range(count // 2)]
                    file = certified_scenes(place, scenes, time, drawn_law(draw, form) + fixed)
                    yield from ((name, certificate) for certificate in certificates_in(file))


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
class ClosedForms(Laws):
    def test_a_bouncing_ball_is_proved(self):
        true = [bounces(law, speed, count) for law in LAWS.values() for speed in ("1.3", "3.1") for count in (1, 4, 8)]
        self.assertEqual(self.verdicts_of(true, "true.jsonl"), ["proved"] * len(true))

    def test_another_number_of_a_law_is_refuted(self):
        forged = [
            forgery
            for law in LAWS.values()
            for speed in ("1.3", "3.1", "0.77")
            for forgery in forgeries_of_laws(bounces(law, speed, 8), ("0.999999", "1.000001"))
        ]
        self.assertGreater(len(forged), 60)
        self.assertEqual(set(self.verdicts_of(forged, "forged.jsonl")), {"refuted"})

    def test_another_law_is_refuted(self):
        forged = []
        for law in LAWS.values():
            for other in LAWS.values():
                forgery = bounces(law, "1.3", 6)
                forgery["scene"]["lower"]["restitution"] = other
                forged += [forgery] if law is not other else []
        self.assertEqual(set(self.verdicts_of(forged, "others.jsonl")), {"refuted"})

    def test_a_speed_at_which_the_formula_changes_is_undecided(self):
        """The side is known of no ball, however small: what is proved is up to that impact alone."""
        certificates = [
            bounces(law, str(speed), 3)
            for name, law in LAWS.items()
            if "least" not in name  # a root, which no decimal number is
            for speed in kinks(law)
            if not ("exponent" in law and speed != Decimal(law.get("below", 0)))
        ]
        self.assertGreater(len(certificates), 8)
        self.assertEqual(set(self.verdicts_of(certificates, "kinks.jsonl")), {"undecided"})

    def test_a_claimed_speed_or_time_off_by_little_is_refuted(self):
        forged = []
        for law in LAWS.values():
            certificate = bounces(law, "1.3", 5)
            for at, event in enumerate(certificate["events"]):
                for name in {"time", "v"} & event.keys():
                    wrong = copy.deepcopy(certificate)
                    wrong["events"][at][name][0] = text(Decimal(event[name][0]) + 3 * Decimal(ERROR))
                    forged.append(wrong)
        self.assertEqual(set(self.verdicts_of(forged, "off.jsonl")), {"refuted"})

    def test_the_endless_chatter_of_a_power_ends_where_its_sum_says(self):
        powers = [
            {"R": R, "exponent": p, "reference_speed": V}
            for R, p, V in (("0.7", "0.2", "1"), ("0.5", "0.1", "0.3"), ("0.8", "0.25", "0.4"))
        ]
        true = [chatter(law, speed, listed) for law in powers for speed in ("0.5", "0.02") for listed in (1, 7)]
        self.assertEqual(self.verdicts_of(true, "true.jsonl"), ["proved"] * len(true))
        forged = []
        for certificate in true:
            for off in ("3e-9", "-3e-9", "1e-3"):
                wrong = copy.deepcopy(certificate)
                until = [text(Decimal(certificate["events"][-2]["until"][0]) + Decimal(off)), 1e-9]
                wrong["events"][-2]["until"] = wrong["events"][-1]["time"] = until
                forged.append(wrong)
        self.assertEqual(set(self.verdicts_of(forged, "forged.jsonl")), {"refuted"})

    def test_a_threshold_ends_bounces_without_a_chatter(self):
        """Impacts below it leave nothing, so there is no endless chatter, though times of rests are the same."""
        forged = []
        for name in ("threshold", "power above a threshold", "table without a slow rebound"):
            certificate = bounces(LAWS[name], "1.3", 30)
            *_, before, last, rest = certificate["events"]
            self.assertEqual(rest["event"], "rest")
            ends = {"event": "chatter", "stop": "lower", "time": before["time"], "until": rest["time"]}
            forged.append({**certificate, "events": [*certificate["events"][:-2], ends, rest]})
            ends = {**ends, "time": last["time"]}
            forged.append({**certificate, "events": [*certificate["events"][:-1], ends, rest]})
        self.assertEqual(set(self.verdicts_of(forged, "forged.jsonl")), {"refuted"})


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
class RandomScenes(Laws):
    def check(self, named, least):
        """All are proved, but for a few that stay undecided."""
        told = self.verdicts_of([certificate for _, certificate in named], "drawn.jsonl")
        counts = collections.Counter((name, verdict) for (name, _), verdict in zip(named, told))
        self.assertEqual(told.count("refuted") + told.count("malformed"), 0, counts)
        self.assertGreater(told.count("proved"), least * len(told), counts)
        kinds = {event["event"] for _, certificate in named for event in certificate["events"]}
        return counts, kinds

    def test_motion_between_stops(self):
        named = list(self.drawn_certificates(8, SEED, STOPS))
        counts, kinds = self.check(named, 0.97)
        self.assertEqual({name for name, _ in counts}, set(STOPS))
        self.assertGreaterEqual(kinds, {"impact", "chatter", "rest"})

    def test_motion_between_stops_under_friction(self):
        named = list(self.drawn_certificates(6, SEED + 100, STOPS, fixed="friction = 0.1\n"))
        _, kinds = self.check(named, 0.95)
        self.assertGreaterEqual(kinds, {"impact", "reversal", "rest"})

    def test_a_loose_mass_between_walls(self):
        named = list(self.drawn_certificates(6, SEED + 200, WALLS, housed=True))
        _, kinds = self.check(named, 0.95)
        self.assertGreaterEqual(kinds, {"impact", "press"})

    def test_a_loose_mass_beside_stops(self):
        fixed = drawn_law(random.Random(SEED), STOPS["one of each"]) + "stop_lower = -0.6\nstop_upper = 0.5\n"
        named = list(self.drawn_certificates(6, SEED + 300, WALLS, housed=True, fixed=fixed))
        self.check(named, 0.95)

    def test_no_forgery_is_proved(self):
        draw, forged, false = random.Random(SEED), [], []
        certificates = [one for _, one in self.drawn_certificates(4, SEED + 400, STOPS)]
        certificates += [one for _, one in self.drawn_certificates(4, SEED + 500, WALLS, housed=True)]
        certificates = [one for one in certificates if 0 < len(one["events"]) <= 60]
        for certificate in certificates:
            forged += forgeries_of_laws(certificate)
            try:
                truth = Truth(certificate)
            except Unreliable:
                continue
            if Judge(truth, certificate).reason() is None:
                false += [self.surely_false(truth, draw) for _ in range(max(1, FORGED // len(certificates)))]
        told = self.verdicts_of(forged, "laws.jsonl")
        self.assertGreater(len(told), 100)
        self.assertEqual(told.count("proved"), 0)
        self.assertGreater(told.count("refuted"), 0.9 * len(told))
        false = [one for one in false if one]
        told = self.verdicts_of([forgery for forgery, _, _ in false], "edits.jsonl")
        proved = [(names, reason) for (_, names, reason), verdict in zip(false, told) if verdict == "proved"]
        self.assertEqual(proved, [])
        self.assertGreater(len(told), FORGED / 4)


del Forgers, Laws  # whose tests are its own

if __name__ == "__main__":
    unittest.main()
