"""Outputs that were made to harm their reader: changes of a sound one, by which HDF5 would open other files, wait, run
foreign filters or read what isn't there. The folder of a test has `other.h5`, `secret` and `pipe` for them."""

import functools
import os
import shutil
import struct
import subprocess

import h5py
import numpy

SECRET = "a line that is nobody's business\n"
CONTROLS = "\x1b]0;title\x07\x1b[2J\u202e\u009b\nclatter: all is well"


@functools.cache
def can_trace():
    """Whether strace is there and permitted."""
    command = ["strace", "-qq", "-o", "/dev/null", "true"]
    return shutil.which("strace") is not None and subprocess.run(command, capture_output=True).returncode == 0


def require_trace():
    """Fails, and says what to do, where strace can't be used."""
    if not can_trace():
        raise AssertionError(
            "this test needs strace and the permission to trace, which aren't here: apt-get install strace, and in a "
            "container --cap-add SYS_PTRACE"
        )


def make_surroundings(folder):
    """Files that no reader may open, or wait for."""
    (folder / "secret").write_text(SECRET * 9)
    os.mkfifo(folder / "pipe")
    with h5py.File(folder / "other.h5", "w") as file:
        file["x_max"] = numpy.full(5, 12345.678)
        file["status"] = numpy.zeros(5, "u1")


def replaced(make):
    """x_max goes, and `make` puts another of as many points in its place."""

    def change(file, folder):
        points = len(file["x_max"])
        del file["x_max"]
        make(file, folder, points)

    return change


def external(name):
    return replaced(
        lambda file, folder, points: file.create_dataset(
            "x_max", (points,), "f8", external=[(str(folder / name), 0, 8 * points)]
        )
    )


def linked(link):
    return replaced(lambda file, folder, points: file.__setitem__("x_max", link(folder)))


def dataset(**settings):
    return replaced(
        lambda file, folder, points: file.create_dataset("x_max", data=numpy.arange(float(points)), **settings)
    )


def virtual(file, folder, points):
    layout = h5py.VirtualLayout((points,), "f8")
    layout[:] = h5py.VirtualSource(str(folder / "other.h5"), "x_max", (points,))
    file.create_virtual_dataset("x_max", layout)


def growing_virtual(file, folder, points):
    """One whose shape already takes its sources to know."""
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    without_end = h5py.h5s.create_simple((points,), (h5py.h5s.UNLIMITED,))
    without_end.select_hyperslab((0,), (h5py.h5s.UNLIMITED,), (1,), (1,))
    properties.set_virtual(without_end, str(folder / "other.h5").encode(), b"x_max", without_end)
    create(file, "x_max", (points,), properties, shape=h5py.h5s.create_simple((points,), (h5py.h5s.UNLIMITED,)))


def create(file, name, lengths, properties, kind=h5py.h5t.NATIVE_DOUBLE, shape=None):
    h5py.h5d.create(file.id, name.encode(), kind, shape or h5py.h5s.create_simple(lengths), properties)


def impact_words(**settings):
    """impact_word appears, over the points of x_max."""

    def change(file, folder):
        file.create_dataset("impact_word", file["x_max"].shape, **settings)

    return change


def compact(file, folder, points):
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_layout(h5py.h5d.COMPACT)
    create(file, "x_max", (points,), properties)


def deflated_twice(file, folder, points):
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_chunk((points,))
    for _ in range(2):
        properties.set_filter(h5py.h5z.FILTER_DEFLATE, h5py.h5z.FLAG_MANDATORY, (9,))
    create(file, "x_max", (points,), properties)


def status_link(file, folder):
    del file["status"]
    file["status"] = h5py.ExternalLink(str(folder / "other.h5"), "/status")


def link_in_group(file, folder):
    file.create_group("hidden")["status"] = h5py.ExternalLink(str(folder / "other.h5"), "/status")


