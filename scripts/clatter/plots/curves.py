"""Panels of results over the only axis, with the status of the points, and those of a single point."""

import re
from itertools import product

import numpy as np
from matplotlib import ticker

from .changes import changes_of_motion
from .data import ESCAPED, has_failed, lacks_period
from .scales import COUNTS, is_integer, shown_values
from .per_period import IN_TIME, PER_PERIOD
from .names import YES_OR_NO, amount, in_frame, label, plain, result_in_words, symbol, with_unit
from .shown import note_results
from .style import BLUE, STOP, colour_of, draw_walls, legend_above, set_axis

MARGIN = 0.012  # of an axis beside its points
DENSE = 60  # points from which a curve is drawn without markers
LONGEST = 24  # letters of a text in a table
LONGEST_LABEL = 30  # letters of a label beside a panel
MANY = 2000  # markers from which on they are an image in vector formats
SHARED = {  # the label of results in one panel; alone each has its own
    frozenset({"x_min", "x_max"}): r"displacement $x$",
    frozenset({"v_min", "v_max"}): "velocity $x$\N{PRIME}",
    frozenset({"y_min", "y_max"}): "displacement $y$ of the loose mass",
    frozenset({"z_min", "z_max"}): "place in the housing $z$",
    frozenset({"v_before", "v_after"}): "velocity at impact $x$\N{PRIME}",
    frozenset({"work_in", "loss_damping", "loss_friction"}): f"energy {IN_TIME}",
}


def draw_branch(axes, output, name, values, color, title, loose_color=None, result="", **style):
    """One result along the only axis: a line through the points that repeat, hollow markers for those that don't. The
    line ends where the motion becomes another one, and that of a count where it changes."""
    along, loose = output.values(name), lacks_period(output.values("status"))
    ends = changes_of_motion(output, result) | jumps_of(values, result in COUNTS)
    along, values, loose = split_at(ends, along, values, loose)
    steady = np.where(loose, np.nan, values)
    marker = "." if len(along) < DENSE else None
    style = {"lw": 1.2, "marker": marker, **style}
    axes.plot(along, steady, label=title, color=color, rasterized=bool(style["marker"]) and len(along) > MANY, **style)
    alone, hidden = lonely(steady), f"_{title}" if title else None  # an entry that no legend shows
    axes.plot(
        along[alone],
        steady[alone],
        label=hidden,
        ls="none",
        marker=".",
        ms=style.get("ms", 3.2),
        color=color,
        rasterized=alone.sum() > MANY,
    )
    axes.plot(
        along[loose],
        values[loose],
        label=hidden,
        ls="none",
        marker="o",
        ms=3.2,
        mfc="white",
        mec=loose_color or color,
        mew=0.8,
        zorder=3,
        rasterized=loose.sum() > MANY,
    )


def jumps_of(values, is_count=False):
    """Whether the next value doesn't continue what is before and after it, as far as many values tell; of a count,
    whether it changes."""
    step = np.diff(values)
    if is_count:
        return np.isfinite(step) & (step != 0)
    if len(values) < DENSE or not np.isfinite(step).any():
        return np.zeros(len(step), bool)
    after, before = np.append(step[1:], 0.0), np.insert(step[:-1], 0, 0.0)
    around = np.fmax(*(np.where(np.sign(beside) == np.sign(step), np.abs(beside), 0.0) for beside in (before, after)))
    extent = np.nanmax(values) - np.nanmin(values)
    return (np.abs(step) > 0.01 * extent) & (np.abs(step) > 4 * around)


def split_at(ends, along, values, loose):
    """Puts a gap between a point and the next where a line ends: no motion lies between."""
    ends = np.flatnonzero(ends) + 1
    return np.insert(along, ends, along[ends]), np.insert(values, ends, np.nan), np.insert(loose, ends, False)


def lonely(values):
    """Points that no line reaches, since both neighbours are missing."""
    known = np.isfinite(values)
    beside = np.append(known[1:], False) | np.insert(known[:-1], 0, False)
    return known & ~beside


