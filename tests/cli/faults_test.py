"""Calls that fail, disks that are full, places that can't be written: no broken file, no point lost or doubled.

Never a false success. scripts/long_checks.sh disks runs the full disks at more sizes.
"""

import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

from command_line import CLATTER, LONGEST, SANITIZED
from faulty_calls import FaultyCalls, needs_shim


class Faults(FaultyCalls):
    def begin_anew(self, journal=None):
        for path in self.directory.iterdir():
            if path != self.config:
                path.unlink()
        if journal is not None:
            self.journal.write_bytes(journal)

    def stop_on_its_way(self, *more):
        """Leaves the journal of a run that was stopped; returns the words that did it. How fast it is, nobody knows."""
        for attempt in range(1000):
            words = (*more, "--max-time", f"{0.005 * 1.2 ** (attempt % 40):.4g}")
            if self.run_command(*words, threads=1).returncode == 124 and self.journal.exists():
                return words
            self.begin_anew()
        return self.fail("it is never stopped on its way")

    def half(self):
        """The journal of a run that was stopped on its way."""
        self.stop_on_its_way()
        return self.journal.read_bytes()

    def journals(self):
        """The journals of a run that was stopped again and again, up to the last before it was done."""
        self.stop_on_its_way()
        journals = [self.journal.read_bytes()]
        for attempt in range(200):
            result = self.run_command("--max-time", f"{0.005 * 1.1**attempt:.4g}", threads=1)
            if result.returncode == 0:
                return journals
            self.assertEqual(result.returncode, 124, result.stderr)
            journals.append(self.journal.read_bytes())
        return self.fail("it doesn't get on")

    def most(self):
        """A journal with about three quarters of the points: what goes on from it saves points, too, and takes less
        time than from a half."""
        journals = self.journals()
        shorter = [one for one in journals if len(one) <= 0.8 * len(journals[-1])]
        return (shorter or journals[:1])[-1]

    def assert_whole_or_nothing(self, code, said):
        """A run in which something went wrong leaves a whole output and a success, or neither."""
        if self.output.exists():
            self.assertEqual(self.output.read_bytes(), self.whole, said)
        else:
            self.assertNotEqual(code, 0, said)

    def assert_completes(self, context):
        """The same command again gives the bytes of an undisturbed run, and nothing else is left."""
        content, said = self.complete()
        self.assertEqual(content, self.whole, (context, said))

    def with_fault(self, fault, *words):
        environment = {
            **os.environ,
            "LD_PRELOAD": str(self.shim),
            "CLATTER_FAULT": fault,
            "CLATTER_FAULT_DONE": str(self.marker),
        }
        self.marker.unlink(missing_ok=True)
        result = subprocess.run(
            self.command(*words, threads=1), capture_output=True, text=True, timeout=300, env=environment
        )
        happened = self.marker.exists()
        self.marker.unlink(missing_ok=True)
        return result, happened

    def with_fault_in_time(self, fault, stopped, journal):
        """A run in which a call goes wrong. One that is `stopped` by its time may end before it comes to that call,
        how soon depends on the machine: such a run gets more time until one comes to it, or to its end."""
        for attempt in range(40 if stopped else 1):
            words = ("--max-time", f"{0.005 * 1.2**attempt:.4g}") if stopped else ()
            self.begin_anew(journal)
            result, happened = self.with_fault(fault, *words)
            if happened or result.returncode == 0:
                break
        return result, happened, words

    def check_each_call(self, calls, effects, stopped, journal):
        """Lets the n-th call go wrong, for all n that there are; returns how often one did."""
        times = 0
        for call in calls:
            for effect in effects:
                for n in range(1, 1000):
                    result, happened, words = self.with_fault_in_time(f"{call} {n} {effect}", stopped, journal)
                    if not happened:
                        self.assertTrue(n > 1 or stopped, f"no call of {call}")
                        break
                    times += 1
                    context = (call, n, effect, words, result.returncode, result.stderr)
                    permitted = {"kill": {-signal.SIGKILL}, "EINTR": {0, 124}, "short": {0, 124}}.get(
                        effect, {0, 74, 124}
                    )
                    self.assertIn(result.returncode, permitted, context)
                    self.assert_whole_or_nothing(result.returncode, context)
                    if result.returncode == 74:
                        self.assertRegex(result.stderr, "cannot (be read|read|write)", context)
                        self.assertEqual(self.hidden(), [], context)
                    self.assert_completes(context)
        return times

    def hidden(self):
        return [name for name in self.files() if name.startswith(".")]

    @needs_shim
    def test_each_call_of_a_run_that_resumes_and_publishes_may_fail_or_be_the_last(self):
        calls = ("open", "read", "write", "ftruncate", "fsync", "linkat", "rename", "unlink")
        self.assertGreater(self.check_each_call(calls, ("kill", "EIO"), False, self.most()), 20)

    @needs_shim
    def test_each_call_of_a_run_that_saves_may_fail_or_be_the_last(self):
        self.assertGreater(self.check_each_call(("open", "write", "fdatasync"), ("kill", "ENOSPC"), True, None), 5)

    @needs_shim
    def test_interrupted_and_short_calls_are_repeated(self):
        journal = self.most()
        interrupted = [(call, "EINTR") for call in ("open", "read", "write", "ftruncate", "fsync")]
        for call, effect in [*interrupted, ("read", "short"), ("write", "short")]:
            for n in (0, 1):
                self.begin_anew(journal)
                result, happened = self.with_fault(f"{call} {n} {effect}")
                self.assertTrue(happened or n == 0, call)
                self.assertEqual(result.returncode, 0, (call, effect, result.stderr))
                self.assertEqual(self.output.read_bytes(), self.whole, (call, effect))

    @needs_shim
    def test_a_signal_while_the_output_is_written_stops_nothing(self):
        for call in ("write", "fsync", "rename"):
            n = 1
            for _ in range(100):
                begin = time.monotonic()
                result, happened = self.with_fault(f"{call} {n} TERM")
                if happened and (result.returncode != 143 or time.monotonic() - begin < 1):
                    break  # else the machine is so slow that the run saved points, and was stopped then
                n = n + 1 if happened else 1  # now and then a later run is fast, and has no such call
                self.begin_anew()
            self.assertTrue(happened, call)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(self.output.read_bytes(), self.whole)
            self.begin_anew()

    def limited(self, size, *words):
        return subprocess.run(
            self.command(*words),
            capture_output=True,
            text=True,
            timeout=300,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
        )

    def test_a_disk_that_is_full_at_any_size_loses_nothing(self):
        """CLATTER_DISKS: how many sizes (scripts/long_checks.sh disks)."""
        sizes = int(os.environ.get("CLATTER_DISKS", "12"))
        half, refused = self.half(), 0
        for i in range(sizes):
            size = (len(self.whole) + 4096) * i // sizes
            for journal, words in ((None, ()), (half, ()), (None, ("--max-time", "0.05"))):
                self.begin_anew(journal)
                result = self.limited(size, *words)
                context = (size, words, result.returncode, result.stderr)
                self.assertIn(result.returncode, (0, 74, 124), context)
                self.assert_whole_or_nothing(result.returncode, context)
                self.assertEqual(self.hidden(), [], context)
                if result.returncode == 74:
                    refused += 1
                    self.assertIn("free some space", result.stderr)
                    if self.journal.exists():
                        self.assertIn(f"the finished points are in '{self.journal}'", result.stderr)
                if journal is not None and not self.output.exists():
                    self.assertTrue(self.journal.read_bytes().startswith(journal), context)
                self.assert_completes(context)
        self.assertGreater(refused, sizes)

    def test_a_small_disk_that_is_really_full_loses_nothing(self):
        needed = len(self.whole) // 1024
        stop = self.stop_on_its_way()
        for kibibytes in (4, 16, needed // 4, needed // 2, needed - 4, needed + needed // 4):
            with self.small_disk(kibibytes) as disk:
                output, journal, before, done = disk / "a.h5", disk / "a.h5.journal", b"", False
                for words in (stop, stop, ()):
                    result = self.run_command(*words, threads=1, output=output)
                    context = (kibibytes, words, result.returncode, result.stderr)
                    self.assertIn(result.returncode, (0, 74, 124), context)
                    if kibibytes == 4:  # less than the results take without their log
                        self.assertRegex(
                            result.stderr, r"not enough disk space: the results take \S+ KiB beside '\S+', .* are free"
                        )
                    done = done or result.returncode == 0
                    self.assertEqual(output.exists(), done, context)
                    self.assertTrue(not done or output.read_bytes() == self.whole, context)
                    self.assertEqual([path for path in disk.iterdir() if path.suffix == ".tmp"], [], context)
                    saved = journal.read_bytes() if journal.exists() else b""
                    self.assertTrue(done or saved.startswith(before), context)
                    before = saved
                if saved and not done:  # the way out: a larger place
                    self.begin_anew(saved)
                    self.assert_completes(context)

    def test_a_disk_that_lacks_little_without_its_journal_keeps_the_journal(self):
        """Its room is given to the output if that is enough, else it isn't."""
        journals = [journal for journal in self.journals() if len(journal) < len(self.whole)]
        for journal in journals[:: -(-len(journals) // 12)]:
            with self.small_disk(len(self.whole) // 1024 - 4) as disk:
                (disk / "a.h5.journal").write_bytes(journal)
                result = self.run_command(threads=1, output=disk / "a.h5")
                self.assertEqual(result.returncode, 74, result.stderr)
                self.assertTrue((disk / "a.h5.journal").read_bytes().startswith(journal), (len(journal), result.stderr))

    def test_a_disk_that_holds_the_output_and_not_its_journal_is_enough(self):
        larger = ("--set", "observe.trajectory=100")
        self.begin_anew()
        self.assertEqual(self.run_command(*larger).returncode, 0)
        whole = self.output.read_bytes()
        self.begin_anew()
        self.stop_on_its_way(*larger)
        with self.small_disk(len(whole) * 5 // 4 // 1024) as disk:
            shutil.copy(self.journal, disk / "a.h5.journal")
            result = self.run_command(*larger, "--resume", output=disk / "a.h5")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual((disk / "a.h5").read_bytes(), whole)
            self.assertEqual([path.name for path in disk.iterdir()], ["a.h5"])

    def test_an_output_that_was_there_stays_until_the_new_one_is_whole(self):
        self.assertEqual(self.run_command("--set", "scene.R=0.5").returncode, 0)
        before = self.output.read_bytes()
        result = self.limited(len(self.whole) // 2)
        self.assertEqual(result.returncode, 74)
        self.assertEqual(self.output.read_bytes(), before)
        self.assertEqual(self.hidden(), [])
        self.assert_completes("")

    def test_places_that_cannot_be_written_are_refused_before_anything_runs(self):
        closed = self.directory / "closed"
        closed.mkdir(mode=0o555)
        program = self.directory / "clatter"
        shutil.copy(CLATTER, program)
        self.directory.chmod(0o755)
        as_nobody = {"user": 65534, "group": 65534} if os.geteuid() == 0 else {}
        for output, reason in (
            (closed / "a.h5", "ermission denied"),
            (self.directory / "none" / "a.h5", "mkdir -p"),
            (closed, "is a directory"),
            ("/dev/full", "is not a regular file"),
            ("/dev/stdout", "'/dev/stdout': is not a regular file"),  # a pipe
            ("", "empty name"),
        ):
            command = self.command(output=output)
            command[0] = program
            if output == "":
                command[command.index("-o") + 1] = ""
            result = subprocess.run(command, capture_output=True, text=True, **as_nobody)
            self.assertEqual(result.returncode, 74, (output, result.stderr))
            self.assertIn(reason, result.stderr)
        self.assertEqual(list(closed.iterdir()), [])
        closed.rmdir()
        program.unlink()
        self.assertEqual(self.files(), ["a.toml"])

    @unittest.skipIf(SANITIZED, "a sanitizer needs threads of its own")
    def test_threads_that_cannot_be_started_are_no_success(self):
        program = self.directory / "clatter"
        shutil.copy(CLATTER, program)
        self.directory.chmod(0o777)
        as_nobody = {"user": 65534, "group": 65534} if os.geteuid() == 0 else {}
        for processes in (1, 2):
            command = self.command(threads=4)
            command[0] = program
            result = subprocess.run(
                command,
                capture_output=True,
                text=True,
                timeout=LONGEST,
                **as_nobody,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NPROC, (processes, processes)),
            )
            self.assertEqual(result.returncode, 74, result.stderr)
            self.assertIn("ulimit -u", result.stderr)
            self.assertFalse(self.output.exists())
            self.journal.unlink(missing_ok=True)

    @unittest.skipIf(SANITIZED, "a sanitizer reserves all addresses")
    def test_memory_that_runs_out_is_an_error_and_leaves_nothing(self):
        words = ("--set", "sweep.nu=linspace(0.5,1.5,3000)", "--set", "sweep.xs=linspace(0.2,4,3000)")
        result = subprocess.run(
            self.command(*words),
            capture_output=True,
            text=True,
            timeout=300,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (2**29, 2**29)),
        )
        self.assertEqual(result.returncode, 74, result.stderr)
        self.assertRegex(
            result.stderr,
            r"not enough memory: 9000000 points take \S+ MiB with an impact log of some \S+ MiB and map files of \S+ "
            r"GiB, ulimit -v leaves \S+ MiB; .*--shard",
        )
        self.assertEqual(self.files(), ["a.toml"])

    def test_a_sweep_that_no_disk_holds_is_refused_with_the_numbers(self):
        words = (
            "--set",
            "sweep.nu=linspace(0.5,1.5,1000)",
            "--set",
            "sweep.xs=linspace(0.2,4,1000)",
            "--set",
            "observe.trajectory=1000000",
        )
        result = self.run_command(*words)
        self.assertEqual(result.returncode, 74, result.stderr)
        self.assertRegex(
            result.stderr,
            r"not enough disk space: the results take \S+ TiB beside '\S+a\.h5', \S+ [GT]iB are free there; free some",
        )
        self.assertEqual(self.files(), ["a.toml"])


if __name__ == "__main__":
    unittest.main()
