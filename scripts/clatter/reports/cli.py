"""The command clatter-report: makes one page of outputs of clatter; --help says more."""

from pathlib import Path

from .._command import SEE_HELP, Parser, run, tell
from .._pictures import needing

NAME = "clatter-report"
DESCRIPTION = """Makes one self-contained page of outputs of clatter: how they were made, pictures, tables; a click or
the arrow keys on a picture show a point's numbers, its motion, and the command that runs it alone. The page needs no
network."""
EPILOG = """The motion of up to 200 points of each sweep is computed for the page by the program clatter: the one that
the variable CLATTER names, else that beside this command, else that on PATH. Exit codes: 0 done, 2 wrong command line,
74 a file cannot be read or written."""
SUMMARY = "make one page of outputs of clatter"


def options_parser():
    """All that --help and the man page tell."""
    parser = Parser(prog=NAME, description=DESCRIPTION, epilog=EPILOG, allow_abbrev=False)
    add = parser.add_argument
    add("files", nargs="+", metavar="FILE.h5", help="output of 'clatter run', 'clatter accuracy' or 'clatter branch'")
    add("-o", "--output", metavar="FILE.html", default="report.html", help="the page; default: report.html")
    add("--title", metavar="TEXT", help="in place of that of the first file")
    add("--no-histories", action="store_true", help="compute no motion for the page")
    return parser


def main():
    """The exit code."""
    return run(NAME, make)


def make():
    """Writes the page, and tells its name."""
    parser = options_parser()
    parser.hint = SEE_HELP
    options = parser.parse_args()
    with needing("report"):
        from .page import write_page
    tell(NAME, write_page(options.files, Path(options.output), options.title, not options.no_histories))
