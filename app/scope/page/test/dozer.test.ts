// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {Vector2} from '../src/model/api';
import {
  bladeAngle, bladeLinkage, bladeStroke, dozerPose, dozerPoseWithEdgeOn,
} from '../src/model/dozer';
import {designHeight, dozerState, wantedDozer} from '../src/model/wanted';
import {DOZER_9T} from './machines';
import {random, store_of} from './make';
import {graben_log} from './tool';

const {blade} = DOZER_9T;
const near = (a: number, b: number, tolerance: number, what: string): void =>
  assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a}, not ${b}`);
const distance = (a: Vector2, b: Vector2): number => Math.hypot(a[0] - b[0], a[1] - b[1]);

const GRADE = store_of(graben_log('grade'));

const level = (blade_stroke_m: number) =>
  dozerPose(DOZER_9T, {position_m: 0, height_m: 0, pitch_rad: 0, blade_stroke_m})!;

test('the edge reaches from its highest to its lowest over the stroke', () => {
  const {stroke_max_m} = bladeLinkage(DOZER_9T);
  near(level(0).edge_m[1], blade.edge_max_m, 1e-12, 'raised');
  near(level(stroke_max_m).edge_m[1], blade.edge_min_m, 1e-12, 'lowered');
  near(level(bladeStroke(DOZER_9T, 0)).edge_m[1], 0, 1e-12, 'home');
  const home = level(bladeStroke(DOZER_9T, 0));
  near(distance(home.cylinder_base_m, home.cylinder_eye_m), blade.length_home_m, 1e-12, 'home');
});

test('every pin is as far from its neighbours as the steel makes it', () => {
  const next = random(41);
  const {stroke_max_m, shortest_m, l12_m} = bladeLinkage(DOZER_9T);
  for (let i = 0; i < 300; ++i) {
    const stroke = next() * stroke_max_m;
    const pitch = 0.6 * (next() - 0.5);
    const pose = dozerPose(DOZER_9T, {
      position_m: 30 * next(), height_m: next() - 0.5, pitch_rad: pitch, blade_stroke_m: stroke})!;
    near(distance(pose.pivot_m, pose.edge_m), blade.cutting_edge_m, 1e-9, 'edge');
    near(distance(pose.pivot_m, pose.foot_m), Math.hypot(...blade.arm_m), 1e-9, 'foot');
    near(distance(pose.pivot_m, pose.cylinder_eye_m), l12_m, 1e-9, 'eye');
    near(distance(pose.cylinder_base_m, pose.cylinder_eye_m), shortest_m + stroke, 1e-9,
      'cylinder');
    const along: Vector2 = [pose.pivot_m[0] - pose.body_m[0], pose.pivot_m[1] - pose.body_m[1]];
    near(Math.atan2(along[1], along[0]) - Math.atan2(blade.pivot_m[1], blade.pivot_m[0]), pitch,
      1e-9, 'pitch');
    near(bladeStroke(DOZER_9T, bladeAngle(DOZER_9T, stroke)), stroke, 1e-9, 'stroke');
  }
  assert.ok(bladeAngle(DOZER_9T, 0.1) > bladeAngle(DOZER_9T, 0.2), 'extension lowers');
  assert.equal(dozerPose(DOZER_9T,
    {position_m: NaN, height_m: 0, pitch_rad: 0, blade_stroke_m: 0}), null);
});

test('the edge is where the controller has it over its design', () => {
  const store = GRADE;
  assert.equal(store.database?.kind, 'dozer');
  const errors = store.rows('EcuGrade');
  let compared = 0;
  for (let row = 0; row < errors.count; ++row) {
    const time_s = errors.time(row);
    const told = store.reading('EcuGrade.GradeError', time_s);
    const pose = dozerPose(DOZER_9T, dozerState(store, time_s));
    if (told.state !== 'valid' || pose === null) {
      continue;
    }
    const [x, z] = pose.edge_m;
    const [before, after] = [designHeight(DOZER_9T.design, x - 0.5),
      designHeight(DOZER_9T.design, x + 0.5)];
    const slope = after - before;
    const straight = Math.abs(designHeight(DOZER_9T.design, x) - 0.5 * (before + after)) < 1e-9;
    if (straight) {  // no rounded corner near, which the profile's points do not have
      const error = (z - designHeight(DOZER_9T.design, x)) / Math.hypot(1, slope);
      // The controller tells it for where the body will be when a command of now takes effect.
      near(1000 * error, told.value, 3.0, `error at ${x}`);
      ++compared;
    }
  }
  assert.ok(compared > 500);
});

test('wanted is the edge on the design, the body as it is', () => {
  const state = {position_m: 4, height_m: 0.02, pitch_rad: -0.05, blade_stroke_m: 0.1};
  const wanted = dozerPoseWithEdgeOn(DOZER_9T, state, (x) => designHeight(DOZER_9T.design, x))!;
  near(wanted.edge_m[1], designHeight(DOZER_9T.design, wanted.edge_m[0]), 1e-9, 'edge');
  assert.deepEqual(wanted.body_m, [4, 0.02]);
  const store = GRADE;
  const middle = 0.5 * (store.from_s + store.until_s);
  const ghost = wantedDozer(store, DOZER_9T, middle)!;
  near(ghost.edge_m[1], designHeight(DOZER_9T.design, ghost.edge_m[0]), 1e-9, 'ghost');
  assert.equal(wantedDozer(store, DOZER_9T, store.from_s), null);  // not active yet
});

test('a design goes on level before and after', () => {
  assert.deepEqual([-9, 0, 4.5, 12, 26, 99].map((x) => designHeight(DOZER_9T.design, x)),
    [0, 0, -0.175, -0.12, 0, 0]);
  assert.ok(Number.isNaN(designHeight([], 1)));
});
