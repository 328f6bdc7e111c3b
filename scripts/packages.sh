# Sourced by the scripts that need Debian 12 packages: those for each purpose, and the installation of missing ones.
# shellcheck shell=bash disable=SC2034  # its lists are used by those who source it

# libgtest-dev is among the build's, since the preset configures the tests too: one configuration for both scripts.
BUILD_PACKAGES=(g++ cmake ninja-build pkg-config libhdf5-dev libboost-program-options-dev libtomlplusplus-dev
                libfftw3-dev libeigen3-dev nettle-dev zlib1g-dev libxsimd-dev nlohmann-json3-dev libgtest-dev)
PLOT_PACKAGES=(python3 python3-h5py python3-numpy python3-matplotlib)
TEST_PACKAGES=(python3-pandas python3-xarray python3-h5netcdf python3-netcdf4 python3-scipy python3-yaml netcdf-bin
               hdf5-tools strace python3-pip python3-setuptools python3-wheel mandoc zsh fish libflint-arb-dev
               python3-jsonschema)
CHECK_PACKAGES=(clang clang-format libomp-dev shellcheck black flake8)
TIDY_PACKAGES=(clang-tidy)
FUZZ_PACKAGES=(clang libclang-rt-14-dev libomp-dev libflint-arb-dev)
BENCH_PACKAGES=(libflint-arb-dev libbenchmark-dev libsundials-dev python3)
TARBALL_PACKAGES=(git)
PACKAGE_PACKAGES=(dpkg-dev file lintian mmdebstrap python3)
BROWSER_PACKAGES=(chromium chromium-driver python3-selenium)
SLURM_PACKAGES=(slurm-wlm munge)

# A part of an item in a help text, which may name many packages, in lines of at most 119 columns.
help_lines() {
  fold -s -w 114 <<<"$1" | sed 's/^/     /; s/ *$//'
}

is_installed() {
  [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

as_root() {
  if [[ $(id -u) == 0 ]]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "$0: needs root to run '$*': run it as root, or install sudo" >&2
    return 1
  fi
}

# Installs those of the named packages that are not there yet, and nothing else.
install_missing() {
  local missing=() package
  if ! command -v dpkg-query >/dev/null; then
    echo "$0: this is not Debian; install the equivalents of: $*" >&2
    return 1
  fi
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  if ((${#missing[@]} == 0)); then
    echo "All packages are there."
    return 0
  fi
  echo "Installing ${missing[*]}"
  as_root apt-get update -q
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}
