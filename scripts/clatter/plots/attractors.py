"""Which motions the starts end in: basins over two starts, shares and zones over a parameter."""

import numpy as np
from matplotlib import colors

from .data import CREEPING, ESCAPED, FIRST_FAILURE, STARTS, has_failed
from .maps import OLIVE, bar_style, class_map, edges_between, level_colours, name_colours, name_levels, name_panel
from .scales import integer_levels, shown_values, tidy_ticks
from .names import NO_CONTACT, STUCK, has_impacts, label, number, plain, short_word, symbol
from .shown import note_plane
from .style import COLOURS, GREEN, SKY, colour_of, legend_above

OTHERS = "#bfbfbf"
MOST = 16  # motions with an entry of their own in a legend
LEAST = 0.005  # share of the starts at its largest below which a motion is one of the others
ZONES = (("soft", GREEN), ("hard", "#b2182b"), ("quiet", SKY))  # strips above shares
STRIP, GAP = 0.075, 0.02  # of the height of a panel


def is_start(axis):
    return axis in STARTS or axis == "direction"


def name_of(output, motion):
    """A motion in words, e.g. "1/1 symmetric, LU"; of two mirror images that these don't tell apart the second says
    so."""
    name, twin = words_of(output, motion), int(output.values("motion_mirror")[motion])
    return f"{name}, mirrored" if 0 <= twin < motion and words_of(output, twin) == name else name


def words_of(output, motion):
    """The regime, symmetry and word of a motion."""
    word, regime = output.values("motion_word")[motion], output.values("motion_regime")[motion]
    if output.values("motion_period_ratio")[motion] == 0:
        return "no period" + ", symmetric" * bool(output.values("motion_symmetric")[motion] == 1)
    if word in (*NO_CONTACT, STUCK):
        if word != STUCK:
            return "no impacts"
        creeps = (output.values("status")[output.values("attractor") == motion] == CREEPING).any()
        return "creeps to where friction holds it" if creeps else "held by friction"
    symmetry = " symmetric" if output.values("motion_symmetric")[motion] == 1 else ""
    return f"{plain(regime)}{symmetry}, {short_word(word)}".replace("inf", "∞").replace("*", "∗")


def frequent(shares, most=MOST):
    """The motions with entries of their own, by number, and whether there are others."""
    there = np.flatnonzero(shares > 0)
    chosen = sorted(there[np.argsort(-shares[there], kind="stable")][:most])
    chosen = [motion for motion in chosen if shares[motion] >= LEAST] or chosen
    return chosen, len(chosen) < len(there)


def percent(share):
    return "< 1 %" if 0 < share < 0.005 else f"{100 * share:.0f} %"


def distinct_colours(motions):
    """The colour of each of a few motions: its own, or a free one if that is taken by another of them."""
    colours = {}
    for motion in motions:
        taken = colours.values()
        own = colour_of(motion)
        colours[motion] = own if own not in taken else next(colour for colour in COLOURS if colour not in taken)
    return colours


def shares_of(output):
    """The share of the points of an output that end in each motion."""
    numbers = output.values("attractor")
    counts = np.bincount(numbers[numbers >= 0], minlength=len(output.values("motion")))
    return counts / max(1, numbers.size)


def basin_kinds(output):
    """(name, colour, points) of each motion that points of an output end in."""
    numbers, status, shares = output.values("attractor"), output.values("status"), shares_of(output)
    chosen, more = frequent(shares)
    kinds = [
        (f"{name_of(output, motion)}, {percent(shares[motion])}", colour, numbers == motion)
        for motion, colour in distinct_colours(chosen).items()
    ]
    if more:
        kinds.append(("others", OTHERS, (numbers >= 0) & ~np.isin(numbers, chosen)))
    kinds.append(("undecided", "#e0e0e0", (numbers < 0) & (status < FIRST_FAILURE)))
    kinds.append(("failed", "black", has_failed(status)))
    kinds.append(("escaped", OLIVE, status == ESCAPED))
    return kinds


