#!/usr/bin/python3
"""Prints the measurements of scripts/bench.sh beside their targets; --help says more."""

import argparse
import json
import pathlib

from readme_table import BUILD

ARCHS = ("scalar", "sse2", "avx2", "avx512")
FAST_UNIT = 0.6e-9  # seconds: on machines of a longer s than this, times are wanted in proportion


def order(name):
    """Sorts benchmarks, which run in random order: by subject, then instruction set, number, or falling tolerance."""
    what, how = name.split("/")
    if how in ARCHS:
        return what.lower(), ARCHS.index(how)
    return what.lower(), -float(how) if float(how) < 1 else float(how)


class Run:
    """The medians of one Google Benchmark executable by their benchmarks' names."""

    def __init__(self, path):
        content = json.loads(path.read_text())
        self.context = content["context"]
        self.medians = {}
        for entry in content["benchmarks"]:
            if entry["run_type"] == "iteration" or entry["aggregate_name"] == "median":
                self.medians[entry["run_name"].removesuffix("/real_time")] = entry
        self.medians = dict(sorted(self.medians.items(), key=lambda item: order(item[0])))

    def unit(self, arch=None):
        """The time of one batched sincos for each element; for scalar code that of the set it is compiled for."""
        arch = arch or self.context["best"]
        return self.medians["sincos/" + ("sse2" if arch == "scalar" else arch)]["time"]

    def named(self, prefix):
        """The rest of each name with this prefix, with its measurement."""
        return [(name.removeprefix(prefix), entry) for name, entry in self.medians.items() if name.startswith(prefix)]


def time(seconds):
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def in_units(seconds, unit):
    count = seconds / unit
    return f"{count:,.0f}" if 100 < count < 1e6 else f"{count:.3g}"


def show(title, head, rows):
    """A table in Markdown, which is also how it reads in a terminal."""
    rows = [head, *([str(cell) for cell in row] for row in rows)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(head))]
    print(f"\n{title}\n")
    for number, row in enumerate(rows):
        print("| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |")
        if number == 0:
            print("|" + "|".join("-" * (width + 2) for width in widths) + "|")


def show_units(runs):
    rows = [
        (name, *(time(run.unit(arch)) if f"sincos/{arch}" in run.medians else "–" for arch in ARCHS[1:]))
        for name, run in runs.items()
    ]
    show("The unit s: one batched xsimd sincos for each element, in each of the runs", ("run", *ARCHS[1:]), rows)


def show_rates(run):
    rows = []
    for name, entry in run.medians.items():
        sweep, arch = name.split("/")
        if sweep != "sincos":
            unit = run.unit(arch)
            rows.append(
                (
                    sweep,
                    arch,
                    *(
                        text
                        for what in ("impact", "period")
                        for text in (
                            time(entry[what]),
                            in_units(entry[what], unit),
                            f"{entry['proved_' + what]:.3g}",
                            f"{entry['refined_' + what]:.3g}",
                        )
                    ),
                )
            )
    show(
        "Time per impact and per forcing period, one thread; s of the same instruction set; lanes times steps proved "
        "and contacts refined",
        ("sweep", "set", "impact", "in s", "proved", "refined", "period", "in s", "proved", "refined"),
        rows,
    )


def show_growth(run):
    unit = run.unit()
    rows = [
        (f"{kind[:-1]} ({number} {kind})", time(entry["time"]), in_units(entry["time"], unit))
        for kind in ("points", "periods")
        for number, entry in run.named(kind + "/")
    ]
    seconds = out_of_reach(run)
    rows.append(("point whose stops are out of reach", time(seconds), in_units(seconds, unit)))
    show(
        "Growth: time for each point of 3 forcing periods, for each period of 200 points, and for a steady point whose "
        "stops are out of reach; one thread",
        ("each", "time", "in s"),
        rows,
    )
    show(
        "Two threads",
        ("sweep", "1 thread", "2 threads", "efficiency"),
        [
            (
                what,
                time(run.medians[f"threads of {what}/1"]["time"]),
                time(run.medians[f"threads of {what}/2"]["time"]),
                f"{efficiency(run, what):.3f}",
            )
            for what in ("transients", "the map")
        ],
    )


