// SPDX-License-Identifier: Apache-2.0
/// Frames and random numbers for tests.

import {CandumpParser} from '../src/model/candump';
import {e2e_crc} from '../src/model/integrity';
import {PageStore} from '../src/model/store';

export const bytes_of = (text: string): Uint8Array => new TextEncoder().encode(text);

/// The same numbers in every run; 0 .. 1.
export function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

export const hex = (value: number, digits: number): string =>
  value.toString(16).toUpperCase().padStart(digits, '0');

/// A line of a log, as the project writes it; `id` 29 bits.
export function line(time_s: number, id: number, data: ArrayLike<number>): string {
  const micros = Math.round(time_s * 1e6);
  const stamp = `${String(Math.floor(micros / 1e6)).padStart(10, '0')}.` +
    String(micros % 1e6).padStart(6, '0');
  return `(${stamp}) vcan0 ${hex(id, 8)}#${Array.from(data, (byte) => hex(byte, 2)).join('')}\n`;
}

export function store_of(text: string | Uint8Array): PageStore {
  const parser = new CandumpParser();
  parser.feed(typeof text === 'string' ? bytes_of(text) : text);
  parser.end();
  const store = new PageStore();
  store.append(parser.take());
  return store;
}

/// Eight bytes with counter and CRC, a word at byte 2, the rest 0xFF.
export function protected_bytes(data_id: number, counter: number, word = 0): Uint8Array {
  const bytes = new Uint8Array(8).fill(0xff);
  bytes[1] = 0xf0 | counter;
  bytes[2] = word & 0xff;
  bytes[3] = word >> 8;
  bytes[0] = e2e_crc(data_id, bytes, 0);
  return bytes;
}
