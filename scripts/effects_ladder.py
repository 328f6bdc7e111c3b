#!/usr/bin/python3
"""Makes the table of what each effect costs from tests/bench/effects_ladder; --help says more."""

import argparse
import json
import subprocess
import sys

from readme_table import SOURCE, add_build, program, replaced, section

README = SOURCE / "src" / "scene" / "README.md"
NAME = "effects ladder"
HEAD = """\
| effects of the scene | left out | set | impacts | rests | evaluations | time | ÷ kept in | ÷ all effects |
|---|---|--:|--:|--:|--:|--:|--:|--:|"""


def measured(build, repetitions, seconds):
    """For each rung, in order: the effect left out, and medians {"own": {"time": ...}, "kept in": ..., "all": ...}"""
    bench = program(build, "tests/bench/effects_ladder", "it needs libbenchmark-dev", built_now=True)
    # again and again in random order, so that other load on the machine hits all alike
    options = [
        "--benchmark_format=json",
        "--benchmark_enable_random_interleaving=true",
        "--benchmark_report_aggregates_only=true",
        f"--benchmark_repetitions={repetitions}",
        f"--benchmark_min_time={seconds}",
    ]
    done = subprocess.run([bench, *options], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"effects_ladder.py: {bench} fails:\n{done.stderr}")
    rungs = {}
    for run in json.loads(done.stdout)["benchmarks"]:
        if run.get("error_occurred"):
            sys.exit(f"effects_ladder.py: {run['run_name']}: {run['error_message']}")
        if run["aggregate_name"] == "median":
            number, left_out, variants = run["run_name"].split("/")
            rungs.setdefault((int(number), left_out), {}).update(dict.fromkeys(variants.split(", "), run))
    return [(left_out, rungs[number, left_out]) for number, left_out in sorted(rungs)]


def ratio(rung, variant):
    """Of the times per period, its own to another's; that has to be the same motion."""
    own, other = rung["own"], rung[variant]
    if own is other:
        return "same"
    if abs(own["impacts"] - other["impacts"]) > 0.01 * own["impacts"]:
        sys.exit(f"effects_ladder.py: {own['run_name']} and {other['run_name']} have other impacts")
    return f"{own['time'] / other['time']:.2f}"


def time(seconds):
    return f"{seconds * 1e9:.0f} ns" if seconds < 1e-6 else f"{seconds * 1e6:.3g} µs"


def row(left_out, rung):
    own = rung["own"]
    counts = " | ".join(f"{own[name]:.3g}" for name in ("set", "impacts", "rests", "evaluations"))
    with_it = ratio(rung, "kept in") if left_out else "–"
    return f"| {own['label']} | {left_out or '–'} | {counts} | {time(own['time'])} | {with_it} | {ratio(rung, 'all')} |"


def main():
    parser = argparse.ArgumentParser(
        description="Prints the table of what each effect costs, as tests/bench/effects_ladder measures it now."
    )
    add_build(parser)
    parser.add_argument(
        "--write", action="store_true", help="put the table into src/scene/README.md instead of printing it"
    )
    parser.add_argument(
        "--repetitions", type=int, default=51, help="of each benchmark, in random order; medians count (default: 51)"
    )
    parser.add_argument("--seconds", type=float, default=0.02, help="least time of each repetition (default: 0.02)")
    arguments = parser.parse_args()
    if arguments.write:
        section(README.read_text(), NAME)  # before two minutes of measuring
    rungs = measured(arguments.build, arguments.repetitions, arguments.seconds)
    table = "\n".join([HEAD, *(row(*rung) for rung in rungs)])
    if arguments.write:
        README.write_text(replaced(README.read_text(), NAME, table))
    else:
        print(table)


if __name__ == "__main__":
    main()
