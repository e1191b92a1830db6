// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {blade_walk} from '../src/scene/edges';
import {dozer_state, excavator_state} from '../src/scene/machine_state';
import {measured} from '../src/scene/measured';
import {pressure_colour} from '../src/scene/theme';
import {Trail, trail_segments} from '../src/scene/trail';
import {DOZER_9T, EXCAVATOR_22T} from './machines';
import {hex, store_of} from './make';
import {graben_log} from './tool';

const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
const DIG = text(graben_log('dig'));
const stamp = (row: string): number => Number(row.slice(1, row.indexOf(')')));

/// The dig with the rows of one message changed.
const changed = (id: string, change: (row: string) => string | null): string =>
  DIG.split('\n').flatMap((row) => (row.includes(` ${id}#`) ? change(row) ?? [] : row)).join('\n');

test('a message that stops makes its part and all beyond it stale, where it was', () => {
  const whole = store_of(DIG);
  const database = whole.database!;
  const boom = hex(database.messages.get('BoomStroke')!.id & 0x1fffffff, 8);
  const cycle = database.messages.get('BoomStroke')!.cycle_ms / 1000;
  const store = store_of(changed(boom, (row) => (stamp(row) <= 5 ? row : null)));
  const before = excavator_state(EXCAVATOR_22T, store, 5 + 2.9 * cycle);
  assert.deepEqual(before.stale, {platform: false, boom: false, arm: false, bucket: false});
  const after = excavator_state(EXCAVATOR_22T, store, 5 + 3.2 * cycle);
  assert.deepEqual(after.stale, {platform: false, boom: true, arm: true, bucket: true});
  const stood = excavator_state(EXCAVATOR_22T, whole, 5).pose!;
  const later = excavator_state(EXCAVATOR_22T, store, 9).pose!;
  assert.equal(later.joints_rad[0], stood.joints_rad[0]);
  assert.notEqual(later.joints_rad[1], stood.joints_rad[1]);
});

test('an error keeps the last valid value and is not fresh', () => {
  const boom = hex(store_of(DIG).database!.messages.get('BoomStroke')!.id & 0x1fffffff, 8);
  const store = store_of(changed(boom, (row) => (stamp(row) <= 5 ? row :
    row.replace(/#(....)..../, '#$1FFFE'))));
  const good = measured(store, 'BoomStroke.BoomStroke', 5);
  const bad = measured(store, 'BoomStroke.BoomStroke', 5.5);
  assert.equal(store.reading('BoomStroke.BoomStroke', 5.5).state, 'error');
  assert.ok(good.fresh && good.value > 0.1 && good.value < 1.26, `${good.value}`);
  assert.deepEqual(bad, {value: good.value, fresh: false});
  assert.deepEqual(measured(store, 'BoomStroke.BoomStroke', -1), {value: NaN, fresh: false});
});

test('pressures are in Pa, and not known where their frames stop', () => {
  const store = store_of(DIG);
  const known = excavator_state(EXCAVATOR_22T, store, 8).pressures_pa.boom;
  assert.equal(known[0], store.reading('BoomPressure.BoomCapPressure', 8).value * 1e6);
  const over = excavator_state(EXCAVATOR_22T, store, store.until_s + 1);
  assert.ok(Number.isNaN(over.pressures_pa.boom[0]) && over.stale.bucket);
});

test('a trail that goes along is the one that a seek makes', () => {
  const store = store_of(graben_log('grade'));
  const seconds = 4;
  const going = new Trail(seconds, blade_walk(DOZER_9T));
  for (let now = 6; now < 15; now += 0.033) {
    going.at(store, now);
  }
  const along = going.at(store, 15);
  const sought = new Trail(seconds, blade_walk(DOZER_9T)).at(store, 15);
  assert.ok(sought.length > 80 && sought.length < 110, `${sought.length}`);
  assert.ok(Math.abs(along.length - sought.length) <= 1);
  assert.deepEqual(along.slice(-60), sought.slice(-60));
  const edge = dozer_state(DOZER_9T, store, 15).pose!.edge_m;
  const last = sought[sought.length - 1].at_m;
  assert.ok(Math.hypot(last[0] - edge[0], last[2] - edge[1]) < 0.08);
  const {segments, ages} = trail_segments(sought, 15, seconds);
  assert.ok(segments.length === ages.length && segments.length < 2 * sought.length);
  assert.ok(ages.every((age) => age > -1e-6 && age < 1.001));
  assert.ok(going.at(store, 7).every(({time_s}) => time_s <= 7), 'back');
});

test('the pressure scale goes from pale to dark and ends at its ends', () => {
  const light = (share: number): number => pressure_colour(share).reduce((a, b) => a + b, 0);
  for (let share = 0; share < 1; share += 0.05) {
    assert.ok(light(share) > light(share + 0.05));
  }
  assert.deepEqual(pressure_colour(-1), pressure_colour(0));
  assert.deepEqual(pressure_colour(2), pressure_colour(1));
});
