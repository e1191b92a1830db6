// SPDX-License-Identifier: Apache-2.0
/// What the soil in a bucket looks like from the side: its bucket's shell up to a level surface,
/// which goes along with the bucket where it is tilted further than loose soil lies.

import type {Vector2} from '../model/api';
import {doubled_area} from './outline';

/// Slope at which the surface stays within the bucket, rad.
const kSlope_rad = 0.6;
/// Height of a heaped bucket's mound over its mouth, of the mouth's length.
const kMound = 0.2;
const kMoundPoints = 7;
const kSteps = 20;

/// The room that is full when it is heaped: `shell` from the back of the mouth round to the lip.
export function heaped_outline(shell: readonly Vector2[]): Vector2[] {
  const [back, lip] = [shell[0]!, shell[shell.length - 1]!];
  const [x, z] = [lip[0] - back[0], lip[1] - back[1]];
  const mound = Array.from({length: kMoundPoints}, (_, i): Vector2 => {
    const share = 1 - (i + 1) / (kMoundPoints + 1);
    const high = kMound * Math.sin(Math.PI * share);
    return [back[0] + share * x + high * z, back[1] + share * z - high * x];
  });
  return [...shell, ...mound];
}

/// The part of it that `share` of the capacity fills, in the bucket's frame, whose x axis points
/// `direction_rad` above the level. Empty without soil.
export function fill_outline(
  shell: readonly Vector2[], share: number, direction_rad: number): Vector2[] {
  const full = heaped_outline(shell);
  if (!(share > 0)) {
    return [];
  }
  const up = surface_normal(shell, direction_rad);
  const height = ([x, z]: Vector2): number => x * up[0] + z * up[1];
  const heights = full.map(height);
  let [low, high] = [Math.min(...heights), Math.max(...heights)];
  const wanted = Math.min(share, 1) * Math.abs(doubled_area(full));
  for (let i = 0; i < kSteps; ++i) {
    const middle = 0.5 * (low + high);
    if (Math.abs(doubled_area(below(full, height, middle))) < wanted) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return below(full, height, high);
}

/// Up, but within the slope of the way out of the mouth.
function surface_normal(shell: readonly Vector2[], direction_rad: number): Vector2 {
  const [back, lip] = [shell[0]!, shell[shell.length - 1]!];
  const out = Math.atan2(back[0] - lip[0], lip[1] - back[1]);
  const off = Math.PI / 2 - direction_rad - out;
  const wrapped = off - 2 * Math.PI * Math.round(off / (2 * Math.PI));
  const angle = out + Math.min(Math.max(wrapped, -kSlope_rad), kSlope_rad);
  return [Math.cos(angle), Math.sin(angle)];
}

function below(
  ring: readonly Vector2[], height: (point: Vector2) => number, level: number): Vector2[] {
  const kept: Vector2[] = [];
  ring.forEach((from, i) => {
    const to = ring[(i + 1) % ring.length]!;
    const [a, b] = [height(from) - level, height(to) - level];
    if (a <= 0) {
      kept.push(from);
    }
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      const share = a / (a - b);
      kept.push([from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]);
    }
  });
  return kept;
}
