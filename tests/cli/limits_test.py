"""Limits of the system: each that is too narrow is named, and ends the program with 74; no signal ends it."""

import os
import pathlib
import resource
import subprocess
import tempfile
import unittest

from command_line import CLATTER, LONGEST, SANITIZED, SMALL, CommandLine

# The environment stands on the stack: the user's may be longer than a small one.
SHORT = {name: os.environ[name] for name in ("PATH", "LD_LIBRARY_PATH") if name in os.environ}
NOTHING_OBSERVED = """[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -400.0
[sweep]
nu = "linspace(0.5, 1.5, {points})"
[time]
mode = "transient"
duration = 0.1
"""


class Limits(CommandLine):
    def setUp(self):
        super().setUp()
        self.config = self.write("a.toml", SMALL)

    def within(self, limit, value, *words, environment=None, **more):
        """Runs a command within a soft limit; `stderr` may be a file."""

        def lower():
            resource.setrlimit(limit, (value, resource.getrlimit(limit)[1]))

        more = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **more}
        return subprocess.run(
            [CLATTER, *words],
            cwd=self.directory,
            text=True,
            timeout=LONGEST,
            preexec_fn=lower,
            env=SHORT if environment is SHORT else {**os.environ, **(environment or {})},
            **more,
        )

    def assert_said(self, result, words):
        self.assertEqual(result.returncode, 74, (words, result.stderr))
        self.assertRegex(result.stderr, words)
        self.assertNotIn("a bug", result.stderr)


class OpenFiles(Limits):
    @unittest.skipIf(SANITIZED, "a sanitizer opens files of its own")
    def test_too_few_are_named_by_every_command(self):
        self.assertEqual(self.clatter("run", self.config, "-o", "there.h5").returncode, 0)
        for k in range(2):
            self.assertEqual(self.clatter("run", self.config, "-o", f"{k}.h5", "--shard", f"{k}/2").returncode, 0)
        before = self.files()
        commands = (
            ["run", self.config, "-o", "new.h5"],
            ["run", self.config, "-o", "there.h5"],
            ["info", "there.h5"],
            ["accuracy", self.config, "-o", "there.h5"],
            ["merge", "-o", "new.h5", "0.h5", "1.h5"],
        )
        refused = {}
        for command in commands:
            for files in range(4, 12):  # from 4 on the program can load its libraries
                result = self.within(resource.RLIMIT_NOFILE, files, *command)
                if "ulimit -n" not in result.stderr:
                    break
                self.assert_said(result, rf"too many open files \(ulimit -n is {files}\); raise it")
                self.assertEqual(self.files(), before)
                refused[tuple(command)] = files
            self.assertIn(result.returncode, (0, 74), result.stderr)
            self.assertNotIn("no output of clatter", result.stderr)
            (self.directory / "new.h5").unlink(missing_ok=True)
        self.assertEqual(len(refused), len(commands), refused)


