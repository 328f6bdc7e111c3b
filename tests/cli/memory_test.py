"""Memory as it is told before a run and as it is taken, for every shape of a sweep."""

import os
import random
import re
import subprocess
import unittest

from command_line import CLATTER, SANITIZED, CommandLine

UNITS = {"bytes": 1, "KiB": 2**10, "MiB": 2**20, "GiB": 2**30}
SCENE = """[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -400.0
"""
SHORT = '[time]\nmode = "transient"\nduration = 0.1\n'  # what a point computes takes no time


def linspace(count, first=0.5, last=1.5):
    return f'"linspace({first}, {last}, {count})"'


def sweep(axes, scene=SCENE, more="", time=SHORT, observe="extrema = true"):
    """A configuration whose axes replace what the scene has of them."""
    kept = "\n".join(line for line in scene.splitlines() if line.split(" ")[0] not in axes)
    lines = "\n".join(f"{name} = {values}" for name, values in axes.items())
    return f"{kept}\n[sweep]\n{lines}\n{more}\n{time}[observe]\n{observe}\n"


def long_list():
    """As many numbers as a configuration of 1 MiB holds."""
    numbers = random.Random(1)
    return "[" + ", ".join(f"{numbers.uniform(0.5, 1.5):.3f}" for _ in range(140000)) + "]"


TO_AND_FRO = "[scene]\nf = 0.0\nh = 0.0\nR = 1.0\nxs = 0.1\n"
LOGGED = '[time]\nmode = "transient"\nduration = {}\n'

SHAPES = {
    "one long axis": (sweep({"nu": linspace(8 * 10**6)}), ()),
    "many axes": (
        sweep({"nu": linspace(100), "h": linspace(20, 0.1, 0.3), "f": linspace(20), "phase": linspace(25)}),
        (),
    ),
    "trajectory": (sweep({"nu": linspace(2000)}, observe="trajectory = 2001"), ()),
    "harmonics": (sweep({"nu": linspace(20000)}, observe='harmonics = 100\nharmonics_method = "exact"'), ()),
    "harmonics by FFT": (
        sweep({"nu": linspace(50)}, observe="harmonics = 10\nharmonics_samples = 500000"),
        (),
    ),
    "short logs": (
        sweep({"v0": linspace(20000, 1, 2)}, TO_AND_FRO, time=LOGGED.format(10.0), observe="impact_log = true"),
        (),
    ),
    "long logs": (
        sweep({"v0": linspace(200, 1, 2)}, TO_AND_FRO, time=LOGGED.format(1000.0), observe="impact_log = true"),
        (),
    ),
    "log in files": (
        sweep({"v0": linspace(1100, 1, 2)}, TO_AND_FRO, time=LOGGED.format(1000.0), observe="impact_log = true"),
        (),
    ),
    "compression": (
        sweep(
            {"nu": linspace(4 * 10**5)},
            observe="extrema = true\nperiod = true\nimpacts = true\n[output]\ncompression = 1",
        ),
        (),
    ),
    "linked axes": (
        sweep(
            {"nu": linspace(10**6), "h": linspace(10**6, 0.1, 0.3), "f": linspace(10**6)},
            more='linked = "nu, h, f"',
        ),
        (),
    ),
    "a shard": (sweep({"nu": linspace(2 * 10**6)}), ("--shard", "0/3")),
    "attractors of many starts": (
        sweep({"x0": linspace(1000), "v0": linspace(1000)}, time="", observe="attractor = true"),
        (),
    ),
    "attractors of a map": (sweep({"nu": linspace(500), "f": linspace(400)}, time="", observe="attractor = true"), ()),
    "a list": (sweep({"phase": long_list()}), ()),
    "followed branches": (sweep({"nu": linspace(1000), "load": linspace(1000, 0, 1)}, more='follow = "nu"'), ()),
}


@unittest.skipIf(SANITIZED, "a sanitizer takes memory of its own")
class Memory(CommandLine):
    def assert_told(self, name, *words, in_files=False):
        """Memory as a command tells it with -v is within a tenth of the most that it takes; its output goes away."""
        errors = self.directory / "errors"
        with open(errors, "w") as stderr:
            process = subprocess.Popen([CLATTER, *words, "-v", "-o", "a.h5"], cwd=self.directory, stderr=stderr)
            _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        said = errors.read_text(encoding="utf-8")
        self.assertEqual(process.returncode, 0, said)
        number, unit = re.search(r"^memory +(\S+) (\w+)", said, re.MULTILINE).groups()
        told, taken = float(number) * UNITS[unit], usage.ru_maxrss * 1024
        if os.environ.get("CLATTER_SHOW"):
            print(f"{name:18} told {told / 2**20:7.1f} MiB, taken {taken / 2**20:7.1f} MiB, {told / taken:.3f}")
        (self.directory / "a.h5").unlink()
        self.assertGreater(taken, 24e6)  # more than a child of this process has before it becomes the program
        self.assertLess(taken, 1.1 * told, said)
        if in_files:  # the most of their pages that are resident is told, which are seldom so many
            self.assertLess(told, 2**29)
        else:
            self.assertLess(told - taken, 0.1 * taken, said)

    def test_of_a_run_is_told_within_a_tenth(self):
        for name, (text, words) in SHAPES.items():
            with self.subTest(shape=name):
                in_files = name in ("one long axis", "log in files")
                config = self.write("a.toml", text)
                self.assert_told(name, "run", config, "--threads", "2", *words, in_files=in_files)

    def test_of_a_merge_is_told_within_a_tenth(self):
        for name in ("trajectory", "short logs", "long logs"):
            with self.subTest(shape=name):
                config = self.write("a.toml", SHAPES[name][0])
                for number in range(2):
                    self.assertEqual(
                        self.clatter(
                            "run", config, "-o", f"{number}.h5", "--force", "--shard", f"{number}/2"
                        ).returncode,
                        0,
                    )
                self.assert_told("merge, " + name, "merge", "0.h5", "1.h5")


if __name__ == "__main__":
    unittest.main()
