# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091,SC2086
# Machines whose fault looks healthy frame by frame, each with the deployed process on a vcan of its own;
# plausible.py writes the file `cases` and judges the logs.
. ./hil.sh
. ./ecu.sh

# run_case INTERFACE PROFILE OPERATOR TASK SECONDS OPTIONS COMMAND, '-' for none. The command begins with the
# seconds after which it runs, counted from the machine's first cycle; it knows INTERFACE, PROFILE and the process ECU.
run_case() {
  interface=$1 profile=$2 operator=$3 program=$4 seconds=$5 options=$6 command=$7
  [ "$program" = - ] && program=
  vcan_up "$interface"
  record "$interface"
  recorder=$!
  graben-ecu --can "$interface" --profile "$profile" ${program:+--task "$program"} 2>>"$OUT/$interface.err" &
  ecu=$!
  wait_until 5 ecu_sends "$interface" || fail "no frame of the ECU: $(cat "$OUT/$interface.err")"
  graben plant --can "$interface" --profile "$profile" --operator "$operator" --seconds "$seconds" \
    ${program:+--task "$program"} $options --summary "$OUT/$interface.json" 2>>"$OUT/$interface.err" &
  plant=$!
  machine_keeps_time "$interface" "$plant"
  if [ "$command" != - ]; then
    sleep "${command%% *}"
    cansend "$interface" 7F0#01
    INTERFACE=$interface PROFILE=$profile ECU=$ecu sh -c "${command#* }" >>"$OUT/$interface.err" 2>&1
  fi
  wait "$plant" || fail "$interface: the machine's process ended with $?: $(cat "$OUT/$interface.err")"
  kill -TERM "$ecu" 2>/dev/null
  wait "$ecu"
  echo "$?" >"$OUT/$interface.status"
  kill "$recorder"
  ip link delete "$interface"
}

run_lane() {
  while IFS='|' read -r lane interface profile operator program seconds options command; do
    [ "$lane" != "$1" ] || run_case "$interface" "$profile" "$operator" "$program" "$seconds" "$options" "$command"
  done <cases
}

running=
# Lane 0 comes after the others: its machines need the processor for themselves.
cut -d '|' -f 1 cases | sort -u >lanes
while read -r lane; do
  [ "$lane" != 0 ] || continue
  run_lane "$lane" &
  running="$running $!"
done <lanes
for one in $running; do wait "$one" || fail "a lane ended with $?"; done
run_lane 0
cat /proc/uptime >"$OUT/uptime"
