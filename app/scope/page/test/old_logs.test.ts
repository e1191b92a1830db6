// SPDX-License-Identifier: Apache-2.0
/// Logs of the DBC versions before this one, as they were written then (tests/old_logs).

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {CandumpParser} from '../src/model/candump';
import {databaseOf, is_read, loadDatabase, oldest_version} from '../src/model/dbc';
import {PageStore} from '../src/model/store';
import {limit_key} from '../src/view/limits/limit_colours';
import {limit_shares} from '../src/view/limits/limit_shares';
import {bytes_of, store_of} from './make';

const folder = `${process.env.GRABEN_DBC ?? 'can_dbc'}/../tests/old_logs`;
const [EXCAVATOR, EXCAVATOR_11, DOZER, DOZER_8, DOZER_9] =
  ['excavator_10', 'excavator_11', 'dozer_7', 'dozer_8', 'dozer_9']
  .map((name) => readFileSync(`${folder}/${name}.log`, 'utf8'));

const states = (store: PageStore, signal: string, times_s: readonly number[]): string[] =>
  times_s.map((time_s) => store.database!.signal(signal).states.get(store.reading(signal, time_s).raw)!);

for (const [version, log] of [[10, EXCAVATOR], [11, EXCAVATOR_11]] as const)
test(`an excavator of version ${version}`, () => {
  const store = store_of(log);
  assert.equal(store.database, databaseOf('excavator', version));
  // Before the controller has said its version and after.
  assert.deepEqual(states(store, 'EcuStatus.LimitKind', [24.91, 25.03, 25.05]), ['OffPath', 'OffPath', 'None']);
  assert.deepEqual(states(store, 'EcuStatus.Mode', [24.91, 25.03, 25.05]), ['Active', 'Active', 'Active']);
  assert.equal(store.reading('EcuStatus.Lambda', 24.95).value, 1);
  const shares = limit_shares(store, 24, 26).map(({key, share}) => [key, Math.round(100 * share)]);
  assert.deepEqual(shares, [[limit_key(13, 0), 67], [0, 33]]);
  assert.deepEqual(store.faults(), []);
});

for (const [version, log] of [[7, DOZER], [8, DOZER_8], [9, DOZER_9]] as const)
test(`a dozer of version ${version}`, () => {
  const store = store_of(log);
  assert.equal(store.database, databaseOf('dozer', version));
  assert.deepEqual(states(store, 'EcuStatus.LimitKind', [10.97, 11.03]), ['Ahead', 'Rise']);
  assert.deepEqual(states(store, 'EcuStatus.Mode', [10.97, 11.03]), ['Active', 'Active']);
});

test('what was read before the version was told is read anew', () => {
  const [head, tail] = [EXCAVATOR.slice(0, EXCAVATOR.indexOf('0CFF2880') - 30),
    EXCAVATOR.slice(EXCAVATOR.indexOf('0CFF2880') - 30)];
  const store = new PageStore();
  const parser = new CandumpParser();
  // A controller that is exchanged: all is read by what the last one says.
  const identity = tail.split('\n').find((line) => line.includes(' 18FF3482#'))!
    .replace('25.000000', '25.200000').replace(/#(.{8})0A/, '#$10B');
  for (const [text, version] of [[head, 11], [tail, 10], [`${identity}\n`, 11]] as const) {
    parser.feed(bytes_of(text.slice(text.indexOf('('))));
    store.append(parser.take());
    assert.equal(store.database, databaseOf('excavator', version));
    // Of the layout that is known so far.
    assert.equal(store.reading('EcuStatus.LimitKind', 24.91).raw, version === 10 ? 13 : 26);
  }
  assert.equal(store.ready_s, 24.9);
});

test('only EcuStatus was another', () => {
  for (const kind of ['excavator', 'dozer'] as const) {
    const own = loadDatabase(kind);
    assert.equal(databaseOf(kind, own.version), own);
    assert.equal(databaseOf(kind, own.version + 1), own);
    const oldest = oldest_version(kind);
    const before = databaseOf(kind, oldest);
    assert.equal(databaseOf(kind, oldest - 1), before);
    assert.deepEqual([oldest - 1, oldest, own.version, own.version + 1].map((version) => is_read(kind, version)),
      [false, true, true, false]);
    const layout = (database: typeof own): string[] => [...database.messages.values()]
      .flatMap(({name, signals}) => [...signals.values()].map((signal) =>
        `${name}.${signal.name} ${JSON.stringify(signal, (key, value) => key === 'message' ? null : value)}`));
    const [was, is] = [layout(before), layout(own)];
    assert.equal(was.length, is.length);
    const other = was.filter((signal, k) => signal !== is[k]).map((signal) => signal.split(' ')[0]);
    assert.deepEqual(other, ['EcuStatus.Mode', 'EcuStatus.LimitKind']);
    const mode = before.signal('EcuStatus.Mode');
    assert.deepEqual([5, 6, 14, 15].map((raw) => mode.state(raw)), ['valid', 'error', 'error', 'notAvailable']);
  }
});
