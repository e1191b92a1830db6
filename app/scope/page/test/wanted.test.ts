// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {ExcavatorMachine, Pose, Task, Vector3} from '../src/model/api';
import {loadDatabase} from '../src/model/dbc';
import {drivesFromPose, excavatorPose} from '../src/model/excavator';
import {drive_signals, followed_velocity, velocity, velocity_curve} from '../src/model/motion';
import {ahead_on_path, excavatorDrives, wantedExcavator} from '../src/model/wanted';
import {EXCAVATOR_12T, EXCAVATOR_22T} from './machines';
import {line, protected_bytes, store_of} from './make';
import {graben_log} from './tool';

const near = (a: number, b: number, tolerance: number, what: string): void =>
  assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a}, not ${b}`);

const distance = (a: Vector3, b: Vector3): number =>
  Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

test('along a closed path', () => {
  const square: Vector3[] = [[0, 0, 0], [1, 0, 1], [1, 1, 2], [0, 1, 3], [0, 0, 0]];
  assert.deepEqual(ahead_on_path(square, [0.25, -1], 0), [0.25, 0, 0.25]);
  assert.deepEqual(ahead_on_path(square, [0.25, -1], 1.25).slice(0, 2), [1, 0.5]);
  assert.deepEqual(ahead_on_path(square, [-1, 0.25], 0.5).slice(0, 2), [0.25, 0]);
  assert.deepEqual(ahead_on_path(square, [0.25, 0], 4).slice(0, 2), [0.25, 0]);
});

const DIG = store_of(graben_log('dig'));

test('the measured teeth are as far from the path as the controller says', () => {
  const errors = DIG.rows('EcuHydraulics');
  let compared = 0;
  let sum_mm = 0;
  for (let row = 0; row < errors.count; row += 3) {
    const time_s = errors.time(row);
    const told = DIG.reading('EcuHydraulics.PathError', time_s);
    const drives = excavatorDrives(DIG, EXCAVATOR_22T, time_s);
    const pose = excavatorPose(EXCAVATOR_22T, [drives[0], drives[1], drives[2]], 0);
    const active = DIG.reading('EcuStatus.Mode', time_s - 0.03).raw === 3;
    if (!active || told.state !== 'valid' || pose === null) {
      continue;  // while it follows nothing, it says no error
    }
    const [x, , z] = pose.position_m;
    const [px, pz] = ahead_on_path(EXCAVATOR_22T.dig.path, [x, z], 0);
    const off_mm = Math.abs(1000 * Math.hypot(px - x, pz - z) - told.value);
    assert.ok(off_mm < 1.5, `${off_mm} mm at ${time_s}`);  // corners here are polygons
    sum_mm += off_mm;
    ++compared;
  }
  assert.ok(compared > 200);
  assert.ok(sum_mm / compared < 0.05, `${sum_mm / compared} mm`);  // the bus has steps of 0.1
});

test('digging, the ghost is on the path, a little ahead of the bucket', () => {
  let looked = 0;
  for (let time_s = DIG.from_s + 2; time_s < DIG.until_s - 1; time_s += 0.31) {
    const ghost = wantedExcavator(DIG, EXCAVATOR_22T, time_s);
    const next = excavatorDrives(DIG, EXCAVATOR_22T, time_s + 0.25);
    const then = excavatorPose(EXCAVATOR_22T, [next[0], next[1], next[2]], 0);
    if (ghost === null || then === null) {
      continue;
    }
    assert.ok(distance(ghost.pose.position_m, then.position_m) < 0.07, `ghost at ${time_s}`);
    assert.ok(Math.abs(ghost.pose.attitude_rad - then.attitude_rad) < 0.1);
    const back = excavatorPose(EXCAVATOR_22T,
      [ghost.drives![0], ghost.drives![1], ghost.drives![2]], 0)!;
    assert.ok(distance(back.position_m, ghost.pose.position_m) < 1e-6);
    ++looked;
  }
  assert.ok(looked > 10);
  assert.equal(wantedExcavator(DIG, EXCAVATOR_22T, DIG.from_s), null);  // not active yet
});

/// The one line of app/machines/tasks/flatten.toml.
function with_task(straight: boolean): ExcavatorMachine {
  const from: Pose = {position_m: [0, 6.866, 0], attitude_rad: 2.268928};
  const to: Pose = {position_m: [2.244, 3.886, 0], attitude_rad: 1.22173};
  const task: Task = {
    name: 'flatten', fences: [], design: null,
    steps: [{kind: 'dig', straight, from, to, duration_s: 18.4, raised_from_m: 0, raised_to_m: 0,
      from_drives: drivesFromPose(EXCAVATOR_12T, from)!,
      to_drives: drivesFromPose(EXCAVATOR_12T, to)!}],
  };
  return {...EXCAVATOR_12T, tasks: [task]};
}

test('on a task, the ghost is on the line where its progress is', () => {
  const store = store_of(graben_log('autodig', '--task', 'flatten'));
  const machine = with_task(true);
  let looked = 0;
  let worst_m = 0;
  for (let time_s = store.from_s; time_s < store.until_s; time_s += 0.25) {
    const ghost = wantedExcavator(store, machine, time_s);
    if (ghost === null) {
      continue;
    }
    const [boom, arm, bucket, swing] = excavatorDrives(store, machine, time_s);
    const now = excavatorPose(machine, [boom, arm, bucket], swing)!;
    worst_m = Math.max(worst_m, distance(now.position_m, ghost.pose.position_m));
    near(ghost.pose.position_m[2], 0, 1e-9, 'a level line');
    ++looked;
  }
  assert.ok(looked > 40);
  assert.ok(worst_m < 0.05, `${worst_m} m from the plan`);
});

test('a step in drive space is followed in drive space', () => {
  const db = loadDatabase('excavator');
  const [status, operator, task, boom] = ['EcuStatus', 'OperatorCommand', 'TaskStatus',
    'BoomStroke'].map((name) => db.messages.get(name)!);
  const word = Math.round(0.25 / 0.00002);
  const command = protected_bytes(operator.data_id, 0, 1);
  command[3] = 3;
  const store = store_of(line(1, boom.id, protected_bytes(boom.data_id, 0, 5)) +
    line(1, status.id, [3, 0, 0x50, 0xc3, 0, 0, 0, 0]) + line(1, operator.id, command) +
    line(1, task.id, [0, 0, 2, word & 255, word >> 8, 0, 125, 255]));
  const machine = with_task(false);
  const [step] = machine.tasks[0].steps;
  const ghost = wantedExcavator(store, machine, 1)!;
  ghost.drives!.forEach((drive, i) => near(drive,
    0.75 * step.from_drives[i] + 0.25 * step.to_drives[i], 1e-12, `drive ${i}`));
  assert.equal(wantedExcavator(store, {...machine, tasks: []}, 1), null);
});

test('real velocities are lambda times the wanted ones, on the whole', () => {
  const [boom] = drive_signals('excavator', false);
  let [off, size, looked] = [0, 0, 0];
  for (let time_s = DIG.from_s + 2; time_s < DIG.until_s - 1; time_s += 0.1) {
    const real = velocity(DIG, boom.measured, time_s).value;
    const followed = followed_velocity(DIG, boom, time_s - 0.06).value;
    if (Number.isFinite(real) && Number.isFinite(followed)) {
      off += Math.abs(real - followed);
      size += Math.abs(followed);
      ++looked;
    }
  }
  assert.ok(looked > 50);
  assert.ok(off < 0.15 * size, `${off / looked} mm/s of ${size / looked} mm/s`);
});

test('a velocity is the slope of its stroke', () => {
  const boom = loadDatabase('excavator').messages.get('BoomStroke')!;
  const text = Array.from({length: 400}, (_, i) => line(1 + 0.01 * i, boom.id,
    protected_bytes(boom.data_id, 0, i === 300 ? 0xffff : 1000 + 20 * i))).join('');
  const store = store_of(text);  // 1 mm in 10 ms
  const curve = velocity_curve(store, 'BoomStroke.BoomStroke', 1.5, 3.5, 1000);
  assert.ok(curve.time_s.length > 190);
  curve.value.forEach((value) => near(value, 100, 1e-6, 'slope'));
  const coarse = velocity_curve(store, 'BoomStroke.BoomStroke', 1.5, 3.5, 20);
  assert.ok(coarse.time_s.length <= 50);
  near(velocity(store, 'BoomStroke.BoomStroke', 2).value, 100, 1e-6, 'in the middle');
  near(velocity(store, 'BoomStroke.BoomStroke', 4.99).value, 100, 1e-6, 'at the end');
  assert.ok(Number.isNaN(velocity(store, 'BoomStroke.BoomStroke', 4.005).value), 'not available');
  const broken = velocity_curve(store, 'BoomStroke.BoomStroke', 3.5, 4.5, 1000);
  assert.ok(broken.value.some(Number.isNaN));
});
