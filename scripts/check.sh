#!/usr/bin/env bash
# Checks the sources by one command; --help lists the gates.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"

line_length=120  # of Python; .flake8 has it again
quick=(clang-format shellcheck black flake8 arrows g++)
sanitize=(asan tsan)
all=("${quick[@]}" clang++ clang-tidy "${sanitize[@]}")
by_name=(packages report)

# The tests that the sanitizers run, and the programs they need: those that read files or share memory, some minutes.
# ThreadSanitizer runs only those in which threads meet.
threads='attractors\.(Basins|Ensemble|Tracked|Settling)|sweep\.(Run|SavedRun|Shard)|lanes\.(Of/)?(LaneBits|LanePoints)|plan\.Plan'
asan_tests="^(lanes|branches|storage|config|results|observables)\.|^($threads)\.|^cli\.(hostile_files|readers|shards|streams)_test$"
tsan_tests="^($threads|results\.DatasetFile)\.|^cli\.(shards|streams)_test$"
asan_targets=(
  clatter lanes_tests attractors_tests branches_tests storage_tests config_tests results_tests observables_tests sweep_tests plan_tests
)
tsan_targets=(clatter results_tests lanes_tests attractors_tests sweep_tests plan_tests)

steps() {
  cat <<END
Checks the sources on Debian 12, as root or with sudo. It installs missing
packages, runs each gate, names those that fail, and exits with 1 if any does:
  clang-format  C++ is formatted as .clang-format says
  shellcheck    no finding in any shell script
  black         Python is formatted by black, in lines of at most $line_length
  flake8        no finding in any Python file (.flake8)
  arrows        no include points against the arrows between the folders
                (tests/cli/arrows_test.py)
  g++           everything compiles without a warning: the release build,
                which scripts/test.sh has made already
  clang++       no warning by clang++, without making code (build/clang); takes
                ten minutes
  clang-tidy    no finding in any source file (.clang-tidy); takes longest
  asan          AddressSanitizer and UndefinedBehaviorSanitizer find nothing in
                the tests of lanes, attractors, branches, files,
                configurations, observables, plans, and sweeps on several threads, nor in the
                program when its files are hostile, read by others, split into
                shards, piped (build/asan)
  tsan          ThreadSanitizer finds nothing in the tests of lanes, attractors,
                files of results, plans and sweeps on several threads, nor in
                the program's shards and pipes (build/tsan)
  packages      only by name: tarball and Debian package are right
                (scripts/check_packages.sh --help says more)
  report        only by name: pages of scripts/report.py in headless Chromium,
                of every configuration: clicks on each panel, and the commands
                that they show; leaves pictures of them in build/report
END
}

usage() {
  cat <<END
usage: scripts/check.sh [--quick] [--sanitize] [--packages] [GATE...]

  --quick      all but clang++, clang-tidy, asan, tsan; .ci/run calls it after the tests
  --sanitize   ${sanitize[*]}
  --packages   packages, in some ten minutes
  GATE...      one by one; with no argument all of them but ${by_name[*]}

END
  steps
}

cpp_files() { find src apps tests \( -name '*.cpp' -o -name '*.hpp' \) -print0; }
shell_files() { find scripts .ci \( -name '*.sh' -o -name '*.sbatch' -o -path .ci/run \) -print0; }

configure_clang() {
  cmake --preset clang >/dev/null
  cmake --build --preset clang --target clatter_version >/dev/null
}

run_sanitized() {
  local preset=$1 tests=$2
  shift 2
  cmake --preset "$preset"
  cmake --build --preset "$preset" --target "$@"
  ctest --preset "$preset" -R "$tests"
}

run_gate() {
  case "$1" in
    clang-format) cpp_files | xargs -0 clang-format --dry-run -Werror ;;
    shellcheck) shell_files | xargs -0 shellcheck --external-sources ;;
    black) black --quiet --check --diff --line-length "$line_length" scripts tests ;;
    flake8) flake8 scripts tests ;;
    arrows) CLATTER_SOURCE=$source_dir /usr/bin/python3 -B tests/cli/arrows_test.py ;;
    g++)
      cmake --preset release -D CLATTER_WERROR=ON >/dev/null
      cmake --build --preset release
      ;;
    clang++)
      configure_clang
      /usr/bin/python3 -B scripts/clang_syntax.py build/clang
      ;;
    clang-tidy)
      configure_clang
      run-clang-tidy -quiet -p build/clang -j "$(nproc)" "^$source_dir/(src|apps|tests)/"
      ;;
    asan) run_sanitized asan "$asan_tests" "${asan_targets[@]}" ;;
    tsan) run_sanitized tsan "$tsan_tests" "${tsan_targets[@]}" ;;
    packages) scripts/check_packages.sh ;;
    report)
      CLATTER=$source_dir/build/release/apps/clatter/clatter CLATTER_SOURCE=$source_dir \
        /usr/bin/python3 -B tests/cli/report_in_browser.py build/report
      ;;
  esac
}

gates=()
for argument in "$@"; do
  case "$argument" in
    --quick) gates+=("${quick[@]}") ;;
    --sanitize) gates+=("${sanitize[@]}") ;;
    --packages) gates+=(packages) ;;
    -h | --help) usage; exit 0 ;;
    *)
      if [[ " ${all[*]} ${by_name[*]} " != *" $argument "* ]]; then
        echo "check.sh: unknown argument '$argument'; try --help" >&2
        exit 2
      fi
      gates+=("$argument")
      ;;
  esac
done
((${#gates[@]} > 0)) || gates=("${all[@]}")

steps
packages=("${BUILD_PACKAGES[@]}" "${CHECK_PACKAGES[@]}")
[[ " ${gates[*]} " != *" clang-tidy "* ]] || packages+=("${TIDY_PACKAGES[@]}")
[[ " ${gates[*]} " != *san* ]] || packages+=("${PLOT_PACKAGES[@]}" "${TEST_PACKAGES[@]}")
[[ " ${gates[*]} " != *" report "* ]] || packages+=("${PLOT_PACKAGES[@]}" "${BROWSER_PACKAGES[@]}")
install_missing "${packages[@]}"

cd "$source_dir"
verdicts=() code=0
for gate in "${gates[@]}"; do
  echo "$gate"
  began=$SECONDS
  set +e  # if it were in a condition, the gate would go on after a command that fails
  (
    set -e
    run_gate "$gate"
  )
  status=$?
  set -e
  verdict=passed
  ((status == 0)) || verdict=FAILED code=1
  verdicts+=("$(printf '%-12s %s after %d s' "$gate" "$verdict" $((SECONDS - began)))")
done
echo
printf '%s\n' "${verdicts[@]}"
exit $code
