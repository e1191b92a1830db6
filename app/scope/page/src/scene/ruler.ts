// SPDX-License-Identifier: Apache-2.0
/// A scale on the ground with a tick each metre, and a staff for heights where it ends.

import {Group} from 'three';
import type {Vector3} from '../model/api';
import type {Labels} from './labels';
import {Lines} from './lines';
import type {SceneColours} from './theme';

/// Above the ground, or both would be at one depth.
const kOff_m = 0.03;

export interface RulerPlace {
  from_x_m: number;  ///< Whole metres.
  to_x_m: number;
  aside_m: number;   ///< From the middle of the machine, to the reader's side.
  low_z_m: number;   ///< Of the staff.
  high_z_m: number;
}

export class Ruler {
  readonly node = new Group();
  private readonly lines = new Lines({width_px: 1.5, seen_through: false});
  private side = 0;  ///< +1 where it lies on the left of the machine.

  constructor(private readonly place: RulerPlace, private readonly labels: Labels) {
    this.node.add(this.lines.node);
    this.face(-1);
  }

  /// Lies on the reader's side of the machine, where nothing stands before it.
  face(eye_y_m: number): void {
    const side = eye_y_m > 0 ? 1 : -1;
    if (side !== this.side) {
      this.side = side;
      this.lines.set(this.segments());
      this.label();
    }
  }

  private segments(): Vector3[] {
    const {from_x_m, to_x_m, aside_m, low_z_m, high_z_m} = this.place;
    const y = this.side * aside_m;
    const segments: Vector3[] = [[from_x_m, y, kOff_m], [to_x_m, y, kOff_m]];
    for (let x = from_x_m; x <= to_x_m; ++x) {
      const long = this.side * (x % 5 === 0 ? 0.3 : 0.15);
      segments.push([x, y, kOff_m], [x, y + long, kOff_m]);
    }
    segments.push([to_x_m, y, low_z_m], [to_x_m, y, high_z_m]);
    for (let z = low_z_m; z <= high_z_m; ++z) {
      segments.push([to_x_m, y, z], [to_x_m + 0.2, y, z]);
    }
    return segments;
  }

  private label(): void {
    const {labels} = this;
    const {from_x_m, to_x_m, low_z_m, high_z_m} = this.place;
    const y_m = this.side * this.place.aside_m;
    for (let x = from_x_m; x <= to_x_m; ++x) {
      const words = x === from_x_m ? `x ${x} m` : `${x}`;
      labels.put(`x${x}`, 'scale', words, [x, y_m + 0.6 * this.side, 0]);
    }
    for (let z = low_z_m; z <= high_z_m; ++z) {
      if (z !== 0) {
        const words = z === high_z_m ? `z ${z} m` : `${z}`;
        labels.put(`z${z}`, 'scale', words, [to_x_m + 0.5, y_m, z]);
      }
    }
  }

  set_theme(colours: SceneColours): void {
    this.lines.set_colour(colours.text, colours.ground);
  }

  dispose(): void {
    this.lines.dispose();
  }
}
