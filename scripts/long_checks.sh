#!/usr/bin/env bash
# The longer forms of tests that draw random scenes, run for long or go wrong in many ways; --help says more.
set -euo pipefail

usage() {
  cat <<END
usage: scripts/long_checks.sh NAME [COUNT]

Runs the long form of a test in tests/hard, tests/attractors,
tests/stepping or tests/cli; build first (scripts/test.sh). NAME is one of
  random       COUNT scenes with chatter and rest against 50 digits            (default 10000; about 0.1 s each)
  arcs         COUNT arcs of every scale against 50 digits                     (default 10000000; about 0.1 ms each)
  properties   the laws that every motion obeys, on COUNT random scenes        (default 1000000; about 10 ms each)
  shortcuts    COUNT steady scenes with every shortcut and with none           (default 10000; about 0.1 s each)
  soft         COUNT scenes with soft stops against 50 digits and a general solver (default 100000; about 0.1 s each)
  slides       COUNT scenes with dry friction, event by event, against Taylor series in 113 bits
               (default 3000; about 0.2 s each)
  carried      the same with a loose mass (default 2000; about 0.3 s each)
  machines     COUNT scenes with stops, friction and a loose mass at once against the same series (default 1000;
               about 1 s each)
  attractors   the motions of COUNT scenes, numbered and told apart by long runs (default 1000; about 0.5 s each)
  drift        the speed of contact over COUNT conservative impacts            (default 100000000; about 1 us each)
  kills        COUNT runs killed, each sweep again and again until it is done  (default 1000; about 0.5 s each)
  disks        a sweep on disks that are full at COUNT sizes                   (default 100; about 1 s each)
  combinations COUNT random scenes of all effects together, each written in several ways, by the program,
               and branches, followed sweeps and starts of a tenth of them (default 3000; about 0.2 s each)
  coincidences COUNT random scenes in which events fall together, and in which they don't: starts on a contact and
               between, keys at zero and at 1e-9, branches begun again from any of their set, scenes and machines,
               other units of time
               (default 2000; about 0.5 s each)
  sensitivity  derivatives by keys of COUNT random scenes, and as many with a loose mass: what units demand of them,
               and differences of runs (default 3000; about 40 ms each)
  releases     the periods and impacts of COUNT scenes that rest now and then, in 60 digits
               (default 300; about 0.5 s each)
  verify       COUNT random scenes certified and proved by clatter-verify, and all points of the shipped
               configurations and branches (default 100000; about 25 ms each)
  forgers      COUNT false certificates, edited at random, of which clatter-verify proves none
               (default 20000; about 10 ms each)
  scenes       all hard scenes proved by clatter-verify and written anew (no COUNT; about 5 minutes)
  starts       tests/regression on every instruction set with all starts of basins and zones, of which
               ctest runs all on the widest set only (no COUNT; about 2 minutes)
END
}

filter="" count="" tests=hard_tests
case "${1-}" in
  random) filter='*RandomScenes*' count=10000 ;;
  arcs) filter='Arcs.agree*' count=10000000 ;;
  properties) filter='*Properties.*' count=1000000 ;;
  shortcuts) filter='Attractors.no_shortcut*' count=10000 ;;
  attractors) filter='BruteForce.*' count=1000 tests=attractors_tests ;;
  soft) filter='SoftStops.random*:SoftStops.no_contact*' count=100000 tests=stepping_tests ;;
  slides) filter='SlidingScenes.*' count=3000 ;;
  carried) filter='CarryingScenes.*' count=2000 ;;
  machines) filter='Machines.*' count=1000 ;;
  drift) filter='Long.conservative*' count=100000000 ;;
  kills) filter=resume_test.Resume.test_killed_at_random_moments_it_loses_nothing_that_was_saved count=1000 ;;
  disks) filter=faults_test.Faults.test_a_disk_that_is_full_at_any_size_loses_nothing count=100 ;;
  combinations) filter=combinations_test.Combinations count=3000 ;;
  coincidences) filter='coincidences_test units_of_time_test' count=2000 ;;
  sensitivity) count=3000
    filter='sensitivity_relations_test.OfRandomScenes loose_mass_sensitivity_test.OfRandomScenes' ;;
  releases) filter=releases_test.Releases.test_random_rests_are_told_as_60_digits_tell_them count=300 ;;
  verify) filter=verify_test.Verify count=100000 ;;
  forgers) filter=forgers_test.Forgers count=20000 ;;
  scenes) filter=hard_scenes_test.HardScenes count=1 ;;
  starts) filter=regress_test.Regress.test_the_committed_baseline_holds_on_every_instruction_set count=1 ;;
  -h | --help) usage; exit 0 ;;
  *) echo "long_checks.sh: unknown name '${1-}'; try --help" >&2; exit 2 ;;
esac
if [[ $1 == starts || $1 == scenes ]] && (($# > 1)); then
  echo "long_checks.sh: $1 takes no COUNT" >&2
  exit 2
fi
count=${2-$count}
[[ $count =~ ^[1-9][0-9]*$ ]] || { echo "long_checks.sh: COUNT is a whole number above 0, not '$count'" >&2; exit 2; }

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [[ $filter == *_test* ]]; then
  export CLATTER=$top/build/release/apps/clatter/clatter CLATTER_KILLS=$count CLATTER_DISKS=$count
  export CLATTER_COMBINATIONS=$count CLATTER_RELEASES=$count CLATTER_VERIFIED=$count CLATTER_SENSITIVITY=$count
  export CLATTER_COINCIDENCES=$count CLATTER_FORGED=$count
  export CLATTER_VERIFY=$top/build/release/apps/verify/clatter-verify CLATTER_SOURCE=$top
  export PYTHONDONTWRITEBYTECODE=1
  [[ $1 != starts ]] || export CLATTER_ALL_STARTS=1
  [[ -x $CLATTER ]] || { echo "long_checks.sh: $CLATTER is missing; scripts/test.sh builds it" >&2; exit 2; }
  cd "$top/tests/cli"
  read -ra names <<< "$filter"
  exec /usr/bin/python3 -m unittest -v "${names[@]}"
fi

program=$top/build/release/tests/$tests
[[ -x $program ]] || { echo "long_checks.sh: $program is missing; scripts/test.sh builds it" >&2; exit 2; }

if [[ $1 == drift ]]; then
  CLATTER_IMPACTS=$count exec "$program" --gtest_filter="$filter"
fi

parts=$(nproc) failed=0 processes=()
((parts <= count)) || parts=1
for ((part = 0; part < parts; ++part)); do
  CLATTER_SCENES=$((count * part / parts)):$((count * (part + 1) / parts)) "$program" --gtest_filter="$filter" &
  processes+=($!)
done
for process in "${processes[@]}"; do
  wait "$process" || failed=1
done
exit $failed
