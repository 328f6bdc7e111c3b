"""`clatter export`: CSV that holds the values of the file bit for bit, and that others read.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import csv
import io
import subprocess
import unittest

import h5py
import numpy as np
import pandas

from branch_runs import BRANCH, SCENE
from command_line import CLATTER, SMALL, SOURCE, CommandLine

LOGGED = """[scene]
f = -1.0
h = 0.1
R = 0.7
[sweep]
nu = [0.9, 1.0]
xs = [-0.5, -9.0]
[observe]
impact_log = true
extrema = true
impacts = true
harmonics = 2
section = 2
word = true
"""
MACHINE = """[machine]
mass = "500 g"
stiffness = "12.8 kN/m"
force = "12.8 N"
damping = "16 N s/m"
[sweep]
frequency = ["15 Hz", "20 Hz", "25 Hz"]
gap = ["1 mm", "1.5 mm", "2 mm"]
[observe]
extrema = true
"""


class Export(CommandLine):
    def export(self, *words):
        result = self.clatter("export", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        return result.stdout

    def table(self, *words):
        return pandas.read_csv(io.StringIO(self.export(*words)), comment="#", float_precision="round_trip")

    def run_text(self, name, text, *words):
        self.assertEqual(self.clatter("run", self.write(f"{name}.toml", text), "-q", *words).returncode, 0)
        return f"{name}.h5"

    def test_every_value_of_shipped_outputs_is_there_bit_for_bit(self):
        for name in ("fig13", "fig18", "fig22", "follow_up", "hysteresis", "one_stop", "stability"):
            with self.subTest(name):
                path = self.directory / f"{name}.h5"
                subprocess.run([CLATTER, "run", SOURCE / "configs" / f"{name}.toml", "-o", path, "-q"], check=True)
                table = self.table(path)
                with h5py.File(path) as file:
                    self.assert_values(file, table)

    def assert_values(self, file, table):
        shape, seen = file["status"].shape, set()
        for name, item in file.items():
            if (
                item.shape[: len(shape)] != shape
                or item.dtype == object
                or name == "status"
                or name not in str(table.columns)
            ):
                continue
            parts = item[()].reshape(int(np.prod(shape)), -1)
            columns = [column for column in table.columns if column.partition("[")[0] == name]
            if h5py.h5ds.is_scale(item.id) or not columns:
                continue
            self.assertEqual(len(columns), parts.shape[1], name)
            for part, column in enumerate(columns):
                values = table[column].to_numpy(float)
                np.testing.assert_array_equal(
                    values.view("u8") & ~(np.isnan(values) * (2**64 - 1)).astype("u8"),
                    np.where(np.isnan(values), 0, parts[:, part].astype(float).view("u8")),
                )
                seen.add(name)
        self.assertGreater(len(seen), 4)

    def test_columns_rows_and_words(self):
        path = self.run_text("a", LOGGED)
        text = self.export(path)
        header = next(csv.reader([next(line for line in text.splitlines() if not line.startswith("#"))]))
        self.assertEqual(header[:2], ["nu", "xs"])
        self.assertEqual(header[-3:], ["impact_word", "regime", "status"])  # texts behind all numbers, for gnuplot
        for name in ("v_before[-1]", "v_before[1]", "x_amplitude[0]", "x_amplitude[2]", "section_x[1]", "impact_word"):
            self.assertIn(name, header)
        table = self.table(path)
        self.assertEqual(table["nu"].tolist(), [0.9, 0.9, 1.0, 1.0])
        self.assertEqual(table["xs"].tolist(), [-0.5, -9.0, -0.5, -9.0])
        self.assertEqual(table["status"].tolist(), ["periodic"] * 4)
        self.assertEqual(table["impact_word"].fillna("").tolist(), ["LU", "-", "LU", "-"])
        self.assertIn("# x_phase (rad): ", text)

    def test_only_and_where(self):
        path = self.run_text("a", LOGGED)
        table = self.table(path, "--only", "x_max,v_before[-1]", "--where", "nu=1.0")
        self.assertEqual(list(table.columns), ["nu", "xs", "x_max", "v_before[-1]"])
        self.assertEqual(table["nu"].tolist(), [1.0, 1.0])
        one = self.table(path, "--only", "x_max", "--only", "status", "--where", "nu=0.9", "--where", "xs=-0.5")
        self.assertEqual((len(one), one["x_max"][0]), (1, 0.5))

    def test_only_may_name_an_axis(self):
        table = self.table(self.run_text("a", LOGGED), "--only", "nu,x_max")
        self.assertEqual(list(table.columns), ["nu", "xs", "x_max"])
        table = self.table(self.follow(), "--only", "nu,x_max")
        self.assertEqual(list(table.columns), ["branch", "nu", "x_max"])

    def test_where_tells_a_rigid_stop_from_soft_ones(self):
        path = self.run_text(
            "a", LOGGED.replace("R = 0.7\n", "").replace("nu = [0.9, 1.0]", "stop_stiffness = [9, 80, inf]")
        )
        for stiffness, rows in (("inf", [np.inf, np.inf]), ("80", [80.0, 80.0])):
            table = self.table(path, "--only", "x_max", "--where", f"stop_stiffness={stiffness}")
            self.assertEqual(table["stop_stiffness"].tolist(), rows)

    def test_gnuplot_reads_numbers_by_their_columns(self):
        path = self.run_text("a", LOGGED)
        table = self.table(path)
        numbers = [name for name in table.columns if table[name].dtype.kind in "fi"]
        self.assertEqual(list(table.columns[: len(numbers)]), numbers)
        self.assertGreater(len(numbers), 10)

    def test_where_takes_units_as_configurations_do(self):
        path = self.run_text("si", MACHINE)
        for where, gap in (("gap=1.5 mm", 0.0015), ("gap=0.2 cm", 0.002), ("gap=0.0015", 0.0015)):
            table = self.table(path, "--only", "x_max", "--where", where)
            self.assertEqual(table["gap"].tolist(), [gap] * 3)
        table = self.table(path, "--where", "frequency=40*pi rad/s", "--where", "gap=2 mm")
        self.assertEqual(table["frequency"].tolist(), [20.0])
        plain = self.run_text("plain", LOGGED)
        for path, where, words in (
            (path, "gap=3 Hz", "--where gap: the unit 'Hz' doesn't fit: 'gap' in 'si.h5' is in m"),
            (path, "gap=3 foo", "--where 'gap=3 foo': unknown unit 'foo'"),
            (path, "gap=3 mm", "--where gap=0.003: the axis has no such value; the nearest are 0.002 and 0.0015"),
            (plain, "xs=0.5 mm", "the unit 'mm' doesn't fit: 'xs' in 'plain.h5' has none; give the number alone"),
            (plain, "xs", "--where 'xs'; expected e.g. nu=1.0,"),
            (plain, "xs=a", "--where xs=a: 'xs' is a number; expected one"),
        ):
            self.assert_refused(2, words, "export", path, "--where", where)

    def follow(self):
        self.write("b.toml", SCENE + "[observe]\nenergy = true\n" + BRANCH)
        self.assertEqual(self.clatter("branch", "b.toml", "-q").returncode, 0)
        return "b.branch.h5"

    def test_branches_are_a_row_for_each_point(self):
        path = self.follow()
        table = self.table(path)
        self.assertEqual(list(table.columns[:3]), ["branch", "nu", "arclength"])
        self.assertEqual(list(table.columns[-2:]), ["word", "regime"])
        with h5py.File(self.directory / path) as file:
            for name in ("nu", "branch", "x_max", "impact_speed", "stable"):
                np.testing.assert_array_equal(table[name], file[name][()])
            for part in (0, 1):
                np.testing.assert_array_equal(table[f"multiplier_re[{part}]"], file["multiplier_re"][:, part])
            words = [word.decode() for word in file["word"][()]]
            first = file["branch"][()] == 0
        self.assertEqual(table["word"].fillna("").tolist(), words)
        self.assertEqual(len(self.table(path, "--where", "branch=0")), first.sum())

    def test_special_points_of_branches(self):
        path = self.follow()
        table = self.table(path, "--special")
        self.assertEqual(list(table.columns[-3:]), ["special_kind", "special_word", "special_regime"])
        with h5py.File(self.directory / path) as file:
            self.assertEqual(table["special_kind"].tolist(), [kind.decode() for kind in file["special_kind"][()]])
            np.testing.assert_array_equal(table["special_nu"], file["special_nu"][()])
            np.testing.assert_array_equal(table["special_branch[0]"], file["special_branch"][:, 0])
        plain = self.run_text("plain", SMALL)
        self.assert_refused(2, "--special: 'plain.h5' has no special points", "export", plain, "--special")
        self.assert_refused(2, "no impact log; no branch has one", "export", path, "--impacts")
        self.assert_refused(2, "--impacts conflicts with --special", "export", path, "--impacts", "--special")

    def test_a_row_for_each_impact(self):
        path = self.run_text("a", LOGGED)
        table = self.table(path, "--impacts")
        with h5py.File(self.directory / path) as file:
            counts = file["impact_count"][()].ravel()
            np.testing.assert_array_equal(table["impact_tau"], file["impact_tau"][()])
            np.testing.assert_array_equal(table["impact_stop"], file["impact_stop"][()])
        np.testing.assert_array_equal(table["xs"], np.repeat([-0.5, -9.0, -0.5, -9.0], counts))
        self.assertEqual(len(self.table(path, "--impacts", "--where", "xs=-9")), 0)

    def test_a_single_point_is_one_row(self):
        path = self.run_text("one", "[scene]\nxs = 1\nv0 = 2\n[observe]\nextrema = true\n")
        self.assertEqual(len(self.table(path)), 1)

    def test_output_file(self):
        path = self.run_text("a", LOGGED)
        self.assertEqual(self.export(path, "-o", "a.csv"), "")
        written = (self.directory / "a.csv").read_text()
        self.assertEqual(written, self.export(path))
        self.assertEqual(written, self.export(path, "-o", "-"))
        self.assert_refused(74, "cannot write 'a.csv': there is a file", "export", path, "-o", "a.csv")
        self.assert_refused(74, "name another with -o, e.g. -o a-2.csv, move", "export", path, "-o", "a.csv")
        self.assertEqual(self.export(path, "-o", "a.csv", "--force", "--only", "x_max"), "")
        self.assertNotEqual((self.directory / "a.csv").read_text(), written)

    def test_wrong_choices(self):
        path = self.run_text("a", LOGGED)
        plain = self.run_text("plain", SMALL)
        for code, words, command in (
            (2, "--only: 'x_maxx' is no column of 'a.h5'; did you mean 'x_max'?", [path, "--only", "x_maxx"]),
            (
                2,
                "'v_before[0]' is no component; there are v_before[-1], v_before[1]",
                [path, "--only", "v_before[0]"],
            ),
            (
                2,
                "--where: 'h' is neither an axis nor a result of 'a.h5'; its axes are nu, xs",
                [path, "--where", "h=1"],
            ),
            (2, "--where nu=0.95: the axis has no such value; the nearest are ", [path, "--where", "nu=0.95"]),
            (2, "'plain.h5' has no impact log; run its configuration with --set", [plain, "--impacts"]),
            (2, "is the input; name another file", [path, "-o", path]),
            (74, "No such file or directory", ["none.h5"]),
            (74, "there is no directory 'none'", [path, "-o", "none/a.csv"]),
        ):
            with self.subTest(words):
                self.assert_refused(code, words, "export", *command)
        self.assertEqual([file.name for file in self.directory.glob("*.csv")], [])

    def test_a_shard_is_merged_first(self):
        config = self.write("a.toml", LOGGED)
        self.clatter("run", config, "--shard", "0/2", "-q")
        self.assert_refused(74, "is shard 0/2 of a sweep; join all with `clatter merge`", "export", "a.0-of-2.h5")

    def test_a_closed_pipe_and_a_full_disk(self):
        path = self.run_text("a", LOGGED)
        script = f'"{CLATTER}" export {path} | head -n 1; "{CLATTER}" export {path} > /dev/full; echo $?'
        result = subprocess.run(["bash", "-c", script], cwd=self.directory, capture_output=True, text=True)
        self.assertEqual(result.stdout.splitlines()[-1], "74")
        self.assertEqual(result.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
