# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# The scenario as a service: the same as init.sh does around it.

limit_s=
# shellcheck disable=SC1091
. /hil/settings
OUT=/run/out
HIL_WHERE=vm
export OUT HIL_WHERE
mkdir -p "$OUT"
cd /hil || exit 1
up() { cut -d ' ' -f 1 /proc/uptime; }
echo "graben-hil: begin, up for $(up) s"
timeout --signal=KILL "$limit_s" sh ./scenario </dev/null
status=$?
verdict="exit $status"
[ "$status" -ne 137 ] || verdict=timeout
echo "graben-hil: end, $verdict, up for $(up) s"
if mount -t 9p -o trans=virtio,version=9p2000.L,msize=512000 share /mnt/share; then
  cp -r "$OUT/." /mnt/share || verdict='results lost'
  echo "$verdict" >/mnt/share/guest-status
  umount /mnt/share
fi
/hil/busybox poweroff -f
