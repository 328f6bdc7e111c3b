"""Shared by the tests of clatter-verify: certificates of a configuration, and a run of the program."""

import subprocess
import unittest

from certified_runs import VERIFY, certified
from command_line import LONGEST, CommandLine

SOFT = """[scene]
f = -1.0
h = 0.1
xs = -0.5
stop_stiffness = 30
stop_damping = 0.1
[sweep]
nu = "linspace(0.5, 1.5, 21)"
"""


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
class Verifying(CommandLine):
    def verify(self, *words, text=None):
        return subprocess.run(
            [VERIFY, *words],
            input=text,
            cwd=self.directory,
            capture_output=True,
            text=True,
            timeout=LONGEST,
            check=False,
        )

    def certificates(self, name, config, *words, settings=()):
        """The file of the certificates of a configuration, a text or a path, with other settings."""
        if isinstance(config, str):
            config = self.write(f"{name}.toml", config)
        output, file = self.directory / f"{name}.h5", self.directory / f"{name}.jsonl"
        sets = (word for setting in settings for word in ("--set", setting))
        result = self.clatter("run", config, "-q", "-o", output, *sets)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        certified(output, file, *words)
        return file

    def assert_proved(self, found, at_least, undecided=0):
        self.assertEqual((found["refuted"], found["malformed"]), (0, 0), found["claims"])
        self.assertLessEqual(found["undecided"], undecided, found["claims"])
        self.assertGreaterEqual(found["proved"], at_least)
