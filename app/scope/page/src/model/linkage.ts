// SPDX-License-Identifier: Apache-2.0
/// What a cylinder's length makes of a joint, and back: a triangle of two fixed sides and the
/// cylinder for boom and arm, the four-bar linkage for the bucket. Closed forms, as the
/// controller's own (firmware/kinematics).

import type {ExcavatorMachine, Vector2} from './api';
import {add, clamp, direction, meet_left, minus, norm, rotated, wrap_near} from './geometry';

/// The bucket's range lies about here; angles are taken in the turn around it.
const BUCKET_CENTRE_RAD = -1.1;

/// Pins A on the parent and B on the child about a joint at the origin. `side` is +1 where B stands
/// counter-clockwise from A, -1 where clockwise: what the length alone leaves open.
export interface Triangle {
  parent_m: Vector2;
  child_m: Vector2;
  side: 1 | -1;
}

/// Joint angle at a length; one that the triangle can't have gives the nearest that it can.
export function triangle_angle(triangle: Triangle, length_m: number): number {
  const a = norm(triangle.parent_m);
  const b = norm(triangle.child_m);
  const cosine = (a * a + b * b - length_m * length_m) / (2 * a * b);
  const opening = Math.acos(clamp(cosine, -1, 1));
  return wrap_near(triangle.side * opening - offset_of(triangle), 0);
}

/// Length at a joint angle; null past the dead centre, where that length has another angle.
export function triangle_length(triangle: Triangle, angle_rad: number): number | null {
  const opening = offset_of(triangle) + angle_rad;
  if (triangle.side * wrap_near(opening, 0) < 0) {
    return null;
  }
  const a = norm(triangle.parent_m);
  const b = norm(triangle.child_m);
  return Math.sqrt(Math.max(0, a * a + b * b - 2 * a * b * Math.cos(opening)));
}

const offset_of = (triangle: Triangle): number =>
  direction(triangle.child_m) - direction(triangle.parent_m);

export const boom_triangle = (machine: ExcavatorMachine): Triangle => ({
  parent_m: machine.cylinders.boom.base_m, child_m: machine.cylinders.boom.eye_m, side: 1});

/// The arm's joint stands at the boom's tip.
export const arm_triangle = (machine: ExcavatorMachine): Triangle => ({
  parent_m: minus(machine.cylinders.arm.base_m, [machine.boom_m, 0]),
  child_m: machine.cylinders.arm.eye_m, side: -1});

/// The bucket's linkage at one cylinder length; points in the arm's frame.
export interface Linkage {
  angle_rad: number;      ///< Bucket against arm.
  rocker_end_m: Vector2;  ///< Where cylinder, rocker and coupler meet.
  lug_m: Vector2;
}

/// Null where rocker and coupler can't meet.
export function linkage_from_length(machine: ExcavatorMachine, length_m: number): Linkage | null {
  const {rocker_pivot_m, rocker_m, coupler_m, lug_m} = machine.linkage;
  const pin: Vector2 = [machine.arm_m, 0];
  const base = machine.cylinders.bucket.base_m;
  const end = meet_left(base, length_m, rocker_pivot_m, rocker_m);
  const lug = end && meet_left(end, coupler_m, pin, norm(lug_m));
  if (end === null || lug === null) {
    return null;
  }
  const angle = wrap_near(direction(minus(lug, pin)) - direction(lug_m), BUCKET_CENTRE_RAD);
  return {angle_rad: angle, rocker_end_m: end, lug_m: lug};
}

/// Cylinder length at a bucket angle; null where there is none that gives it.
export function length_from_bucket(machine: ExcavatorMachine, angle_rad: number): number | null {
  const {rocker_pivot_m, rocker_m, coupler_m, lug_m} = machine.linkage;
  const lug = add([machine.arm_m, 0], rotated(lug_m, angle_rad));
  const end = meet_left(rocker_pivot_m, rocker_m, lug, coupler_m);
  if (end === null) {
    return null;
  }
  const length = norm(minus(end, machine.cylinders.bucket.base_m));
  const same = linkage_from_length(machine, length);
  // The same length can belong to the linkage folded over.
  const off_rad = same === null ? NaN : Math.abs(wrap_near(same.angle_rad - angle_rad, 0));
  return off_rad < 1e-6 ? length : null;
}

export const bucket_in_turn = (angle_rad: number): number =>
  wrap_near(angle_rad, BUCKET_CENTRE_RAD);
