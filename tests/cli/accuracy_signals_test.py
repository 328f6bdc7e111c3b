"""Signals to `clatter accuracy`: the first one ends it after the present run, a second one at once."""

import os
import re
import signal
import subprocess
import time
import unittest

from accuracy_runs import STEADY, AccuracyRuns, objects
from command_line import CLATTER, LONGEST, full_pipe, handled_signals, heed_signals

POINTS = 30  # more than are finished before a signal comes, on whatever machine
SWEEP = STEADY + f'[sweep]\nnu = "linspace(0.9, 1.1, {POINTS})"\n'
NOTED = "\nclatter: stopping after the present run; a second signal stops at once\n"  # the signal


class Interrupts(AccuracyRuns):
    def interrupted(self, number, stream, words, *options):
        """Sends a signal as soon as a stream has these words; gives the exit code, stdout and stderr."""
        with open(self.directory / "stdout", "wb") as out, open(self.directory / "stderr", "wb") as err:
            process = subprocess.Popen(
                [CLATTER, "accuracy", "a.toml", *options],
                cwd=self.directory,
                stdout=out,
                stderr=err,
                env={**os.environ, "CLATTER_ARCH": ""},
                preexec_fn=heed_signals,
            )
        self.addCleanup(process.kill)
        self.wait_until(
            lambda: words in (self.directory / stream).read_bytes() or process.poll() is not None, f"it says {words}"
        )
        self.assertIsNone(process.poll(), "it ended before the signal")
        process.send_signal(number)
        code = process.wait(LONGEST)
        texts = [(self.directory / name).read_text(encoding="utf-8") for name in ("stdout", "stderr")]
        for name in ("stdout", "stderr"):
            os.remove(self.directory / name)
        return code, *texts

    def test_sigint_in_the_first_point_leaves_nothing(self):
        self.write("a.toml", SWEEP)
        for _ in range(20):  # until no point is over between the first words and the signal
            code, out, err = self.interrupted(signal.SIGINT, "stderr", b" runs ", "--progress", "always")
            self.assertEqual(code, 130, err)
            if out == "":
                break
        self.assertEqual(out, "")
        self.assertIn(f"stopped after 0 of {POINTS} points; a.accuracy.h5 is not written\n", err)
        self.assertEqual(self.files(), ["a.toml"])

    def signalled_twice(self, first, second):
        """The exit code after a second signal while the handler of the first one waits for a full pipe."""
        reader, writer = full_pipe()
        self.addCleanup(os.close, reader)
        process = subprocess.Popen(
            [CLATTER, "accuracy", "a.toml", "-q"],
            cwd=self.directory,
            stdout=subprocess.DEVNULL,
            stderr=writer,
            preexec_fn=heed_signals,
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        os.close(writer)
        self.wait_for_handlers(process, {first, second})
        process.send_signal(first)
        self.wait_for_handlers(process, set())
        process.send_signal(second)
        return process.wait(LONGEST)

    def wait_for_handlers(self, process, numbers):
        """Waits until a process handles these signals and no other."""
        self.wait_until(
            lambda: handled_signals(process) == numbers or process.poll() is not None, f"it handles {numbers}"
        )
        self.assertIsNone(process.poll(), "it ended before the signal")

    def test_a_second_signal_of_the_other_kind_ends_it_at_once(self):
        self.write("a.toml", SWEEP)
        for first, second in ((signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, signal.SIGINT)):
            with self.subTest(first):
                self.assertEqual(self.signalled_twice(first, second), -second)
                self.assertEqual(self.files(), ["a.toml"])

    def test_sigterm_after_the_first_point_keeps_the_printed_part_and_the_older_file(self):
        config = self.write("a.toml", SWEEP)
        self.accuracy(config, "--set", "time.max_impacts=1", code=1)
        older = (self.directory / "a.accuracy.h5").read_bytes()
        code, out, err = self.interrupted(signal.SIGTERM, "stdout", b"\n", "--json", "--progress", "never")
        self.assertEqual(code, 143, err)
        finished = int(
            re.fullmatch(NOTED + rf"stopped after (\d+) of {POINTS} points; a\.accuracy\.h5 is not written\n", err)[1]
        )
        self.assertIn(finished, range(1, POINTS))
        self.assertEqual([row["point"] for row in objects(out)], [k for k in range(finished) for _ in range(61)])
        self.assertEqual(self.files(), ["a.accuracy.h5", "a.toml"])
        self.assertEqual((self.directory / "a.accuracy.h5").read_bytes(), older)

    def test_with_interrupts_ignored_goes_on(self):
        """As under nohup, or in the background of a script."""
        config = self.write("a.toml", STEADY + "max_impacts = 1\n")
        process = subprocess.Popen(
            [CLATTER, "accuracy", config],
            cwd=self.directory,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN),
        )
        while process.poll() is None:
            process.send_signal(signal.SIGINT)
            time.sleep(0.01)
        self.assertEqual(process.returncode, 1, process.communicate())
        process.communicate()
        self.assertEqual(self.files(), ["a.accuracy.h5", "a.toml"])


if __name__ == "__main__":
    unittest.main()
