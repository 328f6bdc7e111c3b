"""The command line of clatter-plot, and the same choices from Python."""

import argparse
import os
import re
import sys
from itertools import takewhile
from pathlib import Path

from .._command import SEE_HELP, Parser
from .written import finite, limits

FORMATS = ("pdf", "png", "svg")
USAGE = """%(prog)s [-o DIR] [--format svg|png|pdf...] [--only NAME,...]
               [--along AXIS] [--over AXIS] [--at AXIS=VALUE,...]
               [--scatter KEY]
               [--size WxH] [--xlim A,B] [--ylim A,B] [--log x|y|xy]
               [--backbone] [--title TEXT] FILE.h5..."""
SUMMARY = "draw outputs of clatter"
DESCRIPTION = """Draws outputs of clatter by what they hold: curves and families of them, bifurcation diagrams,
hysteresis, Poincaré sections, time histories, phase planes, impacts, harmonics, maps, basins, shares of motions,
branches of stable and unstable motion with a sweep behind them, and what accuracy costs in time."""
EPILOG = """Several files share a picture if all of them hold curves over the same axis and none is a figure of the
paper, or if one of them holds branches. Exit codes: 0 done, 2 wrong command line, 74 a file cannot be read or
written."""


def options_parser():
    """All that --help and the man page tell."""
    parser = Parser(usage=USAGE, description=DESCRIPTION, allow_abbrev=False, epilog=EPILOG)
    add = parser.add_argument
    add(
        "files",
        nargs="*",
        metavar="FILE.h5",
        help="output of 'clatter run', 'clatter accuracy' or 'clatter branch'; after --, also names that begin with -",
    )
    add("-o", "--output", metavar="DIR", help="folder for the pictures; default: beside each file")
    add("--format", nargs="+", default=["svg", "png"], metavar="svg|png|pdf", help="default: svg png")
    add("--only", type=names, default=(), metavar="NAME,...", help="panels of these results, or of keys of [observe]")
    add(
        "--along", default="", metavar="AXIS", help="the axis on the abscissa; default: the longest, of a map the first"
    )
    add(
        "--over", default="", metavar="AXIS", help="a curve for each value of this axis; default: those with few values"
    )
    add(
        "--at",
        type=places,
        action="extend",
        default=[],
        metavar="AXIS=VALUE,...",
        help="the value of an axis that is nearest; several, here or in further --at of that axis, are a curve each. "
        "Values may have units: 'gap=1 mm,2 mm'",
    )
    add(
        "--scatter", default="", metavar="KEY", help="each point as a dot over this key that is swept, coloured by word"
    )
    add("--size", type=size, metavar="WxH", help="of the picture in inches, or with cm at the end")
    add(
        "--xlim",
        type=limits,
        metavar="A,B",
        help="limits of the abscissa of every panel, e.g. 0.9,1.1 or '10 Hz,40 Hz'",
    )
    add("--ylim", type=limits, metavar="A,B", help="limits of the ordinate of every panel")
    add("--log", choices=("x", "y", "xy"), default="", metavar="x|y|xy", help="logarithmic scales")
    add("--backbone", action="store_true", help="behind branches along nu, the speed of conservative motion")
    add("--title", metavar="TEXT", help="in place of the configuration's")
    return parser


def command_line():
    """The options and files. A mistake is a ClatterError of one line that names it."""
    parser = options_parser()
    parser.hint = SEE_HELP
    words, files = parted(sys.argv[1:])
    for word in words:
        if word.startswith("-") and word.endswith(".h5") and os.path.exists(word):
            parser.error(f"'{word}' begins like an option; write -- before it, or ./{word}")
    options = parser.parse_intermixed_args(joined(words))
    end_formats(parser, options)
    check_folder(parser, options.output)
    options.files += files
    if not options.files:
        parser.error("no FILE.h5")
    return options


def check_folder(parser, name):
    """Refuses the name of a picture where that of a folder is meant."""
    folder, ending = os.path.split(name or "")[0] or ".", os.path.splitext(name or "")[1].lower()
    if ending in (".svg", ".png", ".pdf", ".jpg", ".jpeg", ".eps", ".gif") and not os.path.isdir(name):
        parser.error(
            f"argument -o: '{name}' is the name of a picture, and pictures are named by their files; name a folder: "
            f"-o {folder} --format {ending[1:] if ending in ('.svg', '.png', '.pdf') else 'svg'}"
        )


def choices(files, words=()):
    """The options that these words choose, for files of any names."""
    options = options_parser().parse_args(words)
    options.files = list(files)
    return options


def parted(words):
    """The arguments before "--", and the files after it: argparse takes those that begin with a minus for options."""
    place = words.index("--") if "--" in words else len(words)
    return words[:place], words[place + 1 :]


def joined(arguments):
    """The arguments, with limits that begin with a minus sign joined to their option: argparse takes them for one."""
    words = []
    for word in arguments:
        if words and words[-1] in ("--xlim", "--ylim") and re.match(r"-[\d.]", word):
            words[-1] += f"={word}"
        else:
            words.append(word)
    return words


def names(text):
    parts = tuple(part.strip() for part in text.split(","))
    if not all(parts):
        raise argparse.ArgumentTypeError(f"'{text}' has an empty name; write e.g. x_max,section")
    return parts


def places(text):
    """(axis, value) for each value of AXIS=VALUE,..."""
    axis, _, values = text.partition("=")
    return [(axis.strip(), finite(value, text, "AXIS=VALUE, e.g. nu=1")) for value in values.split(",")]


def size(text):
    found = re.fullmatch(r"([\d.]+)x([\d.]+)(cm)?", text)
    sides = [finite(side, text, "WxH in inches, e.g. 7x5, or 18x12cm") for side in found.groups()[:2]] if found else []
    unit = 2.54 if found and found.group(3) else 1.0
    if not sides or not all(1.0 <= side / unit <= 100.0 for side in sides):
        raise argparse.ArgumentTypeError(f"'{text}' is no size; write WxH in inches, 1 to 100, e.g. 7x5, or 18x12cm")
    return tuple(side / unit for side in sides)


def end_formats(parser, options):
    """Takes what follows the formats for files, if it looks like one: argparse takes all of it for formats."""
    words = options.format
    options.format = list(takewhile(FORMATS.__contains__, words))
    rest = words[len(options.format) :]
    for word in rest:
        if not options.format or not Path(word).suffix and not os.path.exists(word):
            parser.error(f"argument --format: '{word}' is none of {', '.join(FORMATS)}")
    options.files += rest
