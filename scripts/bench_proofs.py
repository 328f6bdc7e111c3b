#!/usr/bin/python3
"""Times clatter certify and clatter-verify, and writes their processor time as JSON; --help says more."""

import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

from readme_table import SOURCE, add_build, program
from timed_process import timed

CONFIGS = ("fig23", "regimes")
ENOUGH_SECONDS = 60  # after which a measurement is not repeated


def processor_time(*command):
    """Seconds that a process computes, on all cores together."""
    return timed(*command, permitted=(0, 1, 3)).processor  # 1 and 3: some points failed, or aren't proved


def median_time(repetitions, *command):
    seconds = []
    while len(seconds) < repetitions and sum(seconds) < ENOUGH_SECONDS:
        seconds.append(processor_time(*command))
    return statistics.median(seconds)


def measured(name, folder, clatter, verify, repetitions):
    """What it takes to certify all points of a configuration, and to prove their certificates."""
    output, file = folder / f"{name}.h5", folder / f"{name}.jsonl"
    processor_time(clatter, "run", SOURCE / "configs" / f"{name}.toml", "-q", "-o", output)
    certify = median_time(repetitions, clatter, "certify", output, "-o", file, "--force")
    told = subprocess.run([verify, "--json", file], capture_output=True, text=True, check=False).stdout
    return {
        "name": name,
        "certificates": file.read_text(encoding="utf-8").count('"claim":'),
        "proved": json.loads(told)["proved"],
        "certify": certify,
        "verify": median_time(repetitions, verify, "--threads", "1", file),
    }


def main():
    parser = argparse.ArgumentParser(
        description="Times `clatter certify` of the outputs of configs/fig23.toml and configs/regimes.toml, and "
        "`clatter-verify --threads 1` of the certificates: processor time of whole processes, medians. Files go to a "
        "temporary folder."
    )
    add_build(parser)
    parser.add_argument("--out", required=True, help="the JSON file to write")
    parser.add_argument("--repetitions", type=int, default=5, help="within a minute (default: 5)")
    arguments = parser.parse_args()
    built = "cmake --build --preset release makes it"
    clatter = program(arguments.build, "apps/clatter/clatter", built)
    verify = program(arguments.build, "apps/verify/clatter-verify", built)
    with tempfile.TemporaryDirectory() as folder:
        results = [measured(name, pathlib.Path(folder), clatter, verify, arguments.repetitions) for name in CONFIGS]
    with open(arguments.out, "w", encoding="utf-8") as file:
        json.dump({"proofs": results}, file, indent=2)


if __name__ == "__main__":
    main()
