#!/usr/bin/python3
"""Compares the time that `clatter plan` foretells with the wall time of the run, for sweeps of ten shapes."""

import json
import subprocess
import tempfile
import time
from pathlib import Path

from readme_table import SOURCE, program

CONFIGS = SOURCE / "configs"


def settings(**changes):
    return [word for key, value in changes.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


SHAPES = {
    "one point": ("fig18", {}),
    "a curve": ("fig22", {"sweep__nu": "linspace(0.5, 1.5, 20001)"}),
    "stops out of reach": (
        "fig22",
        {"scene__xs": -9, "sweep__nu": "linspace(0.5, 1.5, 2000)", "sweep__phase": "linspace(0, 6, 2000)"},
    ),
    "a map": ("map_nu_xs", {}),
    "a map with FFT": (
        "map_nu_xs",
        {"observe__harmonics": 3, "observe__harmonics_method": "fft", "observe__harmonics_samples": 1024},
    ),
    "basins": ("basins", {}),
    "a followed sweep": ("follow_up", {"sweep__nu": "linspace(0.5, 1.5, 20001)"}),
    "chaos": ("bifurcation", {}),
    "soft stops": ("soft_bumper", {"sweep__stop_stiffness": "logspace(10, 1e4, 20001)"}),
    "Dormand-Prince": ("fig22", {"integrator__method": "dopri5"}),
}


def main():
    clatter = program(SOURCE / "build" / "release", "apps/clatter/clatter")
    print(f"{'':20}{'points':>10}{'foretold':>10}{'run':>9}{'ratio':>7}")
    for name, (config, changes) in SHAPES.items():
        words = [CONFIGS / f"{config}.toml", *settings(**changes)]
        plan = subprocess.run([clatter, "plan", *words, "--json"], check=True, capture_output=True, text=True)
        foretold = json.loads(plan.stdout)
        with tempfile.TemporaryDirectory() as folder:
            begin = time.perf_counter()
            subprocess.run([clatter, "run", *words, "-q", "-o", Path(folder, "a.h5")], check=False)
            took = time.perf_counter() - begin
        seconds = foretold["foretold_seconds"]
        print(f"{name:20}{foretold['points']:10}{seconds:8.3f} s{took:7.3f} s{seconds / took:7.2f}")


if __name__ == "__main__":
    main()
