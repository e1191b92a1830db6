// SPDX-License-Identifier: Apache-2.0
/// All frames of one id, oldest first, in pieces: what has come is never copied again, but for the
/// small pieces of a live bus, which are gathered.

import type {Rows} from './api';

/// A block's column of at least this many rows is taken over as it is.
const OWN_PIECE_ROWS = 1024;
const FIRST_ROWS = 64;
const FULL_ROWS = 4096;

export interface Piece {
  time_s: Float64Array;
  bytes: Uint8Array;
  rows: number;   ///< Of them used.
  start: number;  ///< Index of the first one among those that are kept.
}

export class Series implements Rows {
  readonly pieces: Piece[] = [];
  count = 0;
  seen = 0;  ///< Since the beginning, kept or not.
  private last_found = 0;

  constructor(readonly key: number, readonly length: number) {}

  append(time_s: Float64Array, bytes: Uint8Array): void {
    const rows = time_s.length;
    if (rows >= OWN_PIECE_ROWS) {
      this.pieces.push({time_s, bytes, rows, start: this.count});
    } else {
      this.gather(time_s, bytes);
    }
    this.count += rows;
    this.seen += rows;
  }

  /// Forgets whole pieces that lie before, never the last one: what a message said last stays.
  drop_before(time_s: number): void {
    let dropped = 0;
    const old = (piece: Piece): boolean => piece.time_s[piece.rows - 1] < time_s;
    while (dropped + 1 < this.pieces.length && old(this.pieces[dropped])) {
      ++dropped;
    }
    if (dropped > 0) {
      const shift = this.pieces[dropped].start;
      this.pieces.splice(0, dropped);
      for (const piece of this.pieces) {
        piece.start -= shift;
      }
      this.count -= shift;
      this.last_found = 0;
    }
  }

  time(index: number): number {
    const piece = this.piece_of(index);
    return piece.time_s[index - piece.start];
  }

  bytes(index: number): {buffer: Uint8Array; at: number} {
    const piece = this.piece_of(index);
    return {buffer: piece.bytes, at: 8 * (index - piece.start)};
  }

  at(time_s: number): number {
    let low = 0;
    let high = this.pieces.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.pieces[middle].time_s[0] <= time_s) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low === 0 ? -1 : this.pieces[low - 1].start + last_at(this.pieces[low - 1], time_s);
  }

  private piece_of(index: number): Piece {
    if (!(index >= 0 && index < this.count)) {
      throw new RangeError(`row ${index} of ${this.count}`);
    }
    const known = this.pieces[this.last_found];
    if (index >= known.start && index < known.start + known.rows) {
      return known;
    }
    let low = 0;
    let high = this.pieces.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.pieces[middle].start <= index) {
        low = middle;
      } else {
        high = middle - 1;
      }
    }
    this.last_found = low;
    return this.pieces[low];
  }

  private gather(time_s: Float64Array, bytes: Uint8Array): void {
    const rows = time_s.length;
    let last = this.pieces[this.pieces.length - 1];
    if (last === undefined || last.rows + rows > FULL_ROWS) {
      const room = Math.max(FIRST_ROWS, rows);
      last = {time_s: new Float64Array(room), bytes: new Uint8Array(8 * room), rows: 0,
        start: this.count};
      this.pieces.push(last);
    }
    if (last.rows + rows > last.time_s.length) {
      const room = Math.min(FULL_ROWS, Math.max(last.rows + rows, 2 * last.time_s.length));
      const [old_time_s, old_bytes] = [last.time_s, last.bytes];
      last.time_s = new Float64Array(room);
      last.time_s.set(old_time_s.subarray(0, last.rows));
      last.bytes = new Uint8Array(8 * room);
      last.bytes.set(old_bytes.subarray(0, 8 * last.rows));
    }
    last.time_s.set(time_s, last.rows);
    last.bytes.set(bytes, 8 * last.rows);
    last.rows += rows;
  }
}

/// Row of the last frame at or before a time that is not before the piece.
function last_at(piece: Piece, time_s: number): number {
  let low = 0;
  let high = piece.rows - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (piece.time_s[middle] <= time_s) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}
