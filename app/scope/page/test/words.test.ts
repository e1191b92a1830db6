// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {Words} from '../src/model/api';
import {loadDatabase} from '../src/model/dbc';
import {fault_words, limit_words, why_not_armed} from '../src/model/words';

const WORDS: Words = {
  fault: {'1': 'a stroke is missing', '17': 'wrong CRCs of a message'},
  why_not_armed: ['a stroke is missing', 'a pressure is missing', 'a swash is missing'],
};
const CONTEXT = {kind: 'excavator', words: WORDS, task: null} as const;

test('limits as the reports word them', () => {
  const words = (limit: number, index: number): string => limit_words(limit, index, CONTEXT);
  assert.equal(words(1, 1), 'pump flow: Pump 2');
  assert.equal(words(2, 3), 'back flow: swing');
  assert.equal(words(6, 17), 'slowed: wrong CRCs of a message');
  assert.equal(words(12, 4), 'fence: number 4');
  assert.equal(limit_words(8, 1, {...CONTEXT, kind: 'dozer'}), 'transmission flow: right track');
  assert.equal(limit_words(4, 0, {...CONTEXT, kind: 'dozer'}), 'stroke end: blade');
  const task = {fences: [{words: 'wall'}]} as never;
  assert.equal(limit_words(14, 7, CONTEXT), 'a limit from outside: source 7');
  assert.equal(limit_words(12, 0, {...CONTEXT, task}), 'fence: wall');
});

test('every limit that the DBC knows has words of its own', () => {
  for (const kind of ['excavator', 'dozer'] as const) {
    const numbers = [...loadDatabase(kind).signal('EcuStatus.LimitKind').states.keys()];
    const all = numbers.map((limit) => limit_words(limit, 0, {...CONTEXT, kind}));
    assert.equal(new Set(all).size, all.length);
    assert.ok(all.every((one) => !one.startsWith('unknown')), all.join());
  }
  assert.equal(limit_words(99, 0, CONTEXT), 'unknown limit 99');
});

test('a limit that is in error or not available says so', () => {
  assert.equal(limit_words(30, 0, CONTEXT), 'limit in error');
  assert.equal(limit_words(31, 255, CONTEXT), 'limit not available');
  assert.equal(limit_words(4, 254, CONTEXT), 'stroke end: drive in error');
  assert.equal(limit_words(4, 255, CONTEXT), 'stroke end: drive not available');
  for (const limit of [1, 2, 3, 4, 6, 8, 12]) {
    assert.doesNotMatch(limit_words(limit, 255, CONTEXT), /unknown|25[56]|right/);
  }
});

test('faults and reasons', () => {
  assert.equal(fault_words(WORDS, 1), 'a stroke is missing');
  assert.equal(fault_words(WORDS, 200), 'unknown fault 200');
  assert.deepEqual(why_not_armed(WORDS, 0), []);
  assert.deepEqual(why_not_armed(WORDS, 0b101), ['a stroke is missing', 'a swash is missing']);
  assert.deepEqual(why_not_armed(WORDS, 0x80000000), ['unknown reason, bit 31']);
});
