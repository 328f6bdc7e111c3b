#!/usr/bin/env bash
# All tests from one command; --help says more.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"

steps() {
  cat <<END
Builds clatter and runs all its tests on Debian 12, as root or with sudo:
  1. installs the packages that are missing:
$(help_lines "for the build (${BUILD_PACKAGES[*]}),")
$(help_lines "for the pictures (${PLOT_PACKAGES[*]}),")
$(help_lines "for reading the outputs with other programs (${TEST_PACKAGES[*]}),")
$(help_lines "and for scripts/check.sh, which is tested too (${CHECK_PACKAGES[*]}),")
  2. builds clatter and its tests in build/release,
  3. runs all tests through ctest; one needs a small disk: root, or unshare -rm scripts/test.sh once all is installed.
END
}

usage() {
  echo "usage: scripts/test.sh"
  echo
  steps
}

case "${1-}" in
  "") ;;
  -h | --help) usage; exit 0 ;;
  *) echo "test.sh: unknown argument '$1'; try --help" >&2; exit 2 ;;
esac

steps
install_missing "${BUILD_PACKAGES[@]}" "${PLOT_PACKAGES[@]}" "${TEST_PACKAGES[@]}" "${CHECK_PACKAGES[@]}"

cd "$source_dir"
cmake --preset release -D CLATTER_WERROR=ON
cmake --build --preset release
ctest --preset release
