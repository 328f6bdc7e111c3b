"""stop_R: a soft stop that is given by what an isolated collision with it leaves, through every command.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import math
import unittest

import numpy as np
import xarray
from branch_runs import BranchRuns

# A mass without spring or force runs into one soft stop and leaves again.
COLLISION = """[scene]
stiffness = 0.0
stop_upper = 1.0
stop_stiffness = 7.3
x0 = 0.25
v0 = 1.5
[sweep]
{axis}
[time]
mode = "transient"
duration = 60.0
[observe]
impacts = true
impact_log = true
"""
COLLISION_SI = COLLISION.replace("[scene]\nstiffness = 0.0", "[machine]\nmass = '3 kg'").replace("= 7.3", "= '5 kN/m'")
SHARES = [0.001, 0.0032, 0.01, 0.04, 0.1, 0.12, 0.13, 0.135, 0.13533528, math.exp(-2), 0.1353353, 0.136, 0.14, 0.17]
SHARES += [0.2, 0.3, 0.41, 0.55, 0.7, 0.85, 0.97, 0.999, 0.99999999, 1.0]

# Between soft stops, with a fold along their damping.
FOLDED = """[scene]
h = 0.07348171131018699
f = 0.7744553861214791
nu = 0.5428592602346645
stop_lower = -0.3850112765699967
stop_upper = 0.24644200708264635
stop_stiffness = 302.41480489265393
base_amplitude = -0.05515689488862529
x0 = -0.05352519760842442
v0 = -0.04996595917614489
"""


def restitution(zeta):
    """Equation 55, for zeta below 1."""
    return math.exp(-2 * zeta * math.acos(zeta) / math.sqrt(1 - zeta * zeta))


class SoftRestitution(BranchRuns):
    def run_text(self, name, text, *words):
        result = self.clatter("run", self.write(f"{name}.toml", text), "-o", f"{name}.h5", "-q", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return xarray.open_dataset(self.directory / f"{name}.h5", engine="h5netcdf")

    def test_an_isolated_collision_leaves_that_share_of_the_speed(self):
        for text in (COLLISION, COLLISION_SI):
            data = self.run_text("collision", text.format(axis=f"stop_R = {SHARES}"))
            np.testing.assert_array_equal(data.impact_v_before.values, np.full(len(SHARES), data.impact_v_before[0]))
            before, after = data.v_before.sel(stop=1).values, -data.v_after.sel(stop=1).values
            np.testing.assert_allclose(before, 1.5, rtol=1e-15)
            # a contact is located to some roundings, and its motion is steep if the stop is overdamped
            np.testing.assert_allclose(after / before, SHARES, rtol=1e-12)

    def test_it_is_the_stop_of_that_damping_ratio(self):
        zetas = [0.02, 0.1, 0.35, 0.6, 0.95]
        shares = [restitution(zeta) for zeta in zetas]
        scene = "[scene]\nf = -1.0\nh = 0.1\nxs = 0.5\nnu = 1.1\nstop_stiffness = 60.0\n[observe]\nextrema = true\n"
        follow = '[sweep]\nfollow = "{0}"\n{0} = {1}\n'
        by_ratio = self.run_text("ratio", scene + follow.format("stop_damping", zetas))
        by_share = self.run_text("share", scene + follow.format("stop_R", shares))
        self.assertEqual(by_share.stop_R.attrs["long_name"], "restitution of both soft stops")
        np.testing.assert_allclose(by_share.x_max, by_ratio.x_max, rtol=1e-13)
        ends = f"stop_R_lower = {shares[1]}\nstop_R_upper = {shares[2]}\n"
        sides = self.run_text("sides", scene.replace("[observe]", ends + "[observe]"))
        ratios = self.run_text(
            "ratios", scene.replace("[observe]", "stop_damping_lower=0.1\nstop_damping_upper=0.35\n[observe]")
        )
        np.testing.assert_allclose([sides.x_min, sides.x_max], [ratios.x_min, ratios.x_max], rtol=1e-13)

    def special_points(self, text):
        return [json.loads(line) for line in self.branch(text, "--json", "-q").stdout.splitlines()]

    def folds(self, given, along, ends):
        text = FOLDED + given + f'[branch]\nalong = "{along}"\nrange = [{min(ends)}, {max(ends)}]\n'
        special = self.special_points(text)
        return sorted(point[along] for point in special if point["kind"] == "fold")

    def test_a_branch_along_it_folds_at_that_of_the_damping_ratio(self):
        """The scene may give the damping in the other way, of which the branch begins."""
        zeta, ends = 0.11322410680103415, (0.034, 0.339)
        shares = [restitution(end) for end in ends]
        by_ratio = self.folds(f"stop_damping = {zeta}\n", "stop_damping", ends)
        self.assertGreater(len(by_ratio), 1)
        for given in (f"stop_R = {restitution(zeta)}\n", f"stop_damping = {zeta}\n"):
            by_share = self.folds(given, "stop_R", shares)
            np.testing.assert_allclose(by_share, [restitution(fold) for fold in reversed(by_ratio)], rtol=1e-9)
        other_way = self.folds(f"stop_R = {restitution(zeta)}\n", "stop_damping", ends)
        np.testing.assert_allclose(other_way, by_ratio, rtol=1e-9)

    def test_a_curve_of_folds_in_the_plane_with_another_parameter_is_the_same(self):
        across = 'across = "stop_stiffness"\nacross_range = [250, 350]\ncurve = "fold"\nmax_points = 300\n'
        given = "stop_damping = 0.11322410680103415\n"
        curves = {}
        for along, ends in (("stop_damping", [0.034, 0.27]), ("stop_R", [0.4, 0.9])):
            text = FOLDED + given + f'[branch]\nalong = "{along}"\nrange = {ends}\n' + across
            (curves[along],) = [point for point in self.special_points(text) if point["kind"] == "graze"]
        by_ratio, by_share = curves["stop_damping"], curves["stop_R"]
        self.assertAlmostEqual(by_share["stop_R"], restitution(by_ratio["stop_damping"]), 9)
        self.assertAlmostEqual(by_share["stop_stiffness"] / by_ratio["stop_stiffness"], 1, 9)

    def test_the_complete_configuration_runs_again_to_the_same_bytes(self):
        text = COLLISION.format(axis="v0 = [1.0, 2.0]").replace("v0 = 1.5\n", "stop_R_upper = 0.4\n")
        self.run_text("once", text).close()
        complete = self.clatter("info", "once.h5", "--config").stdout
        self.assertIn("stop_R_upper = 0.4\n", complete)
        self.assertNotIn("stop_damping", complete)
        self.run_text("again", complete).close()
        first, second = ((self.directory / name).read_bytes() for name in ("once.h5", "again.h5"))
        self.assertEqual(first, second)


if __name__ == "__main__":
    unittest.main()
