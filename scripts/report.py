#!/usr/bin/python3
"""Makes one page of outputs of clatter, which shows every point's numbers; --help says more."""

import logging
import os
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
    from plot_choice import ChoiceProblem
    from plot_data import FileProblem, Output
    from plot_style import use_style
    from report_options import command_line
    from report_page import MARK, page
except ImportError as error:
    sys.exit(f"clatter-report: {error}; install python3-h5py and python3-matplotlib (Debian), or h5py and matplotlib")

BAD_COMMAND, BAD_FILE = 2, 74  # exit codes, clatter's


def check_place(path):
    """An older report may be replaced, any other file not."""
    if not path.parent.is_dir():
        raise FileProblem(f"{path}: there is no folder {path.parent}; make it, or name another file with -o")
    if not os.path.exists(path):
        return
    try:
        with open(path, "rb") as file:
            is_report = path.is_file() and file.read(200).decode(errors="replace").splitlines()[1:2] == [MARK]
    except OSError as error:
        raise FileProblem(f"{path}: cannot be read ({error.strerror}); name another file with -o") from None
    if not is_report:
        raise FileProblem(f"{path}: is no report, so it is kept; name another file with -o, or move that one away")


def write(path, text):
    """The whole page or none."""
    try:
        plot_files.write_whole(path, text.encode(errors="backslashreplace"))
    except OSError as error:
        raise FileProblem(f"{path}: cannot be written ({error.strerror}); name another file with -o") from None


def main():
    options = command_line()
    use_style()
    path = Path(options.output)
    try:
        check_place(path)
        outputs = [Output(name) for name in options.files]
        write(path, page(outputs, options.title, not options.no_histories))
    except ChoiceProblem as problem:
        print(f"clatter-report: {problem}", file=sys.stderr)
        return BAD_COMMAND
    except FileProblem as problem:
        print(f"clatter-report: {problem}", file=sys.stderr)
        return BAD_FILE
    plot_files.tell("clatter-report", path)
    return 0


if __name__ == "__main__":
    sys.exit(plot_files.run("clatter-report", main))
