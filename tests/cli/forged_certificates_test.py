"""False certificates that clatter-verify once proved are refuted, for the reason why they are false.

forged_certificates.jsonl holds them, and what is true of the same motion as a control.

Environment: CLATTER and CLATTER_VERIFY, the programs.
"""

import json
import tempfile
import unittest
from pathlib import Path

from certified_runs import VERIFY, verified

FORGED = Path(__file__).with_name("forged_certificates.jsonl")

REASONS = {  # what is said of each, None: it is true, and proved
    "a rest within the period, and no return": "the stop lets the mass go within the period, and it doesn't come back",
    "a transient that ends within a chatter": "event 4, rest at the upper stop: claimed until before its time",
    "twice the period, from within a chatter": "periods: claimed 2, and one stop lets the mass go 2 times in them",
    "a released motion that isn't symmetric": "symmetric: claimed true, found false",
    "three times the period of a symmetric fold": "periods: claimed 3, found 1",
    "one period of that fold": None,
    "x_min of a chatter that isn't followed": r"x_min: claimed 5 to 5, found \[-0\.0413737815",
    "a chatter left out on one side of a symmetric motion": "event 2, rest at the lower stop: claimed, and neither",
    "twice the period, a chatter left out": "event 14, press at the upper wall: claimed, and neither",
    "a stick after the end": "event 2, stick: claimed before the end of event 1",
    "one stick": None,
    "one stick, and another end": r"end, x: claimed 0 to 0, found \[0.2999999",
    "a rest twice": "event 2, rest at the upper stop: claimed before the end of event 1",
    "no stop, where one soft stop pushes for ever": r"word: claimed '-', found '\(U\)'",
    "one soft stop that pushes for ever": None,
    "no stop, where one hardly pushes after 1e6 periods": r"word: claimed '-', found '\(U\)'",
    "a chatter from the impact of the start on": None,
    "a rest of 1e16 turns that lasts too long": r"event 1, rest at the upper stop, until: .* \[62831853071795887\.2",
    "a chatter that hides all impacts": r"event 1, chatter at the upper stop: claimed, found impact at the upper stop",
    "a motion that ends before its release": "end: claimed before the stop releases the mass",
    "x_min beyond the end of a long motion": r"x_min: claimed -0\.9998\d* to 1e-08, found \[-0\.99950099362",
    "a fold, but for friction": "special points under dry friction",
    "twice the period of a press throughout": "periods: claimed 2, found 1",
    "a chatter without an impact, from the stop on": "event 1, chatter at the upper stop: claimed, found",
    "the fastest impact, beside a chatter that hides a faster one": "how fast the impacts within a chatter are",
    "the symmetry of a motion within one soft stop": "symmetric: claimed true, found false",
    "a motion within one soft stop": None,
    "the symmetry of a free motion before one stop": "symmetric: the scene isn't, to its last digit",
    "the symmetry of a free motion between two stops": None,
    "a fold of a restitution above 1": r"parameter: the found one makes 1 - R of the scene \[-0\.0006368",
    "a graze of a negative damping": r"parameter: the found one makes h of the scene \[-9\.9478",
    "a graze at a value that one of two numbers has": r"parameter: claimed 0\.1 to 1e-10, .* at \[0\.9571409191",
    "chatters on a wall about an impact on a stop": None,
    "a chatter on a wall that hides an impact on a stop": "event 3, chatter at the lower wall: claimed, found impact",
    "a press that a touch divides": None,
    "a press that a touch divides, as one": r"event 1, press at the lower wall, until: .* found \[1\.97839568",
    "a touch within a press": "event 2, touch at the upper stop: claimed before the end of event 1",
    "a strike that ends a rest": None,
    "a rest that no strike ends": "event 8, press at the upper wall: claimed, and neither",
    "a strike before the rest that it ends": "event 7, impact at the upper wall: claimed, found that",
    "a strike that ends a stick": None,
    "a stick beyond a strike": r"event 3, stick, until: .* found \[15\.21739118",
}
UNDECIDED = {
    "the fastest impact, beside a chatter that hides a faster one",
    "a fold, but for friction",
    "the symmetry of a free motion before one stop",
}


def forged():
    return [json.loads(line) for line in FORGED.read_text(encoding="utf-8").splitlines()]


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
class ForgedCertificates(unittest.TestCase):
    def test_each_is_refuted_for_its_reason_and_what_is_true_is_proved(self):
        found = {claim["line"]: claim for claim in verified(FORGED)["claims"]}
        names = [certificate["name"] for certificate in forged()]
        self.assertEqual(sorted(names), sorted(REASONS))
        for number, name in enumerate(names, 1):
            with self.subTest(name):
                claim = found.get(number, {"verdict": "proved", "remarks": []})
                verdict = "undecided" if name in UNDECIDED else "refuted" if REASONS[name] else "proved"
                self.assertEqual(claim["verdict"], verdict)
                if REASONS[name]:
                    self.assertRegex("\n".join(claim["remarks"]), f"(?m)^{verdict}: {REASONS[name]}")

    def test_what_is_held_to_the_end_begins_nothing_however_wide_the_errors(self):
        """Times and errors that don't contradict each other leave the found list alone to refute it."""
        for name, event in (("a stick after the end", "stick"), ("a rest twice", "rest at the upper stop")):
            (certificate,) = [one for one in forged() if one["name"] == name]
            certificate["events"][1]["time"] = [1, 1]
            self.assertIn(f"event 2, {event}: claimed, ", self.remark_of(certificate))
        (certificate,) = [one for one in forged() if one["name"] == "a transient that ends within a chatter"]
        certificate["events"][3]["until"] = [5.7, 5]
        self.assertIn(
            "event 3, chatter at the upper stop: claimed, found no further event", self.remark_of(certificate)
        )

    def test_a_parameter_is_the_number_of_the_scene_that_it_moves(self):
        (certificate,) = [one for one in forged() if one["name"] == "one period of that fold"]
        certificate["parameter"][0] += 0.1
        self.assertRegex(
            self.remark_of(certificate),
            r"^refuted: parameter: claimed 1.52\d* to \S+, the scene is that at \[?1.42486182",
        )
        certificate["parameter"][0] *= -1
        self.assertRegex(self.remark_of(certificate), "^refuted: parameter: claimed -1.52")

    def test_a_phase_that_moves_with_the_parameter_shifts_time_alone_and_is_for_people(self):
        (certificate,) = [one for one in forged() if one["name"] == "one period of that fold"]
        for slope, names in ((0, set()), (0.5, {"slopes.phase"}), ("-3e1", {"slopes.phase"})):
            certificate["slopes"]["phase"] = slope
            found = self.found_of(certificate)
            self.assertEqual((found["proved"], set(found["for_people"]) - {*certificate}), (1, names))
        certificate["slopes"] = {"phase": 1}
        found = self.found_of(certificate)
        self.assertEqual((found["proved"], found["for_people"][-2:]), (0, ["slopes.phase", "special"]))
        self.assertIn("parameter", found["for_people"])

    @staticmethod
    def found_of(certificate):
        with tempfile.NamedTemporaryFile("w", suffix=".jsonl") as file:
            file.write(json.dumps(certificate))
            file.flush()
            return verified(file.name)

    def remark_of(self, certificate):
        (claim,) = self.found_of(certificate)["claims"]
        self.assertEqual(claim["verdict"], "refuted")
        return claim["remarks"][0]


if __name__ == "__main__":
    unittest.main()
