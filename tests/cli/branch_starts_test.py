"""`branch.period` begins with a state of a motion at any forcing phase, also just before and after an impact.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import math
import unittest

import h5py
import numpy as np
from branch_runs import SCENE, WIDE, BranchRuns
from command_line import CLATTER
from random_scenes import Scene, followed_scenes
from scene_runs import Program, keys_of

TURN = 2 * math.pi
SYMMETRIC = Scene(h=0.1, f=-1.0, nu=1.1, R_lower=0.7, R_upper=0.7, stop_lower=-3.0, stop_upper=3.0, x0=2.0, v0=3.0)
HAMMER = Scene(h=0.1, f=-1.0, nu=1.1, R_upper=0.6, stop_upper=3.0, load=0.1, x0=2.0, v0=3.0)
SHAKEN = HAMMER.changed(base_amplitude=0.2, stop_phase=0.7)
SOFT = SYMMETRIC.changed(stop_stiffness_lower=40.0, stop_stiffness_upper=40.0, stop_damping_upper=0.1)


class Starts(BranchRuns):
    def setUp(self):
        super().setUp()
        self.program = Program(CLATTER, self.directory)

    def states(self, scene, periods):
        """States of the motion from a scene on: at seven phases, and before and after each of its impacts; where it
        touches a soft stop the velocity doesn't change."""
        observe = "[observe]\ntrajectory = 9\nimpact_log = true\n"
        time = f'mode = "transient"\nduration = {TURN * periods / scene.nu!r}\n'
        run = self.program.run([scene], time, observe)
        found = [(run["tau"][0, i], run["x"][0, i], run["v"][0, i]) for i in range(1, 8)]
        for tau, side, before, after in run.logs[0]:
            end = "_lower" if side < 0 else "_upper"
            stop, is_soft = getattr(scene, "stop" + end), math.isfinite(getattr(scene, "stop_stiffness" + end))
            found += [(tau, stop, before)] + ([] if is_soft else [(tau, stop, after)])
        return [scene.changed(x0=x, v0=v, phase=scene.phase + scene.nu * tau) for tau, x, v in found]

    def started(self, scene, periods):
        """The point at which a branch from a start begins, by the scene's frequency."""
        values = "".join(f"{key} = {value!r}\n" for key, value in keys_of(scene).items())
        branch = f'[branch]\nalong = "nu"\nrange = [{scene.nu - 1e-4!r}, {scene.nu + 1e-4!r}]\nperiod = {periods}\n'
        (self.directory / "a.branch.h5").unlink(missing_ok=True)
        done = self.branch(f"[scene]\n{values}{branch}", "-q")
        self.assertTrue((self.directory / "a.branch.h5").exists(), (scene, done.stderr))
        with h5py.File(self.directory / "a.branch.h5") as file:
            at = int(np.argmin(np.abs(file["nu"][()] - scene.nu) + file["branch"][()]))
            self.assertLess(abs(file["nu"][at] - scene.nu), 1e-14 * scene.nu)
            return {name: file[name][at] for name in ("x", "v", "word", "period_ratio", "x_max", "multiplier_re")}

    def assert_same(self, one, other, periods, scene):
        """The state at phase 0 may be that of another of the motion's periods."""
        for name in ("word", "period_ratio"):
            self.assertEqual(one[name], other[name], scene)
        names = ["x_max", "multiplier_re"] + (["x", "v"] if periods == 1 else [])
        for name in names:
            np.testing.assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-9, err_msg=f"{name} of {scene}")

    def assert_begins_anywhere(self, scene, periods):
        """From each of the states of a motion the same point of a branch comes out."""
        begun = self.started(scene, periods)
        starts = self.states(scene, periods)
        for start in starts:
            self.assert_same(begun, self.started(start, periods), periods, start)
        return len(starts)

    def of_branch(self, scene, low, high):
        """Points of the branch of a scene, stable and unstable, as scenes with the period of their motion."""
        found = self.program.branch(scene, [low, high])
        ratio = found["period_ratio"]
        steps = np.abs(found["multiplier_re"]).max(axis=1)
        usable = np.flatnonzero((ratio == np.round(ratio)) & (steps < 1e3) & np.isfinite(found["x"]))
        for i in usable[:: max(1, len(usable) // 8)]:
            at = scene.changed(nu=float(found["nu"][i]), x0=float(found["x"][i]), v0=float(found["v"][i]), phase=0.0)
            yield at, int(ratio[i]), bool(found["stable"][i])

    def test_stable_and_unstable_motion_from_any_of_its_states(self):
        for scene in (SYMMETRIC, HAMMER, SHAKEN, SOFT):
            kinds, starts = set(), 0
            for at, periods, stable in self.of_branch(scene, 0.8 * scene.nu, 1.35 * scene.nu):
                kinds.add(stable)
                starts += self.assert_begins_anywhere(at, periods)
            self.assertGreater(starts, 50)
            self.assertEqual(kinds, {True, False}, scene)

    def test_a_ball_that_bounces_begins_with_its_impact(self):
        """Of its two motions with an impact a period, both are known: x'' = f sin(theta + tau) - 1 from 0 to 0."""
        f, ratio = 0.7, 0.8
        after = TURN * ratio / (1 + ratio)
        found = []
        for sign in (1, -1):
            theta = sign * math.acos(math.pi * (1 - ratio) / (1 + ratio) / f)
            rest = (TURN - theta) % TURN
            x = after * rest - rest**2 / 2 + f * (rest * math.cos(theta) + math.sin(theta))
            v = after - rest + f * (math.cos(theta) - 1)
            for v0 in (after, after - TURN):  # behind the impact and before it
                scene = Scene(f=f, load=-1.0, stiffness=0.0, stop_lower=0.0, R_lower=ratio, v0=v0, phase=theta)
                begun = self.started(scene, 1)
                self.assertEqual(begun["word"], b"L")
                np.testing.assert_allclose((begun["x"], begun["v"]), (x, v), rtol=1e-11)
            found.append(begun)
        self.assertGreater(abs(found[0]["x"] - found[1]["x"]), 0.1)
        unstable = [np.abs(one["multiplier_re"]).max() > 1 for one in found]
        self.assertEqual(sorted(unstable), [False, True])

    def test_random_scenes_from_any_state(self):
        done = 0
        for scene in followed_scenes(12, 7):
            found = self.program.branch(scene, [0.9 * scene.nu, 1.1 * scene.nu])
            if found is None or not math.isfinite(found["x"][0]):
                continue
            steps = np.abs(found["multiplier_re"]).max(axis=1)
            calm = np.flatnonzero((steps < 50) & (found["period_ratio"] == 1) & ~contains_rest(found["word"]))
            if len(calm) < 5:
                continue
            i = calm[len(calm) // 2]
            at = scene.changed(nu=float(found["nu"][i]), x0=float(found["x"][i]), v0=float(found["v"][i]), phase=0.0)
            done += self.assert_begins_anywhere(at, 1)
        self.assertGreater(done, 30)

    def test_a_phase_of_whole_turns_is_phase_zero(self):
        at, periods, _ = next(self.of_branch(SYMMETRIC, 1.0, 1.4))
        plain = self.started(at, periods)
        for turns in (1, -2):
            self.assert_same(plain, self.started(at.changed(phase=turns * TURN), periods), periods, at)

    def test_a_machine_begins_at_its_phase(self):
        """The hammer in SI: lengths in mm, a tenth of a second as unit of time, 2 kg."""
        mass, mm, second = 2.0, 1e-3, 10.0
        along = '[branch]\nalong = "frequency"\nrange = [1.5, 2.5]\nperiod = 1\n'
        for at, periods, _ in list(self.of_branch(HAMMER, 1.0, 1.3))[:3]:
            if periods != 1:
                continue
            wanted = self.started(at, 1)
            for start in self.states(at, 1):
                keys = {
                    "mass": mass,
                    "stiffness": mass * second**2,
                    "damping_ratio": start.h,
                    "force": start.f * mass * second**2 * mm,
                    "load": start.load * mass * second**2 * mm,
                    "frequency": start.nu * second / TURN,
                    "stop_upper": start.stop_upper * mm,
                    "R_upper": start.R_upper,
                    "x0": min(start.x0 * mm, start.stop_upper * mm),
                    "v0": start.v0 * mm * second,
                    "phase": start.phase,
                }
                text = "[machine]\n" + "".join(f"{key} = {value!r}\n" for key, value in keys.items())
                done = self.branch(text + along, "-q", "--force")
                self.assertEqual(done.returncode, 0, done.stderr)
                with h5py.File(self.directory / "a.branch.h5") as file:
                    i = int(np.argmin(np.abs(file["frequency"][()] - keys["frequency"])))
                    self.assertEqual(file["word"][i], wanted["word"])
                    np.testing.assert_allclose(file["x"][i] / mm, wanted["x"], rtol=1e-8, atol=1e-8)
                    np.testing.assert_allclose(file["v"][i] / mm / second, wanted["v"], rtol=1e-8, atol=1e-8)

    def test_motion_that_rests_begins_from_its_rest_and_from_its_impacts(self):
        text = SCENE.replace("xs = -3", "xs = 0.4").replace("nu = 1.1", "nu = 0.3")
        along = WIDE.replace("0.5, 2", "0.29, 0.31")
        plain = text.replace("x0 = 2", "x0 = 0")
        self.assertEqual(self.branch(plain + along, "-q").returncode, 0)
        with h5py.File(self.directory / "a.branch.h5") as file:
            wanted = {name: file[name][()] for name in ("nu", "x", "v", "word")}
        for phase, x, v in ((0.3, 0.4, 0.0), (2.0, -0.4, 0.0), (1.0, 0.4, 0.2), (1.0, 0.4, -0.2)):
            start = text.replace("x0 = 2\nv0 = 3", f"x0 = {x}\nv0 = {v}\nphase = {phase}")
            done = self.branch(start + along + "period = 1\n", "-q", "--force")
            self.assertEqual(done.returncode, 0, (phase, x, v, done.stderr))
            with h5py.File(self.directory / "a.branch.h5") as file:
                for name, values in wanted.items():
                    if name == "word":
                        np.testing.assert_array_equal(file[name][()], values)
                    else:
                        np.testing.assert_allclose(file[name][()], values, rtol=1e-9, atol=1e-9)


def contains_rest(words):
    return np.array([b"*" in word for word in words])


if __name__ == "__main__":
    unittest.main()
