#!/usr/bin/python3
"""Makes the tables of hard cases in tests/README.md from what the tests measure; --help says more."""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

from readme_table import SOURCE, add_build, program, replaced, section

README = SOURCE / "tests" / "README.md"
OURS, OTHERS = "hard cases", "general solvers on the hard cases"
TITLES = {
    "graze": "graze: the stops 1e-2 … 1e-10 inside the amplitude, or 1e-12 outside it",
    "graze_from_rest": "graze from rest, by 1e-2 … 1e-12",
    "chatter_and_rest": "chatter, rest, release",
    "chatter_cut_by_end": "the run ends within a chatter, down to 1e-14 before its end",
    "chatter_under_fast_force": "chatter during which the force turns round",
    "near_elastic_chatter": "chatter at R = 0.99, 0.999, 0.99999",
    "inelastic": "R = 0",
    "tangent_release": "release at a tangency, \\|f\\| − gap from 1e-3 to 0",
    "second_contact": "release into another contact, at once",
    "close_stops": "stops 2e-9 … 2e-12 apart, a force of 1",
    "resonance": "resonance: h from 0, ν − 1 from an ulp",
    "damping": "h = 1 ± 1e-12, 10, 1000",
    "scales": "xs = 1e-9, 1e9; ν = 1e-3, 1e3; f = 0, 1e-300",
    "edges": "start on a stop: moving in, out, pressed, pulled",
    "last_instant": "contact at the last instant, or 1e-12 beside it",
    "long": "1e6 conservative impacts; 1e7 forcing periods",
    "no_spring": "no spring: k = 0, ±1e-300; a ball that rests, h = 1e-300, 100",
    "unstable_spring": "k = −1, −100: at rest on top, over it by 1e-12, chatter",
    "soft_stops": "soft stops: κ = 1e-3 … 1e12, ζ = 0 … 1e3, a graze, a resonance",
    "shaken_stops": "shaken stops: rest on them, no other force, resonance",
    "dry_friction": "dry friction: turn 200 just sticks, let go at a tangency, R = 1, a stick off a stop, μ = f",
    "chaos": "chaos: 100 forcing periods of it",
}


def measured(build):
    """The reports of the tests of the hard cases, a dictionary for each case."""
    tests = program(build, "tests/hard_tests")
    with tempfile.TemporaryDirectory() as folder:
        lines = pathlib.Path(folder) / "cases"
        environment = {**os.environ, "CLATTER_HARD_CASES": str(lines)}
        names = "*agrees_with_fifty_digits*:*ends_where_the_sum*:Long.*"
        done = subprocess.run([tests, f"--gtest_filter={names}"], env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"hard_cases.py: the tests fail:\n{done.stdout}")
        return parsed(lines.read_text())


def written(path):
    """The reports that tests have written for CLATTER_HARD_CASES, the last of each case. The file is removed, so that
    the next run of the tests begins anew."""
    if not path.exists():
        sys.exit(f"hard_cases.py: {path} is missing; the tests of the hard cases write it: ctest -R hard")
    text = path.read_text()
    path.unlink()
    cases = {(case["row"], case["what"]): case for case in parsed(text)}
    return list(cases.values())


def parsed(text):
    return [json.loads(line.replace(": inf", ": Infinity").replace(": nan", ": NaN")) for line in text.splitlines()]


def by_row(cases):
    rows = {}
    for case in cases:
        rows.setdefault(case["row"], []).append(case)
    unknown = rows.keys() ^ TITLES.keys()
    if unknown:
        sys.exit(f"hard_cases.py: cases without a title, or titles without a case: {', '.join(sorted(unknown))}")
    return {row: rows[row] for row in TITLES}


def size(value):
    """A number in one digit; anything below half an ulp counts as exact."""
    if value is None or math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞"
    return "0" if value == 0 else f"{value:.0e}".replace("e-0", "e-").replace("e+0", "e+").replace("e+", "e")


def our_table(rows):
    lines = [
        "| case | scenes | impacts | rests | outcome | error | one ulp | evaluations |",
        "|---|--:|--:|--:|---|--:|--:|--:|",
    ]
    for row, cases in rows.items():
        worst = max(cases, key=lambda case: case["error"])
        outcomes = sorted({case["outcome"] for case in cases})
        lines.append(
            f"| {TITLES[row]} | {len(cases)} | {sum(c['impacts'] for c in cases):.0f} "
            f"| {sum(c['rests'] for c in cases)} | {', '.join(outcomes)} | {size(worst['error'])} "
            f"| {size(worst['one_ulp'])} | {sum(c['evaluations'] for c in cases):.0f} |"
        )
    return "\n".join(lines)


