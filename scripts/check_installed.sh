#!/usr/bin/env bash
# Tries the package in a bare system, whose root it takes for its own: scripts/check_packages.sh calls it there.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8

if [[ $# != 1 || $1 == -* ]]; then
  echo "usage: check_installed.sh PACKAGE.deb"
  echo
  echo "Installs the package on this system, runs and draws a figure, and removes the package again."
  [[ ${1-} == -h || ${1-} == --help ]]
  exit
fi

fail() {
  echo "check_installed.sh: $1" >&2
  exit 1
}

install() { apt-get install -q -y --no-install-recommends "$@" >/root/log 2>&1 || fail "$(cat /root/log)"; }

apt-get update -q >/dev/null
install "$1"
wrong=$(dpkg --verify clatter)
[[ -z $wrong ]] || fail "installed files differ from those of the package: $wrong"
[[ -s /usr/share/doc/clatter/copyright ]] || fail "there is no copyright file"
clatter --version
for program in /usr/bin/clatter*; do
  [[ -s /usr/share/man/man1/${program##*/}.1.gz ]] || fail "there is no man page of $program"
done

cd "$(mktemp -d)"
clatter run /usr/share/clatter/configs/fig22.toml -q || fail "clatter doesn't run Fig. 22"
[[ -s fig22.h5 ]] || fail "clatter run made no fig22.h5"
clatter info fig22.h5 >/dev/null

# shellcheck disable=SC2046  # a word for each package
install $(dpkg-query -W -f '${Recommends}' clatter | tr -d ,)
clatter-plot fig22.h5 || fail "clatter-plot doesn't draw Fig. 22"
[[ -s fig22.svg && -s fig22.png ]] || fail "clatter-plot made no fig22.svg and fig22.png"
clatter-report fig22.h5 -o page.html || fail "clatter-report makes no page of Fig. 22"
grep -q '"histories"' page.html || fail "the page has no motion: $(grep -o 'The motion was[^<]*' page.html)"

apt-get purge -q -y clatter >/root/log 2>&1 || fail "$(cat /root/log)"
left=$(find /usr -name '*clatter*')
[[ -z $left ]] || fail "the removed package leaves $left"
echo "It was installed, ran and drew Fig. 22, and was removed without a trace."
