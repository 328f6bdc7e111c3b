"""Which part of an output a picture shows: curves over one axis, one for each value of another, or a map over two."""

import difflib
import itertools
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .._program import WRONG_USE, ClatterError
from .along import led_by, scattered, swept_keys
from .data import PHASE, STARTS, Output
from .names import equation, plain, symbol
from .per_period import TOTALS, compared
from .written import misfit

FEW = 6  # values of an axis that make a family of curves rather than a map
MOST = 12  # curves that can be told apart


class ChoiceProblem(ClatterError):
    """A choice that the file doesn't offer; the message is one line that names it and how to fix it."""

    def __init__(self, message):
        super().__init__(message, WRONG_USE)


@dataclass
class Member:
    """One of several outputs in a picture, over the same axes as the others, and its name in the legend."""

    title: str
    output: Output


def members_of(output, along="", over="", at=(), scatter=""):
    """The outputs that share the picture of one file, at most one of them if they have two axes. Where points are
    compared, totals are per forcing period."""
    members = chosen_members(compared(output), along, over, at, scatter)
    if not members[0].output.axes:
        members = chosen_members(output, along, over, at, scatter)
    return [Member(member.title, member.output.without_infinite_values()) for member in members]


def chosen_members(output, along, over, at, scatter):
    """The same with all the values of their axes, infinite ones, too."""
    for key in (along, over, *(name for name, _ in at)):
        output = led_by(output, key)
    several = []  # axes of which some values are chosen: each has its own curves
    for axis in dict.fromkeys(axis for axis, _ in at):
        require_axis(output, axis, "--at")
        indexes = list(dict.fromkeys(index_at(output, axis, value) for name, value in at if name == axis))
        if len(indexes) > 1:
            output = output.picked(axis, indexes)
            several.append(axis)
        else:
            output = output.at(axis, indexes[0])
    if scatter:
        return [Member("", scattered_over(output, scatter, along, over))]
    if along in several:
        raise ChoiceProblem(
            f"--along {along}: --at chooses values of it, which are a curve each; leave one of them out"
        )
    for axis, option in ((along, "--along"), (over, "--over")):
        if axis:
            require_axis(output, axis, option)
    if along and output.is_cloud:
        output = scattered(output, along)
    if along and along == over:
        raise ChoiceProblem(f"--along and --over both name '{along}'; name two axes")
    if len(output.axes) < 2:
        if over or several:
            option = f"--over {over}" if over else f"--at {several[0]}"
            raise ChoiceProblem(f"{option}: no axis is left to draw along; the file has {axes_text(output)}")
        return [Member("", output)]
    families = families_of(output, along, over, several)
    if not families:
        return [Member("", map_of(output, along))]
    along = along or longest(output, families)
    for axis in output.axes:
        if axis not in (along, *families):
            output = output.at(axis, 0)
    return [Member(*part) for part in parts(output, families)]


def scattered_over(output, key, along, over):
    """All points of the output over a key that is swept."""
    if along or over:
        raise ChoiceProblem(f"--scatter {key} conflicts with --{'along' if along else 'over'}; leave one of them out")
    if key not in swept_keys(output):
        there = ", ".join(swept_keys(output)) or "no keys"
        raise ChoiceProblem(f"--scatter: '{key}' isn't swept in this file; there are {there}")
    return scattered(output, key)


def families_of(output, along, over, several):
    """The axes of which each value has its own curves; none for a map."""
    others = [axis for axis in output.axes if axis != (along or longest(output))]
    if over or several:
        families = [axis for axis in output.axes if axis in (over, "direction", *several) and axis != along]
        if len(families) == len(output.axes):
            raise ChoiceProblem(f"--at {', '.join(several)}: no axis is left to draw along")
        if curves(output, families) > MOST:
            option = f"--over {over}" if over else f"--at {', '.join(several)}"
            raise ChoiceProblem(f"{option}: {curves(output, families)} curves; at most {MOST}: choose some with --at")
        return families
    return others if curves(output, [axis for axis in others if axis != "direction"]) <= FEW else []


def curves(output, axes):
    return int(np.prod([len(output.values(axis)) for axis in axes], dtype=int))


def longest(output, without=()):
    """The axis with the most values, the last of equals, which varies fastest."""
    axes = [axis for axis in output.axes if axis not in without]
    return max(reversed(axes), key=lambda axis: len(output.values(axis)))


