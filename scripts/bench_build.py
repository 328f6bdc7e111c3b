#!/usr/bin/python3
"""Measures what building costs, in processor and wall time: the program, then the tests, each file by itself.

usage: bench_build.py [COMMIT]

Builds the sources of this folder in build/bench, from nothing; before that those of a commit, if one is given, with
the same compiler and options, so that both are measured on one machine."""

import os
import re
import shutil
import subprocess
import sys
import time
from collections import defaultdict
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
PLACE = SOURCE / "build" / "bench"
LAUNCHER = """#!/bin/sh
exec /usr/bin/env python3 -S "$0.py" "$@"
"""
TIMED = """import os, resource, sys
command = sys.argv[1:]
process = os.fork()
if process == 0:
    os.execvp(command[0], command)
_, status, usage = os.wait4(process, 0)
if "-o" in command:
    with open(os.environ["CLATTER_BUILD_TIMES"], "a") as times:
        times.write(f"{usage.ru_utime + usage.ru_stime:.2f} {command[command.index('-o') + 1]}\\n")
sys.exit(os.waitstatus_to_exitcode(status))
"""


def checked(*command, **options):
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if result.returncode != 0:
        sys.exit(f"bench_build.py: {' '.join(map(str, command))} fails:\n{result.stdout[-4000:]}")


def folder_of(output):
    """src/point, apps/clatter, or of tests the program that a file belongs to."""
    target = re.search(r"CMakeFiles/(\w+)\.dir", output)
    return f"tests: {target[1]}" if output.startswith("tests/") else "/".join(output.split("/")[:2])


def build(source, name):
    """Builds the program and then the tests of a folder of sources; returns the lines of both."""
    times = PLACE / f"{name}.times"
    times.unlink(missing_ok=True)
    (PLACE / "timed").write_text(LAUNCHER)
    (PLACE / "timed").chmod(0o755)
    (PLACE / "timed.py").write_text(TIMED)
    folder = PLACE / name
    shutil.rmtree(folder, ignore_errors=True)
    environment = os.environ | {"CLATTER_BUILD_TIMES": str(times)}
    launcher = f"-DCMAKE_CXX_COMPILER_LAUNCHER={PLACE / 'timed'}"
    checked("cmake", "--preset", "release", "-B", folder, launcher, cwd=source, env=environment)
    found = []
    for part, target in (("the program", "clatter"), ("the tests", "all")):
        before = times.read_text().splitlines() if times.exists() else []
        began, cpu = time.perf_counter(), os.times()
        checked("cmake", "--build", folder, "--target", target, env=environment)
        wall, spent = time.perf_counter() - began, os.times()
        total = spent.children_user + spent.children_system - cpu.children_user - cpu.children_system
        files = [line.split(" ", 1) for line in times.read_text().splitlines()[len(before) :]]
        found.append((part, wall, total, [(float(seconds), output) for seconds, output in files]))
    return found


def report(name, found):
    for part, wall, total, files in found:
        print(f"\n{name}, {part}: {total:.0f} s of processor time, {wall:.0f} s on {os.cpu_count()} cores")
        folders = defaultdict(float)
        for seconds, output in files:
            folders[folder_of(output)] += seconds
        for folder, seconds in sorted(folders.items(), key=lambda item: -item[1]):
            print(f"  {seconds:7.1f} s  {folder}")
        print("  longest files:")
        for seconds, output in sorted(files, reverse=True)[:12]:
            print(f"  {seconds:7.1f} s  {re.sub(r'CMakeFiles/[^/]+/', '', output)}")


def main():
    if sys.argv[1:2] in (["-h"], ["--help"]):
        return print(__doc__)
    PLACE.mkdir(parents=True, exist_ok=True)
    results = []
    if sys.argv[1:]:
        commit = subprocess.run(
            ["git", "rev-parse", "-q", "--verify", sys.argv[1] + "^{commit}"], cwd=SOURCE, stdout=subprocess.DEVNULL
        )
        if commit.returncode != 0:
            sys.exit(f"bench_build.py: git knows no commit '{sys.argv[1]}'; git log lists them")
        other = PLACE / "sources"
        shutil.rmtree(other, ignore_errors=True)
        other.mkdir()
        archive = subprocess.Popen(["git", "archive", sys.argv[1]], stdout=subprocess.PIPE, cwd=SOURCE)
        checked("tar", "-x", "-C", other, stdin=archive.stdout)
        archive.wait()
        results.append((sys.argv[1], build(other, "other")))
    results.append(("these sources", build(SOURCE, "these")))
    for name, found in results:
        report(name, found)


if __name__ == "__main__":
    main()
