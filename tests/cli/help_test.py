"""Every help page: on stdout, within 80 columns, for every command and every key; suggestions for the rest."""

import re
import unittest

from command_line import SOURCE, CommandLine

COMMANDS = ("run", "plan", "accuracy", "branch", "merge", "export", "certify", "info", "init", "defaults", "help")
SECTIONS = ("scene", "sweep", "time", "observe", "integrator", "branch", "output")


class Help(CommandLine):
    def page(self, *words):
        result = self.clatter(*words)
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        self.assertTrue(result.stdout, words)
        return result.stdout

    def keys(self):
        """Section and name of every key, as `clatter defaults` shows them."""
        section, keys = "", []
        for line in self.page("defaults").splitlines():
            if header := re.match(r"\[(\w+)\]", line):
                section = header[1]
            elif (entry := re.match(r"#?(\w+) =", line)) and (section, entry[1]) != ("sweep", "nu"):
                keys.append((section, entry[1]))
        return keys

    def test_every_page_keeps_within_80_columns(self):
        pages = [["--help"], ["-h"], ["help"], ["help", "configuration"], ["defaults"], ["defaults", "--ini"]]
        pages += [["help", command] for command in COMMANDS] + [[command, "--help"] for command in COMMANDS]
        pages += [["help", section] for section in SECTIONS]
        pages += [["help", function] for function in ("linspace", "logspace", "arange")]
        pages += [["help", name] for section, name in self.keys()]
        pages += [["help", "results"], ["help", "units"]]
        for words in pages:
            with self.subTest(words):
                text = self.page(*words)
                self.assertLessEqual(max(map(len, text.splitlines())), 80)
                self.assertNotRegex(text, r"(?m)[ \t]$")

    def test_the_commands_of_these_tests_are_all(self):
        listed = re.findall(r"^  (\w+) .*  ", self.page("help").split("Exit codes")[0], re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(COMMANDS))

    def test_notes_tell_of_what_time_numbers_are_and_what_tau_is(self):
        """info compares points, export prints files; both say which."""
        for words, *parts in (
            (("help", "info"), "Work, losses and impulse are those of one forcing period here, as in pictures"),
            (
                ("help", "export"),
                "Numbers are those of the file: work, losses and impulse in the observed time",
                "tau of samples and of impacts is the time since the observed time began, in s of a [machine], else in "
                "units of one over the natural frequency, so that a forcing period is 2 pi/nu",
            ),
        ):
            page = self.page(*words)
            notes = " ".join(page[page.index("\nNotes\n") : page.index("\nExamples\n")].split())
            for part in parts:
                self.assertIn(part, notes)
        self.assertNotIn("trajectories: time", self.page("help", "export"))

    def test_a_key_is_explained_with_an_example(self):
        keys = self.keys()
        self.assertGreater(len(keys), 35)
        for section, name in keys:
            with self.subTest(section=section, name=name):
                full = f"{section}.{name}".lstrip(".")
                text = self.page("help", full)
                self.assertTrue(text.startswith(name + (f" in [{section}]" if section else ", before")), text)
                self.assertRegex(text, rf"(?m)^  {name} = ")
                self.assertIn(f"--set {full}=", text)
                self.assertIn("default: ", " ".join(text.split()))
                self.assertIn(text, self.page("help", name))  # alone it may name a key in two sections

    def test_R_is_explained_alone_with_its_section_and_as_an_axis(self):
        text = self.page("help", "scene.R")
        for words in (
            "R in [scene]\n",
            "restitution of velocity on both stops",
            "0 ... 1; default: 1",
            "  [scene]\n  xs = 1.0\n  R = 0.7\n",
            "--set scene.R=0.7\n",
            "As an axis of a sweep\n",
            '  [sweep]\n  R = "linspace(0.35, 0.7, 11)"\n',
            "--set sweep.R='linspace(0.35, 0.7, 11)'\n",
        ):
            self.assertIn(words, text)
        self.assertEqual(self.page("help", "sweep.R"), text)
        self.assertNotIn("[machine]", text)

    def test_R_is_explained_in_both_sections_that_describe_a_scene(self):
        scene, machine = self.page("help", "scene.R"), self.page("help", "machine.R")
        self.assertEqual(self.page("help", "R"), f"{scene}\n\n{machine}")
        self.assertIn("--set machine.R=0.7\n", machine)

    def test_a_name_in_two_sections_is_explained_in_both(self):
        text = self.page("help", "tolerance")
        self.assertIn("tolerance in [time]\n", text)
        self.assertIn("tolerance in [integrator]\n", text)
        self.assertNotIn("[integrator]", self.page("help", "time.tolerance"))

    def test_unknown_topics_get_suggestions(self):
        cases = {
            "rnu": "run",
            "nuu": "nu",
            "scene.nuu": "scene.nu",
            "sweep.harm": None,
            "harmonisc": "harmonics",
            "start": "start_period",
            "conf": "configuration",
            "linspce": "linspace",
            "obsrve": "observe",
            "impact_sped": "impact_speed",
            "multiplier_rr": "multiplier_re",
            "error_extema": "error_extrema",
        }
        for topic, meant in cases.items():
            words = f"no help on '{topic}'; did you mean '{meant}'?" if meant else f"no help on '{topic}'; "
            self.assert_refused(2, words, "help", topic)
        self.assert_refused(2, "there is help on: configuration, run, ", "help", "xyzzyx")

    def test_the_guide_of_configurations_holds_their_reference(self):
        reference = self.page("help", "configuration")
        self.assertIn(reference.strip(), (SOURCE / "configs" / "reference" / "README.md").read_text(encoding="utf-8"))

    def test_the_citation_is_that_of_the_citation_file(self):
        file = (SOURCE / "CITATION.cff").read_text(encoding="utf-8")
        text = self.page("--cite")
        version = self.page("--version").split()[1]
        self.assertIn(f'version: "{version}"', file)
        self.assertIn(f"version = {{{version}}}", text)
        for words in (
            "The clatter authors",
            "Vibration Drives with Two Impacting Pairs for Precise Robots",
            "Mechanika",
        ):
            self.assertIn(words, file)
            self.assertIn(words, text)
        self.assertIn("doi     = {" + re.search(r"doi: (\S+)", file)[1] + "}", text)
        self.assertIn("year    = {" + re.search(r'date-released: "(\d{4})', file)[1] + "}", text)

    def test_the_version_names_the_commit(self):
        self.assertRegex(self.page("--version"), r"^clatter \d+\.\d+\.\d+ \(commit \S+, .+\)\n$")


if __name__ == "__main__":
    unittest.main()
