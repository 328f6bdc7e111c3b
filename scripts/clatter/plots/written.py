"""Numbers of a command line, with units or without. The program reads units: here is no list of them."""

import argparse
import json
import re
import subprocess

from .._command import run_child
from .._program import program

LONGEST = 60  # seconds that the program may take for one
WITH_UNIT = r"[-+\u2010-\u2015\u2212]?(\d|\.\d|pi).*"  # a typeset minus is told by the program


class Written(float):
    """A number in the SI unit `units`, which was written with `unit`; both are "" if it was written without one."""

    units = unit = ""


class Limits(tuple):
    """Two limits, and the SI unit and the unit that they were written with, as above."""

    units = unit = ""


def finite(word, text, wanted):
    """A finite number; `text` is the whole argument, `wanted` what it should be."""
    word = word.strip()
    try:
        value = Written(word)
    except ValueError:
        value = read_by_program(word, text) if re.fullmatch(WITH_UNIT, word) else Written("nan")
    if not abs(value) < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}' is no {wanted}")
    return value


def read_by_program(word, text):
    """A number with its unit as the program reads it."""
    found = program()
    try:
        told = run_child([found, "help", "--json", "--", word], LONGEST) if found else None
    except (OSError, subprocess.TimeoutExpired):
        told = None
    if told is None:
        raise argparse.ArgumentTypeError(
            f"'{text}': units can't be understood without the program clatter; write numbers alone, in the units of "
            "the file, or name the program in the variable CLATTER"
        )
    if told.returncode != 0:
        raise argparse.ArgumentTypeError(told.stderr.strip().removeprefix("clatter: "))
    answer = json.loads(told.stdout)
    value = Written(answer["value"])
    if answer["unit"] is not None:
        value.units, value.unit = answer["units"], answer["unit"]
    return value


def limits(text):
    """The two numbers of A,B; both have units that mean the same, or neither has; 0 needs none."""
    parts = [finite(part, text, "A,B, e.g. 0.9,1.1 or '10 Hz,40 Hz'") for part in text.split(",")]
    if len(parts) != 2 or parts[0] == parts[1]:
        raise argparse.ArgumentTypeError(f"'{text}' is no pair of limits; write A,B, e.g. 0.9,1.1 or '10 Hz,40 Hz'")
    known = [part for part in parts if part.unit]
    if any(part.units != known[0].units for part in parts if known and (part.unit or part != 0)):
        raise argparse.ArgumentTypeError(f"'{text}': give both limits units of one kind, or none")
    pair = Limits(parts)
    if known:
        pair.units, pair.unit = known[0].units, known[0].unit
    return pair


def misfit(value, units):
    """Why numbers with a unit are none in the unit of a file; "" if they are, or have none."""
    unit = getattr(value, "unit", "")
    if not unit or value.units == units:
        return ""
    has = "has none; give numbers alone" if units == "1" else f"is in {units}"
    return f"the unit '{unit}' doesn't fit: it {has}"
