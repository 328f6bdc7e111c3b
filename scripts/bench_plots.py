#!/usr/bin/python3
"""Times scripts/plot.py on a map, a large map and a bifurcation diagram, as whole processes; --help says more."""

import argparse
import pathlib
import statistics
import subprocess
import tempfile
import time

from readme_table import SOURCE, add_build, program

LARGE_MAP = (
    "sweep.nu=linspace(0.5, 1.5, 1000)",
    "sweep.xs=linspace(0.5, 6.4, 1000)",
    "time.max_periods=500",
    "observe.impacts=false",
    "observe.period=false",
    "observe.word=true",
)  # four extrema and the regimes: five panels, and the symmetry
DIAGRAM = ("sweep.nu=linspace(0.82, 1.0, 21501)", "observe.section=100", "observe.stability=false")
PICTURES = (  # name, configuration, settings, options of plot.py, seconds wanted
    ("map_nu_xs.toml", "map_nu_xs", (), (), 3),
    ("map of 1000 x 1000, five panels", "map_nu_xs", LARGE_MAP, ("--only", "extrema,word"), 10),
    ("bifurcation diagram, 10^6 points", "bifurcation", DIAGRAM, ("--only", "section_x"), 5),
)


def command_line():
    parser = argparse.ArgumentParser(description=__doc__, epilog="Each time is the median of the repetitions.")
    add_build(parser)
    parser.add_argument("--repetitions", type=int, default=3, metavar="N", help="default: 3")
    return parser.parse_args()


def seconds(command):
    begin = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - begin


def main():
    options = command_line()
    clatter = program(options.build, "apps/clatter/clatter")
    print("| picture, PNG and SVG | seconds | wanted | PNG | SVG |\n|---|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for title, config, settings, drawn, wanted in PICTURES:
            output = folder / "output.h5"
            sets = [word for setting in settings for word in ("--set", setting)]
            path = SOURCE / "configs" / f"{config}.toml"
            subprocess.run([clatter, "run", path, "-o", output, "--force", "-q", *sets], check=True)
            plot = [SOURCE / "scripts" / "plot.py", output, *drawn]
            took = statistics.median(seconds(plot) for _ in range(options.repetitions))
            sizes = [f"{output.with_suffix(kind).stat().st_size / 1e3:.0f} kB" for kind in (".png", ".svg")]
            print(f"| {title} | {took:.1f} | {wanted} | {' | '.join(sizes)} |", flush=True)


if __name__ == "__main__":
    main()
