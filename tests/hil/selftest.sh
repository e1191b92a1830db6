# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# What later scenarios rely on; selftest.py reads what this leaves in $OUT.
. ./hil.sh

uname -v >"$OUT/kernel"
vcan_up vcan0
record vcan0
number=0
while [ "$number" -lt 20 ]; do
  cansend vcan0 "18FF0100#$(printf %016X "$number")" || fail "cansend $number"
  number=$((number + 1))
  sleep 0.01
done

# A bus-off, as the controller's driver would tell of it, comes to a raw socket that wants errors.
cansend vcan0 20000040#0000000000000000

# A gateway that turns the first byte round on its way: what is corrupted arrives corrupted.
vcan_up vcan1
record vcan1
cangw -A -s vcan0 -d vcan1 -e -m XOR:D:123.8.FF00000000000000 || fail 'cangw'
cansend vcan0 123#0102030405060708

if [ "$HIL_WHERE" = vm ]; then
  # Delayed frames reach local sockets late: vcan is loaded with echo=1.
  tc qdisc add dev vcan1 root netem delay 200ms || fail 'netem'
  cansend vcan0 124#A0
  cansend vcan1 124#A1

  controller_up can0 500000
  controller_up can1 500000
  record can0
  record can1
  cansend can0 18FF0203#1122334455667788
  cansend can1 18FF0302#8877665544332211
  wait_until 5 grep -q 18FF0302 "$OUT/can0.log" || fail 'nothing from can1 on can0'
fi

wait_until 5 grep -q '124#A1' "$OUT/vcan1.log" || [ "$HIL_WHERE" = host ] || fail 'netem kept it'
wait_until 5 grep -q '123#FE0203' "$OUT/vcan1.log" || fail 'cangw let nothing through'

cangw -F
ip link del vcan1

# Neither an idle nor a busy guest may wake a cyclic thread late.
hil_wake_latency 1 >"$OUT/wake_idle" || fail 'no real-time priority'
cangen vcan0 -g 1 -e &
(while :; do :; done) &
hil_wake_latency 1 >"$OUT/wake_busy" || fail 'no real-time priority'
