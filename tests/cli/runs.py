"""Runs of configurations given as text, in a scratch directory; the environment's CLATTER is the program."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from command_line import CLATTER, LONGEST

FORCED = {"f": -1.0, "h": 0.1, "R": 0.7, "xs": -0.5}


def toml(title="", scene=FORCED, **sections):
    """A configuration as text; a section is given as a dictionary, and keys of [sweep] aren't repeated in [scene]."""
    lines = [f'title = "{title}"']
    scene = {key: value for key, value in scene.items() if key not in sections.get("sweep", {})}
    for name, keys in {"scene": scene, **sections}.items():
        lines.append(f"[{name}]")
        lines += [f"{key} = {repr(value).lower() if isinstance(value, bool) else value}" for key, value in keys.items()]
    return "\n".join(lines).replace("'", '"') + "\n"


def quoted(text):
    return f'"{text}"'


class RunTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = Path(scratch.name)

    def run_clatter(self, config, name="out", threads=1, environment=None, options=()):
        """Runs a configuration, a text or a path, and returns the path of its output."""
        if isinstance(config, str):
            path = self.scratch / f"{name}.toml"
            path.write_text(config, encoding="utf-8")
            config = path
        output = self.scratch / f"{name}.h5"
        done = subprocess.run(
            [CLATTER, "run", config, "-o", output, "--threads", str(threads), *options],
            capture_output=True,
            text=True,
            check=False,
            timeout=LONGEST,
            env={**os.environ, **(environment or {})},
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return output
