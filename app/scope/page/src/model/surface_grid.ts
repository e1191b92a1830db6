// SPDX-License-Identifier: Apache-2.0
import type {Vector2} from './api';

/// A controller's design as heights on an even grid, which may lie turned against the machine.
export interface SurfaceGrid {
  columns: number;
  rows: number;
  step_m: number;
  unit_m: number;      ///< Of a height.
  base_m: number;      ///< Ground frame, where a height is 0.
  machine_m: Vector2;  ///< The machine's place, from the first height along columns and rows.
  heading_rad: number;  ///< Of the machine's x axis there.
  /// Row after row; each less the known one before it, the first less 0. Null: none.
  heights: readonly (number | null)[];
}
