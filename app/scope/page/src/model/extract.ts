// SPDX-License-Identifier: Apache-2.0
/// Raw values out of a frame's bytes. What a signal's place asks for is decided once, so that a
/// curve over an hour of frames costs a shift and an or a frame.

import type {Vector2} from './api';

export type ByteOrder = 'Intel' | 'Motorola';

/// Where the bits of a signal are, as a DBC says it: the lowest bit for Intel order, the highest
/// for Motorola order, bit 0 being the lowest of byte 0 either way.
export interface Place {
  start_bit: number;
  width: number;  ///< 1 .. 53: more does not fit a number.
  order: ByteOrder;
  signed: boolean;
}

export type Extract = (bytes: Uint8Array, at: number) => number;

/// Offset of the byte where an unsigned Intel value of this many whole bytes begins; -1 if it is
/// none.
export function aligned_byte(place: Place, width: number): number {
  const fits = place.order === 'Intel' && !place.signed && place.width === width;
  return fits && place.start_bit % 8 === 0 ? place.start_bit / 8 : -1;
}

/// The function that reads the signal at `place`. Throws where the bits leave the 8 bytes.
export function compile(place: Place): Extract {
  const byte = place.start_bit >> 3;
  const shift = place.start_bit & 7;
  const parts = bit_parts(place);
  if (place.order === 'Intel' && !place.signed) {
    if (shift + place.width <= 8) {
      const mask = (1 << place.width) - 1;
      return (bytes, at) => (bytes[at + byte] >> shift) & mask;
    }
    if (shift === 0 && place.width === 16) {
      return (bytes, at) => bytes[at + byte] | (bytes[at + byte + 1] << 8);
    }
    if (shift === 0 && place.width === 32) {
      return (bytes, at) => (bytes[at + byte] | (bytes[at + byte + 1] << 8) |
        (bytes[at + byte + 2] << 16) | (bytes[at + byte + 3] << 24)) >>> 0;
    }
  }
  return general(parts, place);
}

interface Part {
  byte: number;
  shift: number;
  mask: number;
  weight: number;  ///< Of the part's lowest bit in the value.
}

function general(parts: readonly Part[], place: Place): Extract {
  const turn = 2 ** place.width;
  return (bytes, at) => {
    let raw = 0;
    for (const part of parts) {
      raw += ((bytes[at + part.byte] >> part.shift) & part.mask) * part.weight;
    }
    return place.signed && raw >= turn / 2 ? raw - turn : raw;
  };
}

/// The signal's bits byte by byte, lowest bits of the value first.
function bit_parts(place: Place): Part[] {
  if (!(place.width >= 1 && place.width <= 53)) {
    throw new RangeError(`a signal of ${place.width} bits; allowed: 1 .. 53`);
  }
  const parts: Part[] = [];
  let [byte, bit]: Vector2 = lowest_bit(place);
  for (let done = 0; done < place.width;) {
    const bits = Math.min(8 - bit, place.width - done);
    if (byte < 0 || byte > 7) {
      throw new RangeError(`bits of a signal at ${place.start_bit} lie outside the 8 bytes`);
    }
    parts.push({byte, shift: bit, mask: (1 << bits) - 1, weight: 2 ** done});
    done += bits;
    bit = 0;
    byte += place.order === 'Intel' ? 1 : -1;
  }
  return parts;
}

function lowest_bit(place: Place): [number, number] {
  if (place.order === 'Intel') {
    return [place.start_bit >> 3, place.start_bit & 7];
  }
  // Counted along the wire, where byte 0 comes first with its highest bit.
  const along = (place.start_bit & ~7) + 7 - (place.start_bit & 7) + place.width - 1;
  return [along >> 3, 7 - (along & 7)];
}
