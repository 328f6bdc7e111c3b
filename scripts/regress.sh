#!/usr/bin/env bash
# Compares what clatter computes now with a baseline; --help says more.
set -euo pipefail
export LC_ALL=C # one order of files everywhere

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"

tolerance=1e-9 # of results of the order of 1; smaller ones are held to less

usage() {
  cat <<END
usage: scripts/regress.sh BASELINE_DIR [--write h5|text]

Runs configurations of configs/ and compares their outputs with those in BASELINE_DIR, which --write makes:
  h5    whole outputs, NAME.h5, such as those of scripts/reproduce.sh; compared by h5diff, and then value by value
  text  some points of each output, NAME.txt, small enough to commit, with SHA256SUMS
Every figure of the paper must have its baseline; other configurations are compared if they have one. Those of
"clatter accuracy" hold times, optimal_zones has motions that one start in thousands finds, or not, by rounding, and
hysteresis is follow_up and follow_down in one: they are left out.

The table on stdout has a line for each output, in columns between blanks: its name, points and variables compared,
the largest difference, where it is, what h5diff says (same, differs, - for text), the verdict (agrees, differs), and
the differences in words. A difference is a value off by more than $tolerance (times the largest modulus of its
variable if that is below 1, as in m, but at least 1e-4), NaN beside a number, and a variable, shape, type or attribute
that isn't the same. Only these may differ, and the line says "but for" them:
  - values at points that are aperiodic in both, since chaos turns any other rounding into another motion, and along
    "follow" those right after them, since it leaves them near another of several motions; their status must agree,
  - all values at starts that end in another motion, if they are at most 0.2 % of the points: boundaries of basins may
    be so finely mixed that rounding decides; counts and shares of the starts by 2 %, states of aperiodic motions,
  - impact_total, simulated_periods and settling_estimate: how long settling took is no property of the motion,
  - phases by whole turns, or if the amplitude is 0.

Environment: CLATTER, the program (default: build/release/apps/clatter/clatter); CLATTER_ARCH, its instruction set.
Pin it if other machines made the h5 files: on an exact tangency, or before chaos dies out, the last bits may decide
for another motion.
Exit codes: 0 all agree; 1 some differ; 2 wrong use, no baseline, or a damaged one.
END
}

fail() {
  echo "regress.sh: $1" >&2
  exit 2
}

baseline="" write=""
while (($# > 0)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --write)
      [[ ${2-} == h5 || ${2-} == text ]] || fail "--write needs h5 or text; try --help"
      write=$2
      shift
      ;;
    -*) fail "unknown option '$1'; try --help" ;;
    *)
      [[ -z $baseline ]] || fail "one directory, not '$baseline' and '$1'; try --help"
      baseline=$1
      ;;
  esac
  shift
done
[[ -n $baseline ]] || fail "which baseline? try --help"

clatter=${CLATTER:-$source_dir/build/release/apps/clatter/clatter}
[[ -x $clatter ]] || fail "$clatter is missing; scripts/test.sh builds it, or CLATTER names another"

shopt -s nullglob
binaries=("$baseline"/*.h5) texts=("$baseline"/*.txt)
if ((${#binaries[@]} > 0 && ${#texts[@]} > 0)) || [[ $write == h5 && ${#texts[@]} -gt 0 ]] ||
  [[ $write == text && ${#binaries[@]} -gt 0 ]]; then
  fail "$baseline would hold h5 and text; one of them, please"
fi
if [[ -z $write ]]; then
  ((${#binaries[@]} + ${#texts[@]} > 0)) ||
    fail "no baseline in '$baseline'; the present state becomes one with: scripts/regress.sh '$baseline' --write h5"
  if ((${#texts[@]} > 0)); then
    for text in "${texts[@]}" "$baseline/SHA256SUMS"; do
      [[ -f $text ]] || fail "$text isn't a regular file: restore it, or write it anew with --write text"
    done
    (cd "$baseline" && sha256sum -- *.txt | diff - SHA256SUMS >&2) ||
      fail "$baseline isn't what its SHA256SUMS says: restore it, or write it anew with --write text"
  fi
fi

/usr/bin/python3 -c 'import h5py' 2>/dev/null || install_missing python3-h5py >&2
command -v h5diff >/dev/null || ((${#binaries[@]} == 0)) || install_missing hdf5-tools >&2

names=()
if [[ -n $write ]]; then
  for config in "$source_dir"/configs/*.toml; do
    [[ $config == */accuracy_*.toml || $config == */optimal_zones.toml || $config == */hysteresis.toml ]] || names+=("$config")
  done
  names=("${names[@]##*/}")
  names=("${names[@]%.toml}")
else
  # The figures, and all else that the baseline has.
  names=("$source_dir"/configs/fig*.toml "${binaries[@]}" "${texts[@]}")
  names=("${names[@]##*/}")
  mapfile -t names < <(printf '%s\n' "${names[@]%.*}" | sort -u)
fi

outputs=$(mktemp -d)
trap 'rm -rf "$outputs"' EXIT

for name in "${names[@]}"; do
  output=$outputs/$name.h5 code=0
  "$clatter" run "$source_dir/configs/$name.toml" -o "$output" -q || code=$?
  ((code < 124)) || exit "$code" # interrupted; the table reports all else that ends without an output
  [[ -e $output || -z $write ]] || fail "nothing is written, since $name has no output"
done

case "$write" in
  "")
    /usr/bin/python3 "$source_dir/scripts/regress.py" table "$baseline" "$outputs" "$tolerance" "${names[@]}"
    exit
    ;;
  h5)
    mkdir -p "$baseline"
    mv "$outputs"/*.h5 "$baseline"
    ;;
  text)
    mkdir -p "$baseline"
    /usr/bin/python3 "$source_dir/scripts/regress.py" text "$outputs" "$baseline"
    (cd "$baseline" && sha256sum -- *.txt >SHA256SUMS)
    ;;
esac
echo "Written: ${#names[@]} baselines in $baseline" >&2
