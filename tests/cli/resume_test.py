"""Runs that are stopped, by signals, by their time or killed: nothing finished is lost, and the same command gives the bytes of an undisturbed run."""

import os
import random
import signal
import subprocess
import time
import unittest

from command_line import CLATTER, SMALL, CommandLine

LONG = """[scene]
f = -1.0
h = 0.1
R = 0.7
[sweep]
nu = "linspace(0.5, 1.5, 400)"
xs = "linspace(0.2, 4, 120)"
[time]
max_periods = 500
[observe]
extrema = true
harmonics = 3
harmonics_method = "exact"
period = true
impact_log = true
"""
FOLLOWED = """[scene]
f = -1.0
h = 0.1
R = 0.7
[sweep]
xs = "linspace(0.5, 4, 64)"
nu = "linspace(0.5, 1.5, 60)"
follow = "nu"
[time]
max_periods = 2000
[observe]
extrema = true
impacts = true
"""


class Resume(CommandLine):
    def setUp(self):
        super().setUp()
        self.config = self.directory / self.write("a.toml", LONG)
        self.output, self.journal = self.directory / "a.h5", self.directory / "a.h5.journal"

    def command(self, *words, threads=2, config=None):
        return [CLATTER, "run", config or self.config, "-o", self.output, "--threads", str(threads), "--arch", "sse2", *words]

    def undisturbed(self, config=None):
        whole = self.directory / "whole.h5"
        command = self.command(config=config)
        command[4] = whole
        self.assertEqual(subprocess.run(command, capture_output=True).returncode, 0)
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
        said = process.communicate()[1]
        return process.returncode, said

    def complete(self, *words, **more):
        result = subprocess.run(self.command(*words, **more), capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertFalse(self.journal.exists())
        return self.output.read_bytes(), result.stderr

    def test_a_signal_saves_and_the_same_command_goes_on(self):
        whole = self.undisturbed()
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            self.output.unlink(missing_ok=True)
            returned, said = self.stopped(0.4, number)
            self.assertEqual(returned, code, said)
            self.assertIn(str(self.journal), said)
            self.assertFalse(self.output.exists())
            content, said = self.complete(threads=1)
            self.assertIn("goes on from ", said)
            self.assertEqual(content, whole)

    def test_killed_at_random_moments_it_loses_nothing_that_was_saved(self):
        whole, moments = self.undisturbed(), random.Random(8)
        rounds = int(os.environ.get("CLATTER_KILLS", "6"))
        for _ in range(rounds):
            size = 0
            while True:
                code, _ = self.stopped(moments.uniform(0.05, 2.5), signal.SIGKILL, threads=moments.choice((1, 2, 3)))
                if code == 0:
                    break
                self.assertEqual(code, -signal.SIGKILL)
                grown = self.journal.stat().st_size if self.journal.exists() else 0
                self.assertGreaterEqual(grown, size)
                size = grown
            self.assertEqual(self.output.read_bytes(), whole)
            self.assertEqual(self.files(), ["a.h5", "a.toml"])

    def test_max_time_is_a_stop_of_its_own(self):
        whole = self.undisturbed()
        steps = 0
        while True:
            result = subprocess.run(self.command("--max-time", "0.5"), capture_output=True, text=True)
            if result.returncode == 0:
                break
            self.assertEqual(result.returncode, 124, result.stderr)
            self.assertIn("--max-time is over", result.stderr)
            steps += 1
        self.assertGreater(steps, 0)
        self.assertEqual(self.output.read_bytes(), whole)

    def test_followed_branches_are_kept_whole(self):
        config = self.directory / self.write("f.toml", FOLLOWED)
        whole = self.undisturbed(config)
        code, said = self.stopped(0.3, signal.SIGINT, config=config)
        self.assertIn(code, (0, 130), said)
        if code == 130:
            content, _ = self.complete(config=config, threads=1)
            self.assertEqual(content, whole)

    def test_another_configuration_is_refused_and_restart_is_the_way_out(self):
        code, said = self.stopped(0.4, signal.SIGTERM)
        self.assertEqual(code, 143, said)
        before = self.journal.read_bytes()
        result = subprocess.run(self.command("--set", "scene.R=0.6"), capture_output=True, text=True)
        self.assertEqual(result.returncode, 74)
        for words in ("R = 0.7", "R = 0.6", "--restart"):
            self.assertIn(words, result.stderr)
        self.assertEqual(self.journal.read_bytes(), before)
        self.complete("--set", "scene.R=0.6", "--restart")

    def test_a_second_run_on_the_same_output_waits_for_nobody(self):
        first = subprocess.Popen(self.command(), stderr=subprocess.DEVNULL)
        time.sleep(0.2)
        result = subprocess.run(self.command(), capture_output=True, text=True)
        self.assertEqual(result.returncode, 75, result.stderr)
        self.assertIn("another run", result.stderr)
        self.assertEqual(first.wait(), 0)

    def test_wrong_wishes_are_refused(self):
        small = self.write("s.toml", SMALL)
        self.assert_refused(2, "--resume beside --restart", "run", small, "--resume", "--restart")
        for wrong in ("0", "-1", "soon", "nan", "1e10", ""):
            self.assert_refused(2, "--max-time", "run", small, "--max-time", wrong)
        self.assert_refused(74, "nothing to resume", "run", small, "--resume")


if __name__ == "__main__":
    unittest.main()
