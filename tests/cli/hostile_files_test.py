"""Files that were made to harm their reader: nothing but the file itself is read, nothing waits, nothing fills memory,
and a terminal obeys nothing. A checksum is no obstacle to whoever makes such a file, so these have good ones."""

import os
import resource
import shutil
import struct
import subprocess
import unittest
import zlib

import h5py
import numpy

from command_line import CLATTER, SANITIZED, SMALL, CommandLine
from crafted_files import CHANGES, CONTROLS, REASONS, SECRET, claim, hide_variables, make_surroundings, require_trace

CASES = {
    **CHANGES,
    "name": lambda file, directory: file.create_group("a" + CONTROLS),
    "hidden": CHANGES["external_link"],
    "hidden_storage": CHANGES["external"],
}


def add_trailer(path):
    """Puts the checksum trailer of a shard behind a file's bytes."""
    content = path.read_bytes()
    path.write_bytes(content + b"\nclatter shard of %20d bytes, CRC-32 %08x\n" % (len(content), zlib.crc32(content)))


class HostileFiles(CommandLine):
    def setUp(self):
        super().setUp()
        self.config = self.write("a.toml", SMALL)
        self.run_whole("run", self.config)
        for shard in ("0/2", "1/2"):
            self.run_whole("run", self.config, "--shard", shard)
        make_surroundings(self.directory)

    def run_whole(self, *words):
        result = self.clatter(*words)
        self.assertEqual(result.returncode, 0, result.stderr)

    def craft(self, original, change, hide=False):
        path = self.directory / "crafted.h5"
        shutil.copy(self.directory / original, path)
        with h5py.File(path, "r+") as file:
            change(file, self.directory)
        if hide:
            hide_variables(path)
        if "-of-" in original:
            add_trailer(path)
        return path.name

    def each_crafted(self, original):
        for kind, change in CASES.items():
            with self.subTest(kind):
                yield self.craft(original, change, kind.startswith("hidden")), REASONS[kind]

    def opened(self, *command):
        """The files in the directory of the test that a command has opened, by strace."""
        log = self.directory / "strace.log"
        result = subprocess.run(
            ["strace", "-f", "-qq", "-z", "-e", "trace=open,openat,openat2,creat", "-o", log, CLATTER, *command],
            cwd=self.directory,
            capture_output=True,
            text=True,
            timeout=300,
        )
        names = {line.split('"')[1] for line in log.read_text().splitlines() if '"' in line}
        log.unlink()
        system = ("/usr/", "/lib", "/etc/ld.so", "/etc/localtime", "/proc/", "/sys/", "/dev/null")
        return {name for name in names if not name.startswith(system)}, result

    def assert_reads_only(self, allowed, *command):
        if SANITIZED:
            return  # it opens files of its own; that nothing of them shows in an output is tested in any case
        require_trace()
        names, result = self.opened(*command)
        self.assertLessEqual(
            {name.removeprefix(str(self.directory) + "/") for name in names}, allowed, (command, result.stderr)
        )

    def assert_tells_nothing(self, result):
        for text in (result.stdout, result.stderr):
            self.assertNotIn(SECRET[:8], text)
            self.assertNotIn("12345", text)

    @unittest.skipIf(SANITIZED, "a sanitizer opens files of its own")
    def test_an_opened_file_is_noticed(self):
        require_trace()
        names, _ = self.opened("plan", self.config)
        self.assertEqual(names, {self.config})

    def test_nothing_but_the_file_is_read(self):
        for name, reason in self.each_crafted("a.h5"):
            for words in (
                ["info", name],
                ["info", name, "--json"],
                ["info", name, "--config"],
                ["info", name, "--check"],
            ):
                self.assert_refused(74, f"'{name}': cannot be read: {reason}", *words)
            self.assert_tells_nothing(self.clatter("info", name))
            self.assert_reads_only({name}, "info", name)

    def test_nothing_but_the_shards_is_merged(self):
        for name, reason in self.each_crafted("a.0-of-2.h5"):
            words = ["merge", "-o", "merged.h5", name, "a.1-of-2.h5"]
            self.assert_refused(74, f"'{name}' cannot be read: {reason}", *words)
            self.assert_tells_nothing(self.clatter(*words))
            self.assert_reads_only({name, "a.1-of-2.h5"}, *words)  # several are read at a time

    def test_nothing_but_the_file_is_looked_at_before_it_is_replaced(self):
        for name, _ in self.each_crafted("a.h5"):
            words = ["run", self.config, "-o", name]
            self.assert_refused(74, "is not an output of clatter, or is damaged", *words)
            self.assert_reads_only({name, self.config}, *words)

    def test_special_files_are_not_waited_for(self):
        (self.directory / "link.h5").symlink_to("pipe")
        for name in ("pipe", "link.h5"):
            self.assert_refused(74, f"'{name}': is not a regular file", "info", name)
            self.assert_refused(74, f"'{name}': is not a regular file", "merge", "-o", "new.h5", name)
            self.assert_refused(74, "is not a regular file", "run", self.config, "-o", name)

    @unittest.skipIf(SANITIZED, "a sanitizer takes memory of its own")
    def test_a_claimed_length_is_not_read(self):
        def grow(file, directory):
            claim("status", (4 << 30,), file)

        def grow_unread(file, directory):
            grow(file, directory)
            file.attrs["config"] = "of another version"

        def grow_rows(file, directory):
            claim("status", (1 << 30, 5), file)
            file["row"] = numpy.zeros(1)
            file["row"].make_scale("row")
            for place, scale in enumerate((file["row"], file["nu"])):
                file["status"].dims[place].attach_scale(scale)

        name = self.craft("a.h5", grow)
        self.assertLess((self.directory / name).stat().st_blocks * 512, 1 << 20)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        for change in (grow, grow_unread, grow_rows):
            name = self.craft("a.h5", change)
            self.assert_refused(74, "its 'status' is longer than a file of its size can hold", "info", name)
        used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.assertLess(max(0, used - before), 256 * 1024)  # KiB

    def test_a_check_reads_all_values(self):
        self.run_whole(
            "run",
            self.config,
            "-o",
            "b.h5",
            "--set",
            "sweep.nu=linspace(0.5, 1.5, 5000)",
            "--set",
            "output.compression=4",
        )
        self.assertEqual(self.clatter("info", "--check", "b.h5").stderr, "")
        path = self.directory / "b.h5"
        with h5py.File(path) as file:
            chunk = file["x_max"].id.get_chunk_info(0)
        content = bytearray(path.read_bytes())
        for at in range(chunk.byte_offset + chunk.size // 2, chunk.byte_offset + chunk.size // 2 + 20):
            content[at] ^= 0x55
        path.write_bytes(content)
        self.run_whole("info", "b.h5")
        self.assert_refused(74, "'b.h5': cannot be read: ", "info", "--check", "b.h5")

    def test_an_output_with_other_points_than_those_of_its_configuration_is_refused(self):
        name = self.craft("a.h5", lambda file, directory: claim("status", (1000,), file))
        for words in (["info", name], ["export", name], ["certify", name]):
            self.assert_refused(74, "its 'status' doesn't have the 5 points of its configuration", *words)

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

        for attribute in (
            "clatter_version",
            "git_commit",
            "compiler",
            "config",
            "rounding",
            "instruction_set",
            "shard",
            "clatter_schema",
        ):
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
        code, shown = self.shown("info", name, "--config")
        self.assertEqual(code, 0)
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

    def test_a_terminal_obeys_no_name_of_a_configuration(self):
        name = "a" + CONTROLS + ".toml"
        self.write(name, SMALL.replace("[sweep]", '[sweep]\nfollow = "nu"'))
        for words in (["accuracy", name, "-o", "b.h5"], ["run", name, "--set", "scene.R=2"]):
            self.assert_harmless(self.clatter(*words).stderr)
        self.write(name, "#" * (1 << 20))
        for command in ("run", "plan"):
            result = self.clatter(command, name)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(result.stderr.count("\n"), 1)
            self.assert_harmless(result.stderr)

    def test_a_foreign_key_of_a_journal_is_shown_and_not_obeyed(self):
        config = 'nu = 1\nx = "\x1b]0;title\x07"\n'
        journal = self.journal("1.0\x1b[2J\nclatter: all is well", "\u202eavx2", "", config)
        (self.directory / "b.h5.journal").write_bytes(journal)
        result = self.clatter("run", self.config, "-o", "b.h5")
        self.assertEqual(result.returncode, 74)
        self.assert_harmless(result.stderr)
        self.assertIn("1.0\\x1b[2J\\x0aclatter: all is well", result.stderr)

    @unittest.skipIf(SANITIZED, "a sanitizer reserves all addresses")
    def test_a_journal_of_one_long_section_takes_no_memory(self):
        config = "[" + "s" * (1 << 20) + "]\n" + "a\n" * 10_000  # as lines with their section 10 GiB
        (self.directory / "b.h5.journal").write_bytes(self.journal("1.0", "avx2", "", config))
        result = subprocess.run(
            [CLATTER, "run", self.config, "-o", "b.h5"],
            cwd=self.directory,
            text=True,
            timeout=300,
            capture_output=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30)),
        )
        self.assertEqual(result.returncode, 74)
        self.assertIn("has the finished points of another run", result.stderr)
        self.assertLess(len(result.stderr), 10_000)

    def test_a_long_sparse_journal_is_not_read_to_its_end(self):
        path = self.directory / "b.h5.journal"
        path.write_bytes(b"clatter journal 1\n")
        os.truncate(path, 1 << 40)
        self.run_whole("run", self.config, "-o", "b.h5")
        self.assertEqual((self.directory / "b.h5").read_bytes(), (self.directory / "a.h5").read_bytes())


if __name__ == "__main__":
    unittest.main()
