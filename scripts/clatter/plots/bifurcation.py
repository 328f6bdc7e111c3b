"""Points instead of curves: bifurcation diagrams over one axis, and Poincaré sections of one scene."""

import numpy as np

from .curves import MARGIN, name_statuses
from .scales import shown_values
from .names import NO_CONTACT, in_frame, label, short_word, symbol, with_unit
from .empty import say_empty
from .shown import note_results
from .style import BLUE, CYCLE, GREEN, STOP, VERMILION, colour_of, legend_above, set_axis

FEW, MANY = 40, 2000  # points, up to which they are large, and from which on they are small
WORD = "impact word"  # marks the texts that may have to go
CHANGE = "_nolegend_: another word"  # marks the lines between neighbours, in no legend
ROOM = 1.5  # points, beside a word
CRITICAL = 0.97  # modulus from which on a multiplier tells which bifurcation is near


def dots(axes, x, y, color, title=None):
    """Points, as one image in vector formats; the more there are, the smaller, and at last translucent. A few are as
    large as they can be told apart."""
    many, crowded = len(x) > MANY, len(x) > 100 * MANY
    size = 1.6 if many else 4.0 if len(x) > FEW else 9.0
    style = {"marker": ","} if crowded else {"marker": ".", "mew": 0, "ms": size}
    axes.plot(x, y, ls="none", color=color, alpha=0.4 if crowded else None, rasterized=True, **style)
    if title:
        axes.plot([], [], ls="none", marker="o", mew=0, ms=4, color=color, label=title)


def instants(output):
    """When the states of a section are taken."""
    return "once a forcing period" if output.is_forced() else "on the way up"


def section_diagram(members, name, axes):
    """The states of each point's section over the only axis."""
    axis = members[0].output.axes[0]
    note_results(axes, [(name, None)])
    for place, member in enumerate(members):
        values = shown_values(member.output, name)
        known = np.isfinite(values)
        along = np.broadcast_to(member.output.values(axis)[:, None], values.shape)
        if known.any():
            dots(axes, along[known], values[known], colour_of(place), member.title)
    finish(members, axes, axis)
    if not axes.get_lines():
        say_empty(axes, "no states of a section")
    output = members[0].output
    words = f"{symbol(output, name)} {instants(output)}"
    axes.set_ylabel(in_frame(output, name, with_unit(output, words, name)))


def impact_diagram(members, axes):
    """Velocities before all observed impacts over the only axis."""
    axis, several = members[0].output.axes[0], len(members) > 1
    for place, member in enumerate(members):
        output = member.output
        along = np.repeat(output.values(axis), output.values("impact_count"))
        sides, before = output.values("impact_stop"), output.values("impact_v_before")
        for side, color in ((-1, BLUE), (1, VERMILION)):
            hit, title = sides == side, output.stop_name(side)
            if several:
                color, title = colour_of(place), member.title if side < 0 else None
            if hit.any():
                dots(axes, along[hit], before[hit], color, title)
    finish(members, axes, axis)
    if not any(member.output.values("impact_count").any() for member in members):
        say_empty(axes, "no impacts")
    axes.set_ylabel(label(members[0].output, "v_before"))


def finish(members, axes, axis):
    set_axis(axes, members[0].output, axis, MARGIN)
    axes.margins(y=0.08)
    for member in members:
        name_statuses(axes, member.output, axis, shown=False)
    if len(members) == 1:
        mark_words(axes, members[0].output, axis)
        mark_multipliers(axes, members[0].output, axis)
    legend_above(axes, columns=3)


def mark_words(axes, output, axis):
    """A line between neighbours with different impact words, and the words as far as there is room."""
    if "impact_word" not in output:
        return
    words, along = output.values("impact_word"), output.values(axis)
    order = np.argsort(along, kind="stable")
    words, along = words[order], along[order]
    starts = np.flatnonzero(np.append(True, words[1:] != words[:-1]))
    for start in starts[1:]:
        place = (along[start - 1] + along[start]) / 2
        axes.axvline(place, color=STOP, lw=0.5, ls=(0, (1, 2)), zorder=0.5, label=CHANGE)
    ends = np.append(starts[1:], len(words)) - 1
    runs = [(start, end) for start, end in zip(starts, ends) if words[start] not in NO_CONTACT]
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.1 * (high - low))  # room for the words
    for start, end in sorted(runs, key=lambda run: along[run[0]] - along[run[1]]):  # the widest first
        axes.text(
            (along[start] + along[end]) / 2,
            0.96,
            short_word(words[start]),
            fontsize=7,
            va="top",
            ha="center",
            color=STOP,
            transform=axes.get_xaxis_transform(),
            gid=WORD,
        ).set_in_layout(False)


def keep_words_with_room(figure):
    """Removes the words that lie on another one, on the end of their run or beyond their panel; everything else must
    be in the figure."""
    kept, ends = {}, {axes: changes_in(axes) for axes in figure.axes}
    for text in figure.findobj(lambda artist: artist.get_gid() == WORD):
        box = text.get_window_extent().padded(ROOM * figure.dpi / 72.0)
        boxes, frame = kept.setdefault(text.axes, []), text.axes.bbox
        is_cut = np.any((box.x0 < ends[text.axes]) & (ends[text.axes] < box.x1))
        if frame.x0 < box.x0 and box.x1 < frame.x1 and not is_cut and not any(box.overlaps(other) for other in boxes):
            boxes.append(box)
        else:
            text.remove()


def changes_in(axes):
    """The places of the lines between different words, in pixels."""
    places = [line.get_xdata()[0] for line in axes.get_lines() if line.get_label() == CHANGE]
    return axes.transData.transform([(place, 0.0) for place in places])[:, 0] if places else np.empty(0)


def mark_multipliers(axes, output, axis):
    """Triangles at the foot of a panel where a multiplier comes close to the unit circle: a bifurcation is near."""
    if "multiplier_re" not in output:
        return
    re, im = (shown_values(output, f"multiplier_{part}")[:, 0] for part in ("re", "im"))
    modulus = np.hypot(re, im)
    inner = np.nan_to_num(modulus, nan=0.0)
    peak = (inner >= CRITICAL) & (inner >= np.append(inner[1:], 0)) & (inner > np.insert(inner[:-1], 0, 0))
    kinds = (
        ("multiplier near −1", VERMILION, peak & (im == 0) & (re < 0)),
        ("multiplier near +1", GREEN, peak & (im == 0) & (re > 0)),
        ("complex multipliers near the unit circle", CYCLE[3], peak & (im != 0)),
    )
    for title, color, here in kinds:
        if here.any():
            axes.plot(
                output.values(axis)[here],
                np.full(here.sum(), 0.02),
                transform=axes.get_xaxis_transform(),
                ls="none",
                marker="^",
                ms=4.5,
                color=color,
                label=title,
                clip_on=False,
                zorder=4,
            )


def poincare(output, axes):
    """The section of one scene: x' against x once a forcing period."""
    x, v = (shown_values(output, f"section_{name}") for name in "xv")
    dots(axes, x, v, BLUE)
    if not np.isfinite(x).any():
        say_empty(axes, "no states of a section")
    axes.margins(x=0.05, y=0.05)
    axes.set_xlabel(f"{label(output, 'x')} {instants(output)}")
    axes.set_ylabel(label(output, "v"))
