"""Programs that people plot with find in clatter's files the names, axes and types that its guide promises.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory. A reader that isn't installed is a failure.
"""

import hashlib
import os
import subprocess
import tomllib
import warnings
from pathlib import Path
from unittest import main

import h5py
import netCDF4
import numpy
import xarray

from command_line import LONGEST
from runs import CLATTER, FORCED, RunTest, quoted, toml

SOURCE = Path(os.environ["CLATTER_SOURCE"])

ALWAYS = {"status": "uint8", "impact_total": "int64", "simulated_periods": "float64", "settling_estimate": "float64"}
ALWAYS_OF_TRANSIENTS = {name: kind for name, kind in ALWAYS.items() if name != "settling_estimate"}
FLAGS = {
    0: "periodic",
    1: "aperiodic",
    2: "transient",
    3: "grazing",
    4: "undecided",
    5: "creeping",
    16: "event_budget",
    17: "not_finite",
    18: "unresolved",
    19: "escaped",
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
    "scene_names",
    "instruction_set",
]
# Axes have the same names and order whatever their lengths: some points of the configurations that have many.
SHORTER = {
    "basins": ("x0=linspace(-3, 3, 7)", "v0=linspace(-6, 6, 5)"),
    "optimal_zones": ("nu=linspace(1, 13, 3)", "x0=sobol(-0.5, 0.5, 8)", "v0=sobol(-5, 5, 8)"),
    "regimes": ("nu=linspace(0.3, 1.3, 7)", "xs=linspace(0.05, 2.05, 5)"),
    "zones": ("nu=linspace(0.5, 1.5, 3)", "x0=sobol(-3, 3, 8)", "v0=sobol(-6, 6, 8)"),
}


class Readers(RunTest):
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
            kinds = {name: data[name].dtype for name in data.variables}
            kinds = {name: "object" if kind is str else str(kind) for name, kind in kinds.items()}
            found = {name: (data[name].dimensions, kinds[name]) for name in data.variables}
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
        kinds = {"float64": "double", "uint8": "ubyte", "int8": "byte", "int64": "int64", "object": "string"}
        done = subprocess.run(["ncdump", "-h", path], capture_output=True, text=True, check=True, timeout=LONGEST)
        self.assertEqual(done.stderr, "")
        for name, (names, kind) in variables.items():
            shape = f"({', '.join(names)})" if names else ""
            self.assertIn(f"\t{kinds[kind]} {name}{shape} ;\n", done.stdout)

    def test_words(self):
        config = toml(sweep={"nu": [0.3, 0.9], "xs": [-0.5, -9.0]}, observe={"word": True})
        path = self.run_clatter(config)
        axes = {"nu": (("nu",), "float64"), "xs": (("xs",), "float64")}
        results = {**ALWAYS, "impact_word": "object", "regime": "object", "symmetric": "float64"}
        over = {name: (("nu", "xs"), kind) for name, kind in results.items()}
        self.assert_contents(path, {"nu": 2, "xs": 2}, {**axes, **over})
        words, regimes = [["L*U*", "-"], ["LU", "-"]], [["inf/1", "0/1"], ["1/1", "0/1"]]
        for engine in ("h5netcdf", "netcdf4"):
            with xarray.open_dataset(path, engine=engine) as data:
                self.assertEqual(data["impact_word"].values.tolist(), words)
                self.assertEqual(data["regime"].values.tolist(), regimes)
        with h5py.File(path) as file:
            self.assertEqual(file["impact_word"].asstr()[()].tolist(), words)
        done = subprocess.run(["ncdump", "-v", "regime", path], capture_output=True, text=True, check=True)
        self.assertIn('"inf/1", "0/1",\n  "1/1", "0/1" ;', done.stdout)

    def test_one_axis(self):
        config = toml(
            "Größter Ausschlag",
            sweep={"nu": quoted("linspace(0.9, 1.1, 5)")},
            observe={"extrema": True, "impacts": True, "period": True, "stability": True},
        )
        path = self.run_clatter(config)
        on_nu = {
            **ALWAYS,
            **dict.fromkeys(("x_min", "x_max", "v_min", "v_max", "period", "period_ratio"), "float64"),
            **dict.fromkeys(("eigenfrequency", "velocity_ratio", "lyapunov"), "float64"),
        }
        on_stops = ("impacts_per_period", "v_before", "v_after", "impact_speed", "rest_fraction")
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

    def test_linked_axes_are_coordinates_of_the_results_along_them(self):
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
    LOG |= {"impact_phase": "float64"}

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
        done = subprocess.run([CLATTER, "run", config, "-o", output], capture_output=True, check=False, timeout=LONGEST)
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
        self.assertNotIn(
            str(self.scratch).encode(), path.read_bytes()
        )  # the file doesn't tell the folder it was made in

    def test_every_configuration_has_its_axes(self):
        configurations = sorted([*SOURCE.glob("configs/*.toml"), *SOURCE.glob("configs/*.ini")])
        self.assertGreater(len(configurations), 20)
        for config in configurations:
            with self.subTest(config=config.name):
                sets = [word for axis in SHORTER.get(config.stem, ()) for word in ("--set", f"sweep.{axis}")]
                path = self.run_clatter(config, config.stem, options=sets)
                with h5py.File(path) as file:
                    sweep = tomllib.loads(file.attrs["config"]).get("sweep", {})
                linked = [key.strip() for key in sweep.pop("linked", "").split(",")]
                sweep.pop("follow", None)
                both = ["direction"] if sweep.pop("direction", "up") == "both" else []
                axes = both + [key for key in sweep if key not in linked[1:]]
                for engine in ("h5netcdf", "netcdf4"):
                    with xarray.open_dataset(path, engine=engine) as data:
                        self.assertEqual(list(data.status.dims), axes)
                        self.assertTrue(set(sweep) <= set(data.variables))
                header = subprocess.run(["ncdump", "-h", path], capture_output=True, text=True, check=True).stdout
                for axis in axes:
                    self.assertIn(f"{'byte' if axis == 'direction' else 'double'} {axis}({axis}) ;", header)

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


if __name__ == "__main__":
    main()
