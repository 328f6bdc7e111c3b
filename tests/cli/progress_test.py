"""Progress on stderr: a bar that fits its terminal, and lines where there is none."""

import contextlib
import fcntl
import os
import re
import struct
import subprocess
import termios
import unittest

from command_line import CLATTER, SMALL, CommandLine, open_terminal


def shown_on_terminal(command, columns, folder):
    """What a command writes on a terminal of so many columns, which is its stderr."""
    terminal, program = open_terminal()
    fcntl.ioctl(program, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    environment = os.environ | {"TERM": "xterm", "NO_COLOR": ""}
    with subprocess.Popen(command, cwd=folder, stderr=program, env=environment) as process:
        os.close(program)
        shown = b""
        with contextlib.suppress(OSError), open(terminal, "rb", buffering=0) as stream:
            while part := stream.read(4096):  # fails once nobody has the other end
                shown += part
    if process.returncode != 0:
        raise AssertionError(f"{command} ends by {process.returncode}: {shown}")
    return shown.decode()


class Progress(CommandLine):
    def test_the_bar_fits_every_terminal(self):
        config = self.write("a.toml", SMALL.replace("1.5, 5)", "1.5, 40301)"))
        for columns in (20, 33, 47, 61, 87, 200):
            shown = shown_on_terminal([CLATTER, "run", config, "--force"], columns, self.directory)
            bars = [re.sub(r"\033\[\d*m", "", bar) for bar in shown.split("\r\033[K") if " left" in bar]
            self.assertTrue(bars)
            for bar in bars:
                self.assertRegex(bar, r"^(\[[#.]+\] )? *\d+ %.* left$")
                self.assertLess(len(bar), columns, bar)
            self.assertEqual("/40301 points" in bars[-1], columns > 50, bars[-1])
            self.assertEqual("points/s" in bars[-1], columns > 70, bars[-1])

    def test_the_bar_appears_on_demand_and_without_a_terminal_only_then(self):
        config = self.write("a.toml", SMALL)
        for words in ([], ["--progress", "never"], ["--quiet"]):
            self.assertNotIn("points/s", self.clatter("run", config, *words).stderr)
        bar = self.clatter("run", config, "--progress", "always", environment={"NO_COLOR": "1"}).stderr
        self.assertRegex(bar, r"5/5 points .* points/s .* left")
        self.assertNotIn("\033[", bar)

    def test_without_a_terminal_a_line_tells_how_long_a_long_command_takes(self):
        """`accuracy` foretells it, since it knows its runs; others by their pace."""
        long = SMALL.replace("[sweep]", '[time]\nmode = "transient"\nduration = 1e9\n[sweep]').replace("5)", "1)")
        steady = SMALL.replace("1.5, 5)", "1.5, 40)")
        for command, text, told in (
            ("run", long, r"0 of 1 points, about \d+:\d\d:\d\d left\n"),
            ("accuracy", steady, r"\d+ of \d+ runs, about \d+:\d\d:\d\d left\n"),
        ):
            config = self.write("a.toml", text)
            process = subprocess.Popen(
                [CLATTER, command, config, "--set", "scene.xs=-1"],
                cwd=self.directory,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
            )
            with process:
                line = next((line for line in process.stderr if " left" in line), "")
                process.kill()
            self.assertRegex(line, told)


if __name__ == "__main__":
    unittest.main()
