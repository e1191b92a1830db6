# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# Commissioning on a bus: the deployed process, a simulated machine that is another one than its profile
# says, and the station with a gamepad that uinput makes. What comes of it is judged by commission.py.
. ./hil.sh
. ./ecu.sh

# refused NAME command...: it has to end with 1; what it says is in $OUT/NAME
refused() {
  refused_name=$1
  shift
  "$@" >"$OUT/$refused_name" 2>&1 </dev/null && fail "$refused_name: not refused"
  [ $? -eq 1 ] || true
}
says() { grep -q "$1" "$OUT/$2"; }
# No function: a signal has to reach the station itself.
commission="graben commission --can vcan0 --profile excavator_22t.toml --log $OUT/drive.log --silent-after 60"
parts='--only bucket --no-steps --no-bursts --no-pairs'

vcan_up vcan0
# shellcheck disable=SC2086
refused no_controller $commission $parts --windows commission.toml
record vcan0
ecu_start vcan0 excavator_22t.toml
graben plant --can vcan0 --profile excavator_22t.toml --hidden 3 --seconds 110 2>"$OUT/plant_errors" &
# shellcheck disable=SC2086
refused no_windows $commission $parts
# shellcheck disable=SC2086
refused nothing_begun $commission --resume
hil_gamepad vcan0 'First Pad' <commission.pad >"$OUT/pad" 2>&1 &
pad=$!
wait_until 10 grep -q make "$OUT/pad" || fail "no gamepad: $(cat "$OUT/pad")"

# The first run is told to end when the first ramp is done.
# shellcheck disable=SC2086
$commission $parts --windows commission.toml >"$OUT/said_first" 2>&1 &
station=$!
wait_until 20 says 'press and hold' said_first || fail "it does not wait: $(cat "$OUT/said_first")"
touch first
wait_until 60 says 'extending: ramp to its edge: done' said_first ||
  fail "no ramp is done: $(cat "$OUT/said_first")"
cansend vcan0 7F0#03
kill -TERM "$station"
wait "$station"
[ $? -eq 1 ] || fail "told to end, it ended well: $(cat "$OUT/said_first")"
touch second
# shellcheck disable=SC2086
refused log_is_there $commission $parts --windows commission.toml

# shellcheck disable=SC2086
$commission --resume >"$OUT/said_second" 2>&1 &
station=$!
wait_until 20 says 'press and hold' said_second || fail "it does not wait: $(cat "$OUT/said_second")"
touch third
wait "$station" || fail "it ended with $?: $(cat "$OUT/said_second")"
cansend vcan0 7F0#04
kill "$pad" 2>/dev/null
wait "$pad"
exit 0
