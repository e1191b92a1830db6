// SPDX-License-Identifier: Apache-2.0
/// Where the soil is that a machine cuts, and how it lies before the first cut.

import type {DozerMachine, ExcavatorMachine} from '../model/api';
import type {Grid} from './height_field';

export const kCell_m = 0.1;

function grid_over(x0: number, y0: number, x1: number, y1: number): Grid {
  const nodes = (from: number, to: number): number => Math.round((to - from) / kCell_m) + 1;
  return {x_m: x0, y_m: y0, cell_m: kCell_m, columns: nodes(x0, x1), rows: nodes(y0, y1)};
}

/// Teeth at the ground reach no farther.
export const reach_m = (machine: ExcavatorMachine): number =>
  machine.boom_foot_m[0] + machine.boom_m + machine.arm_m + machine.bucket_m;

/// Whole metres: all around a machine that swings, ahead of one that does not.
export function excavator_grid(machine: ExcavatorMachine): Grid {
  const far = Math.ceil(reach_m(machine));
  return machine.has_swing ? grid_over(-far, -far, far, far) : grid_over(0, -4, far + 2, 4);
}

/// Soil that lies higher or lower than the tracks stand is a bank or a pit before them: its side
/// begins where the tracks end and rises within whole metres, to the sides as well, so that it is
/// drawn with few triangles.
export function excavator_start(machine: ExcavatorMachine): (x_m: number, y_m: number) => number {
  const level = machine.dig.ground_z_m;
  const tracks = Math.round(0.36 * machine.boom_m + 0.2);
  const run = Math.max(Math.ceil(Math.abs(level)), 1);
  const grid = excavator_grid(machine);
  const side = machine.has_swing ? Infinity : -grid.y_m - 1;
  const far = machine.has_swing ? -grid.x_m : grid.x_m + (grid.columns - 1) * grid.cell_m;
  return (x, y) => {
    const out = machine.has_swing ? Math.hypot(x, y) : x;
    const inside = Math.min(out - tracks, far - out, side - Math.abs(y));
    return level * Math.min(Math.max(inside / run, 0), 1);
  };
}

/// From behind where the machine may stand to beyond the end of its grade.
export function dozer_grid(machine: DozerMachine): Grid {
  const half = Math.ceil(machine.half_gauge_m + 1);
  const design = machine.design.map(([x]) => x);
  const from = Math.floor(Math.min(0, ...design)) - 8;
  const to = Math.ceil(Math.max(machine.length_m, ...design)) + 8;
  return grid_over(from, -half, to, half);
}
