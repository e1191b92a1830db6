# shellcheck shell=sh disable=SC1091
# The same with the kernel's real driver: the ECU on one SJA1000 controller, the machine on another.
. ./hil.sh
. ./ecu.sh

read -r task profile seconds <task
controller_up can0 500000
controller_up can1 500000
record can0
ecu_start can0 "$profile" --stats "$OUT/stats"
graben plant --can can1 --profile "$profile" --operator "$task" --seconds "$seconds" \
  --summary "$OUT/summary.json" || fail "the machine's process ended with $?"
ecu_stop
