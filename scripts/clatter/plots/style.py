"""How the pictures look: fonts, colours, stops, legends, headings."""

import functools
import re
import textwrap
from contextlib import contextmanager

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .choice import ChoiceProblem, condition, differing_keys, matters
from .data import OWN_AMPLITUDES
from .names import equation, label, plain, scale_in, symbol, typeset_unit

DPI = 200  # of PNG; texts are measured for it, once
LARGE = 115.0  # square inches, of a picture that has fewer dots an inch
NOTE = 0.19  # inches, of a line of a caption
WIDTH = 7.0  # inches, two columns of a journal: fonts below are in points at this size
WIDEST = 10.5  # inches, of any picture
LONGEST_LABEL = 1.15  # of the height of a panel, for the name of its ordinate

# Colours that stay apart for colour-blind readers and in grey (Okabe and Ito).
BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY = "#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9"
STOP, WALL, GRID = "#404040", "#e4e4e4", "#d0d0d0"
CYCLE = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)
COLOURS = (  # of more than six
    *CYCLE,
    *("#8c510a", "#80cdc1", "#762a83", "#b2df8a", "#003c30", "#fdbf6f", "#a50026", "#c7c7f0", "#666666"),
    *("#f4a582", "#4d9221", "#2166ac", "#fee391", "#7a0177", "#41b6c4", "#bc80bd", "#543005", "#d9ef8b"),
)


def colour_of(number):
    """The colour of a curve, a branch or a motion by its number; they come again after 24."""
    return COLOURS[number % len(COLOURS)]


def use_style(size=None):
    """The same look on every machine, whatever its matplotlibrc says; the same bytes on every run. Texts are divided
    into lines for this size, in inches, if it is given."""
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(
        {
            "font.family": "STIXGeneral",
            "mathtext.fontset": "stix",
            "font.size": 10,
            "axes.labelsize": 11,
            "axes.titlesize": 11,
            "xtick.labelsize": 9.5,
            "ytick.labelsize": 9.5,
            "legend.fontsize": 9.5,
            "axes.linewidth": 0.7,
            "lines.linewidth": 1.2,
            "xtick.direction": "in",
            "ytick.direction": "in",
            "xtick.major.pad": 5.5,  # numbers of both axes stand apart in the corner
            "xtick.minor.pad": 5.5,
            "xtick.top": True,
            "ytick.right": True,
            "legend.frameon": False,
            "legend.handlelength": 1.8,
            "axes.prop_cycle": matplotlib.cycler(color=CYCLE),
            "axes.titley": 1.0,
            "axes.formatter.useoffset": False,
            "axes.formatter.limits": (-4, 5),
            "axes.xmargin": 0.0,
            "hatch.linewidth": 0.5,
            "figure.dpi": DPI,
            "figure.figsize": size or (WIDEST, WIDEST),
            "svg.hashsalt": "clatter",
        }
    )


@contextmanager
def own_style(size=None):
    """The same for a while, in a program whose own look comes back afterwards."""
    with matplotlib.rc_context():
        use_style(size)
        yield


def typeset(output, title):
    """A configuration's title with its keys as symbols: 'xs = -4' becomes x_s = −4."""
    title = plain(title)
    title = re.sub(r"\b(xs|nu|x0|v0|R|h|f)(?= = )", lambda key: symbol(output, key.group(1)), title)
    return re.sub(r"(?<=[=,( ])-(?=\d)", "\N{MINUS SIGN}", title)


def heading(figure, output, title=None, others=()):
    """Title above the picture, and below it the constants that it does not already name, common to all outputs."""
    name = f"Fig. {output.figure}.  " if output.figure else "Accuracy and time.  " if output.is_accuracy else ""
    titles = {other.title for other in others if other.is_branch == output.is_branch}
    is_true = not any(names_key(output.title, key) for key in differing_keys(others))
    own = output.title if len(titles) < 2 and is_true else ""
    shown = constants(output, own, others)
    lines = constant_lines(figure, shown)
    to_text = functools.partial(typeset, output) if title is None else plain
    first = title_lines(figure, f"{name}{own}" if title is None else title, to_text)
    figure.suptitle("\n".join([*first, *lines]).strip(), fontsize=10.5, linespacing=1.5)


def names_key(title, key):
    """Whether a title tells the value of a key."""
    return bool(re.search(rf"\b{key} = ", title))


