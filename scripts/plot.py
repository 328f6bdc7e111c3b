#!/usr/bin/python3
"""Draws any output of clatter by what it contains: curves, time histories, phase planes, impacts, harmonics, maps, and
what accuracy costs in time."""

import argparse
import logging
import sys
import warnings
from itertools import takewhile
from pathlib import Path

if not sys.warnoptions:  # what numpy and matplotlib have to say is for those who work on this program
    warnings.simplefilter("ignore")
    logging.getLogger("matplotlib").setLevel(logging.ERROR)

try:
    import plot_style
    from matplotlib import pyplot
    from plot_accuracy import accuracy_figure
    from plot_data import FileProblem, Output
    from plot_figures import paper_figure
    from plot_generic import generic_figure
except ImportError as error:
    sys.exit(f"plot.py: {error}; install python3-h5py and python3-matplotlib (Debian), or h5py and matplotlib (pip)")

BAD_COMMAND, BAD_FILE = 2, 74  # exit codes, clatter's
DATELESS = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {}}  # the same bytes on every run


def command_line():
    parser = argparse.ArgumentParser(
        usage="plot.py [-o DIR] [--format svg|png|pdf...] FILE.h5...",
        description=__doc__,
        allow_abbrev=False,
        epilog="Exit codes: 0 done, 2 wrong command line, 74 a file cannot be read or " "written.",
    )
    parser.add_argument("files", nargs="*", metavar="FILE.h5", help="output of 'clatter run' or 'clatter accuracy'")
    parser.add_argument("-o", "--output", metavar="DIR", help="folder for the pictures; default: beside each file")
    parser.add_argument(
        "--format",
        nargs="+",
        default=["svg", "png"],
        metavar="svg|png|pdf",
        help="one or more formats; default: svg png",
    )
    options = parser.parse_intermixed_args()
    end_formats(parser, options)
    if not options.files:
        parser.error("no FILE.h5")
    return options


def end_formats(parser, options):
    """Takes what follows the formats for files, if it looks like one: argparse takes all of it for formats."""
    words = options.format
    options.format = list(takewhile(DATELESS.__contains__, words))
    rest = words[len(options.format) :]
    for word in rest:
        if not options.format or not Path(word).suffix and not Path(word).exists():
            parser.error(f"argument --format: '{word}' is none of {', '.join(sorted(DATELESS))}")
    options.files += rest


def draw(path, folder, formats):
    """Draws one file and returns the pictures' names."""
    figure = figure_of(Output(path))
    folder = Path(folder) if folder else Path(path).parent
    pictures = []
    for kind in dict.fromkeys(formats):
        picture = folder / f"{Path(path).stem}.{kind}"
        try:
            figure.savefig(picture, metadata=DATELESS[kind])
        except OSError as error:
            raise FileProblem(f"{picture}: cannot be written ({error.strerror}); name another folder with -o") from None
        pictures.append(str(picture))
    pyplot.close(figure)
    return pictures


def figure_of(output):
    """The figure, with its heading, that suits what the file contains."""
    if output.is_accuracy:
        return accuracy_figure(output)
    figure = (paper_figure(output) or generic_figure)(output)
    plot_style.heading(figure, output)
    return figure


def main():
    options = command_line()
    plot_style.use_style()
    try:
        if options.output:
            make_folder(options.output)
        for path in options.files:
            print("\n".join(draw(path, options.output, options.format)))
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
    sys.exit(main())
