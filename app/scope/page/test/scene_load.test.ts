// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {doubled_area} from '../src/scene/outline';
import {BucketLoad, held_share, kLoose_kgpm3, type LoadSigns} from '../src/scene/bucket_load';
import {bucket_walk, teeth_walk} from '../src/scene/edges';
import {bucket_shell} from '../src/scene/excavator_shape';
import {fill_outline, heaped_outline} from '../src/scene/fill_shape';
import {heap, kRepose} from '../src/scene/heap';
import {cut, type Edge, type Grid, HeightField} from '../src/scene/height_field';
import {KeepOutBody} from '../src/scene/keep_out';
import {keep_out_ring} from '../src/scene/keep_out_ring';
import {excavator_grid, excavator_start} from '../src/scene/soil_shape';
import {TerrainHistory} from '../src/scene/terrain_history';
import {EXCAVATOR_12T} from './machines';
import {store_of} from './make';
import {graben_log} from './tool';

const GRID: Grid = {x_m: -4, y_m: -4, cell_m: 0.1, columns: 81, rows: 81};
const AREA = GRID.cell_m ** 2;
const ignore = (): void => {};
const edge = (x_m: number, y_m: number, z_m: number): Edge => ({x_m, y_m, z_m, heading_rad: 0});
const over = (field: HeightField): number =>
  AREA * field.heights.reduce((sum, z) => sum + Math.max(z, 0), 0);

const signs = (told: Partial<LoadSigns>): LoadSigns =>
  ({tilt_rad: 1, payload_kg: NaN, deviation_kg: NaN, resists: false, free: false, ...told});

test('a heap has the volume that fell, at the angle of repose, and is gone before its time', () => {
  const field = new HeightField(GRID, () => 0);
  for (const volume of [0.2, 0.3]) {
    heap(field, 2, edge(0, 0, 2), 1, volume);
  }
  field.show(2, ignore);
  assert.ok(Math.abs(over(field) - 0.5) < 0.02, `${over(field)} m3`);
  const at = (column: number, row: number): number => field.heights[row * GRID.columns + column]!;
  let steepest = 0;
  for (let i = 1; i < 80; ++i) {
    steepest = Math.max(steepest, Math.abs(at(i, 40) - at(i - 1, 40)) / GRID.cell_m);
  }
  assert.ok(steepest > 0.9 * kRepose && steepest < 1.01 * kRepose, `slope ${steepest}`);
  field.show(1, ignore);
  assert.equal(over(field), 0);
});

test('a heap fills a pit before it stands over it; beyond the grid nothing is heaped', () => {
  const field = new HeightField(GRID, () => 0);
  const dug = cut(field, 1, edge(-1, 0, -0.3), edge(1, 0, -0.3), 1);
  assert.ok(dug > 0.6 && dug < 0.75, `${dug} m3`);
  heap(field, 2, edge(0, 0, 1), 1, 0.1);
  heap(field, 3, edge(40, 0, 1), 1, 5);
  field.show(3, ignore);
  assert.equal(over(field), 0);
  const missing = -AREA * field.heights.reduce((sum, z) => sum + z, 0);
  assert.ok(Math.abs(dug - missing - 0.1) < 0.01, `${dug - missing} m3`);
});

test('without what the controller tells of it nothing is in the bucket', () => {
  const load = new BucketLoad(0.6);
  for (let i = 0; i < 100; ++i) {
    assert.deepEqual(load.step(0.1 * i, signs({free: i > 50}), 0.05), {poured_m3: 0, missed_m3: 0});
  }
  assert.equal(load.at(5), 0);
});

test('what is cut against the ground fills it, the payload corrects that, the tilt pours it', () => {
  const load = new BucketLoad(0.6);
  let time = 0;
  const step = (told: Partial<LoadSigns>, cut_m3 = 0) =>
    load.step(time += 0.1, signs(told), cut_m3);
  step({resists: true}, 0.1);
  assert.ok(Math.abs(load.now_m3 - 0.12) < 1e-9);
  step({resists: true}, 5);
  assert.equal(load.now_m3, 0.6, 'no more than it holds');
  step({tilt_rad: 0.2, payload_kg: 0.4 * kLoose_kgpm3, deviation_kg: 20});
  assert.ok(Math.abs(load.now_m3 - 0.4) < 1e-9);
  const full_s = time;
  step({tilt_rad: 0.3, free: true});
  assert.ok(Math.abs(load.now_m3 - 0.4) < 1e-9, 'a level bucket holds it');
  let poured = 0;
  for (let i = 0; i < 40; ++i) {
    poured += step({tilt_rad: 2, free: true}).poured_m3;
  }
  assert.equal(load.now_m3, 0);
  assert.ok(Math.abs(poured - 0.4) < 1e-9, `${poured} m3`);
  assert.ok(Math.abs(load.at(full_s) - 0.4) < 1e-9 && load.at(time) === 0 && load.at(-1) === 0);
});

test('what is missing when it is weighed again has fallen; the noise of the scales has not', () => {
  const load = new BucketLoad(0.6);
  const weigh = (time_s: number, kg: number): number =>
    load.step(time_s, signs({payload_kg: kg, deviation_kg: 20}), 0).missed_m3;
  assert.equal(weigh(1, 600), 0);
  assert.equal(weigh(2, 580), 0);
  assert.ok(Math.abs(weigh(3, 290) - 0.2) < 0.02);
  assert.ok(weigh(4, -15) > 0.19 && load.now_m3 === 0);
});

test('soil that is cut and weighs nothing is only drawn: it is heaped up nowhere', () => {
  const load = new BucketLoad(0.6);
  load.step(1, signs({payload_kg: 500, deviation_kg: 20}), 0);
  load.step(2, signs({resists: true}), 0.3);
  load.step(3, signs({payload_kg: 3, deviation_kg: 20}), 0);
  load.step(4, signs({}), 0.3);
  assert.equal(load.now_m3, 0);
});

