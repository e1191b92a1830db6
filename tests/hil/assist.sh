# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# Task Assist from the operator's station: the arm's lever draws the edge along a design. What assist.pad does is
# judged by assist.py from the bus.
. ./hil.sh
. ./ecu.sh

vcan_up vcan0
record vcan0
ecu_start vcan0 excavator_22t.toml --task assist.toml
graben plant --can vcan0 --profile excavator_22t.toml --seconds 18 2>"$OUT/plant_errors" &
machine=$!
hil_gamepad vcan0 'First Pad' <assist.pad >"$OUT/pad" 2>&1 &
pad=$!
wait_until 10 grep -q make "$OUT/pad" || fail "no gamepad: $(cat "$OUT/pad")"
graben operate --can vcan0 >"$OUT/said" 2>"$OUT/station_errors" &
station=$!
machine_keeps_time vcan0 "$machine"
wait_until 40 test -e finished || fail "the pad has stopped: $(cat "$OUT/pad")"
kill -TERM "$station"
wait "$station" || fail "the station ended with $?: $(cat "$OUT/station_errors")"
kill "$pad" 2>/dev/null
wait "$pad"
ecu_stop
exit 0
