#!/usr/bin/env bash
# Every figure of the paper from one command; --help says more.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"

steps() {
  cat <<END
Reproduces every figure of doi:10.5755/j02.mech.32277 on Debian 12, as root or with sudo:
  1. installs the packages that are missing:
$(help_lines "for the build (${BUILD_PACKAGES[*]})")
$(help_lines "and for the pictures (${PLOT_PACKAGES[*]}),")
  2. builds clatter in build/release,
  3. runs every configs/fig*.toml to DIR/figNN.h5,
  4. draws every DIR/figNN.svg and DIR/figNN.png.
DIR is out/ in the top folder unless it is given. Running it again replaces the files.
END
}

usage() {
  echo "usage: scripts/reproduce.sh [DIR]"
  echo
  steps
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
  -*) echo "reproduce.sh: unknown option '$1'; try --help" >&2; exit 2 ;;
esac
if (($# > 1)); then
  echo "reproduce.sh: one directory at most; try --help" >&2
  exit 2
fi
mkdir -p "${1:-$source_dir/out}"
out=$(cd "${1:-$source_dir/out}" && pwd)

steps
install_missing "${BUILD_PACKAGES[@]}" "${PLOT_PACKAGES[@]}"

cd "$source_dir"
echo "Building clatter in build/release"
cmake --preset release
cmake --build --preset release --target clatter

echo "Running and drawing the figures into $out"
outputs=()
for config in configs/fig*.toml; do
  output=$out/$(basename "$config" .toml).h5
  build/release/apps/clatter/clatter run "$config" -o "$output" --progress never
  outputs+=("$output")
done
/usr/bin/python3 scripts/plot.py "${outputs[@]}" -o "$out"
echo "Done: ${#outputs[@]} figures in $out"
