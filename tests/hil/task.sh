# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The deployed process and the simulated machine, each a process of its own, at a task over vcan0.
. ./hil.sh
. ./ecu.sh

read -r operator profile seconds program options <task
vcan_up vcan0
record vcan0
ecu_start vcan0 "$profile" ${program:+--task "$program"} --stats "$OUT/stats"
# shellcheck disable=SC2086
graben plant --can vcan0 --profile "$profile" --operator "$operator" --seconds "$seconds" \
  ${program:+--task "$program"} $options --summary "$OUT/summary.json" || fail "the machine's process ended with $?"
ecu_stop
