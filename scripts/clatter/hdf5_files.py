"""Opens an output of clatter, whoever made the file: another process has read all of it before."""

import os
import resource
import stat
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
from h5py import h5d, h5ds, h5t, h5z

from ._command import run_child
from ._program import BAD_FILE, ClatterError, program

WANTED = "give a file that 'clatter run', 'clatter accuracy' or 'clatter branch' wrote"
ANEW = "run its configuration again, or get the file anew"
UNREADABLE = (AttributeError, LookupError, MemoryError, OSError, RuntimeError, TypeError, ValueError)  # if damaged
TEXTS = ("word", "regime", "kind")  # ends of the names of variables of texts
MOST_DEFLATED = 1032  # bytes that one byte gives when it is inflated (zlib's technical details)
FILTERS = {h5z.FILTER_SHUFFLE, h5z.FILTER_DEFLATE}
sound = set()  # files that have been read, by name and state
# Without the program: what reads a file in a process of its own.
TRIAL = "import sys; sys.path[0] = sys.argv[1]; from clatter import hdf5_files; hdf5_files.try_all(sys.argv[2])"


class FileProblem(ClatterError):
    """A file that cannot be used; the message is one line that names it and how to fix it."""

    def __init__(self, message):
        super().__init__(message, BAD_FILE)


def printable(value):
    """A text of a file in one line that moves no cursor."""
    return repr(text(value))[1:-1]


def damaged(path, error):
    """The error for damage that a library found: its words may quote the file."""
    return FileProblem(f"{path}: damaged ({printable(error)}); {ANEW}")


def open_output(path):
    """Opens an output of clatter, or says why it isn't one."""
    require_regular(path)
    require_sound(path)
    try:
        file = h5py.File(path, "r")
    except UNREADABLE as error:
        raise damaged(path, error) from None
    try:
        require_schema(path, file)
    except UNREADABLE as error:
        file.close()
        raise damaged(path, error) from None
    except FileProblem:
        file.close()
        raise
    return file


def require_sound(path):
    """Lets another process read all of a file, since HDF5 crashes on damaged ones, and may lead to others."""
    state = os.stat(path)
    key = (os.fspath(path), state.st_dev, state.st_ino, state.st_size, state.st_mtime_ns)
    if key in sound:
        return
    wait = 120 + state.st_size // 10**6  # seconds
    try:
        told = read_by_program(path, wait) or read_by_python(path, wait)
    except subprocess.TimeoutExpired:
        raise damaged(path, f"reading it takes more than {wait} s") from None
    if told.returncode != 0:
        lines = told.stderr.strip().splitlines()
        if told.returncode != BAD_FILE or not lines:
            raise damaged(path, lines[-1] if lines and told.returncode > 0 else "HDF5 crashes on it")
        raise FileProblem(lines[-1].removeprefix("clatter: ").replace(f"'{path}'", str(path), 1))
    sound.add(key)


def read_by_program(path, wait):
    """The program's check of a file; None if there is no program, or none that runs and has this check."""
    found = program()
    try:
        told = run_child([found, "info", "--check", "--", path], wait, errors="replace") if found else None
    except OSError:
        return None
    is_answer = told and (told.returncode == 0 or told.returncode == BAD_FILE and told.stderr.startswith("clatter: "))
    return told if is_answer else None


def read_by_python(path, wait):
    """The same by h5py, in a process of its own."""
    words = [sys.executable, "-c", TRIAL, str(Path(__file__).parents[1]), os.fspath(path)]
    return run_child(words, wait, errors="replace", env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})


def try_all(path):
    """Reads all of a file, and ends this process by what becomes of that."""
    limit_process(os.stat(path).st_size)
    try:
        with h5py.File(path, "r") as file:
            dict(file.attrs)
            for name in file:
                require_own(path, file, name)
                values_of(file[name]), dimensions_of(file[name]), dict(file[name].attrs)
    except FileProblem as problem:
        end_trial(problem)
    except OSError as error:
        end_trial(damaged(path, error) if h5py.is_hdf5(path) else f"{path}: not an HDF5 file; {WANTED}")
    except UNREADABLE as error:
        end_trial(damaged(path, error))


