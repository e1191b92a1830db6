# SPDX-License-Identifier: Apache-2.0
"""The scope on a real CAN kernel: scope.py OUT GRABEN. What its page got beside what candump wrote."""

import json
import pathlib
import sys

import run_programs

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scope"))
import web_socket  # noqa: E402  pylint: disable=wrong-import-position

LEAST_FRAMES = 1000


def messages(data: bytes) -> tuple[list[dict], list[str]]:
    """JSON messages and candump lines of a page's connection, its handshake first."""
    answer, _, rest = data.partition(b"\r\n\r\n")
    assert answer.startswith(b"HTTP/1.1 101 "), answer[:80]
    received, told, lines = bytearray(rest), [], []
    while (message := web_socket.whole_message(received)) is not None:
        opcode, content = message
        if opcode == web_socket.TEXT:
            told.append(json.loads(content))
        elif opcode == web_socket.BINARY:
            lines += content.decode("ascii").splitlines()
    return told, lines


def check(out: pathlib.Path) -> list[str]:
    data = (out / "page").read_bytes()
    told, lines = messages(data)
    _, before = messages(data[:int((out / "page_before_down").read_text())])
    candump = (out / "candump.log").read_text().splitlines()
    problems = []
    if (out / "sent_by_scope").read_text().strip() != "0":
        problems.append("the scope has sent frames")
    if told[0]["kind"] != "setup" or told[0]["source"]["mode"] != "can":
        problems.append(f"the first message is {told[0]['kind']}")
    if len(candump) < LEAST_FRAMES or before != candump:
        differs = [pair for pair in zip(before, candump) if pair[0] != pair[1]][:1]
        problems.append(f"{len(before)} frames at the page, {len(candump)} in candump's log; {differs}")
    after = len(lines) - len(before)
    if after < LEAST_FRAMES:
        problems.append(f"{after} frames after the interface came back")
    states = [message["up"] for message in told if message["kind"] == "bus"]
    if states[-2:] != [False, True]:
        problems.append(f"the bus was told to be up: {states}")
    if lost := [message for message in told if message["kind"] == "dropped"]:
        problems.append(f"a page that reads has lost frames: {lost[-1]}")
    print(f"scope: {len(before)} frames as candump has them, {after} after the interface came back")
    return problems


if __name__ == "__main__":
    sys.exit(run_programs.main("scope.sh", check, timeout_s=60.0))
