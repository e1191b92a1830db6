// SPDX-License-Identifier: Apache-2.0
/// The moment that the whole page shows, and the stretch of time that its plots show.

import type {Playhead} from './api';
import {clamp} from './geometry';

/// What of a store the playhead goes by.
export interface Extent {
  readonly from_s: number;
  readonly until_s: number;
}

const LIVE_SPAN_S = 30;
const LEAST_SPAN_S = 0.02;
/// Frames come in batches; only a longer pause is silence, in which time goes on without them.
const SILENCE_S = 0.3;

/// Live it follows the newest frame and shows the last 30 s; of a log it shows all until the user
/// zooms. Times are the log's; only `tick` is told of real time.
export class PagePlayhead implements Playhead {
  /// Seconds of the bus a real second while no frames come: 1 on a bus, the pace in a simulation
  /// that runs, 0 where time stands with them.
  clock_rate = 0;

  private now = 0;
  private following: boolean;
  private moving = false;
  private speed = 1;
  private shown: readonly [number, number] = [0, 1];
  private span_s: number | null;  ///< Null: the whole log.
  private silent_s = 0;
  /// Of the page's own last frame: what came while it drew is looked at only afterwards, and a page
  /// that is late must not take that for silence of the bus.
  private owed_s = 0;
  private readonly listeners = new Set<() => void>();

  constructor(private readonly extent: Extent, live: boolean) {
    this.following = live;
    this.span_s = live ? LIVE_SPAN_S : null;
  }

  get now_s(): number { return this.now; }
  get follow(): boolean { return this.following; }
  get playing(): boolean { return this.moving; }
  get rate(): number { return this.speed; }
  get window(): readonly [number, number] { return this.shown; }

  set now_s(time_s: number) { this.seek(time_s); }

  set follow(on: boolean) {
    if (on !== this.following) {
      this.following = on;
      this.moving = this.moving && !on;
      this.update(on ? this.newest_s() : this.now);
    }
  }

  /// Playing from the end begins anew.
  set playing(on: boolean) {
    if (on !== this.moving) {
      this.moving = on;
      this.following = this.following && !on;
      this.update(on && this.now >= this.extent.until_s ? this.extent.from_s : this.now);
    }
  }

  set rate(rate: number) {
    if (rate > 0 && Number.isFinite(rate)) {
      this.speed = rate;
      this.tell();
    }
  }

  /// A zoom. Where it holds all there is, it is the whole log, and grows with it; while following,
  /// only its width counts.
  set window([from_s, until_s]: readonly [number, number]) {
    if (!(until_s >= from_s)) {
      return;
    }
    const middle = 0.5 * (from_s + until_s);
    const span = Math.max(LEAST_SPAN_S, until_s - from_s);
    const all = from_s <= this.extent.from_s && until_s >= this.extent.until_s;
    this.span_s = all && !this.following ? null : span;
    this.shown = this.into_extent(middle - 0.5 * span, middle + 0.5 * span);
    if (this.following) {
      this.shown = [this.now - span, this.now];
    }
    this.tell();
  }

  /// Stops following; a time outside what is there is taken to its end.
  seek(time_s: number): void {
    if (Number.isFinite(time_s)) {
      this.following = false;
      this.update(clamp(time_s, this.extent.from_s, this.extent.until_s));
    }
  }

  on_change(listener: () => void): void {
    this.listeners.add(listener);
  }

  /// To be called after frames were added to the store, or it began anew.
  frames_came(): void {
    this.silent_s = 0;
    this.owed_s = 0;
    this.update(this.following ? this.extent.until_s : this.now);
  }

  /// To be called once a screen frame with the real time since the last one.
  tick(real_s: number): void {
    if (this.moving) {
      const next = this.now + real_s * this.speed;
      this.moving = next < this.extent.until_s;
      this.update(next);
    } else if (this.following && this.clock_rate > 0) {
      this.silent_s += this.owed_s;
      this.owed_s = real_s;
      if (this.silent_s > SILENCE_S) {
        this.update(this.newest_s());
      }
    }
  }

  private newest_s(): number {
    const silent = this.silent_s > SILENCE_S ? this.silent_s * this.clock_rate : 0;
    return this.extent.until_s + silent;
  }

  private update(time_s: number): void {
    const {from_s, until_s} = this.extent;
    this.now = this.following ? time_s : clamp(time_s, from_s, Math.max(from_s, until_s));
    this.shown = this.window_at_now();
    this.tell();
  }

  private window_at_now(): readonly [number, number] {
    const {from_s, until_s} = this.extent;
    if (this.following) {
      const span = this.span_s ?? Math.max(LEAST_SPAN_S, until_s - from_s);
      return [this.now - span, this.now];
    }
    if (this.span_s === null) {
      return [from_s, Math.max(until_s, from_s + LEAST_SPAN_S)];
    }
    const [left, right] = this.shown;
    if (this.now >= left && this.now <= right) {
      return this.shown;
    }
    // Played or sought out of sight: a page on, or where it was sought.
    const ahead = this.now > right && this.now < right + 0.25 * this.span_s;
    const from = ahead ? right : this.now - 0.5 * this.span_s;
    return this.into_extent(from, from + this.span_s);
  }

  private into_extent(from_s: number, until_s: number): readonly [number, number] {
    const span = until_s - from_s;
    const {from_s: first, until_s: last} = this.extent;
    if (span >= last - first) {
      return [first, Math.max(last, first + LEAST_SPAN_S)];
    }
    const from = clamp(from_s, first, last - span);
    return [from, from + span];
  }

  private tell(): void {
    for (const listener of this.listeners) {
      listener();
    }
  }
}
