# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# What scenarios share; they begin with `. ./hil.sh`. They are POSIX sh and run in a guest or on a host,
# in a network of their own, in the folder that holds their files; programs are on PATH, results go
# to $OUT. Busybox prefers its own tools when one of them starts another: never `timeout 1 ip ...`.

fail() {
  echo "FAIL: $*"
  exit 1
}

# wait_until SECONDS command...: looks every 10 ms, or LOOKS_PER_S times a second, until the command succeeds.
wait_until() {
  looks_per_s=${LOOKS_PER_S:-100}
  looks_left=$(($1 * looks_per_s))
  shift
  until "$@"; do
    looks_left=$((looks_left - 1))
    [ "$looks_left" -gt 0 ] || return 1
    sleep "0.$(printf %03d $((1000 / looks_per_s)))"
  done
}

# vcan_up INTERFACE
vcan_up() {
  ip link add "$1" type vcan || fail "no $1"
  ip link set "$1" up || fail "$1 stays down"
}

# controller_up INTERFACE BITRATE: a SJA1000 of the guest
controller_up() {
  ip link set "$1" type can bitrate "$2" || fail "no $1"
  ip link set "$1" up || fail "$1 stays down"
}

is_listened_to() { grep -q "^ *$1 " /proc/net/can/rcvlist_all /proc/net/can/rcvlist_err; }

# record INTERFACE: everything on it, error frames too, goes to $OUT/INTERFACE.log as candump writes it.
# Returns once it listens.
record() {
  candump -D -L "$1,0:0,#FFFFFFFF" >"$OUT/$1.log" &
  wait_until 5 is_listened_to "$1" || fail "nothing records $1"
}
