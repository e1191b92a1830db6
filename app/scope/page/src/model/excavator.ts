// SPDX-License-Identifier: Apache-2.0
/// Where every pin of an excavator is, from its strokes and swing, and the way back. The ground
/// frame of api.ts: x forward, y to the left, z up, origin where the swing axis meets the ground.

import type {ExcavatorMachine, Pose, Vector2, Vector3} from './api';
import {add, direction, norm, polar, rotated, wrap_near} from './geometry';
import {
  arm_triangle, boom_triangle, bucket_in_turn, length_from_bucket, linkage_from_length,
  triangle_angle, triangle_length,
} from './linkage';

/// Boom, arm, bucket strokes in m from the closed cylinder.
export type Strokes = readonly [number, number, number];
/// The strokes and the swing in rad.
export type Drives = readonly [number, number, number, number];

/// A cylinder's two pins.
export interface CylinderPins {
  base_m: Vector3;
  eye_m: Vector3;
}

export interface ExcavatorPose extends Pose {
  joints_rad: Vector3;       ///< Boom against the horizontal, arm against boom, bucket against arm.
  directions_rad: Vector3;   ///< Boom, arm and bucket against the horizontal that the swing faces.
  swing_rad: number;
  boom_foot_m: Vector3;
  arm_pin_m: Vector3;        ///< Boom to arm.
  bucket_pin_m: Vector3;     ///< Arm to bucket.
  cylinders: {boom: CylinderPins; arm: CylinderPins; bucket: CylinderPins};
  rocker_pivot_m: Vector3;   ///< On the arm.
  rocker_end_m: Vector3;     ///< Rocker, coupler and bucket cylinder meet here.
  lug_m: Vector3;            ///< Coupler's pin on the bucket.
}

/// A point of the plane that the swing faces (forward of the swing axis, above ground), in space.
export const in_space = (point_m: Vector2, swing_rad: number): Vector3 =>
  [point_m[0] * Math.cos(swing_rad), point_m[0] * Math.sin(swing_rad), point_m[1]];

/// Null where the bucket's linkage can't close at that stroke, or a number is none. Strokes beyond
/// the cylinders' ends are taken as they come: a sensor that says so is to be seen.
export function excavatorPose(
  machine: ExcavatorMachine, strokes_m: Strokes, swing_rad: number): ExcavatorPose | null {
  const {boom, arm, bucket} = machine.cylinders;
  const linkage = linkage_from_length(machine, bucket.closed_length_m + strokes_m[2]);
  if (linkage === null || ![...strokes_m, swing_rad].every(Number.isFinite)) {
    return null;
  }
  const joints: Vector3 = [
    triangle_angle(boom_triangle(machine), boom.closed_length_m + strokes_m[0]),
    triangle_angle(arm_triangle(machine), arm.closed_length_m + strokes_m[1]),
    linkage.angle_rad,
  ];
  const directions: Vector3 =
    [joints[0], joints[0] + joints[1], joints[0] + joints[1] + joints[2]];
  const foot = machine.boom_foot_m;
  const arm_pin = add(foot, polar(machine.boom_m, directions[0]));
  const bucket_pin = add(arm_pin, polar(machine.arm_m, directions[1]));
  const teeth = add(bucket_pin, polar(machine.bucket_m, directions[2]));
  const space = (point: Vector2): Vector3 => in_space(point, swing_rad);
  const of_body = (pin: Vector2): Vector3 => space(add(foot, pin));
  const of_boom = (pin: Vector2): Vector3 => space(add(foot, rotated(pin, directions[0])));
  const of_arm = (pin: Vector2): Vector3 => space(add(arm_pin, rotated(pin, directions[1])));
  const rocker_end = of_arm(linkage.rocker_end_m);
  return {
    position_m: space(teeth),
    attitude_rad: directions[2] + Math.PI,
    joints_rad: joints,
    directions_rad: directions,
    swing_rad,
    boom_foot_m: space(foot),
    arm_pin_m: space(arm_pin),
    bucket_pin_m: space(bucket_pin),
    cylinders: {
      boom: {base_m: of_body(boom.base_m), eye_m: of_boom(boom.eye_m)},
      arm: {base_m: of_boom(arm.base_m), eye_m: of_arm(arm.eye_m)},
      bucket: {base_m: of_arm(bucket.base_m), eye_m: rocker_end},
    },
    rocker_pivot_m: of_arm(machine.linkage.rocker_pivot_m),
    rocker_end_m: rocker_end,
    lug_m: of_arm(linkage.lug_m),
  };
}

/// Strokes and swing that bring the teeth to the pose, elbow up, the machine facing its teeth. Null
/// where boom and arm do not reach or a linkage does not close; a stroke outside its cylinder is
/// given as it would have to be. Without a swing drive the swing stays 0 and y is taken into reach.
export function drivesFromPose(machine: ExcavatorMachine, pose: Pose): Drives | null {
  const joints = joints_from_pose(machine, pose);
  if (joints === null) {
    return null;
  }
  const boom = triangle_length(boom_triangle(machine), joints[0]);
  const arm = triangle_length(arm_triangle(machine), joints[1]);
  const bucket = length_from_bucket(machine, joints[2]);
  if (boom === null || arm === null || bucket === null) {
    return null;
  }
  const {cylinders} = machine;
  return [
    boom - cylinders.boom.closed_length_m,
    arm - cylinders.arm.closed_length_m,
    bucket - cylinders.bucket.closed_length_m,
    machine.has_swing ? Math.atan2(pose.position_m[1], pose.position_m[0]) : 0,
  ];
}

function joints_from_pose(machine: ExcavatorMachine, pose: Pose): Vector3 | null {
  const [x, y, z] = pose.position_m;
  const tip: Vector2 =
    [Math.hypot(x, y) - machine.boom_foot_m[0], z - machine.boom_foot_m[1]];
  const pin = add(tip, polar(machine.bucket_m, pose.attitude_rad));
  const {boom_m, arm_m} = machine;
  const cosine = (norm(pin) ** 2 - boom_m ** 2 - arm_m ** 2) / (2 * boom_m * arm_m);
  if (!(cosine >= -1 && cosine <= 1)) {
    return null;
  }
  const arm = -Math.acos(cosine);
  const elbow = Math.atan2(arm_m * Math.sin(arm), boom_m + arm_m * Math.cos(arm));
  const boom = wrap_near(direction(pin) - elbow, 0);
  return [boom, arm, bucket_in_turn(pose.attitude_rad - Math.PI - boom - arm)];
}
