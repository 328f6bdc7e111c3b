"""Completions, typed in bash, zsh and fish: commands, options, words, files by their endings, keys after --set."""

import codecs
import fcntl
import os
import pty
import re
import select
import struct
import subprocess
import tempfile
import termios
import time
import unittest
from pathlib import Path

from command_line import CLATTER, LONGEST, open_terminal, require_program

PROMPT = "ready> "


class Terminal:
    """A shell in a terminal, in which keys are typed, each line when the shell has shown its prompt."""

    def __init__(self, words, folder):
        require_program(words[0], words[0])
        self.process, self.terminal = open_terminal(pty.fork)
        if self.process == 0:
            try:
                os.chdir(folder)
                os.environ.update(TERM="xterm", PS1=PROMPT, HOME=str(folder), LC_ALL="C.UTF-8")
                os.execvp(words[0], words)
            finally:
                os._exit(127)  # or there would be two of this test
        fcntl.ioctl(self.terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 300, 200, 0, 0))
        self.commands = 0
        self.read_until(PROMPT)

    def close(self):
        os.close(self.terminal)
        os.waitpid(self.process, 0)

    def read_until(self, mark):
        text, end = "", time.monotonic() + LONGEST
        decoder = codecs.getincrementaldecoder("utf-8")("replace")  # a read may end within a character
        while not re.search(mark, text, re.DOTALL):
            ready, _, _ = select.select([self.terminal], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                raise TimeoutError(f"no {mark!r} within {LONGEST} s in {text!r}")
            try:
                text += decoder.decode(os.read(self.terminal, 65536))
            except OSError as error:
                raise AssertionError(f"the shell ended; it said {text!r}") from error
        return re.sub(r"\x1b(\[[\d;?]*[A-Za-z]|[()=>].?)|\x07|\r", "", text)

    def run(self, command):
        """All that the terminal shows until a command has run."""
        self.commands += 1
        os.write(self.terminal, f"{command}\necho end-of-$(({self.commands}))\n".encode())
        return self.read_until(rf"end-of-{self.commands}\r\n.*{PROMPT}")

    def typed(self, keys):
        """All that the terminal shows when keys are typed; then the line is cleared."""
        os.write(self.terminal, keys.encode())
        return self.run("\x15")


class Typed:
    """What both shells of a terminal must do; two tabs list all that fits."""

    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        folder = Path(kept.name)
        subprocess.run([CLATTER, "help", "--manual", "share"], cwd=folder, check=True)
        for name in ("one.toml", "two.ini", "drawn.svg", "ran.h5", "table.csv"):
            (folder / name).touch()
        (folder / "sub").mkdir()
        cls.shell = Terminal(cls.START, folder)
        cls.addClassCleanup(cls.shell.close)
        for line in cls.SETTINGS:
            cls.shell.run(line)

    def offered(self, line):
        return self.shell.typed(line + "\t\t")

    def test_commands(self):
        self.assertIn("clatter accuracy", self.shell.typed("clatter acc\t"))
        text = self.offered("clatter ")
        for command in ("run", "branch", "defaults"):
            self.assertIn(command, text)
        self.assertIn("clatter --version", self.shell.typed("clatter --ver\t"))

    def test_options_and_their_words(self):
        self.assertIn("clatter run --threads", self.shell.typed("clatter run --thr\t"))
        text = self.offered("clatter run --arch ")
        for word in ("scalar", "sse2", "avx2", "avx512"):
            self.assertIn(word, text)
        self.assertNotIn("one.toml", text)

    def test_files_by_their_endings(self):
        for line, wanted in (
            ("clatter run ", {"one.toml", "two.ini"}),
            ("clatter plan --ini ", {"one.toml", "two.ini"}),
            ("clatter info ", {"ran.h5"}),
            ("clatter export ran.h5 -o ", {"table.csv"}),
        ):
            text = self.offered(line)
            names = {"one.toml", "two.ini", "drawn.svg", "ran.h5", "table.csv"} - set(line.split())
            self.assertEqual({name for name in names if name in text}, wanted, line)

    def test_keys_and_their_values(self):
        text = self.offered("clatter run --set scene.R")
        for key in ("scene.R_lower", "scene.R_upper"):
            self.assertIn(key, text)
        self.assertIn("0 ... 1; default: 1", self.offered("clatter run --set scene.R="))
        self.assertIn("linspace(a, b, n)", self.offered("clatter run --set sweep.R="))
        text = self.offered("clatter run --set time.mode=")
        self.assertRegex(text, r"steady\s+transient")
        self.assertIn("time.mode=transient", self.shell.typed("clatter run --set time.mode=tr\t"))
        self.assertIn("observe.extrema=true", self.shell.typed("clatter plan --set observe.extrema=t\t"))
        line = self.shell.typed("clatter branch --set branch.curve=sym\t")
        self.assertIn(r"branch.curve=symmetry\ breaking", line)

    def test_models(self):
        self.assertIn("clatter init bouncing_ball", self.shell.typed("clatter init bounc\t"))
        text = self.offered("clatter init s")
        for model in ("shaken_stops", "soft_bumper"):
            self.assertIn(model, text)

    def test_topics_of_help(self):
        self.assertIn("clatter help configuration", self.shell.typed("clatter help conf\t"))


class Bash(Typed, unittest.TestCase):
    START = ["bash", "--norc", "--noprofile", "-i"]
    SETTINGS = [
        "bind 'set enable-bracketed-paste off'; bind 'set completion-query-items 0'; bind 'set page-completions off'",
        "source share/bash-completion/completions/clatter.bash",
    ]

    def test_the_same_if_an_equals_sign_ends_no_word(self):
        self.shell.run("kept=$COMP_WORDBREAKS; COMP_WORDBREAKS=${COMP_WORDBREAKS//=}")
        self.assertIn("--set time.mode=transient", self.shell.typed("clatter run --set time.mode=tr\t"))
        self.shell.run("COMP_WORDBREAKS=$kept")


class Zsh(Typed, unittest.TestCase):
    START = ["zsh", "-f", "-i"]
    SETTINGS = [
        "unsetopt prompt_sp; LISTMAX=10000; fpath=($PWD/share/zsh/site-functions $fpath)",
        "autoload -Uz compinit; compinit -u -D",
    ]

    def test_options_are_explained(self):
        self.assertIn("print only errors", self.offered("clatter run -"))


class Fish(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        require_program("fish", "fish")
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = Path(kept.name)
        subprocess.run([CLATTER, "help", "--manual", "share"], cwd=cls.folder, check=True)
        for name in ("one.toml", "two.ini", "drawn.svg", "ran.h5"):
            (cls.folder / name).touch()

    def offered(self, line):
        """Words that fish offers, with their explanations."""
        script = 'source share/fish/vendor_completions.d/clatter.fish; complete -C "$LINE"'
        done = subprocess.run(
            ["fish", "--no-config", "-c", script],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=LONGEST,
            env={**os.environ, "LINE": line, "HOME": str(self.folder), "LC_ALL": "C.UTF-8"},
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return dict((row + "\t").split("\t")[:2] for row in done.stdout.splitlines())

    def test_commands_only_in_the_first_place(self):
        self.assertEqual(list(self.offered("clatter acc")), ["accuracy"])
        self.assertNotIn("plan", self.offered("clatter run "))

    def test_options_and_their_words(self):
        self.assertEqual(list(self.offered("clatter run --thr")), ["--threads"])
        self.assertEqual(set(self.offered("clatter run --arch ")), {"scalar", "sse2", "avx2", "avx512"})
        self.assertIn("-q", self.offered("clatter run -"))

    def test_models(self):
        self.assertEqual(set(self.offered("clatter init dri")), {"drive_si", "drill"})

    def test_files_with_the_right_endings_first(self):
        self.assertEqual(list(self.offered("clatter run o"))[:1], ["one.toml"])
        self.assertEqual(list(self.offered("clatter info r"))[:1], ["ran.h5"])

    def test_keys_and_their_values(self):
        offered = self.offered("clatter run --set scene.R")
        laws = ("R", "R_of_speed", "R_exponent", "R_reference_speed", "R_below")
        sides = ("", "_lower", "_upper")
        self.assertEqual(set(offered), {f"scene.{law}{side}=" for law in laws for side in sides})
        self.assertIn("0 ... 1; default: 1", offered["scene.R="])
        self.assertEqual(set(self.offered("clatter run --set time.mode=")), {"time.mode=steady", "time.mode=transient"})

    def test_topics_of_help(self):
        self.assertEqual(list(self.offered("clatter help configur")), ["configuration"])


if __name__ == "__main__":
    unittest.main()