def attractor_map(figure, axes, grid, output):
    """Motions over two axes; over x0 and v0 with the states of the motions at the forcing phase of the start."""
    basins = all(is_start(axis) for axis in output.axes)
    title = "motion that the start ends in" if basins else "motion"
    notes = class_map(figure, axes, grid, title, basin_kinds(output))
    return notes + (section_points(axes, output) if output.axes in (("x0", "v0"), ("v0", "x0")) else [])


def section_points(axes, output):
    """States of the motions on the plane of the starts."""
    drawn, colours = False, distinct_colours(frequent(shares_of(output))[0])
    for motion in np.unique(output.values("attractor")):
        x, v = section_of(output, motion)
        if x.size == 0:
            continue
        drawn = True
        place = (x, v) if output.axes[0] == "x0" else (v, x)
        axes.plot(
            *place, "o", ms=5.5, mfc=colours.get(motion, OTHERS), mec="white", mew=1.2, zorder=4, gid=f"motion {motion}"
        )
    return ["points: states of the motions at the forcing phase of the start"] * drawn


def section_of(output, motion):
    """The states of a motion at the forcing phase of the starts, as far as the file has them: its section if that is
    observed, else the one of the table, which is for phase 0 and the parameters of the example. A mass that friction
    holds has a band of them."""
    nothing = np.empty(0), np.empty(0)
    if motion < 0 or output.values("motion_word")[motion] == STUCK:
        return nothing
    phase = float(output.scene.get("phase", 0.0))
    if "section_x" in output and float(output.config.get("observe", {}).get("section_phase", 0.0)) == phase:
        point = np.argmax(output.values("attractor").ravel() == motion)
        x, v = (
            output.values(name).reshape(-1, output.values(name).shape[-1])[point] for name in ("section_x", "section_v")
        )
        return x[np.isfinite(x)], v[np.isfinite(v)]
    if phase != 0.0 or output.held:
        return nothing
    return output.values("motion_x")[[motion]], output.values("motion_v")[[motion]]


def basin_points(axes, output):
    """Basins of starts that run along one dimension, such as those of Sobol's sequence."""
    first, second = start_plane(output)
    note_plane(axes, (first, second))
    x, y = (output.values(name) for name in (first, second))
    for name, colour, points in basin_kinds(output):
        if points.any():
            axes.plot(
                x[points], y[points], "o", ms=2.2, mew=0, color=colour, label=name, rasterized=points.sum() > 2000
            )
    axes.set_xlabel(label(output, first))
    axes.set_ylabel(label(output, second))
    legend_above(axes, columns=2, markerscale=2.0)


def start_plane(output):
    """The two starts that are linked along the only axis; empty if there is none, or dots over a key are asked for."""
    if output.is_scattered:
        return []
    linked = [name for name in STARTS if name in output and output[name].dims == output.axes]
    return linked[:2] if len(linked) >= 2 else []


def value_points(figure, axes, output, name):
    """A result at starts that run along one dimension, in colours."""
    first, second = start_plane(output)
    note_plane(axes, (first, second))
    values = shown_values(output, name)
    known = np.isfinite(values)
    levels = integer_levels(values, name)  # of counts, and what is so or not
    shade = level_colours(levels) if levels else None
    look = {"cmap": shade.cmap, "norm": shade.norm} if shade else {}
    places = (output.values(axis)[known] for axis in (first, second))
    points = axes.scatter(*places, s=6, lw=0, c=values[known], **look)
    axes.set_xlabel(label(output, first))
    axes.set_ylabel(label(output, second))
    title = label(output, name)
    bar = figure.colorbar(points, ax=axes, pad=0.02, **bar_style(levels))
    name_panel(axes, title, name_levels(bar, levels, name) if levels else tidy_ticks(bar.ax, title)["y"])


