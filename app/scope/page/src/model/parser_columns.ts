// SPDX-License-Identifier: Apache-2.0
/// Where the parser puts frames: a growing column for each id and length.

import type {Column} from './frame_block';

/// A bus has some dozens of ids; a file of noise must not fill the memory with columns.
const MOST_COLUMNS = 1024;
const SLOTS = 4096;
const FIRST_ROWS = 64;

/// A column that is filled: its arrays are longer than its rows.
export interface Filling {
  key: number;
  length: number;
  rows: number;
  time_s: Float64Array;
  bytes: Uint8Array;
}

/// Columns by key and length, in an open-addressed table of numbers.
export class ParserColumns {
  private readonly keys = new Int32Array(SLOTS);
  private readonly places = new Int16Array(SLOTS).fill(-1);
  private readonly columns: Filling[] = [];

  /// The column with room for one more row; null where there are too many.
  open(key: number, length: number): Filling | null {
    let slot = (Math.imul(key ^ (length << 25), 0x9e3779b1) >>> 20) & (SLOTS - 1);
    for (; this.places[slot] >= 0; slot = (slot + 1) & (SLOTS - 1)) {
      const column = this.columns[this.places[slot]];
      if (this.keys[slot] === (key | 0) && column.length === length) {
        if (column.rows === column.time_s.length) {
          grow(column);
        }
        return column;
      }
    }
    if (this.columns.length === MOST_COLUMNS) {
      return null;
    }
    const column: Filling = {
      key: key >>> 0, length, rows: 0,
      time_s: new Float64Array(FIRST_ROWS), bytes: new Uint8Array(8 * FIRST_ROWS),
    };
    this.keys[slot] = key | 0;
    this.places[slot] = this.columns.length;
    this.columns.push(column);
    return column;
  }

  forget_rows(): void {
    for (const column of this.columns) {
      column.rows = 0;
    }
  }

  /// What was filled since the last time, in one buffer without room to spare.
  take(): Column[] {
    const filled = this.columns.filter((column) => column.rows > 0);
    const rows = filled.reduce((sum, column) => sum + column.rows, 0);
    const buffer = new ArrayBuffer(16 * rows);
    let row = 0;
    const taken = filled.map((column): Column => {
      const time_s = new Float64Array(buffer, 8 * row, column.rows);
      const bytes = new Uint8Array(buffer, 8 * (rows + row), 8 * column.rows);
      time_s.set(column.time_s.subarray(0, column.rows));
      bytes.set(column.bytes.subarray(0, 8 * column.rows));
      row += column.rows;
      return {key: column.key, length: column.length, time_s, bytes};
    });
    this.forget_rows();
    return taken;
  }
}

function grow(column: Filling): void {
  const time_s = new Float64Array(2 * column.time_s.length);
  const bytes = new Uint8Array(2 * column.bytes.length);
  time_s.set(column.time_s);
  bytes.set(column.bytes);
  column.time_s = time_s;
  column.bytes = bytes;
}
