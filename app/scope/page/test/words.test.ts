import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {LogHealth, Words} from '../src/model/api';
import {loadDatabase} from '../src/model/dbc';
import {
  fault_words, health_words, limit_words, mode_words, step_words, why_not_armed,
} from '../src/model/words';

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
  assert.equal(limit_words(12, 0, {...CONTEXT, task}), 'fence: wall');
});

test('every limit, mode and step that the DBC knows has words of its own', () => {
  const database = loadDatabase('excavator');
  const names = (signal: string): number[] => [...database.signal(signal).states]
    .filter(([, name]) => name !== 'Error' && name !== 'NotAvailable').map(([number]) => number);
  const check = (signal: string, words: (number: number) => string): void => {
    const all = names(signal).map(words);
    assert.equal(new Set(all).size, all.length, signal);
    assert.ok(all.every((one) => !one.startsWith('unknown')), signal);
    assert.match(words(names(signal).length), /^unknown/);
  };
  check('EcuStatus.LimitKind', (limit) => limit_words(limit, 0, CONTEXT));
  check('EcuStatus.Mode', mode_words);
  check('TaskStatus.StepKind', step_words);
});

test('faults and reasons', () => {
  assert.equal(fault_words(WORDS, 1), 'a stroke is missing');
  assert.equal(fault_words(WORDS, 200), 'unknown fault 200');
  assert.deepEqual(why_not_armed(WORDS, 0), []);
  assert.deepEqual(why_not_armed(WORDS, 0b101), ['a stroke is missing', 'a swash is missing']);
  assert.deepEqual(why_not_armed(WORDS, 0x8000), ['unknown reason, bit 15']);
});

const WELL: LogHealth = {lines: 10, malformed: 0, first_malformed: null, foreign: 3, backwards: 0,
  profile_hash: 7, dbc_version: 4};
const EXCAVATOR = loadDatabase('excavator');
const MACHINES = [{hash: 7}] as never[];

test('what is wrong with a log', () => {
  const words = (health: Partial<LogHealth>): string =>
    health_words({...WELL, ...health}, EXCAVATOR, MACHINES, false).join('|');
  assert.equal(words({}), '');
  assert.equal(words({dbc_version: null, profile_hash: null}), '');
  assert.match(words({dbc_version: 3}), /version 3 of excavator\.dbc, this page has version 4/);
  assert.match(words({profile_hash: 0xabc}), /00000ABC/);
  assert.match(words({malformed: 1, first_malformed: {line: 5, text: 'rubbish'}}),
    /^1 line of 10 .* line 5: rubbish$/);
  assert.match(words({backwards: 2}), /^2 stamps went back/);
  assert.match(health_words(WELL, null, MACHINES, false).join(), /no frame of an excavator/);
  assert.deepEqual(health_words(WELL, null, MACHINES, true), []);
});
