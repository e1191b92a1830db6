/// A scale on the ground with a tick each metre, and a staff for heights where it ends.

import {Group} from 'three';
import type {Vector3} from '../model/api';
import type {Labels} from './labels';
import {Lines} from './lines';
import type {SceneColours} from './theme';

export interface RulerPlace {
  from_x_m: number;  ///< Whole metres.
  to_x_m: number;
  y_m: number;
  low_z_m: number;   ///< Of the staff.
  high_z_m: number;
}

export class Ruler {
  readonly node = new Group();
  private readonly lines: Lines;

  constructor(private readonly place: RulerPlace) {
    const {from_x_m, to_x_m, y_m, low_z_m, high_z_m} = place;
    const segments: Vector3[] = [[from_x_m, y_m, 0.01], [to_x_m, y_m, 0.01]];
    for (let x = from_x_m; x <= to_x_m; ++x) {
      segments.push([x, y_m, 0.01], [x, y_m - (x % 5 === 0 ? 0.3 : 0.15), 0.01]);
    }
    segments.push([to_x_m, y_m, low_z_m], [to_x_m, y_m, high_z_m]);
    for (let z = low_z_m; z <= high_z_m; ++z) {
      segments.push([to_x_m, y_m, z], [to_x_m + 0.2, y_m, z]);
    }
    this.lines = new Lines({width_px: 1.5, seen_through: true}, segments);
    this.node.add(this.lines.node);
  }

  label(labels: Labels): void {
    const {from_x_m, to_x_m, y_m, low_z_m, high_z_m} = this.place;
    for (let x = from_x_m; x <= to_x_m; ++x) {
      labels.put(`x${x}`, 'scale', x === from_x_m ? `x ${x} m` : `${x}`, [x, y_m - 0.6, 0]);
    }
    for (let z = low_z_m; z <= high_z_m; ++z) {
      if (z !== 0) {
        labels.put(`z${z}`, 'scale', z === high_z_m ? `z ${z} m` : `${z}`, [to_x_m + 0.5, y_m, z]);
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
