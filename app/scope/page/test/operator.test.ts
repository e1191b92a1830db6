// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {Fence, Task, Vector2, Vector3} from '../src/model/api';
import {not_live} from '../src/operator/big_state';
import {ends_of, in_plan, in_section, kept_out} from '../src/operator/bounds';
import {edge_off, LIGHTS, lights_of, off_of, off_path, off_plane, off_words} from '../src/operator/cut_fill';
import {profile_of} from '../src/operator/section';
import {HeightField} from '../src/scene/height_field';
import {DOZER_9T, EXCAVATOR_12T, EXCAVATOR_22T} from './machines';
import {graben_log} from './tool';
import {store_of} from './make';
import {SETUP} from './status';

const near = (found: number, wanted: number, within = 1e-9): void =>
  assert.ok(Math.abs(found - wanted) <= within, `${found} is not ${wanted}`);

test('off a plane is told along the vertical, up is positive', () => {
  const level = {through_m: [0, 0, -1] as Vector3, up: [0, 0, 1] as Vector3};
  near(off_plane(level, [5, 2, -0.7]), 0.3);
  near(off_plane(level, [5, 2, -1.2]), -0.2);
  const tilt = Math.atan(0.1);
  const slope = {through_m: [0, 0, 0] as Vector3, up: [-Math.sin(tilt), 0, Math.cos(tilt)] as Vector3};
  near(off_plane(slope, [10, 3, 1.25]), 0.25);
});

test('inside a closed path is positive, outside is negative, on it is none', () => {
  const path: Vector3[] = [[4, -1, 0], [7, -1, 0], [7, 1, 0], [4, 1, 0], [4, -1, 0]];
  near(off_path(path, [5, -0.9]), 0.1);
  near(off_path(path, [5, -1.1]), -0.1);
  near(off_path(path, [7.3, 0]), -0.3);
  near(off_path(path, [6, 1]), 0);
});

test('digits, unit and word are one statement', () => {
  const said = (off_m: number, from: 'design' | 'path' = 'design'): string => {
    const {digits, unit, word} = off_words({off_m, from});
    return `${digits} ${unit} ${word}`;
  };
  assert.equal(said(0.0353), '35 mm Cut');
  assert.equal(said(-0.0353), '35 mm Fill');
  assert.equal(said(0.0104), '10 mm On grade');
  assert.equal(said(0.0106), '11 mm Cut');
  assert.equal(said(-0.9994), '999 mm Fill');
  assert.equal(said(0.9996), '1.0 m Cut');
  assert.equal(said(12.4), '12 m Cut');
  assert.equal(said(0.02, 'path'), '20 mm Inside path');
  assert.equal(said(-0.02, 'path'), '20 mm Outside path');
  assert.equal(off_words(null).digits, '–');
  assert.equal(off_words({off_m: NaN, from: 'design'}).digits, '–');
});

test('the light bar goes from the middle outwards and never beyond its end', () => {
  const lit = (off_m: number): number | null => lights_of({off_m, from: 'design'});
  assert.deepEqual([0, 0.0104, 0.0106, 0.021, 0.041, 0.081, 0.161, 9].map(lit),
    [0, 0, 1, 2, 3, 4, LIGHTS, LIGHTS]);
  assert.deepEqual([-0.0106, -0.05, -9].map(lit), [-1, -3, -LIGHTS]);
  assert.equal(lights_of(null), null);
});

test('only what comes from a bus is not called a replay or a simulation', () => {
  const of = (mode: 'can' | 'log' | 'sim') =>
    not_live({...SETUP, source: {...SETUP.source, mode, name: 'a'}});
  assert.equal(of('can'), null);
  assert.equal(not_live(null), null);
  assert.deepEqual(of('log'), {kind: 'Replay', of: 'a'});
  assert.deepEqual(of('sim'), {kind: 'Simulation', of: 'a'});
});

/// Differences of two figures, mm, least first.
const sorted = (differences: number[]): number[] => differences.map(Math.abs).sort((a, b) => a - b);

