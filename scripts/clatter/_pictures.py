"""Pictures and pages as functions: what the commands clatter-plot and clatter-report make."""

import os
import re
from contextlib import contextmanager
from pathlib import Path

from ._program import WRONG_USE, ClatterError


def plot(
    files,
    *,
    only=(),
    along=None,
    over=None,
    at=None,
    scatter=None,
    size=None,
    xlim=None,
    ylim=None,
    log=None,
    backbone=False,
    title=None,
):
    """The picture of an output of `clatter run`, `clatter accuracy` or `clatter branch`, by what it holds, as a
    matplotlib.figure.Figure. No file is written, no display is needed, and the style of other figures stays as it is.

    files: path of an output, or a list of those that share a picture: curves over one axis, or branches and sweeps.
    only: results, or keys of [observe], that have a panel, e.g. "x_max", or a list of them; by default all.
    along: the axis on the abscissa; by default the longest, of a map the first.
    over: the axis of which each value has a curve; by default those with few values.
    at: values of axes, the nearest is taken, e.g. {"xs": 4.0}; of several, [2.0, 4.0], each is a curve. Numbers are in
        the units of the file, texts may have their own, e.g. {"gap": "1.5 mm"}.
    scatter: a key that is swept, along an axis of its own or linked to another: each point is a dot over it, in the
        colour of its impact word, if the file has words.
    size: width and height in inches, 1 to 100.
    xlim, ylim: two limits of the abscissa, or ordinate, of every panel, likewise, e.g. ("10 Hz", "40 Hz").
    log: "x", "y" or "xy", the logarithmic scales.
    backbone: whether the speed of conservative motion is behind branches along nu.
    title: in place of the configuration's.

    Raises ClatterError: its exit_code is 74 if a file can't be read, 2 if it doesn't offer what is chosen, or if the
    files share no picture. TypeError if a value is of no such type; ImportError without the extra clatter[plot].
    """
    words = _words(only, along, over, at, scatter, size, xlim, ylim, log, backbone, title)
    with needing("plot"):
        from .plots import options, pictures, style
    with _in_words_of_python():
        chosen = options.choices(_paths(files), words)
        with style.own_style(chosen.size):
            figure = pictures.shared_figure(chosen)
        if figure is None:
            raise ClatterError(
                "these files share no picture: not all hold curves over the same axis; plot one by one", WRONG_USE
            )
    return figure


def report(files, output="report.html", *, title=None, histories=True):
    """Writes one page in HTML of outputs, which needs no network, and returns its pathlib.Path.

    files: path of an output, or a list of them.
    output: the page; an older report is replaced, any other file isn't.
    title: in place of that of the first file.
    histories: whether the program computes the motion of up to 200 points of each sweep for the page.

    Raises ClatterError with the exit_code 74 if a file can't be read or written; TypeError if a value is of no such
    type; ImportError without the extra clatter[report].
    """
    if not isinstance(output, (str, os.PathLike)):
        raise TypeError(f"output = {output!r}: expected the path of the page")
    with needing("report"):
        from .reports.page import write_page
    with _in_words_of_python():
        return write_page(_paths(files), Path(output), title, histories)


@contextmanager
def needing(extra):
    """Around imports: if one fails, the error says in one line what to install."""
    try:
        yield
    except ImportError as error:
        way_out = f"pip install 'clatter[{extra}]', or install python3-h5py and python3-matplotlib (Debian)"
        raise ImportError(f"{error}; {way_out}") from None


@contextmanager
def _in_words_of_python():
    """Messages name arguments as a call has them: only, not --only."""
    try:
        yield
    except ClatterError as error:
        message = re.sub(r"(?<!\S)--(?=[a-z])| with -o\b", "", str(error))
        raise ClatterError(message, error.exit_code) from None


def _paths(files):
    if hasattr(files, "data_vars"):  # an xarray.Dataset, whose items are the names of its variables
        raise TypeError(
            "a dataset in memory has no picture; expected the path of an output, or a list of them, as "
            'clatter.run(..., output="a.h5") keeps it'
        )
    files = [files] if isinstance(files, (str, os.PathLike)) else files
    try:
        paths = [os.fspath(file) for file in files]
    except TypeError:
        paths = []
    if not paths:
        raise TypeError(f"{files!r}: expected the path of an output, or a list of them")
    return paths


def _words(only, along, over, at, scatter, size, xlim, ylim, log, backbone, title):
    """The choices as words of a command line, which checks them."""
    texts = {"only": only, "along": along, "over": over, "scatter": scatter, "log": log, "title": title}
    if not isinstance(only, str):
        texts["only"] = _joined("only", only)
    pairs = {"xlim": (xlim, ","), "ylim": (ylim, ","), "size": (size, "x")}
    texts |= {name: sign.join(_numbers(name, pair)) for name, (pair, sign) in pairs.items() if pair is not None}
    if not isinstance(at, (dict, type(None))):
        raise TypeError(f"at = {at!r}: expected a dictionary of axes, e.g. {{'xs': 4.0}}")
    words = [f"--{name}={value}" for name, value in texts.items() if value is not None]
    for axis, values in (at or {}).items():
        is_one = isinstance(values, str) or not hasattr(values, "__iter__")
        words.append(f"--at={axis}={','.join(_numbers('at', [values] if is_one else values))}")
    return words + ["--backbone"] * bool(backbone)


def _joined(name, texts):
    """Texts with commas between them; None if there is none."""
    try:
        return ",".join(texts) or None
    except TypeError:
        raise TypeError(f"{name} = {texts!r}: expected a text, or a list of texts") from None


def _numbers(name, values):
    """Numbers as words, to their last bit; texts of numbers with units as they are, but sizes have none."""
    try:
        return [value if name != "size" and _is_measure(value) else repr(float(value)) for value in values]
    except (TypeError, ValueError):
        raise TypeError(f"{name} = {values!r}: expected numbers") from None


def _is_measure(value):
    """Whether it is a text that may be a number with a unit."""
    return isinstance(value, str) and any(map(str.isdigit, value))
