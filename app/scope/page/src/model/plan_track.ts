// SPDX-License-Identifier: Apache-2.0
/// A track in plan as a line in the plane: its curvature summed up, straight beyond both ends.

import type {Vector2} from './api';
import {add, minus, polar, rotated} from './geometry';

interface Node {
  station_m: number;
  at_m: Vector2;
  direction_rad: number;
  curvature_pm: number;  ///< Up to the next one.
}

const kFootSteps = 4;

export class PlanTrack {
  private readonly nodes: readonly Node[];

  /// Of stations and the curvature there, 1/m, to the left positive.
  constructor(curvature: readonly Vector2[]) {
    let [at, turned]: [Vector2, number] = [[0, 0], 0];
    this.nodes = curvature.map(([station, here], i): Node => {
      const next = curvature[i + 1];
      const mean = next === undefined ? 0 : 0.5 * (here + next[1]);
      const node = {station_m: station, at_m: at, direction_rad: turned, curvature_pm: mean};
      const way = next === undefined ? 0 : next[0] - station;
      at = add(at, chord(node, way));
      turned += mean * way;
      return node;
    });
  }

  /// Along the track and left of it: of a point so far ahead and to the left of a body at this
  /// place, turned so far against the track beside it.
  place_of([station, offset]: Vector2, heading_rad: number, ahead_left_m: Vector2): Vector2 {
    const body = this.at(station);
    const target = add(add(body.at_m, rotated([0, offset], body.direction_rad)),
      rotated(ahead_left_m, body.direction_rad + heading_rad));
    let place: Vector2 = [station + ahead_left_m[0], 0];
    for (let i = 0; i < kFootSteps; ++i) {
      const foot = this.at(place[0]);
      const [along, left] = rotated(minus(target, foot.at_m), -foot.direction_rad);
      place = [place[0] + along / Math.max(0.2, 1 - foot.curvature_pm * left), left];
    }
    return place;
  }

  private at(station_m: number): Node {
    const {nodes} = this;
    const first = nodes[0]!;
    // Evenly apart, but for what rounding leaves of it.
    const step = nodes.length > 1 ? nodes[1]!.station_m - first.station_m : 1;
    const index = Math.floor((station_m - first.station_m) / step + 1e-6);
    const node = nodes[Math.min(Math.max(index, 0), nodes.length - 1)]!;
    const way = station_m - node.station_m;
    const bent = way < 0 ? {...node, curvature_pm: 0} : node;
    return {station_m, at_m: add(node.at_m, chord(bent, way)),
      direction_rad: node.direction_rad + bent.curvature_pm * way, curvature_pm: bent.curvature_pm};
  }
}

/// Along an arc from its beginning.
const chord = ({direction_rad, curvature_pm}: Node, way_m: number): Vector2 =>
  polar(way_m, direction_rad + 0.5 * curvature_pm * way_m);
