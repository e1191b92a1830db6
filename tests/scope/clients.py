#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What eight pages cost the server at the full rate of a simulated machine: its share of one core at the
pace of real time, the simulation itself in it. Fails above the bound, or if a page misses a frame; how
fast it all goes is the machine's, so that a tenth of real time will do."""

import argparse
import os
import re
import selectors
import signal
import subprocess
import sys
import time

from web_socket import BINARY, TEXT, WebSocket

CLIENTS = 8
LEAST_FRAMES_PS = 1000
LEAST_PACE = 0.1
ENDED_S = 10.0  # It has no page to wait for.


def cpu_s(pid: int) -> float:
    with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def start(graben: str) -> tuple[subprocess.Popen, int]:
    server = subprocess.Popen([graben, "scope", "--sim", "dig", "--port", "0"],
                              stdout=subprocess.PIPE, text=True)
    line = server.stdout.readline()
    match = re.fullmatch(r"graben scope: http://127\.0\.0\.1:(\d+)/ \(.*\)\n", line)
    if not match:
        server.kill()
        sys.exit(f"clients.py: no address in {line!r}")
    return server, int(match[1])


class Page:
    """What one of them got."""

    def __init__(self, port: int):
        self.socket = WebSocket("127.0.0.1", port)
        self.frames = 0
        self.dropped = 0
        self.until_s = 0.0
        self.kinds: set[str] = set()

    def read(self) -> None:
        for opcode, content in self.socket.take():
            if opcode == BINARY:
                self.frames += content.count(b"\n")
                # Simulated time, as the last line has it.
                self.until_s = float(content[content.rindex(b"(") + 1:content.rindex(b")")])
            elif opcode == TEXT:
                self.kinds.add(content["kind"])
                if content["kind"] == "dropped":
                    self.dropped = content["frames"]


def read_for(pages: list[Page], seconds: float) -> None:
    with selectors.DefaultSelector() as selector:
        for page in pages:
            selector.register(page.socket, selectors.EVENT_READ, page)
        until = time.monotonic() + seconds
        while (left := until - time.monotonic()) > 0:
            for key, _ in selector.select(left):
                key.data.read()


def share(pid: int, pages: list[Page], seconds: float) -> float:
    cpu, began = cpu_s(pid), time.monotonic()
    read_for(pages, seconds)
    return (cpu_s(pid) - cpu) / (time.monotonic() - began)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("graben")
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--most", type=float, default=0.10, help="share of one core")
    options = parser.parse_args()
    server, port = start(options.graben)
    try:
        alone = share(server.pid, [], min(options.seconds, 3.0))
        pages = [Page(port) for _ in range(CLIENTS)]
        read_for(pages, 1.0)
        before = [(page.frames, page.until_s) for page in pages]
        taken = share(server.pid, pages, options.seconds)
        frames = [page.frames - b for page, (b, _) in zip(pages, before)]
        simulated_s = [page.until_s - b for page, (_, b) in zip(pages, before)]
    finally:
        server.send_signal(signal.SIGINT)
        began = time.monotonic()
        try:
            status = server.wait(ENDED_S)
        except subprocess.TimeoutExpired:
            server.kill()
            status = None
        ended = time.monotonic() - began
    rate = min(frames) / options.seconds
    pace = min(simulated_s) / options.seconds
    taken /= pace
    print(f"{CLIENTS} pages at {rate:.0f} frames/s, {pace:.2f} of real time: {100 * taken:.1f} % of one "
          f"core, {100 * alone:.1f} % without them; ended in {1000 * ended:.0f} ms")
    problems = []
    if taken > options.most:
        problems.append(f"{100 * taken:.1f} % of one core; at most {100 * options.most:.0f} %")
    if rate < LEAST_FRAMES_PS * pace or pace < LEAST_PACE:
        problems.append(f"{rate:.0f} frames/s at {pace:.2f} of real time; the simulation makes "
                        f"{LEAST_FRAMES_PS} and more a second, and keeps {LEAST_PACE} of real time")
    problems += [f"page {i} missed {page.dropped} frames"
                 for i, page in enumerate(pages) if page.dropped]
    problems += [f"page {i} got {page.kinds}"
                 for i, page in enumerate(pages) if not {"setup", "sim"} <= page.kinds]
    if status != 0:
        problems.append(f"ended with {status} after {ended:.1f} s")
    sys.exit("\n".join(problems) or 0)


if __name__ == "__main__":
    main()
