"""Shared by the scripts that make tables of guides: a table stands in a README.md, between two markers."""

import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
BUILD = SOURCE / "build" / "release"


def add_build(parser):
    parser.add_argument("--build", type=pathlib.Path, default=BUILD, help="build folder (default: build/release)")


def program(build, path, reason="scripts/test.sh builds it", built_now=False):
    """A program of a build folder, built now if it belongs to no other build; the script ends if it isn't there."""
    found = build / path
    if built_now:
        subprocess.run(["cmake", "--build", build, "--target", found.name], stdout=subprocess.DEVNULL)
    if not found.exists():
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {found} is missing; {reason}")
    return found


def section(text, name):
    """Where in a guide's text the section between its markers begins and ends."""
    begin, end = f"<!-- begin: {name} -->\n", "<!-- end -->"
    start = text.find(begin)
    if start < 0:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: its README.md has no section '{name}'")
    start += len(begin)
    return start, text.index(end, start)


def replaced(text, name, table):
    start, stop = section(text, name)
    return text[:start] + table + "\n" + text[stop:]
