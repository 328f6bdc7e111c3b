"""Sweeps with `follow` and a loose mass: each point is the run that begins where the point before ended.

Environment: CLATTER, the program.
"""

import unittest

import h5py
import numpy as np

from command_line import CommandLine

SCENE = {"h": 0.02, "f": 0.3, "nu": 1.3, "loose_mass": 0.05, "loose_gap": 1.9, "loose_R": 0.6, "loose_v0": 0.3}
PRESSED = {**SCENE, "f": 0.05, "loose_load": -0.4}  # the lower wall presses the loose mass for all time
OBSERVE = {"trajectory": 2, "word": True, "impact_log": True, "section": 4, "extrema": True}
STEADY = {"max_periods": 300}
SETTLED = {"max_periods": 1500}
SHORT = {"max_periods": 4, "window": 3}  # so that chaos makes no difference of rounding large
STATE = {"x0": "x", "v0": "v", "loose_x0": "z", "loose_v0": "w"}


def text_of(scene, time, sweep=None, section="scene", observe=OBSERVE):
    """A configuration as text."""
    lines = []
    for name, keys in {section: scene, "sweep": sweep or {}, "time": time, "observe": observe}.items():
        lines += [f"[{name}]"] * bool(keys)
        for key, value in keys.items():
            lines.append(f"{key} = {str(value).lower() if isinstance(value, bool) else repr(value)}")
    return "\n".join(lines).replace("'", '"') + "\n"


