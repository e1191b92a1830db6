# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The package as an engineer meets it, on a Debian with systemd and two CAN controllers on one bus:
# installed, enabled, stalled, killed, stopped, removed. can0 is the ECU's, can1 the machine's.
# check_service.py reads what this leaves in $OUT; 7F0#NN frames mark what happens on the bus.
. ./hil.sh

LD_LIBRARY_PATH=/hil/lib
export LD_LIBRARY_PATH

unit=graben-ecu.service
mark() { cansend can1 "7F0#$1"; }
property() { systemctl show -P "$1" "$unit"; }
# note NAME: as the manager sees it
note() {
  systemctl show "$unit" -p ActiveState -p SubState -p Result -p ExecMainStatus -p NRestarts \
    -p UnitFileState -p LoadState >"$OUT/$1"
}
ecu_sends() { candump -T 50 -n 1 can1,0CFF3082:1FFFFFFF | grep -q 0CFF3082; }
is_active() { sleep 0.2 && systemctl -q is-active "$unit"; }
# Asked of the manager, whose answer costs the guest 50 ms.
restarts_are() { sleep 0.2 && [ "$(property NRestarts)" = "$1" ]; }
# Three bits of the second digit, whose fourth may be either.
mode_is() { tail -n 60 "$OUT/can1.log" | grep '18FF3182#' | tail -n 1 | grep -q "18FF3182#.[$1]"; }

dpkg -i graben-ecu.deb >"$OUT/dpkg" 2>&1 || fail "dpkg -i: $(cat "$OUT/dpkg")"
note installed
systemctl preset "$unit" >>"$OUT/dpkg" 2>&1
note preset

# A profile that is not there: told, and not tried again and again.
sed -i 's/^GRABEN_PROFILE=.*/GRABEN_PROFILE=nothing/' /etc/default/graben-ecu
systemctl start "$unit" 2>/dev/null && fail 'it starts without a profile'
sleep 1
note no_profile
sed -i 's/^GRABEN_PROFILE=.*/GRABEN_PROFILE=excavator_22t.toml/' /etc/default/graben-ecu

# The bus comes later than the service: it tries until it is there.
controller_up can1 500000
record can1
systemctl enable "$unit" 2>>"$OUT/dpkg"
systemctl start "$unit" 2>/dev/null && fail 'it starts without its interface'
sleep 0.6
note no_interface
udevadm trigger --subsystem-match=net --action=add
systemctl start systemd-networkd
wait_until 10 is_active || fail 'not active once the interface is there'
ip -details link show can0 >"$OUT/link"
note came
# What it sends, on its own side: the emulated controller that receives has room for four frames and a half, and a
# cycle has five, which come at once here.
record can0

systemctl restart "$unit"
wait_until 5 ecu_sends || fail 'no frames'
pid=$(property MainPID)
note running
chrt -p "$pid" >"$OUT/scheduler"
cat "/proc/$pid/status" >"$OUT/process"
# Nothing that the manager does for itself may look like a stall.
systemctl daemon-reload
sleep 1
note reloaded

mark 01
kill -STOP "$pid"
wait_until 5 restarts_are 1 || fail 'no restart after a stall'
wait_until 5 ecu_sends || fail 'no frames after a stall'
note stalled
mark 02
kill -KILL "$(property MainPID)"
wait_until 5 restarts_are 2 || fail 'no restart after a kill'
wait_until 5 ecu_sends || fail 'no frames after a kill'
note killed

# Stopped while it digs.
# Before what looks at it: a machine whose frames are late is stopped.
nice -n -15 ./graben-bus plant --can can1 --profile excavator_22t.toml --operator dig >"$OUT/plant" 2>&1 &
plant=$!
wait_until 15 mode_is 3B || fail 'it does not dig'
sleep 1
mark 03
systemctl stop "$unit"
mark 04
note stopped
kill -TERM "$plant"
wait "$plant" || fail "the machine's process ended with $?"

# A new version stops it and leaves it so: a person starts a machine.
systemctl start "$unit"
dpkg -i graben-ecu.deb >>"$OUT/dpkg" 2>&1 || fail "dpkg -i again: $(cat "$OUT/dpkg")"
note upgraded

systemctl start "$unit"
wait_until 5 ecu_sends || fail 'no frames after a stop'
mark 05
dpkg -r graben-ecu >>"$OUT/dpkg" 2>&1 || fail "dpkg -r: $(cat "$OUT/dpkg")"
mark 06
note removed
pidof graben-ecu >"$OUT/left"
ls /etc/systemd/system/multi-user.target.wants >>"$OUT/left"
sleep 0.1
mark 07
journalctl -b -o short-monotonic --no-pager >"$OUT/journal"
journalctl -b -p warning -o cat --no-pager >"$OUT/warnings"