class Stacks(Limits):
    @unittest.skipIf(SANITIZED, "a sanitizer needs a stack of its own")
    def test_of_the_main_thread(self):
        for kibibytes in (48, 64, 256):  # with much less, the kernel or the loader may end the process first
            for command in (["run", self.config], ["plan", self.config], ["accuracy", self.config], ["info", "a.h5"]):
                result = self.within(resource.RLIMIT_STACK, kibibytes * 1024, *command, environment=SHORT)
                self.assert_said(result, rf"ulimit -s permits {kibibytes} KiB, 512 KiB are needed; raise it")
        self.assertEqual(self.files(), ["a.toml"])

    @unittest.skipIf(SANITIZED, "a sanitizer makes frames larger")
    def test_that_suffice_suffice(self):
        everything = [f"--set=observe.{name}=true" for name in ("impacts", "impact_log", "stability", "period")]
        everything += ["--set=observe.harmonics=5", "--set=observe.trajectory=100", "--set=scene.xs=2", "--threads=3"]
        for method in ("exact", "dopri5", "moreau"):
            words = ("run", self.config, "--force", f"--set=integrator.method={method}", *everything)
            result = self.within(resource.RLIMIT_STACK, 512 * 1024, *words)
            self.assertEqual(result.returncode, 0, result.stderr)
            result = self.clatter(*words, environment={"OMP_STACKSIZE": "512k"})
            self.assertEqual(result.returncode, 0, result.stderr)
        result = self.within(
            resource.RLIMIT_STACK,
            512 * 1024,
            "accuracy",
            self.config,
            "-q",
            "--rounds=1",
            "--set=sweep.nu=1",
            "--set=time.mode=transient",
            "--set=time.duration=20",
        )
        self.assertEqual(result.returncode, 0, result.stderr)

    @unittest.skipIf(SANITIZED, "a sanitizer needs a stack of its own")
    def test_of_the_other_threads(self):
        for variable, size in (("OMP_STACKSIZE", 64), ("GOMP_STACKSIZE", 64), ("OMP_STACKSIZE", 256)):
            for arch in ("scalar", "sse2"):
                result = self.clatter(
                    "run", self.config, "--threads", "3", "--arch", arch, environment={variable: f"{size}k"}
                )
                self.assert_said(
                    result, rf"{variable} gives it {size} KiB, 512 KiB are needed; unset {variable}, or set it to 8M"
                )
                self.assertEqual(self.files(), ["a.toml"])
        alone = self.clatter("run", self.config, "--threads", "1", environment={"OMP_STACKSIZE": "64k"})
        self.assertEqual(alone.returncode, 0, alone.stderr)


class FileSizes(Limits):
    def test_stderr_in_a_file_that_may_not_grow_leaves_the_exit_code_of_the_run(self):
        for words, code in (((), 0), (("--set", "time.max_impacts=1", "--set", "scene.xs=0.1"), 1)):
            log = self.directory / "log"
            size = 64 * 1024
            log.write_bytes(bytes(size))
            with open(log, "a") as stderr:
                result = self.within(
                    resource.RLIMIT_FSIZE,
                    size,
                    "run",
                    self.config,
                    "-v",
                    "--progress",
                    "always",
                    "--force",
                    *words,
                    stderr=stderr,
                )
            self.assertEqual(result.returncode, code)
            self.assertEqual(log.read_bytes(), bytes(size))
            self.assertTrue((self.directory / "a.h5").exists())

    def test_stdout_in_such_a_file_is_an_error(self):
        with open(self.directory / "out", "w") as stdout:
            result = self.within(resource.RLIMIT_FSIZE, 10, "plan", self.config, stdout=stdout)
        self.assert_said(result, "standard output cannot be written")