test('a bucket holds all when its mouth is level, whole turns aside, and nothing upside down', () => {
  assert.equal(held_share(0.1), 1);
  assert.equal(held_share(-2 * Math.PI - 0.1), 1);
  assert.equal(held_share(Math.PI), 0);
  assert.ok(held_share(0.8) > held_share(1.2) && held_share(1.2) > 0);
});

test('the fill is drawn as large as it is, within the bucket, and lies level as far as soil does', () => {
  const shell = bucket_shell(EXCAVATOR_12T);
  const whole = Math.abs(doubled_area(heaped_outline(shell)));
  for (const direction of [-Math.PI, -2.6, -2, 0, 1.5]) {
    assert.deepEqual(fill_outline(shell, 0, direction), []);
    for (const share of [0.1, 0.5, 1]) {
      const area = Math.abs(doubled_area(fill_outline(shell, share, direction)));
      assert.ok(Math.abs(area - share * whole) < 0.01 * whole, `${share} at ${direction}`);
    }
  }
  // Curled by a little: the highest points of a half fill are level in the ground frame.
  const direction = -Math.PI + 0.3;
  const heights = fill_outline(shell, 0.5, direction)
    .map(([x, z]) => x * Math.sin(direction) + z * Math.cos(direction)).sort((a, b) => b - a);
  assert.ok(Math.abs(heights[0]! - heights[1]!) < 1e-3, `${heights[0]}, ${heights[1]}`);
});

const worked = (log: Uint8Array): {history: TerrainHistory; until_s: number} => {
  const store = store_of(log);
  const field = new HeightField(excavator_grid(EXCAVATOR_12T), excavator_start(EXCAVATOR_12T));
  const history = new TerrainHistory(
    field, 0.98, bucket_walk(EXCAVATOR_12T), new BucketLoad(0.6));
  assert.equal(history.advance(store, Infinity, 1e9), true);
  field.show(Infinity, ignore);
  return {history, until_s: store.until_s};
};

test('a trench in loam: the bucket fills and empties, and what it cut lies beside the trench', () => {
  const {history, until_s} = worked(graben_log('autodig', '--task', 'trench', '--soil', 'loam'));
  const {field} = history;
  const dug = -AREA * field.heights.reduce((sum, z) => sum + Math.min(z, 0), 0);
  assert.ok(dug > 1.4 && dug < 2.6, `${dug} m3 dug`);
  assert.ok(over(field) > dug && over(field) < 1.5 * dug, `${over(field)} m3 heaped, ${dug} dug`);
  let [dumps, full] = [0, false];
  for (let time = 0; time < until_s; time += 0.1) {
    const fill = history.load!.at(time);
    assert.ok(fill >= 0 && fill < 0.7, `${fill} m3 at ${time}`);
    dumps += full && fill < 0.05 ? 1 : 0;
    full = fill < 0.05 ? false : full || fill > 0.1;
  }
  assert.ok(dumps >= 4 && dumps <= 12, `${dumps} dumps`);
});

test('the same task in the air: nothing in the bucket, nothing heaped up', () => {
  const {history, until_s} = worked(graben_log('autodig', '--task', 'trench'));
  for (let time = 0; time < until_s; time += 0.1) {
    // Less is not told from nothing: one reading of the force may stand over its doubt.
    assert.ok(history.load!.at(time) < 0.02);
  }
  assert.equal(over(history.field), 0);
});

test('a log without the load\'s frames is cut as before', () => {
  const text = new TextDecoder().decode(graben_log('autodig', '--task', 'trench', '--soil', 'loam'));
  const bare = text.split('\n').filter((line) => !line.includes(' 18FF3A82#')).join('\n');
  assert.ok(bare.length < text.length);
  const store = store_of(bare);
  const make = (walk: typeof teeth_walk, load: BucketLoad | null): HeightField => {
    const field = new HeightField(excavator_grid(EXCAVATOR_12T), excavator_start(EXCAVATOR_12T));
    new TerrainHistory(field, 0.98, walk(EXCAVATOR_12T), load).advance(store, Infinity, 1e9);
    field.show(Infinity, ignore);
    return field;
  };
  const plain = make(teeth_walk, null);
  assert.deepEqual(make(bucket_walk, new BucketLoad(0.6)).heights, plain.heights);
  assert.ok(plain.heights.some((z) => z < -0.5));
});

test('boxes are drawn turned, cylinders round, and both as high as they are', () => {
  const centre_m = [5, 2, 1] as const;
  const box = {centre_m, half_m: [2, 1, 0.5] as const, turn_rad: Math.PI / 2};
  const ring = keep_out_ring(box);
  assert.equal(ring.length, 4);
  for (const [x, y] of ring) {
    assert.ok(Math.abs(Math.abs(x - 5) - 1) < 1e-9 && Math.abs(Math.abs(y - 2) - 2) < 1e-9);
  }
  const round = keep_out_ring({centre_m, half_m: [1.5, 1.5, 0.5], round: true});
  assert.ok(round.every(([x, y]) => Math.abs(Math.hypot(x - 5, y - 2) - 1.5) < 1e-9));
  const body = new KeepOutBody(box);
  assert.deepEqual(body.label_m, [5, 2, 1.5]);
  const mesh = body.node.children[0] as unknown as
    {geometry: {attributes: {position: {array: Float32Array}}}};
  const heights = [...mesh.geometry.attributes.position.array].filter((_, i) => i % 3 === 2);
  assert.deepEqual([...new Set(heights)].sort(), [0.5, 1.5]);
  body.dispose();
});
