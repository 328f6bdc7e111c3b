"""What the programs that people plot with find in clatter's files: the names, axes and types of its contract.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory. A reader that isn't installed is a failure.
"""

import hashlib
import os
import subprocess
import tempfile
import tomllib
import unittest
import warnings
from pathlib import Path

import h5py
import netCDF4
import numpy
import xarray

CLATTER = os.environ["CLATTER"]
SOURCE = Path(os.environ["CLATTER_SOURCE"])

ALWAYS = {"status": "uint8", "impact_total": "int64", "simulated_periods": "float64", "settling_estimate": "float64"}
ALWAYS_OF_TRANSIENTS = {name: kind for name, kind in ALWAYS.items() if name != "settling_estimate"}
FLAGS = {
    0: "periodic",
    1: "aperiodic",
    2: "transient",
    3: "grazing",
    16: "event_budget",
    17: "not_finite",
    18: "unresolved",
}
ROOT = [
    "Conventions",
    "title",
    "source",
    "clatter_schema",
    "clatter_version",
    "git_commit",
    "config",
    "config_sha256",
    "compiler",
]
FORCED = {"f": -1.0, "h": 0.1, "R": 0.7, "xs": -0.5}


def toml(title="", scene=FORCED, **sections):
    """A configuration as text; a section is given as a dictionary, and what [sweep] holds isn't repeated in [scene]."""
    lines = [f'title = "{title}"']
    scene = {key: value for key, value in scene.items() if key not in sections.get("sweep", {})}
    for name, keys in {"scene": scene, **sections}.items():
        lines.append(f"[{name}]")
        lines += [f"{key} = {repr(value).lower() if isinstance(value, bool) else value}" for key, value in keys.items()]
    return "\n".join(lines).replace("'", '"') + "\n"


def quoted(text):
    return f'"{text}"'


