"""Any other output: one panel for each thing that the file contains."""

from dataclasses import replace
from math import ceil

import numpy as np

from .attractors import (
    attractor_map,
    basin_points,
    has_linked_starts,
    has_shares,
    is_start,
    share_panel,
    start_plane,
    value_points,
)
from .bifurcation import impact_diagram, poincare, section_diagram
from .curves import curves, modulus_name, scalar_parts, scalars, spectrum
from .data import FIRST_FAILURE, PHASE
from .empty import empty_panel, empty_results, why_empty
from .housing import both_masses, housing_plane
from .impact_phases import phases_panel
from .maps import Grid, kind_map, quantity, regime_map, value_map
from .motion import chosen_points, impact_log, phase_plane, time_history
from .scatter import word_scatter
from .scales import constant_value, is_constant, largest, shown_values
from .names import YES_OR_NO, amount, label, number, plain, result_in_words, symbol
from .panel_order import BOOKKEEPING, TOGETHER, in_order
from .style import caption_below, legend_above, new_figure, set_axis

RECORDS = ("tau", "x", "v")
TEXTS = ("impact_word", "regime")
NAMES = (*TEXTS, "attractor")  # results that no scale orders
LINE = 0.2  # inches, of a line in a table
MAP_LIMIT = 4  # components of one variable (harmonics, stops) that maps show


