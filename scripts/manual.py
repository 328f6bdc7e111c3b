#!/usr/bin/python3
"""Writes the man pages of clatter-plot and clatter-report below FOLDER/man: what their --help says, as roff.

usage: scripts/manual.py FOLDER
"""

import re
import sys
import textwrap
from pathlib import Path

import plot_options
import report_options

CITATION = Path(__file__).resolve().parent.parent / "CITATION.cff"
OPTIONS = {"clatter-plot": plot_options, "clatter-report": report_options}
EXAMPLES = {
    "clatter-plot": "clatter run fig22.toml\nclatter-plot fig22.h5\nclatter-plot map.h5 --along nu --at xs=4",
    "clatter-report": "clatter run map.toml\nclatter-report map.h5 -o map.html",
}
ESCAPES = {"\\": r"\e", "-": r"\-", "'": r"\(aq", "`": r"\(ga", "^": r"\(ha", "~": r"\(ti"}


def roff(text):
    """Text with dashes that can be copied, quotes as they are typed, and names for letters beyond ASCII."""
    return "".join(ESCAPES.get(c, c if c.isascii() else rf"\[u{ord(c):04X}]") for c in text)


def prose(text):
    """Text in lines of at most 80 columns."""
    lines = textwrap.wrap(roff(" ".join(text.split())), 80, break_long_words=False, break_on_hyphens=False)
    return "\n".join(re.sub(r"^\.", r"\&.", line) for line in lines)


def item(action):
    """An option or operand, and its explanation below."""
    names = ", ".join(rf"\fB{roff(name)}\fR" for name in action.option_strings)
    value = rf"\fI{roff(action.metavar)}\fR" if action.metavar else ""
    return f".TP\n{' '.join(filter(None, (names, value)))}\n{prose(action.help)}\n"


def synopsis(parser, name):
    parser.prog = name
    usage = parser.format_usage().removeprefix("usage: ").split(maxsplit=1)[1]
    return rf"\fB{roff(name)}\fR {prose(usage)}" + "\n"


def exit_status(sentence):
    """Of "Exit codes: 0 done, 2 wrong command line, ..." an item a code."""
    codes = re.findall(r"(\d+) (.+?)(?:, (?=\d)|\.$)", sentence)
    return "".join(f".TP\n\\fB{code}\\fR\n{prose(meaning)}\n" for code, meaning in codes)


def page(name):
    module = OPTIONS[name]
    parser = module.options_parser()
    more, codes = " ".join(module.EPILOG.split()).split(" Exit codes: ")
    citation = CITATION.read_text(encoding="utf-8")
    version, date = (re.search(rf'^{key}: "(.+)"', citation, re.MULTILINE)[1] for key in ("version", "date-released"))
    body = {
        "NAME": rf"{roff(name)} \- {prose(module.SUMMARY)}" + "\n",
        "SYNOPSIS": synopsis(parser, name),
        "DESCRIPTION": f"{prose(module.DESCRIPTION)}\n.PP\n{prose(more)}\n",
        "OPTIONS": "".join(map(item, parser._actions)),  # argparse has no public list of them
        "EXIT STATUS": exit_status(codes),
        "EXAMPLES": f".nf\n{roff(EXAMPLES[name])}\n.fi\n",
        "SEE ALSO": "\\fBclatter\\fR(1),\n\\fBclatter\\-config\\fR(5)\n",
    }
    title = f'.TH {roff(name.upper())} 1 {date} "clatter {version}" "clatter"\n'
    return title + "".join(f".SH {heading}\n{text}" for heading, text in body.items())


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        wanted = sys.argv[1:] in (["-h"], ["--help"])
        print(__doc__, file=sys.stdout if wanted else sys.stderr)
        return 0 if wanted else 2
    folder = Path(sys.argv[1], "man", "man1")
    folder.mkdir(parents=True, exist_ok=True)
    for name in OPTIONS:
        (folder / f"{name}.1").write_text(page(name), encoding="ascii")
    return 0


if __name__ == "__main__":
    sys.exit(main())
