#!/usr/bin/python3
"""Times whole processes of clatter and writes their time and memory as JSON; --help says more."""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile

from readme_table import SOURCE, add_build, program
from timed_process import timed

CONFIGS = SOURCE / "configs"
FIGURES = [CONFIGS / f"fig{number:02d}.toml" for number in range(2, 24)]
ONE_POINT = CONFIGS / "fig18.toml"
ENOUGH_SECONDS = 60  # after which a measurement is not repeated


def map_settings(points):
    """Of the map over frequency and stops: configs/map_nu_xs.toml has the scene."""
    settings = {
        "sweep.nu": f"linspace(0.5, 1.5, {points})",
        "sweep.xs": f"linspace(0.2, 4, {points})",
        "time.max_periods": 500,
        "observe.extrema": "true",
        "observe.harmonics": 3,
        "observe.harmonics_method": "exact",
        "observe.impacts": "false",
        "observe.period": "true",
    }
    return [text for key, value in settings.items() for text in ("--set", f"{key}={value}")]


# a plain sweep: nothing but impacts
TRANSIENTS = """[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -0.5

[sweep]
nu = "linspace(0.5, 1.5, 2000)"

[time]
mode = "transient"
duration = 20000
"""


def seconds_and_impacts(command, environment):
    """The processor time of a run on one thread, and the impacts that it simulates."""
    seconds = timed(*command, permitted=(0, 1), environment=environment).processor
    loud = [word for word in command if word != "-q"] + ["-v"]
    told = subprocess.run(loud, env=environment, capture_output=True, text=True, check=False).stderr
    return seconds, next(float(line.split()[1]) for line in told.splitlines() if line.startswith("impacts "))


def over_impacts(run, plain, repetitions, environment):
    """The time of a run over that of its impacts, each of which takes as long as one of a plain sweep; both on one
    thread, in turn."""
    ratios = []
    for _ in range(repetitions):
        seconds, impacts = seconds_and_impacts(run, environment)
        plain_seconds, plain_impacts = seconds_and_impacts(plain, environment)
        ratios.append(seconds / impacts / (plain_seconds / plain_impacts))
    return statistics.median(ratios)


def basins_scene(points, numbered):
    """The basins of attraction of Fig. 23's oscillator at nu = 1.2: the steady motions of many starts, and if asked for
    the numbers of the motions."""
    return f"""[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -3.0
nu = 1.2

[sweep]
x0 = "linspace(-3, 3, {points})"
v0 = "linspace(-3, 3, {points})"

[observe]
extrema = true
attractor = {str(numbered).lower()}
"""


def measured(name, commands, repetitions, environment):
    """The commands one after the other, again and again: medians of their time together and of the largest memory."""
    seconds, megabytes = [], []
    while len(seconds) < repetitions and sum(seconds) < ENOUGH_SECONDS:
        # exit code 1: some points failed
        runs = [timed(*command, permitted=(0, 1), environment=environment) for command in commands]
        seconds.append(sum(run.wall for run in runs))
        megabytes.append(max(run.memory for run in runs))
    return {
        "name": name,
        "seconds": statistics.median(seconds),
        "megabytes": statistics.median(megabytes),
        "repetitions": len(seconds),
    }


def main():
    parser = argparse.ArgumentParser(
        description="Times `clatter run` as whole processes: a scene of one point, the 22 figures one after "
        "the other, a map over frequency and stops, and the basins of as many starts. Output files go to a "
        "temporary folder."
    )
    add_build(parser)
    parser.add_argument("--out", required=True, help="the JSON file to write")
    parser.add_argument(
        "--map",
        type=int,
        default=1000,
        metavar="N",
        help="the map has N x N points, the basins as many starts (default: 1000)",
    )
    parser.add_argument(
        "--repetitions",
        type=int,
        default=5,
        help="of the figures, the map and the basins (default: 5); four times as many of one point",
    )
    parser.add_argument("--arch", help="instruction set, as `clatter run --arch` takes it")
    arguments = parser.parse_args()
    clatter = program(arguments.build, "apps/clatter/clatter", "cmake --build --preset release makes it")
    environment = dict(os.environ, CLATTER_ARCH=arguments.arch) if arguments.arch else None
    with tempfile.TemporaryDirectory() as folder:

        def command(config, *options):
            chosen = ["--arch", arguments.arch] if arguments.arch else []
            return [
                clatter,
                "run",
                config,
                "-o",
                f"{folder}/{config.stem}.h5",
                "--force",
                "--progress",
                "never",
                "-q",
                *chosen,
                *options,
            ]

        basins, numbered, transients = (
            pathlib.Path(folder) / f"{name}.toml" for name in ("basins", "numbered", "transients")
        )
        basins.write_text(basins_scene(arguments.map, False), encoding="utf-8")
        numbered.write_text(basins_scene(arguments.map, True), encoding="utf-8")
        transients.write_text(TRANSIENTS, encoding="utf-8")
        map_command = command(CONFIGS / "map_nu_xs.toml", *map_settings(arguments.map))
        results = [
            measured("start", [command(ONE_POINT)], 4 * arguments.repetitions, environment),
            measured("figures", [command(config) for config in FIGURES], arguments.repetitions, environment),
            measured("map", [map_command], arguments.repetitions, environment),
            measured("basins", [command(basins)], arguments.repetitions, environment),
            measured("numbered basins", [command(numbered)], arguments.repetitions, environment),
        ]
        one_thread = ("--threads", "1")
        ratio = over_impacts(
            [*map_command, *one_thread], command(transients, *one_thread), arguments.repetitions, environment
        )
    with open(arguments.out, "w", encoding="utf-8") as file:
        json.dump(
            {
                "context": {"map": arguments.map, "cores": os.cpu_count(), "arch": arguments.arch},
                "processes": results,
                "map over its impacts": ratio,
            },
            file,
            indent=2,
        )


if __name__ == "__main__":
    main()
