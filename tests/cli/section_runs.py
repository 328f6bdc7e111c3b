"""Runs of a scene whose events fall on the section, on each instruction set."""

import h5py

from command_line import CommandLine, runs_here

ARCHITECTURES = ("scalar", *(name for name in ("sse2", "avx2", "avx512") if runs_here(name)))


class SectionRuns(CommandLine):
    def run_on(self, arch, text, name="scene"):
        done = self.clatter(
            "run", self.write(f"{name}.toml", text), "--force", "-q", environment={"CLATTER_ARCH": arch}
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return h5py.File(self.directory / f"{name}.h5")
