// SPDX-License-Identifier: Apache-2.0
/// Bytes of candump's lines: digits, blanks, a line's end.

export const NEW_LINE = 10;
export const RETURN = 13;
export const SPACE = 32;
const DLC_MARK = 95;

/// Values of hexadecimal digits; -1 for all else, so that an or of several shows one that is none.
export const HEX = new Int8Array(256).fill(-1);
for (let digit = 0; digit < 16; ++digit) {
  HEX[digit.toString(16).charCodeAt(0)] = digit;
  HEX[digit.toString(16).toUpperCase().charCodeAt(0)] = digit;
}
/// The same of decimal digits.
export const DECIMAL = HEX.map((digit) => digit > 9 ? -1 : digit);

export function after_blanks(text: Uint8Array, from: number): number {
  let at = from;
  while (text[at] === SPACE) {
    ++at;
  }
  return at;
}

/// Below 0 where one of them is none.
export function five_digits(text: Uint8Array, at: number): number {
  const a = DECIMAL[text[at]];
  const b = DECIMAL[text[at + 1]];
  const c = DECIMAL[text[at + 2]];
  const d = DECIMAL[text[at + 3]];
  const e = DECIMAL[text[at + 4]];
  return (a | b | c | d | e) < 0 ? -1 : (((a * 10 + b) * 10 + c) * 10 + d) * 10 + e;
}

/// Below 0 where one of them is none.
export const four_hex = (text: Uint8Array, at: number): number =>
  (HEX[text[at]] << 12) | (HEX[text[at + 1]] << 8) | (HEX[text[at + 2]] << 4) | HEX[text[at + 3]];

/// Where the next line begins, with nothing left of this one but what candump may write after a
/// frame: the DLC of a frame of eight bytes, and letters that say which way it went. Else 0.
export function line_end(text: Uint8Array, from: number, length: number): number {
  let at = from;
  if (text[at] === NEW_LINE) {
    return at + 1;
  }
  if (text[at] === DLC_MARK && length === 8 && HEX[text[at + 1]] > 8) {
    at += 2;
  }
  if (text[at] === SPACE) {
    while (text[at] === SPACE || (text[at] >= 65 && text[at] <= 90)) {
      ++at;
    }
  }
  if (text[at] === RETURN) {
    ++at;
  }
  return text[at] === NEW_LINE ? at + 1 : 0;
}
