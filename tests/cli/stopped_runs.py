"""Shared by the tests of stopped, divided and failing runs: a sweep of every kind of motion, and its bytes."""

import random
import signal
import struct
import subprocess
import time
import zlib

from command_line import CLATTER, CommandLine, handled_signals

# Periodic and aperiodic motion, with and without impacts; ragged results too. Fractions of a second to seconds.
SWEEP = """[scene]
f = -1.0
h = 0.1
R = 0.7
[sweep]
nu = "linspace(0.5, 1.5, {nu})"
xs = "linspace(0.2, 4, {xs})"
follow = "{follow}"
[time]
max_periods = 300
[observe]
extrema = true
harmonics = 3
harmonics_method = "exact"
impacts = true
impact_log = true
period = true
"""


MAGIC = b"clatter journal 1\n"


def whole_records(journal):
    """The bytes of a journal without what a killed run has left of a last record.

    They are blocks of length, CRC-32, CRC-32 of both, and content.
    """
    at = len(MAGIC)
    while at + 16 <= len(journal):
        end = at + 16 + struct.unpack_from("<Q", journal, at)[0]
        if end > len(journal):
            break
        assert zlib.crc32(journal[at + 16 : end]) == struct.unpack_from("<I", journal, at + 8)[0]
        at = end
    return journal[:at] if len(journal) >= at else b""


def holds_points(journal):
    """Whether a journal has a whole record of results after that of the configuration."""
    records = whole_records(journal)
    return (
        len(records) > len(MAGIC) and len(records) > len(MAGIC) + 16 + struct.unpack_from("<Q", records, len(MAGIC))[0]
    )


class StoppedRuns(CommandLine):
    def setUp(self):
        super().setUp()
        self.output, self.journal = self.directory / "a.h5", self.directory / "a.h5.journal"

    def sweep(self, nu=60, xs=40, follow=""):
        """Writes the configuration that the other functions run."""
        self.config = self.directory / self.write("a.toml", SWEEP.format(nu=nu, xs=xs, follow=follow))
        return self.config

    def command(self, *words, threads=2, output=None, arch="sse2"):
        """One instruction set for all, which every machine has."""
        return [
            CLATTER,
            "run",
            self.config,
            "-o",
            output or self.output,
            "--threads",
            str(threads),
            "--arch",
            arch,
            *words,
        ]

    def run_command(self, *words, **more):
        return subprocess.run(self.command(*words, **more), capture_output=True, text=True, timeout=300)

    def undisturbed(self):
        """The bytes of a run that nothing stops."""
        whole = self.directory / "whole.h5"
        result = self.run_command(output=whole)
        self.assertEqual(result.returncode, 0, result.stderr)
        content = whole.read_bytes()
        whole.unlink()
        return content

    def wait_until_it_listens(self, process):
        """Waits until a run handles signals, from when on it stops in an orderly way, or until it has ended."""
        while not handled_signals(process) and process.poll() is None:
            time.sleep(0.001)

    def stopped(self, seconds, number, *words, popen=None, **more):
        """The exit code and what was said by a run that gets a signal after so long, SIGKILL at any moment, others
        once it listens."""
        process = subprocess.Popen(self.command(*words, **more), stderr=subprocess.PIPE, text=True, **(popen or {}))
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            if number != signal.SIGKILL:
                self.wait_until_it_listens(process)
            process.send_signal(number)
        said = process.communicate(timeout=300)[1]
        return process.returncode, said

    def stopped_with_points(self, number, popen=None):
        """What was said by a run that a signal stopped after some points and before the last: later if none was
        finished, sooner if all were."""
        seconds = 0.05
        for _ in range(100):
            code, said = self.stopped(seconds, number, popen=popen)
            if code == 0:
                self.output.unlink()
                seconds /= 2
                continue
            self.assertEqual(code, 128 + number, said)
            self.assertFalse(self.output.exists())
            if self.journal.exists():
                return said
            seconds *= 1.5
        return self.fail("it never stops between two points")

    def in_steps(self, *words, **more):
        """Runs with --max-time, longer and longer, until it is done; returns how often it was stopped with something
        finished. Times grow in small ratios, so that on a machine of any speed some end in the middle."""
        stops = 0
        for attempt in range(100):
            result = self.run_command("--max-time", f"{0.001 * 1.2**attempt:.4g}", *words, **more)
            if result.returncode == 0:
                return stops
            self.assertEqual(result.returncode, 124, result.stderr)
            stops += "goes on" in result.stderr
        self.fail("it doesn't get on")

    def complete(self, *words, **more):
        """The bytes and what was said by a run that ends what others began; nothing else is left."""
        result = self.run_command(*words, **more)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.files(), ["a.h5", "a.toml"])
        return self.output.read_bytes(), result.stderr

    def killed(self, whole, kills, seed):
        """Kills so many runs at random moments, each sweep again and again until it is done.

        Returns how often one went on from a journal.
        """
        moments, done, resumed = random.Random(seed), 0, 0
        while done < kills:
            saved = b""
            for attempt in range(1, 200):
                code, said = self.stopped(
                    moments.uniform(0, 0.2 * attempt), signal.SIGKILL, threads=moments.choice((1, 2, 3))
                )
                resumed += "goes on from" in said
                if code == 0:
                    break
                done += 1
                self.assertEqual(code, -signal.SIGKILL, said)
                self.assertTrue(not self.output.exists() or self.output.read_bytes() == whole)
                found = whole_records(self.journal.read_bytes()) if self.journal.exists() else b""
                self.assertTrue(found.startswith(saved) or self.output.exists(), "the journal lost something")
                saved = found
            self.assertEqual(self.output.read_bytes(), whole)
            self.assertEqual(self.files(), ["a.h5", "a.toml"])
            self.output.unlink()
        return resumed
