"""Restitution that depends on the speed, as certificates state it: see apps/verify/README.md for their format.

Numbers are those of a type: doubles, or decimals of many digits.
"""

from decimal import Decimal


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
