"""Shared by the tests of stopped, divided and failing runs: a sweep of every kind of motion, and its bytes."""

import os
import random
import signal
import struct
import subprocess
import time
import zlib

from command_line import CLATTER, LONGEST, STOPS, CommandLine, full_pipe, handled_signals, heed_signals

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


def processor_time(process):
    """Seconds of all threads of a process that isn't waited for yet, by its clock as clock_getcpuclockid(3) has it."""
    return time.clock_gettime(~process.pid << 3 | 2)


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
        return subprocess.run(self.command(*words, **more), capture_output=True, text=True, timeout=LONGEST)

    def undisturbed(self):
        """The bytes of a run that nothing stops."""
        whole = self.directory / "whole.h5"
        result = self.run_command(output=whole)
        self.assertEqual(result.returncode, 0, result.stderr)
        content = whole.read_bytes()
        whole.unlink()
        return content

    def begin(self, *words, stderr=subprocess.PIPE, prepare=None, **more):
        """A run that heeds signals; `prepare` is called just before it becomes the program."""

        def prepare_all():
            heed_signals()
            if prepare is not None:
                prepare()

        process = subprocess.Popen(self.command(*words, **more), stderr=stderr, text=True, preexec_fn=prepare_all)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def begin_held(self):
        """A run that listens to signals but can't end, since it waits for room in a full pipe to show its progress.
        Returns it and an end of the pipe, after whose closing it goes on."""
        reader, writer = full_pipe()
        process = self.begin("--progress", "always", stderr=writer)
        os.close(writer)
        self.wait_until_it_listens(process)
        self.assertIsNone(process.poll(), "it ended though nobody reads its messages")
        return process, reader

    def wait_until_it_listens(self, process):
        """Waits until a run handles all signals, from when on it stops in an orderly way, or until it has ended."""
        self.wait_until(
            lambda: handled_signals(process) == STOPS or process.poll() is not None, "a run handles signals or ends"
        )

    def killed_after(self, seconds, **more):
        """The exit code and what was said by a run that is killed after so long, at whatever moment that is."""
        process = self.begin(**more)
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.kill()
        said = process.communicate(timeout=LONGEST)[1]
        return process.returncode, said

    def stopped(self, seconds, number, *words, **more):
        """The exit code and what was said by a run that gets a signal when it listens and has taken so much processor
        time, which tells on a busy machine, too, how far it is."""
        process = self.begin(*words, **more)
        self.wait_until_it_listens(process)
        self.wait_until(
            lambda: process.poll() is not None or processor_time(process) >= seconds, f"a run works for {seconds} s"
        )
        process.send_signal(number)
        said = process.communicate(timeout=LONGEST)[1]
        return process.returncode, said

    def stopped_with_points(self, number, **more):
        """What was said by a run that a signal stopped after some points and before the last: later if none was
        finished, sooner if all were."""
        seconds = 0.05
        for _ in range(100):
            code, said = self.stopped(seconds, number, **more)
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
        return self.fail("it doesn't get on")

    def in_several_steps(self, *words, **more):
        """The same, again until it was stopped with something finished: a busy machine may give a run no time until it
        is over, and then all of it at once."""
        for _ in range(100):
            if self.in_steps(*words, **more) > 0:
                return
            (more.get("output") or self.output).unlink()
        self.fail("it is never stopped between two points")

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
                code, said = self.killed_after(moments.uniform(0, 0.2 * attempt), threads=moments.choice((1, 2, 3)))
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