@unittest.skipIf(SANITIZED, "a sanitizer reserves all addresses")
class Memory(Limits):
    def run_within(self, limit, value, points, *words):
        config = self.write("large.toml", NOTHING_OBSERVED.format(points=points))
        return self.within(limit, value, "run", config, "-o", "large.h5", "--threads", "2", *words)

    def test_ulimit_v_and_d_are_seen_before_anything_runs(self):
        for limit, letter in ((resource.RLIMIT_AS, "v"), (resource.RLIMIT_DATA, "d")):
            result = self.run_within(limit, 200 << 20, 10**7)
            self.assert_said(
                result,
                rf"not enough memory: 10000000 points take \S+ MiB, ulimit -{letter} leaves \S+ MiB; sweep fewer "
                "points, observe less, divide the sweep with --shard",
            )
            self.assertEqual(self.files(), ["a.toml", "large.toml"])

    def test_whatever_ulimit_v_is_a_run_is_refused_or_done_or_says_that_memory_ran_out(self):
        codes = []
        starts = (size for size in range(16, 64) if self.within(resource.RLIMIT_AS, size << 20, "help").returncode == 0)
        least = next(starts)  # in which the program itself has room; in less a library ends it before main
        for mebibytes in (least, least + 2, least + 7, 48, 56, 64, 72, 80, 88, 96, 104, 112, 128, 160):
            result = self.run_within(resource.RLIMIT_AS, mebibytes << 20, 10**6)
            codes.append(result.returncode)
            if result.returncode != 0:
                self.assert_said(result, "not enough memory: |ulimit -v")
                if "large.h5.journal" in self.files():  # it ran out after the first save, which a slow machine reaches
                    self.assertEqual(self.clatter("run", "large.toml", "-o", "large.h5", "--resume").returncode, 0)
                    (self.directory / "large.h5").unlink()
                self.assertEqual(self.files(), ["a.toml", "large.toml"])
            (self.directory / "large.h5").unlink(missing_ok=True)
        self.assertEqual(codes, sorted(codes, reverse=True))
        self.assertEqual(set(codes), {0, 74})

    def test_a_merge_is_refused_in_the_same_form(self):
        config = self.write("large.toml", NOTHING_OBSERVED.format(points=4 * 10**6))
        for k in range(2):
            self.assertEqual(self.clatter("run", config, "-o", f"{k}.h5", "--shard", f"{k}/2").returncode, 0)
        result = self.within(resource.RLIMIT_AS, 112 << 20, "merge", "-o", "whole.h5", "0.h5", "1.h5")
        self.assert_said(
            result, r"not enough memory: merging takes \S+ MiB, ulimit -v leaves \S+ MiB; sweep fewer points"
        )
        self.assertFalse((self.directory / "whole.h5").exists())

    def test_a_control_group_is_seen(self):
        group = self.small_group(64 << 20)
        config = self.write(
            "large.toml",
            NOTHING_OBSERVED.format(points=1000).replace("[time]", 'load = "linspace(0, 1, 4000)"\n[time]'),
        )
        result = subprocess.run(
            ["sh", "-c", f'echo $$ > "{group}/cgroup.procs" && exec "$@"', "sh", CLATTER, "run", config],
            cwd=self.directory,
            capture_output=True,
            text=True,
            timeout=LONGEST,
        )
        self.assert_said(
            result, r"not enough memory: 4000000 points take \S+ MiB, its control group '\S+' permits 64 MiB;"
        )

    def small_group(self, size):
        """A control group of this much memory, of whichever version is here."""
        reasons = []
        for line in pathlib.Path("/proc/self/mountinfo").read_text().splitlines():
            place, kind = line.split()[4], line.split(" - ")[1].split()
            file = {"cgroup": "memory.limit_in_bytes", "cgroup2": "memory.max"}.get(kind[0])
            if file is None or (kind[0] == "cgroup" and "memory" not in kind[2].split(",")):
                continue
            try:
                group = pathlib.Path(tempfile.mkdtemp(prefix="clatter-test-", dir=place))
                self.addCleanup(group.rmdir)
                (group / file).write_text(str(size))
                return group
            except OSError as error:
                reasons.append(str(error))
        return self.skipTest(
            "no control group with a limit of memory can be made here; as root, with /sys/fs/cgroup writable and its "
            f"memory controller on, it can ({'; '.join(reasons) or 'none is mounted'})"
        )

    def test_memory_that_runs_out_all_the_same_names_the_journal(self):
        """A log that no estimate sees: of a hundred points, one that isn't looked at for it has all the impacts."""
        speeds = ", ".join(["0.0"] * 99 + ["10.0"])
        config = self.write(
            "log.toml",
            f"""[scene]
f = 0.0
h = 0.0
R = 1.0
xs = 0.01
[sweep]
v0 = [{speeds}]
[time]
mode = "transient"
duration = 5000.0
[observe]
impact_log = true
""",
        )
        result = self.within(resource.RLIMIT_AS, 100 << 20, "run", config, "--threads", "1", "--progress", "never")
        self.assert_said(result, "not enough memory: it ran out; sweep fewer points")
        self.assertRegex(result.stderr, "the finished points are in '.*log.h5.journal'; the same command continues")
        self.assertEqual(self.files(), ["a.toml", "log.h5.journal", "log.toml"])
        result = self.clatter("run", config)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("goes on from", result.stderr)


if __name__ == "__main__":
    unittest.main()
