"""Restitution that depends on the speed, as certificates state it: see apps/verify/README.md for their format.

Numbers are those of a type: doubles, or decimals of many digits.
"""

from decimal import Decimal

LAWS = {
    "power": {"R": "0.7", "exponent": "0.2", "reference_speed": "1"},
    "power down to its least": {"R": "0.4", "exponent": "0.5", "reference_speed": "1.1"},
    "threshold": {"R": "0.7", "below": "0.3"},
    "table": {"table": [["0.1", "0.9"], ["0.5", "0.8"], ["2", "0.6"]]},
    "table in units": {"table": [["0.1", "0.9"], [1, "0.8"], ["4", "0.6"]], "unit": "0.37", "below": "0.05"},
    "power above a threshold": {"R": "0.7", "exponent": "0.2", "reference_speed": "1.5", "below": "0.2"},
    "table from 0": {"table": [[0, "0.4"], [1, "0.9"]]},
    "table without a slow rebound": {"table": [["0.3", 0], ["1", "0.9"]]},
}


def law_of(rigid):
    """The law of a rigid stop or of a wall: an object, also if R is one number."""
    return rigid.get("restitution") or {"R": rigid["R"]}


def share(law, speed, number=float):
    """The share of its speed that an impact keeps."""
    if speed < number(law.get("below", 0)):
        return number(0)
    if "table" in law:
        return share_of_table(law, speed, number)
    R = number(law["R"])
    if "exponent" not in law:
        return R
    p, ratio = number(law["exponent"]), speed / number(law["reference_speed"])
    return max(1 - (1 - R) * ratio**p, p / (1 + p)) if ratio > 0 else number(1)


def share_of_table(law, speed, number):
    unit = number(law.get("unit", 1))
    knots = [(number(v) * unit, number(R)) for v, R in law["table"]]
    if speed <= knots[0][0]:
        return knots[0][1]
    for (v, R), (faster, R_there) in zip(knots, knots[1:]):
        if speed <= faster:
            return R + (R_there - R) * (speed - v) / (faster - v)
    return knots[-1][1]


def ends_in_chatter(law):
    """Whether the slowest impacts rebound, so that a mass comes to rest after infinitely many."""
    return share(law, 1e-200) > 0


def kinks(law):
    """The speeds at which its formula changes."""
    below = Decimal(law.get("below", 0))
    knots = [Decimal(v) * Decimal(law.get("unit", 1)) for v, _ in law.get("table", [])]
    kinks = [speed for speed in [below, *knots] if speed >= below and speed > 0]
    if "exponent" in law and Decimal(law["R"]) < 1:
        p, V = Decimal(law["exponent"]), Decimal(law["reference_speed"])
        kinks.append(V * (1 / (1 + p) / (1 - Decimal(law["R"]))) ** (1 / p))
    return kinks
