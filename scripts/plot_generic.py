"""Any other output: one panel for each thing that the file contains."""

from math import ceil

import numpy as np

from plot_curves import curves, scalars, spectrum
from plot_data import APERIODIC, FIRST_FAILURE
from plot_maps import kind_map, value_map
from plot_motion import chosen_points, impact_cloud, impact_log, phase_plane, time_history
from plot_style import label, legend_above, new_figure, number, symbol

BOOKKEEPING = (
    "status",
    "impact_total",
    "simulated_periods",
    "settling_estimate",
    "impact_count",
    "base_frequency",
    "energy_residual",
)
TOGETHER = (
    ("x_min", "x_max"),
    ("v_min", "v_max"),
    ("v_before", "v_after"),
    ("work_in", "loss_damping"),
)  # results that share a panel
RECORDS = ("tau", "x", "v")
MAP_LIMIT = 4  # components of one variable (harmonics, stops) that maps show
ORDER = (
    "x_min",
    "x_max",
    "v_min",
    "v_max",
    "period_ratio",
    "period",
    "eigenfrequency",
    "velocity_ratio",
    "impacts_per_period",
    "v_before",
    "v_after",
    "rest_fraction",
    "x_amplitude",
    "x_phase",
    "v_amplitude",
    "v_phase",
    "multiplier_re",
    "multiplier_im",
    "lyapunov",
    "work_in",
    "loss_damping",
    "loss_impact",
    "impulse",
    "impact_power",
)


def generic_figure(output):
    """A figure with every panel that the output gives something to."""
    panels = motion_panels(output) + {0: point_panels, 1: curve_panels}.get(len(output.axes), map_panels)(output)
    columns = min(len(panels), 3 if len(panels) > 8 else 2)
    rows = ceil(len(panels) / columns)
    width = 4.6 if columns == 1 else 3.5 * columns
    figure = new_figure(0.5 + (2.5 if columns > 1 else 3.2) * rows, width)
    for place, draw in enumerate(panels):
        draw(figure, figure.add_subplot(rows, columns, place + 1))
    if len(output.axes) > 1:
        figure.supxlabel(map_note(output), fontsize=10)
    return figure


def motion_panels(output):
    """Time histories, phase plane and impacts, as far as they were recorded."""
    if any(name not in output for name in RECORDS):
        return []
    points = chosen_points(output)
    named = len(points) > 1

    def history(quantity):
        def draw(figure, axes):
            time_history(output, quantity, points, axes)
            if named:
                legend_above(axes, columns=3)

        return draw

    panels = [history("x"), lambda figure, axes: phase_plane(output, points, axes), history("v")]
    if "impact_count" in output and not named:
        panels.append(lambda figure, axes: impact_log(output, points[0][0], axes))
    return panels


def point_panels(output):
    """The panels of a sweep without axes, besides its motion: its harmonics, and its numbers."""
    panels = []
    if "impact_count" in output and any(name not in output for name in RECORDS):
        panels.append(lambda figure, axes: impact_log(output, (), axes))
    for name in in_order(output.results()):
        if output[name].dims == ("harmonic",):
            panels.append(lambda figure, axes, name=name: spectrum(output, name, axes))
    names = [
        name
        for name in in_order(output.results())
        if output[name].dims in ((), ("stop",), ("multiplier",)) and name not in BOOKKEEPING
    ]
    if names or not panels and any(name not in output for name in RECORDS):
        panels.append(lambda figure, axes: scalars(output, names or BOOKKEEPING[:3], axes))
    return panels


def curve_panels(output):
    """Each group of results over the only axis."""
    name = output.axes[0]
    groups = [parts for group in result_groups(output) if (parts := components(output, group))]
    panels = [lambda figure, axes, parts=parts: curves(output, name, parts, axes) for parts in groups]
    if "impact_count" in output:
        panels.append(lambda figure, axes: impact_cloud(output, name, axes))
    return panels or [lambda figure, axes: curves(output, name, [("impact_total", None, "")], axes)]


def result_groups(output):
    """The results to be drawn, those that belong together as one group."""
    names = [name for name in output.results() if name not in BOOKKEEPING + RECORDS]
    names = [name for name in names if np.isfinite(output.values(name).astype(float)).any()]
    groups = []
    for name in in_order(names):
        group = next((group for group in TOGETHER if name in group), (name,))
        present = tuple(member for member in group if member in names)
        if present not in groups:
            groups.append(present)
    return groups


def in_order(names):
    """Names in the order of the panels; unknown ones come last."""
    return sorted(names, key=lambda name: ORDER.index(name) if name in ORDER else len(ORDER))


def components(output, group):
    """(variable, component, legend entry) of each curve in a panel."""
    parts = []
    for name in group:
        extra = output[name].dims[len(output.axes) :]
        if not extra:
            parts.append((name, None, symbol(name)))
        elif len(extra) == 1 and extra[0] in output:
            for place, value in enumerate(output.values(extra[0])):
                if np.isfinite(output.values(name)[..., place].astype(float)).any():
                    parts.append((name, place, component_title(name, extra[0], value, len(group) > 1)))
    return parts


def component_title(name, dimension, value, several):
    if dimension == "stop":
        side = "lower" if value < 0 else "upper"
        return f"{symbol(name)} {side}" if several else f"{side} stop"
    if dimension == "multiplier":
        return f"{'larger' if value == 1 else 'smaller'} modulus"
    return f"${'k' if dimension == 'harmonic' else dimension} = {number(float(value))}$"


def map_panels(output):
    """Each result over the first two axes; further axes stand at their first value."""
    names, rest = output.axes[:2], (0,) * (len(output.axes) - 2)
    cut = (slice(None), slice(None)) + rest
    status = output.values("status")[cut]
    panels, drawn = [], ()
    if "period_ratio" in output:
        drawn = ("period_ratio", "period")
        ratio = output.values("period_ratio")[cut]
        panels.append(lambda figure, axes: kind_map(output, figure, axes, names, status, ratio))
    for group in result_groups(output):
        for name, part, title in components(output, group):
            values = output.values(name)[cut] if part is None else output.values(name)[cut + (part,)]
            if name in drawn or part is not None and part >= MAP_LIMIT:
                continue
            if np.isfinite(values[status < FIRST_FAILURE].astype(float)).any():
                shown = map_title(output, name, part, title)
                panels.append(
                    lambda figure, axes, values=values, shown=shown: value_map(
                        output, figure, axes, names, shown, values, status
                    )
                )
    return panels or [
        lambda figure, axes: value_map(
            output, figure, axes, names, "impacts simulated", output.values("impact_total")[cut], status
        )
    ]


def map_title(output, name, part, title):
    """Label of a map's colour bar: the result, and which component of it."""
    return label(output, name) if part is None else f"{label(output, name)}, {title.removeprefix(symbol(name)).strip()}"


def map_note(output):
    """The meaning of the marks in maps, and the values at which further axes are held."""
    status = output.values("status")
    notes = ["hatched: no period"] * bool((status == APERIODIC).any())
    notes += ["black: failed"] * bool((status >= FIRST_FAILURE).any())
    notes += [f"{symbol(axis)} = {number(output.values(axis)[0])}" for axis in output.axes[2:]]
    return ";  ".join(notes)
