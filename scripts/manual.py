#!/usr/bin/python3
"""Writes man pages below FOLDER/man: what --help of clatter-plot and clatter-report says, or of PROGRAM, as roff.

usage: scripts/manual.py FOLDER [PROGRAM]
"""

import re
import subprocess
import sys
import textwrap
from pathlib import Path

import clatter.plots.options
import clatter.reports.cli

CITATION = Path(__file__).resolve().parent.parent / "CITATION.cff"
OPTIONS = {"clatter-plot": clatter.plots.options, "clatter-report": clatter.reports.cli}
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


def page(name, sections):
    citation = CITATION.read_text(encoding="utf-8")
    version, date = (re.search(rf'^{key}: "(.+)"', citation, re.MULTILINE)[1] for key in ("version", "date-released"))
    title = f'.TH {roff(name.upper())} 1 {date} "clatter {version}" "clatter"\n'
    return title + "".join(f".SH {heading}\n{text}" for heading, text in sections.items())


def page_of_script(name):
    module = OPTIONS[name]
    parser = module.options_parser()
    more, codes = " ".join(module.EPILOG.split()).split(" Exit codes: ")
    sections = {
        "NAME": rf"{roff(name)} \- {prose(module.SUMMARY)}" + "\n",
        "SYNOPSIS": synopsis(parser, name),
        "DESCRIPTION": f"{prose(module.DESCRIPTION)}\n.PP\n{prose(more)}\n",
        "OPTIONS": "".join(map(item, parser._actions)),  # argparse has no public list of them
        "EXIT STATUS": exit_status(codes),
        "EXAMPLES": f".nf\n{roff(EXAMPLES[name])}\n.fi\n",
        "SEE ALSO": "\\fBclatter\\fR(1),\n\\fBclatter\\-config\\fR(5)\n",
    }
    return page(name, sections)


def option(term):
    """An option as --help writes it, "-h, --help" or "--threads N"."""
    names, value = re.fullmatch(r"(-\S+(?:, -\S+)*)(?: (\S+))?", term).groups()
    names = ", ".join(rf"\fB{roff(name)}\fR" for name in names.split(", "))
    return f"{names} \\fI{roff(value)}\\fR" if value else names


def items(lines, shown):
    """Of lines "  TERM  EXPLANATION" an item each."""
    pairs = (re.split("  +", line.strip(), maxsplit=1) for line in lines)
    return "".join(f".TP\n{shown(term)}\n{prose(explanation)}\n" for term, explanation in pairs)


def page_of_program(program):
    """The page of a program whose --help has a usage, a summary, a description, and sections as clatter's has."""
    told = subprocess.run([program, "--help"], capture_output=True, check=True, text=True, encoding="utf-8").stdout
    usage, summary, description, *blocks = told.rstrip("\n").split("\n\n")
    lines = {title: body.split("\n") for title, body in (block.split("\n", 1) for block in blocks)}
    name, operands = usage.split(" ", 1)
    examples = "".join(f"{roff(line.strip())}\n" for line in lines["Examples"])
    sections = {
        "NAME": rf"{roff(name)} \- {prose(summary)}" + "\n",
        "SYNOPSIS": rf"\fB{roff(name)}\fR {prose(operands)}" + "\n",
        "DESCRIPTION": f"{prose(description)}\n",
        "OPTIONS": items(lines["Options"], option),
        "EXIT STATUS": items(lines["Exit codes"], lambda code: rf"\fB{code}\fR"),
        "EXAMPLES": f".nf\n{examples}.fi\n",
        "SEE ALSO": "\\fBclatter\\fR(1),\n\\fBclatter\\-certify\\fR(1)\n",
    }
    return name, page(name, sections)


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[1].startswith("-"):
        wanted = sys.argv[1:] in (["-h"], ["--help"])
        print(__doc__, file=sys.stdout if wanted else sys.stderr)
        return 0 if wanted else 2
    folder = Path(sys.argv[1], "man", "man1")
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (
        map(page_of_program, sys.argv[2:]) if sys.argv[2:] else zip(OPTIONS, map(page_of_script, OPTIONS))
    ):
        (folder / f"{name}.1").write_text(text, encoding="ascii")
    return 0


if __name__ == "__main__":
    sys.exit(main())
