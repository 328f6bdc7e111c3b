"""Files that the program makes, and the tables that `clatter export` prints of them."""

import csv
import io

import h5py

from command_line import CommandLine


class ExportedFiles(CommandLine):
    def made(self, text, name="a.h5", command="run"):
        self.write("a.toml", text)
        done = self.clatter(command, "a.toml", "-q", "-o", name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return h5py.File(self.directory / name)

    def table(self, *words):
        done = self.clatter("export", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]
        return list(csv.DictReader(io.StringIO("\n".join(lines))))
