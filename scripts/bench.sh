#!/usr/bin/env bash
# All benchmarks from one command; --help says more.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"

steps() {
  cat <<END
Measures how fast clatter is, on Debian 12, as root or with sudo; nothing else should run meanwhile:
  1. installs the packages that are missing:
$(help_lines "for the build (${BUILD_PACKAGES[*]})")
$(help_lines "and for the benchmarks (${BENCH_PACKAGES[*]}),")
  2. builds clatter and its benchmarks in build/release,
  3. runs them, some ten minutes long, and leaves their results as JSON in build/release/bench,
  4. prints tables of them, medians of several repetitions, and the targets. It asserts nothing.
--build measures, instead of all that, what it costs to build the program and then its tests: processor and wall time,
by folder and for the longest files, each from nothing, which takes some ten minutes. With COMMIT that commit's sources
are measured first. Nothing else should run meanwhile.
--growth measures, instead of all that, how time and memory grow with points, periods, shards and motions, with
the options that scripts/bench_growth.py --help tells.
--plan compares, instead of all that, the times that the command plan foretells with those of the runs of ten sweeps.
--quick takes one repetition and smaller sweeps, to see that all works. --arch NAME makes the whole processes
use that instruction set; the other benchmarks use each in turn.
END
}

usage() {
  echo "usage: scripts/bench.sh [--quick] [--arch NAME] | --build [COMMIT] | --growth [OPTION]... | --plan"
  echo
  steps
}

repetitions=(--benchmark_repetitions=7 --benchmark_min_time=0.3)
solver_repetitions=3
growth_filter=all
solver_filter=all
processes=()
proofs=()
build=()
growth=
plan=
while (($# > 0)); do
  case "$1" in
    --quick)
      repetitions=(--benchmark_repetitions=1 --benchmark_min_time=0.05)
      solver_repetitions=1
      growth_filter='^(sincos|threads|out of reach|points/10{3,5}$|periods/10{1,3}$)'
      solver_filter='^(sincos|clatter|Odeint|CVODE/1e-0)'
      processes+=(--map 60 --repetitions 1)
      proofs+=(--repetitions 1)
      shift
      ;;
    --arch)
      if (($# < 2)); then
        echo "bench.sh: --arch needs a name; try --help" >&2
        exit 2
      fi
      processes+=(--arch "$2")
      shift 2
      ;;
    --build)
      build=(scripts/bench_build.py)
      shift
      if (($# > 0)) && [[ $1 != -* ]]; then
        build+=("$1")
        shift
      fi
      ;;
    --growth) growth=yes; shift; break ;;
    --plan) plan=yes; shift ;;
    -h | --help) usage; exit 0 ;;
    *) echo "bench.sh: unknown argument '$1'; try --help" >&2; exit 2 ;;
  esac
done

cd "$source_dir"
if ((${#build[@]} > 0)); then
  install_missing "${BUILD_PACKAGES[@]}" python3
  exec /usr/bin/python3 -B "${build[@]}"
fi
if [[ -n $growth ]]; then
  install_missing "${BUILD_PACKAGES[@]}" python3
  cmake --preset release
  cmake --build --preset release --target clatter
  exec /usr/bin/python3 -B scripts/bench_growth.py "$@"
fi
if [[ -n $plan ]]; then
  install_missing "${BUILD_PACKAGES[@]}" python3
  cmake --preset release
  cmake --build --preset release --target clatter
  exec /usr/bin/python3 -B scripts/bench_plan.py
fi
steps
install_missing "${BUILD_PACKAGES[@]}" "${BENCH_PACKAGES[@]}"
cmake --preset release
cmake --build --preset release --target benchmarks
has_verifier=
if cmake --build --preset release --target help | grep -w clatter-verify >/dev/null; then
  cmake --build --preset release --target clatter-verify
  has_verifier=yes
fi

results=build/release/bench
mkdir -p "$results"

# Runs an executable's benchmarks again and again in random order, so that other load on the machine hits all alike.
measure() {
  local name=$1
  shift
  echo "Running $name"
  "build/release/tests/bench/${name}_bench" "${repetitions[@]}" --benchmark_enable_random_interleaving=true \
    --benchmark_report_aggregates_only=true --benchmark_out_format=json --benchmark_out="$results/$name.json" \
    "$@" >/dev/null
}

measure rates
measure growth --benchmark_filter="$growth_filter"
measure figures
measure solvers --benchmark_repetitions="$solver_repetitions" --benchmark_filter="$solver_filter"
measure housing
echo "Running whole processes"
/usr/bin/python3 scripts/bench_processes.py --out "$results/processes.json" "${processes[@]}"
rm -f "$results/proofs.json"
if [[ -n $has_verifier ]]; then
  echo "Running clatter certify and clatter-verify"
  /usr/bin/python3 scripts/bench_proofs.py --out "$results/proofs.json" "${proofs[@]}"
fi
/usr/bin/python3 scripts/bench_table.py "$results"
