# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC1091
# The scope on a bus of a real kernel: it hears all that candump hears, sends nothing, and sees the
# interface go and come back.
. ./hil.sh

sent() { cat /sys/class/net/vcan0/statistics/tx_packets; }
machine() {
  graben plant --can vcan0 --profile excavator_22t.toml --seconds 2 --summary "$OUT/summary.json" ||
    fail "the machine's process ended with $?"
}

ip link set lo up || fail 'no loopback interface'
vcan_up vcan0
graben scope --can vcan0 --port 8080 --profile excavator_22t.toml >"$OUT/said" 2>"$OUT/errors" &
scope=$!
wait_until 5 grep -q 'http://127.0.0.1:8080/' "$OUT/said" || fail "$(cat "$OUT/errors")"
wait_until 5 is_listened_to vcan0 || fail 'the scope does not listen'
# Never ends by itself; what comes is a page's.
{
  printf 'GET /frames HTTP/1.1\r\nHost: 127.0.0.1:8080\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n'
  printf 'Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: graben-scope\r\n'
  printf 'Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n'
  sleep 1000
} | nc 127.0.0.1 8080 >"$OUT/page" &
page=$!
wait_until 5 grep -q setup "$OUT/page" || fail 'the page gets no setup'
sleep 1
sent >"$OUT/sent_by_scope"

record vcan0
machine
cansend vcan0 123#
cansend vcan0 123#R
cansend vcan0 20000040#0000000000000000
sleep 0.5
cp "$OUT/vcan0.log" "$OUT/candump.log"
wc -c <"$OUT/page" >"$OUT/page_before_down"
ip link set vcan0 down
sleep 1
ip link set vcan0 up || fail 'vcan0 stays down'
sleep 2
machine
sleep 0.5
kill -TERM "$scope"
wait "$scope" || fail "the scope ended with $?: $(cat "$OUT/errors")"
# It ends with its server, as a rule.
kill "$page" 2>/dev/null || true
