"""Deflated outputs, and copies of outputs by the tools of HDF5 and netCDF, hold the same values.

Environment: CLATTER, the program. A tool that isn't installed is a failure.
"""

import subprocess
from unittest import main

import h5py
import numpy
import xarray

from command_line import LONGEST
from runs import CLATTER, FORCED, RunTest, quoted, toml


class Copies(RunTest):
    def test_large_arrays_are_deflated_in_moderate_chunks(self):
        with h5py.File(
            self.run_clatter(
                toml(
                    time={"mode": quoted("transient"), "duration": 100.0},
                    observe={"trajectory": 200000},
                    output={"compression": 4},
                )
            )
        ) as file:
            self.assertEqual((file["x"].compression, file["x"].shuffle), ("gzip", True))
            self.assertLessEqual(file["x"].chunks[0] * 8, 2**20)
            self.assertEqual(len(set(file["tau"][:])), 200000)  # several chunks, each in its place
            self.assertTrue((numpy.diff(file["tau"]) > 0).all())
            self.assertIsNone(file["status"].chunks)

    def test_deflated_values_are_the_same_in_every_reader(self):
        texts = {
            level: toml(
                sweep={"nu": quoted("linspace(0.5, 1.5, 21)")},
                observe={"trajectory": 501},
                output={"compression": level},
            )
            for level in (0, 1, 9)
        }
        paths = {level: self.run_clatter(text, f"level{level}") for level, text in texts.items()}
        with h5py.File(paths[0]) as plain:
            self.assertIsNone(plain["x"].chunks)
            for level in (1, 9):
                for engine in ("h5netcdf", "netcdf4"):
                    with xarray.open_dataset(paths[level], engine=engine) as data:
                        self.assertEqual(data["x"].encoding["complevel"], level)
                        numpy.testing.assert_array_equal(data["x"].values, plain["x"][...])
                two = self.run_clatter(texts[level], "two", threads=2)
                self.assertEqual(two.read_bytes(), paths[level].read_bytes())

    def outputs_to_copy(self):
        """Large and small arrays, logs with and without impacts, a point, shards with and without points, deflated."""
        sweep, log = {"nu": quoted("linspace(0.9, 1.1, 9)")}, {"extrema": True, "impact_log": True}
        far = {**FORCED, "xs": -100.0}
        yield self.run_clatter(toml("Größter Ausschlag", sweep=sweep, observe={**log, "trajectory": 2001}), "log")
        yield self.run_clatter(toml(scene=far, sweep=sweep, observe=log, output={"compression": 4}), "no_impacts")
        yield self.run_clatter(toml(observe={"extrema": True}), "point")
        for name, shard in (("shard", "1/2"), ("empty_shard", "10/11")):
            yield self.run_clatter(toml(sweep=sweep, observe=log), name, options=("--shard", shard))
        deflated = toml(sweep=sweep, observe={"trajectory": 2001}, output={"compression": 4})
        yield self.run_clatter(deflated, "deflated")

    def test_copies_of_netcdf4_and_hdf5_hold_the_same(self):
        """Those of the guide of results: for h5repack a chunk can't have the length 0 of an array, hence -m."""

        def contents(path):
            command = ["ncdump", "-p", "9,17", "-n", "any", path]
            return subprocess.run(command, capture_output=True, text=True, check=True, timeout=LONGEST).stdout

        for path in self.outputs_to_copy():
            original = contents(path)
            for command in ("nccopy -k nc4", "nccopy -d 4 -s", "h5repack", "h5repack -m 1 -f SHUF -f GZIP=4"):
                with self.subTest(file=path.name, command=command):
                    copy = self.scratch / "copy.h5"
                    copy.unlink(missing_ok=True)
                    subprocess.run([*command.split(), path, copy], capture_output=True, check=True, timeout=LONGEST)
                    self.assertEqual(contents(copy), original)
                    subprocess.run([CLATTER, "info", copy], capture_output=True, check=True, timeout=LONGEST)

    def test_xarray_makes_classic_netcdf_of_outputs(self):
        """The guide's way: nccopy can't, since classic files have no texts of variable length. They have one dimension
        of length 0 at most, of which a shard without points, and so without impacts, has two."""
        for path in self.outputs_to_copy():
            if path.stem == "empty_shard":
                continue
            copy = self.scratch / "classic.nc"
            xarray.load_dataset(path).to_netcdf(copy, format="NETCDF3_64BIT")
            kind = subprocess.run(
                ["ncdump", "-k", copy], capture_output=True, text=True, check=True, timeout=LONGEST
            ).stdout
            self.assertEqual(kind, "64-bit offset\n")
            with self.subTest(path.name), xarray.open_dataset(path) as one, xarray.open_dataset(copy) as other:
                self.assertEqual(one.attrs, other.attrs)
                xarray.testing.assert_equal(one, other)


if __name__ == "__main__":
    main()