class Followed(CommandLine):
    def run_text(self, text, name="out.h5", *words):
        self.write("a.toml", text)
        done = self.clatter("run", "a.toml", "-o", name, "-q", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return self.directory / name

    def observed(self, *arguments, **more):
        """The variables of an output, by name; the impacts of each point apart."""
        with h5py.File(self.run_text(text_of(*arguments, **more))) as file:
            data = {
                name: value.asstr()[()] if h5py.check_string_dtype(value.dtype) else value[()]
                for name, value in file.items()
                if isinstance(value, h5py.Dataset) and value.dtype.kind in "fiuO"
            }
        ends = np.cumsum(data["impact_count"].ravel())[:-1]
        for name in ("impact_tau", "impact_stop", "impact_v_before"):
            data[name] = np.split(data[name], ends)
        return data

    def assert_chain(self, scene, along, *, direction="up", section="scene", time=STEADY, advance=None, exactly=True):
        """Each point is that run; `advance(values)` is by how much the phase grows in it. Returns the points."""
        (key, values) = along
        sweep = {key: list(map(float, values)), "follow": key, "direction": direction}
        fixed = {name: value for name, value in scene.items() if name != key}
        points = self.observed(fixed, time, sweep, section=section)
        order = range(len(values)) if direction == "up" else range(len(values) - 1, -1, -1)
        start = {}
        for i in order:
            changed = {**scene, **start, key: float(values[i])}
            alone = self.observed(changed, time, section=section)
            self.assertEqual(points["status"][i], alone["status"])
            for name in ("impact_tau", "impact_stop", "impact_v_before"):
                self.assert_close(points[name][i], alone[name][0], exactly, name)
            for name in (*"xvzw", "section_z", "section_w", "x_max", "y_min", "z_max"):
                self.assert_close(points[name][i], alone[name], exactly, name)
            start = {begin: float(points[end][i][-1]) for begin, end in STATE.items()}
            if advance is not None:
                start["phase"] = changed.get("phase", 0.0) + advance(float(values[i]))
        return points

    def assert_same_bytes(self, text):
        """On one thread and on two, in shards that are merged, and stopped and resumed."""
        whole = self.run_text(text, "whole.h5", "--threads", "1").read_bytes()
        self.assertEqual(self.run_text(text, "two.h5", "--threads", "2").read_bytes(), whole)
        shards = [f"{number}.h5" for number in range(3)]
        for number, name in enumerate(shards):
            self.run_text(text, name, "--shard", f"{number}/3")
        self.assertEqual(self.clatter("merge", "-o", "merged.h5", *shards).returncode, 0)
        self.assertEqual((self.directory / "merged.h5").read_bytes(), whole)
        self.assert_resumed(whole)

    def assert_resumed(self, whole):
        """A run that is stopped time and again, and goes on from its journal, has these bytes in the end."""
        for attempt in range(200):
            done = self.clatter("run", "a.toml", "-o", "stopped.h5", "-q", "--max-time", f"{0.01 * 1.1**attempt:.4g}")
            if done.returncode == 0:
                break
        self.assertGreater(attempt, 0)
        self.assertEqual((self.directory / "stopped.h5").read_bytes(), whole)

    def assert_close(self, one, other, exactly, name):
        if exactly:
            np.testing.assert_array_equal(one, other, err_msg=name)
        else:
            self.assertEqual(one.shape, other.shape)
            size = np.abs(other).max(initial=0.0)
            np.testing.assert_allclose(one, other, rtol=1e-8, atol=1e-8 * size, err_msg=name)


class Chains(Followed):
    def test_up_and_down(self):
        values = np.linspace(0.9, 1.7, 17)
        up = self.assert_chain(SCENE, ("nu", values))
        down = self.assert_chain(SCENE, ("nu", values), direction="down")
        self.assertGreater(len(set(up["impact_word"])), 2)
        self.assertGreater(np.sum(up["status"] == 0), 3)
        self.assertGreater(np.abs(up["x_max"] - down["x_max"]).max(), 1e-3)

    def test_both_ways_are_one_chain(self):
        values = np.linspace(0.9, 1.7, 9)
        sweep = {"nu": list(map(float, values)), "follow": "nu", "direction": "both"}
        scene = {key: value for key, value in SCENE.items() if key != "nu"}
        both = self.observed(scene, STEADY, sweep)
        up = self.observed(scene, STEADY, {**sweep, "direction": "up"})
        for name in "xvzw":
            np.testing.assert_array_equal(both[name][0], up[name])
        turned = {begin: float(up[end][-1][-1]) for begin, end in STATE.items()}
        down = self.observed({**scene, **turned}, STEADY, {**sweep, "direction": "down"})
        for name in "xvzw":
            np.testing.assert_array_equal(both[name][1], down[name])

    def test_a_wall_goes_on_pressing_the_loose_mass(self):
        start = {"loose_x0": -1.9, "loose_v0": 0.0}
        points = self.assert_chain({**PRESSED, **start}, ("f", np.linspace(0.05, 0.25, 6)), time=SETTLED)
        self.assertEqual(list(points["impact_word"][:4]), ["(L)"] * 4)
        self.assertTrue((points["z"][:4] == -1.9).all() and (points["w"][:4] == 0).all())

    def test_narrower_walls_take_the_loose_mass_along(self):
        scene = {**PRESSED, "loose_x0": -1.5, "loose_v0": 0.0}
        gaps = [2.0, 1.9, 1.7, 1.5]
        sweep = {"loose_gap": gaps, "follow": "loose_gap"}
        fixed = {key: value for key, value in scene.items() if key != "loose_gap"}
        points = self.observed(fixed, SETTLED, sweep)
        for i, gap in enumerate(gaps):
            np.testing.assert_array_equal(points["z"][i], [-gap, -gap])
            self.assertEqual(points["impact_total"][i] > 0, i == 0)
        wider = self.observed(fixed, SETTLED, {**sweep, "direction": "down"})  # it falls onto the wall further away
        np.testing.assert_array_equal(wider["z"][:, -1], np.negative(gaps))
        self.assertTrue((wider["impact_total"][:-1] > 0).all())

    def test_a_transient_goes_on_at_the_phase_at_which_it_was_cut(self):
        time = {"mode": "transient", "duration": 17.3}
        masses = np.linspace(0.05, 0.2, 7)

        def advance(_):
            return 17.3 * SCENE["nu"]

        scene = {**SCENE, "phase": 0.4}
        sweep = {"loose_mass": list(map(float, masses)), "follow": "loose_mass"}
        fixed = {key: value for key, value in scene.items() if key != "loose_mass"}
        points = self.observed(fixed, time, sweep)
        start = {}
        for i, mass in enumerate(masses):
            alone = self.observed({**scene, **start, "loose_mass": float(mass)}, time)
            for name in "xvzw":
                self.assert_close(points[name][i], alone[name], False, name)
            start = {begin: float(points[end][i][-1]) for begin, end in STATE.items()}
            start["phase"] = 0.4 + (i + 1) * advance(mass)

    def test_a_shaken_base_keeps_the_motion_over_it(self):
        scene = {**SCENE, "f": 0.0, "base_amplitude": 0.2, "phase": 0.7}
        for axis in (("nu", np.linspace(1.0, 1.5, 6)), ("base_amplitude", np.linspace(0.1, 0.3, 6))):
            self.assert_chain(scene, axis, exactly=False, time=SHORT)

    def test_a_machine_in_SI(self):
        machine = {"mass": 0.35, "stiffness": 2835.0, "damping": 1.26, "force": 1.7, "frequency": 18.6}
        machine |= {"loose_mass": 0.0175, "loose_gap": 3.8e-3, "loose_R": 0.6, "loose_v0": 0.05}
        for axis in (("frequency", np.linspace(17.0, 20.0, 6)), ("stiffness", np.linspace(2700.0, 3000.0, 5))):
            self.assert_chain(machine, axis, section="machine", exactly=False, time=SHORT)


class Bytes(Followed):
    def test_every_way_to_run_a_sweep_gives_the_same_bytes(self):
        scene = {key: value for key, value in SCENE.items() if key not in ("nu", "loose_v0")}
        sweep = {"nu": "linspace(0.9, 1.7, 9)", "loose_v0": "linspace(-1, 1, 7)", "follow": "nu", "direction": "both"}
        text = text_of(scene, STEADY, sweep, observe={"word": True, "section": 2, "extrema": True})
        self.assert_same_bytes(text)


if __name__ == "__main__":
    unittest.main()
