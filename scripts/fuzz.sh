#!/usr/bin/env bash
# The fuzzers from one command; --help says more.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"

build=$source_dir/build/fuzz
all=()
for file in "$source_dir"/tests/fuzz/*_fuzz.cpp; do
  name=${file##*/}
  all+=("${name%_fuzz.cpp}")
done

steps() {
  cat <<END_OF_STEPS
Runs libFuzzer on the code that reads files written or damaged by others, on Debian 12, as root or with sudo:
  1. installs the packages that are missing:
$(help_lines "for the build (${BUILD_PACKAGES[*]})")
$(help_lines "and for libFuzzer (${FUZZ_PACKAGES[*]}),")
  2. builds the fuzzers in build/fuzz with AddressSanitizer and UndefinedBehaviorSanitizer,
  3. makes the seeds in build/fuzz/corpus from configs/ and tests/fuzz/certificates.jsonl, and small outputs and
     journals,
  4. runs each fuzzer for SECONDS (60 unless given), as many side by side as there are cores,
  5. prints a table. Exit code 1: there is a finding; it is printed, with the command that repeats it.
NAME is one of: ${all[*]}; or all, which is the default.
A fuzzer keeps the inputs that reach new code in build/fuzz/grown, and its next run begins with them.
END_OF_STEPS
}

usage() {
  echo "usage: scripts/fuzz.sh [NAME|all] [SECONDS]"
  echo
  steps
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
esac
name=${1-all} seconds=${2-60}
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "fuzz.sh: SECONDS is a whole number above 0, not '$seconds'" >&2; exit 2; }
names=("${all[@]}")
if [[ $name != all ]]; then
  [[ " ${all[*]} " == *" $name "* ]] || { echo "fuzz.sh: unknown name '$name'; try --help" >&2; exit 2; }
  names=("$name")
fi

steps
install_missing "${BUILD_PACKAGES[@]}" "${FUZZ_PACKAGES[@]}"

cd "$source_dir"
cmake --preset fuzz
cmake --build --preset fuzz
scratch=$(mktemp -d -p "$([[ -w /dev/shm ]] && echo /dev/shm || echo "${TMPDIR:-/tmp}")")
trap 'rm -rf "$scratch"' EXIT
rm -rf "$build/corpus"
TMPDIR=$scratch "$build/tests/fuzz/fuzz_seeds" configs tests/fuzz/certificates.jsonl "$build/corpus"
mkdir -p "$build/findings"

# Sets `options` to those of one fuzzer.
choose_options() {
  case "$1" in
    toml | ini) options=(-max_len=8192 -dict="$build/corpus/words") ;;
    value) options=(-max_len=256 -dict="$build/corpus/words") ;;
    journal | certificate) options=(-max_len=4096) ;;
    *) options=(-max_len=65536 -mutate_depth=2) ;;  # files, whose own mutations change several places at once
  esac
}

# A log of its own for each fuzzer: they run side by side.
run() {
  local options
  choose_options "$1"
  mkdir -p "$build/grown/$1"
  TMPDIR=$scratch "$build/tests/fuzz/$1_fuzz" "${options[@]}" -max_total_time="$seconds" -timeout=25 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$build/findings/$1-" \
    "$build/grown/$1" "$build/corpus/$1" >"$build/$1.log" 2>&1
}

echo "Running ${names[*]}, $seconds s each"
declare -A process
for name in "${names[@]}"; do
  while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n || true; done
  run "$name" &
  process[$name]=$!
done

found=()
printf '\n%-11s %10s %8s %9s %9s\n' target runs seconds coverage findings
for name in "${names[@]}"; do
  findings=0
  wait "${process[$name]}" || { findings=1; found+=("$name"); }
  log=$build/$name.log
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  took=$(sed -n 's/^Done .* runs in \([0-9]*\) second.*/\1/p' "$log")
  coverage=$(grep -o 'cov: [0-9]*' "$log" | tail -n 1 | cut -d ' ' -f 2 || true)
  printf '%-11s %10s %8s %9s %9s\n' "$name" "${runs:--}" "${took:--}" "${coverage:--}" "$findings"
done

for name in "${found[@]}"; do
  log=$build/$name.log
  echo
  echo "$name: $(grep -m 1 -E '^finding: |ERROR: |runtime error: |^terminate called' "$log" || echo "see $log")"
  artifact=$(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1)
  [[ -z $artifact ]] || printf 'again: %q %q\n' "$build/tests/fuzz/${name}_fuzz" "$artifact"
done
((${#found[@]} == 0))
