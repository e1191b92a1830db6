// SPDX-License-Identifier: Apache-2.0
/// The soil as the received frames have it cut and heaped up: every frame's edge in the order of
/// time, a little at a time, so that an hour of log does not hold the page up.

import type {FrameStore, Vector3} from '../model/api';
import {type BucketLoad} from './bucket_load';
import {heap} from './heap';
import {cut, type Edge, type HeightField} from './height_field';
import {is_jump, is_one_sensor} from './jump';

/// Where the edge was at one time; null: not known then.
export interface EdgeWalk {
  /// Time of the next frame, in order; NaN after the last.
  next(): number;
  edge(): Edge | null;
}

/// Frames of one time come one after another: the newest moment is not complete yet.
const kSettle_s = 0.05;
/// Over a longer gap nobody knows which way the edge took.
const kGap_s = 0.3;
/// Until all messages tell of the place after a jump.
const kArrive_s = 0.03;
/// Frames between two looks at the clock.
const kFramesAtOnce = 32;
/// What falls is heaped up by so much at a time.
const kHeaped_m3 = 0.03;
/// An edge so far over the soil is clear of it.
const kClear_m = 0.1;

export class TerrainHistory {
  private known_s = -Infinity;
  private last: {edge: Edge; time_s: number} | null = null;
  /// Newest place, kept where nothing is known for a while.
  private seen: {edge: Edge; time_s: number} | null = null;
  private arriving_s = -Infinity;
  private falling_m3 = 0;
  /// Where the bucket was opened widest since it was weighed.
  private opened: {edge: Edge; open_rad: number} | null = null;

  /// `walk` begins with the first frame after a time. The field has to be as it was at the start.
  /// `load`: of what carries soil away.
  constructor(
    readonly field: HeightField, private readonly width_m: number,
    private readonly walk: (store: FrameStore, after_s: number) => EdgeWalk,
    readonly load: BucketLoad | null = null) {}

  /// All frames until then are in the field.
  get known_until_s(): number {
    return this.known_s;
  }

  /// Whether what was worked in is of another time than what the store has now: a source that
  /// began anew. This history is of no use then.
  outlived(store: FrameStore): boolean {
    return this.known_s > -Infinity && store.until_s < this.known_s;
  }

  /// Works frames in until `until_s` or for `budget_ms` of the clock. True: nothing is left to do.
  advance(
    store: FrameStore, until_s: number, budget_ms: number,
    clock_ms: () => number = () => performance.now()): boolean {
    const end = Math.min(until_s, store.until_s - kSettle_s);
    if (store.database === null || !(this.known_s < end)) {
      return true;
    }
    const stop_ms = clock_ms() + budget_ms;
    const walk = this.walk(store, this.known_s);
    for (let frame = 1; ; ++frame) {
      const time = walk.next();
      if (!(time <= end)) {
        this.known_s = end;
        return true;
      }
      this.take(time, walk.edge());
      this.known_s = time;
      if (frame % kFramesAtOnce === 0 && clock_ms() >= stop_ms) {
        return false;
      }
    }
  }

  private take(time_s: number, edge: Edge | null): void {
    const before = this.last;
    if (edge === null) {
      this.last = null;
      return;
    }
    this.look_for_jump(time_s, edge);
    this.seen = {edge, time_s};
    if (before === null || time_s - before.time_s > kGap_s || time_s <= this.arriving_s) {
      this.last = {edge, time_s};
      return;
    }
    // Less than this moves no node that the frames around do not move.
    const moved = Math.hypot(edge.x_m - before.edge.x_m, edge.y_m - before.edge.y_m);
    const sunk = before.edge.z_m - edge.z_m;
    if (moved < 0.1 * this.field.grid.cell_m && sunk < 0.002 &&
        time_s - before.time_s < 0.5 * kGap_s) {
      this.carry(time_s, edge, 0);
      return;
    }
    this.carry(time_s, edge, cut(this.field, time_s, before.edge, edge, this.width_m));
    this.last = {edge, time_s};
  }

  private carry(time_s: number, edge: Edge, cut_m3: number): void {
    const {load} = this;
    const {bucket, tilt_rad = NaN} = edge;
    if (load === null || bucket === undefined) {
      return;
    }
    const open_rad = Math.abs(tilt_rad);
    if (this.opened === null || open_rad > this.opened.open_rad) {
      this.opened = {edge, open_rad};
    }
    const free = edge.z_m > this.field.latest_at(edge.x_m, edge.y_m) + kClear_m;
    const {poured_m3, missed_m3} = load.step(time_s, {...bucket, tilt_rad, free}, cut_m3);
    this.falling_m3 += poured_m3;
    if (this.falling_m3 > (load.now_m3 > 0 ? kHeaped_m3 : 0)) {
      heap(this.field, time_s, edge, this.width_m, this.falling_m3);
      this.falling_m3 = 0;
    }
    if (missed_m3 > 0) {
      heap(this.field, time_s, this.opened.edge, this.width_m, missed_m3);
    }
    if (Number.isFinite(bucket.payload_kg)) {
      this.opened = null;
    }
  }

  /// No machine cuts on such a way. Who is at once elsewhere has begun anew, on soil as it was.
  private look_for_jump(time_s: number, edge: Edge): void {
    const {seen} = this;
    const since_s = seen ? time_s - seen.time_s : Infinity;
    if (seen === null || !is_jump(place(seen.edge), place(edge), since_s)) {
      return;
    }
    this.arriving_s = time_s + kArrive_s;
    if (!is_one_sensor(seen.edge.drives ?? [], edge.drives ?? [], since_s)) {
      this.field.lay_anew(time_s);
      this.load?.empty(time_s);
      this.falling_m3 = 0;
      this.opened = null;
    }
  }
}

const place = ({x_m, y_m, z_m}: Edge): Vector3 => [x_m, y_m, z_m];
