// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {FrameStore} from '../src/model/api';
import {blade_walk, teeth_walk} from '../src/scene/edges';
import {type Edge, type Grid, HeightField} from '../src/scene/height_field';
import {dozer_grid, excavator_grid} from '../src/scene/soil_shape';
import {type EdgeWalk, TerrainHistory} from '../src/scene/terrain_history';
import {Trail, trail_segments} from '../src/scene/trail';
import {DOZER_9T, EXCAVATOR_12T, EXCAVATOR_22T} from './machines';
import {store_of} from './make';
import {graben_log} from './tool';

const ignore = (): void => {};
const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);

/// A log twice, the second time right after the first, as a simulation that restarts sends it.
function twice(log: string): {text: string; begins_s: number} {
  const rows = log.trimEnd().split('\n');
  const stamp = (row: string): number => Number(row.slice(1, row.indexOf(')')));
  const begins_s = stamp(rows[rows.length - 1]) + 0.01;
  const from_s = stamp(rows[0]);
  const later = rows.map((row) =>
    `(${(stamp(row) - from_s + begins_s).toFixed(6).padStart(17, '0')}` +
    row.slice(row.indexOf(')')));
  return {text: [...rows, ...later].join('\n') + '\n', begins_s};
}

const GRADE = twice(text(graben_log('grade')));
const STORE = store_of(GRADE.text);
const soil = (): HeightField => new HeightField(dozer_grid(DOZER_9T), () => 0);

function worked(field: HeightField, store: FrameStore, walk = blade_walk(DOZER_9T)): HeightField {
  new TerrainHistory(field, 2.4, walk).advance(store, Infinity, 1e9);
  return field;
}

test('a run that begins anew finds the soil as it was, and cuts the same again', () => {
  const field = worked(soil(), STORE);
  const [first, second] = [soil(), soil()].map((at) => at.heights);
  field.show(GRADE.begins_s - 0.005, ignore);
  first.set(field.heights);
  field.show(GRADE.begins_s + 0.1, ignore);
  assert.deepEqual(field.heights, soil().heights, 'nothing is cut, not by the way back either');
  field.show(Infinity, ignore);
  second.set(field.heights);
  assert.ok(first.some((height) => height < -0.1));
  first.forEach((height, node) => assert.ok(Math.abs(height - second[node]) < 0.01, `${node}`));
  field.show(GRADE.begins_s - 0.005, ignore);
  assert.deepEqual(field.heights, first, 'back before it');
});

test('the trail has a gap where the run begins anew', () => {
  const now = GRADE.begins_s + 2;
  const points = new Trail(4, blade_walk(DOZER_9T)).at(STORE, now);
  const xs = points.map(({at_m}) => at_m[0]);
  assert.ok(Math.max(...xs) - Math.min(...xs) > 10, 'both runs are in it');
  const {segments} = trail_segments(points, now, 4);
  for (let i = 0; i < segments.length; i += 2) {
    const way = Math.abs(segments[i + 1][0] - segments[i][0]);
    assert.ok(way < 8, `${way} m`);
  }
});

const GRID: Grid = {x_m: -2, y_m: -2, cell_m: 0.1, columns: 41, rows: 41};

/// Edges every 10 ms.
const walk_of = (edges: readonly Edge[]) => (_: FrameStore, after_s: number): EdgeWalk => {
  let index = Math.max(Math.floor(after_s / 0.01 + 1e-6), -1);
  return {
    next: () => (++index < edges.length ? index * 0.01 : NaN),
    edge: () => edges[index],
  };
};

const whole = {database: {}, until_s: 100} as unknown as FrameStore;
const at = (x_m: number, drives?: readonly number[]): Edge =>
  ({x_m, y_m: 0, z_m: -0.3, heading_rad: 0, drives});

/// One metre of cut, then a step from x = 0.
function stepped(to: Edge, drives?: readonly number[]): Float32Array {
  const way = Array.from({length: 21}, (_, i) => at(-1 + 0.05 * i, drives));
  const field = worked(new HeightField(GRID, () => 0), whole, walk_of([...way, to, to]));
  field.show(Infinity, ignore);
  return field.heights;
}

test('a step that a machine can make cuts; a longer one begins anew', () => {
  const middle = 20 * GRID.columns;
  assert.ok(stepped(at(0.45))[middle + 10] < -0.29 && stepped(at(0.45))[middle + 23] < -0.29);
  assert.ok(stepped(at(0.6)).every((height) => height === 0));
});

test('one sensor that jumps leaves the soil as it is', () => {
  const middle = 20 * GRID.columns;
  const wrong = stepped(at(1, [0.65, 0.7, 0.3, 0]), [0.5, 0.7, 0.3, 0]);
  assert.ok(wrong[middle + 10] < -0.29, 'what was cut stays');
  assert.equal(wrong[middle + 25], 0, 'and nothing is cut on the way');
  const anew = stepped(at(1, [0.65, 0.9, 0.3, 0]), [0.5, 0.7, 0.3, 0]);
  assert.ok(anew.every((height) => height === 0));
});

test('no frame of a machine at work is taken for a jump', () => {
  const field = new HeightField(excavator_grid(EXCAVATOR_12T), () => 1);
  let laid = 0;
  field.lay_anew = () => {
    ++laid;
  };
  for (const [task, machine] of [['dig', EXCAVATOR_22T], ['autodig', EXCAVATOR_12T]] as const) {
    worked(field, store_of(graben_log(task)), teeth_walk(machine));
    assert.ok(field.entries > 100, task);
  }
  assert.equal(laid, 0);
});
