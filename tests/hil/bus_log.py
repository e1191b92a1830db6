# SPDX-License-Identifier: Apache-2.0
"""What a candump log says, as far as the scenarios ask: commands, states, marks."""

import dataclasses
import pathlib
import re

FRAME = re.compile(r"^\((\d+\.\d+)\) (\S+) ([0-9A-F]+)#([0-9A-F]*)", re.MULTILINE)
SPOOL_COMMAND, ECU_STATUS, ECU_HEALTH, DM1 = "0CFF3082", "18FF3182", "18FF3682", "18FECA82"
SWING_COMMAND, PUMP_COMMAND = "0CFF3782", "0CFF5882"
SWING_STATE, BOOM_STROKE = "0CFF2A80", "0CFF2080"
VALVE_STATE, MARK = "0CFF2983", "7F0"
SILENT, READY, ARMED, ACTIVE, STOPPING, FAULT = range(6)
NEUTRAL_RAW = 32000
SPN_BASE = 520192


@dataclasses.dataclass
class Frame:
    time: float
    name: str
    data: bytes

    def bits(self, start: int, length: int) -> int:
        """As the DBC counts them, Intel byte order."""
        return int.from_bytes(self.data, "little") >> start & (1 << length) - 1

    # Of SpoolCommand.
    @property
    def neutral(self) -> bool:
        """Enable is off and every duty is 0."""
        return self.bits(12, 2) == 0 and all(self.bits(start, 16) == NEUTRAL_RAW
                                             for start in (16, 32, 48))

    # Of EcuStatus.
    @property
    def mode(self) -> int:
        return self.bits(0, 3)

    @property
    def fault(self) -> int:
        return self.bits(32, 8)


def frames(path: pathlib.Path) -> list[Frame]:
    """Every frame with whole bytes, in the order of the log."""
    return [Frame(float(time), name, bytes.fromhex(data))
            for time, _, name, data in FRAME.findall(path.read_text()) if len(data) % 2 == 0]
