"""Files that were made to harm their reader: nothing but the file itself is read, nothing waits, nothing fills memory,
and a terminal obeys nothing. A checksum is no obstacle to whoever makes such a file, so these have good ones."""

import os
import pty
import resource
import shutil
import struct
import subprocess
import unittest
import zlib

import h5py
import numpy

from command_line import CLATTER, SANITIZED, SMALL, CommandLine

SECRET = b"root:x:0:0:secret\n" * 8
DOES_NOT = ", which clatter doesn't write; "
CONTROLS = "\x1b]0;title\x07\x1b[2J\u202e\u009b\nclatter: all is well"


def seal(path):
    """Puts the seal of a shard behind a file's bytes."""
    content = path.read_bytes()
    path.write_bytes(content + b"\nclatter shard of %20d bytes, CRC-32 %08x\n" % (len(content), zlib.crc32(content)))


def replace(make):
    """A way to craft a file: another x_max, of as many values."""
    def craft(file, directory):
        points = len(file["x_max"])
        del file["x_max"]
        make(file, points, directory)
    return craft


def properties(**settings):
    created = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    for name, value in settings.items():
        getattr(created, "set_" + name)(value)
    return created


def deflated_twice(points):
    created = properties(chunk=(points,))
    for _ in range(2):
        created.set_filter(h5py.h5z.FILTER_DEFLATE, h5py.h5z.FLAG_MANDATORY, (9,))
    return created


def low_level(file, points, created, kind=h5py.h5t.NATIVE_DOUBLE):
    h5py.h5d.create(file.id, b"x_max", kind, h5py.h5s.create_simple((points,)), created)


def virtual(file, points, directory):
    layout = h5py.VirtualLayout(shape=(points,), dtype="f8")
    layout[:] = h5py.VirtualSource(directory / "other.h5", "x_max", shape=(points,))
    file.create_virtual_dataset("x_max", layout)


def printf_virtual(file, points, directory):
    layout = h5py.VirtualLayout(shape=(points,), dtype="f8", maxshape=(None,))
    source = h5py.VirtualSource(directory / "other.h5", "x_max", shape=(points,), maxshape=(None,))
    layout[:h5py.h5s.UNLIMITED] = source[:h5py.h5s.UNLIMITED]
    file.create_virtual_dataset("x_max", layout)


def external(name):
    return lambda file, points, directory: file.create_dataset(
        "x_max", (points,), "f8", external=[(os.path.join(directory, name), 0, h5py.h5f.UNLIMITED)])


def linked(link):
    return lambda file, points, directory: file.__setitem__("x_max", link(directory))


# Name, how x_max is made, and the reason that is given.
CRAFTED = {
    "external storage": (replace(external("secret")), "'x_max' has its values in another file"),
    "external storage in a FIFO": (replace(external("fifo")), "'x_max' has its values in another file"),
    "external link": (replace(linked(lambda directory: h5py.ExternalLink(str(directory / "other.h5"), "x_max"))),
                      "'x_max' is a link to something else"),
    "external link to a FIFO": (replace(linked(lambda directory: h5py.ExternalLink(str(directory / "fifo"), "x_max"))),
                                "'x_max' is a link to something else"),
    "soft link": (replace(linked(lambda directory: h5py.SoftLink("/x_min"))), "'x_max' is a link to something else"),
    "dangling link": (replace(linked(lambda directory: h5py.SoftLink("/none"))),
                      "'x_max' is a link to something else"),
    "virtual": (replace(virtual), "'x_max' has its values in another file"),
    "growing virtual": (replace(printf_virtual), "'x_max' has its values in another file"),
    "group": (replace(lambda file, points, directory: file.create_group("x_max")),
              "'x_max' is a group or a type, not a variable"),
    "link within a group": (lambda file, directory: file.create_group("hidden").__setitem__(
        "status", h5py.ExternalLink(str(directory / "other.h5"), "x_max")),
        "'hidden' is a group or a type, not a variable"),
    "type": (replace(linked(lambda directory: numpy.dtype("f8"))), "'x_max' is a group or a type, not a variable"),
    "filter": (replace(lambda file, points, directory: file.create_dataset(
        "x_max", data=numpy.zeros(points), chunks=(points,), compression="lzf")), "'x_max' passes through filter 32000"),
    "deflated twice": (replace(lambda file, points, directory: low_level(
        file, points, deflated_twice(points))), "'x_max' passes through filter 1"),
    "compact": (replace(lambda file, points, directory: low_level(
        file, points, properties(layout=h5py.h5d.COMPACT))), "'x_max' is stored compactly"),
    "texts": (replace(lambda file, points, directory: file.create_dataset("x_max", data=["a"] * points)),
              "'x_max' holds no numbers"),
    "references": (replace(lambda file, points, directory: file.create_dataset(
        "x_max", data=[file["x_min"].ref] * points, dtype=h5py.ref_dtype)), "'x_max' holds no numbers"),
    "text in lines": (lambda file, directory: file.create_group("a" + CONTROLS),
                      "'a\\x1b]0;title\\x07\\x1b[2J\\xe2\\x80\\xae\\xc2\\x9b\\x0aclatter: all is well' is a group"),
}


