// SPDX-License-Identifier: Apache-2.0
/// Strokes of an excavator whose links carry IMUs in the place of stroke sensors. The bus tells
/// gyros and accelerometers alone; the angles that the controller makes of them stay in it. So the
/// page makes its own: each link's gyro is followed, and pulled slowly to where gravity says that
/// the link is, with what the links' own motion adds to gravity taken out. Good for a picture, some
/// centimetres at the teeth; nothing else goes by it.

import type {ExcavatorMachine, Imu, Vector2} from './api';
import {add, direction, minus, norm, polar, rotated, wrap_near} from './geometry';
import {arm_triangle, boom_triangle, bucket_in_turn, length_from_bucket, triangle_length} from './linkage';

/// Angles come to gravity's within this, and the gyros' biases within the second.
const ANGLE_S = 1.5;
const BIAS_S = 15;
/// Differences of a gyro's readings are noise: taken over this.
const TURN_S = 0.1;
/// Over a longer gap nobody knows how the links have turned.
const GAP_S = 0.3;
const GRAVITY: Vector2 = [0, 9.81];
const LINKS = ['boom', 'arm', 'bucket'] as const;

/// What one sensor shows, SI, in its own axes: pitch, roll, yaw; along and upright.
export interface ImuReading {
  time_s: number;  ///< When it was so.
  rates_radps: readonly [number, number, number];
  force_mps2: Vector2;
}

interface Link {
  angle_rad: number;     ///< Of the sensor's body against the horizontal.
  rate_radps: number;
  turn_radps2: number;
  bias_radps: number;
  time_s: number;
}

const seen_along = ({backwards}: Imu, [along, upright]: Vector2): Vector2 =>
  [backwards ? -along : along, upright];
/// A vector of the sensor's axes in its body's.
const in_body = (imu: Imu, v: Vector2): Vector2 => rotated(seen_along(imu, v), imu.turn_rad);

export class ImuStrokes {
  private links: Link[] = [];

  constructor(private readonly machine: ExcavatorMachine) {}

  /// Readings of boom, arm and bucket, as new as there are at `now_s`, in the order of time. Strokes
  /// in m of then; null before there is an angle, and where no cylinders have it.
  next(readings: readonly ImuReading[], now_s: number): readonly number[] | null {
    const imus = this.machine.imus;
    if (imus === undefined) {
      return null;
    }
    if (this.links.some((link, i) => !(readings[i]!.time_s - link.time_s < GAP_S))) {
      this.links = [];
    }
    const begins = this.links.length === 0;
    const before = begins ? LINKS.map((name, i) => this.at_rest(imus[name], readings[i]!)) : this.links;
    this.links = before.map((link, i) => this.turned(link, imus[LINKS[i]!], readings[i]!));
    const felt = this.felt(readings);
    this.links.forEach((link, i) => this.pull(link, before[i]!, imus[LINKS[i]!], readings[i]!, felt[i]!));
    return this.strokes(this.links.map(({angle_rad, rate_radps, time_s}) =>
      angle_rad + rate_radps * (now_s - time_s)));
  }

  private at_rest(imu: Imu, {force_mps2, time_s}: ImuReading): Link {
    const angle_rad = direction(GRAVITY) - direction(in_body(imu, force_mps2));
    return {angle_rad, rate_radps: 0, turn_radps2: 0, bias_radps: 0, time_s};
  }

  private turned(link: Link, imu: Imu, {time_s, rates_radps: [pitch]}: ImuReading): Link {
    const step_s = time_s - link.time_s;
    if (!(step_s > 0)) {
      return {...link};
    }
    const rate_radps = (imu.backwards ? -pitch : pitch) - link.bias_radps;
    const turn_radps2 = (rate_radps - link.rate_radps) / step_s;
    const share = Math.min(1, step_s / TURN_S);
    return {...link, time_s, rate_radps,
      turn_radps2: link.turn_radps2 + share * (turn_radps2 - link.turn_radps2),
      angle_rad: link.angle_rad + 0.5 * (rate_radps + link.rate_radps) * step_s};
  }

  /// Accelerations of the sensors' places in the plane that the swing faces, gravity with them.
  private felt(readings: readonly ImuReading[]): Vector2[] {
    const {machine} = this;
    const imus = machine.imus!;
    const [boom, arm, bucket] = this.links as [Link, Link, Link];
    const swing = this.swing_radps(imus.boom, boom, readings[0]!);
    const moved = ({angle_rad, rate_radps, turn_radps2}: Link, v: Vector2): [Vector2, Vector2] => {
      const [x, y] = rotated(v, angle_rad);
      return [[x, y], [-turn_radps2 * y - rate_radps ** 2 * x, turn_radps2 * x - rate_radps ** 2 * y]];
    };
    const chains: (readonly [Link, Vector2])[][] = [
      [[boom, imus.boom.at_m]],
      [[boom, [machine.boom_m, 0]], [arm, imus.arm.at_m]],
      [[boom, [machine.boom_m, 0]],
        [arm, imus.bucket.on_rocker ? machine.linkage.rocker_pivot_m : [machine.arm_m, 0]],
        [bucket, imus.bucket.at_m]]];
    return chains.map((chain) => {
      let place = machine.boom_foot_m;
      let sum = GRAVITY;
      for (const [link, v] of chain) {
        const [along, pull] = moved(link, v);
        place = add(place, along);
        sum = add(sum, pull);
      }
      return add(sum, [-(swing ** 2) * place[0], 0]);
    });
  }

  /// The gyros across the pitch see it along the upright.
  private swing_radps(imu: Imu, {angle_rad}: Link, {rates_radps: [, roll, yaw]}: ImuReading): number {
    const [along, upright] = seen_along(imu, rotated([0, 1], -angle_rad - imu.turn_rad));
    return this.machine.has_swing ? roll * along + yaw * upright : 0;
  }

  private pull(link: Link, before: Link, imu: Imu, {force_mps2}: ImuReading, felt: Vector2): void {
    const step_s = link.time_s - before.time_s;
    const told_rad = direction(felt) - direction(in_body(imu, force_mps2));
    const off_rad = wrap_near(told_rad - link.angle_rad, 0);
    if (step_s > 0 && Number.isFinite(off_rad)) {
      link.angle_rad += off_rad * Math.min(1, step_s / ANGLE_S);
      link.bias_radps -= off_rad * step_s / (ANGLE_S * BIAS_S);
    }
  }

  private strokes([boom, arm, bucket]: readonly number[]): readonly number[] | null {
    return strokes_of(this.machine, [boom!, arm! - boom!, bucket! - arm!],
      this.machine.imus!.bucket.on_rocker);
  }
}

/// Of joint angles; null where no cylinders have them. `on_rocker`: the last is of the linkage's
/// rocker against the arm, not of the bucket.
export function strokes_of(machine: ExcavatorMachine, joints: readonly number[],
  on_rocker = false): readonly number[] | null {
  const {cylinders, linkage} = machine;
  const [boom, arm, bucket] = joints.map((joint) => wrap_near(joint, 0));
  const lengths = [
    triangle_length(boom_triangle(machine), boom!),
    triangle_length(arm_triangle(machine), arm!),
    on_rocker
      ? norm(minus(add(linkage.rocker_pivot_m, polar(linkage.rocker_m, bucket!)), cylinders.bucket.base_m))
      : length_from_bucket(machine, bucket_in_turn(bucket!))];
  const closed = LINKS.map((name) => cylinders[name].closed_length_m);
  return lengths.some((length) => length === null) ? null
    : lengths.map((length, i) => length! - closed[i]!);
}

