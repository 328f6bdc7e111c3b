#!/usr/bin/python3
"""Measures how time and memory grow with points, periods, shards and motions, and prints a table; --help says more."""

import argparse
import math
import pathlib
import statistics
import tempfile

from readme_table import add_build, program
from timed_process import timed

OUT_OF_REACH = """[scene]
f = -1.0
xs = -9.0
R = 0.7
[sweep]
nu = "linspace(0.5, 1.5, {side})"
h = "linspace(0.1, 0.5, {other})"
[observe]
extrema = true
period = true
"""

CHAOS = """[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -3.0
nu = 0.86
[time]
mode = "transient"
duration = {duration!r}
max_impacts = 100000000
[observe]
extrema = true
"""

STARTS = """[scene]
f = -1.0
h = {h}
R = {R}
xs = -1.0
nu = {nu}
[sweep]
x0 = "linspace(-1, 1, 100)"
v0 = "linspace(-8, 8, 100)"
[observe]
extrema = true
attractor = {numbered}
"""
# h, R and nu at which 100 x 100 starts end in so many motions
MOTIONS = {
    1: (0.1, 0.7, 1.0),
    2: (0.002, 0.98, 2.6),
    4: (0.002, 0.98, 3.4),
    8: (0.002, 0.98, 3.8),
    16: (0.001, 0.998, 7.8),
}


class Growth:
    """Runs of one or two programs, side by side."""

    def __init__(self, programs, folder, repetitions):
        self.programs, self.folder, self.repetitions = programs, pathlib.Path(folder), repetitions

    def config(self, text):
        path = self.folder / "a.toml"
        path.write_text(text, encoding="utf-8")
        return path

    def measured(self, words_of, times=None):
        """For each program the medians of time and memory of the command of `words_of`, in turn."""
        runs = {one: [] for one in self.programs}
        for _ in range(times or self.repetitions):
            for one in self.programs:
                runs[one].append(timed(one, *words_of(one))[1:])
        return [tuple(statistics.median(values) for values in zip(*runs[one])) for one in self.programs]

    def run_words(self, text, *more):
        return lambda _: ["run", self.config(text), "-o", self.folder / "a.h5", "--force", "-q", *more]

    def points(self, most):
        for power in range(3, int(math.log10(most)) + 1):
            side, other = 10 ** (power // 2), 10 ** (power - power // 2)
            times = 1 if power > 7 else None
            yield 10**power, self.measured(self.run_words(OUT_OF_REACH.format(side=side, other=other)), times)

    def periods(self, most):
        for power in range(1, int(math.log10(most)) + 1):
            duration = 10**power * 2 * math.pi / 0.86
            yield 10**power, self.measured(self.run_words(CHAOS.format(duration=duration)))

    def shards(self, points):
        """The merge of a sweep, by each program that of its own shards."""
        text = OUT_OF_REACH.format(side=1000, other=points // 1000)
        for of in (1, 3, 10, 30, 100):
            for number, one in enumerate(self.programs):
                for k in range(of):
                    shard = self.folder / f"{number}.{k}.h5"
                    timed(one, "run", self.config(text), "-o", shard, "--force", "-q", "--shard", f"{k}/{of}")
            names = {one: f"{number}.*.h5" for number, one in enumerate(self.programs)}
            yield of, self.measured(
                lambda one: [
                    "merge",
                    "-o",
                    self.folder / "m.h5",
                    "--force",
                    "-q",
                    *self.folder.glob(names[one]),
                ]
            )
            for path in self.folder.glob("*.*.h5"):
                path.unlink()

    def motions(self, numbered):
        for count, (h, R, nu) in MOTIONS.items():
            text = STARTS.format(h=h, R=R, nu=nu, numbered=str(numbered).lower())
            yield count, self.measured(self.run_words(text))


def exponent(sizes, costs):
    """The slope of cost over size in a plot of their logarithms, by least squares."""
    points = [(math.log(size), math.log(cost)) for size, cost in zip(sizes, costs) if cost > 0]
    if len(points) < 2:
        return math.nan
    x, y = (statistics.mean(values) for values in zip(*points))
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def table(title, unit, rows, unit_of, scale, programs):
    """`unit_of(size)` units have the cost of a row; exponents are those of the upper half of the sizes."""
    rows = list(rows)
    upper = rows[len(rows) // 2 :]
    for number in range(programs):
        name = title if programs == 1 else f"{title}, {('this program', 'the other one')[number]}"
        print(f"\n| {name} | processor time, s | {unit} | memory, MB |\n|--:|--:|--:|--:|")
        for size, results in rows:
            seconds, megabytes = results[number]
            print(f"| {size} | {seconds:.3g} | {scale * seconds / unit_of(size):.3g} | {megabytes:.0f} |")
        sizes = [size for size, _ in upper]
        time, memory = ([results[number][which] for _, results in upper] for which in (0, 1))
        print(f"| exponent | {exponent(sizes, time):.2f} | | {exponent(sizes, memory):.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(
        description="Times whole runs as points, periods, shards and motions grow, and prints for each size the "
        "processor time, that of a unit and the largest resident memory, with the exponents of their growth over the "
        "upper half of the sizes. Output files go to a temporary folder; 10^8 points take 27 GB there for some minutes."
    )
    add_build(parser)
    parser.add_argument("--points", type=float, default=1e8, metavar="N", help="the most points (default: 1e8)")
    parser.add_argument("--periods", type=float, default=1e6, metavar="N", help="the most periods (default: 1e6)")
    parser.add_argument("--merged", type=float, default=1e6, metavar="N", help="points that are merged (default: 1e6)")
    parser.add_argument("--repetitions", type=int, default=3, help="of each run up to 10^7 points (default: 3)")
    parser.add_argument("--beside", metavar="PROGRAM", help="another clatter, each of whose runs follows one of this")
    parser.add_argument("--folder", help="where the temporary folder is made (default: that of the system)")
    arguments = parser.parse_args()
    clatter = program(arguments.build, "apps/clatter/clatter", "cmake --build --preset release makes it")
    programs = [clatter] + ([pathlib.Path(arguments.beside).resolve()] if arguments.beside else [])
    with tempfile.TemporaryDirectory(dir=arguments.folder) as folder:
        growth, many = Growth(programs, folder, arguments.repetitions), len(programs)
        table("points out of reach", "µs a point", growth.points(arguments.points), lambda n: n, 1e6, many)
        table("periods of chaos", "µs a period", growth.periods(arguments.periods), lambda n: n, 1e6, many)
        merged = int(arguments.merged)
        rows = growth.shards(merged)
        table(f"shards of {merged} points merged", "µs a point", rows, lambda _: merged, 1e6, many)
        table("motions of 10^4 starts", "µs a start", growth.motions(False), lambda _: 1e4, 1e6, many)
        table("the same, numbered", "µs a start", growth.motions(True), lambda _: 1e4, 1e6, many)


if __name__ == "__main__":
    main()
