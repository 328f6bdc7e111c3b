"""The paper's figures (doi:10.5755/j02.mech.32277), each drawn with the care that it needs."""

import numpy as np
from matplotlib import ticker

from .curves import draw_branch, draw_stops_along, label_of, name_statuses
from .motion import draw_common_walls, impact_log, motion, phase_plane, time_history
from .names import label
from .style import BLUE, CYCLE, GRID, ORANGE, STOP, VERMILION, legend_above, new_figure, set_axis

SHOWN_TIME = 20.0  # tau to which the paper shows free vibration
ONE = [((), "")]  # the only point of a sweep without axes, untitled


def velocity_ratio(output):
    """Figs. 2, 3: speed at contact over the gap, against the period and against the eigenfrequency."""
    figure = new_figure(3.0)
    panels = figure.subplots(1, 2, sharey=True)
    for axes, name in zip(panels, ("period", "eigenfrequency")):
        axes.plot(output.values(name), output.values("velocity_ratio"), color=BLUE)
        axes.set_xlim(0.0 if name == "period" else 1.0, output.values(name).max())
        axes.set_xlabel(label(output, name))
    panels[0].set_ylim(0.0, None)
    panels[0].set_ylabel(label(output, "velocity_ratio"))
    return figure


def free_vibration(output):
    """Figs. 4-6: x and x' in time, phase plane, and the first harmonics with their sum."""
    figure = new_figure(7.2)
    grid = figure.add_gridspec(4, 3, height_ratios=(1, 1, 0.1, 1.25))
    for row, quantity in enumerate("xv"):
        axes = figure.add_subplot(grid[row, :])
        time_history(output, quantity, ONE, axes, end=SHOWN_TIME)
        axes.xaxis.set_major_locator(ticker.MultipleLocator(2))
    phase_plane(output, ONE, figure.add_subplot(grid[2:, 0]))
    for column, quantity in enumerate("xv", start=1):
        axes = figure.add_subplot(grid[3, column])
        harmonic_sum(output, quantity, axes)
    names = figure.add_subplot(grid[2, 1:])
    names.set_axis_off()
    legend = names.legend(
        *axes.get_legend_handles_labels(), loc="center", ncol=5, columnspacing=1.0, handlelength=1.5, borderaxespad=0.0
    )
    legend.set_in_layout(False)  # its own row has the room
    return figure


def harmonic_sum(output, quantity, axes):
    """The harmonics of one period of the motion, their sum, and the motion itself."""
    tau, x, v = motion(output, ())
    base = float(output.values("base_frequency"))
    amplitude, phase = output.values(f"{quantity}_amplitude"), output.values(f"{quantity}_phase")
    axes.plot(tau, x if quantity == "x" else v, color="#b0b0b0", lw=2.4, label="motion")
    total = np.full_like(tau, amplitude[0])
    for k in range(1, len(amplitude)):
        wave = amplitude[k] * np.cos(k * base * tau + phase[k])
        total += wave
        axes.plot(
            tau,
            wave,
            color=CYCLE[k % len(CYCLE)],
            lw=1.0,
            ls=("-", (0, (5, 1.5)), (0, (2, 1.2)))[k % 3],
            label=f"$k = {k}$",
        )
    axes.plot(tau, total, color=BLUE, lw=1.4, label="sum")
    axes.margins(y=0.08)
    if quantity == "x":
        draw_common_walls(axes, output)
    axes.set_xlabel(label(output, "tau"))
    axes.set_ylabel(label(output, quantity))


def period_curve(output):
    """Fig. 7: the period falls below 2 pi once the stops are reached."""
    figure = new_figure(3.0, 4.6)
    axes = figure.subplots()
    axes.plot(output.values("v0"), output.values("period"), color=BLUE)
    axes.axhline(2 * np.pi, color=GRID, lw=0.8, zorder=0)
    axes.text(0.02, 2 * np.pi, r"$2\pi$", transform=axes.get_yaxis_transform(), va="bottom", color=STOP)
    _, gap = output.stops()
    axes.axvline(-gap.flat[0], color=STOP, lw=0.8, ls=(0, (4, 2)), zorder=0)
    axes.text(
        -gap.flat[0], 0.06, "$x$\N{PRIME}$(0) = -|x_s|$  ", transform=axes.get_xaxis_transform(), ha="right", color=STOP
    )
    axes.set_ylim(0.0, 7.0)
    set_axis(axes, output, "v0")
    axes.set_ylabel(label(output, "period"))
    return figure