def solved(build):
    """The output of tests/bench/general_solvers, a dictionary for each case and solver."""
    solvers = program(build, "tests/bench/general_solvers", built_now=True)
    return parsed(subprocess.run([solvers], check=True, capture_output=True, text=True).stdout)


def is_right(run):
    """The same impacts to a millionth, and into a stop by less than a millionth of half the gap between the stops."""
    off = [run[name] or 0 for name in ("missed", "extra", "unreached")] + [run["outcome"] != "completed"]
    return not any(off) and all((run[name] or 0) < 1e-6 for name in ("penetration", "error_time", "error_x"))


def verdict(runs):
    """How one solver did on the scenes of a row, in words."""
    words = [f"{sum(map(is_right, runs))} of {len(runs)}"]
    missed, extra = sum(run["missed"] for run in runs), sum(run["extra"] for run in runs)
    stuck = sum(run["outcome"] != "completed" for run in runs)
    deepest = max(run["penetration"] or 0 for run in runs)
    words += (
        [f"misses {missed}"] * (missed > 0) + [f"adds {extra}"] * (extra > 0) + [f"no end in {stuck}"] * (stuck > 0)
    )
    words += [f"{size(deepest)} into a stop"] * (deepest > 1e-6)
    latest = max(run["error_time"] or 0 for run in runs)
    words += [f"times off by {size(latest)}"] * (len(words) == 1 and latest > 1e-6)
    return "; ".join(words)


def others_table(runs):
    solvers = list(dict.fromkeys(run["solver"] for run in runs))
    lines = [
        "| right in how many scenes, and what is wrong | " + " | ".join(solvers) + " |",
        "|---" * (len(solvers) + 1) + "|",
    ]
    for row, title in TITLES.items():
        if row == "long":  # beyond any general solver's patience
            continue
        of_row = [run for run in runs if run["row"] == row]
        if not of_row:  # of other springs or stops than the solvers are set up for
            continue
        lines.append(
            f"| {title} | " + " | ".join(verdict([r for r in of_row if r["solver"] == s]) for s in solvers) + " |"
        )
    return "\n".join(lines)


def cells(table):
    return [
        [cell.strip() for cell in line.replace("\\|", "¦").strip("| ").split("|")] for line in table.splitlines()[2:]
    ]


def number(text):
    return math.nan if text in ("–", "nan") else float(text.replace("∞", "inf"))


def differences(now, written):
    """Rows of the README that are no longer true: facts must be equal, errors of the same order, effort within 5 %."""
    now, written = cells(now), cells(written)
    if [line[:5] for line in now] != [line[:5] for line in written]:
        return [f"{a[:5]} now, {b[:5]} in the README" for a, b in zip(now, written) if a[:5] != b[:5]] or ["other rows"]
    found = []
    for a, b in zip(now, written):
        if number(a[5]) > 10 * max(number(b[5]), 1e-15):
            found.append(f"{a[0]}: error {a[5]} now, {b[5]} in the README")
        if abs(number(a[7]) - number(b[7])) > 0.05 * number(b[7]) + 5:
            found.append(f"{a[0]}: {a[7]} evaluations now, {b[7]} in the README")
    return found


def main():
    parser = argparse.ArgumentParser(
        description="Makes the tables of hard cases in tests/README.md from what the tests and tests/bench measure."
    )
    add_build(parser)
    parser.add_argument(
        "--check", action="store_true", help="write nothing; fail if the guide's numbers are no longer true"
    )
    parser.add_argument("--cases", action="store_true", help="print every case instead")
    parser.add_argument(
        "--written",
        type=pathlib.Path,
        metavar="FILE",
        help="take, and remove, what tests have written to the FILE that CLATTER_HARD_CASES named; run none",
    )
    arguments = parser.parse_args()
    cases = written(arguments.written) if arguments.written else measured(arguments.build)
    if arguments.cases:
        for case in cases:
            print(
                f"{case['row']:25} {case['what']:28} {case['outcome']:9} "
                f"{case['impacts']:8.0f} impacts {case['rests']:4} rests "
                f"error {size(case['error']):6} one ulp {size(case['one_ulp'])}"
            )
        return
    text = README.read_text()
    table = our_table(by_row(cases))
    if arguments.check:
        start, stop = section(text, OURS)
        found = differences(table, text[start:stop])
        if found:
            sys.exit("tests/README.md is behind; scripts/hard_cases.py brings it up to date:\n" + "\n".join(found))
        return
    text = replaced(text, OURS, table)
    README.write_text(replaced(text, OTHERS, others_table(solved(arguments.build))))


if __name__ == "__main__":
    main()