class Readers(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = Path(scratch.name)

    def run_clatter(self, config, name="out", threads=1, environment=None, options=()):
        """Runs a configuration, a text or a path, and returns the path of its output."""
        if isinstance(config, str):
            path = self.scratch / f"{name}.toml"
            path.write_text(config, encoding="utf-8")
            config = path
        output = self.scratch / f"{name}.h5"
        done = subprocess.run(
            [CLATTER, "run", config, "-o", output, "--threads", str(threads), *options],
            capture_output=True,
            text=True,
            check=False,
            timeout=300,
            env={**os.environ, **(environment or {})},
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return output

    def assert_contents(self, path, dimensions, variables):
        """Every reader finds exactly these dimensions {name: length} and variables {name: (dimensions, type)}."""
        for engine in ("h5netcdf", "netcdf4"):
            with self.subTest(engine=engine), warnings.catch_warnings():
                warnings.simplefilter("error")  # a reader that has doubts says so by a warning
                with xarray.open_dataset(path, engine=engine, mask_and_scale=False) as data:
                    self.assertEqual(dict(data.sizes), dimensions)
                    found = {name: (data[name].dims, str(data[name].dtype)) for name in data.variables}
                    self.assertEqual(found, variables)
        with self.subTest(reader="netCDF4"), netCDF4.Dataset(path) as data:
            self.assertEqual({name: len(dimension) for name, dimension in data.dimensions.items()}, dimensions)
            found = {name: (data[name].dimensions, str(data[name].dtype)) for name in data.variables}
            self.assertEqual(found, variables)
        with self.subTest(reader="h5py"):
            self.assert_hdf5(path, dimensions, variables)
        with self.subTest(reader="ncdump"):
            self.assert_ncdump(path, variables)

    def assert_hdf5(self, path, dimensions, variables):
        with h5py.File(path) as file:
            self.assertEqual(set(file), set(variables) | set(dimensions))
            for name, (names, kind) in variables.items():
                dataset = file[name]
                self.assertEqual(dataset.dtype, numpy.dtype(kind).newbyteorder("<"), name)
                self.assertTrue(dataset.attrs["long_name"], name)
                self.assertEqual(dataset.attrs["units"], "rad" if name.endswith("phase") else "1", name)
                is_coordinate = names == (name,)
                if not is_coordinate:
                    self.assertEqual(tuple(dimension[0].name[1:] for dimension in dataset.dims), names)
                self.assertEqual("_FillValue" in dataset.attrs, kind == "float64" and not is_coordinate, name)
                if "_FillValue" in dataset.attrs:
                    self.assertEqual(dataset.attrs["_FillValue"].shape, (1,))
                    self.assertTrue(numpy.isnan(dataset.attrs["_FillValue"][0]))
                    self.assertTrue(numpy.isnan(dataset.fillvalue))

    def assert_ncdump(self, path, variables):
        kinds = {"float64": "double", "uint8": "ubyte", "int8": "byte", "int64": "int64"}
        done = subprocess.run(["ncdump", "-h", path], capture_output=True, text=True, check=True, timeout=60)
        self.assertEqual(done.stderr, "")
        for name, (names, kind) in variables.items():
            shape = f"({', '.join(names)})" if names else ""
            self.assertIn(f"\t{kinds[kind]} {name}{shape} ;\n", done.stdout)

    def test_one_axis(self):
        config = toml(
            "Größter Ausschlag",
            sweep={"nu": quoted("linspace(0.9, 1.1, 5)")},
            observe={"extrema": True, "impacts": True, "period": True, "stability": True},
        )
        path = self.run_clatter(config)
        on_nu = {
            **ALWAYS,
            **dict.fromkeys(
                (
                    "x_min",
                    "x_max",
                    "v_min",
                    "v_max",
                    "period",
                    "period_ratio",
                    "eigenfrequency",
                    "velocity_ratio",
                    "lyapunov",
                ),
                "float64",
            ),
        }
        on_stops = ("impacts_per_period", "v_before", "v_after", "rest_fraction")
        self.assert_contents(
            path,
            {"nu": 5, "stop": 2, "multiplier": 2},
            {
                "nu": (("nu",), "float64"),
                "stop": (("stop",), "int8"),
                "multiplier": (("multiplier",), "int8"),
                **{name: (("nu", "multiplier"), "float64") for name in ("multiplier_re", "multiplier_im")},
                **{name: (("nu",), kind) for name, kind in on_nu.items()},
                **{name: (("nu", "stop"), "float64") for name in on_stops},
            },
        )
        with xarray.open_dataset(path) as data:
            self.assertEqual(list(data.nu.values), [0.9 + i * (1.1 - 0.9) / 4 for i in range(4)] + [1.1])
            self.assertEqual(list(data.stop.values), [-1, 1])
            self.assertTrue(numpy.isnan(data.eigenfrequency).all())  # forced
            self.assertTrue((data.x_min < data.x_max).all())

    def test_two_axes_in_the_order_of_the_sweep(self):
        config = toml(sweep={"R": [0.5, 0.7], "nu": [0.9, 1.0, 1.1]}, observe={"extrema": True})
        both = ("R", "nu")
        self.assert_contents(
            self.run_clatter(config),
            {"R": 2, "nu": 3},
            {
                "R": (("R",), "float64"),
                "nu": (("nu",), "float64"),
                **{name: (both, kind) for name, kind in ALWAYS.items()},
                **{name: (both, "float64") for name in ("x_min", "x_max", "v_min", "v_max")},
            },
        )

    def test_linked_axes_share_the_dimension_of_the_first(self):
        config = toml(sweep={"nu": [0.9, 1.0, 1.1], "f": [-1.0, -1.1, -1.2], "linked": quoted("nu, f")})
        path = self.run_clatter(config)
        self.assert_contents(
            path,
            {"nu": 3},
            {
                "nu": (("nu",), "float64"),
                "f": (("nu",), "float64"),
                **{name: (("nu",), kind) for name, kind in ALWAYS.items()},
            },
        )
        with h5py.File(path) as file:
            self.assertEqual(list(file["f"]), [-1.0, -1.1, -1.2])

    def test_linked_axes_are_coordinates_of_what_runs_along_them(self):
        linked = quoted("nu, f, load")
        sweep = {
            "nu": [0.9, 1.0, 1.1],
            "f": [-1.0, -1.1, -1.2],
            "load": [0, 0.1, 0.2],
            "R": [0.5, 0.7],
            "linked": linked,
        }
        path = self.run_clatter(toml(sweep=sweep, observe={"extrema": True, "impacts": True, "impact_log": True}))
        for engine in ("h5netcdf", "netcdf4"):
            with self.subTest(engine=engine), xarray.open_dataset(path, engine=engine) as data:
                self.assertEqual(set(data.coords), {"nu", "f", "load", "R", "stop"})
                self.assertEqual(set(data.x_max.coords), {"nu", "f", "load", "R"})
                self.assertEqual(set(data.impact_tau.coords), set())
                self.assertEqual(float(data.x_max.swap_dims(nu="f").sel(f=-1.1, R=0.5)), float(data.x_max[1, 0]))

    def test_no_axes_give_scalars(self):
        self.assert_contents(
            self.run_clatter(toml(observe={"extrema": True})),
            {},
            {
                **{name: ((), kind) for name, kind in ALWAYS.items()},
                **{name: ((), "float64") for name in ("x_min", "x_max", "v_min", "v_max")},
            },
        )

    def test_transient_with_trajectory(self):
        config = toml(time={"mode": quoted("transient"), "duration": 20.0}, observe={"trajectory": 33})
        path = self.run_clatter(config)
        self.assert_contents(
            path,
            {"sample": 33},
            {
                **{name: ((), kind) for name, kind in ALWAYS_OF_TRANSIENTS.items()},
                **{name: (("sample",), "float64") for name in ("tau", "x", "v")},
            },
        )
        with xarray.open_dataset(path) as data:
            self.assertEqual(int(data.status), 2)
            self.assertEqual([float(data.tau[0]), float(data.tau[-1])], [0.0, 20.0])

    def test_harmonics(self):
        config = toml(sweep={"nu": [0.9, 1.0]}, observe={"harmonics": 3})
        path = self.run_clatter(config)
        spectra = ("x_amplitude", "x_phase", "v_amplitude", "v_phase")
        self.assert_contents(
            path,
            {"nu": 2, "harmonic": 4},
            {
                "nu": (("nu",), "float64"),
                "harmonic": (("harmonic",), "int64"),
                "base_frequency": (("nu",), "float64"),
                **{name: (("nu",), kind) for name, kind in ALWAYS.items()},
                **{name: (("nu", "harmonic"), "float64") for name in spectra},
            },
        )
        with xarray.open_dataset(path) as data:
            self.assertEqual(list(data.harmonic), [0, 1, 2, 3])
            self.assertTrue(numpy.isnan(data.x_phase[:, 0]).all())  # the constant part has none

    LOG = {"impact_tau": "float64", "impact_stop": "int8", "impact_v_before": "float64", "impact_v_after": "float64"}

    def assert_log(self, path, impacts, always):
        self.assert_contents(
            path,
            {"nu": 2, "impact": impacts},
            {
                "nu": (("nu",), "float64"),
                "impact_count": (("nu",), "int64"),
                **{name: (("nu",), kind) for name, kind in always.items()},
                **{name: (("impact",), kind) for name, kind in self.LOG.items()},
            },
        )
        with h5py.File(path) as file:
            self.assertEqual(file["impact_count"][:].sum(), impacts)
            self.assertEqual(file["impact_count"].attrs["sample_dimension"], "impact")

    def test_impact_log(self):
        config = toml(
            sweep={"nu": [0.9, 1.0]}, time={"mode": quoted("transient"), "duration": 50.0}, observe={"impact_log": True}
        )
        path = self.run_clatter(config)
        with xarray.open_dataset(path) as data:
            impacts = data.sizes["impact"]
            self.assertGreater(impacts, 4)
            self.assertEqual(set(data.impact_stop.values), {-1, 1})
        self.assert_log(path, impacts, ALWAYS_OF_TRANSIENTS)

    def test_impact_log_without_impacts(self):
        config = toml(scene={**FORCED, "xs": -100.0}, sweep={"nu": [0.9, 1.0]}, observe={"impact_log": True})
        self.assert_log(self.run_clatter(config), 0, ALWAYS)

    def test_flags_and_failed_points(self):
        config = self.scratch / "failed.toml"
        config.write_text(toml(sweep={"R": [0.5, 1.0]}, time={"max_impacts": 3}, observe={"extrema": True}))
        output = self.scratch / "failed.h5"
        done = subprocess.run([CLATTER, "run", config, "-o", output], capture_output=True, check=False, timeout=60)
        self.assertEqual(done.returncode, 1)
        with xarray.open_dataset(output) as data:
            self.assertEqual(list(data.status.attrs["flag_values"]), list(FLAGS))
            self.assertEqual(data.status.attrs["flag_values"].dtype, data.status.dtype)
            self.assertEqual(data.status.attrs["flag_meanings"].split(), list(FLAGS.values()))
            self.assertEqual(list(data.status), [16, 16])
            self.assertTrue(numpy.isnan(data.x_min).all())
        with netCDF4.Dataset(output) as data:
            self.assertTrue(numpy.ma.getmaskarray(data["x_min"][:]).all())  # NaN is the fill value

    def test_root_attributes(self):
        path = self.run_clatter(toml("Größter Ausschlag", observe={"extrema": True}))
        with h5py.File(path) as hdf5, netCDF4.Dataset(path) as netcdf, xarray.open_dataset(path) as data:
            for attributes in (dict(hdf5.attrs), netcdf.__dict__, data.attrs):
                self.assertEqual(sorted(attributes), sorted(ROOT))
                self.assertEqual(attributes["Conventions"], "CF-1.10")
                self.assertEqual(attributes["title"], "Größter Ausschlag")
                self.assertEqual(attributes["source"], "")
                self.assertEqual(attributes["clatter_schema"], "clatter/1")
                text = attributes["config"].encode()
                self.assertEqual(attributes["config_sha256"], hashlib.sha256(text).hexdigest())
            self.assertEqual(list(data.attrs), ROOT)
        self.assertNotIn(str(self.scratch).encode(), path.read_bytes())  # where it was made stays out of it

    def test_every_configuration_has_its_axes(self):
        configurations = sorted([*SOURCE.glob("configs/*.toml"), *SOURCE.glob("configs/*.ini")])
        self.assertGreater(len(configurations), 20)
        for config in configurations:
            with self.subTest(config=config.name):
                path = self.run_clatter(config, config.stem)
                with h5py.File(path) as file:
                    sweep = tomllib.loads(file.attrs["config"]).get("sweep", {})
                linked = [key.strip() for key in sweep.pop("linked", "").split(",")]
                sweep.pop("follow", None)
                axes = [key for key in sweep if key not in linked[1:]]
                for engine in ("h5netcdf", "netcdf4"):
                    with xarray.open_dataset(path, engine=engine) as data:
                        self.assertEqual(list(data.status.dims), axes)
                        self.assertTrue(set(sweep) <= set(data.variables))
                header = subprocess.run(["ncdump", "-h", path], capture_output=True, text=True, check=True).stdout
                for axis in axes:
                    self.assertIn(f"double {axis}({axis}) ;", header)

    def test_the_configuration_inside_gives_the_same_file(self):
        path = self.run_clatter(SOURCE / "configs" / "fig16.toml")
        with h5py.File(path) as file:
            again = self.run_clatter(file.attrs["config"], name="again")
        self.assertEqual(path.read_bytes(), again.read_bytes())

    def test_threads_and_memory_leave_the_bytes(self):
        config = toml(
            sweep={"nu": quoted("linspace(0.5, 1.5, 101)"), "R": [0.5, 0.7]},
            observe={"extrema": True, "impacts": True, "harmonics": 3, "impact_log": True, "trajectory": 65},
        )
        one = self.run_clatter(config, "one", threads=1).read_bytes()
        self.assertEqual(one, self.run_clatter(config, "two", threads=2).read_bytes())
        fill = {"MALLOC_PERTURB_": "165"}  # malloc no longer gives zeros: nothing uninitialised gets into the file
        self.assertEqual(one, self.run_clatter(config, "three", threads=2, environment=fill).read_bytes())

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
            return subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout

        for path in self.outputs_to_copy():
            original = contents(path)
            for command in ("nccopy -k nc4", "nccopy -d 4 -s", "h5repack", "h5repack -m 1 -f SHUF -f GZIP=4"):
                with self.subTest(file=path.name, command=command):
                    copy = self.scratch / "copy.h5"
                    copy.unlink(missing_ok=True)
                    subprocess.run([*command.split(), path, copy], capture_output=True, check=True, timeout=60)
                    self.assertEqual(contents(copy), original)
                    subprocess.run([CLATTER, "info", copy], capture_output=True, check=True, timeout=60)

    def test_xarray_makes_classic_netcdf_of_outputs(self):
        """The guide's way: nccopy can't, since classic files have no texts of variable length. They have one dimension
        of length 0 at most, of which a shard without points, and so without impacts, has two."""
        for path in self.outputs_to_copy():
            if path.stem == "empty_shard":
                continue
            copy = self.scratch / "classic.nc"
            xarray.load_dataset(path).to_netcdf(copy, format="NETCDF3_64BIT")
            kind = subprocess.run(["ncdump", "-k", copy], capture_output=True, text=True, check=True, timeout=60).stdout
            self.assertEqual(kind, "64-bit offset\n")
            with self.subTest(path.name), xarray.open_dataset(path) as one, xarray.open_dataset(copy) as other:
                self.assertEqual(one.attrs, other.attrs)
                xarray.testing.assert_equal(one, other)


if __name__ == "__main__":
    unittest.main()
