"""Tables of a page, as HTML: special points, motions, extremes of every result, what became of the points."""

from html import escape

import numpy as np

from ..plots.attractors import name_of
from ..plots.data import FIRST_FAILURE
from ..plots.names import in_one_line
from ..plots.per_period import PER_PERIOD, TOTALS, compared

MOST = 300  # rows
BLANK = "\N{NO-BREAK SPACE}"  # in units, which no line ends within


def table(title, heads, rows, note=""):
    """A table; each cell is a text, or a number to align."""
    body = "".join("<tr>" + "".join(map(cell, row)) + "</tr>" for row in rows[:MOST])
    head = "".join(f"<th scope=col>{escape(str(text))}</th>" for text in heads)
    more = f"{len(rows) - MOST} more rows are only in the file. " if len(rows) > MOST else ""
    notes = f"<p class=note>{escape(more + note)}</p>" if more + note else ""
    return (
        f"<h3>{escape(title)}</h3><div class=wide><table><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table></div>{notes}"
    )


def cell(value):
    if isinstance(value, str):
        return f"<td>{escape(value)}</td>"
    return f"<td class=number>{escape(shown(value))}</td>"


def shown(value):
    """A number with the digits that read back to it."""
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    value = float(value)
    return "–" if np.isnan(value) else str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)


def tables(output, points):
    """Every table that the output has something for."""
    if output.is_branch:
        return special_points(output)
    if output.is_accuracy:
        return methods(output)
    parts = motions(output) if "motion_share" in output else ""
    return parts + (extremes(output, points) if output.axes else "") + outcomes(output)


def special_points(output):
    parameters = [f"special_{name}" for name in output.sweep]
    names = ["special_x", "special_v", "special_impact_speed", "special_period_ratio", "special_word"]
    names = [name for name in (*parameters, *names) if name in output]
    rows = []
    for place, kind in enumerate(output.values("special_kind")):
        pairs = zip(output.values("special_multiplier_re")[place], output.values("special_multiplier_im")[place])
        multipliers = ",  ".join(complex_text(*pair) for pair in pairs)
        rows.append([str(kind), *(plain(output.values(name)[place]) for name in names), multipliers])
    if not rows:
        return "<h3>Special points</h3><p>There are none.</p>"
    heads = [with_unit(name.removeprefix("special_").replace("_", " "), output[name].units) for name in names]
    return table("Special points", ["kind", *heads, "multipliers"], rows)


def complex_text(real, imaginary):
    return f"{real:.9g}" if imaginary == 0 else f"{real:.9g}{imaginary:+.9g}i"


def plain(value):
    return str(value) if isinstance(value, str) else value


def motions(output):
    """Each motion with its share of the starts; if parameters vary, the largest, where that is, and at how many."""
    shares = output.values("motion_share")
    parameters = output["motion_share"].dims[:-1]
    rows = []
    for motion in np.argsort(-shares.reshape(-1, shares.shape[-1]).max(axis=0), kind="stable"):
        index = np.unravel_index(np.argmax(shares[..., motion]), shares.shape[:-1])
        row = [motion, name_of(output, motion)]
        row += [output.values(f"motion_share{end}")[(*index, motion)] for end in ("", "_low", "_high")]
        if parameters:
            row += [", ".join(place_of(output, axis, i) for axis, i in zip(parameters, index))]
            row += [np.count_nonzero(shares[..., motion])]
        rows.append([*row, *(output.values(f"motion_{name}")[motion] for name in ("period_ratio", "x", "v"))])
    where = ["at", f"found at, of {shares[..., 0].size}"] if parameters else []
    share = "largest share" if parameters else "share"
    states = [with_unit(sign, output[f"motion_{name}"].units) for sign, name in (("x", "x"), ("x′", "v"))]
    heads = ["number", "motion", share, "at least", "at most", *where, "periods of the force", *states]
    note = "The bounds of a share hold with 95 % confidence; x and x′ are the motion's state at forcing phase 0"
    return table("Motions", heads, rows, note + (", at the first parameters that have it." if parameters else "."))


def extremes(output, points):
    rows, of_all = [], compared(output)
    for name, variable, part in points.columns:
        if variable.name in TOTALS and PER_PERIOD in of_all[variable.name].long_name:
            name, variable = f"{name} {PER_PERIOD}", of_all[variable.name]
        values = variable.values[(..., *part)]
        if values.dtype.kind not in "fiu" or name == "status":
            continue
        known = np.isfinite(values.astype(float))
        if not known.any():
            continue
        least, most = (find(np.where(known, values, bad)) for find, bad in ((np.argmin, np.inf), (np.argmax, -np.inf)))
        row = [with_unit(name, variable.units)]
        for flat in (least, most):
            index = np.unravel_index(flat, values.shape)
            row += [values[index], ", ".join(place_of(output, axis, i) for axis, i in zip(output.axes, index))]
        rows.append([*row, int(np.size(known) - np.count_nonzero(known))])
    return table("Extremes", ["result", "least", "at", "greatest", "at", "points without value"], rows)


def place_of(output, axis, index):
    number, units = shown(output.values(axis)[index]), output[axis].units
    return f"{axis} = {number}" if units == "1" else f"{axis} = {number}{BLANK}{in_one_line(units)}"


def with_unit(name, units):
    """The name of numbers of a table, and their unit in brackets if they have one."""
    return name if units == "1" else f"{name} ({in_one_line(units).replace(' ', BLANK)})"


def outcomes(output):
    codes, counts = np.unique(output.values("status"), return_counts=True)
    rows = []
    for code, count in zip(codes, counts):
        meaning = output.meanings.get(int(code), str(code)).replace("_", " ")
        rows.append([meaning, "failed" if code >= FIRST_FAILURE else "done", int(count)])
    return table("What became of the points", ["status", "", "points"], rows)


def methods(output):
    """The rows of accuracy at the first point."""
    names = [name for name, variable in output.variables.items() if variable.dims[-1:] == ("row",)]
    first = {name: output.values(name)[(0,) * (output[name].values.ndim - 1)] for name in names}
    rows = []
    for place in range(len(first["method"])):
        row = [first[name][place] for name in names if name != "method"]
        rows.append([output.methods.get(int(first["method"][place]), "?"), *map(plain, row)])
    heads = [with_unit(name, output[name].units) for name in names if name != "method"]
    return table("Methods and settings", ["method", *heads], rows)
