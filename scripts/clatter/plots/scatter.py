"""Every point of a sweep as a dot over any key that is swept, in the colour of its impact word."""

import numpy as np

from .curves import MANY, MARGIN, draw_stops_along, label_of, name_statuses, set_ordinate
from .data import lacks_period
from .names import NO_CONTACT, PLACES, short_word
from .scales import shown_values
from .shown import note_results
from .style import STOP, colour_of, legend_above, set_axis

NAMED = 8  # words with a colour of their own
OTHERS = "#a0a0a0"


def words_of_points(output):
    """(name, colour, points) of each impact word, the most frequent first; rare ones are together, motion without a
    period comes last and has no colour."""
    words, loose = output.values("impact_word").astype(str), lacks_period(output.values("status"))
    words = np.where(np.isin(words, NO_CONTACT), "", words)
    known, counts = np.unique(words[~loose], return_counts=True)
    order = known[np.argsort(-counts, kind="stable")]
    kinds = [
        (short_word(word) if word else "no impacts", colour_of(place), (words == word) & ~loose)
        for place, word in enumerate(order[:NAMED])
    ]
    rest = np.isin(words, order[NAMED:]) & ~loose
    return kinds + [("other words", OTHERS, rest)] * bool(rest.any()) + [("", None, loose)] * bool(loose.any())


def word_scatter(members, parts, axes):
    """A result, or a component of it, of the only member over its only axis."""
    output, (name, component, _) = members[0].output, parts[0]
    note_results(axes, [(name, component)])
    along, values = output.values(output.axes[0]), shown_values(output, name)
    values = values if component is None else values[:, component]
    for word, colour, here in words_of_points(output):
        look = {"mfc": colour, "mew": 0} if colour else {"mfc": "white", "mec": STOP, "mew": 0.7, "zorder": 3}
        shown = here & np.isfinite(values)
        style = {"ls": "none", "marker": "o", "ms": 3.0, "color": colour or STOP, **look}
        axes.plot(along[shown], values[shown], rasterized=shown.sum() > MANY, **style)
        if word:
            axes.plot([], [], label=word, **{**style, "ms": 4.0})
    set_axis(axes, output, output.axes[0], MARGIN)
    axes.margins(y=0.08)
    if name in PLACES:
        draw_stops_along(axes, output, output.axes[0])
    name_statuses(axes, output, output.axes[0], shown=lacks_period(output.values("status")).any())
    axes.set_ylabel(label_of(output, parts))
    set_ordinate(axes, output, [name])
    legend_above(axes, columns=4)
