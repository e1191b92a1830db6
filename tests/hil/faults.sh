# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# Faults that only a kernel can show, one after the other on a machine that digs in shifts. Each is
# marked on the bus by an 11-bit frame 7F0#<row> as it begins; faults.py judges the log.
. ./hil.sh
. ./ecu.sh

# The last EcuStatus on the bus says this mode: three bits of the second digit, whose fourth may be either. To look
# takes four processes, which cost the guest more than the controller's cycles.
mode_is() { tail -n 60 "$OUT/vcan0.log" | grep '18FF3182#' | tail -n 1 | grep -q "18FF3182#.[$1]"; }
LOOKS_PER_S=10

# begin ROW: waits until the operator has let go and the machine has been digging anew for a moment.
begin() {
  wait_until 15 mode_is 19 || fail "row $1: not ready"
  wait_until 15 mode_is 3B || fail "row $1: not active"
  sleep 1
  cansend vcan0 "7F0#$1"
}

ecu_pid() { pidof graben-ecu; }

vcan_up vcan0
record vcan0
hil_supervise 200 graben-ecu --can vcan0 --profile excavator_22t.toml --stats "$OUT/stats" \
  >"$OUT/supervise.log" 2>"$OUT/ecu.err" &
supervisor=$!
wait_until 5 ecu_sends vcan0 || fail "no frame of the ECU: $(cat "$OUT/ecu.err")"
graben plant --can vcan0 --profile excavator_22t.toml --operator shifts \
  --summary "$OUT/summary.json" &
plant=$!
machine_keeps_time vcan0 "$plant"

begin 26 # a bus-off, as the driver tells of it
cansend vcan0 20000040#0000000000000000

begin 27 # error-passive; a second later active again
cansend vcan0 20000004#0020000000000000
sleep 1
cansend vcan0 20000004#0040000000000000

begin 28 # the interface goes down and comes back
ip link set vcan0 down
sleep 0.5
ip link set vcan0 up

begin 29 # for a moment the interface takes no frame
tc qdisc add dev vcan0 root netem delay 5s limit 1
sleep 0.03
tc qdisc del dev vcan0 root

begin 24 # as many frames as the kernel can make, the highest priority
cangen vcan0 -g 0 -e -I 00000000 -L 8 -D 0000000000000000 -n 5000 2>/dev/null

begin 25 # and the lowest
cangen vcan0 -g 0 -e -I 1FFFFFFF -L 8 -D 0000000000000000 -n 5000 2>/dev/null

begin 44 # stopped; the supervisor's watchdog is not to end it this time
kill -STOP "$supervisor"
kill -STOP "$(ecu_pid)"
sleep 1
kill -CONT "$(ecu_pid)"
sleep 0.1
kill -CONT "$supervisor"

begin 42 # stalled for good: the watchdog restarts it
kill -STOP "$(ecu_pid)"
sleep 1

begin 43 # killed
kill -KILL "$(ecu_pid)"
sleep 1

begin 45 # the wall clock steps, a day on and two back
date -s "@$(($(date +%s) + 86400))" >/dev/null
sleep 0.2
date -s "@$(($(date +%s) - 172800))" >/dev/null
sleep 1
cansend vcan0 7F0#FF

kill -TERM "$supervisor"
wait "$supervisor" || fail "the supervisor ended with $?: $(cat "$OUT/ecu.err")"
kill -TERM "$plant"
wait "$plant" || fail "the machine's process ended with $?"
