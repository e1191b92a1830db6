# shellcheck shell=sh disable=SC1091
# The deployed process and the simulated machine, each a process of its own, dig over vcan0.
. ./hil.sh
. ./ecu.sh

vcan_up vcan0
record vcan0
ecu_start vcan0 --stats "$OUT/stats"
graben plant --can vcan0 --profile excavator_22t.toml --operator dig --seconds "$(cat seconds)" \
  --summary "$OUT/summary.json" || fail "the machine's process ended with $?"
ecu_stop