def name_statuses(axes, output, name, color=STOP, shown=True):
    """Legend entries for points without a known period, and failed points marked at the foot of the panel."""
    along, status = output.values(name), output.values("status")
    loose = status[lacks_period(status)]
    if loose.size and shown:
        kinds = np.unique(loose)  # one name for both: with two the legend is wider than the panel
        title = plain(output.meanings.get(int(kinds[0]), "aperiodic")) if kinds.size == 1 else "no known period"
        style = {"ls": "none", "marker": "o", "ms": 3.8, "mfc": "white", "mec": color, "mew": 0.9}
        axes.plot([], [], color=color, label=title, **style)  # one colour in all panels, so one entry in their legend
    failed = has_failed(status)
    if failed.any():
        kinds = ", ".join(plain(output.meanings.get(int(kind), "failed")) for kind in np.unique(status[failed]))
        mark_foot(axes, along[failed], f"failed: {kinds}", marker="x", ms=5, mew=1.1, color="#c00000")
    escaped = status == ESCAPED
    if escaped.any():
        mark_foot(axes, along[escaped], "escaped", marker="^", ms=4, mew=0.9, mfc="none", color=color)


def mark_foot(axes, along, title, **style):
    """Markers at the foot of a panel, for points without results."""
    foot = np.full(len(along), 0.03)
    style = {"transform": axes.get_xaxis_transform(), "ls": "none", "clip_on": False, "zorder": 4, **style}
    axes.plot(along, foot, label=title, **style)


def draw_stops_along(axes, output, name):
    """The stops in a panel of displacements over a swept axis."""
    along, (lower, upper) = output.values(name), output.reach()
    words = "reach of the stops" if output.is_absolute or output.stops_move else "stops"
    if np.ptp(lower) == 0.0 and np.ptp(upper) == 0.0 or not np.isfinite([lower, upper]).all():
        return draw_walls(axes, lower.flat[0], upper.flat[0], named=words)
    if output.is_cloud:  # no line runs along its points
        return None
    for place, stop in enumerate((lower, upper)):
        axes.plot(along, stop, color=STOP, lw=1.0, ls=(0, (5, 2)), zorder=1.5, label=None if place else words)
    return None