def constant_lines(figure, entries):
    """Entries in lines that fit a figure, in as many as they need, and about as many in each."""
    most = int(1.2 * figure.get_figwidth())
    needed = len(filled_lines(figure, entries, most))
    fewest = -(-len(entries) // max(needed, 1))
    found = (filled_lines(figure, entries, count) for count in range(fewest, most + 1))
    return next((lines for lines in found if len(lines) == needed), [])


def filled_lines(figure, entries, most):
    """Entries in lines of so many at most, each as full as a figure has room for."""
    room, lines = 0.97 * figure.bbox.width, []
    for entry in entries:
        longer = [*lines[-1], entry] if lines else []
        if 0 < len(longer) <= most and heading_width(figure, ",   ".join(longer)) <= room:
            lines[-1] = longer
        else:
            lines.append([entry])
    return [",   ".join(line) for line in lines]


def heading_width(figure, text):
    """In pixels."""
    return figure.suptitle(text, fontsize=10.5).get_window_extent().width


def title_lines(figure, title, to_text):
    """A title as text, in as many lines as a figure needs; an equation isn't divided."""
    width = heading_width(figure, to_text(title))
    room = int(0.97 * figure.bbox.width / max(width, 1.0) * len(title))
    joined = re.sub(r" (?== )|(?<= =) ", "\0", title)
    parts = [title] if room >= len(title) else even_lines(joined, room)
    return [to_text(part.replace("\0", " ")) for part in parts]


def set_view(axes, options):
    """The scales and limits that the command line asks for."""
    for axis, limits in (("x", options.xlim), ("y", options.ylim)):
        if axis in options.log:
            getattr(axes, f"set_{axis}scale")("log")
        if limits:
            require_unit(axes, axis, limits)
            getattr(axes, f"set_{axis}lim")(*limits)


def require_unit(axes, axis, limits):
    """Refuses limits with a unit that isn't that of the axis, as its label names it; one without label is as another
    that has one."""
    words, unit = getattr(axes, f"get_{axis}label")(), getattr(limits, "unit", "")
    if not unit or not words or scale_in(words) != 1 and limits.units == "m":
        return
    if f"({typeset_unit(limits.units)})" not in words:
        name = " ".join(re.sub(r"\$[^$]*\$", " ", words).split()) or words  # a terminal shows no TeX
        raise ChoiceProblem(f"--{axis}lim: the unit '{unit}' doesn't fit the axis '{name}'")


def caption_below(figure, notes):
    """Notes below the panels, as many in a line as it has room for; a figure of many notes grows with them."""
    room, lines = int(13 * figure.get_figwidth()), []
    for note in gathered(dict.fromkeys(notes)):
        if lines and len(lines[-1]) + len(note) + 4 <= room:
            lines[-1] += f";   {note}"
        else:
            lines += even_lines(note, room)
    figure.supxlabel("\n".join(lines), fontsize=9.5, linespacing=1.4)
    figure.set_figheight(figure.get_figheight() + NOTE * max(0, len(lines) - 2))


def even_lines(text, room):
    """A text in as few lines of so many letters as it needs, about as long as each other: no word stands alone."""
    lines = textwrap.wrap(text, room)
    narrower = (textwrap.wrap(text, width) for width in range(-(-len(text) // max(len(lines), 1)), room))
    return next((even for even in narrower if len(even) == len(lines)), lines)


def gathered(notes):
    """The notes, with those alike for both stops as one, and the reasons for white in the last."""
    white = "white: "
    reasons = [note.removeprefix(white) for note in notes if note.startswith(white)]
    others = [note for note in notes if not note.startswith(white)]
    for note in list(others):
        of_lower = re.search(", lower (stop|wall)", note)
        if of_lower and (twin := note.replace(", lower", ", upper")) in others:
            others[others.index(note)] = note.replace(of_lower[0], f", both {of_lower[1]}s")
            others.remove(twin)
    return [*others, white + ", or ".join(reasons)] if reasons else others


def constants(output, title, others=()):
    """The fixed numbers of the scene that the title doesn't name, e.g. ['h = 0.1', 'f = −1']."""
    starts = ("x0", "v0", "loose_x0", "loose_v0", "phase")
    nothing = (
        *starts,
        "load",
        "loose_load",
        "damping",
        "friction",
        "loose_friction",
        "stop_amplitude",
        "base_amplitude",
        "stop_phase",
        *OWN_AMPLITUDES,
        "stop_phase_lower",
        "stop_phase_upper",
    )
    stiffnesses = ("stop_stiffness", "stop_stiffness_lower", "stop_stiffness_upper")
    hidden = {
        **dict.fromkeys(nothing, 0.0),
        "stiffness": 0.0 if output.is_si else 1.0,
    }  # nothing to say at these values
    named = {key for key in output.constants if names_key(title, key)}
    keys = [key for key in output.constants if key in output.scene and key not in named and not output.swept(key)]
    keys = [key for key in keys if matters(output, key)]
    keys = [key for key in keys if len({condition(other, key) for other in (output, *others)}) == 1]
    forces = ("force" if output.is_si else "f", "stop_amplitude", "base_amplitude", *OWN_AMPLITUDES)
    if not any(float(output.scene.get(key, 0.0)) or output.swept(key) for key in forces):
        keys = [key for key in keys if key not in ("nu", "frequency", "phase")]  # no force, no frequency
    if not any(output.swept(key) or np.isfinite(float(output.scene.get(key, np.inf))) for key in stiffnesses):
        keys = [key for key in keys if not key.startswith("stop_damping")]  # of rigid stops
    absent = {key for key, side in (("R_lower", -1), ("R_upper", 1)) if not output.has_stop(side)}
    absent |= {"R"} if output.is_of_walls else set()
    values = {key: float(output.scene[key]) for key in keys if key not in absent}
    return [
        equation(output, key, value)
        for key, value in values.items()
        if np.isfinite(value) and not (key in hidden and value == hidden[key])
    ]


def legend_above(axes, columns=4, **options):
    """A legend on top of the panel's frame, where it covers no data."""
    entries = dict(zip(*reversed(axes.get_legend_handles_labels())))  # each name once
    names, handles = list(entries), list(entries.values())
    if handles:
        axes.legend(
            handles,
            names,
            loc="lower center",
            bbox_to_anchor=(0.5, 1.0),
            ncol=columns,
            borderaxespad=0.15,
            columnspacing=1.2,
            handletextpad=0.5,
            **options,
        )


def draw_walls(axes, lower, upper, vertical=False, named="stops"):
    """Stops as lines with the wall behind them shaded; the view reaches a little into the walls, and as far as motion
    does into those that are soft."""
    line, span = (axes.axvline, axes.axvspan) if vertical else (axes.axhline, axes.axhspan)
    view, set_view = (axes.get_xlim, axes.set_xlim) if vertical else (axes.get_ylim, axes.set_ylim)
    stops = [stop for stop in (lower, upper) if np.isfinite(stop)]
    if not stops:
        return
    low, high = min(*view(), *stops), max(*view(), *stops)
    margin = 0.08 * (high - low)
    low = min(low, lower - margin) if np.isfinite(lower) else low
    high = max(high, upper + margin) if np.isfinite(upper) else high
    for place, stop in enumerate(stops):
        line(stop, color=STOP, lw=1.0, zorder=1.5, label=named if named and place == 0 else None)
        span(stop, low if stop == lower else high, color=WALL, lw=0, zorder=0)
    set_view(low, high)


def is_geometric(values):
    """Whether values are spread by equal ratios, so that a logarithmic axis shows them best."""
    values = np.asarray(values, float)
    if len(values) < 3 or np.any(values <= 0) or values.max() < 20 * values.min():
        return False
    steps = np.diff(np.log(values))
    return np.allclose(steps, steps[0], rtol=1e-6)


def set_axis(axes, output, name, margin=0.0):
    """Scale, label and limits of a swept axis; a margin, as a share of its length, keeps markers off the frame."""
    values = output.values(name)
    if is_geometric(values):
        axes.set_xscale("log")
    if values.min() < values.max():
        to_scale, from_scale = (np.log, np.exp) if is_geometric(values) else (np.asarray, np.asarray)
        low, high = to_scale([values.min(), values.max()])
        axes.set_xlim(from_scale([low - margin * (high - low), high + margin * (high - low)]))
    axes.set_xlabel(label(output, name))


def lay_out(figure):
    """Finds the place of every panel, once for all formats. Titles stand on their frames: to look for ticks and labels
    above a frame takes longer than to draw."""
    for axes in figure.axes:
        axes.set_title(axes.get_title(), fontsize=axes.title.get_fontsize())
    figure.get_layout_engine().execute(figure)
    if any([divide_label(axes) for axes in figure.axes]):
        figure.get_layout_engine().execute(figure)
    figure.set_layout_engine(None)  # else every format is drawn twice, first to lay it out


def divide_label(axes):
    """Divides the name of an ordinate into lines if it is longer than its panel has room for; returns whether it is."""
    name, room = axes.yaxis.label, LONGEST_LABEL * axes.bbox.height
    length, text = name.get_window_extent().height, name.get_text()
    if length <= room or not text:
        return False
    name.set_text("\n".join(lines_of(text, room / length * max(map(letters, text.split("\n"))))))
    return name.get_text() != text


def letters(text):
    """About how many letters wide a text is, without the signs that typeset it."""
    return len(re.sub(r"[$^_{}]|\\[a-z]+", "", text))


def lines_of(text, room):
    """A text in lines of about so many letters, none of which ends within mathematics."""
    lines = []
    for word in re.split(r"[ \n]", text):
        is_open = bool(lines) and lines[-1].count("$") % 2 == 1
        if lines and (is_open or letters(f"{lines[-1]} {word}") <= room):
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


def resolution(figure, dpi):
    """Dots per inch of a figure: fewer for one of many panels, whose file would have megabytes."""
    return dpi * min(1.0, (LARGE / np.prod(figure.get_size_inches())) ** 0.5)


def new_figure(height, width=WIDTH):
    """A figure that needs no display: pyplot doesn't know it."""
    widest, _ = matplotlib.rcParams["figure.figsize"]
    figure = Figure(figsize=(min(width, widest), height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure
