// SPDX-License-Identifier: Apache-2.0
/// Closed outlines of plates and boxes in the plane of a link, before they get a thickness. They
/// run counter-clockwise; metres throughout.

import type {Vector2} from '../model/api';
import {add, direction, minus, polar, scaled} from '../model/geometry';

/// A round end: a boss around a pin, the wheel of a track.
export interface Disc {
  at_m: Vector2;
  radius_m: number;
}

/// What a band stretched round the discs encloses.
export function hull_of_discs(discs: readonly Disc[], corners = 16): Vector2[] {
  const points: Vector2[] = [];
  for (const disc of discs) {
    for (let i = 0; i < corners; ++i) {
      points.push(add(disc.at_m, polar(disc.radius_m, 2 * Math.PI * i / corners)));
    }
  }
  return convex_hull(points);
}

/// Andrew's monotone chain; points on an edge are left out.
export function convex_hull(points: readonly Vector2[]): Vector2[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (ordered: readonly Vector2[]): Vector2[] => {
    const chain: Vector2[] = [];
    for (const point of ordered) {
      while (chain.length > 1 && turn(chain[chain.length - 2], chain[chain.length - 1], point)
          <= 1e-9) {
        chain.pop();
      }
      chain.push(point);
    }
    chain.pop();
    return chain;
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/// Above 0 where a, b, c turn to the left.
const turn = (a: Vector2, b: Vector2, c: Vector2): number =>
  (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/// Twice the area: above 0 where the outline runs counter-clockwise.
export function doubled_area(outline: readonly Vector2[]): number {
  return outline.reduce((sum, point, i) => {
    const next = outline[(i + 1) % outline.length];
    return sum + point[0] * next[1] - next[0] * point[1];
  }, 0);
}

/// A line along a bent beam: straight to both sides of `knee`, round there over `round` of each
/// side's length.
export function bent_line(
  from: Vector2, knee: Vector2, to: Vector2, round: number, steps: number): Vector2[] {
  const begin = add(knee, scaled(minus(from, knee), round));
  const end = add(knee, scaled(minus(to, knee), round));
  const line: Vector2[] = [from];
  for (let i = 0; i <= steps; ++i) {
    const t = i / steps;
    line.push(add(
      add(scaled(begin, (1 - t) ** 2), scaled(knee, 2 * t * (1 - t))), scaled(end, t ** 2)));
  }
  line.push(to);
  return line;
}

/// A beam around a line, as thick to either side as `half_m` says at each of its points, and round
/// about both ends.
export function beam(line: readonly Vector2[], half_m: readonly number[]): Vector2[] {
  const last = line.length - 1;
  const along = line.map((_, i) =>
    direction(minus(line[Math.min(i + 1, last)], line[Math.max(i - 1, 0)])));
  const side = (i: number, turn_rad: number): Vector2 =>
    add(line[i], polar(half_m[i], along[i] + turn_rad));
  const outline: Vector2[] = [];
  for (let i = 0; i <= last; ++i) {
    outline.push(side(i, -Math.PI / 2));
  }
  for (const turn_rad of [-0.375, -0.25, -0.125, 0, 0.125, 0.25, 0.375]) {
    outline.push(side(last, turn_rad * Math.PI));
  }
  for (let i = last; i >= 0; --i) {
    outline.push(side(i, Math.PI / 2));
  }
  for (const turn_rad of [0.625, 0.75, 0.875, 1, 1.125, 1.25, 1.375]) {
    outline.push(side(0, turn_rad * Math.PI));
  }
  return outline;
}

/// Points along a closed outline at equal distances, for the shoes of a track.
export function evenly_along(outline: readonly Vector2[], count: number): Vector2[] {
  const lengths = outline.map((point, i) => {
    const next = outline[(i + 1) % outline.length];
    return Math.hypot(next[0] - point[0], next[1] - point[1]);
  });
  const whole = lengths.reduce((sum, length) => sum + length, 0);
  const points: Vector2[] = [];
  let edge = 0;
  let before = 0;
  for (let i = 0; i < count; ++i) {
    const at = whole * i / count;
    while (edge < outline.length - 1 && before + lengths[edge] < at) {
      before += lengths[edge];
      ++edge;
    }
    const from = outline[edge];
    const to = outline[(edge + 1) % outline.length];
    points.push(add(from, scaled(minus(to, from), (at - before) / lengths[edge])));
  }
  return points;
}

/// A chain of points without those that stand less than `off_m` aside of what is left (Douglas and
/// Peucker): a line costs by its points.
export function simplified<Point extends readonly number[]>(
  points: readonly Point[], off_m: number): Point[] {
  if (points.length < 3) {
    return [...points];
  }
  const [from, to] = [points[0], points[points.length - 1]];
  let worst = 0;
  let at = 0;
  for (let i = 1; i + 1 < points.length; ++i) {
    const off = distance_to_segment(points[i], from, to);
    if (off > worst) {
      [worst, at] = [off, i];
    }
  }
  return worst <= off_m ? [from, to] : [
    ...simplified(points.slice(0, at + 1), off_m).slice(0, -1),
    ...simplified(points.slice(at), off_m)];
}

function distance_to_segment(
  point: readonly number[], from: readonly number[], to: readonly number[]): number {
  let [along, square] = [0, 0];
  for (let i = 0; i < point.length; ++i) {
    along += (point[i] - from[i]) * (to[i] - from[i]);
    square += (to[i] - from[i]) ** 2;
  }
  const share = square > 0 ? Math.min(Math.max(along / square, 0), 1) : 0;
  return Math.hypot(...point.map((part, i) => part - from[i] - share * (to[i] - from[i])));
}
