// SPDX-License-Identifier: Apache-2.0
/// Where a task keeps the machine out, seen from above.

import type {Vector2, Vector3} from '../model/api';

/// As Fence of api.ts has it.
export interface KeepOut {
  round?: boolean;
  centre_m: Vector3;
  half_m: Vector3;
  turn_rad?: number;
}

const kCorners = 32;
/// From above, counterclockwise: a box's four corners, or those that a cylinder is drawn with.
export function keep_out_ring({round, centre_m, half_m, turn_rad = 0}: KeepOut): Vector2[] {
  const place = (u: number, v: number): Vector2 => [
    centre_m[0] + u * Math.cos(turn_rad) - v * Math.sin(turn_rad),
    centre_m[1] + u * Math.sin(turn_rad) + v * Math.cos(turn_rad)];
  if (round) {
    return Array.from({length: kCorners}, (_, i) => {
      const angle = 2 * Math.PI * i / kCorners;
      return place(half_m[0] * Math.cos(angle), half_m[1] * Math.sin(angle));
    });
  }
  const [a, b] = half_m;
  return [place(-a, -b), place(a, -b), place(a, b), place(-a, b)];
}
