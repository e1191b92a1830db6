// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {ExcavatorMachine, Vector3} from '../src/model/api';
import {drivesFromPose, excavatorPose, type Strokes} from '../src/model/excavator';
import {EXCAVATOR_12T, EXCAVATOR_22T} from './machines';
import {random} from './make';
import {graben_json} from './tool';

const near = (a: number, b: number, tolerance: number, what: string): void =>
  assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a}, not ${b}`);

const distance = (a: Vector3, b: Vector3): number =>
  Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

const axes = (machine: ExcavatorMachine) => {
  const {boom, arm, bucket} = machine.cylinders;
  return [boom, arm, bucket] as const;
};

function strokes_at(machine: ExcavatorMachine, share: () => number): Strokes {
  return axes(machine).map(({stroke_m}) => share() * stroke_m) as unknown as Strokes;
}

for (const machine of [EXCAVATOR_22T, EXCAVATOR_12T]) {
  test(`${machine.name}: joints and teeth are where the controller has them`, () => {
    const next = random(31);
    const shares = [() => 0, () => 1, ...Array.from({length: 14}, () => next)];
    for (const share of shares) {
      const strokes = strokes_at(machine, share);
      const swing = machine.has_swing ? 6 * (next() - 0.5) : 0;
      const told = graben_json('pose', '--profile', machine.name, '--strokes', strokes.join(','),
        '--swing', String(swing));
      const pose = excavatorPose(machine, strokes, swing)!;
      // Of the 12 t machine the profile has its boom's pins as rounded angles.
      for (let i = 0; i < 3; ++i) {
        near(pose.joints_rad[i], told.joints_rad[i], 1e-5, `joint ${i} at ${strokes}`);
        near(pose.position_m[i], told.position_m[i], 1e-4, `teeth ${i} at ${strokes}`);
      }
      near(pose.attitude_rad, told.attitude_rad, 1e-5, 'attitude');
    }
  });

  test(`${machine.name}: every pin is as far from its neighbours as the steel makes it`, () => {
    const next = random(33);
    for (let i = 0; i < 300; ++i) {
      const strokes = strokes_at(machine, next);
      const swing = 6 * (next() - 0.5);
      const pose = excavatorPose(machine, strokes, swing)!;
      const {cylinders} = pose;
      const pairs = [cylinders.boom, cylinders.arm, cylinders.bucket];
      pairs.forEach(({base_m, eye_m}, axis) => near(distance(base_m, eye_m),
        axes(machine)[axis].closed_length_m + strokes[axis], 1e-9, `cylinder ${axis}`));
      near(distance(pose.boom_foot_m, pose.arm_pin_m), machine.boom_m, 1e-9, 'boom');
      near(distance(pose.arm_pin_m, pose.bucket_pin_m), machine.arm_m, 1e-9, 'arm');
      near(distance(pose.bucket_pin_m, pose.position_m), machine.bucket_m, 1e-9, 'bucket');
      near(distance(pose.rocker_pivot_m, pose.rocker_end_m), machine.linkage.rocker_m, 1e-9,
        'rocker');
      near(distance(pose.rocker_end_m, pose.lug_m), machine.linkage.coupler_m, 1e-9, 'coupler');
      near(distance(pose.bucket_pin_m, pose.lug_m), Math.hypot(...machine.linkage.lug_m), 1e-9,
        'lug');
      for (const point of [pose.position_m, pose.lug_m, cylinders.boom.base_m]) {
        near(point[0] * Math.sin(swing) - point[1] * Math.cos(swing), 0, 1e-9, 'plane of swing');
      }
    }
  });

  test(`${machine.name}: the way back from a pose`, () => {
    const next = random(35);
    for (let i = 0; i < 300; ++i) {
      const strokes = strokes_at(machine, next);
      const swing = machine.has_swing ? 6 * (next() - 0.5) : 0;
      const pose = excavatorPose(machine, strokes, swing)!;
      if (Math.hypot(pose.position_m[0], pose.position_m[1]) < 0.3 ||
          pose.position_m[0] * Math.cos(swing) + pose.position_m[1] * Math.sin(swing) < 0) {
        continue;  // over or behind the swing axis the machine would face the other way
      }
      const drives = drivesFromPose(machine, pose)!;
      strokes.forEach((stroke, axis) => near(drives[axis], stroke, 1e-7, `stroke ${axis}`));
      near(drives[3], swing, 1e-9, 'swing');
    }
  });
}

test('strokes for a pose are the controller\'s', () => {
  for (const [x, y, attitude] of [[5, -1, 1.4], [6.4, -2, 2], [3.6, 0.1, 0.9]]) {
    const told = graben_json('strokes', '--profile', 'excavator_22t', '--x', String(x),
      '--y', String(y), '--attitude', String(attitude));
    assert.equal(told.status, 'ok');
    const drives = drivesFromPose(EXCAVATOR_22T,
      {position_m: [x + 0.1, 0, y + 1.75], attitude_rad: attitude})!;
    for (let i = 0; i < 3; ++i) {
      near(drives[i], told.strokes_m[i], 1e-9, `stroke ${i}`);
    }
  }
});

test('what cannot be had is null, not a number', () => {
  assert.equal(drivesFromPose(EXCAVATOR_22T, {position_m: [20, 0, 0], attitude_rad: 1}), null);
  assert.equal(excavatorPose(EXCAVATOR_22T, [0.5, NaN, 0.5], 0), null);
  assert.equal(excavatorPose(EXCAVATOR_22T, [0.5, 0.5, 3], 0), null);  // the linkage opens
});

test('a stroke a little beyond its end still has a pose', () => {
  assert.notEqual(excavatorPose(EXCAVATOR_22T, [-0.005, 1.51, 0.5], 0), null);
});
