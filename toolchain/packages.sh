# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# Which packages of Debian 12 the build and the checks need, and how the missing ones are installed.
# Sourced by ./run and ./test. Everything is looked for by what it is wanted for, a command or a
# header, not by package name: a tool that came from elsewhere is as good.

graben_say() { echo "graben: $*" >&2; }

has_command() { command -v "$1" >/dev/null 2>&1; }

has_header() { [ -e "/usr/include/$1" ] || [ -e "/usr/local/include/$1" ]; }

# graben_missing build|check|fuzz|bench|hil|cross|scope|film|slurm|package|install: the packages that are not there yet,
# a line each.
graben_missing() {
  has_command g++ || echo g++
  has_command cmake || echo cmake
  has_command ninja || echo ninja-build
  has_command python3 || echo python3
  has_header eigen3/Eigen/Core || echo libeigen3-dev
  has_header cmocka.h || echo libcmocka-dev
  has_header toml++/toml.h || echo libtomlplusplus-dev
  has_header CLI/CLI.hpp || echo libcli11-dev
  has_header fmt/core.h || echo libfmt-dev
  has_header nlohmann/json.hpp || echo nlohmann-json3-dev
  has_header libwebsockets.h || echo libwebsockets-dev
  has_header zlib.h || echo zlib1g-dev
  has_header ceres/ceres.h || echo libceres-dev
  has_header openssl/evp.h || echo libssl-dev
  has_header libevdev-1.0/libevdev/libevdev.h || echo libevdev-dev
  has_header pugixml.hpp || echo libpugixml-dev
  has_header boost/polygon/voronoi.hpp || echo libboost-dev
  # Debian's npm conflicts with a Node.js from elsewhere, which brings its own.
  has_command node || echo nodejs
  has_command npm || echo npm
  # Debian's Node.js only recommends the certificates without which npm reaches no registry.
  [ -e /etc/ssl/certs/ca-certificates.crt ] || echo ca-certificates
  if [ "$1" = check ]; then
    # What each test costs is GNU time's word.
    [ -x /usr/bin/time ] || echo time
    has_command clang-format-14 || has_command clang-format || echo clang-format
    has_command clang-tidy-14 || has_command clang-tidy || echo clang-tidy
    has_command gcovr || echo gcovr
    # A decoder of CANopen and J1939 that is not ours.
    has_command tshark || echo tshark
    # For the counts of instructions.
    has_command qemu-x86_64 || echo qemu-user
  fi
  if [ "$1" = check ] || [ "$1" = fuzz ]; then
    has_command clang++-14 || echo clang-14
    # The sanitizers' runtimes and libFuzzer; the architecture is in the file's name.
    ls /usr/lib/llvm-14/lib/clang/*/lib/linux/libclang_rt.fuzzer-*.a >/dev/null 2>&1 ||
      echo libclang-rt-14-dev
  fi
  if [ "$1" = bench ]; then
    has_header benchmark/benchmark.h || echo libbenchmark-dev
    has_header boost/math/tools/toms748_solve.hpp || echo libboost-dev
    has_header nlopt.h || echo libnlopt-dev
    has_header coin/IpTNLP.hpp || echo coinor-libipopt-dev
    has_command pkg-config || echo pkg-config
    has_command valgrind || echo valgrind
  fi
  if [ "$1" = hil ]; then
    has_command candump || echo can-utils
    # A user's PATH may lead past it.
    has_command ip || [ -x /usr/sbin/ip ] || [ -x /sbin/ip ] || echo iproute2
    has_command busybox || echo busybox-static
    has_command mkfs.ext4 || [ -x /usr/sbin/mkfs.ext4 ] || [ -x /sbin/mkfs.ext4 ] || echo e2fsprogs
    has_command qemu-system-x86_64 || echo qemu-system-x86
  fi
  if [ "$1" = cross ]; then
    has_command aarch64-linux-gnu-g++ || echo g++-aarch64-linux-gnu
    has_command arm-linux-gnueabihf-g++ || echo g++-arm-linux-gnueabihf
    has_command arm-none-eabi-g++ || echo gcc-arm-none-eabi
    # The C++ library has no command and no fixed version in its path; it brings newlib.
    echo '#include <vector>' | arm-none-eabi-g++ -x c++ -E - >/dev/null 2>&1 ||
      echo libstdc++-arm-none-eabi-newlib
    has_command qemu-aarch64 || echo qemu-user
    has_command qemu-system-arm || echo qemu-system-arm
    # The longest path of an image.
    has_command glpsol || echo glpk-utils
    # CMocka's source for what has no package of it.
    has_command xz || echo xz-utils
  fi
  if [ "$1" = scope ]; then
    has_command chromium || echo chromium
  fi
  if [ "$1" = film ]; then
    has_command chromium || echo chromium
    has_command ffmpeg || echo ffmpeg
  fi
  # A cluster of one machine, on which campaigns are tried.
  if [ "$1" = slurm ]; then
    has_command sbatch || echo slurm-client
    has_command slurmctld || [ -x /usr/sbin/slurmctld ] || echo slurmctld
    has_command slurmd || [ -x /usr/sbin/slurmd ] || echo slurmd
    has_command munged || [ -x /usr/sbin/munged ] || echo munge
  fi
  # What makes the package; what judges and tries it.
  if [ "$1" = package ] || [ "$1" = install ]; then
    has_command dpkg-shlibdeps || echo dpkg-dev
  fi
  if [ "$1" = install ]; then
    has_command lintian || echo lintian
    has_command debootstrap || [ -x /usr/sbin/debootstrap ] || echo debootstrap
  fi
}

graben_apt() {
  DEBIAN_FRONTEND=noninteractive $graben_as_root \
    apt-get -q -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@" </dev/null
}

# graben_install build|check|fuzz|bench|hil|cross|scope|film|slurm|package|install: nothing when all is there; otherwise
# says what, then installs it.
graben_install() {
  # Word splitting is wanted: package names have no blanks.
  graben_packages=$(graben_missing "$1" | tr '\n' ' ')
  [ -n "$graben_packages" ] || return 0
  graben_packages=${graben_packages% }

  if ! has_command apt-get; then
    graben_say "missing: $graben_packages (Debian's names), and there is no apt-get to install it"
    return 1
  fi
  if [ "$(id -u)" -eq 0 ]; then
    graben_as_root=
  elif has_command sudo; then
    # sudo clears the environment; so the variable goes in through env.
    graben_as_root='sudo env DEBIAN_FRONTEND=noninteractive'
  else
    graben_say "missing: $graben_packages. Neither root nor sudo here; as root, please:"
    graben_say "  apt-get install --no-install-recommends $graben_packages"
    return 1
  fi

  graben_say "going to install by apt: $graben_packages"
  graben_log=$(mktemp)
  # A source that cannot be reached must not stop the others: install decides.
  graben_apt update >"$graben_log" 2>&1 || graben_say 'apt-get update failed; trying all the same'
  # shellcheck disable=SC2086
  if ! graben_apt install -y --no-install-recommends $graben_packages >>"$graben_log" 2>&1; then
    cat "$graben_log" >&2
    rm -f "$graben_log"
    graben_say "could not install: $graben_packages"
    return 1
  fi
  rm -f "$graben_log"
  # Read back: an install that 'succeeds' and leaves a gap would surface as a riddle later.
  graben_packages=$(graben_missing "$1" | tr '\n' ' ')
  if [ -n "$graben_packages" ]; then
    graben_say "installed, but still not found: $graben_packages"
    return 1
  fi
}
