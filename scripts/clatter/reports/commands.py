"""The command that computes a point of an output again, as texts and the numbers of the chosen point between them."""

import os
import shlex
from pathlib import Path

import numpy as np

from ..plots.data import FIRST_FAILURE
from .points import keys_along, packed


def shell_word(name):
    """A file's name as a word of bash that no command takes for an option."""
    name = os.fspath(name)
    name = f"./{name}" if name.startswith("-") else name
    if name.isprintable():
        return shlex.quote(name)
    plain = {ord("'"): "\\'", ord("\\"): "\\\\"}
    return "$'" + "".join(plain.get(b, chr(b) if 32 <= b < 127 else f"\\x{b:02x}") for b in os.fsencode(name)) + "'"


def command(output, points):
    """Parts of the command of any point: texts, and numbers {"values"} of its place on "axis", else of the point."""
    if output.is_branch:
        return joined(start(output), branch_settings(output, points), f" -o {point_file(output)}")
    return joined(
        start(output), sweep_settings(output, points), f" -o {point_file(output)}", followed_row(output, points)
    )


def command_notes(output, config):
    """Remarks on the command."""
    notes = [
        f"The command of a point takes the configuration from {shell_word(output.path)}. Where that file isn't, "
        f"download the configuration below and begin with: clatter run {shell_word(config)}"
    ]
    if output.follow:
        notes.append(
            "Each point started from the end of the one before, so the command of a point runs its whole line of the "
            "sweep again, and then prints the point."
        )
    if output.is_branch:
        notes.append(
            "The command of a point computes one period of its motion, stable or not, as a transient from its state at "
            "forcing phase 0."
        )
    if "attractor" in output:
        notes.append("Numbers of motions are those of the whole sweep: a point that runs alone has the number 0.")
    return notes


def start(output):
    return f"clatter info {shell_word(output.path)} --config | clatter run -"


def point_file(output):
    """The file to write, a word of bash: one for each output, since clatter replaces none that has another title."""
    return shell_word(f"{Path(output.path).stem}_point.h5")


def sweep_settings(output, points):
    """Each axis at the value of the point, but that along which the sweep is followed: it takes all its points."""
    section, followed, parts = section_of(output), output.follow, []
    for place, axis in enumerate(output.axes):
        if axis in ("direction", followed):
            continue
        for key in keys_along(output, axis):
            parts += [f" --set {section}.{key}=", {"axis": place, **numbers(output.values(key)[points.kept[place]])}]
    linked = [output[key].dims[0] for key in names_in(output.sweep.get("linked", ""))]
    return [*parts, " --set sweep.linked=''" * (linked != [] and followed not in linked)]


def followed_row(output, points):
    """Words that print the point, since a followed sweep writes the whole line that leads to it."""
    followed = output.follow
    if not followed:
        return []
    failed = bool((output.values("status") >= FIRST_FAILURE).any())
    parts = [f"{';' if failed else ' &&'} clatter export {point_file(output)}"]  # failed points have an exit code, too
    values = output.values(followed)
    if len(np.unique(values)) < len(values) or not np.isfinite(values).all():  # which --where doesn't tell apart
        return [*parts, " | grep -v '^#' | sed -n '1p;", numbers(rows_of(output, points)), "p'"]
    for place, axis in enumerate(output.axes):
        if axis in ("direction", followed):
            parts += [f" --where {axis}=", {"axis": place, **numbers(output.values(axis)[points.kept[place]])}]
    return parts


def rows_of(output, points):
    """Which line of the table of its own line of the sweep each point is, after one of names."""
    line = ("direction", output.follow)
    counts = [len(output.values(axis)) if axis in line else 1 for axis in output.axes]
    rows = np.arange(np.prod(counts)).reshape(counts) + 2
    return np.broadcast_to(rows, output.shape)[np.ix_(*points.kept)]


def branch_settings(output, points):
    """One period of the motion, stable or not, from its state at forcing phase 0."""
    section, kept = section_of(output), points.kept[0]
    keys = {**{key: key for key in output.sweep}, "x0": "x", "v0": "v"}
    if output.has_loose_mass:
        keys |= {"loose_x0": "z", "loose_v0": "w"}
    parts = []
    for key, name in keys.items():
        parts += [f" --set {section}.{key}=", numbers(output.values(name)[kept])]
    parts += [f" --set {section}.phase=0 --set time.mode=transient --set time.duration="]
    parts += [numbers(output.values("period_ratio")[kept] * forcing_periods(output)[kept])]
    for group, key, value in (("observe", "frame", "relative"), ("integrator", "method", "exact")):  # as branches are
        if output.config.get(group, {}).get(key, value) != value:
            parts.append(f" --set {group}.{key}={value}")
    return [*parts, " --set observe.extrema=true --set observe.impacts=true"]


def forcing_periods(output):
    """The forcing period at every point of a branch."""
    key = "frequency" if output.is_si else "nu"
    frequency = output.values(key) if key in output.sweep else float(output.parameter(key)[()])
    period = 1 / frequency if output.is_si else 2 * np.pi / frequency
    return np.broadcast_to(period, output.values("period_ratio").shape)


def section_of(output):
    return "machine" if output.is_si else "scene"


def names_in(text):
    return [name.strip() for name in text.split(",") if name.strip()]


def numbers(values):
    return {"values": packed(values)}


def joined(*parts):
    """Parts in one list, in which texts that meet are one."""
    result = []
    for part in (item for part in parts for item in ([part] if isinstance(part, str) else part)):
        if isinstance(part, str) and result and isinstance(result[-1], str):
            result[-1] += part
        else:
            result.append(part)
    return result
