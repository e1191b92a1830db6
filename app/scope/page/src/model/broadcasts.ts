// SPDX-License-Identifier: Apache-2.0
/// DM1 of several trouble codes, which a controller sends as one broadcast (BAM of J1939-21): each
/// code as a DM1 of its own, at the time of the last packet, among those that came so.

import {identity_of} from './dbc';
import {EXTENDED, type Column} from './frame_block';
import {Series} from './series';

const DM1 = 0x18feca82;
const ANNOUNCE = 0x1cecff82;
const PACKET = 0x1cebff82;
const DM1_PGN = 0xfeca;
const BROADCAST = 32;
const PACKET_BYTES = 7;
/// Lamps and 17 codes.
const MOST_BYTES = 70;
/// A packet that is later ends its message.
const LATE_S = 0.75;

const is = (key: number, id: number): boolean => key >= EXTENDED && identity_of(key - EXTENDED) === identity_of(id);
export const is_dm1 = (id: number): boolean => identity_of(id) === identity_of(DM1);
export const is_transport = (key: number): boolean => is(key, ANNOUNCE) || is(key, PACKET);

interface Row { time_s: number; bytes: Uint8Array; packet: boolean }

function rows_of(column: Column, packet: boolean): Row[] {
  return Array.from(column.time_s, (time_s, row) =>
    ({time_s, bytes: column.bytes.subarray(8 * row, 8 * row + 8), packet}));
}

export class Broadcasts {
  /// All DM1, single ones and those of broadcasts.
  all = new Series(DM1 + EXTENDED, 8);
  any = false;  ///< A broadcast has come.
  private size = 0;
  private next = 0;  ///< Packet that has to come; 0: none is under way.
  private heard_s = 0;
  private readonly bytes = new Uint8Array(MOST_BYTES + PACKET_BYTES);

  /// A block's columns; those before were older.
  take(columns: readonly Column[]): void {
    const said: Row[] = [];
    const sent: Row[] = [];
    for (const column of columns) {
      if (column.length !== 8) {
        continue;
      }
      if (is(column.key, DM1)) {
        said.push(...rows_of(column, false));
      } else if (is_transport(column.key)) {
        sent.push(...rows_of(column, is(column.key, PACKET)));
      }
    }
    if (said.length + sent.length === 0) {
      return;
    }
    // Of one time the announcement comes first.
    sent.sort((a, b) => a.time_s - b.time_s || Number(a.packet) - Number(b.packet));
    for (const row of sent) {
      this.hear(row, said);
    }
    said.sort((a, b) => a.time_s - b.time_s);
    const bytes = new Uint8Array(8 * said.length);
    said.forEach((row, k) => bytes.set(row.bytes, 8 * k));
    if (said.length > 0) {
      this.all.append(Float64Array.from(said, ({time_s}) => time_s), bytes);
    }
  }

  clear(): void {
    this.all = new Series(DM1 + EXTENDED, 8);
    this.any = false;
    this.next = 0;
  }

  private hear({time_s, bytes, packet}: Row, said: Row[]): void {
    if (!packet) {
      this.size = bytes[1]! + 256 * bytes[2]!;
      const fits = bytes[0] === BROADCAST && bytes[5]! + 256 * bytes[6]! + 65536 * bytes[7]! === DM1_PGN
        && this.size > 8 && this.size <= MOST_BYTES && bytes[3] === Math.ceil(this.size / PACKET_BYTES);
      this.next = fits ? 1 : 0;
      this.heard_s = time_s;
      return;
    }
    if (this.next === 0 || bytes[0] !== this.next || time_s - this.heard_s > LATE_S) {
      this.next = 0;
      return;
    }
    this.bytes.set(bytes.subarray(1), PACKET_BYTES * (this.next - 1));
    this.heard_s = time_s;
    if (PACKET_BYTES * this.next++ < this.size) {
      return;
    }
    this.next = 0;
    this.any = true;
    for (let at = 2; at + 4 <= this.size; at += 4) {
      const code = this.bytes.subarray(at, at + 4);
      said.push({time_s, packet: false,
        bytes: Uint8Array.of(this.bytes[0]!, this.bytes[1]!, ...code, 0xff, 0xff)});
    }
  }
}
