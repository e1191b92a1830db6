// SPDX-License-Identifier: Apache-2.0
/// The soil that a machine cuts, and its history from the first frame on.

import type {DozerMachine, ExcavatorMachine, FrameStore} from '../model/api';
import {BucketLoad} from './bucket_load';
import {blade_width} from './dozer_shape';
import {blade_walk, bucket_walk} from './edges';
import {bucket_capacity_m3, excavator_widths} from './excavator_shape';
import {type Grid, HeightField} from './height_field';
import {dozer_grid, excavator_grid, excavator_start} from './soil_shape';
import {type EdgeWalk, TerrainHistory} from './terrain_history';

export interface Soil {
  grid: Grid;
  width_m: number;  ///< Of what cuts.
  start: (x_m: number, y_m: number) => number;
  walk: (store: FrameStore, after_s: number) => EdgeWalk;
  load?: Load;
}

/// Of what cuts and carries: how much it holds, and who shows what is in it, as a share of that.
export interface Load {
  capacity_m3: number;
  show: (share: number) => void;
}

export function soil_history({grid, start, width_m, walk, load}: Soil): TerrainHistory {
  return new TerrainHistory(new HeightField(grid, start), width_m, walk,
    load ? new BucketLoad(load.capacity_m3) : null);
}

/// `show`: who shows what is in the bucket.
export function excavator_soil(machine: ExcavatorMachine, show: Load['show']): Soil {
  const widths = excavator_widths(machine);
  return {
    grid: excavator_grid(machine), start: excavator_start(machine), width_m: widths.bucket_m,
    walk: bucket_walk(machine), load: {capacity_m3: bucket_capacity_m3(machine, widths), show}};
}

export const dozer_soil = (machine: DozerMachine): Soil => ({
  grid: dozer_grid(machine), start: () => 0, width_m: blade_width(machine),
  walk: blade_walk(machine)});
