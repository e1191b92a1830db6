// SPDX-License-Identifier: Apache-2.0
/// Frames on their way from the parser to the store: columns of times and bytes, an id each, so
/// that no frame is ever an object.

/// All frames of one id and length of a block, oldest first.
export interface Column {
  /// As SocketCAN has it: 29 or 11 bits, with EXTENDED and REMOTE.
  key: number;
  length: number;        ///< Data bytes of each frame, 0 .. 8.
  time_s: Float64Array;
  bytes: Uint8Array;     ///< 8 a frame; those beyond `length` are 0xFF.
}

/// A frame's line counts once: as one of a column's, or as one of these.
export interface ParseCount {
  lines: number;      ///< That were not empty.
  malformed: number;
  first_malformed: {line: number; text: string} | null;
  backwards: number;  ///< Stamps a little before the one before.
  /// CAN FD, CAN XL and error frames, ids beyond the number that is kept, stamps that fit no other.
  unheard: number;
  lost: number;       ///< Frames that the log itself says it lacks (DROPCOUNT).
  breaks: number;     ///< Gaps and steps of the clock.
  first_break: {line: number; by_s: number} | null;
}

export interface FrameBlock {
  columns: readonly Column[];
  count: ParseCount;  ///< Since the source was opened, not of this block alone.
  /// What came before is of another time or another run: forget it.
  restart: boolean;
}

export const EXTENDED = 0x80000000;
export const REMOTE = 0x40000000;
export const ERROR = 0x20000000;

/// Buffers that a block can be handed over with instead of copied.
export function buffers_of(block: FrameBlock): ArrayBuffer[] {
  const buffers = new Set<ArrayBuffer>();
  for (const {time_s, bytes} of block.columns) {
    buffers.add(time_s.buffer as ArrayBuffer);
    buffers.add(bytes.buffer as ArrayBuffer);
  }
  return [...buffers];
}
