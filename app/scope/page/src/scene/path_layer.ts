// SPDX-License-Identifier: Apache-2.0
/// What an excavator's teeth are meant to do: the digging path with the field around it, or the
/// steps of a task.

import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, GreaterDepth, Group, Mesh,
  MeshBasicMaterial,
} from 'three';
import type {Dig, ExcavatorMachine, Task, Vector3} from '../model/api';
import {excavatorPose} from '../model/excavator';
import type {Labels} from './labels';
import {chained, Lines} from './lines';
import {kOrder} from './materials';
import {simplified} from './outline';
import type {SceneColours} from './theme';

/// Points of a move that is straight in drive space only.
const kMoveSteps = 24;

/// The path lies in the plane that the swing faces: its node turns with the platform.
export class DigLayer {
  readonly path = new Group();
  readonly field = new Group();
  private readonly line: Lines;
  private readonly arrows: Mesh<BufferGeometry, MeshBasicMaterial>;
  private readonly buried: Mesh<BufferGeometry, MeshBasicMaterial>;

  constructor(dig: Dig) {
    const points = simplified(dig.path.map(([x, z]): Vector3 => [x, 0, z]), 0.002);
    this.line = new Lines({width_px: 3.5, seen_through: true}, chained(points, true));
    this.path.add(this.line.node);
    const shape = arrows(dig);
    this.arrows = new Mesh(shape, new MeshBasicMaterial({side: DoubleSide}));
    this.arrows.renderOrder = kOrder.lines;
    this.buried = new Mesh(shape, new MeshBasicMaterial({
      side: DoubleSide, depthFunc: GreaterDepth, depthWrite: false}));
    this.buried.renderOrder = kOrder.hidden;
    this.field.add(this.arrows, this.buried);
  }

  turn(swing_rad: number): void {
    this.path.rotation.z = swing_rad;
    this.field.rotation.z = swing_rad;
  }

  set_theme(colours: SceneColours): void {
    this.line.set_colour(colours.path, colours.cut);
    this.arrows.material.color.copy(field_colour(colours));
    this.buried.material.color.set(colours.path).lerp(new Color(colours.soil), 0.65);
  }

  dispose(): void {
    this.line.dispose();
    this.arrows.geometry.dispose();
    this.arrows.material.dispose();
    this.buried.material.dispose();
  }
}

export const field_colour = (colours: SceneColours): Color =>
  new Color(colours.path).lerp(new Color(colours.ground), 0.25);

/// What the longest arrow stands for; 0 without a field.
export const fastest_mps = (dig: Dig): number =>
  dig.field.reduce((most, [, , x, z]) => Math.max(most, Math.hypot(x, z)), 0);

/// Flat arrows in the field's plane: as long as the way of some tenths of a second, none longer
/// than the places of the field are apart.
function arrows(dig: Dig): BufferGeometry {
  const places = dig.field;
  const fastest = Math.max(fastest_mps(dig), 1e-6);
  const longest = 0.85 * apart(places);
  const list: number[] = [];
  for (const [x, z, vx, vz] of places) {
    const speed = Math.hypot(vx, vz);
    if (speed > 1e-6) {
      arrow(list, x, z, vx / speed, vz / speed, longest * speed / fastest, longest);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(list), 3));
  return geometry;
}

/// Shaft and head, centred on the place.
function arrow(
  list: number[], x: number, z: number, dx: number, dz: number, length: number, size: number,
): void {
  const head = Math.min(0.32 * size, 0.6 * length);
  const put = (along: number, across: number): void => {
    list.push(x + along * dx - across * dz, 0, z + along * dz + across * dx);
  };
  const [tail, neck, tip] = [-0.5 * length, 0.5 * length - head, 0.5 * length];
  const thin = 0.035 * size;
  put(tail, -thin); put(neck, -thin); put(neck, thin);
  put(tail, -thin); put(neck, thin); put(tail, thin);
  put(neck, -0.42 * head); put(tip, 0); put(neck, 0.42 * head);
}

