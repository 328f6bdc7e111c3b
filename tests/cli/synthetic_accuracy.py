"""Outputs as `clatter accuracy` writes them, with made-up numbers, for tests of their pictures."""

import h5py
import numpy as np

ARCHS = ("scalar", "sse2", "avx2", "avx512")
METHODS = ("exact", "dopri5", "moreau", "harmonics_exact", "harmonics_fft", "steady", "steady_repetition")
STATUSES = {0: "periodic", 1: "aperiodic", 2: "transient", 16: "event_budget", 17: "not_finite", 18: "unresolved"}
RESULTS = (
    "error_contact_time",
    "error_contact_speed",
    "error_extrema",
    "error_harmonics",
    "error_harmonics_v",
    "error_rest",
    "missed",
    "doubled",
    "impacts",
    "simulated_periods",
    "ns_per_period",
    "ns_spread",
)
MOTION = ("error_contact_time", "error_contact_speed", "error_extrema")
CONFIG = """title = "Minimum and maximum displacement, xs = -4"
source = "doi:10.5755/j02.mech.32277, Fig. 22"

[scene]
h = 0.1
f = -1.0
R = 0.7
xs = -4.0
nu = 1.0
"""


class SyntheticAccuracy:
    """The rows of an accuracy run in memory: settings, and for each result an array over the axes and the rows."""

    def __init__(self, steady=True, **axes):
        settings = {
            "exact": [np.nan],
            "dopri5": 10.0 ** -np.arange(3, 14),
            "moreau": 10.0 ** -np.arange(1, 6),
            "harmonics_exact": [np.nan],
            "harmonics_fft": 2.0 ** np.arange(4, 21),
        }
        if steady:
            settings |= dict.fromkeys(("steady", "steady_repetition"), 10.0 ** -np.arange(3, 15))
        self.axes = {name: np.asarray(values, float) for name, values in axes.items()}
        self.method = np.concatenate(
            [[METHODS.index("exact")], *([METHODS.index(name)] * len(values) for name, values in settings.items())]
        )
        self.setting = np.concatenate([[np.nan], *settings.values()])
        self.arch = np.zeros(len(self.method), np.uint8)
        self.arch[0] = ARCHS.index("avx512")
        shape = (*map(len, self.axes.values()), len(self.method))
        self.status = np.zeros(shape, np.uint8)
        self.results = {name: np.full(shape, np.nan) for name in RESULTS}
        self.chance = np.random.default_rng(1)
        self.fill()

    def rows(self, method, setting=None, arch="scalar"):
        """Index of a method's rows at all points, or of the one with this setting."""
        found = (self.method == METHODS.index(method)) & (self.arch == ARCHS.index(arch))
        return np.s_[..., found if setting is None else found & np.isclose(self.setting, setting, rtol=1e-9, atol=0)]

    def put(self, method, **values):
        """Sets results of a method's rows, scattered a little from row to row and from point to point."""
        for name, value in values.items():
            part = self.results[name][self.rows(method)]
            self.results[name][self.rows(method)] = value * self.chance.lognormal(0.0, 0.15, part.shape)

    def put_motion(self, method, error, time):
        self.put(
            method,
            error_contact_time=error,
            error_contact_speed=2 * error,
            error_extrema=0.5 * error,
            ns_per_period=time,
            ns_spread=0.08 * time,
        )
        for name, value in (("missed", 0.0), ("doubled", 0.0), ("impacts", 200.0), ("simulated_periods", 100.0)):
            self.results[name][self.rows(method)] = value

    def fill(self):
        self.put_motion("exact", np.array([3e-15]), np.array([1400.0]))
        for name, value in (("error_extrema", 5e-15), ("ns_per_period", 120.0), ("ns_spread", 9.0), ("missed", 0.0)):
            self.results[name][self.rows("exact", arch="avx512")] = value
        tolerance = self.setting[self.rows("dopri5")[1]]
        self.put_motion("dopri5", 4 * tolerance + 1e-13, 2600.0 * (1e-3 / tolerance) ** 0.17)
        step = self.setting[self.rows("moreau")[1]]
        self.put_motion("moreau", 2 * step, 25.0 / step + 60)
        self.results["ns_spread"][self.rows("moreau", 1e-5)] = np.nan
        self.results["missed"][self.rows("moreau", 1e-1)] = 12.0
        self.results["doubled"][self.rows("dopri5", 1e-3)] = 1.0
        samples = self.setting[self.rows("harmonics_fft")[1]]
        self.put(
            "harmonics_fft",
            error_harmonics=3.0 * samples**-2.0,
            error_harmonics_v=2.0 / samples,
            ns_per_period=30 * samples,
        )
        self.put("harmonics_exact", error_harmonics=np.array([2e-16]), ns_per_period=np.array([900.0]))
        for method, slowness in (("steady", 0.0), ("steady_repetition", 1.0)):
            tolerance = self.setting[self.rows(method)[1]]
            if len(tolerance):
                newton = np.where(tolerance > 1e-5, 0.3 * tolerance, 3e-16)
                error = 0.8 * tolerance if slowness else newton
                self.put(method, error_contact_time=error, error_extrema=0.6 * error, error_harmonics=0.9 * error)
                periods = 5 + 7 * np.arange(len(tolerance)) if slowness else np.where(tolerance > 1e-5, 4, 6)
                self.results["simulated_periods"][self.rows(method)] = periods

    def sweep(self):
        """The axes as lines of the configuration."""
        lines = "".join(f"{name} = {[float(value) for value in values]}\n" for name, values in self.axes.items())
        return f"\n[sweep]\n{lines}" if lines else ""

    def write(self, path):
        with h5py.File(path, "w") as file:
            file.attrs.update(
                {
                    "Conventions": "CF-1.10",
                    "title": "Minimum and maximum displacement, xs = -4",
                    "source": "doi:10.5755/j02.mech.32277, Fig. 22",
                    "clatter_schema": "clatter/1",
                    "config": CONFIG + self.sweep(),
                }
            )
            for name, values in self.axes.items():
                file[name] = values
                file[name].make_scale(name)
            file["row"] = np.zeros(len(self.method), np.float32)
            file["row"].make_scale(f"This is a netCDF dimension but not a netCDF variable.{len(self.method):10d}")
            self.put_variable(file, "method", self.method.astype(np.uint8), ("row",))
            self.put_variable(file, "setting", self.setting, ("row",))
            self.put_variable(file, "arch", self.arch, ("row",))
            flags(file["method"], dict(enumerate(METHODS)))
            flags(file["arch"], dict(enumerate(ARCHS)))
            for name, values in ({"status": self.status} | self.results).items():
                self.put_variable(file, name, values, (*self.axes, "row"))
            flags(file["status"], STATUSES)
            for name, value in (("horizon", 100.0), ("reference_impacts", 200.0)):
                self.put_variable(file, name, np.full([len(part) for part in self.axes.values()], value), self.axes)

    @staticmethod
    def put_variable(file, name, values, dims):
        file[name] = values
        for place, dim in enumerate(dims):
            file[name].dims[place].attach_scale(file[dim])


def flags(item, meanings):
    item.attrs["flag_values"] = np.array(list(meanings), np.uint8)
    item.attrs["flag_meanings"] = " ".join(meanings.values())
