// SPDX-License-Identifier: Apache-2.0
/// How full the bus is: every bit that a frame takes on the wire, from start of frame to the space
/// between frames, and the stuff bits that its very content asks for, CRC included. Frames that no
/// log has are not counted: error frames, repetitions, and those of receivers that filter.

import {EXTENDED, REMOTE} from './frame_block';
import type {Series} from './series';

/// Without stuffing: CRC delimiter, acknowledge with its delimiter, end of frame, space.
const TAIL_BITS = 1 + 2 + 7 + 3;
const CRC_BITS = 15;
const CRC_POLYNOMIAL = 0x4599;

/// The CRC's steps a byte at a time.
const CRC_TABLE = new Uint16Array(256);
for (let byte = 0; byte < 256; ++byte) {
  let crc = byte << 7;
  for (let bit = 0; bit < 8; ++bit) {
    crc = (crc & 0x4000) !== 0 ? (crc << 1) ^ CRC_POLYNOMIAL : crc << 1;
  }
  CRC_TABLE[byte] = crc & 0x7fff;
}

/// How the stuffing stands: the last bit, and how many like it there were in a row (1 .. 5; a stuff
/// bit that was put counts as the first of its row), as `2 * row + bit`.
/// For each of these and each byte: the state after it, and in the upper bits how many were put.
const STUFF_TABLE = new Uint8Array(12 * 256);
for (let state = 2; state < 12; ++state) {
  for (let byte = 0; byte < 256; ++byte) {
    STUFF_TABLE[256 * state + byte] = stuff(state, byte, 8);
  }
}

/// `bits` of `value`, the highest first; the state after them and 16 times the stuff bits.
function stuff(state: number, value: number, bits: number): number {
  let [row, last, put] = [state >> 1, state & 1, 0];
  for (let i = bits - 1; i >= 0; --i) {
    const bit = (value >> i) & 1;
    row = bit === last ? row + 1 : 1;
    last = bit;
    if (row === 5) {
      ++put;
      last = 1 - bit;
      row = 1;
    }
  }
  return 16 * put + 2 * row + last;
}

/// A frame's head is the same for all frames of an id and a length.
interface Head {
  bits: number;  ///< Unstuffed, of the whole frame but its stuff bits.
  put: number;
  state: number;
  crc: number;
  data: number;  ///< Bytes of data on the wire.
}

const heads = new WeakMap<Series, Head>();

function head_of(series: Series): Head {
  let head = heads.get(series);
  if (head === undefined) {
    head = make_head(series.key, series.length);
    heads.set(series, head);
  }
  return head;
}

function make_head(key: number, length: number): Head {
  const remote = (key & REMOTE) !== 0 ? 1 : 0;
  const extended = key >= EXTENDED;
  // Start of frame; 11 bits; SRR, IDE, 18 bits, RTR, r1, r0 or RTR, IDE, r0; DLC.
  const text = extended
    ? `0${binary((key >>> 18) & 0x7ff, 11)}11${binary(key & 0x3ffff, 18)}${remote}00`
    : `0${binary(key & 0x7ff, 11)}${remote}00`;
  const bits = text + binary(length, 4);
  // Before the first bit there is no row that it could lengthen.
  let [state, put, crc] = [1, 0, 0];
  for (const letter of bits) {
    const bit = Number(letter);
    const next = stuff(state, bit, 1);
    state = next & 15;
    put += next >> 4;
    const flip = ((crc >> 14) & 1) !== bit;
    crc = ((crc << 1) & 0x7fff) ^ (flip ? CRC_POLYNOMIAL : 0);
  }
  const data = remote === 1 ? 0 : length;
  return {bits: bits.length + 8 * data + CRC_BITS + TAIL_BITS, put, state, crc, data};
}

const binary = (value: number, width: number): string => value.toString(2).padStart(width, '0');

/// Bits on the wire of the frame whose bytes begin at `at`.
export function frame_bits(series: Series, bytes: Uint8Array, at: number): number {
  const head = head_of(series);
  let {state, put, crc} = head;
  for (let i = 0; i < head.data; ++i) {
    const byte = bytes[at + i];
    const next = STUFF_TABLE[256 * state + byte];
    state = next & 15;
    put += next >> 4;
    crc = ((crc << 8) & 0x7fff) ^ CRC_TABLE[(crc >> 7) ^ byte];
  }
  return head.bits + put + (stuff(state, crc, CRC_BITS) >> 4);
}

/// Bits of all frames in the second before a time.
export function bits_in_second(all: Iterable<Series>, time_s: number): number {
  let bits = 0;
  for (const series of all) {
    const last = series.at(time_s);
    for (let row = series.at(time_s - 1) + 1; row <= last; ++row) {
      const {buffer, at} = series.bytes(row);
      bits += frame_bits(series, buffer, at);
    }
  }
  return bits;
}
