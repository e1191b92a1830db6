# SPDX-License-Identifier: Apache-2.0
"""A WebSocket client of the scope's, as small as it can be: it asks, and reads."""

import base64
import json
import os
import socket
import struct

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class WebSocket:
    """One connection. `take()` gives what has come; nothing waits but the handshake."""

    def __init__(self, host: str, port: int):
        self._socket = socket.create_connection((host, port), timeout=120)
        self._received = bytearray()
        key = base64.b64encode(os.urandom(16)).decode()
        self._socket.sendall((
            f"GET /frames HTTP/1.1\r\nHost: {host}:{port}\r\nConnection: Upgrade\r\n"
            f"Upgrade: websocket\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Protocol: graben-scope\r\n\r\n").encode())
        while b"\r\n\r\n" not in self._received:
            more = self._socket.recv(4096)
            if not more:
                raise ConnectionError(f"no answer but {bytes(self._received)!r}")
            self._received += more
        answer, _, rest = bytes(self._received).partition(b"\r\n\r\n")
        if not answer.startswith(b"HTTP/1.1 101 "):
            raise ConnectionError(answer.split(b"\r\n")[0].decode())
        self._received = bytearray(rest)
        self._socket.setblocking(False)

    def block(self, seconds: float) -> None:
        """From now on take() waits for something, so long at most."""
        self._socket.settimeout(seconds)

    def fileno(self) -> int:
        return self._socket.fileno()

    def close(self) -> None:
        self._socket.close()

    def send(self, opcode: int, content: bytes) -> None:
        """A frame of less than 126 bytes, masked with nothing."""
        self._socket.sendall(struct.pack("BB4x", 0x80 | opcode, 0x80 | len(content)) + content)

    def take(self):
        """(opcode, content) of each whole message; to be called when there is something to read."""
        data = self._socket.recv(1 << 20)
        if not data:
            raise ConnectionError("the server hung up")
        self._received += data
        while (message := whole_message(self._received)) is not None:
            opcode, content = message
            if opcode == PING:
                self.send(PONG, content)
            elif opcode == CLOSE:
                raise ConnectionError(f"the server closed: {content!r}")
            else:
                yield opcode, json.loads(content) if opcode == TEXT else content


def whole_message(received: bytearray) -> tuple[int, bytes] | None:
    """Takes the first whole message of a server's bytes; None if there is none yet."""
    if len(received) < 2:
        return None
    size, header = received[1], 2
    if size >= 126:
        header = 4 if size == 126 else 10
        if len(received) < header:
            return None
        size = int.from_bytes(received[2:header], "big")
    if len(received) < header + size:
        return None
    content = bytes(received[header:header + size])
    opcode = received[0] & 15
    del received[:header + size]
    return opcode, content
