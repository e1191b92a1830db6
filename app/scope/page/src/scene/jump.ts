// SPDX-License-Identifier: Apache-2.0
/// Steps that no machine makes: a simulation that began anew, another log after the first, or a
/// sensor that tells wrong.

import type {Vector3} from '../model/api';

/// The teeth of a swinging excavator at full reach are the fastest, with 11 m/s.
const kFastest_mps = 12;
/// Less may be frames that were late.
const kLeast_m = 0.5;
/// A drive, m/s or rad/s, that goes faster than this has jumped.
const kFastestDrive_per_s = 2.5;

export function is_jump(from_m: Vector3, to_m: Vector3, time_s: number): boolean {
  const way =
    Math.hypot(to_m[0] - from_m[0], to_m[1] - from_m[1], to_m[2] - from_m[2]);
  return way > kLeast_m && way > kFastest_mps * time_s;
}

/// Whether one drive alone has jumped: then a sensor tells wrong, and the machine stands where it
/// stood. Who begins anew moves all of them.
export function is_one_sensor(
  from: readonly number[], to: readonly number[], time_s: number): boolean {
  const jumped = to.filter((drive, i) =>
    Math.abs(drive - (from[i] ?? drive)) > kFastestDrive_per_s * Math.max(time_s, 0.01));
  return jumped.length === 1 && to.length > 1;
}
