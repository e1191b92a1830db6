# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The same with the kernel's real driver: the ECU on one SJA1000 controller, the machine on another.
. ./hil.sh
. ./ecu.sh

read -r operator profile seconds program <task
controller_up can0 500000
controller_up can1 500000
record can0
ecu_start can0 "$profile" ${program:+--task "$program"} --stats "$OUT/stats"
graben plant --can can1 --profile "$profile" --operator "$operator" --seconds "$seconds" \
  ${program:+--task "$program"} --summary "$OUT/summary.json" || fail "the machine's process ended with $?"
ecu_stop
