# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The deployed process at a task while the bus is filled; each line of `loads` names a run: name,
# percent of the bus or 0, profile, operator, seconds, and an id of frames that fill it.
. ./hil.sh
. ./ecu.sh

# Frames on the bus since it is up, and when: two numbers.
frames_by_now() { echo "$(cat /sys/class/net/vcan0/statistics/tx_packets) $(cut -d ' ' -f 1 /proc/uptime)"; }

# measure NAME PERCENT PROFILE OPERATOR SECONDS [ID]
measure() {
  name=$1
  if [ "$2" -gt 0 ]; then
    hil_bus_load vcan0 "$2" ${6:+"$6"} >"$OUT/$name.generator" &
    generator=$!
  fi
  ecu_start vcan0 "$3" --stats "$OUT/$name.stats"
  frames_by_now >"$OUT/$name.frames"
  graben plant --can vcan0 --profile "$3" --operator "$4" --seconds "$5" \
    --summary "$OUT/$name.json" || fail "the machine's process ended with $?"
  frames_by_now >>"$OUT/$name.frames"
  ecu_stop
  if [ "$2" -gt 0 ]; then
    kill -TERM "$generator"
    wait "$generator" || fail "the load ended with $?"
  fi
}

uname -v >"$OUT/kernel"
cat /sys/devices/system/clocksource/clocksource0/current_clocksource >"$OUT/clocksource"
vcan_up vcan0
while read -r name percent profile operator seconds id; do
  [ "$name" != end ] || break
  measure "$name" "$percent" "$profile" "$operator" "$seconds" "$id"
done <loads
