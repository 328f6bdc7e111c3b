"""Numbers of the motions that starts end in: the same for every way to run a sweep, and what a file says of them.

Environment: CLATTER, the program.
"""

import json
import unittest

import h5py
import numpy as np
import xarray
from command_line import CommandLine

SCENE = """[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -3.0
"""
ZONES = (
    SCENE
    + """[sweep]
nu = "linspace(0.85, 1.3, 10)"
x0 = "sobol(-3, 3, 40)"
v0 = "sobol(-6, 6, 40)"
linked = "x0, v0"
[time]
max_periods = 400
[observe]
attractor = true
settling = true
"""
)
PHASES = (  # half of these starts are mirror images of the others
    SCENE
    + """nu = 0.868
[sweep]
x0 = "linspace(-2.9, 2.9, 10)"
v0 = "linspace(-5.9, 5.9, 10)"
phase = "arange(0, 2*pi, pi/4)"
[observe]
attractor = true
"""
)


class Attractors(CommandLine):
    def run_to(self, name, *words):
        result = self.clatter("run", "a.toml", "-o", name, "-q", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return (self.directory / name).read_bytes()

    def test_every_way_to_run_a_sweep_gives_the_same_bytes(self):
        for text in (ZONES, PHASES):
            with self.subTest(text=text):
                self.assert_same_bytes(text)

    def test_the_state_of_a_motion_is_that_of_its_section_in_either_frame(self):
        scene = SCENE.replace("-3.0", "1.0") + "nu = 1.2\nbase_amplitude = 0.2\nstop_phase = 1.1\n"
        for frame in ("relative", "absolute"):
            self.write("a.toml", f'{scene}[observe]\nattractor = true\nsection = 1\nframe = "{frame}"\n')
            self.run_to("a.h5")
            with h5py.File(self.directory / "a.h5") as file:
                for name in "xv":
                    np.testing.assert_allclose(file[f"motion_{name}"][0], file[f"section_{name}"][0], rtol=1e-9)

    def assert_same_bytes(self, text):
        self.write("a.toml", text)
        whole = self.run_to("whole.h5", "--threads", "1")
        self.assertEqual(self.run_to("threads.h5", "--threads", "3"), whole)
        for number in range(3):
            self.run_to(f"{number}.h5", "--shard", f"{number}/3")
        self.assertEqual(self.clatter("merge", "-o", "merged.h5", "0.h5", "1.h5", "2.h5").returncode, 0)
        self.assertEqual((self.directory / "merged.h5").read_bytes(), whole)
        for _ in range(100):  # a busy machine may give a run no time until it is over, and then all of it at once
            if self.stops_of("stopped.h5") > 0:
                break
            (self.directory / "stopped.h5").unlink()
        else:
            self.fail("it is never stopped")
        self.assertEqual((self.directory / "stopped.h5").read_bytes(), whole)
        for path in self.directory.glob("*.h5"):
            path.unlink()

    def stops_of(self, name):
        """How often a run is stopped that is given longer and longer time, until it is done."""
        for attempt in range(100):
            result = self.clatter("run", "a.toml", "-o", name, "-q", "--max-time", f"{0.003 * 1.2**attempt:.4g}")
            if result.returncode == 0:
                return attempt
            self.assertEqual(result.returncode, 124, result.stderr)
        return self.fail("it doesn't get on")

    def test_plan_tells_of_mirror_images(self):
        self.write("a.toml", PHASES)
        said = self.clatter("plan", "a.toml").stdout
        self.assertIn("400 are mirror images of others, (-x0, -v0) half a period later", said)
        self.assertEqual(json.loads(self.clatter("plan", "a.toml", "--json").stdout)["mirror_images"], 400)
        self.assertIn("groups           400 points", self.clatter("run", "a.toml", "-v").stderr)

    def test_a_shard_has_numbers_of_its_own_and_the_states_behind_them(self):
        self.write("a.toml", ZONES)
        self.run_to("a.h5", "--shard", "1/4")
        with h5py.File(self.directory / "a.h5") as file:
            numbers, motions = file["attractor"][()], len(file["motion"])
            self.assertEqual(sorted(set(numbers.tolist()) - {-1}), list(range(motions)))
            self.assertEqual(file["attractor_x"].shape, numbers.shape)
            self.assertNotIn("motion_share", file)

    def test_the_table_fits_the_points(self):
        self.write("a.toml", ZONES)
        self.run_to("a.h5")
        with xarray.open_dataset(self.directory / "a.h5", engine="h5netcdf") as data:
            numbers = data.attractor.values
            self.assertEqual(data.attractor.dtype, np.int32)
            self.assertEqual(data.attractor.dims, ("nu", "x0"))
            self.assertEqual(data.motion_share.dims, ("nu", "motion"))
            counts = (numbers[:, :, None] == data.motion.values).sum(axis=1)
            self.assertEqual(data.motion_points.values.tolist(), counts.sum(axis=0).tolist())
            self.assertEqual(data.motion_count.values.tolist(), (counts > 0).sum(axis=1).tolist())
            np.testing.assert_allclose(data.motion_share.values, counts / 40, rtol=1e-15)
            self.assertTrue((data.motion_share_low.values <= data.motion_share.values).all())
            self.assertTrue((data.motion_share_high.values >= data.motion_share.values).all())
            firsts = [int(np.flatnonzero(numbers.ravel() == motion)[0]) for motion in data.motion.values]
            self.assertEqual(data.motion_example.values.tolist(), firsts)
            self.assertEqual(firsts, sorted(firsts))
            mirrors = data.motion_mirror.values
            self.assertEqual(
                [mirrors[mirror] for mirror in mirrors if mirror >= 0], np.flatnonzero(mirrors >= 0).tolist()
            )
            own = mirrors == data.motion.values
            self.assertEqual(data.motion_symmetric.values.tolist(), own.astype(float).tolist())
            self.assertTrue({"LU", "-"} <= set(data.motion_word.values.tolist()))

    def test_a_state_of_the_table_is_on_its_motion(self):
        self.write("a.toml", ZONES)
        self.run_to("a.h5")
        with h5py.File(self.directory / "a.h5") as file:
            nu, ratio = file["nu"][()], file["motion_period_ratio"][()]
            states = list(zip(file["motion_example"][()] // 40, file["motion_x"][()], file["motion_v"][()], ratio))
        for place, x, v, periods in states:
            if periods == 0:
                continue
            start = [f"scene.nu={float(nu[place])!r}", f"scene.x0={float(x)!r}", f"scene.v0={float(v)!r}"]
            text = ZONES[: ZONES.index("[sweep]")] + ZONES[ZONES.index("[time]") :]
            self.write("b.toml", text + "section = 70\nperiod = true\n")
            words = [word for setting in start for word in ("--set", setting)]
            self.assertEqual(self.clatter("run", "b.toml", "-q", "--force", *words).returncode, 0)
            with h5py.File(self.directory / "b.h5") as file:
                self.assertEqual(file["period_ratio"][()], periods)
                self.assertEqual(file["settling_periods"][()], 0)
                section = np.stack([file["section_x"][()], file["section_v"][()]], axis=-1)[:periods]
            self.assertLess(np.abs(section - [x, v]).max(axis=1).min(), 1e-11)

    def test_motion_that_nothing_attracts_has_no_number(self):
        self.write("a.toml", "[scene]\nxs = 1\n[sweep]\nv0 = [0.5, 1.5]\n[observe]\nattractor = true\n")
        self.run_to("a.h5")
        with h5py.File(self.directory / "a.h5") as file:
            self.assertEqual(file["attractor"][()].tolist(), [-1, -1])
            self.assertEqual(len(file["motion"]), 0)

    def test_free_motion_ends_at_rest(self):
        scene = "[scene]\nh = 0.1\nR = 0.5\nstop_upper = 1\n"
        self.write("a.toml", scene + "[sweep]\nload = [0.5, 2]\nv0 = [-1, 0, 3]\n[observe]\nattractor = true\n")
        self.run_to("a.h5")
        with h5py.File(self.directory / "a.h5") as file:
            self.assertEqual(file["attractor"][()].tolist(), [[0, 0, 0], [1, 1, 1]])
            np.testing.assert_allclose(file["motion_x"][()], [0.5, 1.0], rtol=1e-9)


if __name__ == "__main__":
    unittest.main()