def impact_velocity(output):
    """Figs. 8-11: velocity before and after impact at the first and at the second surface."""
    result, place = {8: ("v_before", 0), 9: ("v_after", 0), 10: ("v_before", 1), 11: ("v_after", 1)}[output.figure]
    figure = new_figure(3.0, 4.6)
    axes = figure.subplots()
    values = output.values(result)[:, place]
    axes.plot(output.values("xs"), values, color=BLUE)
    axes.axhline(0.0, color=GRID, lw=0.7, zorder=0)
    axes.set_xlim(output.values("xs").min(), 0.0)
    low, high = min(0.0, np.nanmin(values)), max(0.0, np.nanmax(values))
    axes.set_ylim(low - 0.06 * (high - low), high + 0.06 * (high - low))
    axes.set_xlabel(label(output, "xs"))
    axes.set_ylabel(label(output, result))
    return figure


def harmonics(output):
    """Figs. 12, 13: amplitudes of the harmonics 0-3 of x and of x'."""
    name = "x_amplitude" if output.figure == 12 else "v_amplitude"
    figure = new_figure(3.2, 4.6)
    axes = figure.subplots()
    values = output.values(name)
    for k, dashes in enumerate(((0, (6, 2)), "-", (0, (2, 2)), "-")[: values.shape[1]]):
        axes.plot(
            output.values("v0"),
            values[:, k],
            color=(STOP, BLUE, VERMILION, "#009E73")[k],
            ls=dashes,
            lw=1.6 if k == 0 else 1.3,
            label=f"$k = {k}$",
        )
    _, gap = output.stops()
    axes.axvline(-gap.flat[0], color=STOP, lw=0.8, ls=(0, (4, 2)), zorder=0)
    set_axis(axes, output, "v0")
    axes.margins(y=0.06)
    axes.set_ylabel(label(output, name))
    legend_above(axes)
    return figure


def forced_motion(output):
    """Figs. 14-19: two periods of the steady motion in time, its phase plane, and its impacts."""
    figure = new_figure(5.0)
    (top, plane), (middle, log) = figure.subplots(2, 2)
    period = float(output.values("period"))
    period = period if np.isfinite(period) else None
    end = 2 * period if period else None
    time_history(output, "x", ONE, top, end)
    time_history(output, "v", ONE, middle, end)
    phase_plane(output, ONE, plane)
    impact_log(output, (), log, period)
    if period:
        for axes in (top, middle, log):
            axes.xaxis.set_major_locator(ticker.MultipleLocator(2 if period < 7 else max(2, period // 3)))
    return figure


def extrema(output):
    """Figs. 20-23: smallest and largest displacement against the excitation frequency, between the stops."""
    figure = new_figure(3.9, 5.6)
    axes = figure.subplots()
    draw_branch(axes, output, "nu", output.values("x_max"), VERMILION, r"$x_{\max}$", ORANGE)
    draw_branch(axes, output, "nu", output.values("x_min"), BLUE, r"$x_{\min}$", ORANGE)
    set_axis(axes, output, "nu")
    draw_stops_along(axes, output, "nu")
    name_statuses(axes, output, "nu", ORANGE)
    axes.xaxis.set_major_locator(ticker.MultipleLocator(0.1))
    axes.set_ylabel(label_of(output, [("x_min", None, ""), ("x_max", None, "")]))
    legend_above(axes)
    return figure


PAPER_FIGURES = {
    **dict.fromkeys((2, 3), (velocity_ratio, ("velocity_ratio", "period", "eigenfrequency"), ("start_period",))),
    **dict.fromkeys((4, 5, 6), (free_vibration, ("tau", "x", "v", "x_amplitude", "v_amplitude", "x_phase"), ())),
    7: (period_curve, ("period",), ("v0",)),
    **dict.fromkeys((8, 9, 10, 11), (impact_velocity, ("v_before", "v_after"), ("xs",))),
    12: (harmonics, ("x_amplitude",), ("v0",)),
    13: (harmonics, ("v_amplitude",), ("v0",)),
    **dict.fromkeys(range(14, 20), (forced_motion, ("tau", "x", "v", "impact_count", "period"), ())),
    **dict.fromkeys(range(20, 24), (extrema, ("x_min", "x_max"), ("nu",))),
}


def paper_figure(output):
    """The function that draws this output as the paper does, or None if the file has other contents."""
    draw, needed, axes = PAPER_FIGURES.get(output.figure, (None, (), ()))
    if not draw or output.axes != axes or any(name not in output for name in needed):
        return None
    return lambda output: draw(output.in_increasing_order())
