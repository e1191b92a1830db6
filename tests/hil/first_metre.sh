# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# A new operator's walk (app/operate/README.md): its own commands, as first_metre.py has taken them out of the page, and
# a hand that does what it says (first_metre.pad). first_metre.py judges the bus.
. ./hil.sh
. ./ecu.sh

# Where an installed tool finds the shipped profiles. The guest is this scenario's own.
[ "$HIL_WHERE" = vm ] || fail 'only in a machine of its own'
mkdir -p /usr/share/graben/machines && cp ./excavator_22t*.toml /usr/share/graben/machines || fail 'no profiles'
ip link set lo up || fail 'no loopback interface'
. ./walk_bus.sh || fail 'no bus'
record vcan0
. ./walk_design.sh || fail 'no design'
cp out/first_metre.toml "$OUT" || fail 'the page writes no out/first_metre.toml'
. ./walk_power_on.sh >"$OUT/power_on" 2>&1
wait_until 10 ecu_sends vcan0 || fail "no frame of the ECU: $(cat "$OUT/power_on")"
wait_until 10 grep -q 'http://127.0.0.1:8080/' "$OUT/power_on" || fail "no page: $(cat "$OUT/power_on")"
ecu=$(pidof graben-ecu) || fail "no graben-ecu: $(cat "$OUT/power_on")"
machine=$(pidof graben-bus) || fail "no machine: $(cat "$OUT/power_on")"
hil_gamepad vcan0 'First Pad' <first_metre.pad >"$OUT/pad" 2>&1 &
pad=$!
wait_until 10 grep -q make "$OUT/pad" || fail "no gamepad: $(cat "$OUT/pad")"
{ . ./walk_levers.sh; } >"$OUT/said" 2>"$OUT/station_errors" &
machine_keeps_time vcan0 "$machine"
wait_until 60 test -e finished || fail "the pad has stopped: $(cat "$OUT/pad")"
# Ctrl-C ends the station; the others live still.
station=$(pidof graben-bus | tr ' ' '\n' | grep -v "^$machine\$")
kill -INT "$station" || fail "no station: $(cat "$OUT/station_errors")"
wait_until 5 test ! -e "/proc/$station" || fail 'the station does not end'
kill -0 "$machine" || fail 'the machine has ended'
kill "$pad" 2>/dev/null
wait "$pad"
ecu_stop
exit 0
