"""What the tests of stopped, shared and failing runs have in common: a sweep of every kind of motion, and its bytes."""

import random
import signal
import subprocess

from command_line import CLATTER, CommandLine

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
        return [CLATTER, "run", self.config, "-o", output or self.output, "--threads", str(threads), "--arch", arch, *words]

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

    def stopped(self, seconds, number, *words, **more):
        """The exit code and what was said by a run that gets a signal after so long."""
        process = subprocess.Popen(self.command(*words, **more), stderr=subprocess.PIPE, text=True)
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(number)
        said = process.communicate(timeout=300)[1]
        return process.returncode, said

    def in_steps(self, *words, seconds=0.03, **more):
        """Runs with --max-time until it is done; returns how often it was stopped with something finished."""
        stops = 0
        for attempt in range(1, 200):
            result = self.run_command("--max-time", f"{seconds * attempt:g}", *words, **more)
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

    def killed(self, whole, rounds, seed):
        """Kills runs at random moments until one ends, so many times; returns how often one went on from a journal."""
        moments, resumed = random.Random(seed), 0
        for _ in range(rounds):
            saved = 0
            for attempt in range(1, 200):
                code, said = self.stopped(moments.uniform(0, 0.5 * attempt), signal.SIGKILL, threads=moments.choice((1, 2, 3)))
                resumed += "goes on from" in said
                if code == 0:
                    break
                self.assertEqual(code, -signal.SIGKILL, said)
                self.assertTrue(not self.output.exists() or self.output.read_bytes() == whole)
                grown = self.journal.stat().st_size if self.journal.exists() else 0
                self.assertTrue(grown >= saved or self.output.exists(), "the journal lost something")
                saved = grown
            self.assertEqual(self.output.read_bytes(), whole)
            self.assertEqual(self.files(), ["a.h5", "a.toml"])
            self.output.unlink()
        return resumed
