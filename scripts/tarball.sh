#!/usr/bin/env bash
# Makes the tarball of the sources; --help says more.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat <<END
usage: scripts/tarball.sh [DIR]

Makes DIR/clatter-VERSION.tar.gz from the files of the last commit; default: build. Changes that are not committed are
not in it. It builds without git, and its program names the commit. Every call for a commit makes the same bytes.
END
}

fail() {
  echo "tarball.sh: $1" >&2
  exit 2
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
  -*) fail "unknown option '$1'; try --help" ;;
esac
(($# <= 1)) || fail "one directory at most; try --help"
command -v git >/dev/null || fail "git is missing; install it"
[[ -e $source_dir/.git ]] || fail "there is no git repository in $source_dir: only a repository has a commit to pack"

# git refuses to read the repository of another user, as of a container's host, and packs with its umask.
git=(git -C "$source_dir" -c safe.directory="$source_dir" -c tar.umask=0022)
version=$("${git[@]}" show HEAD:CMakeLists.txt | sed -n 's/^project(clatter VERSION \([0-9.]*\) .*/\1/p')
[[ -n $version ]] || fail "CMakeLists.txt of the last commit has no project(clatter VERSION ...)"
mkdir -p "${1:-$source_dir/build}"
out=$(cd "${1:-$source_dir/build}" && pwd)/clatter-$version.tar.gz
temporary=$(mktemp "$out.XXXXXX")
trap 'rm -f "$temporary"' EXIT
"${git[@]}" archive --format=tar --prefix="clatter-$version/" HEAD | gzip -9 --no-name >"$temporary"
chmod 644 "$temporary"
mv "$temporary" "$out"
echo "$out"
