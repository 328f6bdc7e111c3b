"""Merges that are killed or meet a full disk leave the shards as they were, and no output."""

import os
import resource
import signal
import subprocess
import unittest

from command_line import CLATTER
from faulty_calls import FaultyCalls, needs_shim


class FaultsOfMerges(FaultyCalls):
    def merge_of_two(self):
        """Runs both shards; returns the files that are there then, and the command that merges them."""
        shards = [self.directory / f"{number}.h5" for number in range(2)]
        for number, shard in enumerate(shards):
            self.assertEqual(self.run_command("--shard", f"{number}/2", output=shard).returncode, 0)
        return self.files(), [CLATTER, "merge", "-o", self.output, *shards]

    def test_a_merge_on_a_full_disk_leaves_the_shards_and_no_output(self):
        before, command = self.merge_of_two()
        for size in (0, 1000, len(self.whole) - 1):
            result = subprocess.run(
                command,
                capture_output=True,
                text=True,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
            )
            self.assertEqual(result.returncode, 74)
            self.assertEqual(self.files(), before)
        with self.small_disk(len(self.whole) // 2048) as disk:
            result = subprocess.run([*command[:3], disk / "a.h5", *command[4:]], capture_output=True, text=True)
            self.assertEqual(result.returncode, 74)
            self.assertRegex(result.stderr, r"not enough disk space: the merged file takes \S+ KiB beside '\S+', ")
            self.assertEqual(list(disk.iterdir()), [])
        self.assertEqual(subprocess.run(command, capture_output=True).returncode, 0)
        self.assertEqual(self.output.read_bytes(), self.whole)

    @needs_shim
    def test_a_merge_that_is_killed_leaves_the_shards_and_nothing_else(self):
        before, command = self.merge_of_two()
        killed = 0
        for call in ("write", "ftruncate", "fsync", "linkat"):
            for n in (1, 2, 5):
                faults = {"LD_PRELOAD": str(self.shim), "CLATTER_FAULT": f"{call} {n} kill"}
                result = subprocess.run(command, capture_output=True, env={**os.environ, **faults})
                if result.returncode == 0:
                    self.output.unlink()
                    continue
                killed += 1
                self.assertEqual(result.returncode, -signal.SIGKILL)
                if self.output.exists():  # it was killed while the folder was synced
                    self.assertEqual(self.output.read_bytes(), self.whole)
                    self.output.unlink()
                self.assertEqual(self.files(), before)
        self.assertGreater(killed, 5)


if __name__ == "__main__":
    unittest.main()