def map_of(output, along):
    """The output over two axes, the abscissa first; further axes at their first value."""
    first = along or next(axis for axis in output.axes if axis != "direction")
    second = next(axis for axis in output.axes if axis not in (first, "direction"))
    for axis in output.axes:
        if axis not in (first, second):
            output = output.at(axis, 0)
    return output.in_order((first, second))


def parts(output, families):
    """(title, output) for each combination of the values of these axes."""
    for indexes in itertools.product(*(range(len(output.values(axis))) for axis in families)):
        part, names = output, []
        for axis, index in zip(families, indexes):
            keys = [
                axis,
                *(key for key in output.sweep if key != axis and key in output and output[key].dims == (axis,)),
            ]
            names += [equation(output, key, output.values(key)[index]) for key in keys]
            part = part.at(axis, index)
        yield ", ".join(names), part


def require_axis(output, axis, option):
    if axis in output.axes:
        return axis
    raise ChoiceProblem(f"{option}: '{axis}' is no axis of this file, which has {axes_text(output)}")


def axes_text(output):
    return ", ".join(output.axes) or "none"


def index_at(output, axis, value):
    """The index of the value of an axis that is nearest to this one. Throws beyond its range, or if its unit doesn't
    fit."""
    if why := misfit(value, output[axis].units):
        raise ChoiceProblem(f"--at {axis}: {why}")
    values = output.values(axis).astype(float)
    low, high = values.min(), values.max()
    if not low <= value <= high:
        raise ChoiceProblem(f"--at {axis}={value:g}: beyond the axis, which goes from {low:g} to {high:g}")
    return int(np.argmin(np.abs(values - value)))


def results_named(members, only):
    """The results that --only names, by themselves or by their key of [observe]; empty if it names none."""
    output, results = members[0].output, []
    there = [name for name in output.results() if name != "status"]
    there += [name for name in (PHASE,) if name in output and name not in there]
    observed = {name: output[name].observable for name in there if output[name].observable}
    keys = list(dict.fromkeys(observed.values()))
    for name in only:
        if name not in there + keys:
            near = difflib.get_close_matches(name, there + keys, 1)
            hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(keys + there)}"
            raise ChoiceProblem(f"--only: '{name}' is no result in {output.path}; {hint}")
        results += [name] if name in there else [result for result, key in observed.items() if key == name]
    return results


def together(outputs):
    """One member for each file, if all hold curves over the same axis in the same units; else None."""
    units = {(output.axes, output.is_si) for output in outputs}
    totals = [{output[name].label for output in outputs if name in output} for name in TOTALS]
    if len(units) != 1 or len(outputs) > MOST or any(len(labels) > 1 for labels in totals):
        return None
    names = differences(outputs)
    return [Member(name, output) for name, output in zip(told_apart(names, outputs), outputs)]


def told_apart(names, outputs):
    """The names, those that several outputs share with the names of their files."""
    if len(set(names)) == len(names):
        return names
    stems = [plain(Path(output.path).stem) for output in outputs]
    return [f"{stem}: {name}" if name else stem for name, stem in zip(names, stems)]


def differences(outputs):
    """The keys of its scene in which each output isn't as all others are, e.g. R = 0.6; empty texts if none differs."""
    keys = differing_keys(outputs)
    return [", ".join(filter(None, (own_value(output, key) for key in keys))) for output in outputs]


def differing_keys(outputs):
    """The keys of the scene that differ between outputs. Branches only begin at a start, so it doesn't tell them
    apart."""
    keys = dict.fromkeys(key for output in outputs for key in (*output.scene, *output.sweep))
    return [key for key in keys if len({condition(output, key) for output in outputs if matters(output, key)}) > 1]


def matters(output, key):
    return key != "direction" and not (output.is_branch and key in STARTS)


def condition(output, key):
    """What tells outputs apart: a value with its unit, or that the output has values of the key along an axis."""
    return "varies" if varies(output, key) else (output.scene.get(key), output.units.get(key))


def varies(output, key):
    """Whether a key of the scene has values along an axis of the output, its own or that of another key."""
    return key in output.sweep and key in output


def own_value(output, key):
    """The value of a key as text; empty if the output has none."""
    if varies(output, key):
        return f"{symbol(output, key)} along {symbol(output, output[key].dims[0])}"
    value = output.scene.get(key)
    return equation(output, key, value) if is_number(value) and matters(output, key) else ""


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)
