// SPDX-License-Identifier: Apache-2.0
/// End-to-end protection as a receiver sees it (hal/link/e2e.hpp): the CRC of the data id and bytes 1 to
/// 7, and the counter. Looked at over one second, whenever and wherever it is asked for; what a
/// receiver remembers for longer (its synchronisation, frames too early for their sender) is left
/// out.

import type {FrameStore, Integrity, MessageDef, MessageState, Rows} from './api';

const POLYNOMIAL = 0x1d;
const COUNTERS = 15;  ///< 0 .. 14; 15 is invalid.
const LATE = 2;       ///< So many places behind, a frame is late, no jump.
const LOOK_BACK_S = 1;
/// Before the second, so that its first frame has one to be compared with.
const BEFORE = 3;
const STALE_CYCLES = 3;

const CRC_TABLE = new Uint8Array(256);
for (let byte = 0; byte < 256; ++byte) {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) {
    crc = (crc & 0x80) !== 0 ? (crc << 1) ^ POLYNOMIAL : crc << 1;
  }
  CRC_TABLE[byte] = crc;
}

/// What byte 0 of the 8 bytes at `at` has to be: the CRC over the data id, low byte first, then
/// bytes 1 to 7; initial value and final xor 0.
export function e2e_crc(data_id: number, bytes: Uint8Array, at: number): number {
  let crc = CRC_TABLE[CRC_TABLE[data_id & 0xff] ^ (data_id >> 8)];
  for (let i = 1; i < 8; ++i) {
    crc = CRC_TABLE[crc ^ bytes[at + i]];
  }
  return crc;
}

/// Judges the frames of one message in their order.
export class CounterWatch {
  private last = -1;  ///< Counter of the last good frame; -1: none yet.
  private last_crc = -1;

  constructor(private readonly data_id: number, private readonly max_delta: number) {}

  judge(bytes: Uint8Array, at: number): Integrity {
    const crc = bytes[at];
    if (e2e_crc(this.data_id, bytes, at) !== crc) {
      return 'crc';
    }
    const counter = bytes[at + 1] & 15;
    if (counter === COUNTERS) {
      return 'sequence';
    }
    const delta = this.last < 0 ? 1 : (counter + COUNTERS - this.last) % COUNTERS;
    if (delta === 0) {
      return crc === this.last_crc ? 'repeated' : 'sequence';
    }
    if (delta > this.max_delta && delta >= COUNTERS - LATE) {
      return 'sequence';
    }
    this.last = counter;
    this.last_crc = crc;
    return delta === 1 ? 'ok' : delta <= this.max_delta ? 'lost' : 'sequence';
  }
}

/// Older than this a message is stale, s; one that comes on demand never is.
export function stale_after_s(message: MessageDef | undefined): number {
  const cycle_ms = message?.cycle_ms ?? 0;
  return cycle_ms > 0 ? STALE_CYCLES * cycle_ms / 1000 : Infinity;
}

/// What never came is stale too.
export function is_stale(store: FrameStore, message: string, age_s: number): boolean {
  return age_s === Infinity || age_s > stale_after_s(store.database?.messages.get(message));
}

/// All messages of the database, in its order; none before the database is known.
export function messageStates(store: FrameStore, time_s: number): MessageState[] {
  const messages = store.database?.messages.values() ?? [];
  return Array.from(messages, (message) => message_state(store, message, time_s));
}

function message_state(store: FrameStore, message: MessageDef, time_s: number): MessageState {
  const rows = store.rows(message.name);
  const last = rows.at(time_s);
  const age_s = last < 0 ? Infinity : time_s - rows.time(last);
  const cycle_s = message.cycle_ms / 1000;
  const stale = last < 0 || age_s > stale_after_s(message);
  const first = rows.at(time_s - LOOK_BACK_S) + 1;
  // A log that begins within the second has no whole one.
  const span_s = Math.min(LOOK_BACK_S, Math.max(time_s - store.from_s, cycle_s));
  const state: MessageState = {
    message, age_s, stale, counter: -1, integrity: stale ? 'silent' : 'unprotected', wrong: 0,
    rate_hz: span_s > 0 ? (last - first + 1) / span_s : 0,
  };
  if (message.data_id > 0 && last >= 0) {
    const seen = protection(message, rows, first, last);
    state.counter = seen.counter;
    state.wrong = seen.wrong;
    state.integrity = stale ? 'silent' : seen.integrity;
  }
  return state;
}

function protection(message: MessageDef, rows: Rows, first: number, last: number):
    {counter: number; wrong: number; integrity: Integrity} {
  const watch = new CounterWatch(message.data_id, message.max_delta);
  let wrong = 0;
  let counter = -1;
  let integrity: Integrity = 'ok';
  for (let row = Math.max(0, Math.min(first, last) - BEFORE); row <= last; ++row) {
    const {buffer, at} = rows.bytes(row);
    integrity = watch.judge(buffer, at);
    counter = buffer[at + 1] & 15;
    wrong += row >= first && integrity !== 'ok' ? 1 : 0;
  }
  return {counter, wrong, integrity};
}
