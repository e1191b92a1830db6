#!/bin/busybox sh
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# The guest's first process: loads the modules, runs the scenario, brings its results out by the
# folder shared with the host, switches off. /hil/settings says how long the scenario may take.

/bin/busybox --install -s /bin
PATH=/usr/bin:/usr/sbin:/bin
export PATH
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
mount -t tmpfs tmp /tmp
mount -t tmpfs run /run
mkdir -p /tmp/out /mnt/share

# The file's name, then the module's parameters; the order is the dependencies'.
while read -r module parameters; do
  # shellcheck disable=SC2086
  insmod "/modules/$module" $parameters || echo "graben-hil: module $module failed"
done </modules/order

limit_s=
# shellcheck disable=SC1091
. /hil/settings
OUT=/tmp/out
HIL_WHERE=vm
export OUT HIL_WHERE
cd /hil || exit 1
echo "graben-hil: begin, up for $(cut -d ' ' -f 1 /proc/uptime) s"

# /usr/bin/sh is the host's: busybox's own would put its ip in front of the one that knows CAN.
/usr/bin/sh ./scenario </dev/null &
scenario=$!
(
  sleep "$limit_s"
  echo timeout >/run/verdict
  kill -KILL "$scenario"
) &
wait "$scenario"
status=$?
verdict="exit $status"
[ ! -e /run/verdict ] || verdict=$(cat /run/verdict)
echo "graben-hil: end, $verdict, up for $(cut -d ' ' -f 1 /proc/uptime) s"

# Only now: a share in use would bring the host's timing into the guest.
if mount -t 9p -o trans=virtio,version=9p2000.L,msize=512000 share /mnt/share; then
  cp -r /tmp/out/. /mnt/share || verdict='results lost'
  echo "$verdict" >/mnt/share/guest-status
  umount /mnt/share
fi
poweroff -f
