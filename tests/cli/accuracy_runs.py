"""Shared by the tests of `clatter accuracy`: a small scene, its run, and the objects that it prints."""

import json

from command_line import CommandLine

SCENE = """title = "a small scene"
[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -0.5
"""
STEADY = SCENE + "[time]\nwindow = 3\n"


def objects(text):
    """The JSON objects of lines, none of which may hold a word that JSON doesn't have, such as NaN."""

    def refuse(word):
        raise ValueError(f"{word} is no JSON")

    return [json.loads(line, parse_constant=refuse) for line in text.splitlines()]


class AccuracyRuns(CommandLine):
    def accuracy(self, *words, code=0, arch="", rounds=2):
        """Times each row twice, not nine times: no test depends on a time."""
        result = self.clatter("accuracy", *words, "--rounds", str(rounds), environment={"CLATTER_ARCH": arch})
        self.assertEqual(result.returncode, code, result.stderr)
        return result
