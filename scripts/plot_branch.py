"""The picture of branches of periodic motion: stable and unstable, with their special points."""

import numpy as np

from plot_choice import ChoiceProblem
from plot_style import CYCLE, STOP, caption_below, label, legend_above, new_figure

PANELS = ("v_max", "impact_speed")  # unless --only names others
OFFERED = ("x", "v", "x_min", "x_max", "v_min", "v_max", "impact_speed", "impact_power")
MARKS = {  # special point: its symbol, and whether it is filled
    "fold": ("s", True),
    "flip": ("D", True),
    "symmetry breaking": ("^", True),
    "graze": ("o", False),
    "chatter limit": ("X", False),
    "maximum impact_speed": ("*", True),
    "maximum impact_power": ("P", True),
    "maximum harmonic": ("v", True),
}
BEHIND = "#b8b8b8"


def branch_figure(outputs, only):
    """One panel for each quantity, all over the parameter along which the branches were followed."""
    branches = [output for output in outputs if output.is_branch]
    parameters = {parameter_of(output) for output in branches}
    if len(parameters) > 1:
        raise ChoiceProblem(f"the branches run along {' and '.join(sorted(parameters))}; draw those along one of them")
    parameter = parameters.pop()
    names = chosen(only)
    figure = new_figure(1.2 + 2.6 * len(names))
    panels = figure.subplots(len(names), sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(panels, names):
        for output in outputs:
            if not output.is_branch:
                points_behind(axes, output, parameter, name)
        for output in branches:
            draw_branches(axes, output, parameter, name)
        for output in branches:
            draw_specials(axes, output, parameter, name)
        axes.set_ylabel(label(branches[0], name))
        low, high = (bound for bound in branches[0].config["branch"]["range"])
        axes.set_xlim(low, high)
    panels[-1].set_xlabel(label(branches[0], parameter))
    legend_above(panels[0], columns=3)
    caption_below(figure, ["solid: stable", "dashed: unstable"])
    return figure


def parameter_of(output):
    return output.config["branch"]["along"]


def chosen(only):
    if not only:
        return PANELS
    wrong = [name for name in only if name not in OFFERED]
    if wrong:
        raise ChoiceProblem(f"--only {wrong[0]}: a file of branches has {', '.join(OFFERED)}")
    return tuple(only)


def draw_branches(axes, output, parameter, name):
    """Each branch in its colour; solid where it is stable."""
    number, stable = output.values("branch"), output.values("stable") == 1
    x, y, words = output.values(parameter), output.values(name), output.values("word")
    for branch in np.unique(number):
        own = np.flatnonzero(number == branch)
        colour = CYCLE[branch % len(CYCLE)]
        title = f"{words[own[len(own) // 2]] or 'no impacts'}, branch {branch}"
        axes.plot([], [], color=colour, label=title)
        for begin, end in stretches(stable[own]):
            part = own[begin : min(end + 1, len(own))]
            style = "-" if stable[part[0]] else (0, (4, 2))
            axes.plot(x[part], y[part], ls=style, color=colour, zorder=2, gid=f"branch {branch}")


def stretches(flags):
    """(begin, end) of each run of equal flags."""
    changes = [0, *(np.flatnonzero(flags[1:] != flags[:-1]) + 1), len(flags)]
    return list(zip(changes[:-1], changes[1:]))


def draw_specials(axes, output, parameter, name):
    """Special points with a symbol for each kind."""
    kinds = output.values("special_kind")
    x, y = output.values(f"special_{parameter}"), output.values(f"special_{name}")
    for kind in dict.fromkeys(kinds):
        own = np.array([other == kind for other in kinds])
        marker, filled = MARKS.get(kind, (".", True))
        look = {"ms": 5.5, "color": STOP, "mfc": STOP if filled else "white", "zorder": 4}
        axes.plot(x[own], y[own], marker, label=kind.replace("_", " "), **look)


def points_behind(axes, output, parameter, name):
    """The results of a sweep over the parameter, if it has the quantity."""
    if output.axes != (parameter,):
        raise ChoiceProblem(
            f"a sweep behind branches runs over {parameter} alone; '{output.title}' runs over {', '.join(output.axes)}"
        )
    if name == "impact_speed" and "v_before" in output:
        values = np.nanmax(np.abs(output.values("v_before")).reshape(len(output.values(parameter)), -1), axis=1)
    elif name in output:
        values = output.values(name)
    else:
        return
    axes.plot(output.values(parameter), values, ".", ms=6, mew=0, color=BEHIND, label="sweep", zorder=1)
