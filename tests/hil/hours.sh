# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The deployed process beside the simulated machine for hours, on vcan0, with its store, while a workshop's tool asks and
# another station claims its address. Nothing is recorded: a log would fill the guest. hours.py judges what this leaves.
. ./hil.sh
. ./ecu.sh

read -r seconds <seconds
# look NAME: memory, threads and open files of the process, and the store's size.
look() {
  cat "/proc/$ecu/smaps_rollup" "/proc/$ecu/status" >"$OUT/$1" || fail 'no graben-ecu'
  set -- "$1" "/proc/$ecu/fd/"*
  echo "OpenFiles: $(($# - 1))" >>"$OUT/$1"
  echo "StoreFiles: $(find /store -type f | wc -l)" >>"$OUT/$1"
}

vcan_up vcan0
ecu_start vcan0 excavator_22t.toml --stats "$OUT/stats" --store /store --name 3000ff0000000005
graben plant --can vcan0 --profile excavator_22t.toml --operator dig --seconds "$seconds" --summary "$OUT/summary.json" &
plant=$!
sleep 20
look first
while kill -0 "$plant" 2>/dev/null; do
  for frame in 18EAFFF9#CAFE00 18EA82F9#CBFE00 18EAFFF9#B6FD00 18EA82F9#B7FD00 18EAFFF9#00EE00 18EEFF82#FFFFFFFFFFFFFF7F; do
    cansend vcan0 "$frame"
    sleep 1
  done
done
wait "$plant" || fail "the machine's process ended with $?"
look last
ecu_stop
