"""What was once accepted in silence and gave something else than was meant is refused, warned of, or done as meant."""

import subprocess
import unittest

from command_line import SMALL, SOURCE, CommandLine

SWEEP = SMALL.replace('nu = "linspace(0.5, 1.5, 5)"', "nu = [0.9, 1.1]\nR = [0.6, 0.7]\nlinked = {}")


class Accepted(CommandLine):
    def test_a_run_that_becomes_a_sweep_keeps_its_value_with_a_warning(self):
        self.write("a.toml", SMALL.replace("h = 0.1", "h = 0.1\nnu = 1.2"))
        done = self.clatter("run", "a.toml")
        self.assertEqual(done.returncode, 0)
        said = "a.toml:5:1: warning: 'nu' has no effect beside its axis in [sweep], a.toml:9:1; leave one of them out\n"
        self.assertIn(said, done.stderr)
        self.write("b.toml", SMALL)
        self.assertEqual(self.clatter("run", "b.toml", "-q").returncode, 0)
        configs = [self.clatter("info", name, "--config").stdout for name in ("a.h5", "b.h5")]
        self.assertEqual(*configs)

    def test_the_name_of_another_kind_of_file_is_refused_for_results(self):
        self.write("a.toml", SMALL)
        for command in ("run", "branch", "accuracy"):
            words = "-o 'result.csv': results are HDF5; write -o result.h5, and then e.g. clatter export result.h5"
            self.assert_refused(2, words, command, "a.toml", "-o", "result.csv")
        for name in ("a.txt", "b.XLSX", "c.svg", "y.toml", "y.ini"):
            self.assert_refused(2, "results are HDF5", "run", "a.toml", "-o", name)
        for name in ("plain", "results.nc", "v1.2"):
            self.assertEqual(self.clatter("run", "a.toml", "-q", "-o", name).returncode, 0)

    def test_the_name_of_another_kind_of_file_is_refused_for_tables_certificates_and_configurations(self):
        self.write("a.toml", SMALL)
        self.clatter("run", "a.toml", "-q")
        table, lines = (
            "a table is CSV, which spreadsheets open, too; write -o ",
            "certificates are JSON, one a line; write -o ",
        )
        for words, *command in (
            ("-o 'x.h5': " + table + "x.csv\n", "export", "a.h5", "-o", "x.h5"),
            ("-o 'x.xlsx': " + table + "x.csv\n", "export", "a.h5", "-o", "x.xlsx"),
            (table + "none/x.csv\n", "export", "a.h5", "-o", "none/x.JSON"),
            ("-o 'c.h5': " + lines + "c.jsonl\n", "certify", "a.h5", "-o", "c.h5"),
            (lines + "c.jsonl\n", "certify", "a.h5", "-o", "c.csv"),
            ("results are HDF5; write -o y.h5\n", "run", "a.toml", "-o", "y.toml"),
            ("results are HDF5; write -o y.h5\n", "merge", "a.h5", "-o", "y.toml"),
            ("-o 'x.h5': a configuration is TOML; write -o x.toml\n", "init", "drill", "-o", "x.h5"),
        ):
            self.assert_refused(2, words, *command)
        for *command, name in (
            ("export", "a.h5", "b.csv"),
            ("export", "a.h5", "b.dat"),
            ("export", "a.h5", "v1.2"),
            ("certify", "a.h5", "b.jsonl"),
            ("certify", "a.h5", "b.json"),
            ("init", "drill", "b.toml"),
        ):
            self.assertEqual(self.clatter(*command, "-o", name).returncode, 0, name)

    def test_the_name_of_a_picture_is_no_folder_and_a_report_is_html(self):
        self.write("a.toml", SMALL)
        self.clatter("run", "a.toml", "-q")
        for script, name, words in (
            ("plot.py", "x.svg", "'x.svg' is the name of a picture, and pictures are named by their files"),
            ("plot.py", "x.svg", "-o . --format svg"),
            ("plot.py", "none/x.PDF", "-o none --format pdf"),
            ("report.py", "x.pdf", "x.pdf: a report is a page in HTML; name it x.html"),
        ):
            before = self.files()
            command = ["/usr/bin/python3", "-B", str(SOURCE / "scripts" / script), "a.h5", "-o", name]
            done = subprocess.run(command, cwd=self.directory, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertIn(words, done.stderr)
            self.assertEqual(self.files(), before)

    def test_names_may_be_a_list_as_births_may(self):
        for index, names in enumerate(('"nu, R"', '["nu", "R"]')):
            self.write(f"{index}.toml", SWEEP.format(names) + f"sensitivity = {names}\n")
            self.assertEqual(self.clatter("run", f"{index}.toml", "-q").returncode, 0)
        texts = [self.clatter("info", f"{index}.h5", "--config").stdout for index in (0, 1)]
        self.assertEqual(*texts)
        self.write("a.ini", SWEEP.format("[nu, R]").replace('"a small sweep"', "a small sweep"))
        self.assertEqual(self.clatter("run", "a.ini", "-q").stderr, "")
        self.write("a.toml", SMALL.replace("[observe]", 'follow = ["nu"]\n[observe]'))
        self.assertEqual(self.clatter("run", "a.toml", "-q").stderr, "")
        self.write("a.toml", SWEEP.format('["nu", 3]'))
        self.assert_refused(2, "linked = the number 3; expected names of axes, in quotes", "run", "a.toml")

    def test_an_axis_has_one_value_at_a_point(self):
        self.write("a.toml", SMALL)
        self.clatter("run", "a.toml", "-q")
        words = "--where nu=0.5 beside --where nu=1.0; a point has one value of it"
        self.assert_refused(2, words, "export", "a.h5", "--where", "nu=1.0", "--where", "nu=0.5")
        self.assert_refused(2, words, "certify", "a.h5", "--where", "nu=1.0", "--where", "nu=0.5")


if __name__ == "__main__":
    unittest.main()
