"""Linked axes whose values are valid together at each point, though not each with every other one.

Environment: CLATTER, the program.
"""

import subprocess
import unittest

import h5py
import numpy as np

from runs import CLATTER, RunTest, quoted, toml

LOOSE = {"h": 0.02, "nu": 1.3, "loose_mass": 0.05, "loose_R": 0.6, "loose_load": -0.1, "loose_v0": 0.3}
FORCED = {"h": 0.1, "f": 1, "nu": 1.2, "v0": 0.5}
STOPS = FORCED | {"R": 0.7}
SHORT = {"mode": quoted("transient"), "duration": 20}
INF = "inf"
# What doesn't vary, and the linked axes, which are refused if they cross each other
SWEEPS = [
    (LOOSE | {"f": 0.3}, {"loose_lower": ["-inf", -0.5], "loose_upper": [0.4, INF]}),
    (STOPS | {"stop_lower": "-inf"}, {"stiffness": [0, 1], "stop_upper": [1, INF]}),
    (STOPS, {"stiffness": [0, 1, 0], "stop_lower": ["-inf", "-inf", -1], "stop_upper": [1, INF, INF]}),
    (STOPS | {"xs": 0.5}, {"stop_amplitude": [0.1, 0], "base_amplitude": [0, 0.1]}),
    (STOPS | {"xs": 0.5}, {"stop_amplitude": [0.1, 0], "friction": [0, 0.1]}),
    (FORCED | {"xs": 0.5}, {"stop_stiffness": [50, INF], "x0": [0.6, 0.2]}),
    (FORCED | {"x0": 0.6}, {"stop_stiffness": [50, INF], "xs": [0.5, 0.7]}),
    ({"f": 1, "stop_lower": -1, "stop_R_upper": 0.7}, {"stop_upper": [1, INF], "stop_stiffness_upper": [50, INF]}),
]


def sweep_of(axes, linked):
    lists = {key: f"[{', '.join(map(str, values))}]" for key, values in axes.items()}
    return lists | ({"linked": quoted(", ".join(axes))} if linked else {})


class LinkedAxes(RunTest):
    def values(self, scene, sweep, time, name):
        observe = {"trajectory": 3, "extrema": True}
        with h5py.File(self.run_clatter(toml(scene=scene, sweep=sweep, time=time, observe=observe), name)) as file:
            return {key: file[key][()] for key in ("x", "v", "x_min", "x_max", "impact_total")}

    def test_each_point_is_judged_by_its_own_values(self):
        for n, (scene, axes) in enumerate(SWEEPS):
            with self.subTest(axes=axes):
                together = self.values(scene, sweep_of(axes, True), SHORT, f"linked{n}")
                for i in range(len(next(iter(axes.values())))):
                    point = {key: values[i] for key, values in axes.items()}
                    alone = self.values(scene | point, {}, SHORT, f"alone{n}_{i}")
                    for name, values in alone.items():
                        np.testing.assert_array_equal(together[name][i], values, err_msg=name)

    def test_every_pair_is_judged_if_they_cross(self):
        for n, (scene, axes) in enumerate(SWEEPS):
            path = self.scratch / f"crossed{n}.toml"
            path.write_text(toml(scene=scene, sweep=sweep_of(axes, False), time=SHORT, observe={"extrema": True}))
            done = subprocess.run([CLATTER, "plan", path], capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual(done.returncode, 2, f"{axes}: {done.stderr}")


if __name__ == "__main__":
    unittest.main()
