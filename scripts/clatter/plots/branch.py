"""Pictures of branches of periodic motion, stable and unstable, with their special points, and of curves of these
points in the plane of two parameters."""

from pathlib import Path

import numpy as np
from matplotlib import colors
from matplotlib.patheffects import withStroke

from .attractors import ZONES, has_shares, runs
from .branch_names import REST, colours_and_names, prefixed
from .choice import ChoiceProblem, differences
from .maps import Grid, edges_between, kind_map, regime_map
from .names import label, plain
from .shown import note_results
from .style import STOP, caption_below, colour_of, legend_above, new_figure

PANELS = ("v_max", "impact_speed")  # unless --only names others
OFFERED = ("x", "v", "x_min", "x_max", "v_min", "v_max", "impact_speed", "impact_power")
MARKS = {  # special point: its symbol, and whether it is filled
    "fold": ("s", True),
    "flip": ("D", True),
    "symmetry breaking": ("^", True),
    "graze": ("o", False),
    "chatter limit": ("X", False),
    "release tangency": ("d", False),
    "maximum impact_speed": ("*", True),
    "maximum impact_power": ("P", True),
    "maximum harmonic": ("v", True),
    "resonant graze": ("h", False),
    "cusp": ("p", True),
    "crossing-sliding": ("<", False),
    "grazing-sliding": (">", False),
    "switching-sliding": ("s", False),
    "Neimark-Sacker": ("8", True),
    "motion ceases": ("H", True),
    "simultaneous events": ("+", True),
    "rebound threshold": ("1", True),
    "strong resonance": ("x", True),
}
CURVES = {  # special point: name and dashes of its curve in the plane of two parameters
    "fold": ("folds", "-"),
    "flip": ("flips", (0, (5, 1.5))),
    "symmetry breaking": ("losses of symmetry", (0, (5, 1.5, 1, 1.5))),
    "graze": ("grazes", (0, (1.2, 1.2))),
    "Neimark-Sacker": ("Neimark–Sacker points", (0, (6, 2, 1, 2, 1, 2))),
}
BEHIND = "#b8b8b8"
BACKBONE = (("xs", None), ("R", 1.0), ("load", 0.0), ("stiffness", 1.0))  # keys of the scene, with their defaults


