# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# The deployed process, for scenarios that have sourced hil.sh.

# ecu_start INTERFACE PROFILE [options]: returns once it sends.
ecu_start() {
  ecu_interface=$1
  ecu_profile=$2
  shift 2
  graben-ecu --can "$ecu_interface" --profile "$ecu_profile" "$@" 2>>"$OUT/ecu.err" &
  ecu=$!
  wait_until 5 ecu_sends "$ecu_interface" || fail "no frame of the ECU: $(cat "$OUT/ecu.err")"
}

# A frame within this second.
ecu_sends() { candump -T 50 -n 1 "$1,0CFF3082:1FFFFFFF" | grep -q 0CFF3082; }

# machine_keeps_time INTERFACE PID: from its first cycle on, whatever processes begin beside it. Without, looking at the
# log kept a machine's valve frame back for 56 ms, and the ECU said 'the valve's feedback is missing'.
machine_keeps_time() {
  candump -T 5000 -n 1 "$1,0CFF2781:1FFFFFFF" >/dev/null
  chrt -f -p 10 "$2"
}

# ecu_stop: told to end, it has to end by itself and with 0. What memory it had is in $OUT/memory.
ecu_stop() {
  cat "/proc/$ecu/smaps_rollup" "/proc/$ecu/status" >"$OUT/memory" || fail 'no graben-ecu'
  kill -TERM "$ecu"
  wait "$ecu" || fail "graben-ecu ended with $?: $(cat "$OUT/ecu.err")"
}
