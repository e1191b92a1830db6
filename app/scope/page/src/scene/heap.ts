// SPDX-License-Identifier: Apache-2.0
/// Loose soil on the ground: a ridge as long as the bucket is wide, with slopes at the angle of
/// repose, on whatever lies there.

import type {Edge, HeightField} from './height_field';

/// Slope of loose soil: about 35 degrees, between sand and clay.
export const kRepose = 0.7;
/// No heap is looked for farther from where it falls.
const kReach_m = 3;
const kSteps = 24;

/// Puts `volume_m3` under the edge. What falls beyond the grid is lost.
export function heap(
  field: HeightField, time_s: number, edge: Edge, width_m: number, volume_m3: number): void {
  const nodes = around(field, edge, width_m);
  if (nodes.length === 0 || !(volume_m3 > 0)) {
    return;
  }
  const area = field.grid.cell_m ** 2;
  const added = (top: number): number => area * nodes.reduce((sum, {node, off_m}) =>
    sum + Math.max(0, top - kRepose * off_m - field.latest_m(node)), 0);
  let low = nodes.reduce((least, {node}) => Math.min(least, field.latest_m(node)), Infinity);
  let high = low;
  for (let step = 0.1; added(high) < volume_m3 && step < 100; step *= 2) {
    high += step;
  }
  for (let i = 0; i < kSteps; ++i) {
    const middle = 0.5 * (low + high);
    if (added(middle) < volume_m3) {
      low = middle;
    } else {
      high = middle;
    }
  }
  for (const {node, off_m} of nodes) {
    field.raise(time_s, node, high - kRepose * off_m);
  }
}

/// Nodes in reach with their distance from the line that the soil falls on.
function around(
  field: HeightField, edge: Edge, width_m: number): {node: number; off_m: number}[] {
  const {x_m, y_m, cell_m, columns, rows} = field.grid;
  const [cos, sin] = [Math.cos(edge.heading_rad), Math.sin(edge.heading_rad)];
  const half = 0.5 * width_m;
  const reach = kReach_m + half;
  const first = Math.max(0, Math.ceil((edge.x_m - reach - x_m) / cell_m));
  const last = Math.min(columns - 1, Math.floor((edge.x_m + reach - x_m) / cell_m));
  const bottom = Math.max(0, Math.ceil((edge.y_m - reach - y_m) / cell_m));
  const top = Math.min(rows - 1, Math.floor((edge.y_m + reach - y_m) / cell_m));
  const nodes: {node: number; off_m: number}[] = [];
  for (let row = bottom; row <= top; ++row) {
    const dy = y_m + row * cell_m - edge.y_m;
    for (let column = first; column <= last; ++column) {
      const dx = x_m + column * cell_m - edge.x_m;
      const aside = Math.max(Math.abs(dy * cos - dx * sin) - half, 0);
      const off_m = Math.hypot(dx * cos + dy * sin, aside);
      if (off_m <= kReach_m) {
        nodes.push({node: row * columns + column, off_m});
      }
    }
  }
  return nodes;
}
