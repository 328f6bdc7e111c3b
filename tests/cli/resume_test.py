"""Runs that are stopped, by signals, by their time or killed: nothing finished is lost.

The same command gives the bytes of an undisturbed run.
"""

import os
import signal
import subprocess
import unittest

from command_line import LONGEST, SMALL, handled_signals
from stopped_runs import StoppedRuns, holds_points


class Resume(StoppedRuns):
    def test_a_signal_saves_and_the_same_command_goes_on(self):
        self.sweep(nu=200, xs=100)
        whole = self.undisturbed()
        for number in (signal.SIGINT, signal.SIGTERM):
            self.assertIn(str(self.journal), self.stopped_with_points(number))
            content, said = self.complete(threads=1)
            self.assertIn("goes on from ", said)
            self.assertEqual(content, whole)
            self.output.unlink()

    def test_killed_at_random_moments_it_loses_nothing_that_was_saved(self):
        """CLATTER_KILLS: how many (scripts/long_checks.sh kills)."""
        self.sweep(nu=200, xs=50)
        self.killed(self.undisturbed(), kills=int(os.environ.get("CLATTER_KILLS", "15")), seed=8)

    def test_points_are_saved_about_once_a_second_while_it_runs(self):
        for nu in (400, 1600, 6400):  # more points, if the machine is done with those before they are seen
            self.sweep(nu=nu, xs=200)
            process = self.begin(threads=1, stderr=subprocess.DEVNULL)
            self.wait_until(lambda: self.has_saved() or process.poll() is not None, "points are saved")
            process.kill()
            if process.wait(LONGEST) != 0:
                break
        self.assertEqual(process.returncode, -signal.SIGKILL, "the sweep is too short for this machine")
        self.assertIn("goes on from ", self.stopped(0, signal.SIGTERM)[1])

    def has_saved(self):
        """Whether a run's journal has points; there is none before it begins and after its end."""
        try:
            return holds_points(self.journal.read_bytes())
        except FileNotFoundError:
            return False

    def test_max_time_is_a_stop_of_its_own(self):
        self.sweep()
        whole = self.undisturbed()
        self.in_several_steps()
        self.assertEqual(self.output.read_bytes(), whole)

    def test_followed_branches_are_kept_whole(self):
        for follow in ("nu", "xs"):
            self.sweep(follow=follow)
            whole = self.undisturbed()
            self.in_several_steps()
            self.assertEqual(self.output.read_bytes(), whole)
            self.output.unlink()

    def test_a_run_that_is_stopped_again_and_again_without_a_point_leaves_nothing(self):
        self.sweep(nu=100_000, xs=1, follow="nu")  # one branch, not over before its time is looked at
        result = self.run_command("--max-time", "1e-9")
        self.assertEqual(result.returncode, 124, result.stderr)
        self.assertIn("no point was finished yet", result.stderr)
        self.assertEqual(self.files(), ["a.toml"])

    def test_another_configuration_is_refused_and_restart_is_the_way_out(self):
        self.sweep(nu=200, xs=100)
        self.stopped_with_points(signal.SIGTERM)
        before = self.journal.read_bytes()
        for words, named in (
            (("--set", "scene.R=0.6"), ("R = 0.7", "R = 0.6")),
            (("--shard", "1/2"), ("the whole sweep", "shard 1/2")),
        ):
            result = self.run_command(*words)
            self.assertEqual(result.returncode, 74)
            for word in (*named, "--restart"):
                self.assertIn(word, result.stderr)
            self.assertEqual(self.journal.read_bytes(), before)
        self.complete("--set", "scene.R=0.6", "--restart")

    def test_a_damaged_journal_is_refused_and_a_torn_one_goes_on(self):
        self.sweep(nu=200, xs=100)
        whole = self.undisturbed()
        self.stopped_with_points(signal.SIGTERM)
        content = self.journal.read_bytes()
        for place in (0, 20, len(content) // 2, len(content) - 1):
            damaged = bytearray(content)
            damaged[place] ^= 0x10
            damaged[-1] |= 0x01  # a last block that ends in a zero would be one that a power cut has left unfinished
            self.journal.write_bytes(damaged)
            result = self.run_command()
            self.assertEqual(result.returncode, 74)
            self.assertRegex(result.stderr, "damaged at byte|is not a journal")
            self.assertEqual(self.journal.read_bytes(), damaged)
        self.journal.write_bytes(content[:-7])
        self.assertEqual(self.complete()[0], whole)

    def test_a_second_run_on_the_same_output_waits_for_nobody(self):
        self.sweep()
        first, reader = self.begin_held()
        result = self.run_command()
        os.close(reader)  # it goes on
        self.assertEqual(result.returncode, 75, result.stderr)
        self.assertIn("another run", result.stderr)
        self.assertEqual(first.wait(LONGEST), 0)

    def test_closed_standard_streams_and_closed_terminals_lose_nothing(self):
        self.sweep(nu=200, xs=100)
        whole = self.undisturbed()

        def close(*files):
            for file in files:
                os.close(file)

        for closed in ((0, 1, 2), (2,), (0, 2)):
            self.stopped_with_points(signal.SIGTERM, prepare=lambda closed=closed: close(*closed))
            self.assertEqual(self.complete()[0], whole, closed)
            self.output.unlink()
        reader, writer = os.pipe()
        os.close(reader)
        for number, code in ((signal.SIGINT, 130), (signal.SIGHUP, 129)):
            for _ in range(100):  # until it isn't over before the signal
                stopped, _ = self.stopped(0, number, "--progress", "always", "--restart", stderr=writer)
                if stopped != 0:
                    break
            self.assertEqual(stopped, code)
        os.close(writer)
        self.assertEqual(self.complete()[0], whole)

    def test_a_second_signal_of_any_kind_leaves_at_once(self):
        self.sweep()
        for first, second in ((signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, signal.SIGHUP)):
            process, reader = self.begin_held()  # what it says of the first signal has to wait, too
            process.send_signal(first)
            self.wait_until(lambda: not handled_signals(process), "the first signal is taken")
            process.send_signal(second)
            self.assertEqual(process.wait(LONGEST), -second)
            os.close(reader)

    def test_other_rounding_is_another_run(self):
        """A mathematical library without fused operations, as on an older processor, gives other last digits."""
        self.sweep(nu=200, xs=100)
        older = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX,-AVX512F"}
        self.stopped_with_points(signal.SIGTERM)
        said = subprocess.run(
            self.command("--max-time", "0.1"), capture_output=True, text=True, timeout=LONGEST, env=older
        )
        if said.returncode in (0, 124):
            self.skipTest("this machine's mathematical library has no other rounding")
        self.assertEqual(said.returncode, 74, said.stderr)
        self.assertIn("rounding: sse2, functions ", said.stderr)
        self.complete()

    def test_wrong_wishes_are_refused(self):
        small = self.write("s.toml", SMALL)
        self.assert_refused(2, "--resume conflicts with --restart", "run", small, "--resume", "--restart")
        for wrong in ("0", "-1", "soon", "nan", "1e10", ""):
            self.assert_refused(2, "--max-time", "run", small, "--max-time", wrong)
        self.assert_refused(74, "nothing to resume", "run", small, "--resume")


if __name__ == "__main__":
    unittest.main()
