"""`clatter defaults --schema`: a JSON Schema that takes each configuration that runs, and no wrong one that it sees.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import tomllib
import unittest

import jsonschema

from command_line import SOURCE, CommandLine

MACHINE = '[machine]\nmass = "250 g"\nstiffness = 800\ngap = "3 mm"\n'
SCENE = "[scene]\nxs = 1.0\n"

# What the program takes, too.
RIGHT = (
    SCENE + 'phase = "30 °"\nR = "60 %"\nload = "-pi/2"\nnu = 2\n[time]\nmax_impacts = 1e8\n',
    SCENE + '[sweep]\nnu = "linspace(0.5, 2*pi, 11)"\nR = ["50 %", "70 %"]\nh = "0.1, 0.2"\nlinked = "R, h"\n',
    "[scene]\nstop_lower = -inf\nstop_upper = 2\nstop_stiffness_upper = 9\nstop_R = 1\n",
    MACHINE
    + 'force = "1 N"\nfrequency = "1500 1/min"\nphase = "0.5 rad"\n[time]\nmode = "transient"\nduration = "2 s"\n',
    MACHINE + 'stop_stiffness = "90 N/mm"\nstop_damping = "4 N s/m"\n',
    MACHINE + 'stop_stiffness = "90 N/mm"\n[sweep]\nstop_damping = ["4 N s/m", "5 N s m^-1"]\n',
    MACHINE + '[sweep]\nx0 = "sobol(-1 mm, 1 mm, 8)"\nfrequency = "arange(10 Hz, 20 Hz, 1 Hz)"\nforce = [1]\n',
    MACHINE + '[branch]\nalong = "frequency"\nrange = ["20 Hz", "30 Hz"]\n',
    SCENE + "[machine]\n",
)

# Wrong ones; the program refuses them, too.
WRONG = (
    SCENE + "nuu = 1\n",
    SCENE + "R = 1.5\n",
    SCENE + "h = -0.1\n",
    SCENE + "stop_stiffness = 9\nstop_R = 0\n",
    SCENE + 'h = "much"\n',
    SCENE + 'h = "0.1 m"\n',
    SCENE + "nu = true\n",
    SCENE + "nu = [1, 2]\n",
    "[scene]\nxs = 0\n",
    SCENE + '[time]\nmode = "steadily"\n',
    SCENE + "[time]\nwindow = 1.5\n",
    SCENE + "[time]\ntolerance = 1\n",
    SCENE + "[observe]\nextrema = 1\n",
    SCENE + "[observe]\nharmonics = 2\nextremes = true\n",
    SCENE + "[sweep]\nwindow = [1, 2]\n",
    SCENE + "[sweep]\nR = [0.5, 2]\n",
    SCENE + "[sweep]\nR = []\n",
    SCENE + '[sweep]\nR = "linspace(0, 1)"\n',
    SCENE + '[sweep]\nR = "between(0, 1, 3)"\n',
    SCENE + "[seep]\nR = [0.5]\n",
    SCENE + '[branch]\nalong = "x0"\nrange = [0, 1]\n',
    SCENE + '[branch]\nalong = "nu"\nrange = [0.5, 1, 2]\n',
    SCENE + "[output]\ncompression = 10\n",
    SCENE + MACHINE,
    MACHINE + "nu = 1\n",
    MACHINE + 'load = "3 lbf"\n',
    MACHINE + "quality = 0\n",
    "xs = 1\n",
    "title = 3\n" + SCENE,
)


class Schema(CommandLine):
    def setUp(self):
        super().setUp()
        result = self.clatter("defaults", "--schema")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        schema = json.loads(result.stdout)
        jsonschema.Draft7Validator.check_schema(schema)
        self.schema, self.validator = schema, jsonschema.Draft7Validator(schema)

    def mistakes(self, text):
        return [error.message for error in self.validator.iter_errors(tomllib.loads(text))]

    def is_taken(self, text):
        self.write("a.toml", text)
        return self.clatter("plan", "a.toml").returncode == 0

    def test_takes_every_shipped_configuration(self):
        for path in sorted((SOURCE / "configs").glob("*.toml")):
            self.assertEqual(self.mistakes(path.read_text(encoding="utf-8")), [], path.name)
        self.assertEqual(self.mistakes(self.clatter("defaults").stdout), [])

    def test_takes_the_example_of_every_key(self):
        for name, section in self.schema["properties"].items():
            for key in section.get("properties", ()):
                example = (
                    self.clatter("help", f"{name}.{key}").stdout.split("Example\n")[1].split("\n\n  clatter run")[0]
                )
                self.assertEqual(self.mistakes(example), [], (name, key, example))

    def test_takes_what_the_program_takes(self):
        for text in RIGHT:
            self.assertTrue(self.is_taken(text), text)
            self.assertEqual(self.mistakes(text), [], text)

    def test_refuses_what_the_program_refuses(self):
        for text in WRONG:
            self.assertFalse(self.is_taken(text), text)
            self.assertNotEqual(self.mistakes(text), [], text)

    def test_has_the_help_and_the_default_of_every_key(self):
        R = self.schema["properties"]["scene"]["properties"]["R"]
        self.assertEqual(R["description"], "restitution of velocity on both stops (0 ... 1; default: 1)")
        self.assertEqual(R["default"], 1)
        for section in self.schema["properties"].values():
            for key, value in section.get("properties", {}).items():
                self.assertTrue(value.get("description") or all("description" in one for one in value["anyOf"]), key)

    def test_is_of_toml(self):
        result = self.clatter("defaults", "--schema", "--ini")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("--schema conflicts with --ini", result.stderr)


if __name__ == "__main__":
    unittest.main()
