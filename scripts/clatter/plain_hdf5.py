"""Opens an output of clatter, whoever made the file: nothing in it leads out of it."""

import math
import os
import stat

import h5py
import numpy as np
from h5py import h5d, h5ds, h5l, h5o, h5t, h5z

from ._program import BAD_FILE, ClatterError
from .hdf5_heaps import damaged_heap, longest_text

WANTED = "give a file that 'clatter run', 'clatter accuracy' or 'clatter branch' wrote"
ANEW = "run its configuration again, or get the file anew"
UNREADABLE = (AttributeError, LookupError, MemoryError, OSError, RuntimeError, TypeError, ValueError)  # if damaged
TEXTS = (  # variables of texts; all others are numbers
    *("impact_word", "regime", "motion_word", "motion_regime"),
    *("word", "special_kind", "special_word", "special_regime"),
)
LONGEST_TEXT = 255  # bytes, of a value
READ_AT_ONCE = 2**26  # bytes of texts
MOST_DEFLATED = 1032  # bytes that one byte gives when it is inflated (zlib's technical details)
FILTERS = {h5z.FILTER_SHUFFLE, h5z.FILTER_DEFLATE}


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


class Output(h5py.File):
    """Looks at each variable that is asked for, too: the indexes of a damaged file needn't agree on what there is."""

    def __getitem__(self, name):
        if name != "/":  # the file itself, which has attributes
            require_variable(self.filename, self, name)
        return super().__getitem__(name)


def open_output(path):
    """Opens an output that holds all its values itself, as clatter writes them, or says why it isn't one."""
    require_regular(path)
    try:
        file = Output(path, "r")
        heap = damaged_heap(path)
    except PermissionError:
        raise FileProblem(f"{path}: not readable; check its permissions") from None
    except OSError:
        raise FileProblem(f"{path}: not an HDF5 file; {WANTED}") from None
    try:
        if heap is not None:
            raise damaged(path, f"a heap of texts at byte {heap}")
        require_schema(path, file)
        require_plain(path, file)
    except UNREADABLE as error:
        file.close()
        raise damaged(path, error) from None
    except FileProblem:
        file.close()
        raise
    return file


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


def require_plain(path, file):
    """Refuses what would be read from elsewhere, and whatever else clatter doesn't write."""
    names = list(file)  # of links, none of which is followed
    for name in names:
        require_variable(path, file, name)
    if not {"status", "arclength"} & set(names) or "config" not in file.attrs:
        raise FileProblem(f"{path}: not a clatter/1 file (it lacks its status or configuration); {WANTED}")


def require_variable(path, file, name):
    unlike = unlike_clatter(path, file.id, name) if name.isidentifier() else "is no name of a variable"
    if unlike:
        raise FileProblem(f"{path}: {name!r} {unlike}, which clatter doesn't write; {ANEW}")


def unlike_clatter(path, root, name):
    """How an object at the root differs from all that clatter writes, or None; checks a link before it follows it."""
    if root.links.get_info(name.encode()).type != h5l.TYPE_HARD:
        return "is a link to another place"
    if h5o.get_info(root, name.encode()).type != h5o.TYPE_DATASET:
        return "is no dataset"
    dataset = h5d.open(root, name.encode())  # opens no other file yet
    properties = dataset.get_create_plist()
    if properties.get_layout() == h5d.VIRTUAL or properties.get_external_count() > 0:
        return "has its values in other files"
    if properties.get_layout() not in (h5d.CONTIGUOUS, h5d.CHUNKED):
        return "is stored in an unknown layout"
    filters = [properties.get_filter(place)[0] for place in range(properties.get_nfilters())]
    if not FILTERS.issuperset(filters) or len(set(filters)) < len(filters):
        return "has other filters than shuffle and deflate, each once"
    if name in TEXTS and not is_text(dataset):
        return "holds no texts of variable length"
    if name not in TEXTS and dataset.get_type().get_class() not in (h5t.INTEGER, h5t.FLOAT):
        return "holds something else than numbers"
    if dataset.get_space().get_simple_extent_npoints() > MOST_DEFLATED * stored_bytes(path):
        return "has more values than the file can hold"
    return None


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
    if not is_text(dataset.id):
        return np.asarray(dataset[()])
    at_once = max(1, READ_AT_ONCE // max(1, longest_text(dataset.file.filename)))
    return np.asarray(texts_in(dataset, (), at_once), str).reshape(dataset.shape)


def texts_in(dataset, place, at_once):
    """The texts at a place, few at a time: all of them may refer to the longest one in the file."""
    rest = dataset.shape[len(place) :]
    each = math.prod(rest[1:])
    if each > at_once:
        return [text for i in range(rest[0]) for text in texts_in(dataset, (*place, i), at_once)]
    rows = at_once // max(each, 1)
    parts = [(*place, slice(first, first + rows)) for first in range(0, rest[0], rows)] if rest else [place]
    texts = []
    for part in parts:
        more = np.ravel(dataset.asstr()[part]).tolist()
        if any(len(text) > LONGEST_TEXT for text in more):
            text = f"{dataset.name} holds a text of more than {LONGEST_TEXT} characters"
            raise damaged(dataset.file.filename, text)
        texts += more
    return texts


def stored_bytes(path):
    """The room that a file takes on its disk; its length, if the file system doesn't tell."""
    status = os.stat(path)
    return 512 * status.st_blocks or status.st_size


def text(value):
    """A text attribute; nccopy makes an array of one out of it."""
    value = value.item() if isinstance(value, np.ndarray) and value.size == 1 else value
    return value.decode() if isinstance(value, bytes) else str(value)
