"""`clatter help` on results, by the list that files are made of: meaning, unit, dimensions, and when they are NaN.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import re
import unittest

import h5py
import numpy as np

from command_line import SOURCE, CommandLine

OBSERVED = """[machine]
mass = "500 g"
stiffness = "12.8 kN/m"
damping = "16 N s/m"
force = "12.8 N"
stop_stiffness = "500 kN/m"
[sweep]
frequency = ["20 Hz", "25 Hz"]
gap = ["1 mm", "2 mm"]
[observe]
extrema = true
harmonics = 2
impacts = true
impact_log = true
trajectory = 11
section = 3
word = true
period = true
stability = true
energy = true
settling = true
attractor = true
"""
MISSING = """[scene]
f = -1.0
h = 0.1
R = 0.7
[sweep]
nu = [0.3, 0.84, 1.0]
stop_upper = [0.5, 30]
[time]
max_periods = 100
max_impacts = 3000
[observe]
extrema = true
harmonics = 2
impacts = true
trajectory = 11
section = 3
word = true
period = true
stability = true
energy = true
settling = true
attractor = true
"""


class HelpOnResults(CommandLine):
    def page(self, *words):
        result = self.clatter(*words)
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        self.assertTrue(result.stdout, words)
        return result.stdout

    def results(self):
        """Command, name and meaning of every result, as `clatter help results` lists them."""
        command, results = "", []
        for line in self.page("help", "results").splitlines():
            if header := re.match(r"Files of `clatter (\w+)`", line):
                command = header[1]
            elif entry := re.match(r"  (\w+)  +(\S.*)$", line):
                results.append((command, entry[1], entry[2]))
        return results

    def test_derivatives_by_any_key_are_explained(self):
        for name, words, unit in (
            ("d_x_max_d_gap", "derivative of x_max by gap", "none"),
            ("d_impact_speed_d_gap", "derivative of impact_speed by gap", "m/s/m of a [machine], else none"),
            ("d_impact_speed_d_stiffness", "derivative of impact_speed by stiffness", "m/s/(N/m) of a [machine]"),
            ("d_period_d_damping", "derivative of period by damping", "s/(N s/m) of a [machine]"),
            ("d_x_min_d_xs", "derivative of x_min by xs", "none"),
            ("d_z_max_d_loose_gap", "derivative of z_max by loose_gap", "none"),
        ):
            page = self.page("help", name)
            self.assertTrue(page.startswith(f"{name} in files of `clatter run`\n  {words}\n"), page)
            self.assertRegex(page, rf"\n  unit +{re.escape(unit)}")
            self.assertIn("observe.sensitivity", page)
        for name in ("d_x_max_d_x0", "d_x_max_d_none", "d_none_d_gap", "d_d_gap"):
            result = self.clatter("help", name)
            self.assertEqual((result.returncode, result.stdout), (2, ""))

    def test_units_of_derivatives_are_those_that_people_write(self):
        scene = OBSERVED.split("[observe]")[0].replace("[sweep]", "R = 0.7\n[sweep]").replace("stop_stiffness", "#")
        self.write("s.toml", scene + "[observe]\nimpacts = true\nsensitivity = 'gap, stiffness, mass'\n")
        gap = "gap = '1 mm'\n"
        self.write(
            "s.toml",
            (self.directory / "s.toml")
            .read_text()
            .replace('gap = ["1 mm", "2 mm"]\n', "")
            .replace("[sweep]", gap + "[sweep]"),
        )
        self.assertEqual(self.clatter("run", "s.toml", "-o", "s.h5", "-q").returncode, 0)
        for key, unit in (("gap", "m/s/m"), ("stiffness", "m/s/(N/m)"), ("mass", "m/s/kg")):
            page = self.page("info", "s.h5", "--max", f"d_impact_speed_d_{key}")
            self.assertRegex(page, rf"\n  -?[\d.e-]+ {re.escape(unit)} at ")

    def test_every_result_is_explained(self):
        results = self.results()
        self.assertGreater(len(results), 100)
        self.assertEqual({command for command, _, _ in results}, {"run", "branch", "accuracy"})
        for command, name, meaning in results:
            with self.subTest(command=command, name=name):
                text = self.page("help", name)
                part = text[text.index(f"{name} in files of `clatter {command}`\n") :]
                self.assertIn(meaning.split(" / ")[0], part)
                self.assertLessEqual(max(map(len, text.splitlines())), 80)
                self.assertNotRegex(text, r"(?m)[ \t]$")
                self.assertRegex(part, r"(?m)^  type        (float64|u?int\d+|string)$")
                self.assertRegex(part, r"(?m)^  unit        \S")

    def test_the_help_on_a_result_says_what_the_file_of_a_run_says(self):
        self.write("a.toml", OBSERVED)
        self.assertEqual(self.clatter("run", "a.toml", "-q").returncode, 0)
        told = json.loads(self.page("info", "a.h5", "--json"))["variables"]
        names = [variable["name"] for variable in told if variable["name"] not in ("frequency", "gap")]
        self.assertGreater(len(names), 50)
        self.assertLessEqual(set(names), {name for command, name, _ in self.results() if command == "run"})
        for variable in told:
            if variable["name"] not in names:
                continue
            text = self.page("help", variable["name"])
            text = text[text.index(f"{variable['name']} in files of `clatter run`\n") :].split("\n\n")[0]
            with self.subTest(variable["name"]):
                self.assertIn(f"type        {variable['type']}\n", text)
                self.assertIn(variable["long_name"], " ".join(text.split()))
                for dimension in variable["dimensions"]:
                    if dimension not in ("frequency", "gap"):
                        self.assertRegex(text, rf"  over .*\b{dimension}\b")
                if variable["units"] != "1" and "-" not in variable["units"]:
                    self.assertRegex(text, rf"  unit +{variable['units']}\b")

    def test_what_is_missing_where_is_told_as_it_is_in_files(self):
        self.write("a.toml", MISSING)
        self.assertIn(self.clatter("run", "a.toml", "-q").returncode, (0, 1))
        with h5py.File(self.directory / "a.h5") as file:
            for name in file:
                values = file[name][()]
                if values.dtype.kind == "f" and np.isnan(values).any():
                    self.assertIn("\n  missing     NaN if ", self.page("help", name), name)
                if values.dtype.kind == "O" and b"" in values:
                    self.assertIn("\n  missing     empty if ", self.page("help", name), name)

    def test_a_status_is_explained_value_by_value(self):
        text = self.page("help", "status")
        for words in ("0 periodic       the point repeats", "19 escaped       the point failed: nothing brings"):
            self.assertIn(words, text)
        guide = (SOURCE / "src" / "results" / "README.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| (\d+) \| `(\w+)` \| ([^;:(|]+)", guide, re.MULTILINE)
        self.assertEqual(len(rows), 10)
        for value, name, meaning in rows:
            self.assertRegex(text, rf"(?m)^  {value} {name} +the point {meaning.strip().split()[0]}")

    def test_a_name_that_is_a_key_and_a_result_is_explained_as_both(self):
        for name in ("period", "attractor", "section_x", "branch"):
            text = self.page("help", name)
            self.assertEqual("\nExample" in text, name != "section_x", name)
            self.assertIn(f"{name} in files of `clatter {'branch' if name == 'branch' else 'run'}`\n", text)
        self.assertIn(self.page("branch", "--help"), self.page("help", "branch"))

    def test_info_tells_of_each_variable_when_it_is_missing(self):
        self.write("a.toml", OBSERVED)
        self.assertEqual(self.clatter("run", "a.toml", "-q").returncode, 0)
        brief, verbose = self.page("info", "a.h5"), self.page("info", "-v", "a.h5")
        self.assertEqual([line for line in verbose.splitlines() if line in brief.splitlines()], brief.splitlines())
        words = " ".join(verbose.split())
        self.assertIn("fastest impact, m s-1 NaN if the point failed, or the stop isn't hit; asked for by", words)
        self.assertIn("asked for by observe.impacts", words)

    def test_the_guide_of_results_has_every_result_of_a_run_with_its_type_and_dimension(self):
        guide = (SOURCE / "src" / "results" / "README.md").read_text(encoding="utf-8")
        table = guide[guide.index("| `[observe]` | variable |") :].split("\n\n")[0].splitlines()[2:]
        rows = {}
        for line in table:
            _, names, kind, over, _ = (cell.strip() for cell in line.strip()[1:-1].split("|"))
            names = re.findall(r"`(…?\w+)`", names)
            for name in names:
                name = name.replace("KEY", "R")  # of sensitivity, whose example it is
                rows[name if name[0] != "…" else names[0] + name[1:]] = (kind, re.findall(r"`(\w+)`", over))
        results = [name for command, name, _ in self.results() if command == "run" and name != "direction"]
        self.assertEqual(sorted(set(results)), sorted(rows))
        for name, (kind, over) in rows.items():
            text = self.page("help", name)
            text = text[text.index(f"{name} in files of `clatter run`\n") :]
            self.assertIn(f"  type        {kind}\n", text, name)
            for dimension in over:
                self.assertRegex(text, rf"  over .*\b{dimension}\b", name)

    def test_values_with_units_are_read_for_scripts(self):
        for value, number, units, unit in (
            ("1.5 mm", 0.0015, "m", "mm"),
            ("-2*pi rad/s", -1.0, "Hz", "rad/s"),
            ("3 N s/m", 3.0, "N s m-1", "N s/m"),
            ("7", 7.0, "1", None),
        ):
            told = json.loads(self.page("help", "--json", "--", value))
            self.assertEqual((told["value"], told["units"], told["unit"]), (number, units, unit))
        self.assert_refused(2, "'3 foo': unknown unit 'foo'; `clatter help units`", "help", "--json", "3 foo")
        self.assert_refused(2, "the unit 'm3' is that of nothing", "help", "--json", "3 m3")
        self.assert_refused(2, "--json without a value", "help", "--json")


if __name__ == "__main__":
    unittest.main()
