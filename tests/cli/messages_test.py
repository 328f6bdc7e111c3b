"""Messages that lead somebody who makes an understandable mistake to what he meant, each with what to type."""

import json
import subprocess
import unittest

from command_line import SOURCE, CommandLine
from script_runs import run_script

RIG = """[machine]
mass = 1.0
stiffness = "2000 N/m"
damping_ratio = 0.05
force = 40
frequency = "8 Hz"
gap = "1 mm"
R = 0.6
[observe]
impacts = true
"""
BRANCH = (SOURCE / "configs" / "branch.toml").read_text(encoding="utf-8")


class Messages(CommandLine):
    def refused(self, old, new, *words):
        """A rig with another line is refused in all these words."""
        self.assertIn(old, RIG)
        self.write("a.toml", RIG.replace(old, new))
        for part in words:
            self.assert_refused(2, part, "run", "a.toml")

    def test_a_comma_may_be_of_decimals_or_of_thousands(self):
        words = "a decimal comma? write 2.000 N/m; thousands? write 2000 N/m"
        self.refused('"2000 N/m"', '"2,000 N/m"', "a.toml:3:13: stiffness = the text '2,000 N/m'", words)
        self.refused('"2000 N/m"', "2,000", "a decimal comma? write 2.000; thousands? write 2000")
        self.refused('"2000 N/m"', '"1,200,000 N/m"', "; thousands? write 1200000 N/m")
        self.write("a.toml", RIG.replace("0.05", "0,050"))
        said = self.clatter("run", "a.toml").stderr
        self.assertIn("a decimal comma? write 0.050", said)
        self.assertNotIn("thousands", said)

    def test_characters_of_word_processors_are_named_with_what_to_type(self):
        for number, plain in ((0x2212, "a hyphen, -"), (0x2013, "a hyphen, -")):
            sign = chr(number)
            words = f"'{sign}' (U+{number:04X}) is a typeset ", f"; type {plain}"
            self.refused("force = 40", f"force = {sign}5", "a.toml:5:9: ", *words)
            self.refused("force = 40", f'force = "{sign}5 N"', *words)
            self.assert_refused(2, words[0], "run", str(SOURCE / "configs/rig.toml"), "--set", f"machine.x0={sign}1 mm")
        self.refused('"8 Hz"', "“8 Hz”", "a.toml:6:13: '“' (U+201C) is a typeset quote; type a straight quote, \"")
        self.refused("force = 40", "force = 40\u00a0", "U+00A0 is a no-break space; type a plain blank")
        self.refused('"8 Hz"', '"8\u00a0Hz"', "U+00A0 is a no-break space; type a plain blank")
        self.refused("force = 40", "force = ü", "a character outside ASCII, 'ü' (U+00FC); put the text in quotes")

    def test_a_key_of_another_section_is_sent_there_before_any_guess(self):
        self.refused("impacts = true", "friction = 3", "unknown key 'friction' in [observe]; it belongs in [machine]")
        self.write("a.toml", "[observe]\nfriction = 3\n")
        self.assert_refused(2, "unknown key 'friction' in [observe]; it belongs in [scene]", "run", "a.toml")

    def test_names_of_the_field_lead_to_ours(self):
        for name, in_scene, in_machine in (
            ("e", "R", "R"),
            ("restitution", "R", "R"),
            ("mu", "friction", "friction"),
            ("omega", "nu", "frequency"),
            ("zeta", "h", "damping_ratio"),
            ("clearance", "xs", "gap"),
        ):
            for section, ours in (("scene", in_scene), ("machine", in_machine)):
                for place in (section, "sweep", "observe"):
                    home = {section: "", "sweep": ""}.get(place, f", in [{section}]")
                    words = f"unknown key '{name}' in [{place}]; "
                    self.write("a.toml", f"[{section}]\nfriction_static = 1\n[observe]\nimpacts = true\n")
                    self.assert_refused(2, words, "run", "a.toml", "--set", f"{place}.{name}=1")
                    self.assert_refused(2, f" is '{ours}'{home}\n", "run", "a.toml", "--set", f"{place}.{name}=1")

    def test_an_unknown_axis_is_told_what_can_be_swept(self):
        self.refused("[observe]", "[sweep]\nfoo = [1, 2]\n[observe]", "keys of [machine] can be swept: mass, stiffness")
        said = self.clatter("run", "a.toml").stderr
        self.assertIn("; beside them [sweep] has linked, follow, direction\n", said)
        self.assertNotIn(" nu,", said)

    def test_a_range_in_hz_without_its_parameter_asks_for_that(self):
        for along, words in (
            ("", "[branch] without 'along'; add a key of [machine], e.g. along = \"frequency\""),
            (
                'along = "frequency"\nacross_range = ["1 mm", "2 mm"]\n',
                "'across_range' without 'across'; add the second",
            ),
        ):
            self.write("a.toml", RIG + '[branch]\nrange = ["8 Hz", "9 Hz"]\n' + along)
            self.assert_refused(2, words, "branch", "a.toml")

    def test_a_start_that_the_configuration_rules_out_is_its_mistake(self):
        for change, words in (
            ((), None),
            (("--set", "branch.range=1.2, 1.5"), "a.toml: the start lies outside branch.range; give scene.nu"),
            (
                ("--set", "branch.along=friction", "--set", "branch.range=0, 0.2"),
                "there is no dry friction at the start",
            ),
            (("--set", "scene.f=0"), "a branch needs a force"),
        ):
            self.write("a.toml", BRANCH)
            command = ("branch", "a.toml", "-q", *change)
            if words is None:
                self.assertEqual(self.clatter(*command, "-o", "b.h5").returncode, 0)
            else:
                self.assert_refused(2, words, *command)

    def test_init_names_the_command_that_the_configuration_is_for(self):
        for model, command in (("branch", "branch"), ("drill", "run"), ("accuracy_smooth", "accuracy")):
            said = self.clatter("init", model).stderr
            self.assertTrue(said.endswith(f"run it by: clatter {command} {model}.toml\n"), said)

    def test_nearest_values_and_components_that_are_there_are_listed_once(self):
        self.write("a.toml", RIG)
        self.write("b.toml", BRANCH)
        self.assertEqual(self.clatter("run", "a.toml", "-q").returncode, 0)
        self.assertEqual(self.clatter("branch", "b.toml", "-q").returncode, 0)
        self.assert_refused(
            2, "there are impact_speed[-1], impact_speed[1]\n", "info", "a.h5", "--max", "impact_speed[0]"
        )
        self.assert_refused(2, "there are v_before[-1], v_before[1]\n", "export", "a.h5", "--only", "v_before[0]")
        said = self.clatter("export", "b.branch.h5", "--where", "branch=99").stderr
        values = json.loads(f"[{said.rsplit('are ')[-1].replace(' and ', ',')}]")
        self.assertEqual(len(set(values)), 2, said)

    def test_values_beside_files_are_told_like_those_in_them(self):
        self.assert_refused(2, "unknown unit ',4 mm'; a decimal comma? write 0.4", "help", "--json", "0,4 mm")
        self.assert_refused(2, "'\u2212' (U+2212) is a typeset minus; type a hyphen, -", "help", "--json", "\u22123")


class Python(CommandLine):
    def test_a_typeset_minus_is_told_by_the_program(self):
        self.write("a.toml", RIG + "[sweep]\nload = ['-3 N', '3 N']\n")
        self.assertEqual(self.clatter("run", "a.toml", "-q").returncode, 0)
        said = run_script("plot.py", self.directory / "a.h5", "--at", "load=\u22123 N").stderr
        self.assertIn("'\u2212' (U+2212) is a typeset minus; type a hyphen, -", said)

    def test_a_dataset_in_place_of_its_file_is_named(self):
        code = (
            f"import sys; sys.path.insert(0, {str(SOURCE / 'scripts')!r}); import clatter, xarray\n"
            "try: clatter.plot(xarray.Dataset({'status': 1}))\n"
            "except TypeError as error: print(error)"
        )
        done = subprocess.run(["/usr/bin/python3", "-B", "-c", code], capture_output=True, text=True)
        self.assertIn("a dataset in memory has no picture; expected the path of an output", done.stdout, done.stderr)


if __name__ == "__main__":
    unittest.main()
