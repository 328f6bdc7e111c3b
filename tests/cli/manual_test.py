"""Man pages: without complaint from mandoc, with every command, option and key, and an example that runs."""

import os
import re
import subprocess
import unittest

from command_line import SOURCE, CommandLine

VERIFY = os.environ.get("CLATTER_VERIFY", "")


class Manual(CommandLine):
    def setUp(self):
        super().setUp()
        result = self.clatter("help", "--manual", "deep/share")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        self.man = self.directory / "deep/share/man"

    def help(self, *words):
        return self.clatter("help", *words).stdout

    def shown(self, name):
        """A page as a reader sees it."""
        page = subprocess.run(
            ["mandoc", "-Tascii", "-O", "width=200", self.man / f"man{name[-1]}" / name],
            capture_output=True,
            check=True,
        ).stdout.decode("ascii")
        return re.sub(".\b", "", page)

    def commands(self):
        return re.findall(r"^  (\w+) .*  ", self.help().split("Exit codes")[0], re.MULTILINE)

    def test_mandoc_finds_no_fault(self):
        pages = sorted(self.man.rglob("*.[1-8]"))
        self.assertEqual(len(pages), 2 + len(self.commands()))
        for page in pages:
            lint = subprocess.run(["mandoc", "-Tlint", page], capture_output=True, text=True)
            self.assertEqual((lint.returncode, lint.stdout), (0, ""), page)

    def test_every_command_has_a_page_with_its_options_and_examples(self):
        commands = self.commands()
        self.assertIn("branch", commands)
        main = self.shown("clatter.1")
        for command in commands:
            self.assertIn(f"clatter-{command}(1)", main)
            page = self.shown(f"clatter-{command}.1")
            options, examples = self.clatter(command, "--help").stdout.split("Options\n")[1].split("\nExamples\n")
            for option in re.findall(r"--[\w-]+", re.sub(r"(?m)^ {10}.*", "", options)):
                self.assertRegex(page, rf"(?m)^ .*{option}\b", command)
            for line in examples.splitlines():
                self.assertIn(" ".join(line.split()), " ".join(page.split()))

    def test_every_exit_code_is_there(self):
        page = self.shown("clatter.1").split("EXIT STATUS")[1]
        codes = re.findall(r"(?m)^  (\d+) ", self.help().split("Exit codes\n")[1])
        self.assertGreater(len(codes), 5)
        for code in codes:
            self.assertRegex(page, rf"(?m)^ +{code} ")

    def test_every_key_is_there_with_its_values(self):
        page = " ".join(self.shown("clatter-config.5").split())
        self.assertIn("[scene]", page)
        reference = self.help("configuration").split("Values, in TOML")[0]
        entries = re.findall(r"(?m)^  (\w+)(?: +|\n {21})((?:.*\n)(?: {21}.*\n)+)", reference)
        self.assertGreater(len(entries), 35)
        for name, text in entries:
            self.assertIn(f"{name} {' '.join(text.split())}", page)

    def test_the_example_runs(self):
        lines = self.shown("clatter-config.5").split("EXAMPLE\n")[1].split("SEE ALSO")[0].splitlines()
        (self.directory / "a.toml").write_text("\n".join(line.strip() for line in lines) + "\n", encoding="utf-8")
        result = self.clatter("run", "a.toml", "-q")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_pages_tell_version_and_release(self):
        version = re.search(r"VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text().split("project(")[1])[1]
        date = re.search(r'date-released: "([\d-]+)"', (SOURCE / "CITATION.cff").read_text())[1]
        last_line = self.shown("clatter.1").splitlines()[-1]
        self.assertEqual(last_line.split(), ["clatter", version, date, "CLATTER(1)"])

    def test_a_folder_that_cannot_be_made_is_named(self):
        (self.directory / "file").touch()
        result = self.clatter("help", "--manual", "file")
        self.assertEqual(result.returncode, 74)
        self.assertRegex(result.stderr, r"^clatter: cannot make the folder '?file/man/man1'?: Not a directory\n$")

    def test_a_topic_beside_it_is_refused(self):
        result = self.clatter("help", "run", "--manual", "here")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--manual conflicts with 'run'", result.stderr)
        self.assertFalse((self.directory / "here").exists())


class ManualOfScripts(CommandLine):
    """The pages of clatter-plot and clatter-report, from the parsers that --help prints."""

    def setUp(self):
        super().setUp()
        subprocess.run(["/usr/bin/python3", "-B", SOURCE / "scripts/manual.py", self.directory / "share"], check=True)
        self.pages = sorted((self.directory / "share/man/man1").iterdir())

    def test_mandoc_finds_no_fault(self):
        self.assertEqual([page.name for page in self.pages], ["clatter-plot.1", "clatter-report.1"])
        for page in self.pages:
            lint = subprocess.run(["mandoc", "-Tlint", page], capture_output=True, text=True)
            self.assertEqual((lint.returncode, lint.stdout), (0, ""), page)

    def test_every_option_is_there_with_its_explanation(self):
        for page in self.pages:
            script = SOURCE / "scripts" / f"{page.stem.removeprefix('clatter-')}.py"
            text = subprocess.run(
                ["/usr/bin/python3", "-B", script, "--help"],
                capture_output=True,
                check=True,
                text=True,
                env={"COLUMNS": "300", "PATH": "/usr/bin:/bin"},
            ).stdout
            entries = re.findall(r"(?m)^  (-\S.*?)(?:  +|\n +)(\S.*)$", text)
            self.assertGreater(len(entries), 3)
            shown = subprocess.run(
                ["mandoc", "-Tascii", "-O", "width=300", page], capture_output=True, check=True, text=True
            ).stdout
            shown = re.sub(".\b", "", shown)
            for option, explanation in entries:
                name = re.findall(r"--[\w-]+", option)[-1]
                self.assertRegex(shown, rf"(?m)^ .*{name}\b.*\n +{re.escape(explanation)}$")


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
class ManualOfVerifier(CommandLine):
    """The page of clatter-verify, made of what its --help prints."""

    def setUp(self):
        super().setUp()
        folder = self.directory / "share"
        subprocess.run(["/usr/bin/python3", "-B", SOURCE / "scripts/manual.py", folder, VERIFY], check=True)
        self.pages = list((folder / "man/man1").iterdir())

    def test_mandoc_finds_no_fault(self):
        self.assertEqual([page.name for page in self.pages], ["clatter-verify.1"])
        lint = subprocess.run(["mandoc", "-Tlint", *self.pages], capture_output=True, text=True)
        self.assertEqual((lint.returncode, lint.stdout), (0, ""))

    def test_every_word_of_the_help_is_there_in_its_order(self):
        told = subprocess.run([VERIFY, "--help"], capture_output=True, check=True, text=True).stdout
        self.assertRegex(told, r"(?m)^Exit codes\n  0    every claim is proved$")
        page = subprocess.run(["mandoc", "-Tascii", *self.pages], capture_output=True, check=True, text=True).stdout
        shown = iter(re.sub(".\b", "", page).split())
        titles = {"Options": "OPTIONS", "Exit codes": "EXIT STATUS", "Examples": "EXAMPLES"}
        usage, summary, others = told.split("\n\n", 2)
        for line in f"{summary}\n{usage}\n{others}".splitlines():
            for word in titles.get(line, line).split():
                self.assertIn(word, shown, line)


if __name__ == "__main__":
    unittest.main()
