"""Files of shaken scenes say to every reader in which frame a variable is given.

Environment: CLATTER, the program.
"""

import json
import subprocess
from unittest import main

import h5py
import netCDF4
import numpy
import xarray

from runs import CLATTER, RunTest, quoted, toml

SHAKEN = {"h": 0.1, "R": 0.7, "xs": 0.5, "nu": 1.3, "stop_amplitude": 0.3, "phase": 0.4}
ASKED = ("x_min", "x_max", "v_min", "v_max", "x_amplitude", "x_phase", "v_amplitude", "v_phase", "x", "v", "section_x")
RELATIVE = ("v_before", "v_after", "impact_speed", "impact_v_before", "work_in", "x0")
IN_BOTH = ("status", "period", "tau", "impacts_per_period", "impulse", "impact_tau", "base_frequency", "multiplier_re")


class FrameOfFiles(RunTest):
    def run_in(self, frame):
        observe = {"extrema": True, "harmonics": 2, "trajectory": 9, "section": 1, "impacts": True, "impact_log": True}
        observe |= {"energy": True, "period": True, "stability": True, "frame": f'"{frame}"'}
        return self.run_clatter(toml(scene=SHAKEN, sweep={"x0": [0.0, 0.1]}, observe=observe), name=frame)

    def test_impacts_as_the_ground_sees_them_differ_by_the_velocity_of_the_stops(self):
        for frame in ("relative", "absolute"):
            config = toml(scene={**SHAKEN, "xs": 0.1}, observe={"impact_log": True, "frame": quoted(frame)})
            with h5py.File(self.run_clatter(config, name=frame)) as file:
                theta, before = file["impact_phase"][:], file["impact_v_before"][:]
                absolute = file["impact_v_before_absolute"]
                self.assertEqual(absolute.attrs["frame"], "absolute")
                self.assertGreater(len(theta), 1)
                turns = (1.3 * file["impact_tau"][:] + 0.4 - theta) / (2 * numpy.pi)  # steady: as the samples below
                numpy.testing.assert_allclose(turns, numpy.round(turns), atol=1e-14)
                numpy.testing.assert_allclose(absolute[:], before + 0.3 * 1.3 * numpy.cos(theta), atol=1e-14)

    def assert_frames(self, frame_of, asked):
        for name in ASKED:
            self.assertEqual(frame_of(name), asked, name)
        for name in RELATIVE:
            self.assertEqual(frame_of(name), "relative", name)
        for name in IN_BOTH:
            self.assertIsNone(frame_of(name), name)

    def test_every_reader_finds_the_attribute(self):
        for asked in ("relative", "absolute"):
            path = self.run_in(asked)
            with h5py.File(path) as file:
                self.assert_frames(lambda name: file[name].attrs.get("frame"), asked)
            for engine in ("h5netcdf", "netcdf4"):
                with xarray.open_dataset(path, engine=engine) as data:
                    self.assert_frames(lambda name: data[name].attrs.get("frame"), asked)
            with netCDF4.Dataset(path) as data:
                self.assert_frames(lambda name: getattr(data[name], "frame", None), asked)
            header = subprocess.run(["ncdump", "-h", path], capture_output=True, text=True, check=True).stdout
            self.assertIn(f'x_max:frame = "{asked}" ;', header)

    def test_samples_differ_by_the_motion_of_the_stops(self):
        with h5py.File(self.run_in("relative")) as relative, h5py.File(self.run_in("absolute")) as absolute:
            theta = 1.3 * relative["tau"][:] + 0.4  # steady: observed from a whole number of forcing periods on
            numpy.testing.assert_allclose(absolute["x"][:], relative["x"][:] + 0.3 * numpy.sin(theta), atol=1e-14)
            numpy.testing.assert_array_equal(absolute["v_before"][:], relative["v_before"][:])

    def test_info_and_export_say_it(self):
        path = self.run_in("absolute")
        told = subprocess.run([CLATTER, "info", path], capture_output=True, text=True, check=True).stdout
        self.assertRegex(told, r"x_max .* maximum displacement, absolute\n")
        self.assertRegex(told, r"v_before .* velocity before the first impact, relative\n")
        told = subprocess.run([CLATTER, "info", "--json", path], capture_output=True, text=True, check=True).stdout
        frames = {entry["name"]: entry.get("frame") for entry in json.loads(told)["variables"]}
        self.assertEqual((frames["x_max"], frames["v_before"], frames["status"]), ("absolute", "relative", None))
        command = [CLATTER, "export", path, "--only", "x_max"]
        told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        self.assertIn("# x_max (1): maximum displacement, absolute\n", told)

    def test_files_of_resting_stops_have_no_frame(self):
        scene = {key: value for key, value in SHAKEN.items() if key != "stop_amplitude"} | {"f": 1.0}
        observe = {"extrema": True, "impacts": True, "energy": True, "impact_log": True}
        path = self.run_clatter(toml(scene=scene, observe=observe))
        with h5py.File(path) as file:
            self.assertNotIn("impact_v_before_absolute", file)
            self.assertFalse([name for name in file if "frame" in file[name].attrs])

    def test_shards_are_merged_to_the_same_bytes(self):
        config = toml(
            scene=SHAKEN,
            sweep={"nu": '"linspace(0.8, 2, 7)"', "v0": [-1.0, 1.0]},
            observe={"extrema": True, "attractor": True, "impact_log": True, "frame": '"absolute"'},
        )
        whole = self.run_clatter(config)
        shards = [self.run_clatter(config, f"shard{k}", options=("--shard", f"{k}/2")) for k in (0, 1)]
        merged = self.scratch / "merged.h5"
        subprocess.run([CLATTER, "merge", "-o", merged, *shards], check=True, capture_output=True)
        self.assertEqual(merged.read_bytes(), whole.read_bytes())


if __name__ == "__main__":
    main()
