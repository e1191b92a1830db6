// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {designHeight} from '../src/model/wanted';
import {blade_walk, teeth_walk} from '../src/scene/edges';
import {cut, type Edge, type Grid, HeightField} from '../src/scene/height_field';
import {dozer_grid, excavator_grid, excavator_start} from '../src/scene/soil_shape';
import {TerrainHistory} from '../src/scene/terrain_history';
import {DOZER_9T, EXCAVATOR_22T} from './machines';
import {random, store_of} from './make';
import {graben_log} from './tool';

const GRID: Grid = {x_m: -2, y_m: -2, cell_m: 0.1, columns: 41, rows: 41};
const flat = (): HeightField => new HeightField(GRID, () => 0);
const all = Infinity;
const ignore = (): void => {};

function height_at(field: HeightField, x_m: number, y_m: number): number {
  const {grid} = field;
  return field.heights[Math.round((y_m - grid.y_m) / grid.cell_m) * grid.columns +
    Math.round((x_m - grid.x_m) / grid.cell_m)];
}

const edge = (x_m: number, y_m: number, z_m: number, heading_rad = 0): Edge =>
  ({x_m, y_m, z_m, heading_rad});

test('an edge lowers what it passes over, as wide as it is, to its own height', () => {
  const field = flat();
  cut(field, 1, edge(-1, 0, -0.2), edge(1, 0, -0.4), 1);
  field.show(all, ignore);
  for (const [x, y, z] of [[-0.9, 0, -0.21], [0, 0.5, -0.3], [0.9, -0.5, -0.39]]) {
    const height = height_at(field, x, y);
    assert.ok(Math.abs(height - z) < 0.011, `${x}, ${y}: ${height}`);
  }
  for (const [x, y] of [[0, 0.6], [0, -0.6], [-1.2, 0], [1.2, 0]]) {
    assert.equal(height_at(field, x, y), 0, `${x}, ${y} is beside it`);
  }
});

test('an edge that looks aside cuts across its own direction', () => {
  const field = flat();
  cut(field, 1, edge(0, -1, -0.3, Math.PI / 2), edge(0, 1, -0.3, Math.PI / 2), 1);
  field.show(all, ignore);
  assert.ok(height_at(field, 0.5, 0) < -0.29 && height_at(field, -0.5, 0) < -0.29);
  assert.equal(height_at(field, 0.6, 0), 0);
});

test('soil is never raised, and an edge above it does nothing', () => {
  const field = flat();
  cut(field, 1, edge(-1, 0, -0.5), edge(1, 0, -0.5), 1);
  const entries = field.entries;
  cut(field, 2, edge(-1, 0, -0.2), edge(1, 0, 0.4), 1);
  field.show(all, ignore);
  assert.equal(field.entries, entries);
  assert.ok(Math.abs(height_at(field, 0, 0) + 0.5) < 1e-6);
});

/// Random cuts at 1, 2, 3 ... s.
function random_cuts(field: HeightField, until_s: number): void {
  const next = random(7);
  const place = (): Edge => edge(4 * next() - 2, 4 * next() - 2, -next(), 6 * next());
  let from = place();
  for (let time = 1; time <= until_s; ++time) {
    const to = place();
    cut(field, time, from, to, 0.6);
    from = to;
  }
}

test('any time is shown as if nothing had come after it', () => {
  const field = flat();
  random_cuts(field, 60);
  const next = random(8);
  for (let i = 0; i < 40; ++i) {
    const time = Math.floor(62 * next());
    const changed = new Set<number>();
    const before = field.heights.slice();
    field.show(time, (node) => changed.add(node));
    const fresh = flat();
    random_cuts(fresh, time);
    fresh.show(all, ignore);
    assert.deepEqual(field.heights, fresh.heights, `at ${time}`);
    before.forEach((height, node) =>
      assert.ok(height === field.heights[node] || changed.has(node), 'a change is told'));
  }
});

test('a field that has forgotten its oldest cuts keeps what they left', () => {
  const [small, large] = [new HeightField(GRID, () => 0, 2048), flat()];
  random_cuts(small, 60);
  random_cuts(large, 60);
  assert.ok(large.entries > 2048 && small.entries <= 2048);
  for (const time of [all, 58, 60]) {
    small.show(time, ignore);
    large.show(time, ignore);
    assert.deepEqual(small.heights, large.heights, `at ${time}`);
  }
});

test('a change by forgetting is told with the next time that is shown', () => {
  const field = new HeightField(GRID, () => 0, 2048);
  random_cuts(field, 10);
  const mesh = field.heights.slice();
  const told = (node: number): void => {
    mesh[node] = field.heights[node];
  };
  field.show(2, told);
  const before = field.entries;
  for (let time = 11; field.entries >= before; ++time) {
    cut(field, time, edge(-2, 0, -time), edge(2, 0, -time), 4);
  }
  assert.notDeepEqual(field.heights, mesh);
  field.show(2, told);
  assert.deepEqual(field.heights, mesh);
});

const GRADE = store_of(graben_log('grade'));
const graded = (): TerrainHistory => new TerrainHistory(
  new HeightField(dozer_grid(DOZER_9T), () => 0), 2.4, blade_walk(DOZER_9T));

test('the soil that a grade leaves is the design', () => {
  const history = graded();
  assert.equal(history.advance(GRADE, all, 1e9), true);
  history.field.show(all, ignore);
  for (let x = 3; x < 26; x += 0.1) {
    // A cell reaches half of it down a slope.
    const [low, high] = [x - 0.06, x + 0.06].map((at) => designHeight(DOZER_9T.design, at))
      .sort((a, b) => a - b);
    const height = height_at(history.field, x, 0);
    assert.ok(height > low - 0.03 && height < high + 0.03, `x ${x}: ${height}`);
    assert.equal(height_at(history.field, x, 1.5), 0, 'beside the blade');
  }
});

test('worked in a little at a time, and shown meanwhile, the soil is the same', () => {
  const [whole, pieces] = [graded(), graded()];
  whole.advance(GRADE, 20, 1e9);
  whole.field.show(20, ignore);
  let [turns, clock] = [0, 0];
  while (!pieces.advance(GRADE, 20, 1, () => ++clock)) {
    pieces.field.show(++turns % 3 === 0 ? 5 : pieces.known_until_s, ignore);
  }
  assert.ok(turns > 20, `${turns} turns`);
  pieces.field.show(20, ignore);
  assert.deepEqual(pieces.field.heights, whole.field.heights);
  assert.equal(whole.outlived(GRADE), false);
  assert.equal(whole.outlived({...GRADE, until_s: 3} as typeof GRADE), true);
});

test('teeth dig where the digging path is below the soil, and nowhere else', () => {
  const store = store_of(graben_log('dig'));
  const field = new HeightField(excavator_grid(EXCAVATOR_22T), excavator_start(EXCAVATOR_22T));
  const history = new TerrainHistory(field, 1.2, teeth_walk(EXCAVATOR_22T));
  history.advance(store, all, 1e9);
  field.show(all, ignore);
  const bottom = Math.min(...EXCAVATOR_22T.dig.path.map(([, z]) => z));
  assert.ok(Math.abs(height_at(field, 5.1, 0) - bottom) < 0.02, `${height_at(field, 5.1, 0)}`);
  assert.equal(height_at(field, 5.1, 0.8), 0.75, 'beside the bucket');
  assert.equal(height_at(field, 8, 0), 0.75, 'beyond the path');
  assert.equal(height_at(field, 1, 0), 0, 'between the tracks');
});
