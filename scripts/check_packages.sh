#!/usr/bin/env bash
# Makes the packages and tries them; --help says more.
set -euo pipefail
export LC_ALL=C # one order of files everywhere

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"

steps() {
  cat <<END
Makes the tarball and the Debian package of the last commit in build/packages, on Debian 12, as root or with sudo:
  1. installs the packages that are missing:
$(help_lines "${BUILD_PACKAGES[*]} ${TARBALL_PACKAGES[*]},")
$(help_lines "without --tarball ${PACKAGE_PACKAGES[*]},")
  2. makes the tarball: it has the files of git, and configures without git.
--tarball ends here. Without it, some ten minutes:
  3. builds the Debian package from the tarball without git, and from a clone in another folder,
  4. compares both tarballs and both packages byte for byte,
  5. lets lintian look for errors in the package,
  6. installs it in a bare system that is removed afterwards, and runs and draws a figure there. The system is the
     release of this machine, from its own sources of packages.
END
}

usage() {
  cat <<END
usage: scripts/check_packages.sh [--tarball]

END
  steps
}

fail() {
  echo "check_packages.sh: $1" >&2
  exit 1
}

# Runs a command as if git were not installed.
without_git() { PATH=$scratch/without_git:$PATH "$@"; }

configure() { # folder of the sources, then options
  cmake -S "$1" --preset release -D CLATTER_TESTS=OFF "${@:2}" >"$scratch/log" ||
    { cat "$scratch/log" >&2; fail "the sources in $1 don't configure"; }
}

check_tarball() {
  local tarball commit
  tarball=$("$source_dir/scripts/tarball.sh" "$out")
  tar -xzf "$tarball" -C "$scratch"
  unpacked=$scratch/$(basename "$tarball" .tar.gz)
  (cd "$unpacked" && find . -type f -o -type l) | sed 's|^\./||' | sort >"$scratch/packed"
  "${git[@]}" ls-tree -r -z --name-only HEAD | tr '\0' '\n' | sort >"$scratch/committed"
  diff "$scratch/committed" "$scratch/packed" >&2 || fail "the tarball (>) has other files than the last commit (<)"
  echo "The tarball has the $(wc -l <"$scratch/committed") files of git."

  without_git configure "$unpacked"
  without_git cmake --build "$unpacked/build/release" --target clatter_version >"$scratch/log" ||
    fail "$(cat "$scratch/log")"
  commit=$("${git[@]}" rev-parse HEAD)
  grep -q "\"$commit\"" "$unpacked/build/release/src/results/version.cpp" ||
    fail "a build of the tarball doesn't know its commit, $commit: see .gitattributes and src/results/version.cmake"
  echo "It configures without git, as commit $commit."
}

build_package() { # folder of the sources; prints the name of the package
  configure "$1"
  cmake --build "$1/build/release" >"$scratch/log" || fail "the sources in $1 don't build: $(tail -n 30 "$scratch/log")"
  (cd "$1/build/release" && cpack) >"$scratch/log" 2>&1 || fail "cpack failed: $(cat "$scratch/log")"
  (cd "$1/build/release" && realpath -- *.deb)
}

check_package() {
  local clone=$scratch/elsewhere/"a clone" first second
  "${git[@]}" clone -q "$source_dir" "$clone"
  git -C "$clone" checkout -q --detach "$("${git[@]}" rev-parse HEAD)"
  echo "Building the package from the tarball"
  first=$(without_git build_package "$unpacked")
  echo "Building it from a clone"
  second=$(build_package "$clone")
  same "$first" "$second"
  same "$out/$(basename "$unpacked").tar.gz" "$("$clone/scripts/tarball.sh" "$scratch/elsewhere")"
  package=$out/$(basename "$first")
  cp "$first" "$package.new"
  mv "$package.new" "$package"
  all_of_the_manual "$unpacked/build/release/manual"
  lintian --allow-root --fail-on error "$package" || fail "lintian finds errors"
}

same() {
  cmp "$1" "$2" || fail "two builds of one commit made different bytes; diffoscope shows which"
  echo "Two builds made the same bytes: $(basename "$1"), $(sha256sum <"$1")"
}

# Every page and every completion that the build makes is in the package.
all_of_the_manual() {
  local file name
  dpkg-deb --fsys-tarfile "$package" | tar -t >"$scratch/contents"
  while IFS= read -r file; do
    name=$(basename "$file")
    grep -qE "/${name//./\\.}(\.gz)?\$" "$scratch/contents" || fail "the package doesn't have $name of the manual"
  done < <(find "$1" -type f)
}

try_package() {
  local sources suite
  sources=$(apt-get indextargets --format "deb \$(REPO_URI) \$(RELEASE) \$(COMPONENT)" \
    "Origin: $(. /etc/os-release && echo "${ID^}")" 'Created-By: Packages' | sort -u)
  [[ -n $sources ]] || fail "apt-get knows no packages of this release; run apt-get update"
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  echo "Installing the package in a bare $suite"
  # It makes the system in a folder of its own, which it removes, even if a hook fails.
  mmdebstrap --quiet --variant=minbase --format=null \
    --customize-hook="copy-in '$package' '$source_dir/scripts/check_installed.sh' /root" \
    --customize-hook="chroot \"\$1\" bash /root/check_installed.sh '/root/$(basename "$package")'" \
    "$suite" - - <<<"$sources" || fail "the package doesn't work in a bare $suite"
}

only_tarball=""
case "${1-}" in
  "") ;;
  --tarball) only_tarball=yes ;;
  -h | --help) usage; exit 0 ;;
  *) echo "check_packages.sh: unknown argument '$1'; try --help" >&2; exit 2 ;;
esac

if [[ ! -e $source_dir/.git ]]; then
  echo "There is no git repository in $source_dir, so there is nothing to pack: these sources are a tarball's."
  exit 0
fi
steps
packages=("${BUILD_PACKAGES[@]}" "${TARBALL_PACKAGES[@]}")
[[ -n $only_tarball ]] || packages+=("${PACKAGE_PACKAGES[@]}")
install_missing "${packages[@]}"

git=(git -C "$source_dir" -c safe.directory="$source_dir")
out=$source_dir/build/packages
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$out" "$scratch/elsewhere" "$scratch/without_git"
printf '#!/bin/sh\necho "git is hidden from this build" >&2\nexit 127\n' >"$scratch/without_git/git"
chmod +x "$scratch/without_git/git"
if ! "${git[@]}" diff-index --quiet HEAD --; then
  echo "Changes that are not committed are not in the packages."
fi

check_tarball
[[ -z $only_tarball ]] || exit 0
check_package
try_package
echo "All is well: $(find "$out" -type f -printf '%f ')"
