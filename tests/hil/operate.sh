# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The operator's station beside the deployed process and the simulated machine, with a gamepad that
# uinput makes. What operate.pad does is judged by operate.py from the bus.
. ./hil.sh
. ./ecu.sh

# refused NAME command...: it has to end with 1; what it says is in $OUT/NAME
refused() {
  refused_name=$1
  shift
  "$@" >"$OUT/$refused_name" 2>&1 && fail "$refused_name: not refused"
  [ $? -eq 1 ] || true
}
says() { grep -q "$1" "$OUT/said"; }
# station_start [options]: returns once it sends
station_start() {
  graben operate --can vcan0 "$@" >"$OUT/said" 2>"$OUT/station_errors" &
  station=$!
  wait_until 10 says 's: vcan0' || fail "the station says nothing: $(cat "$OUT/station_errors")"
}
# station_ends STATUS
station_ends() {
  wait "$station"
  ended=$?
  [ "$ended" -eq "$1" ] || fail "the station ended with $ended: $(cat "$OUT/station_errors")"
}

vcan_up vcan0
refused no_interface graben operate --can vcan7 --gamepad /dev/input/event0
refused no_gamepad graben operate --can vcan0
refused no_device graben operate --can vcan0 --gamepad /dev/null
refused no_terminal graben operate --can vcan0 --keyboard

record vcan0
ecu_start vcan0 excavator_22t.toml
graben plant --can vcan0 --profile excavator_22t.toml --seconds 23 2>"$OUT/plant_errors" &
hil_gamepad vcan0 'First Pad' <operate.pad >"$OUT/pad" 2>&1 &
pad=$!
wait_until 10 grep -q make "$OUT/pad" || fail "no gamepad: $(cat "$OUT/pad")"
station_start --silent-after 2
cp "$OUT/said" "$OUT/said_first"

wait_until 30 test -e held || fail "the pad has stopped: $(cat "$OUT/pad")"
# A second station hears the first and sends nothing; two gamepads are one too many.
printf 'make\nsleep 8000\n' | hil_gamepad vcan0 'Second Pad' >"$OUT/second_pad" 2>&1 &
second=$!
wait_until 10 grep -q make "$OUT/second_pad" || fail "no second gamepad: $(cat "$OUT/second_pad")"
refused two_gamepads graben operate --can vcan0
for event in /dev/input/event*; do other=$event; done
refused second_station graben operate --can vcan0 --gamepad "$other"
# Told to end while it is held.
cansend vcan0 7F0#0C
kill -TERM "$station"
station_ends 0
cp "$OUT/said" "$OUT/said_all"
kill "$pad" 2>/dev/null
wait "$pad"

# Another station begins while this one sends: it ends, and says whose frames they were.
station_start --gamepad "$other"
sleep 1
cansend vcan0 7F0#0D
cansend vcan0 0CFF2742#0000000000000000
station_ends 1
cp "$OUT/station_errors" "$OUT/other_station"

# An ECU with frames of another version.
ecu_stop
station_start --gamepad "$other" --seconds 3
sleep 1
cansend vcan0 18FF3482#0000000007FFFFFF
station_ends 0
cp "$OUT/said" "$OUT/said_other_version"
kill "$second" 2>/dev/null
wait "$second"
exit 0
