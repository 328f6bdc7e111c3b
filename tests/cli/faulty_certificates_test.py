"""What commit 1e9e6fe answered wrongly is refuted, for the reason of its fault; the right answers are proved.

faulty_certificates.jsonl holds what that commit made of `../shared/faults/`: its periods, logs, extrema, multipliers
and symmetry. A log tells its numbers without an error; 1e-9 is a million times their last digit. The file has no times
of chatter, rest and release: they follow from its last impact and the scene. Starts of branches are those of its
points; their events are those of clatter's motion from there. A log that doesn't close is a transient from its last
impact to the end of its period, at which it claims the state that it began with.

Environment: CLATTER and CLATTER_VERIFY, the programs.
"""

import json
import unittest
from pathlib import Path

import h5py

from certified_runs import VERIFY, certified, verified
from command_line import CommandLine

FAULTY = Path(__file__).with_name("faulty_certificates.jsonl")

REASONS = {  # what is said of it, and first
    "false_period": r"event 149, impact at the upper stop: claimed, found impact at the lower stop",
    "false_period_simple": r"event 94, impact at the upper stop: claimed, found impact at the lower stop",
    "log_of_twelve": r"event \d+, impact at the \w+ stop, time: claimed \S+ to 1e-09, found",
    "log_does_not_close": r"end, x: claimed -0.0968036\d* to 1e-09, found \[-0.0968796",
    "log_v_after": r"event 10, separation at the upper stop, v: claimed -0.000139\d* to \S+, found \[-0.0043714792",
    "chatter_ceiling": r"event 2, chatter at the lower stop: claimed, found impact at the upper stop, time \[0.16182",
    "chatter_high_rebounds": r"x_max: claimed 0.01 to \S+, found \S*0.219733",
    "chatter_high_rebounds: trajectory": r"end, x: claimed 0 to 1e-09, found \[0.0686674695",
    "branch_pressed: flip": r"multiplier 1, real part: claimed -1.0\d* to \S+, found \[-0.977290",
    "branch_pressed: fold": r"multiplier 1, real part: claimed 0.99\d* to \S+, found \[0.8522673",
    "branch_not_minimal": r"periods: claimed 4, found 2",
    "hidden_symmetry": r"symmetric: claimed false, found true",
}

PERIODS = {  # the right ones
    "false_period": 22,
    "false_period_simple": 26,
    "log_of_twelve": 12,
    "log_does_not_close": 28,
    "branch_pressed: flip": 1,
    "branch_pressed: fold": 1,
    "branch_not_minimal": 2,
    "hidden_symmetry": 1,
}
# of motion that rests, which any start ends in, and that double loses: it is certified in 50 digits
LONG = {"false_period", "false_period_simple", "log_does_not_close", "log_of_twelve"}


def faulty_certificates():
    for line in FAULTY.read_text(encoding="utf-8").splitlines():
        certificate = json.loads(line)
        yield certificate["name"], certificate


def config_of(certificate):
    """A run of the same scene, from the same start if this decides what it settles on."""
    scene, start = certificate["scene"], certificate["start"]
    is_transient = certificate["claim"] == "transient" and certificate["name"] not in PERIODS
    values = {"stiffness" if name == "k" else name: scene[name] for name in ("h", "k", "f", "nu", "load", "phase")}
    for side in ("lower", "upper"):
        for name, value in scene.get(side, {}).items():
            key = {"position": "stop", "R": "R", "stiffness": "stop_stiffness", "damping": "stop_damping"}[name]
            values[f"{key}_{side}"] = value
    if "x" in start and certificate["name"] not in LONG:
        x, v = start["x"], start["v"]
        values |= {"x0": x, "v0": v} if is_transient else {"x0": x[0], "v0": v[0]}
    time, observed = "max_periods = 2000\n", ("extrema", "period", "word", "stability")
    if is_transient:
        time, observed = f'mode = "transient"\nduration = {certificate["end"]["time"]}\n', ("extrema",)
    lines = "".join(f"{name} = {value}\n" for name, value in values.items())
    return f"[scene]\n{lines}[time]\n{time}[observe]\n" + "".join(f"{name} = true\n" for name in observed)


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
class FaultyCertificates(CommandLine):
    def test_each_wrong_answer_is_refuted_for_its_reason(self):
        found = {claim["line"]: claim for claim in verified(FAULTY)["claims"]}
        names = []
        for number, (name, _) in enumerate(faulty_certificates(), 1):
            names.append(name)
            with self.subTest(name):
                claim = found.get(number, {"verdict": "proved", "remarks": [""]})
                self.assertEqual(claim["verdict"], "refuted")
                self.assertRegex("\n".join(claim["remarks"]), f"(?m)^refuted: {REASONS[name]}")
        self.assertEqual(sorted(names), sorted(REASONS))

    def test_the_right_answers_are_proved(self):
        for name, certificate in faulty_certificates():
            with self.subTest(name):
                config = self.write("a.toml", config_of(certificate))
                result = self.clatter("run", config, "-q", "-o", "a.h5", "--force")
                self.assertEqual(result.returncode, 0, result.stderr)
                if name in PERIODS:
                    with h5py.File(self.directory / "a.h5") as file:
                        self.assertEqual(file["period_ratio"][()], PERIODS[name])
                count, said = certified(self.directory / "a.h5", self.directory / "a.jsonl")
                self.assertEqual(count, 1, said)
                verdicts = verified(self.directory / "a.jsonl")
                self.assertEqual(verdicts["proved"], 1, verdicts["claims"])


if __name__ == "__main__":
    unittest.main()
