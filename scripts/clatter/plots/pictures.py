"""Pictures of outputs of clatter, by what they hold."""

import io
import warnings
from pathlib import Path

from . import legends, style
from .accuracy import accuracy_figure
from .bifurcation import keep_words_with_room
from .branch import branch_figure, curve_figure, plane_of
from .choice import ChoiceProblem, members_of, results_named, together
from .data import Output
from .figures import paper_figure
from .generic import generic_figure
from .log import names_left_out, note_left_out
from .room import require_room
from .scales import tidy_ticks

DATELESS = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {}}  # the same bytes on every run
ENCODING = {"png": {"pil_kwargs": {"compress_level": 4}}}  # nearly as small as at 6, sooner
RASTER = {"svg": 150, "pdf": 200, "png": style.DPI}  # dots per inch of what is drawn as an image


def pictures(options):
    """(stem of the name, figure) for each picture, drawn one at a time."""
    shared = shared_figure(options)
    if shared:
        yield "+".join(Path(path).stem for path in options.files), shared
        return
    for path in options.files:
        yield Path(path).stem, single_figure(Output(path), options)


def shared_figure(options):
    """The picture of all files together, or of a single one; None if each has its own."""
    if len(options.files) == 1:
        output = Output(options.files[0])
        return branches_together([output], options) if output.is_branch else single_figure(output, options)
    if any(Output(path).is_branch for path in options.files):
        return branches_together([Output(path) for path in options.files], options)
    members = shared_members(options)
    return figure_of(members, options) if members else None


def branches_together(outputs, options):
    """All branches, or curves, of the files in one picture, with the results of sweeps behind them."""
    branches = [output for output in outputs if output.is_branch]
    if options.scatter:
        raise ChoiceProblem("--scatter: branches are curves; a sweep has points that can be scattered")
    if len({output.is_si for output in outputs}) > 1:
        raise ChoiceProblem(
            "[scene] and [machine] in one picture: their units differ; draw each in a picture of its own"
        )
    shape = curve_figure if any(map(plane_of, branches)) else branch_figure

    def draw():
        figure = shape(outputs, options)
        style.heading(figure, branches[0], options.title, outputs)
        return figure

    return finished(draw, options)


def shared_members(options):
    """The members of one picture of several files, if they can share it."""
    parts = []
    for path in options.files:
        output = Output(path)
        if output.is_accuracy or output.figure:
            return None
        members = members_of(output, options.along, options.over, options.at, options.scatter)
        if len(members) > 1 or len(members[0].output.axes) != 1:
            return None
        parts.append(members[0].output)
    return together(parts)


def single_figure(output, options):
    if output.is_accuracy:
        return with_room(lambda size: accuracy_figure(output, options.title, size), options)
    chosen = options.only or options.along or options.over or options.at or options.scatter
    paper = None if chosen else paper_figure(output)
    if paper is None:
        return figure_of(members_of(output, options.along, options.over, options.at, options.scatter), options)

    def draw():
        figure = paper(output)
        style.heading(figure, output, options.title)
        return figure

    return finished(draw, options)


def figure_of(members, options):
    def draw():
        figure = generic_figure(members, results_named(members, options.only), options)
        style.heading(figure, members[0].output, options.title, [member.output for member in members])
        return figure

    return finished(draw, options)


def finished(draw, options):
    """The figure that is drawn, with what the options say of every panel."""
    return with_room(lambda size: laid_out(draw(), options, size), options)


def with_room(draw, options):
    """The figure of the size that is chosen, if that has room for it."""
    if not options.size:
        return draw(None)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="constrained_layout not applied")  # it is refused then
        figure = draw(options.size)
        require_room(figure, draw, options.size)
    return figure


def laid_out(figure, options, size):
    """Sets what the options say of every panel, and the layout once for all formats."""
    left_out = []
    for axes in figure.axes:
        if axes.get_label() != "<colorbar>" and axes.axison:  # a table has no scales
            left_out += names_left_out(axes, options)
            style.set_view(axes, options)
            tidy_ticks(axes)
    note_left_out(figure, left_out)
    if size:
        figure.set_size_inches(size)
    legends.lay_out(figure, is_fixed=bool(size))
    keep_words_with_room(figure)
    return figure


def in_format(figure, kind):
    """A picture as a file of this format holds it."""
    drawn, dpi = io.BytesIO(), style.resolution(figure, RASTER[kind])
    figure.savefig(drawn, format=kind, metadata=DATELESS[kind], dpi=dpi, **ENCODING.get(kind, {}))
    return drawn.getbuffer()
