/// The way that the teeth or the blade's edge took lately.

import type {FrameStore, Vector3} from '../model/api';
import type {EdgeWalk} from './terrain_history';

/// Points of the trail stand at whole multiples of this, so that they stay as time goes on.
const kStep_s = 0.04;
/// Over a longer time without a place the trail has a gap.
const kGap_s = 0.2;

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
    const keep = forward ? this.until_s - 2 * kGap_s : from;
    this.points = forward ?
      this.points.filter(({time_s}) => time_s > from && time_s <= keep) : [];
    this.read(store, Math.max(keep, from), now_s);
    this.until_s = now_s;
    this.revision = store.revision;
    return this.points;
  }

  private read(store: FrameStore, after_s: number, until_s: number): void {
    const walk = this.walk(store, after_s);
    let slot = Math.floor(after_s / kStep_s);
    for (let time = walk.next(); time <= until_s; time = walk.next()) {
      const its = Math.floor(time / kStep_s);
      if (its === slot) {
        continue;
      }
      const edge = walk.edge();
      if (edge !== null) {
        slot = its;
        this.points.push({time_s: time, at_m: [edge.x_m, edge.y_m, edge.z_m]});
      }
    }
  }
}

/// Neighbouring points as segments, with how old each end is: 0 now, 1 at the trail's end.
export function trail_segments(
  points: readonly TrailPoint[], now_s: number, length_s: number,
): {segments: Vector3[]; ages: number[]} {
  const segments: Vector3[] = [];
  const ages: number[] = [];
  for (let i = 1; i < points.length; ++i) {
    const [from, to] = [points[i - 1]!, points[i]!];
    if (to.time_s - from.time_s <= kGap_s) {
      segments.push(from.at_m, to.at_m);
      ages.push((now_s - from.time_s) / length_s, (now_s - to.time_s) / length_s);
    }
  }
  return {segments, ages};
}
