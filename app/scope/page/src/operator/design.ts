// SPDX-License-Identifier: Apache-2.0
/// What a task makes of the ground, as a height over each place, for the pictures and the digits.

import type {Task, Vector2} from '../model/api';
import type {SurfaceGrid} from '../model/surface_grid';

/// Of the ground frame, m; NaN where there is no design.
export type HeightAt = (x_m: number, y_m: number) => number;

const made = new WeakMap<Task, HeightAt>();

/// Null: the task has no design.
export function design_of(task: Task | null): HeightAt | null {
  if (task === null || (!task.design && !task.surface)) {
    return null;
  }
  let at = made.get(task);
  if (at === undefined) {
    at = task.design ? of_plane(task.design) : of_surface(task.surface!);
    made.set(task, at);
  }
  return at;
}

function of_plane({through_m, up}: NonNullable<Task['design']>): HeightAt {
  return (x, y) => through_m[2] - (up[0] * (x - through_m[0]) + up[1] * (y - through_m[1])) / up[2];
}

/// Between its four heights, as the controller has it (design_surface.hpp).
export function of_surface(grid: SurfaceGrid): HeightAt {
  const {columns, rows, step_m, unit_m, base_m, machine_m, heading_rad} = grid;
  const heights = new Float64Array(columns * rows).fill(NaN);
  let before = 0;
  grid.heights.forEach((rise, n) => {
    if (rise !== null) {
      before += rise;
      heights[n] = base_m + unit_m * before;
    }
  });
  const [cosine, sine] = [Math.cos(heading_rad), Math.sin(heading_rad)];
  return (x, y) => {
    const u = (machine_m[0] + cosine * x - sine * y) / step_m;
    const v = (machine_m[1] + sine * x + cosine * y) / step_m;
    if (!(u >= 0 && v >= 0 && u < columns - 1 && v < rows - 1)) {
      return NaN;
    }
    const at = Math.floor(v) * columns + Math.floor(u);
    const [along, across] = [u - Math.floor(u), v - Math.floor(v)];
    const near = heights[at]! + along * (heights[at + 1]! - heights[at]!);
    const far = heights[at + columns]! + along * (heights[at + columns + 1]! - heights[at + columns]!);
    return near + across * (far - near);
  };
}

const STEP_M = 0.05;

/// The design in the upright plane through the swing axis, over reach and height: a line for each
/// stretch that has one.
export function design_lines(
  at: HeightAt, swing_rad: number, [from, to]: readonly [number, number]): Vector2[][] {
  const lines: Vector2[][] = [];
  let line: Vector2[] = [];
  for (let n = Math.floor(from / STEP_M); n * STEP_M <= to; ++n) {
    const reach = n * STEP_M;
    const z = at(reach * Math.cos(swing_rad), reach * Math.sin(swing_rad));
    if (Number.isNaN(z)) {
      line = [];
    } else {
      if (line.length === 0) {
        lines.push(line);
      }
      line.push([reach, z]);
    }
  }
  return lines.filter(({length}) => length > 1);
}

/// Ground within this of its design is as it should be, m: as in the reports' map.
export const BUILT_M = 0.03;

export type Built = 'over' | 'under' | 'on';

export const built_as = (off_m: number): Built =>
  off_m > BUILT_M ? 'over' : off_m < -BUILT_M ? 'under' : 'on';