test('the digits are what the controllers report as their errors', () => {
  const grade = store_of(graben_log('grade'));
  const dig = store_of(graben_log('dig'));
  const graded: number[] = [];
  const dug: number[] = [];
  for (let time_s = 0; time_s < 25; time_s += 0.05) {
    const active = (store: typeof grade): boolean => store.reading('EcuStatus.Mode', time_s).raw === 3;
    const edge = edge_off(DOZER_9T, grade, time_s);
    const told = grade.reading('EcuGrade.GradeError', time_s);
    if (edge !== null && told.state === 'valid' && active(grade)) {
      graded.push(1000 * edge - told.value);
      near(1000 * off_of(DOZER_9T, grade, time_s, 'none')!.off_m, told.value);
    }
    const path = off_of(EXCAVATOR_22T, dig, time_s, 'dig');
    const error = dig.reading('EcuHydraulics.PathError', time_s);
    if (path !== null && error.value > 0 && active(dig)) {
      dug.push(Math.abs(1000 * path.off_m) - error.value);
    }
  }
  assert.ok(graded.length > 200 && dug.length > 200, `${graded.length}, ${dug.length}`);
  // Over a step of the design a cycle is some centimetres; elsewhere they agree.
  assert.ok(sorted(graded)[Math.floor(0.7 * graded.length)]! < 1, `${sorted(graded)}`);
  assert.ok(sorted(dug)[Math.floor(0.95 * dug.length)]! < 2, `${sorted(dug)}`);
  // Above is positive in both.
  assert.ok(graded.length > 0 && off_of(DOZER_9T, grade, 8.5, 'none')!.off_m > 0.004);
  // Frames of another kind of machine say nothing of this one; nor do those that never came.
  assert.equal(off_of(EXCAVATOR_22T, grade, 10, 'dig'), null);
  assert.equal(off_of(EXCAVATOR_12T, dig, 10, 0), null);
  assert.equal(off_of(DOZER_9T, grade, -1, 'none'), null);
});

const wall: Fence = {words: 'wall', normal: [0, 1, 0], offset_m: 2};
const roof: Fence = {words: 'roof', normal: [0, 0, 1], offset_m: 5};

test('a plane is where it is in the section and in the plan, or in neither', () => {
  assert.deepEqual(in_section(roof, 1), {across: [0, 1], offset: 5});
  assert.equal(in_section(wall, 0), null, 'along the section');
  const turned = in_section(wall, Math.PI / 2)!;
  near(turned.offset, 2);
  near(turned.across[0], 1);
  assert.equal(in_plan(roof, 1), null);
  // y is to the left: u is -y.
  const plan = in_plan(wall, 0)!;
  near(plan.across[0], -1);
  near(plan.offset, 2);
  const [from, to] = ends_of(plan, {u: [-5, 5], v: [-5, 5]})!;
  for (const [u] of [from, to]) near(u, -2);
  assert.ok(Math.abs(from[1] - to[1]) >= 10, 'from edge to edge');
  assert.equal(ends_of(plan, {u: [10, 12], v: [0, 2]}), null);
});

test('a keep-out is met where the swing points at it, and nowhere else', () => {
  const box: Fence = {words: 'box', centre_m: [0, 5, 1], half_m: [1, 0.5, 1], turn_rad: 0};
  const post: Fence = {words: 'post', round: true, centre_m: [6, 0, 1], half_m: [0.4, 0.4, 1]};
  const [[from, to]] = kept_out(box, Math.PI / 2, 9) as [Vector2];
  near(from, 4.5, 0.06);
  near(to, 5.5, 0.06);
  assert.deepEqual(kept_out(box, 0, 9), []);
  assert.equal(kept_out(post, 0, 9).length, 1);
  assert.deepEqual(kept_out(wall, 0, 9), []);
});

test('the ground is cut along the swing, and level beyond the field', () => {
  const field = new HeightField(
    {x_m: 0, y_m: -2, cell_m: 0.5, columns: 9, rows: 9}, (x) => (x >= 2 ? -1 : 0));
  const ahead = new Map(profile_of(field, 0, [0, 6]).map(([reach, z]) => [reach.toFixed(2), z]));
  assert.equal(ahead.get('1.00'), 0);
  assert.equal(ahead.get('3.00'), -1);
  assert.equal(ahead.get('5.00'), 0);
  assert.ok(profile_of(field, Math.PI / 2, [0, 2]).every(([, z]) => z === 0));
});

test('a design comes before the line of a step', () => {
  const task: Task = {
    name: 'line', fences: [], design: null, steps: [{
      kind: 'dig', straight: true, duration_s: 1, raised_from_m: 0, raised_to_m: 0,
      from_drives: [], to_drives: [], from: {position_m: [8, 0, 0], attitude_rad: 0},
      to: {position_m: [1, 0, -1], attitude_rad: 0}}]};
  const store = store_of(graben_log('autodig'));
  const with_design = {...task, design: {
    through_m: [0, 0, 0] as Vector3, up: [0, 0, 1] as Vector3}};
  const off = (one: Task) => off_of({...EXCAVATOR_12T, tasks: [one]}, store, 6, 0);
  assert.equal(off(with_design)!.from, 'design');
  const line = off(task);
  if (line !== null) {
    assert.equal(line.from, 'line');
    assert.ok(line.off_m > off(with_design)!.off_m, 'the line is lower');
  }
  assert.equal(off({...task, steps: []}), null);
});