CHANGES = {
    "external": external("secret"),
    "external_pipe": external("pipe"),
    "virtual": replaced(virtual),
    "growing_virtual": replaced(growing_virtual),
    "external_link": linked(lambda folder: h5py.ExternalLink(str(folder / "other.h5"), "/x_max")),
    "external_link_to_pipe": linked(lambda folder: h5py.ExternalLink(str(folder / "pipe"), "/x_max")),
    "soft_link": linked(lambda folder: h5py.SoftLink("/x_min")),
    "dangling_link": linked(lambda folder: h5py.SoftLink("/none")),
    "status_link": status_link,
    "group": replaced(lambda file, folder, points: file.create_group("x_max")),
    "link_in_group": link_in_group,
    "type": linked(lambda folder: numpy.dtype("f8")),
    "lzf": dataset(compression="lzf"),
    "scaled": dataset(scaleoffset=3),
    "checked": dataset(fletcher32=True),
    "deflated_twice": replaced(deflated_twice),
    "compact": replaced(compact),
    "texts": replaced(lambda file, folder, points: file.create_dataset("x_max", data=["a"] * points)),
    "number_words": impact_words(dtype="f8", fillvalue=1.0),
    "fixed_words": impact_words(dtype="S5", fillvalue=b"LU"),
    "references": replaced(lambda file, folder, points: file.create_dataset("x_max", (points,), h5py.ref_dtype)),
    "name": lambda file, folder: file.__setitem__("a" + CONTROLS, [1.0]),
}


def claim(name, lengths, file, kind=h5py.h5t.NATIVE_UINT8):
    """Gives a variable lengths that the file has no room for: nothing of it is ever written."""
    del file[name]
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_alloc_time(h5py.h5d.ALLOC_TIME_EARLY)
    properties.set_fill_time(h5py.h5d.FILL_TIME_NEVER)
    create(file, name, lengths, properties, kind)


def rotated(value, bits):
    return (value << bits | value >> 32 - bits) & 0xFFFFFFFF


def checksum(data):
    """That of HDF5's metadata: Jenkins's lookup3."""
    a = b = c = 0xDEADBEEF + len(data) & 0xFFFFFFFF
    words = struct.unpack(f"<{(len(data) + 11) // 12 * 3}I", data.ljust((len(data) + 11) // 12 * 12, b"\0"))
    for place in range(0, len(words), 3):
        a, b, c = (a + words[place] & 0xFFFFFFFF, b + words[place + 1] & 0xFFFFFFFF, c + words[place + 2] & 0xFFFFFFFF)
        if place + 3 == len(words):
            break
        for bits in (4, 6, 8, 16, 19, 4):
            a = a - c & 0xFFFFFFFF ^ rotated(c, bits)
            c = c + b & 0xFFFFFFFF
            a, b, c = b, c, a
    for bits in (14, 11, 25, 16, 4, 14, 24):
        c = (c ^ b) - rotated(b, bits) & 0xFFFFFFFF
        a, b, c = b, c, a
    return b


def hide_variables(path):
    """Makes the index of names say that it has no records, which keeps them from whoever counts them."""
    content = bytearray(path.read_bytes())
    begin = content.index(b"BTHD\0\5")  # HDF5 file format, III.A.2: a version 2 B-tree of the names of links
    records, end = begin + 26, begin + 34  # total number of records, checksum
    assert struct.unpack_from("<I", content, end)[0] == checksum(bytes(content[begin:end]))
    content[records:end] = bytes(8)
    struct.pack_into("<I", content, end, checksum(bytes(content[begin:end])))
    path.write_bytes(content)


ELSEWHERE, LINK = "'x_max' has its values in another file", "'x_max' is a link to something else"
NO_NUMBERS = "'x_max' holds no numbers"
NO_TEXTS = "'impact_word' holds no texts of variable length"
REASONS = {  # what clatter says of each
    "external": ELSEWHERE,
    "external_pipe": ELSEWHERE,
    "virtual": ELSEWHERE,
    "growing_virtual": ELSEWHERE,
    "external_link": LINK,
    "external_link_to_pipe": LINK,
    "soft_link": LINK,
    "dangling_link": LINK,
    "status_link": "'status' is a link to something else",
    "group": "'x_max' is a group or a type, not a variable",
    "link_in_group": "'hidden' is a group or a type, not a variable",
    "type": "'x_max' is a group or a type, not a variable",
    "lzf": "'x_max' passes through filter 32000",
    "scaled": "'x_max' passes through filter 6",
    "checked": "'x_max' passes through filter 3",
    "deflated_twice": "'x_max' passes through filter 1",
    "compact": "'x_max' is stored compactly",
    "texts": NO_NUMBERS,
    "number_words": NO_TEXTS,
    "fixed_words": NO_TEXTS,
    "references": NO_NUMBERS,
    "name": "'a\\x1b]0;title\\x07\\x1b[2J\\xe2\\x80\\xae\\xc2\\x9b\\x0aclatter: all is well' is no name of a variable",
    **dict.fromkeys(("hidden", "hidden_storage"), "its list of variables is damaged"),
}