def curves(members, group, axes):
    """One panel of related results over the only axis; `group` lists (variable, component or None, title)."""
    output, first, name = members[0].output, group[0][0], members[0].output.axes[0]
    note_results(axes, [(result, part) for result, part, _ in group])
    several, shown = len(members) > 1, False
    for place, (member, (result, part, title)) in enumerate(product(members, group)):
        values, status = shown_values(member.output, result), member.output.values("status")
        values = values if part is None else values[:, part]
        shown = shown or bool(np.isfinite(values[lacks_period(status)]).any())
        member_title = member.title if (result, part, title) == group[0] else None
        draw_branch(
            axes,
            member.output,
            name,
            values,
            colour_of(place // len(group) if several else place),
            member_title if several else title if len(group) > 1 else None,
            result=result,
            **line_style(members, len(group), result, part, place),
        )
    set_axis(axes, output, name, MARGIN)
    axes.margins(y=0.08)
    if first in ("x_min", "x_max") and have_same_stops(members):
        draw_stops_along(axes, output, name)
    for member in members:
        name_statuses(axes, member.output, name, shown=shown)
    axes.set_ylabel(common_label(members, group))
    set_ordinate(axes, output, [result for result, _, _ in group])
    if output.follow == name and not several:
        rises = (output.values(name)[-1] > output.values(name)[0]) != output.goes_down
        axes.set_xlabel(f"{label(output, name)}, followed " + (r"$\rightarrow$" if rises else r"$\leftarrow$"))
    legend_above(axes, columns=3 if several or len(axes.get_legend_handles_labels()[0]) > 4 else 4)


def set_ordinate(axes, output, results):
    """Ticks and limits for counts, shares, and what is so or not."""
    first = results[0]
    if first == "period_ratio":
        axes.set_ylim(0.5, (axes.dataLim.y1 if np.isfinite(axes.dataLim.y1) else 1) + 0.5)  # none may have a period
    if first == "impacts_per_period" or all(is_integer(shown_values(output, result)) for result in results):
        axes.yaxis.set_major_locator(ticker.MaxNLocator(integer=True))
    if first in YES_OR_NO:
        axes.set_yticks([0, 1], labels=["no", "yes"])
        axes.set_ylim(-0.15, 1.15)
    if first in ("rest_fraction", "stick_fraction", "contact_fraction"):
        axes.set_ylim(-0.02, max(1.02 * axes.get_ylim()[1], 0.1))


def have_same_stops(members):
    stops = [np.stack(member.output.reach()) for member in members]
    return all(np.array_equal(other, stops[0]) for other in stops)


def line_style(members, parts, result, part, place):
    """Dots for periods, which jump; of two curves the first broad, since the second may cover it; dashes for the second
    of two components."""
    ratios = [member.output.values("period_ratio") for member in members if "period_ratio" in member.output]
    many_periods = any((ratio > 1).any() for ratio in ratios)
    is_cloud = any(member.output.is_cloud for member in members)
    if result == "period_ratio" or result == "period" and many_periods or is_cloud:
        return {"ls": "none", "marker": ".", "ms": 6.0 if len(members) == 2 and place < parts else 3.0}
    if len(members) == 2:
        return {"lw": 2.4 if place < parts else 1.0}
    return {"ls": (0, (4, 1.5)) if part is not None and place % 2 and len(members) == 1 else "-"}


def common_label(members, group):
    """The label of the results that share a panel; without a frame if they are given in both."""
    output, first = members[0].output, group[0][0]
    frames = {member.output[first].frame for member in members}
    words = label_of(output, group)
    return words if len(frames) == 1 else re.sub(rf"[,\n] ?{output[first].frame}", "", words)


def label_of(output, group):
    """The label of results of an output that share a panel."""
    names, first = list(dict.fromkeys(result for result, _, _ in group)), group[0][0]
    shared = next((words for words in SHARED if len(names) > 1 and set(names) <= words), None)
    if shared:
        words = SHARED[shared].replace("$x$", "$z$") if first == "v_before" and output.is_of_walls else SHARED[shared]
        words = words.replace(IN_TIME, PER_PERIOD) if PER_PERIOD in output[first].long_name else words
        words = with_unit(output, words, *names)
        return in_frame(output, first, words) if first[:2] in ("x_", "v_", "y_") and "impact" not in words else words
    title = group[0][2]
    is_part = len(group) == 1 and group[0][1] is not None
    words, frame = label(output, first), f", {output[first].frame}"
    part = title.removeprefix(symbol(output, first)).strip() if is_part else ""
    if frame == ", " or not words.endswith(frame) or not part and len(words) <= LONGEST_LABEL:
        return f"{words}\n{part}".strip()
    return f"{words.removesuffix(frame)}\n{frame[2:]}{', ' * is_part}{part}"  # no longer than the panel is high


def spectrum(output, name, axes):
    """Amplitudes or phases of the harmonics of a single point."""
    order, values = output.values("harmonic"), shown_values(output, name)
    axes.vlines(order, 0.0, values, color=BLUE, lw=1.2)
    axes.plot(order, values, ls="none", marker="o", ms=4, color=BLUE)
    axes.axhline(0.0, color=STOP, lw=0.7)
    axes.set_xlim(-0.5, order[-1] + 0.5)
    axes.xaxis.set_major_locator(ticker.MaxNLocator(integer=True))
    axes.set_xlabel(label(output, "harmonic"))
    axes.set_ylabel(label(output, name))


def scalars(rows, axes):
    """The results of a single point, as a table in words: (words, text) of each line."""
    axes.set_axis_off()
    axes.set_ylim(len(rows), 0)
    for line, (words, text) in enumerate(rows):
        axes.text(0.7, line + 0.5, words, va="baseline", ha="right", transform=axes.get_yaxis_transform())
        axes.text(0.72, line + 0.5, text, va="baseline", ha="left", transform=axes.get_yaxis_transform())


def scalar_parts(output, name):
    """(words, text) of each number or text of a result of a single point; none of what doesn't exist."""
    variable = output[name]
    if variable.values.ndim > 1 or variable.dims not in ((), ("stop",), ("multiplier",)):
        return []
    if variable.values.dtype.kind == "U":
        text = {"-": "none"}.get(str(variable.values), str(variable.values).replace("inf", "∞"))
        return (
            [(plain(variable.long_name), plain(text if len(text) <= LONGEST else f"{text[:LONGEST]}…"))] if text else []
        )
    values = zip(component_names(output, name), np.atleast_1d(shown_values(output, name)))
    return [
        (result_in_words(output, name) + part, amount(output, name, value))
        for part, value in values
        if part is not None and value == value
    ]


def component_names(output, result):
    """The name of each value of a result of a single point, None if it is of a stop that isn't there."""
    variable = output[result]
    if variable.dims == ("stop",):
        names = ((side, f", {output.stop_name(side, result)}") for side in output.values("stop"))
        return [words if output.has_stop(side, result) else None for side, words in names]
    if variable.dims == ("multiplier",):
        numbers = output.values("multiplier")
        return [f", {modulus_name(int(number), len(numbers))}" for number in numbers]
    return [""]


def modulus_name(number, count):
    """A multiplier by its place in the order of moduli, 1 for the largest."""
    if count == 2:
        return "larger modulus" if number == 1 else "smaller modulus"
    return ("largest", "second", "third", "smallest")[number - 1] + " modulus"
