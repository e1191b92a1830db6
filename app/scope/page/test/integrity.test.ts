// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {Integrity, MessageState} from '../src/model/api';
import {loadDatabase} from '../src/model/dbc';
import {CounterWatch, e2e_crc, messageStates} from '../src/model/integrity';
import type {PageStore} from '../src/model/store';
import {line, protected_bytes, store_of} from './make';
import {graben_log} from './tool';

test('the CRC of the published vectors', () => {
  const crc = (counter: number): number =>
    e2e_crc(0x123, Uint8Array.from([0, counter, 0, 0, 0, 0, 0, 0]), 0);
  assert.equal(crc(0), 0xcc);
  assert.equal(crc(1), 0x91);
});

test('a log of the controller is right in every frame of every message', () => {
  const store = store_of(graben_log('dig', '--loops', '0.3'));
  assert.ok(store.until_s > 3);
  let guarded = 0;
  for (const message of store.database!.messages.values()) {
    const rows = store.rows(message.name);
    if (message.data_id === 0 || rows.count === 0) {
      continue;
    }
    const watch = new CounterWatch(message.data_id, message.max_delta);
    for (let row = 0; row < rows.count; ++row) {
      const {buffer, at} = rows.bytes(row);
      assert.equal(watch.judge(buffer, at), 'ok', `${message.name}, frame ${row}`);
    }
    guarded += rows.count;
  }
  assert.ok(guarded > 3000);
  for (const state of messageStates(store, store.until_s)) {
    const of_other_tasks = /^(Swing|Second|OperatorAxes|Commission|TouchedPoint|ExternalLimit)/;
    const expected = of_other_tasks.test(state.message.name)
      ? 'silent' : state.message.data_id > 0 ? 'ok' : 'unprotected';
    assert.equal(state.integrity, expected, state.message.name);
    assert.equal(state.wrong, 0);
    if (expected === 'ok') {
      const hertz = 1000 / state.message.cycle_ms;
      assert.ok(Math.abs(state.rate_hz - hertz) <= 1, `${state.message.name} ${state.rate_hz}`);
    }
  }
});

const DB = loadDatabase('excavator');
const BOOM = DB.messages.get('BoomStroke')!;  // 10 ms, three lost frames in a row are one too many

interface Sent {
  counter: number;
  word?: number;
  flip?: boolean;
}

function boom_of(store: PageStore, time_s: number): MessageState {
  return messageStates(store, time_s).find(({message}) => message.name === 'BoomStroke')!;
}

/// What is said after these frames, 10 ms apart, behind two good ones with counters 13 and 14.
function after(sent: readonly Sent[]): MessageState {
  const all = [{counter: 13}, {counter: 14}, ...sent];
  const text = all.map(({counter, word, flip}: Sent, i) => {
    const bytes = protected_bytes(BOOM.data_id, counter, word ?? 7);
    bytes[5] ^= flip ? 0x10 : 0;
    return line(1 + 0.01 * i, BOOM.id, bytes);
  }).join('');
  const store = store_of(text);
  return boom_of(store, store.until_s);
}

const CASES: readonly (readonly [string, Integrity, number, readonly Sent[]])[] = [
  ['in order', 'ok', 0, [{counter: 0}, {counter: 1}]],
  ['a flipped bit', 'crc', 1, [{counter: 0, flip: true}]],
  ['good again after it', 'lost', 2, [{counter: 0, flip: true}, {counter: 1}]],
  ['and then', 'ok', 2, [{counter: 0, flip: true}, {counter: 1}, {counter: 2}]],
  ['the very frame again', 'repeated', 1, [{counter: 0}, {counter: 0}]],
  ['its counter with other data', 'sequence', 1, [{counter: 0}, {counter: 0, word: 8}]],
  ['one lost', 'lost', 1, [{counter: 1}]],
  ['two lost', 'lost', 1, [{counter: 2}]],
  ['three lost', 'sequence', 1, [{counter: 3}]],
  ['going on from there', 'ok', 1, [{counter: 3}, {counter: 4}]],
  ['a pair out of order', 'sequence', 2, [{counter: 1}, {counter: 0}]],
  ['which moved nothing', 'ok', 2, [{counter: 1}, {counter: 0}, {counter: 2}]],
  ['no counter', 'sequence', 1, [{counter: 15}]],
];

for (const [name, integrity, wrong, sent] of CASES) {
  test(`counter: ${name}`, () => {
    const state = after(sent);
    assert.equal(state.integrity, integrity);
    assert.equal(state.wrong, wrong);
    assert.equal(state.counter, sent[sent.length - 1].counter);
  });
}

test('a frame under another id has a wrong CRC', () => {
  const arm = DB.messages.get('ArmStroke')!;
  const text = line(1, BOOM.id, protected_bytes(arm.data_id, 3));
  assert.equal(boom_of(store_of(text), 1).integrity, 'crc');
});

test('silence, and what is older than a second', () => {
  const lines = Array.from({length: 300}, (_, i) => {
    const bytes = protected_bytes(BOOM.data_id, i % 15);
    bytes[7] ^= i === 50 ? 1 : 0;
    return line(1 + 0.01 * i, BOOM.id, bytes);
  });
  const store = store_of(lines.join(''));
  const seen = (time_s: number): unknown[] => {
    const {integrity, wrong, stale} = boom_of(store, time_s);
    return [integrity, wrong, stale];
  };
  assert.deepEqual(seen(0.9), ['silent', 0, true]);
  assert.deepEqual(seen(1.5), ['crc', 1, false]);
  assert.deepEqual(seen(1.6), ['ok', 2, false]);
  assert.deepEqual(seen(2.505), ['ok', 1, false]);
  assert.deepEqual(seen(2.515), ['ok', 0, false]);
  assert.deepEqual(seen(2.6), ['ok', 0, false]);
  assert.deepEqual(seen(4.015), ['ok', 0, false]);
  assert.deepEqual(seen(4.025), ['silent', 0, true]);
  assert.equal(boom_of(store, 6).rate_hz, 0);
  assert.equal(boom_of(store, 3).rate_hz, 100);
  assert.equal(boom_of(store, 1.2).rate_hz > 95, true);
});