def branch_figure(outputs, options):
    """One panel for each quantity, all over the parameter along which the branches were followed."""
    branches = [output for output in outputs if output.is_branch]
    parameters = {parameter_of(output) for output in branches}
    if len(parameters) > 1:
        raise ChoiceProblem(f"the branches run along {' and '.join(sorted(parameters))}; draw those along one of them")
    parameter = parameters.pop()
    names = chosen(options.only)
    notes = ["solid: stable", "dashed: unstable"]
    own = dict(zip(map(id, outputs), differences(outputs)))
    colours, legend = colours_and_names(branches, parameter, names, [own[id(output)] for output in branches])
    figure = new_figure(1.2 + 2.6 * len(names))
    panels = figure.subplots(len(names), sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(panels, names):
        for output in outputs:
            if not output.is_branch:
                notes += sweep_behind(axes, output, parameter, branches[0][name], own[id(output)])
        if options.backbone and name == "impact_speed":
            notes += draw_backbones(axes, branches, parameter)
        for colour, title in legend:
            axes.plot([], [], color=colour, label=title)
        for place, output in enumerate(branches):
            draw_branches(axes, output, parameter, name, colours, place)
        for output in branches:
            draw_specials(axes, output, parameter, name)
        note_results(axes, [(name, None)])
        axes.set_ylabel(label(branches[0], name))
        ranges = [output.config["branch"]["range"] for output in branches]
        axes.set_xlim(min(low for low, _ in ranges), max(high for _, high in ranges))
    panels[-1].set_xlabel(label(branches[0], parameter))
    legend_above(panels[0], columns=3)
    caption_below(figure, notes)
    return figure


def curve_figure(outputs, options):
    """Curves of special points in the plane of two parameters, over the map of a sweep over the same two, if given."""
    curves = [output for output in outputs if output.is_branch]
    planes = {plane_of(output) for output in curves}
    if len(planes) > 1 or None in planes:
        raise ChoiceProblem(
            "branches and curves, or curves over different parameters; draw each in a picture of its own"
        )
    for option in ("only", "along", "over", "at", "backbone"):
        if getattr(options, option):
            raise ChoiceProblem(f"--{option}: curves in the plane of two parameters have one picture")
    plane = planes.pop()
    figure = new_figure(4.6, 6.4)
    axes = figure.subplots()
    notes = []
    own = differences(outputs)
    looks = {difference: colour_of(place) for place, difference in enumerate(dict.fromkeys(own))}
    looks = looks if len({own[outputs.index(output)] for output in curves}) > 1 else dict.fromkeys(own, STOP)
    for output, difference in zip(outputs, own):
        if output.is_branch:
            draw_curves(axes, output, plane, difference, looks[difference])
        else:
            notes += map_behind(figure, axes, output, plane, options) + [f"map: {difference}"] * bool(difference)
    for output in curves:
        draw_specials(axes, output, *plane, skip=output.config["branch"]["curve"])
    if len(curves) == len(outputs):
        axes.set_xlabel(label(curves[0], plane[0]))
        axes.set_ylabel(label(curves[0], plane[1]))
        axes.set_xlim(*curves[0].config["branch"]["range"])
        if "across_range" in curves[0].config["branch"]:
            axes.set_ylim(*curves[0].config["branch"]["across_range"])
    legend_above(axes, columns=3)
    caption_below(figure, notes)
    return figure


def plane_of(output):
    """The two parameters of a file of curves; None of branches."""
    branch = output.config["branch"]
    return (branch["along"], branch["across"]) if "across" in branch else None


def map_behind(figure, axes, output, plane, options):
    """The regimes, or kinds of motion, of a sweep over the plane of the curves."""
    if output.axes not in (plane, plane[::-1]):
        raise ChoiceProblem(
            f"a map behind curves runs over {' and '.join(plane)}; '{output.title}' runs over {', '.join(output.axes)}"
        )
    output = output.in_order(plane)
    grid = Grid(output, plane, (options.xlim, options.ylim), options.log)
    status = output.values("status")
    if "regime" in output:
        notes = regime_map(figure, axes, grid, status, output.values("regime"))
    else:
        notes = kind_map(figure, axes, grid, status, output.values("period_ratio"))
    axes.set_title("")
    return notes or []


def draw_curves(axes, output, plane, difference, colour):
    """The curves of a file, named by their kind and how its scene differs."""
    number, (kind, dashes) = output.values("branch"), CURVES[output.config["branch"]["curve"]]
    title, look = prefixed(difference, kind), {"color": colour}
    if colour != STOP:  # one of several, over colours of a map
        look["path_effects"] = [withStroke(linewidth=2.6, foreground="white")]
    x, y = (output.values(name) for name in plane)
    for curve in np.unique(number):
        own = number == curve
        axes.plot(x[own], y[own], ls=dashes, lw=1.1, label=title, zorder=3, gid=f"{kind} {curve}", **look)


def parameter_of(output):
    return output.config["branch"]["along"]


def chosen(only):
    if not only:
        return PANELS
    wrong = [name for name in only if name not in OFFERED]
    if wrong:
        raise ChoiceProblem(f"--only {wrong[0]}: a file of branches has {', '.join(OFFERED)}")
    return tuple(only)


def draw_branches(axes, output, parameter, name, colours, place):
    """Each branch in its colour, those without one in grey behind the others; solid where it is stable."""
    number, stable = output.values("branch"), output.values("stable") == 1
    x, y = (output.values(key) for key in (parameter, name))
    for branch in np.unique(number):
        own, colour = np.flatnonzero(number == branch), colours.get((place, branch), REST)
        for begin, end in stretches(stable[own]):
            part = own[begin : min(end + 1, len(own))]
            style = "-" if stable[part[0]] else (0, (4, 2))
            axes.plot(
                x[part], y[part], ls=style, color=colour, zorder=1.9 if colour == REST else 2, gid=f"branch {branch}"
            )


def draw_backbones(axes, branches, parameter):
    """The speed of conservative motion between the stops that repeats after as many forcing periods as the branches:
    x_s cot(n pi / (2 nu)), eq. 21 with the frequency nu / n, as the mean of those before and after an impact. Returns
    the note that explains it."""
    low, high = branches[0].config["branch"]["range"]
    scenes = {tuple(output.scene.get(key, default) for key, default in BACKBONE) for output in branches}
    gap, R, load, stiffness = scenes.pop()
    if parameter != "nu" or gap is None or load != 0 or stiffness != 1 or scenes:
        raise ChoiceProblem(
            "--backbone is of branches along nu of one machine, between stops xs without a load, at stiffness 1"
        )
    for n in sorted({round(output.values("period_ratio")[0]) for output in branches}):
        if n >= high:
            continue
        nu = np.linspace(max(low, n), high, 600)
        axes.plot(
            nu,
            2 / (1 + R) * abs(gap) / np.tan(n * np.pi / (2 * nu)),
            ls=":",
            lw=1.2,
            color=STOP,
            zorder=1.5,
            gid=f"backbone {n}",
        )
    return ["dotted: conservative motion of the mean speed before and after impact"]


def stretches(flags):
    """(begin, end) of each run of equal flags."""
    changes = [0, *(np.flatnonzero(flags[1:] != flags[:-1]) + 1), len(flags)]
    return list(zip(changes[:-1], changes[1:]))


def draw_specials(axes, output, parameter, name, skip=""):
    """Special points with a symbol for each kind but one."""
    kinds = output.values("special_kind")
    x, y = output.values(f"special_{parameter}"), output.values(f"special_{name}")
    for kind in dict.fromkeys(kind for kind in kinds if kind != skip):
        own = np.array([other == kind for other in kinds])
        marker, filled = MARKS.get(kind, (".", True))
        look = {"ms": 5.5, "color": STOP, "mfc": STOP if filled else "white", "zorder": 4}
        axes.plot(x[own], y[own], marker, label=plain(kind).replace("_", " "), **look)


def sweep_behind(axes, output, parameter, quantity, difference):
    """Behind branches, the zones of a sweep with shares of its motions, or else its results of that quantity, named by
    how its scene differs."""
    if has_shares(output) and output["motion_share"].dims[0] == parameter:
        return zones_behind(axes, output, parameter, difference)
    return points_behind(axes, output, parameter, quantity, prefixed(difference, "sweep"))


def zones_behind(axes, output, parameter, difference):
    """Where all starts end in one motion, and where in several, as the colour of the ground."""
    places = output.values(parameter).astype(float)
    order = np.argsort(places, kind="stable")
    edges, several = edges_between(places[order]), (output.values("motion_share")[order] > 0).sum(axis=1) > 1
    for name, cells in (("soft", ~several), ("hard", several)):
        colour = colors.to_rgba(dict(ZONES)[name], 0.13)
        for part, (begin, end) in enumerate(runs(cells)):
            title = prefixed(difference, f"{name} zone") if part == 0 else None
            axes.axvspan(edges[begin], edges[end], color=colour, lw=0, zorder=0, label=title, gid=f"{name} zone")
    return []


def points_behind(axes, output, parameter, quantity, title):
    """The results of a sweep over the parameter, of two stops the larger; returns the note that it has none."""
    if output.axes != (parameter,):
        raise ChoiceProblem(
            f"a sweep behind branches runs over {parameter} alone; '{output.title}' runs over {', '.join(output.axes)}"
        )
    name = quantity.name
    if name not in output:
        key = quantity.observable
        way = f", which a run with observe.{key} = true writes" if key else ""
        return [f"no points of the sweep: {plain(Path(output.path).name)} has no {name}{way}"]
    values = output.values(name)
    if values.ndim > 1:  # of each stop
        values = np.fmax.reduce(values, axis=-1)
    axes.plot(output.values(parameter), values, ".", ms=6, mew=0, color=BEHIND, label=title, zorder=1, gid="sweep")
    return []
