// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Vector3} from 'three';
import type {ExcavatorMachine, Vector2} from '../src/model/api';
import {bladeLinkage, dozerPose} from '../src/model/dozer';
import {excavatorPose} from '../src/model/excavator';
import {cylinder_places} from '../src/scene/cylinder';
import {DozerModel} from '../src/scene/dozer_model';
import {dozer_shape} from '../src/scene/dozer_shape';
import {ExcavatorModel} from '../src/scene/excavator_model';
import {excavator_shape} from '../src/scene/excavator_shape';
import {SharedMaterials} from '../src/scene/materials';
import {doubled_area, hull_of_discs, simplified} from '../src/scene/outline';
import type {Piece} from '../src/scene/pieces';
import {plane_outline} from '../src/scene/planes';
import {solid} from '../src/scene/solid';
import {DOZER_9T, EXCAVATOR_12T, EXCAVATOR_22T} from './machines';
import {random} from './make';

const EXCAVATORS = [EXCAVATOR_22T, EXCAVATOR_12T];

function inside(outline: readonly Vector2[], [x, y]: Vector2): boolean {
  let odd = false;
  outline.forEach(([ax, ay], i) => {
    const [bx, by] = outline[(i + 1) % outline.length];
    if (ay > y !== by > y && x < ax + (bx - ax) * (y - ay) / (by - ay)) {
      odd = !odd;
    }
  });
  return odd;
}

/// Steel around a pin, the pin itself not counted.
const held = (pieces: readonly Piece[], at_m: Vector2): boolean => pieces.some((piece) =>
  piece.seen === 'side' && piece.paint !== 'steel' && inside(piece.outline, at_m));

test('every pin of an excavator is in the steel of the parts that it joins', () => {
  for (const machine of EXCAVATORS) {
    const shape = excavator_shape(machine);
    const {cylinders, linkage, boom_foot_m} = machine;
    const body = (pin: Vector2): Vector2 => [pin[0] + boom_foot_m[0], pin[1] + boom_foot_m[1]];
    const pins: [readonly Piece[], Vector2, string][] = [
      [shape.platform, body([0, 0]), 'boom foot'],
      [shape.platform, body(cylinders.boom.base_m), 'boom cylinder'],
      [shape.boom, [0, 0], 'boom foot'], [shape.boom, [machine.boom_m, 0], 'arm pin'],
      [shape.boom, cylinders.boom.eye_m, 'boom rod'],
      [shape.boom, cylinders.arm.base_m, 'arm cylinder'],
      [shape.arm, [0, 0], 'arm pin'], [shape.arm, [machine.arm_m, 0], 'bucket pin'],
      [shape.arm, cylinders.arm.eye_m, 'arm rod'],
      [shape.arm, cylinders.bucket.base_m, 'bucket cylinder'],
      [shape.arm, linkage.rocker_pivot_m, 'rocker'],
      [shape.bucket, [0, 0], 'bucket pin'], [shape.bucket, linkage.lug_m, 'lug'],
      [shape.rocker, [linkage.rocker_m, 0], 'rocker end'],
      [shape.coupler, [linkage.coupler_m, 0], 'coupler end'],
    ];
    for (const [pieces, at, name] of pins) {
      assert.ok(held(pieces, at), `${machine.name}: ${name}`);
    }
  }
});

test('teeth end where the profile has the tip, tracks stand on the ground', () => {
  for (const machine of EXCAVATORS) {
    const {bucket, undercarriage} = excavator_shape(machine);
    const points = bucket.flatMap(({outline}) => outline);
    const farthest = points.reduce((a, b) => (Math.hypot(...b) > Math.hypot(...a) ? b : a));
    assert.deepEqual(farthest, [machine.bucket_m, 0]);
    const heights = undercarriage.filter(({seen}) => seen === 'side')
      .flatMap(({outline}) => outline.map(([, z]) => z));
    assert.ok(Math.abs(Math.min(...heights)) < 0.005, `${Math.min(...heights)}`);
  }
});

test('the nodes put the teeth where the kinematics have them', () => {
  const next = random(3);
  for (const machine of EXCAVATORS) {
    const model = new ExcavatorModel(machine, new SharedMaterials());
    for (let i = 0; i < 50; ++i) {
      const {boom, arm, bucket} = machine.cylinders;
      const pose = excavatorPose(machine, [
        next() * boom.stroke_m, next() * arm.stroke_m, next() * bucket.stroke_m],
      machine.has_swing ? 6 * next() - 3 : 0)!;
      model.pose(pose);
      const tip = model.teeth.getWorldPosition(new Vector3()).toArray();
      tip.forEach((part, axis) =>
        assert.ok(Math.abs(part - pose.position_m[axis]) < 1e-6, `${tip} ${pose.position_m}`));
    }
  }
});

test('cylinders reach from pin to pin and end in their rods', () => {
  const machine: ExcavatorMachine = EXCAVATOR_22T;
  const model = new ExcavatorModel(machine, new SharedMaterials());
  const {boom, arm, bucket} = machine.cylinders;
  for (const share of [0, 0.3, 1]) {
    const pose = excavatorPose(
      machine, [share * boom.stroke_m, share * arm.stroke_m, share * bucket.stroke_m], 0)!;
    model.pose(pose);
    model.node.updateMatrixWorld(true);
    const ends = model.cylinder_ends();
    assert.equal(ends.length, 4);
    for (const {axis, base, eye} of ends) {
      const {base_m, eye_m} = pose.cylinders[axis];
      assert.ok(Math.hypot(base.x - base_m[0], base.z - base_m[2]) < 1e-6, axis);
      assert.ok(Math.hypot(eye.x - eye_m[0], eye.z - eye_m[2]) < 1e-6, axis);
    }
  }
});

