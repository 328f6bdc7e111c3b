"""Pictures and pages are whole or not there, whatever stops the script; texts and names of any kind are drawn or
refused in one line.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import os
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py

from command_line import CLATTER, LONGEST, SMALL, CommandLine, heed_signals
from plot_checks import Svg
from script_runs import SCRIPTS, run_script, start_script
from small_disk import small_disk

from clatter.plots import style

MAKES = {"plot.py": ("--format", "svg", "-o", "."), "report.py": ("--no-histories", "-o", "a.html")}
MADE = {"plot.py": "a.svg", "report.py": "a.html"}
REPORT = "<!doctype html>\n<!-- a report of clatter -->\nan older one"


def sends(number):
    """In place of a function: sends this signal to the process that calls it."""
    return lambda *_: os.kill(os.getpid(), number)


class Made(CommandLine):
    def setUp(self):
        super().setUp()
        self.write("a.toml", SMALL)
        self.assertEqual(self.clatter("run", "a.toml", "-q").returncode, 0)
        (self.directory / "a.toml").unlink()

    def scripts(self):
        """(script, its words, the file that it makes), with an older such file in its place."""
        for name, words in MAKES.items():
            made = self.directory / MADE[name]
            made.write_text(REPORT)
            with self.subTest(name):
                yield name, ("a.h5", *words), made
            made.unlink(missing_ok=True)

    def run_here(self, name, *words, **how):
        return run_script(name, *words, cwd=self.directory, **how)

    def assert_as_before(self, made):
        self.assertEqual(made.read_text(), REPORT)
        self.assertEqual(self.files(), sorted(["a.h5", made.name]))


class Stopped(Made):
    @classmethod
    def setUpClass(cls):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # nohup has some of them ignored
            cls.addClassCleanup(signal.signal, number, signal.signal(number, signal.SIG_DFL))

    def test_a_signal_while_a_picture_is_drawn_ends_it_without_a_word_and_the_older_one_stays(self):
        for name, words, made in self.scripts():
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                with mock.patch.object(style, "lay_out", sends(number)):
                    result = self.run_here(name, *words)
                self.assertEqual((result.returncode, result.stdout, result.stderr), (-number, "", ""))
                self.assert_as_before(made)

    def test_a_signal_while_a_file_is_written_leaves_no_part_of_it(self):
        for name, words, made in self.scripts():
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                with mock.patch("os.fsync", sends(number)):
                    result = self.run_here(name, *words)
                self.assertEqual((result.returncode, result.stdout, result.stderr), (-number, "", ""))
                self.assert_as_before(made)

    def test_a_kill_while_a_file_is_written_leaves_the_older_one(self):
        for name, words, made in self.scripts():
            with mock.patch("os.fsync", sends(signal.SIGKILL)):
                self.assertEqual(self.run_here(name, *words).returncode, -signal.SIGKILL)
            self.assertEqual(made.read_text(), REPORT)
            for part in self.directory.glob(".*"):
                part.unlink()

    def test_an_interrupt_while_libraries_are_loaded_ends_it_without_a_word(self):
        library = self.directory / "matplotlib"
        library.mkdir()
        (library / "__init__.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n")
        for name, words in MAKES.items():
            environment = {**os.environ, "PYTHONPATH": str(self.directory)}
            command = [sys.executable, SCRIPTS / name, "a.h5", *words]
            result = subprocess.run(
                command,
                cwd=self.directory,
                env=environment,
                capture_output=True,
                timeout=LONGEST,
                preexec_fn=heed_signals,
            )
            self.assertEqual((result.returncode, result.stdout, result.stderr), (-signal.SIGINT, b"", b""))

    def test_a_signal_while_motion_is_computed_ends_the_program_and_leaves_no_folder(self):
        program = self.directory / "slow"
        look = f'[ "$1" = info ] && exec "{CLATTER}" "$@"'
        program.write_text(f'#!/bin/bash\n{look}\n[ "$1" = run ] && kill -TERM $PPID\nexec sleep 1000\n')
        program.chmod(0o755)
        folder = self.directory / "tmp"
        folder.mkdir()
        environment = {**os.environ, "CLATTER": str(program), "TMPDIR": str(folder)}
        result = start_script("report.py", "a.h5", "-o", "a.html", cwd=self.directory, environment=environment)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (-signal.SIGTERM, "", ""))
        self.assertEqual(list(folder.iterdir()), [])


class NoRoom(Made):
    def assert_refused(self, result, made):
        self.assertEqual((result.returncode, result.stdout), (74, ""))
        self.assertRegex(
            result.stderr, rf"^(plot\.py|clatter-report): {made.name}: cannot be written \(.*\); name .*\n$"
        )

    def test_a_file_that_may_not_grow_is_an_error_and_the_older_one_stays(self):
        kept = resource.getrlimit(resource.RLIMIT_FSIZE)
        for name, words, made in self.scripts():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, kept[1]))
            try:
                result = self.run_here(name, *words)
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, kept)
            self.assert_refused(result, made)
            self.assert_as_before(made)

    def test_a_full_disk_is_an_error_and_the_older_file_stays(self):
        for name, words, made in self.scripts():
            with small_disk(self.directory / "disk", 16) as disk:
                (disk / made.name).write_text(REPORT)
                result = run_script(name, self.directory / "a.h5", *words[1:], cwd=disk)
                self.assert_refused(result, made)
                self.assertEqual([path.name for path in disk.iterdir()], [made.name])
                self.assertEqual((disk / made.name).read_text(), REPORT)

    def test_standard_output_without_room_is_an_error_after_the_file(self):
        for name, words, made in self.scripts():
            with open("/dev/full", "wb") as full:
                for arguments in (words, ["--help"]):
                    command = [sys.executable, SCRIPTS / name, *arguments]
                    result = subprocess.run(command, cwd=self.directory, stdout=full, stderr=subprocess.PIPE, text=True)
                    self.assertEqual(result.returncode, 74)
                    self.assertRegex(result.stderr, r"^\S+: standard output cannot be written; is its disk full\?\n$")
            self.assertNotEqual(made.read_text(), REPORT)

    def test_a_reader_that_has_gone_is_no_mistake(self):
        for name, words, made in self.scripts():
            for arguments in (words, ["--help"]):
                reader, writer = os.pipe()
                os.close(reader)
                command = [sys.executable, SCRIPTS / name, *arguments]
                result = subprocess.run(command, cwd=self.directory, stdout=writer, stderr=subprocess.PIPE, text=True)
                os.close(writer)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertNotEqual(made.read_text(), REPORT)


class Places(Made):
    def test_a_link_stays_one_and_rights_stay(self):
        for name, words, made in self.scripts():
            real = self.directory / "real"
            made.rename(real)
            made.symlink_to("real")
            real.chmod(0o640)
            self.assertEqual(self.run_here(name, *words).returncode, 0)
            self.assertTrue(made.is_symlink())
            self.assertNotEqual(real.read_text(), REPORT)
            self.assertEqual(real.stat().st_mode & 0o777, 0o640)
            real.unlink()

    def test_a_new_file_has_the_rights_that_the_mask_leaves(self):
        for name, words, made in self.scripts():
            made.unlink()
            kept = os.umask(0o027)
            try:
                self.assertEqual(self.run_here(name, *words).returncode, 0)
            finally:
                os.umask(kept)
            self.assertEqual(made.stat().st_mode & 0o777, 0o640)

    def test_a_folder_of_that_name_is_an_error(self):
        (self.directory / "a.svg").mkdir()
        result = self.run_here("plot.py", "a.h5", *MAKES["plot.py"])
        self.assertEqual((result.returncode, result.stdout), (74, ""))
        self.assertIn("a.svg: cannot be written (Is a directory)", result.stderr)
        self.assertEqual(self.files(), ["a.h5", "a.svg"])

    def test_a_picture_that_is_refused_leaves_no_folder(self):
        for words in (["--only", "none"], ["--scatter", "none"], ["--at", "none=1"], ["--size", "1x1"]):
            with self.subTest(words):
                result = self.run_here("plot.py", "a.h5", *words, "-o", "new/deep")
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertEqual(self.files(), ["a.h5"])
        result = self.run_here("plot.py", "a.h5", "--format", "svg", "-o", "new/deep")
        self.assertEqual((result.returncode, result.stdout), (0, "new/deep/a.svg\n"))
        result = self.run_here("plot.py", "a.h5", "--format", "svg", "-o", "a.h5/deep")
        self.assertEqual((result.returncode, result.stdout), (74, ""))
        self.assertRegex(result.stderr, r"^plot.py: a.h5/deep: no folder can be made here \(.*\); name another .*\n$")


class Names(Made):
    def test_files_that_begin_with_a_minus_come_after_two(self):
        os.rename(self.directory / "a.h5", self.directory / "-x.h5")
        self.assertEqual(self.run_here("plot.py", "--format", "svg", "--", "-x.h5").stdout, "-x.svg\n")
        self.assertEqual(self.run_here("report.py", "--no-histories", "-o", "x.html", "--", "-x.h5").returncode, 0)
        self.assertEqual(self.files(), ["-x.h5", "-x.svg", "x.html"])
        result = self.run_here("plot.py", "-x.h5")
        self.assertEqual(result.returncode, 2)
        self.assertIn("'-x.h5' begins like an option; write -- before it, or ./-x.h5", result.stderr)

    def test_names_that_are_not_utf_8_are_printed_as_they_are(self):
        for byte in (b"1\xff", b"2\xff"):
            os.link(self.directory / "a.h5", os.fsencode(self.directory) + b"/" + byte + b".h5")
        for words, made in (
            (["plot.py", b"1\xff.h5", "--format", "svg"], b"1\xff.svg"),
            (["plot.py", b"1\xff.h5", b"2\xff.h5", "--format", "svg", "pdf"], b"1\xff+2\xff.svg\n1\xff+2\xff.pdf"),
            (["report.py", b"1\xff.h5", "-o", b"\xff.html", "--no-histories"], b"\xff.html"),
        ):
            for locale in ("C.UTF-8", "POSIX"):
                command = [sys.executable, SCRIPTS / words[0], *words[1:]]
                environment = {**os.environ, "LC_ALL": locale}
                result = subprocess.run(command, cwd=self.directory, capture_output=True, env=environment)
                self.assertEqual((result.returncode, result.stdout, result.stderr), (0, made + b"\n", b""))
        self.assertEqual([name for name in self.files() if name.startswith(".")], [])
        page = (self.directory / os.fsdecode(b"\xff.html")).read_text(encoding="utf-8")
        self.assertTrue(page.endswith("</html>\n"))

    def test_a_name_that_is_not_there_is_told_in_one_line(self):
        for name in MAKES:
            command = [sys.executable, SCRIPTS / name, b"\xff.h5"]
            result = subprocess.run(command, cwd=self.directory, capture_output=True)
            self.assertEqual((result.returncode, result.stdout), (74, b""))
            self.assertRegex(result.stderr, rb"^\S+: \xff\.h5: no such file; make it with .*\n$")

    def test_a_format_of_many_letters_is_told_in_one_line(self):
        result = self.run_here("plot.py", "a.h5", "--format", "svg", "x" * 300)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr.splitlines()[-1], "argument --format: 'x+' is none of pdf, png, svg")


class Texts(Made):
    """Texts that matplotlib would take for mathematics, or that no picture can hold."""

    ODD = ("$", "$x_{$", "a $ b", "\\$", "\x01", "two\nlines", "é ∞")

    def change(self, name, key, text):
        with h5py.File(self.directory / "a.h5", "r+") as file:
            file[name].attrs[key] = text

    def test_units_and_names_of_a_file_are_drawn_as_they_are(self):
        for name, key in (
            ("x_max", "units"),
            ("period_ratio", "long_name"),
            ("nu", "units"),
            ("status", "flag_meanings"),
        ):
            for text in self.ODD:
                with self.subTest(name=name, key=key, text=text):
                    self.change(name, key, text)
                    result = self.run_here("plot.py", "a.h5", "--format", "svg")
                    self.assertEqual((result.returncode, result.stderr), (0, ""))
                    Svg(self.directory / "a.svg")  # is well-formed
        self.change("x_max", "units", "US$")
        self.run_here("plot.py", "a.h5", "--format", "svg", "--only", "x_max")
        self.assertIn("US$", " ".join(Svg(self.directory / "a.svg").texts()).replace("\\", ""))

    def test_titles_of_any_bytes_are_drawn(self):
        for title in (*self.ODD, os.fsdecode(b"\xff")):
            with self.subTest(title):
                result = self.run_here("plot.py", "a.h5", "--format", "svg", "--title", title)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                Svg(self.directory / "a.svg")

    def test_names_of_files_are_drawn_as_they_are(self):
        for text in ("$", "$x_{$", "two\nlines", os.fsdecode(b"\xff")):
            with tempfile.TemporaryDirectory() as folder:
                files = [Path(folder) / f"{number}{text}.h5" for number in (1, 2)]
                for file in files:
                    os.link(self.directory / "a.h5", file)
                result = run_script("plot.py", *files, "--format", "svg")
                self.assertEqual((result.returncode, result.stderr), (0, ""), text)


if __name__ == "__main__":
    unittest.main()