def out_of_reach(run):
    return next(entry["time"] for _, entry in run.named("out of reach/"))


def efficiency(run, what):
    one, two = (run.medians[f"threads of {what}/{threads}"]["time"] for threads in (1, 2))
    return one / (2 * two)


def show_solvers(run):
    clatter, unit = run.medians["clatter/" + run.context["best"]]["time"], run.unit()
    rows = []
    for name, entry in run.medians.items():
        if not name.startswith("sincos"):
            counts = [
                f"{entry[what]:.{digits}g}" if what in entry else "–"
                for what, digits in (("wrong", 3), ("error", 1), ("through", 3))
            ]
            rows.append(
                (name, time(entry["time"]), in_units(entry["time"], unit), f"{entry['time'] / clatter:.4g}", *counts)
            )
    show(
        "The sweep of Fig. 23: 200 points, 300 forcing periods each on average, one thread; "
        f"s of {run.context['best']}",
        ("method", "period", "in s", "÷ clatter", "wrong points", "error of the others", "through a stop"),
        rows,
    )


def show_housing(run):
    rows = []
    for name, entry in run.medians.items():
        if name.startswith("sincos"):
            continue
        clatter = run.medians[name.split(",")[0] + ", clatter/scalar"]["time"]
        numbers = f"{entry['time'] / clatter:.3g}", f"{entry['impacts']:.3g}", f"{entry['error']:.1g}"
        rows.append((name, time(entry["time"]), *numbers))
    show(
        "Scenes with a loose mass, one thread; error of the state at the end over the free path",
        ("scene, method", "period", "÷ clatter", "impacts a period", "error"),
        rows,
    )


def show_processes(content, unit):
    rows = [
        (
            one["name"],
            time(one["seconds"]),
            in_units(one["seconds"], unit),
            f"{one['megabytes']:.0f} MB",
            one["repetitions"],
        )
        for one in content["processes"]
    ]
    size, cores = content["context"]["map"], content["context"]["cores"]
    ratio = content["map over its impacts"]
    rows.append(("map over its impacts, one thread", f"{ratio:.2f}", "", "", ""))
    show(
        f"Whole processes of clatter run on {cores} cores; the map has {size} x {size} points",
        ("what", "time", "in s", "memory", "runs"),
        rows,
    )


def show_proofs(content):
    rows = [
        (
            one["name"],
            one["certificates"],
            one["proved"],
            *(
                text
                for what in ("certify", "verify")
                for text in (time(one[what]), f"{one['certificates'] / one[what]:,.0f}")
            ),
        )
        for one in content["proofs"]
    ]
    show(
        "Proofs: processor time of clatter certify and of clatter-verify, and certificates a second on one core",
        ("points of", "certificates", "proved", "certify", "a second", "verify", "a second"),
        rows,
    )


class Wanted:
    """Lines of measurements and their targets."""

    def __init__(self):
        self.rows = []

    def at_most(self, what, value, bound, text, seconds=None, unit=None):
        self.rows.append(
            (
                what,
                text(value),
                in_units(seconds, unit) if seconds else "–",
                f"at most {text(bound)}",
                met(value <= bound),
            )
        )

    def at_least(self, what, value, bound, text):
        self.rows.append((what, text(value), "–", f"at least {text(bound)}", met(value >= bound)))


def met(yes):
    return "yes" if yes else "no"


def wanted_rates(wanted, run):
    for arch in ("avx512", "avx2"):
        if f"sincos/{arch}" not in run.medians:
            continue
        unit = run.unit(arch)
        for sweep, what, most in (
            ("fig18", "impact", 25),
            ("fig18_1000", "impact", 25),
            ("fig23", "period", 25),
            ("fig23_hitting", "period", 35),
        ):
            value = run.medians[f"{sweep}/{arch}"][what]
            wanted.at_most(f"{sweep}: {what}, {arch}", value, most * unit, time, value, unit)


