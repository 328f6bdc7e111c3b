"""Shards and merge: one set of bytes however a sweep is shared out, run and stopped.

Anything else is an error that names the remedy.
"""

import os
import re
import subprocess
import sys
import unittest

from command_line import CLATTER, LONGEST, SANITIZED, SMALL, SOURCE
from stopped_runs import StoppedRuns


class Shards(StoppedRuns):
    stops = 0  # of runs that had finished something

    def shard(self, number, of, *words, interrupted=False, **more):
        """Runs a shard; returns its file."""
        output = self.directory / f"a.{number}-of-{of}.h5"
        share = ("--shard", f"{number}/{of}", *words)
        if interrupted:
            self.stops += self.in_steps(*share, output=output, **more)
        else:
            result = self.run_command(*share, output=output, **more)
            self.assertEqual(result.returncode, 0, result.stderr)
        return output

    def merge(self, shards, *words):
        return subprocess.run(
            [CLATTER, "merge", "-o", self.output, *shards, *words], capture_output=True, text=True, timeout=LONGEST
        )

    def merged(self, shards):
        result = self.merge(shards)
        self.assertEqual(result.returncode, 0, result.stderr)
        content = self.output.read_bytes()
        for path in (self.output, *shards):
            path.unlink()
        self.assertEqual(self.files(), ["a.toml"])
        return content

    def assert_not_merged(self, shards, *words):
        """Exit code 74, every one of the words on stderr, and the directory as it was."""
        before = self.files()
        result = self.merge(shards)
        self.assertEqual(result.returncode, 74, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(self.files(), before)

    def test_one_set_of_bytes_for_every_sharing_thread_count_and_interruption(self):
        self.sweep(nu=30, xs=20)
        whole = self.undisturbed()
        for of in (1, 2, 3, 7):
            for threads in (1, 3):
                for interrupted in (False, True):
                    shards = [self.shard(k, of, threads=threads, interrupted=interrupted) for k in reversed(range(of))]
                    self.assertEqual(self.merged(shards), whole, (of, threads, interrupted))
        self.assertGreater(self.stops, 0)

    def test_between_soft_stops_the_bytes_are_the_same_too(self):
        for follow in ("", "nu"):
            self.sweep(nu=12, xs=10, follow=follow)
            text = re.sub(r"(?m)^R = .*$", "stop_stiffness = 60.0\nstop_damping = 0.1", self.config.read_text())
            self.config.write_text(text)
            whole = self.undisturbed()
            shards = [self.shard(k, 3, threads=1 + k, interrupted=k == 1) for k in range(3)]
            self.assertEqual(self.merged(shards), whole, follow)

    def test_shards_take_whole_branches_along_a_followed_axis(self):
        for follow in ("nu", "xs"):
            self.sweep(nu=12, xs=10, follow=follow)
            whole = self.undisturbed()
            shards = [self.shard(k, 4, threads=1 + k % 3, interrupted=k == 2) for k in range(4)]
            self.assertEqual(self.merged(shards), whole, follow)

    def test_linked_axes_are_merged_as_coordinates(self):
        self.config = self.directory / self.write(
            "a.toml",
            SMALL.replace("f = -1.0\n", "")
            .replace("[observe]", 'f = "linspace(-1, -2, 5)"\nR = [0.5, 0.7]\nlinked = "nu, f"\n[observe]')
            .replace("R = 0.7\n", ""),
        )
        whole = self.undisturbed()
        self.assertIn(b"coordinates", whole)
        self.assertEqual(self.merged([self.shard(k, 3) for k in range(3)]), whole)

    def test_shards_of_different_counts_merge_if_they_make_a_whole(self):
        self.sweep(nu=10, xs=7)
        whole = self.undisturbed()
        self.assertEqual(self.merged([self.shard(1, 4), self.shard(0, 2), self.shard(3, 4)]), whole)

    def test_more_shards_than_points_leave_some_empty(self):
        self.sweep(nu=3, xs=1)
        whole = self.undisturbed()
        self.assertEqual(self.merged([self.shard(k, 5) for k in range(5)]), whole)
        self.assertEqual(self.merged([self.shard(k, 5) for k in range(3)]), whole)  # nothing is missing

    def test_a_shard_without_axes_is_the_one_point(self):
        self.config = self.directory / self.write(
            "a.toml", SMALL.replace("[sweep]", "").replace('nu = "linspace(0.5, 1.5, 5)"', "")
        )
        whole = self.undisturbed()
        self.assertEqual(self.merged([self.shard(0, 1)]), whole)

    def test_the_file_is_named_by_its_share(self):
        self.sweep(nu=3, xs=2)
        result = self.clatter("run", "a.toml", "--shard", "1/2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.files(), ["a.1-of-2.h5", "a.toml"])

    def test_missing_shards_are_named_with_the_remedy(self):
        self.sweep(nu=10, xs=10)
        shards = {k: self.shard(k, 8) for k in (0, 1, 2, 4, 5, 7)}
        self.assert_not_merged(
            shards.values(),
            "shard 3/8: 13 points missing: rerun with --shard 3/8",
            "shard 6/8: 12 points missing: rerun with --shard 6/8",
        )
        self.assert_not_merged([shards[0]], "shard 1/8: 13 points", "and 2 more shards")
        self.assert_not_merged([self.shard(1, 2), shards[0], shards[4]], "shard 2/8: 13 points", "shard 6/8: 12 points")

    def test_points_that_are_there_twice_are_refused(self):
        self.sweep(nu=4, xs=2)
        two = [self.shard(k, 2) for k in range(2)]
        self.assert_not_merged([*two, two[0]], "in common (shards 0/2 and 0/2)")
        self.assert_not_merged([*two, self.shard(3, 4)], "in common", "1/2", "3/4")
        self.assert_not_merged([*two, self.shard(2, 3)], "in common")

    def test_shards_of_another_sweep_are_refused_with_the_difference(self):
        self.sweep(nu=4, xs=2)
        shards = [self.shard(0, 2), self.shard(1, 2, "--set", "scene.R=0.6")]
        self.assert_not_merged(shards, "different configurations", "R = 0.7", "R = 0.6")

    def test_shards_of_another_instruction_set_are_refused(self):
        self.sweep(nu=4, xs=2)
        self.assert_not_merged(
            [self.shard(0, 2), self.shard(1, 2, arch="scalar")], "rounded differently (scalar, ", "--arch"
        )

    def test_every_damage_of_a_shard_is_found(self):
        self.sweep(nu=4, xs=2)
        shards = [self.shard(k, 2) for k in range(2)]
        content = shards[1].read_bytes()
        for place in range(0, len(content), max(1, len(content) // 200)):
            shards[1].write_bytes(content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :])
            self.assert_not_merged(shards, "a.1-of-2.h5")
        for length in (0, 1, 60, len(content) // 2, len(content) - 1):
            shards[1].write_bytes(content[:length])
            self.assert_not_merged(shards, "a.1-of-2.h5")
        shards[1].write_bytes(content + b"\0")
        self.assert_not_merged(shards, "a.1-of-2.h5")
        shards[1].write_bytes(content)
        self.assertEqual(self.merge(shards).returncode, 0)

    def test_other_files_than_shards_are_refused(self):
        self.sweep(nu=4, xs=2)
        whole = self.directory / "whole.h5"
        self.run_command(output=whole)
        self.assert_not_merged([whole], "is not a complete shard")
        self.assert_not_merged([self.config], "is not a complete shard")
        self.assert_not_merged([self.directory], "is a directory")
        self.assert_not_merged([self.directory / "none.h5"], "No such file")
        self.assert_refused(2, "SHARD.h5 is missing", "merge", "-o", "a.h5")
        self.assert_refused(2, "name it with -o", "merge", "whole.h5")
        self.assert_refused(74, "no directory", "merge", "-o", "none/a.h5", "whole.h5")
        shard = self.shard(0, 1)
        self.assert_refused(2, "is one of the shards", "merge", "-o", shard.name, shard.name)

    def test_a_shard_opens_like_any_output_and_is_not_drawn(self):
        self.sweep(nu=4, xs=3)
        shard = self.shard(1, 2)
        read = (
            "import h5py, sys; f = h5py.File(sys.argv[1]); "
            "print(f.attrs['shard'], list(f['point']), f['x_max'].dims[0].keys())"
        )
        said = subprocess.run(
            [sys.executable, "-c", read, shard], capture_output=True, text=True
        )  # h5py here would count as memory of runs
        self.assertEqual(said.stdout, "1/2 [1, 3, 5, 7, 9, 11] ['point']\n", said.stderr)
        info = self.clatter("info", shard)
        self.assertIn("[point = 6]", info.stdout)
        drawn = subprocess.run([sys.executable, SOURCE / "scripts" / "plot.py", shard], capture_output=True, text=True)
        self.assertEqual(drawn.returncode, 74)
        self.assertIn("shard 1/2 of a sweep; join all with 'clatter merge' first", drawn.stderr)

    def test_wrong_shares_are_refused(self):
        small = self.write("s.toml", SMALL)
        for wrong in ("", "1", "8/8", "-1/8", "1/0", "a/b", "1/8/2", "0/1000001"):
            self.assert_refused(2, "--shard", "run", small, f"--shard={wrong}")

    def test_failed_points_end_with_1_in_the_shard_and_in_the_merge(self):
        self.config = self.directory / self.write(
            "a.toml", SMALL.replace("xs = -4.0", "xs = 0.1") + "[time]\nmax_impacts = 1\n"
        )
        for k in range(2):
            self.assertEqual(self.run_command("--shard", f"{k}/2", output=self.directory / f"{k}.h5").returncode, 1)
        result = self.merge([self.directory / "0.h5", self.directory / "1.h5"])
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("5 failed", result.stderr)

    @unittest.skipIf(SANITIZED, "a sanitizer takes memory of its own")
    def test_memory_is_that_of_the_share_and_of_a_merge_as_forecast(self):
        self.config = self.directory / self.write(
            "a.toml", SMALL.replace("xs = -4.0", "xs = 400.0").replace("1.5, 5)", "1.5, 300000)")
        )
        base = peak_bytes([CLATTER, "--version"])
        whole = peak_bytes(self.command(output=self.directory / "whole.h5")) - base
        shards = [self.directory / f"{k}.h5" for k in range(4)]
        for number, path in enumerate(shards):
            self.assertLess(peak_bytes(self.command("--shard", f"{number}/4", output=path)) - base, whole / 2)
        said = self.merge(shards, "-v").stderr
        told = float(re.search(r"memory +(\S+) MiB", said)[1]) * 2**20
        used = peak_bytes([CLATTER, "merge", "-q", "-o", self.output, *shards]) - base
        self.assertLess(used, told + 8e6, said)
        self.assertGreater(used + base, told / 2, said)


def peak_bytes(command):
    """The most memory that a command has held."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, command
    return usage.ru_maxrss * 1024


if __name__ == "__main__":
    unittest.main()
