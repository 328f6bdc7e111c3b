"""Shared by the tests of the command line: the program in a directory of its own."""

import contextlib
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

CLATTER = os.environ["CLATTER"]
SOURCE = pathlib.Path(os.environ.get("CLATTER_SOURCE", pathlib.Path(__file__).parents[2]))

LONGEST = 300  # seconds until whatever is waited for counts as hung; a busy or slow machine takes some of them

SANITIZED = os.environ.get("CLATTER_FAULTS") == ""  # such a program takes other memory, and can't have its calls fail

SMALL = """title = "a small sweep"
[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -4.0
[sweep]
nu = "linspace(0.5, 1.5, 5)"
[observe]
extrema = true
period = true
"""


def runs_here(name):
    """Whether this machine has an instruction set, as Linux reports."""
    flags = set(re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)[1].split())
    needed = {"avx2": "avx2 fma", "avx512": "avx512f avx512dq avx512cd avx512bw avx512vl"}
    return set(needed.get(name, "").split()) <= flags


STOPS = frozenset((signal.SIGINT, signal.SIGTERM, signal.SIGHUP))


def handled_signals(process):
    """Those of STOPS that a process handles; none once it has ended."""
    try:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
    except (FileNotFoundError, ProcessLookupError):
        return set()
    if re.search(r"^State:\s*[ZX]", status, re.MULTILINE):
        return set()
    caught = int(re.search(r"^SigCgt:\s*(\w+)$", status, re.MULTILINE)[1], 16)
    return {number for number in STOPS if caught >> (number - 1) & 1}


def heed_signals():
    """Between fork and exec: nohup, or a shell that starts the tests in the background, has some of them ignored."""
    for number in STOPS:
        signal.signal(number, signal.SIG_DFL)


def without_progress(said):
    """What a command says on stderr without the lines about a run that takes more than half a minute."""
    return re.sub(r"^\d+ of \d+ (points|runs), about [\d:]+ left\n", "", said, flags=re.MULTILINE)


def full_pipe():
    """A pipe that has no room, so that whoever writes into it waits until the first of its ends, the reader, is read
    from or closed."""
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    with contextlib.suppress(BlockingIOError):
        while os.write(writer, bytes(4096)):
            pass
    os.set_blocking(writer, True)
    return reader, writer


def open_terminal(make=pty.openpty):
    """What this function of pty gives; fails, and says what to do, where there are no pseudo terminals."""
    try:
        return make()
    except OSError as error:
        raise AssertionError(
            f"this test needs a pseudo terminal, and none can be opened here ({error}): mount -t devpts devpts "
            "/dev/pts, and see that /dev/ptmx is there"
        ) from error


def require_program(name, package):
    """Fails, and says what to do, on a machine without a program that a test needs."""
    if shutil.which(name) is None:
        raise AssertionError(f"this test needs {name}, which isn't here: apt-get install {package}")


class CommandLine(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def clatter(self, *words, environment=None):
        """What the program does and says, but for how far it is: only on a slow machine it tells this."""
        done = subprocess.run(
            [CLATTER, *words],
            cwd=self.directory,
            capture_output=True,
            text=True,
            timeout=LONGEST,
            env={**os.environ, **(environment or {})},
        )
        done.stderr = without_progress(done.stderr)
        return done

    def shown(self, *words):
        """The exit code of a command whose standard output is a terminal, and what it shows there."""
        terminal, output = open_terminal()
        try:
            with os.fdopen(output, "wb") as stdout:
                process = subprocess.Popen([CLATTER, *words], cwd=self.directory, stdout=stdout)
            text = b""
            with contextlib.suppress(OSError):  # that nobody writes any more
                while part := os.read(terminal, 65536):
                    text += part
        finally:
            os.close(terminal)
        return process.wait(LONGEST), text.decode().replace("\r\n", "\n")

    def write(self, name, text):
        (self.directory / name).write_text(text, encoding="utf-8")
        return name

    def files(self):
        return sorted(path.name for path in self.directory.iterdir())

    def wait_until(self, holds, what):
        """Waits for a condition, however long a busy machine takes."""
        deadline = time.monotonic() + LONGEST
        while not holds():
            self.assertLess(time.monotonic(), deadline, f"not within {LONGEST} s: {what}")
            time.sleep(0.005)

    def assert_refused(self, code, words, *command):
        """The command ends with this code and one line on stderr that says why; nothing on stdout, no new file."""
        before = self.files()
        result = self.clatter(*command)
        self.assertEqual(result.returncode, code, (command, result.stderr))
        self.assertIn(words, result.stderr, command)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertEqual(result.stdout, "", command)
        self.assertEqual(self.files(), before, command)
