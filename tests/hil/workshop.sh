# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The deployed process without a machine, so that faults come, and a workshop's tool on vcan0: what it is
# answered, what is stored, and what a disk that is full does. workshop.py judges what this leaves.
. ./hil.sh
. ./ecu.sh

vcan_up vcan0
record vcan0
# Others' J1939 beside ours: the kernel puts DM1 together, and takes what is for address F8.
j1939cat vcan0:0xf7,0xfeca -B -r >"$OUT/dm1" &
j1939cat vcan0:0xf8 -r >"$OUT/to_f8" &
j1939cat vcan0:0xf6 -r >"$OUT/to_f6" &
ecu_start vcan0 excavator_22t.toml --stats "$OUT/stats" --store /store
sleep 12.5
# DM2; a group that there is not, of us and of all; DM3; what is no request; DM1 of us alone, which is long.
for request in 18EA82F9#CBFE00 18EA82F9#ECFE00 18EAFFF9#ECFE00 18EA82F9#CCFE00 18EA82F9#01 18EA82F9#CAFE00; do
  cansend vcan0 "$request"
  sleep 0.3
done
# DM1 for the kernel's tool alone, once the other has been given up.
sleep 1.3
printf '\312\376\0' >/tmp/request
j1939cat -i /tmp/request vcan0:0xf8,0xea00 :0x82,0xea00
sleep 1
# DM24 and DM25, what a freeze frame has and the last one, for another one of the kernel's.
printf '\266\375\0' >/tmp/request
j1939cat -i /tmp/request vcan0:0xf6,0xea00 :0x82,0xea00
sleep 2
printf '\267\375\0' >/tmp/request
j1939cat -i /tmp/request vcan0:0xf6,0xea00 :0x82,0xea00
sleep 2
# Our own tool for a workshop.
graben faults --can vcan0 --json >"$OUT/faults.json" || fail 'graben faults'
graben faults --can vcan0 --address 33 2>"$OUT/nobody" && fail 'an ECU that there is not has answered'
graben faults --can vcan0 --clear previous >"$OUT/cleared" || fail 'nothing cleared'
mkdir "$OUT/before" "$OUT/after"
cp /store/* "$OUT/before"
cansend vcan0 18EA82F9#D3FE00
sleep 6
ecu_stop
cp /store/* "$OUT/after"

# A start with what is there, by the way that systemd has it.
STATE_DIRECTORY=/store ecu_start vcan0 excavator_22t.toml --stats "$OUT/stats_again"
sleep 2
ecu_stop

# Its address (J1939-81): j1939acd of the kernel's people asks who has 130, and takes 129; a storm of claims of higher
# names changes nothing; a lower one has it.
vcan_up vcan1
record vcan1
ecu_start vcan1 excavator_22t.toml --stats "$OUT/stats_claim" --name 3000ff0000000005
j1939acd -r 130,129 -c /tmp/claimed 80000000000000aa vcan1 2>/dev/null &
daemon=$!
sleep 2
kill -TERM "$daemon"
wait "$daemon"
cangen vcan1 -g 1 -n 2000 -I 18EEFF82 -e -L 8 -D FFFFFFFFFFFFFFFF
sleep 0.3
cansend vcan1 18EAFFF9#00EE00
sleep 0.3
cansend vcan1 18EEFF82#0400000000FF0030
sleep 1
ecu_stop

mkdir /full
mount -t tmpfs -o size=8k tmpfs /full || fail 'no small disk'
dd if=/dev/zero of=/full/rest bs=4096 count=2 2>/dev/null
ecu_start vcan0 excavator_22t.toml --stats "$OUT/stats_full" --store /full/store
sleep 2
ecu_stop
