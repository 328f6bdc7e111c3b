"""Finds heaps of texts in HDF5 files that HDF5 1.10 would read for ever, like src/results/hdf5_plain.cpp."""

import mmap
import struct

SIGNATURE = b"GCOL\1\0\0\0"  # HDF5 file format, III.E: signature, version, size; then objects, each after a header
HEADER = struct.Struct("<HHIQ")  # index, references, reserved, size


def damaged_heap(path):
    """The place of the first damaged heap in a file, or None: zeros, which a disk error leaves, are enough."""
    return next((place for place, longest in heaps(path) if longest is None), None)


def longest_text(path):
    """The bytes of the longest text in the heaps of a file without damaged ones."""
    return max((longest for _, longest in heaps(path)), default=0)


def heaps(path):
    """The place of each heap in a file and the size of its largest object, None if it is damaged."""
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        place = data.find(SIGNATURE)
        while place >= 0:
            yield place, largest_object(data, place)
            place = data.find(SIGNATURE, place + HEADER.size)


def largest_object(data, place):
    """Walks the objects of a heap as the library does: every step must lead forward, and none beyond the end."""
    largest = 0
    if place + HEADER.size > len(data):
        return largest  # no heap any more, but the end of the values
    end = place + struct.unpack_from("<Q", data, place + len(SIGNATURE))[0]
    place += HEADER.size
    if not place <= end <= len(data):
        return None
    while end - place >= HEADER.size:
        index, _, _, size = HEADER.unpack_from(data, place)
        step = size if index == 0 else HEADER.size + (size + 7) // 8 * 8  # 0: the free rest, header included
        if step == 0 or size > end - place or step > end - place:
            return None
        largest = largest if index == 0 else max(largest, size)
        place += step
    return largest
