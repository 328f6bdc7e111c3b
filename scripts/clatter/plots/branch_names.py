"""Which branches of a picture have a colour and a name of their own: the first and the longest."""

import numpy as np

from .choice import told_apart
from .names import NO_CONTACT, plain, short_word
from .style import colour_of

NAMED = 10  # branches, or files if there are several
REST = "#a0a0a0"  # colour of all others


def colours_and_names(branches, parameter, names, own):
    """The colour of each branch that is named, by the place of its file and its number, and the entries of the legend:
    (colour, name). `names` are those of the quantities that the panels show, `own` is how the scene of each file
    differs."""
    units = [[(place, number) for number in numbers_in(output)] for place, output in enumerate(branches)]
    if len(units) > 1:
        titles = titles_of_files(branches, own)
    else:
        titles = [prefixed(own[0], title_of(branches[0], number)) for _, number in units[0]]
    units = units if len(units) > 1 else [[branch] for branch in units[0]]
    extents = {key: extent(branches, key) for key in (parameter, *names)}

    def length(unit):
        return sum(
            drawn_length(branches[place], number, {key: extents[key] for key in (parameter, name)})
            for place, number in unit
            for name in names
        )

    lengths = list(map(length, units))
    longest = sorted(range(1, len(units)), key=lambda unit: -lengths[unit])
    named = sorted([0, *longest[: NAMED - 1]])
    colours = {branch: colour_of(rank) for rank, unit in enumerate(named) for branch in units[unit]}
    legend = [(colour_of(rank), titles[unit]) for rank, unit in enumerate(named)]
    rest = len(units) - len(named)
    if rest:
        one, many = ("branch", "branches") if len(branches) == 1 else ("file", "files")
        legend.append((REST, f"{rest} other {one if rest == 1 else many}"))
    return colours, legend


def numbers_in(output):
    return np.unique(output.values("branch"))


def title_of(output, number):
    return f"{word_of(output, number)}, branch {number}"


def titles_of_files(branches, own):
    """How the scene of each file differs, and the regime and word that it begins with; with the name of the file if
    these are the same."""
    titles = []
    for output, difference in zip(branches, own):
        number = numbers_in(output)[0]
        regime = output.values("regime")[middle(output, number)]
        titles.append(prefixed(difference, f"{plain(regime)}, {word_of(output, number)}"))
    return told_apart(titles, branches)


def prefixed(difference, title):
    """The title of a curve behind the keys that it doesn't share with all others."""
    return f"{difference}: {title}" if difference else title


def word_of(output, number):
    word = output.values("word")[middle(output, number)]
    return short_word(word) if word not in NO_CONTACT else "no impacts"


def middle(output, number):
    """The point in the middle of a branch."""
    own = np.flatnonzero(output.values("branch") == number)
    return own[len(own) // 2]


def extent(branches, key):
    values = np.concatenate([output.values(key) for output in branches])
    values = values[np.isfinite(values)]
    return np.ptp(values) if values.size and np.ptp(values) > 0 else 1.0


def drawn_length(output, number, extents):
    """How long a branch is in a panel of these quantities, in parts of its sides."""
    own = output.values("branch") == number
    steps = [np.nan_to_num(np.diff(output.values(key)[own]) / length) for key, length in extents.items()]
    return np.linalg.norm(steps, axis=0).sum()
