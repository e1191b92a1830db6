// SPDX-License-Identifier: Apache-2.0
/// The way that the teeth or the blade's edge took lately.

import type {FrameStore, Vector3} from '../model/api';
import {is_jump} from './jump';
import {simplified} from './outline';
import type {EdgeWalk} from './terrain_history';

/// Points of the trail stand at whole multiples of this, so that they stay as time goes on.
const kStep_s = 0.04;
/// Over a longer time without a place the trail has a gap.
const kGap_s = 0.2;
const kTimeWeight_mps = 0.01;

export interface TrailPoint {
  time_s: number;
  at_m: Vector3;
}

/// Points in the last `length_s` before now, oldest first.
export class Trail {
  private points: TrailPoint[] = [];
  private until_s = -Infinity;
  private revision = -1;

  constructor(
    readonly length_s: number,
    private readonly walk: (store: FrameStore, after_s: number) => EdgeWalk) {}

  /// A step forward adds what is new; a seek makes all of it anew.
  at(store: FrameStore, now_s: number): readonly TrailPoint[] {
    if (store.database === null) {
      return [];
    }
    const from = now_s - this.length_s;
    const forward = now_s >= this.until_s && from < this.until_s;
    if (now_s === this.until_s && store.revision === this.revision) {
      return this.points;
    }
    // Frames may have come before where the trail ends: its last moments are read again.
    const first = slot_of(forward ? this.until_s - 2 * kGap_s : from);
    this.points = forward ?
      this.points.filter(({time_s}) => time_s > from && slot_of(time_s) < first) : [];
    this.read(store, first, from, now_s);
    this.until_s = now_s;
    this.revision = store.revision;
    return this.points;
  }

  /// The first place of each slot from `first` on.
  private read(store: FrameStore, first: number, from_s: number, until_s: number): void {
    const walk = this.walk(store, Math.max(first * kStep_s - 0.5 * kStep_s, from_s));
    let slot = first - 1;
    for (let time = walk.next(); time <= until_s; time = walk.next()) {
      const its = slot_of(time);
      const edge = its > slot ? walk.edge() : null;
      if (edge !== null) {
        slot = its;
        this.points.push({time_s: time, at_m: [edge.x_m, edge.y_m, edge.z_m]});
      }
    }
  }
}

/// Stamps are whole microseconds, which no sum of doubles is.
const slot_of = (time_s: number): number => Math.floor((time_s + 1e-7) / kStep_s);

/// The points as segments, with how old each end is: 0 now, 1 at the trail's end.
export function trail_segments(
  points: readonly TrailPoint[], now_s: number, length_s: number,
): {segments: Vector3[]; ages: number[]} {
  const segments: Vector3[] = [];
  const ages: number[] = [];
  for (const piece of pieces(points)) {
    // With time as a coordinate, so that what is left out had nearly the age it gets.
    const line = simplified(piece.map(({at_m, time_s}) =>
      [...at_m, kTimeWeight_mps * (now_s - time_s)] as const), 0.004);
    for (let i = 1; i < line.length; ++i) {
      for (const [x, y, z, age] of [line[i - 1], line[i]]) {
        segments.push([x, y, z]);
        ages.push(age / kTimeWeight_mps / length_s);
      }
    }
  }
  return {segments, ages};
}

/// Runs without a gap or a jump.
function pieces(points: readonly TrailPoint[]): TrailPoint[][] {
  const runs: TrailPoint[][] = [];
  points.forEach((point, i) => {
    const before = points[i - 1];
    const since_s = before ? point.time_s - before.time_s : Infinity;
    if (!before || since_s > kGap_s || is_jump(before.at_m, point.at_m, since_s)) {
      runs.push([]);
    }
    runs[runs.length - 1].push(point);
  });
  return runs;
}