/// Least distance between the first place and another.
function apart(places: Dig['field']): number {
  const [first, ...others] = places;
  const least = Math.min(...others.map(([x, z]) => Math.hypot(x - first![0], z - first![1])), 1);
  return Math.max(least, 0.05);
}

/// The steps of one task, numbered from 1, with their ends.
export class TaskLayer {
  readonly node = new Group();
  private readonly straight: Lines;
  private readonly moves: Lines;
  private readonly ends: Lines;
  private readonly poses: Lines;

  /// With `has_poses` the bucket is drawn along straight steps, as a line from the teeth to its pin.
  constructor(machine: ExcavatorMachine, private readonly task: Task, has_poses = false) {
    const {steps} = task;
    this.straight = new Lines({width_px: 3.5, seen_through: true}, steps
      .filter((step) => step.straight)
      .flatMap((step) => [step.from.position_m, step.to.position_m]));
    this.moves = new Lines({width_px: 2, seen_through: true, dashed: true}, steps
      .filter((step) => !step.straight)
      .flatMap((step) => chained(simplified(way_of(machine, step), 0.005))));
    this.ends = new Lines({width_px: 2.5, seen_through: true}, steps.flatMap((step) =>
      [...cross(step.from.position_m), ...cross(step.to.position_m)]));
    this.poses = new Lines({width_px: 2, seen_through: true}, !has_poses ? [] : steps
      .filter((step) => step.straight)
      .flatMap((step) => buckets_along(machine, step)));
    this.node.add(this.straight.node, this.moves.node, this.ends.node, this.poses.node);
  }

  label(labels: Labels): void {
    this.task.steps.forEach((step, i) => {
      const middle = step.from.position_m.map(
        (from, axis) => 0.5 * (from + step.to.position_m[axis])) as unknown as Vector3;
      labels.put(`step${i}`, 'path', `${i + 1} ${step.kind}`, middle);
    });
  }

  set_theme(colours: SceneColours): void {
    for (const lines of [this.straight, this.moves, this.ends, this.poses]) {
      lines.set_colour(colours.path, colours.cut);
    }
  }

  dispose(): void {
    [this.straight, this.moves, this.ends, this.poses].forEach((lines) => lines.dispose());
  }
}

/// So many poses of the bucket, the ends with them.
const kPoses = 7;

function buckets_along(machine: ExcavatorMachine, step: Task['steps'][number]): Vector3[] {
  const points: Vector3[] = [];
  for (let i = 0; i < kPoses; ++i) {
    const share = i / (kPoses - 1);
    const mixed = (from: number, to: number): number => from + share * (to - from);
    const [x, y, z] = step.from.position_m.map((from, axis) =>
      mixed(from, step.to.position_m[axis]!)) as unknown as Vector3;
    const attitude = mixed(step.from.attitude_rad, step.to.attitude_rad);
    // The bucket stands in the plane that the swing faces.
    const swing = Math.atan2(y, x);
    const out = machine.bucket_m * Math.cos(attitude);
    points.push([x, y, z], [x + out * Math.cos(swing), y + out * Math.sin(swing),
      z + machine.bucket_m * Math.sin(attitude)]);
  }
  return points;
}

function way_of(machine: ExcavatorMachine, step: Task['steps'][number]): Vector3[] {
  const points: Vector3[] = [];
  for (let i = 0; i <= kMoveSteps; ++i) {
    const at = (drive: number): number => {
      const from = step.from_drives[drive] ?? 0;
      return from + (i / kMoveSteps) * ((step.to_drives[drive] ?? 0) - from);
    };
    const pose = excavatorPose(machine, [at(0), at(1), at(2)], at(3));
    if (pose) {
      points.push(pose.position_m);
    }
  }
  return points;
}

function cross([x, y, z]: Vector3): Vector3[] {
  const arm = 0.12;
  return [
    [x - arm, y, z], [x + arm, y, z], [x, y - arm, z], [x, y + arm, z],
    [x, y, z - arm], [x, y, z + arm]];
}
