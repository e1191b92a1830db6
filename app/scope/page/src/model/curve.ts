/// Curves for the screen straight from the frames: an hour of a 100 Hz signal is 360,000 of them,
/// read in some milliseconds, so that nothing has to be kept beside the frames.

import type {Curve} from './api';
import type {SignalLayout} from './dbc';
import type {Piece, Series} from './series';

/// A line is broken where frames are missing for longer than three cycles, and than this: a live
/// bus stutters.
const LEAST_GAP_S = 0.1;
const GAP_WITHOUT_CYCLE_S = 1;

export const EMPTY: Curve = {time_s: new Float64Array(0), value: new Float64Array(0)};

/// From the last frame before the window to the first one after it, so that lines reach its edges.
/// Where there are more than two frames a bucket, each bucket gives its least and its greatest in
/// their order; the buckets stand still while the window moves on.
export function make_curve(series: Series, signal: SignalLayout, from_s: number, until_s: number,
                           buckets: number): Curve {
  if (series.count === 0 || !(until_s > from_s) || !(buckets >= 1)) {
    return EMPTY;
  }
  const first = Math.max(0, series.at(from_s));
  const last = Math.min(series.count - 1, series.at(until_s) + 1);
  const rows = last - first + 1;
  const width_s = rows > 2 * buckets ? (until_s - from_s) / buckets : 0;
  const most = width_s > 0 ? 3 * (buckets + 3) : 2 * rows;
  const curve = new CurveMaker(signal, width_s, most);
  for (const piece of series.pieces) {
    const begin = Math.max(0, first - piece.start);
    const end = Math.min(piece.rows, last + 1 - piece.start);
    if (begin < end) {
      curve.add(piece, begin, end);
    }
  }
  return curve.done();
}

class CurveMaker {
  private time_s: Float64Array;
  private value: Float64Array;
  private points = 0;
  private readonly gap_s: number;
  private last_s = Infinity;     ///< Of the frame before.
  private bucket_end_s = -Infinity;
  private least = Infinity;      ///< Raw, of the bucket.
  private greatest = -Infinity;
  private least_s = 0;
  private greatest_s = 0;

  /// With a width of 0 every frame is a point.
  constructor(private readonly signal: SignalLayout, private readonly width_s: number,
              most: number) {
    const cycle_s = signal.message.cycle_ms / 1000;
    this.gap_s = cycle_s > 0 ? Math.max(LEAST_GAP_S, 3 * cycle_s) : GAP_WITHOUT_CYCLE_S;
    this.time_s = new Float64Array(most);
    this.value = new Float64Array(most);
  }

  add(piece: Piece, begin: number, end: number): void {
    const {raw, raw_min, raw_max, word_at} = this.signal;
    const {time_s, bytes} = piece;
    for (let row = begin; row < end; ++row) {
      const now_s = time_s[row];
      if (now_s >= this.bucket_end_s || now_s - this.last_s > this.gap_s) {
        this.next_bucket(now_s);
      }
      this.last_s = now_s;
      const at = 8 * row;
      // Nearly all signals are words; a call each for the others.
      const value = word_at >= 0 ? bytes[at + word_at] | (bytes[at + word_at + 1] << 8)
        : raw(bytes, at);
      if (value < raw_min || value > raw_max) {
        if (this.width_s === 0) {
          this.point(now_s, NaN);
        }
        continue;
      }
      if (value < this.least) {
        this.least = value;
        this.least_s = now_s;
      }
      if (value > this.greatest) {
        this.greatest = value;
        this.greatest_s = now_s;
      }
    }
  }

  done(): Curve {
    this.flush();
    return {
      time_s: this.time_s.subarray(0, this.points), value: this.value.subarray(0, this.points)};
  }

  private next_bucket(now_s: number): void {
    const had_value = this.flush();
    const silent = now_s - this.last_s > this.gap_s;
    if (silent || (!had_value && this.width_s > 0 && this.points > 0)) {
      this.point(silent ? 0.5 * (this.last_s + now_s) : this.last_s, NaN);
    }
    const {width_s} = this;
    this.bucket_end_s = width_s > 0 ? (Math.floor(now_s / width_s) + 1) * width_s : now_s;
  }

  /// Writes what the bucket had; false if it was nothing.
  private flush(): boolean {
    const {least, greatest, least_s, greatest_s} = this;
    if (least === Infinity) {
      return false;
    }
    if (least_s < greatest_s) {
      this.point(least_s, this.physical(least));
      this.point(greatest_s, this.physical(greatest));
    } else {
      this.point(greatest_s, this.physical(greatest));
      if (least_s > greatest_s) {
        this.point(least_s, this.physical(least));
      }
    }
    this.least = Infinity;
    this.greatest = -Infinity;
    return true;
  }

  private physical(raw: number): number {
    return raw * this.signal.factor + this.signal.offset;
  }

  private point(time_s: number, value: number): void {
    if (this.points === this.time_s.length) {
      this.grow();
    }
    this.time_s[this.points] = time_s;
    this.value[this.points++] = value;
  }

  /// Gaps beyond what was foreseen.
  private grow(): void {
    const time_s = new Float64Array(2 * this.points + 8);
    const value = new Float64Array(2 * this.points + 8);
    time_s.set(this.time_s);
    value.set(this.value);
    this.time_s = time_s;
    this.value = value;
  }
}