class HostileFiles(CommandLine):
    def setUp(self):
        super().setUp()
        self.config = self.write("a.toml", SMALL)
        self.run_whole("run", self.config)
        for shard in ("0/2", "1/2"):
            self.run_whole("run", self.config, "--shard", shard)
        (self.directory / "secret").write_bytes(SECRET)
        os.mkfifo(self.directory / "fifo")
        with h5py.File(self.directory / "other.h5", "w") as file:
            file["x_max"] = numpy.full(5, 12345.678)

    def run_whole(self, *words):
        result = self.clatter(*words)
        self.assertEqual(result.returncode, 0, result.stderr)

    def craft(self, original, change, name="crafted.h5"):
        path = self.directory / name
        shutil.copy(self.directory / original, path)
        with h5py.File(path, "r+") as file:
            change(file, self.directory)
        if "-of-" in original:
            seal(path)
        return name

    def opened(self, *command):
        """The files in the directory of the test that a command has opened, by strace."""
        log = self.directory / "strace.log"
        result = subprocess.run(["strace", "-f", "-qq", "-z", "-e", "trace=open,openat,openat2,creat", "-o", log, CLATTER,
                                 *command], cwd=self.directory, capture_output=True, text=True, timeout=300)
        names = {line.split('"')[1] for line in log.read_text().splitlines() if '"' in line}
        log.unlink()
        system = ("/usr/", "/lib", "/etc/ld.so", "/etc/localtime", "/proc/", "/sys/", "/dev/null")
        return {name for name in names if not name.startswith(system)}, result

    def assert_reads_only(self, allowed, *command):
        if SANITIZED or shutil.which("strace") is None or subprocess.run(
                ["strace", "-qq", "-o", "/dev/null", "true"], capture_output=True).returncode != 0:
            return  # what was read shows in no output, in any case
        names, result = self.opened(*command)
        self.assertLessEqual({name.removeprefix(str(self.directory) + "/") for name in names}, allowed,
                             (command, result.stderr))

    def assert_tells_nothing(self, result):
        for text in (result.stdout, result.stderr):
            self.assertNotIn("secret", text)
            self.assertNotIn("12345", text)

    def test_nothing_but_the_file_is_read(self):
        for kind, (change, reason) in CRAFTED.items():
            with self.subTest(kind):
                name = self.craft("a.h5", change)
                for words in (["info", name], ["info", name, "--json"], ["info", name, "--config"]):
                    self.assert_refused(74, f"'{name}': cannot be read: {reason}", *words)
                self.assert_tells_nothing(self.clatter("info", name))
                self.assert_reads_only({name}, "info", name)

    def test_nothing_but_the_shards_is_merged(self):
        for kind, (change, reason) in CRAFTED.items():
            with self.subTest(kind):
                name = self.craft("a.0-of-2.h5", change)
                words = ["merge", "-o", "merged.h5", name, "a.1-of-2.h5"]
                self.assert_refused(74, f"'{name}' cannot be read: {reason}", *words)
                self.assert_tells_nothing(self.clatter(*words))
                self.assert_reads_only({name}, *words)

    def test_nothing_but_the_file_is_looked_at_before_it_is_replaced(self):
        for kind, (change, _) in CRAFTED.items():
            with self.subTest(kind):
                name = self.craft("a.h5", change)
                words = ["run", self.config, "-o", name]
                self.assert_refused(74, "is no output of clatter, or a damaged one", *words)
                self.assert_reads_only({name, self.config, "."}, *words)

    def test_what_is_no_regular_file_is_not_waited_for(self):
        (self.directory / "link.h5").symlink_to("fifo")
        for name in ("fifo", "link.h5"):
            self.assert_refused(74, f"'{name}': is not a regular file", "info", name)
            self.assert_refused(74, f"'{name}': is not a regular file", "merge", "-o", "new.h5", name)
            self.assert_refused(74, "is not a regular file", "run", self.config, "-o", name)

    @unittest.skipIf(SANITIZED, "a sanitizer takes memory of its own")
    def test_a_claimed_length_is_not_read(self):
        def grow(file, directory):
            del file["status"]
            created = properties(alloc_time=h5py.h5d.ALLOC_TIME_EARLY, fill_time=h5py.h5d.FILL_TIME_NEVER)
            h5py.h5d.create(file.id, b"status", h5py.h5t.NATIVE_UINT8, h5py.h5s.create_simple((4 << 30,)), created)
        def grow_unread(file, directory):
            grow(file, directory)
            file.attrs["config"] = "of another version"
        name = self.craft("a.h5", grow)
        self.assertLess((self.directory / name).stat().st_blocks * 512, 1 << 20)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.assert_refused(74, "its 'status' is of other points than the 5 of its configuration", "info", name)
        name = self.craft("a.h5", grow_unread)
        self.assert_refused(74, "its 'status' is longer than a file of its size can hold", "info", name)
        used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.assertLess(max(0, used - before), 256 * 1024)  # KiB

    def test_a_shard_that_claims_more_than_its_points_is_not_merged(self):
        def grow(file, directory):
            del file["x_max"]
            file.create_dataset("x_max", (1 << 40,), "f8", chunks=(1 << 10,))[:1] = 0.0
        def add_log(file, directory):
            file.create_dataset("impact_tau", data=numpy.zeros(100))
        for change, words in ((grow, "its size can hold"), (add_log, "a run of its configuration writes")):
            name = self.craft("a.0-of-2.h5", change)
            self.assert_refused(74, f"it holds more values than {words}", "merge", "-o", "new.h5", name, "a.1-of-2.h5")

    def test_a_terminal_obeys_nothing_of_a_shard(self):
        def mark(attribute):
            return lambda file, directory: file.attrs.__setitem__(attribute, "x" + CONTROLS)
        for attribute in ("clatter_version", "git_commit", "compiler", "config", "rounding", "shard", "clatter_schema"):
            for original in ("a.0-of-2.h5", "a.1-of-2.h5"):
                name = self.craft(original, mark(attribute))
                other = "a.1-of-2.h5" if original == "a.0-of-2.h5" else "a.0-of-2.h5"
                result = self.clatter("merge", "-v", "-o", "new.h5", *sorted([name, other]))
                self.assertEqual(result.returncode, 74, (attribute, result.stderr))
                self.assert_harmless(result.stderr)

    def assert_harmless(self, text):
        for obeyed in ("\x1b", "\x07", "\u202e", "\u009b", "\nclatter: all is well"):
            self.assertNotIn(obeyed, text)

    def test_a_terminal_obeys_nothing_of_a_configuration(self):
        text = 'title = "' + CONTROLS.replace("\n", " ") + '"\n[scene]\n'
        name = self.craft("a.h5", lambda file, directory: file.attrs.__setitem__("config", text))
        piped = self.clatter("info", name, "--config")
        self.assertEqual(piped.stdout, text)
        master, slave = pty.openpty()
        try:
            result = subprocess.run([CLATTER, "info", name, "--config"], cwd=self.directory, stdout=slave, timeout=60)
            os.close(slave)
            shown = os.read(master, 100_000).decode().replace("\r\n", "\n")
        finally:
            os.close(master)
        self.assertEqual(result.returncode, 0)
        self.assert_harmless(shown)
        self.assertEqual(shown.count("\n"), 2)
        self.assertIn("\\x1b]0;title\\x07", shown)

    def test_marks_of_direction_are_shown_by_info(self):
        name = self.craft("a.h5", lambda file, directory: file.attrs.__setitem__("title", "a\u202eb\u2066c\u200fd"))
        self.assertIn("a\\xe2\\x80\\xaeb\\xe2\\x81\\xa6c\\xe2\\x80\\x8fd", self.clatter("info", name).stdout)
        self.assertIn('"title": "a\\u202eb\\u2066c\\u200fd"', self.clatter("info", name, "--json").stdout)

    def journal(self, *texts, record=b"\0"):
        """A journal with these texts for its key, program first, and one record."""
        def block(content):
            head = struct.pack("<QI", len(content), zlib.crc32(content))
            return head + struct.pack("<I", zlib.crc32(head)) + content
        key = b"".join(struct.pack("<Q", len(text.encode())) + text.encode() for text in texts)
        return b"clatter journal 1\n" + block(key) + block(record)

    def test_a_terminal_obeys_nothing_of_a_journal(self):
        for hostile in range(4):
            texts = ["1.0", "avx2", "", "nu = 1\n"]
            texts[hostile] += CONTROLS
            content = self.journal(*texts)
            (self.directory / "b.h5.journal").write_bytes(content)
            result = self.clatter("run", self.config, "-o", "b.h5")
            self.assertEqual(result.returncode, 74, result.stderr)
            self.assert_harmless(result.stderr)
            self.assertIn("\\x1b]0;title\\x07", result.stderr)
            self.assertEqual((self.directory / "b.h5.journal").read_bytes(), content)

    def test_a_terminal_obeys_no_name_of_a_file(self):
        name = "a" + CONTROLS.replace("/", "") + ".h5"
        shutil.copy(self.directory / "a.toml", self.directory / name)
        for words in (["info", name], ["run", name], ["merge", "-o", "new.h5", name], ["run", self.config, "-o", name]):
            result = self.clatter(*words)
            self.assertNotEqual(result.returncode, 0)
            self.assert_harmless(result.stderr)

    def test_a_long_sparse_journal_is_not_read_to_its_end(self):
        path = self.directory / "b.h5.journal"
        path.write_bytes(b"clatter journal 1\n")
        os.truncate(path, 1 << 40)
        self.run_whole("run", self.config, "-o", "b.h5")
        self.assertEqual((self.directory / "b.h5").read_bytes(), (self.directory / "a.h5").read_bytes())


if __name__ == "__main__":
    unittest.main()
