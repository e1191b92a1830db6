# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The deployed process starts, stores its faults, and ends, again and again, on a disk that outlives the guest, until
# the power goes. Once it has ended by itself, what its files say is acknowledged: it goes to the console.
# power_cuts.py cuts and judges.
. ./hil.sh
. ./ecu.sh

mkdir -p /mnt/disk
# The kernel writes nothing for a minute unless it is told to.
mount -t ext4 -o commit=60 /dev/vda /mnt/disk || fail 'no disk'
vcan_up vcan0
while :; do
  sleep 0.25
  echo tick
done &
while :; do
  : >"$OUT/ecu.err"
  ecu_start vcan0 excavator_22t.toml --store /mnt/disk/store --stats "$OUT/stats"
  echo "began: $(sed -n 1p "$OUT/ecu.err")"
  # Faults are stored from ten seconds on.
  sleep 13
  ecu_stop
  for file in /mnt/disk/store/*.[ab]; do
    echo "kept: $(basename "$file") $(head -c 24 "$file" | hexdump -v -e '1/1 "%02x"')"
  done
  echo "ended: $(sed -n 's/^# \(store_[a-z]* [0-9]*\)$/\1/p' "$OUT/stats" | tr '\n' ' ')"
done