def wanted_ratios(wanted, run):
    clatter = run.medians["clatter/" + run.context["best"]]["time"]
    for solver, bound in (("Odeint with turns", 300), ("CVODE", 4000)):
        right = [(name, entry["time"]) for name, entry in run.named(solver + "/") if entry["wrong"] == 0]
        if right:
            loosest, seconds = max(right, key=lambda one: float(one[0]))
            wanted.at_least(
                f"times faster than {solver} at {loosest}", seconds / clatter, bound, lambda ratio: f"{ratio:.4g}"
            )


def wanted_times(wanted, content, figures):
    unit = figures.unit()
    slower = max(1.0, unit / FAST_UNIT)
    seconds = {one["name"]: one["seconds"] for one in content["processes"]}
    in_one = figures.medians["figures/" + figures.context["best"]]["time"]
    times = [
        ("22 figures in one process", in_one, 0.25),
        ("22 figures in 22 processes", seconds["figures"], 0.25),
        ("one point, the process", seconds["start"], 0.01),
    ]
    if content["context"]["map"] == 1000:
        times.append((f"the map, {content['context']['cores']} cores", seconds["map"], 4))
        times.append((f"basins, {content['context']['cores']} cores", seconds["basins"], 1))
        wanted.at_most(
            "basins with numbers over those without",
            seconds["numbered basins"] / seconds["basins"],
            1.3,
            lambda ratio: f"{ratio:.2f}",
        )
        wanted.at_most("the map over its impacts", content["map over its impacts"], 2.5, lambda ratio: f"{ratio:.2f}")
        megabytes = next(one["megabytes"] for one in content["processes"] if one["name"] == "map")
        wanted.at_most("the map: memory", megabytes, 300, lambda value: f"{value:.0f} MB")
    for what, value, bound in times:
        wanted.at_most(what, value, bound * slower, time, value, unit)


def main():
    parser = argparse.ArgumentParser(
        description="Prints the measurements of scripts/bench.sh as tables, each time also in s, and their targets. "
        "Target times of whole runs are for s of at most 0.6 ns, and longer in proportion on slower machines."
    )
    parser.add_argument(
        "folder",
        type=pathlib.Path,
        nargs="?",
        default=BUILD / "bench",
        help="of the JSON files (default: build/release/bench)",
    )
    folder = parser.parse_args().folder
    runs = {name: Run(folder / f"{name}.json") for name in ("rates", "growth", "figures", "solvers", "housing")}
    processes = json.loads((folder / "processes.json").read_text())
    show_units(runs)
    show_rates(runs["rates"])
    show_growth(runs["growth"])
    show_solvers(runs["solvers"])
    show_housing(runs["housing"])
    show_processes(processes, runs["figures"].unit())
    proofs = folder / "proofs.json"
    if proofs.exists():
        show_proofs(json.loads(proofs.read_text()))
    else:
        print("\nNo clatter-verify was built, so no proofs were timed: it needs Arb, libflint-arb-dev.")
    wanted = Wanted()
    wanted_rates(wanted, runs["rates"])
    wanted_ratios(wanted, runs["solvers"])
    wanted_times(wanted, processes, runs["figures"])
    seconds, unit = out_of_reach(runs["growth"]), runs["growth"].unit()
    wanted.at_most("a point whose stops are out of reach", seconds, 1000 * unit, time, seconds, unit)
    for what in ("transients", "the map"):
        wanted.at_least(
            f"efficiency of 2 threads, {what}", efficiency(runs["growth"], what), 0.93, lambda value: f"{value:.3f}"
        )
    show("What is wanted", ("what", "measured", "in s", "wanted", "met"), wanted.rows)


if __name__ == "__main__":
    main()