def generic_figure(members, only, options):
    """A figure with every panel that the outputs give something to, and a caption for what needs none. A map has one
    member, curves over one axis any number of them; `only` names the results that are drawn, or is empty."""
    output, caption, table = members[0].output, [], []

    def drawn(*names):
        return not only or any(name in only for name in names)

    panels = motion_panels(output, drawn) if len(members) == 1 else []
    panels += [phases_panel(members)] * (PHASE in only and all(PHASE in member.output for member in members))
    if len(output.axes) == 0:
        panels += point_panels(output, drawn)
        table = table_of(output, only, drawn, may_be_empty=bool(panels))
    elif len(output.axes) == 1:
        panels += curve_panels(members, drawn, caption) + empty_panel(output, only, set_axis)
        panels = panels or [lambda figure, axes: curves(members, [("impact_total", None, "")], axes)]
    else:
        grid = Grid(output, output.axes, (options.xlim, options.ylim), options.log)
        panels += map_panels(output, grid, drawn, caption)
        panels += empty_panel(output, only, lambda axes, *_: grid.set_axes(axes))
        simulated = quantity(output, "impact_total", None, "impacts simulated")
        panels = panels or [value_panel(grid, simulated, output.values("status"))]
    columns = max(1, min(len(panels), 2 + (len(panels) > 8) + (len(panels) > 16)))
    heights = [(3.2, 2.5, 2.5, 2.1)[columns - 1]] * ceil(len(panels) / columns) + [LINE * len(table)] * bool(table)
    width = 4.6 if columns == 1 and not table and not has_shares(output) else min(max(3.5 * columns, 7.0), 10.5)
    figure = new_figure(0.5 + sum(heights), width)
    grid_spec = figure.add_gridspec(len(heights), columns, height_ratios=heights)
    for place, draw in enumerate(panels):
        axes = figure.add_subplot(grid_spec[place // columns, place % columns])
        caption += draw(figure, axes) or []
        if len(output.axes) > 1:
            label_outside(axes, is_first=place % columns == 0, is_last=place + columns >= len(panels))
    if table:
        scalars(table, figure.add_subplot(grid_spec[-1, :]))
    caption_below(figure, caption)
    return figure


def label_outside(axes, is_first, is_last):
    """Leaves labels and numbers to the first panel of a row and the last of a column: all have the same axes."""
    if not is_first:
        axes.set_ylabel("")
        axes.tick_params(labelleft=False)
    if not is_last:
        axes.set_xlabel("")
        axes.tick_params(labelbottom=False)


def motion_panels(output, drawn):
    """Time histories, phase plane and impacts, as far as they were recorded."""
    if any(name not in output for name in RECORDS) or not drawn(*RECORDS):
        return []
    points = chosen_points(output)
    named = len(points) > 1

    def history(quantity):
        def draw(figure, axes):
            if output.has_loose_mass:
                both_masses(output, quantity, points, axes)
            else:
                time_history(output, quantity, points, axes)
            if named or output.has_loose_mass:
                legend_above(axes, columns=3)

        return draw

    plane = housing_plane if output.has_loose_mass else phase_plane
    panels = [history("x"), lambda figure, axes: plane(output, points, axes), history("v")]
    if "impact_count" in output and not named:
        panels.append(lambda figure, axes: impact_log(output, points[0][0], axes))
    return panels


def point_panels(output, drawn):
    """The panels of a sweep without axes, besides its motion: section, impacts, harmonics."""
    panels = []
    if "section_x" in output and drawn("section_x", "section_v"):
        panels.append(lambda figure, axes: poincare(output, axes))
    if "impact_count" in output and any(name not in output for name in RECORDS) and drawn("impact_count"):
        panels.append(lambda figure, axes: impact_log(output, (), axes))
    for name in in_order(filter(drawn, output.results())):
        if output[name].dims == ("harmonic",):
            panels.append(lambda figure, axes, name=name: spectrum(output, name, axes))
    return panels


def table_of(output, only, drawn, may_be_empty):
    """(words, number or text) of each result of a single point that is one, and why another has none if it is asked
    for; of its bookkeeping if there is none."""
    names = [name for name in in_order(filter(drawn, output.results())) if name not in BOOKKEEPING]
    rows = [row for name in names for row in scalar_parts(output, name)]
    rows += [(plain(output[name].long_name), why_empty(output, name)) for name in empty_results(output, only)]
    return rows or [row for name in BOOKKEEPING[:3] for row in scalar_parts(output, name) if not may_be_empty]


def start_panels(output, drawn, caption):
    """Each result at starts that fill a plane, though they run along one dimension."""
    panels = []
    if "attractor" in output and drawn("attractor"):
        panels.append(lambda figure, axes: basin_points(axes, output))
    for name, part, title in (part for group in result_groups(output, drawn) for part in components(output, group)):
        if part is None and is_constant(shown_values(output, name), scale_of(output, name)):
            caption.append(constant_note([output], name, part, title))
        elif part is None:
            panels.append(lambda figure, axes, name=name: value_points(figure, axes, output, name))
    return panels


def curve_panels(members, drawn, caption):
    """Each group of results over the only axis, and points instead of curves for sections and impacts."""
    output, panels = members[0].output, []
    if len(members) == 1 and start_plane(output) and (shown := start_panels(output, drawn, caption)):
        return shown
    members = [replace(member, output=member.output.in_increasing_order()) for member in members]
    output = members[0].output
    for name in ("section_x", "section_v"):
        if name in output and drawn(name):
            panels.append(lambda figure, axes, name=name: section_diagram(members, name, axes))
    for group in result_groups(output, drawn):
        parts = [part for part in components(output, group) if all(part[0] in member.output for member in members)]
        if all(is_one_value(members, part) for part in parts):
            caption += [constant_note([member.output for member in members], *part) for part in parts]
            continue
        draw = word_scatter if len(members) == 1 and output.is_cloud and "impact_word" in output else curves
        together = draw == curves and (len(members) == 1 or group in TOGETHER[:2])
        varying = [part for part in parts if not is_one_value(members, part)]
        alone = [[(name, part, component_name(output, name, part))] for name, part, _ in varying]
        for shown in [parts] if together else alone:
            panels.append(lambda figure, axes, shown=shown, draw=draw: draw(members, shown, axes))
    if "impact_count" in output and drawn("impact_count"):
        panels.append(lambda figure, axes: impact_diagram(members, axes))
    if "attractor" in output and drawn("attractor") and len(members) == 1 and has_shares(output):
        panels.insert(0, lambda figure, axes: share_panel(figure, axes, output))
    return panels


def is_one_value(members, part):
    """Whether a component of a result is constant, and the same for all members."""
    name, component, _ = part
    values = np.concatenate([component_values(member.output, name, component).ravel() for member in members])
    return is_constant(values, max(scale_of(member.output, name) for member in members))


def result_groups(output, drawn):
    """The results to be drawn, those that belong together as one group."""
    names = [name for name in output.results() if name not in BOOKKEEPING + RECORDS + NAMES and drawn(name)]
    names = [name for name in names if np.isfinite(shown_values(output, name)).any()]
    groups = []
    for name in in_order(names):
        group = next((group for group in TOGETHER if name in group), (name,))
        present = tuple(member for member in group if member in names)
        if present not in groups:
            groups.append(present)
    return groups


def components(output, group):
    """(variable, component, legend entry) of each curve in a panel."""
    parts = []
    for name in group:
        dims = output[name].dims[len(output.axes) :]
        if not dims:
            parts.append((name, None, symbol(output, name)))
        elif len(dims) == 1 and dims[0] in output:
            known = np.isfinite(shown_values(output, name)).reshape(-1, len(output.values(dims[0]))).any(axis=0)
            if dims[0] == "stop":
                known &= [output.has_stop(side, name) for side in output.values("stop")]
            prefix = f"{symbol(output, name)} " if len(group) > 1 else ""
            parts += [(name, part, prefix + component_name(output, name, part)) for part in np.flatnonzero(known)]
    return parts


def component_name(output, name, part):
    """The name of a component of a result, e.g. 'lower stop'."""
    if part is None:
        return symbol(output, name)
    dimension = output[name].dims[-1]
    value = output.values(dimension)[part]
    if dimension == "stop":
        return output.stop_name(value, name)
    if dimension == "multiplier":
        return modulus_name(int(value), len(output.values(dimension)))
    return f"${'k' if dimension == 'harmonic' else dimension} = {number(float(value))}$"


def map_panels(output, grid, drawn, caption):
    """Each result over two axes."""
    status = output.values("status")
    panels = attractor_panels(output, grid, drawn)
    if panels and has_linked_starts(output):
        return panels  # no map can show what depends on both
    if "regime" in output and drawn(*TEXTS):
        panels.append(lambda figure, axes: regime_map(figure, axes, grid, status, output.values("regime")))
    if "period_ratio" in output and drawn("period_ratio"):
        ratio = output.values("period_ratio")
        panels.append(lambda figure, axes: kind_map(figure, axes, grid, status, ratio))
    results = [name for group in result_groups(output, drawn) for name in group]
    for name, part, title in [part for name in results for part in components(output, (name,))]:
        values = component_values(output, name, part)
        if name in ("period_ratio", "period") and "period_ratio" in output or part is not None and part >= MAP_LIMIT:
            continue
        if is_constant(values[status < FIRST_FAILURE], scale_of(output, name)):
            caption.append(constant_note([output], name, part, title))
        elif np.isfinite(values[status < FIRST_FAILURE]).any():
            panels.append(value_panel(grid, quantity(output, name, part, map_title(output, name, part, title)), status))
    return panels


def attractor_panels(output, grid, drawn):
    """Shares of the starts over a parameter, else the motions over the two axes."""
    if "attractor" not in output or not drawn("attractor"):
        return []
    if any(map(is_start, output.axes)) and not all(map(is_start, output.axes)):
        return [lambda figure, axes: share_panel(figure, axes, output)] * has_shares(output)
    return [lambda figure, axes: attractor_map(figure, axes, grid, output)]


def value_panel(grid, shown, status):
    return lambda figure, axes: value_map(figure, axes, grid, shown, status)


def component_values(output, name, part):
    values = shown_values(output, name)
    return values if part is None else values[..., part]


def scale_of(output, name):
    """The scale of a result: of minimum and maximum together, and of all its components."""
    group = next((group for group in TOGETHER if name in group), (name,))
    return max(largest(shown_values(output, member)) for member in group if member in output)


def constant_note(outputs, name, part, title):
    """A result that is the same wherever it has a value, and at how many points it has one if not at all."""
    output, values = outputs[0], np.concatenate([component_values(other, name, part).ravel() for other in outputs])
    value, known = constant_value(values, scale_of(output, name)), np.isfinite(values).sum()
    words = plain_title(output, name, part, title)
    where = f" at {known} of {values.size} points" if known < values.size else ""
    sign = ":" if "=" in words or name in YES_OR_NO else " ="
    return f"{words}{sign} {amount(output, name, value)}{where}"


def plain_title(output, name, part, title):
    """A result in words, and which component of it."""
    words = result_in_words(output, name)
    return words if part is None else f"{words}, {title.removeprefix(symbol(output, name)).strip()}"


def map_title(output, name, part, title):
    """Title of a map: the result, and which component of it."""
    return (
        label(output, name)
        if part is None
        else f"{label(output, name)}, {title.removeprefix(symbol(output, name)).strip()}"
    )
