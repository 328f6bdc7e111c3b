"""Branches of motion with a loose mass beside stops: measures against runs, words, ends, and what isn't followed.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import unittest

import h5py
import numpy as np
from branch_runs import BranchRuns

OWN = "xs = 0.5\nv0 = 0.1\nloose_mass = 0.2\nloose_R = 0.6\nloose_v0 = 0.3\nh = 0.05\n"
RIGID, DAMPED, SPRING = "R = 0.7\n", "stop_stiffness = 20\nstop_damping = 0.3\n", "stop_stiffness = 20\n"
SCENES = {  # by the word of the motion that each settles on, of the period of the force
    "LlulUulu": "nu = 0.8\nf = 0.6\nloose_gap = 0.3\n" + RIGID,
    "LlulUu": "nu = 0.8\nf = 0.3\nloose_gap = 0.3\nstiffness = -0.2\n" + RIGID,
    "LlUuuu": "nu = 1.1\nf = 0.3\nloose_gap = 0.5\n" + DAMPED,
    "LlulUuUlu": "nu = 0.8\nf = 1.0\nloose_gap = 0.3\n" + DAMPED,
    "LlUul": "nu = 1.1\nf = 0.3\nloose_gap = 0.5\nload = 0.05\nloose_load = -0.05\n" + SPRING,
}
KEYS = ("nu", "f", "h", "xs", "loose_gap", "loose_R", "loose_mass")
OBSERVED = "[observe]\nextrema = true\nstability = true\nimpacts = true\nenergy = true\nword = true\n"
SAME = ("x_min", "x_max", "v_min", "v_max", "y_min", "y_max", "z_min", "z_max", "impact_power")
ALIKE = {"word": "impact_word", "regime": "regime"}


class BranchLooseMassBesideStops(BranchRuns):
    def followed(self, text, *words):
        done = self.branch(text, "--force", "-q", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.output()

    def output(self):
        with h5py.File(self.directory / "a.branch.h5") as data:
            return {name: values[()] for name, values in data.items() if isinstance(values, h5py.Dataset)}

    def run_at(self, text, key, branch, points):
        """Steady motion at points of a branch, from their states on."""
        keys = {"x0": "x", "v0": "v", "loose_x0": "z", "loose_v0": "w", key: key}
        for own in keys:
            text = "\n".join(line for line in text.splitlines() if not line.startswith(f"{own} ="))
        axes = "".join(f"{own} = {[float(branch[name][k]) for k in points]}\n" for own, name in keys.items())
        linked = ", ".join(f'"{own}"' for own in keys)
        self.write("s.toml", f"{text}\n{OBSERVED}[sweep]\n{axes}linked = [{linked}]\n")
        done = self.clatter("run", "s.toml", "-o", "s.h5", "-q", "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "s.h5") as data:
            return {name: values[()] for name, values in data.items() if isinstance(values, h5py.Dataset)}

    def test_measures_are_those_of_runs(self):
        for word, own in SCENES.items():
            text = self.settled(f"[scene]\n{own}{OWN}", word)
            for key in KEYS:
                value = next(float(line.split("= ")[1]) for line in text.splitlines() if line.startswith(f"{key} ="))
                limits = f"[{0.95 * value!r}, {1.05 * value!r}]"
                with self.subTest(word=word, key=key):
                    self.check(text, key, f'[branch]\nalong = "{key}"\nrange = {limits}\nperiod = 1\n')

    def check(self, text, key, along):
        branch = self.followed(text + "[observe]\nenergy = true\n" + along)
        inside = (np.diff(branch["branch"], prepend=-1) == 0) & (np.diff(branch["branch"], append=-1) == 0)
        stable = np.flatnonzero(inside & (branch["stable"] == 1) & (branch["period_ratio"] == 1))
        self.assertGreater(len(stable), 10)
        points = stable[np.unique(np.linspace(0, len(stable) - 1, 12).astype(int))]
        run = self.run_at(text, key, branch, points)
        for name in SAME:
            np.testing.assert_allclose(run[name], branch[name][points], rtol=1e-7, atol=1e-9, err_msg=name)
        for name, of_run in ALIKE.items():
            self.assertEqual(list(run[of_run]), list(branch[name][points]), name)
        for name in ("impact_speed", "wall_impact_speed"):
            fastest = np.nanmax(np.nan_to_num(run[name]), axis=-1)
            np.testing.assert_allclose(fastest, branch[name][points], rtol=1e-7, atol=1e-9, err_msg=name)
        of_run = np.sort(np.hypot(run["multiplier_re"], run["multiplier_im"]))
        told = np.sort(np.hypot(branch["multiplier_re"][points], branch["multiplier_im"][points]))
        np.testing.assert_allclose(of_run, told, atol=1e-6)

    def settled(self, text, word):
        """The scene with the state of the motion that it settles on."""
        self.write("b.toml", text + "[time]\nmax_periods = 2000\n[observe]\nattractor = true\n")
        self.assertEqual(self.clatter("run", "b.toml", "-o", "b.h5", "-q", "--force").returncode, 0)
        with h5py.File(self.directory / "b.h5") as data:
            self.assertEqual((data["motion_word"][0].decode(), data["motion_period_ratio"][0]), (word, 1))
            state = {key: float(np.ravel(data["motion_" + name][0])[0]) for key, name in zip(STATE, "xvzw")}
        lines = [line for line in text.splitlines() if line.split(" =")[0] not in STATE]
        return "\n".join(lines) + "\n" + "".join(f"{key} = {value!r}\n" for key, value in state.items())

    def test_ends_and_starts_that_are_not_followed(self):
        """Two events at once; a mass that may be anywhere; a wall that presses."""
        at_once = self.settled("[scene]\nnu = 0.8\nf = 0.6\nloose_gap = 0.3\n" + RIGID + OWN, "LlulUulu")
        done = self.branch(at_once + '[branch]\nalong = "loose_gap"\nrange = [0.2, 1.2]\n', "--json", "-q")
        kinds = [json.loads(line)["kind"] for line in done.stdout.splitlines()]
        self.assertIn("simultaneous events", kinds)
        anywhere = "[scene]\nnu = 1.5\nf = 0.3\nloose_gap = 0.3\nstiffness = 0\n" + RIGID + OWN.replace("0.5", "5", 1)
        for text, told in (
            (anywhere, "anywhere between"),
            ("[scene]\nnu = 1.1\nf = 0.3\nloose_gap = 0.3\n" + DAMPED + OWN, "a wall presses the loose mass"),
        ):
            done = self.branch(text + '[branch]\nalong = "nu"\nrange = [1, 1.6]\n', "--force")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(told, done.stderr)

    def test_points_of_curves_are_special_points_of_branches(self):
        """A branch at the second parameter of a point of a curve has that special point; of Neimark-Sacker points the
        pair of multipliers lies on the unit circle."""
        sink = (
            "[scene]\nh = 0.02\nf = 0.3\nloose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6\nnu = 1.2\nloose_v0 = 0.5\n"
        )
        beside = self.settled("[scene]\n" + SCENES["LlUuuu"] + OWN, "LlUuuu")
        for text, along, across, curve in (
            (sink, ("nu", 1.1, 1.35), ("loose_R", 0.5, 0.7), "Neimark-Sacker"),
            (sink + "stop_upper = 9\n", ("nu", 1.1, 1.35), ("loose_mass", 0.03, 0.07), "Neimark-Sacker"),
            (beside, ("loose_R", 0.55, 0.65), ("stop_damping", 0.28, 0.32), "fold"),
            (beside, ("loose_R", 0.55, 0.65), ("loose_gap", 0.49, 0.51), "flip"),
            (beside, ("loose_R", 0.55, 0.65), ("xs", 0.49, 0.51), "graze"),
        ):
            branch = f'[branch]\nalong = "{along[0]}"\nrange = [{along[1]}, {along[2]}]\n'
            second = f'across = "{across[0]}"\nacross_range = [{across[1]}, {across[2]}]\ncurve = "{curve}"\n'
            with self.subTest(along=along, across=across, curve=curve):
                curves = self.followed(text + branch + second)
                first, other = curves[along[0]], curves[across[0]]
                inside = np.flatnonzero((first > along[1] * 1.01) & (first < along[2] * 0.99) & (curves["branch"] == 0))
                self.assertGreater(len(inside), 8)
                self.assertGreater(np.ptp(other[inside]), 0.1 * (across[2] - across[1]))
                if curve == "Neimark-Sacker":
                    pair = (curves["multiplier_re"] + 1j * curves["multiplier_im"])[inside, 0]
                    np.testing.assert_allclose(abs(pair), 1, atol=1e-9)
                for k in inside[:: max(1, len(inside) // 4)]:
                    lines = [line for line in text.splitlines() if line.split(" =")[0] not in (*STATE, *across[:1])]
                    state = zip(STATE, (curves[name][k] for name in "xvzw"))
                    start = "".join(f"{key} = {float(value)!r}\n" for key, value in state)
                    scene = "\n".join(line for line in lines if line.split(" =")[0] != along[0])
                    period = round(curves["period_ratio"][k])
                    for beside in (1 + 1e-5, 1 - 1e-5):  # the motion may be on one side alone
                        at = f"{across[0]} = {other[k]!r}\n{along[0]} = {first[k] * beside!r}\n{start}"
                        done = self.branch(f"{scene}\n{at}{branch}period = {period}\n", "--force", "-q")
                        if done.returncode == 0:
                            break
                    self.assertEqual(done.returncode, 0, done.stderr)
                    near = self.output()
                    there = near["special_" + along[0]][near["special_kind"] == curve.encode()]
                    self.assertLess(np.min(abs(there - first[k])), 1e-8 * first[k])

    def test_a_container_without_a_spring_is_followed_where_it_is(self):
        text = "[scene]\nnu = 1.2\nf = 0.5\nh = 0.1\nstiffness = 0\nloose_mass = 0.3\nloose_gap = 0.3\nloose_R = 0.6\n"
        for x0 in (0.0, 7.0):
            branch = self.followed(f'{text}loose_v0 = 0.5\nx0 = {x0}\n[branch]\nalong = "nu"\nrange = [1.1, 1.3]\n')
            near = np.min(np.hypot(branch["multiplier_re"] - 1, branch["multiplier_im"]), axis=1)
            np.testing.assert_allclose(near, 0, atol=1e-4)  # the root of rounding, beside a second one
            self.assertTrue(np.any(branch["stable"] == 1))
            middle = (branch["x_min"] + branch["x_max"]) / 2
            if x0 == 0:
                first = branch
            else:
                wide = branch["x_max"] - branch["x_min"], first["x_max"] - first["x_min"]
                np.testing.assert_allclose(
                    np.interp(1.2, branch["nu"], wide[0]), np.interp(1.2, first["nu"], wide[1]), rtol=1e-3
                )
                self.assertGreater(middle.min(), 5)


STATE = ("x0", "v0", "loose_x0", "loose_v0")


if __name__ == "__main__":
    unittest.main()