def limit_process(size):
    """So much time and memory, beyond what the process has, as reading a file of this size can take."""
    present = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
    for limit, most in (
        (resource.RLIMIT_CPU, 60 + size // 10**7),
        (resource.RLIMIT_AS, present + 2**30 + 8 * size),
    ):
        hard = resource.getrlimit(limit)[1]
        resource.setrlimit(limit, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))


def end_trial(words):
    print(words, file=sys.stderr)
    sys.exit(BAD_FILE)


def require_own(path, file, name):
    """Refuses what clatter doesn't write: links, values elsewhere, foreign filters and types, impossible lengths."""
    is_own = name.isidentifier() and isinstance(file.get(name, getlink=True), h5py.HardLink)
    if not is_own or file.get(name, getclass=True) is not h5py.Dataset or not is_plain(path, file, name):
        raise FileProblem(f"{path}: {name!r} is no variable as clatter writes it; {ANEW}")


def is_plain(path, file, name):
    dataset = h5d.open(file.id, name.encode())  # opens no other file yet
    made, kind = dataset.get_create_plist(), dataset.get_type().get_class()
    if made.get_layout() not in (h5d.CONTIGUOUS, h5d.CHUNKED) or made.get_external_count() > 0:
        return False
    filters = [made.get_filter(place)[0] for place in range(made.get_nfilters())]
    if not FILTERS.issuperset(filters) or len(set(filters)) < len(filters):
        return False
    is_right_kind = is_text(dataset) if name.endswith(TEXTS) else kind in (h5t.INTEGER, h5t.FLOAT)
    state = os.stat(path)
    stored = 512 * state.st_blocks or state.st_size
    return is_right_kind and dataset.get_space().get_simple_extent_npoints() <= MOST_DEFLATED * stored


def require_regular(path):
    """Looks at the file without opening it: a pipe would wait for a writer."""
    if not path:
        raise FileProblem(f"'': an empty name; {WANTED}")
    try:
        mode = os.stat(path).st_mode
    except OSError as error:
        if isinstance(error, FileNotFoundError):
            raise FileProblem(f"{path}: no such file; make it with 'clatter run CONFIG -o {path}'") from None
        raise FileProblem(f"{path}: not readable ({error.strerror}); check its name and permissions") from None
    if stat.S_ISDIR(mode):
        raise FileProblem(f"{path}: a folder, not a file; name the .h5 files in it")
    if not stat.S_ISREG(mode):
        raise FileProblem(f"{path}: not a regular file; {WANTED}")


def require_schema(path, file):
    schema = text(file.attrs.get("clatter_schema", ""))
    if schema != "clatter/1":
        found = f"its schema is '{printable(schema)}'" if schema else "it has no attribute clatter_schema"
        raise FileProblem(f"{path}: not a clatter/1 file ({found}); {WANTED}")
    if not {"status", "arclength"} & set(file) or "config" not in file.attrs:
        raise FileProblem(f"{path}: not a clatter/1 file (it lacks its status or configuration); {WANTED}")


def is_text(dataset):
    """Whether a low-level dataset holds texts of variable length."""
    kind = dataset.get_type()
    return kind.get_class() == h5t.STRING and kind.is_variable_str()


def dimensions_of(dataset):
    """The names of a variable's dimensions, slowest first; of an axis its own."""
    if h5ds.is_scale(dataset.id):
        return (dataset.name.lstrip("/"),)
    return tuple(dim[0].name.lstrip("/") if len(dim) else f"dim{place}" for place, dim in enumerate(dataset.dims))


def values_of(dataset):
    """All values of a variable: an array of numbers, or of strings."""
    return np.asarray(dataset.asstr()[()], str) if is_text(dataset.id) else np.asarray(dataset[()])


def text(value):
    """A text attribute; nccopy makes an array of one out of it."""
    value = value.item() if isinstance(value, np.ndarray) and value.size == 1 else value
    return value.decode() if isinstance(value, bytes) else str(value)
