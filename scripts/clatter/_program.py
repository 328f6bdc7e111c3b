"""The program as functions."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import warnings
from pathlib import Path

from ._config import set_words, toml_of

# Exit codes: points failed, or a branch stopped early, and the file is there; a mistake; a file can't be read or
# written.
SOME_FAILED, WRONG_USE, BAD_FILE = 1, 2, 74


class ClatterError(Exception):
    """The program, or what draws, refused or failed; the text is its message.

    exit_code: that of the program, e.g. 2 for a mistake, 74 for a file that can't be read or written; else None.
    """

    def __init__(self, message, exit_code):
        super().__init__(message)
        self.exit_code = exit_code


class ConfigError(ClatterError):
    """A mistake in a configuration.

    file, line, column: its place, if it is in a file; else None.
    key: the key or section if it is in a dictionary, e.g. "scene.nu"; else None.
    """

    def __init__(self, message, exit_code, file=None, line=None, column=None, key=None):
        super().__init__(message, exit_code)
        self.file, self.line, self.column, self.key = file, line, column, key


class ClatterWarning(UserWarning):
    """The program warned of a configuration, or some points failed."""


def run(config, *, output=None, threads=None, **sections):
    """Results of `clatter run` as an xarray.Dataset: variables over the axes of the sweep.

    config: path of a configuration, or a dictionary of its sections.
    output: file to keep; by default the results are only in memory.
    threads: by default all cores.
    sections: changes, e.g. scene={"R": 0.5}, sweep={"nu": numpy.linspace(0.5, 1.5, 101)}.

    Raises ConfigError for mistakes in the configuration, ClatterError for all else. Points that failed are a
    ClatterWarning: their values are NaN, and `status` says why.
    """
    words = ["--progress", "never"] + (["--threads", str(threads)] if threads is not None else [])
    return _dataset("run", words, config, output, sections)


def branch(config, *, output=None, **sections):
    """Branches of periodic motion, or curves of their special points, as `clatter branch` writes them, in an
    xarray.Dataset over `point` and `special`. Arguments and errors are those of `run`."""
    return _dataset("branch", ["--quiet"], config, output, sections)


def plan(config, **sections):
    """The effects that a run simulates and why, its work and memory: the object of `clatter plan --json`, a dictionary.
    Arguments and errors are those of `run`."""
    with _Workplace(config) as place:
        return json.loads(place.call("plan", ["--json", *set_words(sections)]).stdout)


def _dataset(command, words, config, output, sections):
    if output is not None and not isinstance(output, (str, os.PathLike)):
        raise TypeError(
            f"output = {output!r}: expected the path of a file to keep, or None; keys of the section [output] belong "
            "in the configuration"
        )
    import xarray  # here, since it takes long, and pictures need none

    with _Workplace(config) as place:
        file = Path(output) if output is not None else place.folder / "out.h5"
        place.call(command, [*words, "-o", str(file), *set_words(sections)], file)
        return xarray.load_dataset(file)


class _Workplace:
    """A folder for the files of one call of the program."""

    def __init__(self, config):
        self.keep = tempfile.TemporaryDirectory(prefix="clatter-")
        self.folder = Path(self.keep.name)
        self.keys = []
        self.is_dictionary = isinstance(config, dict)
        if self.is_dictionary:
            self.config = self.folder / "configuration.toml"
            text, self.keys = toml_of(config)
            self.config.write_text(text, encoding="utf-8")
        elif isinstance(config, (str, os.PathLike)):
            self.config = Path(config)
        else:
            raise TypeError(f"{config!r}: expected the path of a configuration, or a dictionary of its sections")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.keep.cleanup()

    def call(self, command, words, file=None):
        """Runs the program; with exit code 1 its file is there, and that is a warning."""
        result = subprocess.run(
            [_program(), command, str(self.config), *words], capture_output=True, text=True, stdin=subprocess.DEVNULL
        )
        message = self.without_place(result.stderr.strip().removeprefix("clatter: "))
        some_failed = result.returncode == SOME_FAILED and file is not None and file.exists()
        if result.returncode != 0 and not some_failed:
            raise self.error(result.stderr, message or f"clatter ends by {result.returncode}", result.returncode)
        told = [line for line in message.splitlines() if some_failed or "warning: " in line]
        if told:
            warnings.warn("\n".join(told), ClatterWarning, stacklevel=4)
        return result

    def without_place(self, text):
        """Messages name the key of a dictionary, whose file is gone by the time that they are read."""
        if not self.is_dictionary:
            return text

        def key_of(match):
            return f"{self.keys[int(match[1]) - 1]}: " if int(match[1]) <= len(self.keys) else ""

        return re.sub(re.escape(str(self.config)) + r":(\d+):\d+: ", key_of, text).replace(f"{self.config}: ", "")

    def error(self, raw, message, exit_code):
        if exit_code != WRONG_USE:
            return ClatterError(message, exit_code)
        change = re.match(r"--set ([\w.]+)=", raw)
        if change:
            return ConfigError(message, exit_code, key=change[1])
        place = re.match(r"(.*?):(\d+):(\d+): ", raw)
        if place is None:
            return ConfigError(message, exit_code)
        line, column = int(place[2]), int(place[3])
        if self.is_dictionary:
            return ConfigError(message, exit_code, key=self.keys[line - 1] if line <= len(self.keys) else None)
        return ConfigError(message, exit_code, file=place[1], line=line, column=column)


def program():
    """The program: that of CLATTER, else that beside this package, installed or built, else that on PATH, or None."""
    scripts = Path(__file__).resolve().parents[1]
    beside = scripts.parent / "build" / "release" / "apps" / "clatter" / "clatter"
    if scripts.parent.name == "clatter" and len(scripts.parents) > 2:  # PREFIX/share/clatter/scripts
        installed = scripts.parents[2] / "bin" / "clatter"
        beside = installed if os.access(installed, os.X_OK) else beside
    own = str(beside) if os.access(beside, os.X_OK) else None
    return os.environ.get("CLATTER") or own or shutil.which("clatter")


def _program():
    found = program()
    if found is None:
        raise ClatterError("no program clatter on PATH; install it, or name it in the variable CLATTER", None)
    return found
