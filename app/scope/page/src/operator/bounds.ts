// SPDX-License-Identifier: Apache-2.0
/// Fences, keep-outs and designs as lines of a plane, for the pictures.

import type {ExcavatorMachine, Fence, Task, Vector2} from '../model/api';
import {keep_out_ring} from '../scene/keep_out_ring';
import type {ShownTask} from '../scene/shown_task';
import type {Picture} from '../view/basics/picture';
import type {Metres, Span} from '../view/basics/picture';

/// A line over u and v: `across` . (u, v) = offset; beyond it, along `across`, nothing may be.
export interface Bound {
  across: Vector2;
  offset: number;
}

/// Less of a plane's slope than this, and a plane cuts the picture nowhere that matters.
const LEAST = 0.05;

export function shown_task(machine: ExcavatorMachine, task: ShownTask): Task | null {
  return typeof task === 'number' ? machine.tasks[task] ?? null : null;
}

/// Those of a task that are no design.
export const own_fences = (task: Task | null): readonly Fence[] =>
  task === null ? [] : task.design || task.surface ? task.fences.slice(0, -1) : task.fences;

/// Where planes cut the upright plane through the swing axis, over reach and height.
export const in_section = ({normal, offset_m}: Fence, swing_rad: number): Bound | null =>
  normal === undefined || offset_m === undefined ? null
    : bound([normal[0] * Math.cos(swing_rad) + normal[1] * Math.sin(swing_rad), normal[2]], offset_m);

/// Where planes cut the level of a height, over y and x: to the left is to the left.
export const in_plan = ({normal, offset_m}: Fence, z_m: number): Bound | null =>
  normal === undefined || offset_m === undefined ? null
    : bound([-normal[1], normal[0]], offset_m - normal[2] * z_m);

function bound(across: Vector2, offset: number): Bound | null {
  const size = Math.hypot(...across);
  return size < LEAST ? null
    : {across: [across[0] / size, across[1] / size], offset: offset / size};
}

/// The part of the line that may be seen, from edge to edge; null where it is outside.
export function ends_of({across: [a, b], offset}: Bound, {u, v}: Span): [Vector2, Vector2] | null {
  const far = Math.hypot(u[1] - u[0], v[1] - v[0]);
  const middle: Vector2 = [0.5 * (u[0] + u[1]), 0.5 * (v[0] + v[1])];
  const away = offset - a * middle[0] - b * middle[1];
  if (Math.abs(away) > 0.5 * far) {
    return null;
  }
  const foot: Vector2 = [middle[0] + away * a, middle[1] + away * b];
  return [[foot[0] - far * b, foot[1] + far * a], [foot[0] + far * b, foot[1] - far * a]];
}

export function draw_bound(picture: Picture, metres: Metres, bound: Bound, colour: string): void {
  const ends = ends_of(bound, metres.seen);
  if (ends !== null) {
    picture.fence(metres.at(ends[0]), metres.at(ends[1]),
      [bound.across[0], -bound.across[1]], colour);
  }
}

const STEP_M = 0.05;

/// Where a keep-out is met by the upright plane through the swing axis: stretches of reach.
export function kept_out(fence: Fence, swing_rad: number, most_m: number): (readonly [number, number])[] {
  if (fence.centre_m === undefined || fence.half_m === undefined) {
    return [];
  }
  const ring = ring_of(fence);
  const found: [number, number][] = [];
  for (let reach = 0; reach <= most_m; reach += STEP_M) {
    if (!holds(ring, [reach * Math.cos(swing_rad), reach * Math.sin(swing_rad)])) {
      continue;
    }
    const last = found.at(-1);
    if (last !== undefined && reach - last[1] < 1.5 * STEP_M) {
      last[1] = reach;
    } else {
      found.push([reach, reach]);
    }
  }
  return found;
}

export const ring_of = ({round, centre_m, half_m, turn_rad}: Fence): readonly Vector2[] =>
  centre_m && half_m ? keep_out_ring({round, centre_m, half_m, turn_rad}) : [];

/// A convex ring, counterclockwise.
function holds(ring: readonly Vector2[], [x, y]: Vector2): boolean {
  return ring.every(([x0, y0], i) => {
    const [x1, y1] = ring[(i + 1) % ring.length]!;
    return (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) >= 0;
  });
}
