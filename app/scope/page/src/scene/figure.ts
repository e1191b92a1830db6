// SPDX-License-Identifier: Apache-2.0
/// The machines as flat shapes: the same pieces as in the scene, seen from the side, from above and
/// from behind.

import type {DozerMachine, ExcavatorMachine, Vector2, Vector3} from '../model/api';
import {type DozerPose, home_edge} from '../model/dozer';
import type {DozerAcross} from '../model/dozer_across';
import type {ExcavatorPose} from '../model/excavator';
import {add, direction, minus, rotated} from '../model/geometry';
import {dozer_shape, type DozerShape} from './dozer_shape';
import {excavator_shape, type ExcavatorShape} from './excavator_shape';
import {kPaints} from './paints';
import {type Piece, rectangle} from './pieces';

export interface Flat {
  outline: readonly Vector2[];
  paint: string;
}

/// A part where it is: what it is made of, its origin, its turn.
type Placed = readonly [readonly Piece[], Vector2, number];

const shapes = new WeakMap<object, unknown>();

function shape_of<M extends object, S>(machine: M, make: (machine: M) => S): S {
  let shape = shapes.get(machine) as S | undefined;
  if (shape === undefined) {
    shape = make(machine);
    shapes.set(machine, shape);
  }
  return shape;
}

/// The nearest last, as one sees them from the right.
function seen_from_side(placed: readonly Placed[]): Flat[] {
  return placed.flatMap(([pieces, at, turn]) => pieces
    .filter(({seen}) => seen === 'side')
    .sort((a, b) => b.to_m - a.to_m)
    .map(({outline, paint}) => ({
      outline: outline.map((point) => add(at, rotated(point, turn))), paint: kPaints[paint]})));
}

/// Over reach and height, in the plane that the swing faces.
export function excavator_side(machine: ExcavatorMachine, pose: ExcavatorPose): Flat[] {
  const shape = shape_of<ExcavatorMachine, ExcavatorShape>(machine, excavator_shape);
  const flat = ([x, y, z]: Vector3): Vector2 =>
    [x * Math.cos(pose.swing_rad) + y * Math.sin(pose.swing_rad), z];
  const foot = flat(pose.boom_foot_m);
  const [arm, bucket] = [flat(pose.arm_pin_m), flat(pose.bucket_pin_m)];
  const [pivot, end] = [flat(pose.rocker_pivot_m), flat(pose.rocker_end_m)];
  const [boom_rad, arm_rad, bucket_rad] = pose.directions_rad;
  return seen_from_side([
    [shape.undercarriage, [0, 0], 0], [shape.platform, [0, 0], 0],
    [shape.boom, foot, boom_rad], [shape.bucket, bucket, bucket_rad], [shape.arm, arm, arm_rad],
    [shape.rocker, pivot, direction(minus(end, pivot))],
    [shape.coupler, end, direction(minus(flat(pose.lug_m), end))]]);
}

export function dozer_side(machine: DozerMachine, pose: DozerPose): Flat[] {
  const shape = shape_of<DozerMachine, DozerShape>(machine, dozer_shape);
  return seen_from_side([
    [shape.body, pose.body_m, pose.pitch_rad],
    [shape.blade, pose.pivot_m, pose.pitch_rad + pose.blade_rad]]);
}

/// From above: x forward, y to the left.
function footprint({seen, outline, from_m, to_m}: Piece): readonly Vector2[] {
  if (seen === 'top') {
    return outline;
  }
  const along = outline.map(([x]) => x);
  return rectangle([Math.min(...along), Math.max(...along)], [from_m, to_m]);
}

function seen_from_above(placed: readonly Placed[]): Flat[] {
  return placed.flatMap(([pieces, at, turn]) => pieces.map((piece) => ({
    outline: footprint(piece).map((point) => add(at, rotated(point, turn))),
    paint: kPaints[piece.paint]})));
}

export function excavator_above(machine: ExcavatorMachine, pose: ExcavatorPose): Flat[] {
  const shape = shape_of<ExcavatorMachine, ExcavatorShape>(machine, excavator_shape);
  const reach = (pin: Vector3): number => Math.hypot(pin[0], pin[1]);
  const {widths} = shape;
  const beam = (from: number, to: number, width: number): Piece =>
    ({seen: 'top', outline: rectangle([from, to], [-0.5 * width, 0.5 * width]), from_m: 0, to_m: 0,
      paint: 'body'});
  const [foot, arm, bucket, teeth] = [pose.boom_foot_m, pose.arm_pin_m, pose.bucket_pin_m,
    pose.position_m].map(reach) as [number, number, number, number];
  const load: Piece = {...beam(Math.min(bucket, teeth), Math.max(bucket, teeth) + 0.05,
    widths.bucket_m), paint: 'steel'};
  return seen_from_above([
    [shape.undercarriage, [0, 0], 0], [shape.platform, [0, 0], pose.swing_rad],
    [[load, beam(arm, bucket, widths.arm_m), beam(foot, arm, 1.6 * widths.boom_m)], [0, 0],
      pose.swing_rad]]);
}

export function dozer_above(machine: DozerMachine, pose: DozerPose): Flat[] {
  const shape = shape_of<DozerMachine, DozerShape>(machine, dozer_shape);
  return seen_from_above([
    [shape.body, [pose.body_m[0], 0], 0], [shape.blade, [pose.pivot_m[0], 0], 0]]);
}

/// From behind: to the right and up, from the middle of the body's tracks or of the blade's edge.
function seen_from_behind(pieces: readonly Piece[], at: Vector2, left_up_rad: number): Flat[] {
  // The farthest first.
  const front = ({outline}: Piece): number => Math.min(...outline.map(([x]) => x));
  return [...pieces].sort((a, b) => front(b) - front(a)).map(({seen, outline, from_m, to_m, paint}) => {
    const second = outline.map(([, v]) => v);
    const own: Vector2 = [Math.min(...second), Math.max(...second)];
    const [y, z]: [Vector2, Vector2] = seen === 'side' ? [[from_m, to_m], own] : [own, [from_m, to_m]];
    // y is to the left.
    return {outline: rectangle([-y[1], -y[0]], z).map((point) => add(at, rotated(point, -left_up_rad))),
      paint: kPaints[paint]};
  });
}

/// Places in the picture, m: see DozerAcross.
export function dozer_behind(machine: DozerMachine, across: DozerAcross): Flat[] {
  const shape = shape_of<DozerMachine, DozerShape>(machine, dozer_shape);
  const {middle, left, right} = across;
  const edge_m = home_edge(machine)[1];
  // Without its arms, which are behind the body's nose; from the edge up, as it is this that turns.
  const board = shape.blade.filter(({from_m, to_m}) => Math.max(-from_m, to_m) > 0.4 * shape.blade_width_m)
    .map((piece): Piece => ({...piece, outline: piece.outline.map(([x, z]): Vector2 => [x, z - edge_m])}));
  const slope_rad = Math.atan2(left.at_m[1] - right.at_m[1], right.at_m[0] - left.at_m[0]);
  return [...seen_from_behind(board, middle.at_m, slope_rad),
    ...seen_from_behind(shape.body, [0, across.body_m], across.roll_rad)];
}
