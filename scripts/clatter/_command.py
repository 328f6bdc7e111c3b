"""How clatter-plot and clatter-report run, and what they leave behind: whole files or none, lines on standard output,
and nothing that a signal cut short."""

import argparse
import logging
import os
import secrets
import shutil
import signal
import subprocess
import sys
import tempfile
import warnings
from contextlib import contextmanager, suppress
from pathlib import Path

from ._program import BAD_FILE, WRONG_USE, ClatterError

SEE_HELP = "; see --help"
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
unfinished = set()  # files and folders that a signal removes
children = set()  # processes that it ends before, since they may write into these folders


class Parser(argparse.ArgumentParser):
    """Throws a mistake in place of ending the program."""

    hint = ""  # behind its message

    def error(self, message):
        raise ClatterError(message + self.hint, WRONG_USE)


def begin():
    """Lets Ctrl-C end the command without a traceback, and names of any bytes be printed as they are."""
    for number in SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:  # as nohup sets it
            signal.signal(number, end)
    for stream in filter(None, (sys.stdout, sys.stderr)):
        stream.reconfigure(errors="surrogateescape")
    if sys.stdout is not None:
        sys.stdout.reconfigure(line_buffering=False, write_through=False)  # so that only a flush can fail


def end(number, _):
    """Removes what isn't finished and ends by the signal: an exception might be caught on its way."""
    for child in list(children):
        child.kill()
        child.wait()
    for path in list(unfinished):
        with suppress(OSError):
            remove(path)
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)


def remove(path):
    """Removes a file or a folder that may be gone already."""
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)
    unfinished.discard(path)


def run(name, work):
    """The exit code of a command that does this, once all that it printed is written."""
    begin()  # before what takes long to import
    if not sys.warnoptions:  # warnings of numpy and matplotlib are for those who work on this program
        warnings.simplefilter("ignore")
        logging.getLogger("matplotlib").setLevel(logging.ERROR)
    code = 0
    try:
        work()
    except SystemExit as end_of_it:  # after --help, for one
        code = end_of_it.code
    except ClatterError as problem:
        print(f"{name}: {problem}", file=sys.stderr)
        code = problem.exit_code
    except ImportError as error:
        print(f"{name}: {error}", file=sys.stderr)
        code = 1
    with printing(name):
        return code


def tell(name, words):
    """Prints a line at once."""
    with printing(name):
        print(words)


@contextmanager
def printing(name):
    """Writes what is printed. If nobody reads it any more, that is no mistake; a full disk is one."""
    try:
        yield
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for what is still to be flushed
        if not isinstance(error, BrokenPipeError):
            print(f"{name}: standard output cannot be written; is its disk full?", file=sys.stderr)
            raise SystemExit(BAD_FILE) from None


def write_whole(path, content):
    """Writes all bytes of a file, or none: until the last is on the disk, what had the name stays as it was."""
    place = Path(os.path.realpath(path))  # a link stays one
    if place.exists() and not place.is_file():  # a device or a pipe
        place.write_bytes(content)
        return
    part = place.with_name(f".clatter-{secrets.token_hex(8)}")
    unfinished.add(part)
    try:
        with open(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666), "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        if place.exists():
            shutil.copymode(place, part)
        os.replace(part, place)
    finally:
        remove(part)


@contextmanager
def temporary_folder(prefix):
    """A folder that is gone afterwards, whatever ends the program."""
    folder = Path(tempfile.gettempdir()) / f"{prefix}{secrets.token_hex(8)}"
    unfinished.add(folder)
    try:
        folder.mkdir(mode=0o700)
        yield folder
    finally:
        remove(folder)


def run_child(words, timeout, **options):
    """subprocess.run with the outputs as text, of a program that ends with this one."""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(words, **pipes, **options) as child:
        children.add(child)
        try:
            out, err = child.communicate(timeout=timeout)
        except BaseException:
            child.kill()
            raise
        finally:
            children.discard(child)
    return subprocess.CompletedProcess(words, child.returncode, out, err)
