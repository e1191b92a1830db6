// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {frame_bits} from '../src/model/bus_load';
import {EXTENDED, REMOTE} from '../src/model/frame_block';
import {Series} from '../src/model/series';
import {line, random, store_of} from './make';

const binary = (value: number, width: number): string => value.toString(2).padStart(width, '0');

/// A frame bit by bit, as ISO 11898-1 has it.
function naive_bits(id: number, extended: boolean, remote: boolean, data: number[]): number {
  let bits = extended
    ? `0${binary(id >>> 18, 11)}11${binary(id & 0x3ffff, 18)}${remote ? 1 : 0}00`
    : `0${binary(id, 11)}${remote ? 1 : 0}00`;
  bits += binary(data.length, 4);
  bits += remote ? '' : data.map((byte) => binary(byte, 8)).join('');
  let crc = 0;
  for (const bit of bits) {
    const top = (crc >> 14) & 1;
    crc = (crc << 1) & 0x7fff;
    crc ^= top !== Number(bit) ? 0x4599 : 0;
  }
  bits += binary(crc, 15);
  let stuffed = '';
  for (const bit of bits) {
    stuffed += bit;
    if (/(00000|11111)$/.test(stuffed)) {
      stuffed += bit === '0' ? '1' : '0';
    }
  }
  return stuffed.length + 1 + 2 + 7 + 3;
}

test('a frame takes the bits that it takes on the wire', () => {
  const next = random(21);
  for (let i = 0; i < 3000; ++i) {
    const extended = next() < 0.7;
    const remote = next() < 0.1;
    const id = Math.floor(next() * (extended ? 2 ** 29 : 2 ** 11)) & (next() < 0.3 ? 0x70f : -1);
    const length = Math.floor(9 * next());
    const plain = next();
    const data = Array.from({length}, () =>
      plain < 0.3 ? 0 : plain < 0.6 ? 255 : Math.floor(256 * next()));
    const key = id + (extended ? EXTENDED : 0) + (remote ? REMOTE : 0);
    const bits = frame_bits(new Series(key, length), Uint8Array.from([9, ...data, 0, 0]), 1);
    assert.equal(bits, naive_bits(id, extended, remote, data), `${id} ${extended} ${data}`);
  }
});

test('the largest frame is within the bound that buses are planned with', () => {
  const zeros = frame_bits(new Series(EXTENDED, 8), new Uint8Array(8), 0);
  assert.ok(zeros > 131 && zeros <= 160);
});

test('the load is that of the second before, foreign frames and short ones too', () => {
  let text = '';
  let bits = 0;
  for (let i = 0; i < 300; ++i) {
    const data = [i & 255, 7, 7];
    text += line(10 + 0.01 * i, 0x18ff1234, data);
    bits += i > 100 && i <= 200 ? naive_bits(0x18ff1234, true, false, data) : 0;
  }
  const store = store_of(text);
  assert.equal(store.bus_load(12, 500000), bits / 500000);
  assert.equal(store.bus_load(5, 500000), 0);
});
