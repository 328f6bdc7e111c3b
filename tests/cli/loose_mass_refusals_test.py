"""What doesn't go with a loose mass, and wrong values of its keys: a sentence says what, where and what to do.

Environment: CLATTER, the program.
"""

import re
import unittest

from command_line import CommandLine

SCENE = "[scene]\nh = 0.02\nf = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6\n"
MACHINE = '[machine]\nmass = "2 kg"\nstiffness = "8 N/mm"\nforce = "20 N"\nfrequency = "9 Hz"\nloose_mass = "50 g"\n'
REMEDY = r"expected |leave |name |give |take |set |remove |use |write |did you mean"


class Refusals(CommandLine):
    def assert_told(self, text, keys, *command):
        """Refused in one line that names the keys and says what to do."""
        command = command or ("run",)
        self.write("a.toml", text)
        words = (command[0], "a.toml", "-o", "a.h5", *command[1:])
        self.assert_refused(2, keys[0], *words)
        said = self.clatter(*words).stderr
        for key in keys:
            self.assertIn(key, said)
        self.assertRegex(said, REMEDY)

    def test_what_does_not_know_it(self):
        for key in ("R", "stop_upper", "stop_stiffness", "friction", "stop_amplitude"):
            asked = f'{SCENE}[observe]\nsensitivity = "nu, {key}"\n'
            self.assert_told(asked, (f"sensitivity names '{key}'", "loose_mass"))

    def test_derivatives_by_keys_that_it_lacks(self):
        without = "".join(line + "\n" for line in SCENE.splitlines() if "loose" not in line) + "xs = 1\n"
        self.assert_told(f'{without}[observe]\nsensitivity = "loose_R"\n', ("'loose_R'", "without 'loose_mass'"))
        walls = SCENE.replace("loose_gap = 1.9", "loose_lower = -1.9")
        asked = '[observe]\nsensitivity = "loose_gap"\n'
        self.assert_told(walls + asked, ("'loose_gap'", "name 'loose_lower' or 'loose_upper'"))
        self.assert_told(f'{SCENE}[observe]\nsensitivity = "loose_x0"\n', ("'loose_x0'", "a start"))

    def test_soft_walls(self):
        rigid = SCENE.replace("loose_R = 0.6\n", "")
        soft = rigid + "loose_wall_stiffness = 30\n"
        cases = {
            SCENE + "loose_wall_stiffness = 30\n": ("loose_wall_stiffness", "loose_R"),
            soft + "loose_wall_R = 0.5\nloose_wall_damping = 0.1\n": ("loose_wall_damping", "loose_wall_R"),
            soft + "loose_wall_stiffness_upper = 9\n": ("loose_wall_stiffness_upper", "loose_wall_stiffness"),
            rigid + "loose_wall_stiffness = 0\n": ("loose_wall_stiffness = 0",),
            rigid + "loose_wall_R = 0.5\n": ("loose_wall_R", "loose_R"),
            rigid + "loose_wall_stiffness_lower = 9\nloose_wall_R = 0.5\n": ("upper one is rigid",),
            rigid.replace("loose_mass = 0.05\nloose_gap = 1.9\n", "xs = 1\nloose_wall_stiffness = 9\n"): (
                "loose_mass",
            ),
            soft + '[observe]\nsensitivity = "f"\n': ("loose_wall_stiffness", "sensitivity"),
        }
        for text, keys in cases.items():
            with self.subTest(text=text):
                self.assert_told(text, keys)
        self.assert_told(
            soft + '[branch]\nalong = "nu"\nrange = [1, 2]\n', ("loose_wall_stiffness", "[branch]"), "branch"
        )

    def test_what_the_main_mass_does_not_have_beside_it(self):
        for key, value in {"stop_amplitude": "0.1", "start_period": "3"}.items():
            with self.subTest(key=key):
                self.assert_told(f"{SCENE}{key} = {value}\n", (key,))

    def test_what_does_not_know_stops_beside_it(self):
        for own in ("xs = 2", "stop_upper = 3", "friction = 0.1", "stiffness = 0"):
            if "friction" not in own:
                asked = '[observe]\nsensitivity = "friction"\n'
                self.assert_told(f"{SCENE}{own}\n{asked}", ("loose_mass", "'friction'"))
            for key in ("base_amplitude", "stop_amplitude"):
                asked = f'[observe]\nsensitivity = "{key}"\n'
                if own != "stiffness = 0" or key == "stop_amplitude":
                    self.assert_told(f"{SCENE}{own}\n{asked}", ("loose_mass", f"'{key}'"))
            if "friction" in own:
                branch = f'{SCENE}{own}\n[branch]\nalong = "nu"\nrange = [1, 2]\n'
                self.assert_told(branch, ("loose_mass", "[branch]"), "branch")
            if own != "stiffness = 0":
                self.assert_told(f"{SCENE}{own}\nbase_amplitude = 0.1\n", ("loose_mass", "base_amplitude"))

    def test_what_it_needs(self):
        self.assert_told(SCENE.replace("loose_gap = 1.9\n", ""), ("loose_mass", "loose_gap"))
        without = SCENE.replace("loose_mass = 0.05\n", "")
        for key in ("loose_gap", "loose_R"):
            lines = [line for line in without.splitlines() if key in line or "loose" not in line]
            self.assert_told("\n".join(lines) + "\n", (key, "loose_mass"))

    def test_wrong_values(self):
        wrong = {"loose_mass": ("-0.1", "nan", "inf"), "loose_gap": ("0", "-1", "inf")}
        wrong |= {"loose_R": ("1.1", "-0.1"), "loose_x0": ("2", "-1.91", "nan"), "loose_load": ("inf",)}
        wrong |= {"loose_v0": ("nan",), "loose_lower": ("-1",), "loose_mas": ("1",)}
        for key, values in wrong.items():
            lines = "".join(line + "\n" for line in SCENE.splitlines() if not line.startswith(f"{key} "))
            for value in values:
                with self.subTest(key=key, value=value):
                    self.assert_told(f"{lines}{key} = {value}\n", (key,))
        for key in ("loose_x0", "loose_v0"):  # only the first point would start from it
            follow = f'{SCENE}[sweep]\n{key} = "linspace(0, 1, 5)"\nfollow = "{key}"\n'
            self.write("a.toml", follow)
            self.assert_refused(
                2, f"'{key}', which only the first point would start from", "run", "a.toml", "-o", "a.h5"
            )
        starts = f'{SCENE}[sweep]\nloose_x0 = "linspace(-2, 2, 5)"\n[observe]\nattractor = true\n'
        self.assert_told(starts, ("loose_x0", "between the walls"))
        walls = SCENE.replace("loose_gap = 1.9", "loose_lower = 1\nloose_upper = -1")
        self.assert_told(walls, ("loose_lower", "loose_upper"))
        self.assert_told(walls.replace("-1", "1"), ("loose_lower", "loose_upper"))

    def test_wrong_units(self):
        for key, value in {"loose_gap": "5 kg", "loose_load": "3 N", "loose_v0": "3 m"}.items():
            gap = "" if key == "loose_gap" else 'loose_gap = "5 mm"\n'
            self.assert_told(f'{MACHINE}{gap}{key} = "{value}"\n', (re.sub(r"^\d+ ", "", value),))
        self.assert_told(MACHINE.replace("50 g", "50 mm") + 'loose_gap = "5 mm"\n', ("'mm'", "mass"))


if __name__ == "__main__":
    unittest.main()