def has_linked_starts(output):
    """Whether another start runs along an axis of starts."""
    return any(
        name in output and name not in output.axes and output[name].dims[:1] in [(s,) for s in STARTS]
        for name in STARTS
    )


def has_shares(output):
    """Whether the output has shares over one parameter."""
    return "motion_share" in output and len(output["motion_share"].dims) == 2


def share_panel(figure, axes, output):
    """Shares of the starts over the parameter, stacked, and the zones above them. Returns the notes that explain it."""
    parameter = output["motion_share"].dims[0]
    shares = output.values("motion_share")
    places = output.values(parameter).astype(float)
    order = np.argsort(places, kind="stable")
    places, shares = places[order], shares[order]
    edges = edges_between(places)
    chosen, more = frequent(shares.max(axis=0))
    names = apart([name_of(output, motion) for motion in chosen], shares[:, chosen], places, symbol(output, parameter))
    colours = distinct_colours(chosen)
    parts = [(name, colours[motion], shares[:, motion]) for name, motion in zip(names, chosen)]
    if more:
        parts.append(("others", OTHERS, np.delete(shares, chosen, axis=1).sum(axis=1)))
    below = np.zeros(len(places))
    for _, colour, share in parts:
        for begin, end in runs(share > 0):
            part = slice(begin, end)
            low, high = below[part], below[part] + share[part]
            axes.stairs(high, edges[begin : end + 1], baseline=low, fill=True, color=colour, lw=0.0)
        below = below + share
    rest = [] if (below > 1 - 1e-9).all() else ["white: undecided, escaped or failed"]
    zone_strips(axes, edges, shares, [motion for motion in range(shares.shape[1]) if is_quiet(output, motion)])
    axes.set_xlim(edges[0], edges[-1])
    axes.set_ylim(0.0, 1.0 + 3 * GAP + 2 * STRIP)
    axes.set_yticks(np.linspace(0, 1, 6), labels=[f"{share:.0f} %" for share in np.linspace(0, 100, 6)])
    axes.set_xlabel(label(output, parameter))
    axes.set_ylabel("share of the starts")
    axes.tick_params(which="both", top=False, right=False)
    name_colours(figure, axes, parts)
    return rest + ["soft: one motion", "hard: several", "quiet: one of them has no impacts"]


def apart(names, shares, places, parameter):
    """The names, those of several motions with the parameter from which on each is there."""
    begins = [number(places[np.argmax(share > 0)]) for share in shares.T]
    return [f"{name}, {parameter} ≥ {begin}" if names.count(name) > 1 else name for name, begin in zip(names, begins)]


def is_quiet(output, motion):
    return not has_impacts(output.values("motion_word")[motion]) and output.values("motion_period_ratio")[motion] != 0


def zone_strips(axes, edges, shares, quiet):
    """Where the motion is the only one, one of several, and where motion without impacts is among them."""
    several = (shares > 0).sum(axis=1) > 1
    calm = (shares[:, quiet] > 0).any(axis=1)
    for row, covered in ((0, (("soft", ~several), ("hard", several))), (1, (("quiet", calm),))):
        low = 1.0 + GAP + row * (STRIP + GAP)
        for name, cells in covered:
            for begin, end in runs(cells):
                axes.fill_between(
                    edges[[begin, end]], low, low + STRIP, color=colors.to_rgba(dict(ZONES)[name], 0.45), lw=0, gid=name
                )
                if edges[end] - edges[begin] >= 0.07 * (edges[-1] - edges[0]):
                    middle = (edges[begin] + edges[end]) / 2
                    axes.text(middle, low + 0.45 * STRIP, name, fontsize=8.5, ha="center", va="center_baseline")


def runs(cells):
    """(begin, end) of each run of true cells."""
    changes = np.flatnonzero(np.diff(np.concatenate([[0], cells.astype(int), [0]])))
    return list(zip(changes[::2], changes[1::2]))
