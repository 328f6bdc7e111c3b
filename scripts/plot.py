#!/usr/bin/python3
"""Draws outputs of clatter by what they hold; --help says more."""

import io
import logging
import sys
import warnings
from pathlib import Path

import plot_files

if __name__ == "__main__":
    plot_files.begin()  # before what takes long to import
if not sys.warnoptions:  # warnings of numpy and matplotlib are for those who work on this program
    warnings.simplefilter("ignore")
    logging.getLogger("matplotlib").setLevel(logging.ERROR)

try:
    import plot_legends
    import plot_style
    from matplotlib import pyplot
    from plot_accuracy import accuracy_figure
    from plot_bifurcation import keep_words_with_room
    from plot_branch import branch_figure, curve_figure, plane_of
    from plot_choice import ChoiceProblem, members_of, results_named, together
    from plot_data import FileProblem, Output
    from plot_figures import paper_figure
    from plot_generic import generic_figure
    from plot_log import names_left_out, note_left_out
    from plot_options import command_line
    from plot_scales import tidy_ticks
except ImportError as error:
    sys.exit(f"plot.py: {error}; install python3-h5py and python3-matplotlib (Debian), or h5py and matplotlib (pip)")

BAD_COMMAND, BAD_FILE = 2, 74  # exit codes, clatter's
DATELESS = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {}}  # the same bytes on every run
ENCODING = {"png": {"pil_kwargs": {"compress_level": 4}}}  # nearly as small as at 6, sooner
RASTER = {"svg": 150, "pdf": 200, "png": plot_style.DPI}  # dots per inch of what is drawn as an image


def pictures(options):
    """(stem of the name, figure) for each picture, drawn one at a time."""
    if any(is_branch(path) for path in options.files):
        yield "+".join(Path(path).stem for path in options.files), branches_together(options)
        return
    outputs = (Output(path) for path in options.files)
    shared = shared_members(options)
    if shared:
        yield "+".join(Path(path).stem for path in options.files), figure_of(shared, options)
        return
    for path, output in zip(options.files, outputs):
        yield Path(path).stem, single_figure(output, options)


def is_branch(path):
    return Output(path).is_branch


def branches_together(options):
    """All branches, or curves, of the files in one picture, with the results of sweeps behind them."""
    outputs = [Output(path) for path in options.files]
    branches = [output for output in outputs if output.is_branch]
    figure = curve_figure(outputs, options) if any(map(plane_of, branches)) else branch_figure(outputs, options)
    plot_style.heading(figure, branches[0], options.title, branches)
    return finished(figure, options)


def shared_members(options):
    """What all files together draw in one picture, if they can share one."""
    if len(options.files) < 2:
        return None
    parts = []
    for path in options.files:
        output = Output(path)
        if output.is_accuracy or output.figure:
            return None
        members = members_of(output, options.along, options.over, options.at)
        if len(members) > 1 or len(members[0].output.axes) != 1:
            return None
        parts.append(members[0].output)
    return together(parts)


def single_figure(output, options):
    if output.is_accuracy:
        return accuracy_figure(output)
    chosen = options.only or options.along or options.over or options.at
    draw = None if chosen else paper_figure(output)
    if draw is None:
        return figure_of(members_of(output, options.along, options.over, options.at), options)
    figure = draw(output)
    plot_style.heading(figure, output, options.title)
    return finished(figure, options)


def figure_of(members, options):
    figure = generic_figure(members, results_named(members, options.only), options)
    plot_style.heading(figure, members[0].output, options.title, [member.output for member in members])
    return finished(figure, options)


def finished(figure, options):
    """Sets what the options say of every panel, and the layout once for all formats."""
    left_out = []
    for axes in figure.axes:
        if axes.get_label() != "<colorbar>" and axes.axison:  # a table has no scales
            left_out += names_left_out(axes, options)
            plot_style.set_view(axes, options)
            tidy_ticks(axes)
    note_left_out(figure, left_out)
    if options.size:
        figure.set_size_inches(options.size)
    plot_legends.lay_out(figure, is_fixed=bool(options.size))
    keep_words_with_room(figure)
    return figure


def save(figure, folder, stem, formats):
    """Writes a picture in each format and tells their names."""
    for kind in dict.fromkeys(formats):
        name, drawn, dpi = folder / f"{stem}.{kind}", io.BytesIO(), plot_style.resolution(figure, RASTER[kind])
        figure.savefig(drawn, format=kind, metadata=DATELESS[kind], dpi=dpi, **ENCODING.get(kind, {}))
        try:
            plot_files.write_whole(name, drawn.getbuffer())
        except OSError as error:
            raise FileProblem(f"{name}: cannot be written ({error.strerror}); name another folder with -o") from None
        plot_files.tell("plot.py", name)
    pyplot.close(figure)


def main():
    options = command_line()
    plot_style.use_style(options.size)
    try:
        if options.output:
            make_folder(options.output)
        places = iter(options.files)
        for stem, figure in pictures(options):
            folder = Path(options.output) if options.output else Path(next(places)).parent
            save(figure, folder, stem, options.format)
    except ChoiceProblem as problem:
        print(f"plot.py: {problem}", file=sys.stderr)
        return BAD_COMMAND
    except FileProblem as problem:
        print(f"plot.py: {problem}", file=sys.stderr)
        return BAD_FILE
    return 0


def make_folder(folder):
    try:
        Path(folder).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileProblem(f"{folder}: no folder can be made here ({error.strerror}); name another with -o") from None


if __name__ == "__main__":
    sys.exit(plot_files.run("plot.py", main))
