#!/hil/busybox sh
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# The guest's first process where a whole Debian is the guest: loads the modules, hands over to that
# Debian's own systemd, which runs the scenario as a service (systemd.sh).

busybox=/hil/busybox
while read -r module parameters; do
  # shellcheck disable=SC2086
  $busybox insmod "/modules/$module" $parameters || echo "graben-hil: module $module failed"
done </modules/order

units=/etc/systemd/system
$busybox mkdir -p $units/multi-user.target.wants /mnt/share
$busybox cat >$units/hil.service <<'UNIT'
[Unit]
Description=The scenario
[Service]
Type=exec
ExecStart=/bin/sh /hil/systemd.sh
StandardOutput=tty
StandardError=tty
TTYPath=/dev/console
UNIT
$busybox ln -s ../hil.service $units/multi-user.target.wants/hil.service
# Nobody logs in, nothing is fetched or checked, no clock is set.
for unit in getty.target apt-daily.timer apt-daily-upgrade.timer dpkg-db-backup.timer e2scrub_all.timer \
  e2scrub_reap.service fstrim.timer systemd-timesyncd.service systemd-update-utmp.service \
  systemd-update-utmp-runlevel.service systemd-random-seed.service systemd-pstore.service \
  systemd-binfmt.service systemd-udev-trigger.service modprobe@.service; do
  $busybox ln -sf /dev/null $units/$unit
done
exec /lib/systemd/systemd