test('a piston stays in its barrel over the whole stroke', () => {
  for (const {cylinders} of EXCAVATORS) {
    for (const cylinder of Object.values(cylinders)) {
      let before = -1;
      for (let i = 0; i <= 10; ++i) {
        const length = cylinder.closed_length_m + cylinder.stroke_m * i / 10;
        const {cap_m, piston_m, gland_m, eye_m} = cylinder_places(cylinder, length);
        assert.ok(cap_m < piston_m && piston_m < gland_m && gland_m < eye_m, `${i}`);
        assert.ok(piston_m > before && eye_m === length);
        before = piston_m;
      }
    }
  }
});

test('the blade is before its tracks, its edge where the profile has it', () => {
  const {body, blade} = dozer_shape(DOZER_9T);
  const {pivot_m, cutting_edge_m} = DOZER_9T.blade;
  const points = blade.flatMap(({outline}) => outline);
  const lowest = points.reduce((a, b) => (b[1] < a[1] ? b : a));
  assert.ok(Math.abs(lowest[1] + pivot_m[1]) < 1e-9, 'on the ground at home');
  assert.ok(points.some((point) =>
    Math.abs(Math.hypot(...point) - cutting_edge_m) < 1e-9 && point[1] < -0.3), 'edge');
  const front = Math.max(...body.filter(({paint}) => paint === 'belt')
    .flatMap(({outline}) => outline.map(([x]) => x)));
  const board = Math.min(...blade.filter(({to_m}) => to_m > 1.1)
    .flatMap(({outline}) => outline.map(([x]) => x))) + pivot_m[0];
  assert.ok(board > front, `${board} ${front}`);
  const eye = bladeLinkage(DOZER_9T).l12_m / Math.hypot(...DOZER_9T.blade.arm_m);
  assert.ok(held(blade, [eye * DOZER_9T.blade.arm_m[0], eye * DOZER_9T.blade.arm_m[1]]), 'rod eye');
  assert.ok(held(body, DOZER_9T.blade.base_m), 'cylinder');
});

test('the nodes put the blade\'s edge where the kinematics have it', () => {
  const next = random(4);
  const model = new DozerModel(DOZER_9T, new SharedMaterials());
  for (let i = 0; i < 50; ++i) {
    const pose = dozerPose(DOZER_9T, {
      position_m: 30 * next(), height_m: next() - 0.5, pitch_rad: 0.6 * (next() - 0.5),
      blade_stroke_m: next() * bladeLinkage(DOZER_9T).stroke_max_m})!;
    model.pose(pose);
    const edge = model.edge.getWorldPosition(new Vector3());
    assert.ok(Math.hypot(edge.x - pose.edge_m[0], edge.z - pose.edge_m[1], edge.y) < 1e-6);
  }
});

test('solids are closed and face outwards', () => {
  const shape = excavator_shape(EXCAVATOR_22T);
  for (const pieces of [shape.boom, shape.bucket, shape.undercarriage, shape.platform]) {
    for (const piece of pieces) {
      const position = solid([piece]).getAttribute('position');
      const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
      let volume = 0;
      for (let i = 0; i < position.count; i += 3) {
        a.fromBufferAttribute(position, i);
        b.fromBufferAttribute(position, i + 1);
        c.fromBufferAttribute(position, i + 2);
        volume += a.dot(b.cross(c)) / 6;
      }
      const area = Math.abs(doubled_area(piece.outline)) / 2 -
        Math.abs(doubled_area(piece.hole ?? [])) / 2;
      const real = area * (piece.to_m - piece.from_m);
      assert.ok(Math.abs(volume - real) < 1e-4 * Math.max(real, 0.01), `${volume} ${real}`);
    }
  }
});

test('a hull holds its discs, a simplified line stays near what it was', () => {
  const discs = [{at_m: [0, 0], radius_m: 1}, {at_m: [4, 1], radius_m: 0.5}] as const;
  const hull = hull_of_discs(discs);
  assert.ok(doubled_area(hull) > 0);
  assert.ok(inside(hull, [-0.9, 0]) && inside(hull, [4.4, 1]) && inside(hull, [2, 1.1]));
  assert.ok(!inside(hull, [2, 1.4]) && !inside(hull, [5, 1]));
  const wave = Array.from({length: 200}, (_, i): Vector2 => [i / 20, Math.sin(i / 20)]);
  const left = simplified(wave, 0.01);
  assert.ok(left.length < 40 && left.length > 10, `${left.length}`);
  assert.deepEqual([left[0], left[left.length - 1]], [wave[0], wave[199]]);
});

test('what is shown of a plane lies in it', () => {
  for (const normal of [[0, 0, 1], [0, 1, 0], [0.6, 0, 0.8], [-0.8, 0, 0.6]] as const) {
    const through = [1, 2, -0.5] as const;
    for (const corner of plane_outline(through, normal, 8)) {
      const off = normal.reduce((sum, part, i) => sum + part * (corner[i] - through[i]), 0);
      assert.ok(Math.abs(off) < 1e-9 && Math.hypot(...corner) < 20, `${normal}: ${corner}`);
    }
  }
});
