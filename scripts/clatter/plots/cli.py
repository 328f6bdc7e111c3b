"""The command clatter-plot: draws outputs of clatter into files; --help says more."""

import sys
from pathlib import Path

from .._command import run, tell, write_whole
from .._pictures import needing
from .._program import BAD_FILE, ClatterError
from .options import command_line


def main():
    """The exit code."""
    name = Path(sys.argv[0]).name
    return run(name, lambda: draw(name))


def draw(name):
    """Writes each picture in each format, and tells their names."""
    options = command_line()
    with needing("plot"):
        from . import pictures, style
    style.use_style(options.size)
    places = iter(options.files)
    for stem, figure in pictures.pictures(options):
        if options.output:
            make_folder(options.output)  # once there is a picture: one that is refused leaves no folder
        folder = Path(options.output) if options.output else Path(next(places)).parent
        for kind in dict.fromkeys(options.format):
            path = folder / f"{stem}.{kind}"
            write(path, pictures.in_format(figure, kind))
            tell(name, path)


def write(path, content):
    try:
        write_whole(path, content)
    except OSError as error:
        message = f"{path}: cannot be written ({error.strerror}); name another folder with -o"
        raise ClatterError(message, BAD_FILE) from None


def make_folder(folder):
    try:
        Path(folder).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        message = f"{folder}: no folder can be made here ({error.strerror}); name another with -o"
        raise ClatterError(message, BAD_FILE) from None
