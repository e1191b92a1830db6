# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# Configures and builds one preset without a word unless it fails. Sourced by ./run and ./test;
# needs graben_say of packages.sh.

# graben_build ROOT PRESET [TARGET [OPTION]]; OPTION is a CMake option to have on.
graben_build() {
  mkdir -p "$1/build"
  # `./run a | ./run b` starts two at once, and Ninja does not lock its folder.
  (
    if has_command flock && ! flock -n 9; then
      graben_say "waits for another build in build/"
      flock 9
    fi
    graben_build_locked "$1" "$2" "${3-all}" "${4-}" 9>&-
  ) 9>"$1/build/.lock" </dev/null
}

graben_build_locked() (
  # Said in full: `set -e` is off in whatever is called on the left of ||.
  cd "$1" || exit 1
  log=build/$2.log
  # Ninja configures again by itself when a CMakeLists.txt has changed, not when the presets have.
  # shellcheck disable=SC3013 # dash, bash and busybox all know -nt
  if ! [ "build/$2/build.ninja" -nt CMakePresets.json ] ||
    { [ -n "$4" ] && ! grep -q "^$4:BOOL=ON\$" "build/$2/CMakeCache.txt"; }; then
    graben_say "configuring $2"
    cmake --preset "$2" ${4:+"-D$4=ON"} >"$log" 2>&1 || graben_build_failed "$2" "$log"
  fi
  : >"$log"
  graben_watch_build "$2" "$log" $$ &
  watcher=$!
  # Keep going: one broken target must not hide the next.
  status=0
  cmake --build "build/$2" --target "$3" -j "$(nproc)" -- -k 0 >"$log" 2>&1 || status=1
  kill "$watcher" 2>/dev/null
  wait "$watcher" 2>/dev/null || true
  if [ -t 2 ]; then printf '\r\033[K' >&2; fi
  [ "$status" = 0 ] || graben_build_failed "$2" "$log"
)

# graben_watch_build PRESET LOG PID: says how far Ninja is, on a terminal in one line each second, elsewhere
# after two seconds and then every ten; until it is killed or PID is gone.
graben_watch_build() {
  seconds=0
  # The last sleep outlives what it waited for: it must hold nobody's pipe.
  while sleep 1 >/dev/null 2>&1 && kill -0 "$3" 2>/dev/null; do
    seconds=$((seconds + 1))
    done_of=$(sed -n 's/^\[\([0-9]*\)\/\([0-9]*\)\].*/\1 of \2 targets/p' "$2" | tail -n 1)
    if [ -t 2 ]; then
      printf '\r\033[Kgraben: building %s: %s' "$1" "${done_of:-looking}" >&2
    elif [ "$seconds" = 2 ] || [ $((seconds % 10)) -eq 0 ]; then
      graben_say "building $1: ${done_of:-looking}, $seconds s"
    fi
  done
}

graben_build_failed() {
  # Without Ninja's progress: what is left is what went wrong.
  grep -v '^\[[0-9]*/[0-9]*\] ' "$2" >&2 || true
  graben_say "build of $1 failed; the log above is $2"
  exit 1
}
