// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {Can, Dbc} from 'candied';
import dozer_text from '@dbc/dozer.dbc?raw';
import excavator_text from '@dbc/excavator.dbc?raw';
import {loadDatabase} from '../src/model/dbc';
import {compile, type Place} from '../src/model/extract';
import {random} from './make';

const TEXTS = {excavator: excavator_text, dozer: dozer_text} as const;
const KINDS = ['excavator', 'dozer'] as const;

for (const kind of KINDS) {
  test(`every signal of ${kind}.dbc has the library's raw and physical value`, () => {
    const database = loadDatabase(kind);
    const content = new Dbc().load(TEXTS[kind]);
    const can = new Can();
    can.database = content;
    const next = random(7);
    let compared = 0;
    for (const message of content.messages.values()) {
      const def = database.by_id.get((message.id - 0x80000000) & 0x3ffffff);
      assert.ok(def, message.name);
      assert.equal(def.signals.size, message.signals.size);
      for (let i = 0; i < 2000; ++i) {
        const payload = Array.from({length: 8}, () => Math.floor(256 * next()));
        const bytes = Uint8Array.from([1, 2, 3, ...payload]);
        const frame = can.createFrame(message.id, payload, true);
        for (const [name, bound] of can.decode(frame)!.boundSignals) {
          const signal = def.signals.get(name)!;
          const raw = signal.raw(bytes, 3);
          assert.equal(raw, bound.rawValue, `${message.name}.${name}`);
          // The library holds values of a range to it; the state says that they are none.
          if (signal.state(raw) === 'valid') {
            assert.equal(raw * signal.factor + signal.offset, bound.value);
          }
          ++compared;
        }
      }
    }
    assert.ok(compared > 100000);
  });
}

test('what the DBC says beside the bits', () => {
  const excavator = loadDatabase('excavator');
  assert.equal(excavator.version, 13);
  assert.equal(loadDatabase('dozer').version, 11);
  const boom = excavator.messages.get('BoomStroke')!;
  assert.deepEqual([boom.id, boom.cycle_ms, boom.data_id, boom.max_delta, boom.sender],
    [0x0cff2080, 10, 65312, 3, 'Machine']);
  assert.equal(excavator.messages.get('EcuStatus')!.data_id, 0);
  const mode = excavator.signal('EcuStatus.Mode');
  assert.equal(mode.states.get(5), 'Fault');
  assert.match(excavator.signal('EcuStatus.Fault').description, /stopped the machine; else what/);
  assert.throws(() => excavator.signal('EcuStatus.Nothing'), /EcuStatus\.Nothing/);
});

test('special values as the controller takes them', () => {
  const stroke = loadDatabase('excavator').signal('BoomStroke.BoomStroke');
  assert.equal(stroke.state(64000), 'valid');
  assert.equal(stroke.state(64001), 'error');       // beyond 3200 mm, and no special value
  assert.equal(stroke.state(0xfe00), 'error');
  assert.equal(stroke.state(0xfeff), 'error');
  assert.equal(stroke.state(0xff00), 'notAvailable');
  assert.equal(stroke.state(0xffff), 'notAvailable');
  const mode = loadDatabase('excavator').signal('EcuStatus.Mode');
  assert.deepEqual([5, 6, 7].map((raw) => mode.state(raw)), ['valid', 'error', 'notAvailable']);
  const limit = loadDatabase('excavator').signal('EcuStatus.LimitKind');
  assert.deepEqual([14, 15, 29, 30, 31].map((raw) => limit.state(raw)),
    ['valid', 'error', 'error', 'error', 'notAvailable']);
  const lamp = loadDatabase('excavator').signal('DM1.RedStopLamp');
  assert.deepEqual([0, 1, 2, 3].map((raw) => lamp.state(raw)),
    ['valid', 'valid', 'error', 'notAvailable']);
});

/// Bit by bit, as the DBC format numbers them.
function naive(place: Place, bytes: Uint8Array, at: number): number {
  const bits: number[] = [];  // lowest first
  let position = place.start_bit;
  for (let i = 0; i < place.width; ++i) {
    bits.push((bytes[at + (position >> 3)] >> (position & 7)) & 1);
    if (place.order === 'Intel') {
      ++position;
    } else {
      position += (position & 7) === 0 ? 15 : -1;
    }
  }
  const value = (place.order === 'Intel' ? bits : bits.reverse())
    .reduce((sum, bit, i) => sum + bit * 2 ** i, 0);
  return place.signed && value >= 2 ** (place.width - 1) ? value - 2 ** place.width : value;
}

test('both byte orders, signed and not, at every place', () => {
  const next = random(11);
  let places = 0;
  for (let i = 0; i < 4000; ++i) {
    const order = next() < 0.5 ? 'Intel' : 'Motorola';
    const place: Place = {
      order, start_bit: Math.floor(64 * next()), width: 1 + Math.floor(53 * next()),
      signed: next() < 0.5,
    };
    const {start_bit, width} = place;
    const left = order === 'Intel' ? 64 - start_bit
      : 64 - 8 * (start_bit >> 3) - (7 - (start_bit & 7));
    if (width > left) {
      assert.throws(() => compile(place), RangeError);
      continue;
    }
    const raw = compile(place);
    const bytes = Uint8Array.from({length: 11}, () => Math.floor(256 * next()));
    assert.equal(raw(bytes, 3), naive(place, bytes, 3), JSON.stringify(place));
    ++places;
  }
  assert.ok(places > 1000);
  assert.throws(() => compile({order: 'Intel', start_bit: 0, width: 60, signed: false}), /53/);
});

test('the page reads the very files that the codecs are made from', () => {
  const folder = process.env.GRABEN_DBC;
  if (folder !== undefined) {
    assert.equal(excavator_text, readFileSync(`${folder}/excavator.dbc`, 'utf8'));
  }
  assert.match(excavator_text, /^VERSION/);
});
