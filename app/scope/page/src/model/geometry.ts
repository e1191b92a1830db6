// SPDX-License-Identifier: Apache-2.0
/// Plane geometry that both machines' kinematics share.

import type {Vector2} from './api';

export const add = (a: Vector2, b: Vector2): Vector2 => [a[0] + b[0], a[1] + b[1]];
export const minus = (a: Vector2, b: Vector2): Vector2 => [a[0] - b[0], a[1] - b[1]];
export const scaled = (a: Vector2, by: number): Vector2 => [a[0] * by, a[1] * by];
export const norm = (a: Vector2): number => Math.hypot(a[0], a[1]);
export const direction = (a: Vector2): number => Math.atan2(a[1], a[0]);

export const polar = (length: number, angle_rad: number): Vector2 =>
  [length * Math.cos(angle_rad), length * Math.sin(angle_rad)];

export function rotated(a: Vector2, angle_rad: number): Vector2 {
  const c = Math.cos(angle_rad);
  const s = Math.sin(angle_rad);
  return [c * a[0] - s * a[1], s * a[0] + c * a[1]];
}

export const clamp = (value: number, least: number, most: number): number =>
  Math.min(Math.max(value, least), most);

/// Equivalent of the angle in [centre - pi, centre + pi).
export const wrap_near = (angle_rad: number, centre_rad: number): number =>
  angle_rad - 2 * Math.PI * Math.floor((angle_rad - centre_rad + Math.PI) / (2 * Math.PI));

/// Where circles about `from` and `to` meet, on the left of from -> to; null where they do not.
export function meet_left(
  from: Vector2, from_radius: number, to: Vector2, to_radius: number): Vector2 | null {
  const line = minus(to, from);
  const distance = norm(line);
  if (!(distance > 0)) {
    return null;
  }
  const along = (from_radius ** 2 - to_radius ** 2 + distance ** 2) / (2 * distance);
  const height_squared = from_radius ** 2 - along ** 2;
  if (!(height_squared >= 0)) {
    return null;
  }
  const unit = scaled(line, 1 / distance);
  const left: Vector2 = [-unit[1], unit[0]];
  return add(from, add(scaled(unit, along), scaled(left, Math.sqrt(height_squared))));
}
