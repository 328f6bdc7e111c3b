#!/usr/bin/env python3
"""Lets clang++ read every file of a compile database without making code; exits with 1 if it warns of any.

GoogleTest and the 50-digit numbers, which all tests include, are compiled once for them (a precompiled header). That
halves the time.
"""

import argparse
import concurrent.futures
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

COMMON = "#include <gtest/gtest.h>\n#include <boost/multiprecision/cpp_bin_float.hpp>\n"


def arguments(entry):
    """The command of an entry without the file that it makes."""
    words = shlex.split(entry["command"])
    at = words.index("-o")
    return words[:at] + words[at + 2 :]


def precompiled(build, entry):
    """The options that make a test of this kind read COMMON from a precompiled header."""
    header, output = build / "common_to_tests.hpp", build / "common_to_tests.pch"
    header.write_text(COMMON, encoding="utf-8")
    options = [word for word in arguments(entry)[:-2] if not word.startswith("-DCLATTER")]
    subprocess.run([*options, "-x", "c++-header", header, "-o", output], cwd=entry["directory"], check=True)
    return ["-include-pch", str(output)]


def is_silent(entry, options):
    """Whether clang++ accepts a file without a message; its messages are printed."""
    command = [*arguments(entry), "-fsyntax-only", *options]
    done = subprocess.run(command, cwd=entry["directory"], capture_output=True, text=True, check=False)
    print(done.stderr, end="", flush=True)
    return done.returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="build folder of clang++ that has a compile database")
    build = parser.parse_args().build.resolve()
    database = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    database = [entry for entry in database if build not in Path(entry["file"]).parents]  # files that a build makes
    tests = [entry for entry in database if entry["file"].endswith("_test.cpp")]
    options = precompiled(build, tests[0]) if tests else []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = [pool.submit(is_silent, entry, options if entry in tests else []) for entry in database]
    sys.exit(0 if all(result.result() for result in results) else 1)


if __name__ == "__main__":
    main()
