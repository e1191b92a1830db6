// SPDX-License-Identifier: Apache-2.0
/// Makes a curve of a stream of samples: all of them, or the least and the greatest of each bucket
/// of time, in their order.

import type {Curve} from './api';

export class Decimator {
  private time_s: Float64Array;
  private value: Float64Array;
  private points = 0;
  private last_s = Infinity;  ///< Of the sample before.
  private bucket_end_s = -Infinity;
  private least = Infinity;
  private greatest = -Infinity;
  private least_s = 0;
  private greatest_s = 0;

  /// Buckets stand at multiples of their width, so that they stay where they are while a window
  /// moves over them; with a width of 0 every sample is a point. The line is broken where no sample
  /// comes for `gap_s`, and where a whole bucket has no value.
  constructor(private readonly width_s: number, private readonly gap_s: number, room: number) {
    this.time_s = new Float64Array(room);
    this.value = new Float64Array(room);
  }

  /// NaN: there is a sample, but it has no value.
  add(now_s: number, value: number): void {
    if (now_s >= this.bucket_end_s || now_s - this.last_s > this.gap_s) {
      this.next_bucket(now_s);
    }
    this.last_s = now_s;
    if (value < this.least) {
      this.least = value;
      this.least_s = now_s;
    }
    if (value > this.greatest) {
      this.greatest = value;
      this.greatest_s = now_s;
    }
  }

  curve(): Curve {
    this.flush();
    const {time_s, value, points} = this;
    return {time_s: time_s.subarray(0, points), value: value.subarray(0, points)};
  }

  private next_bucket(now_s: number): void {
    const {width_s} = this;
    this.flush();
    if (now_s - this.last_s > this.gap_s) {
      this.point(0.5 * (this.last_s + now_s), NaN);
    }
    this.bucket_end_s = width_s > 0 ? (Math.floor(now_s / width_s) + 1) * width_s : now_s;
  }

  private flush(): void {
    const {least, greatest, least_s, greatest_s} = this;
    if (this.last_s === Infinity) {
      return;
    }
    if (least === Infinity) {
      this.point(this.last_s, NaN);
      return;
    }
    if (least_s < greatest_s) {
      this.point(least_s, least);
    }
    this.point(greatest_s, greatest);
    if (least_s > greatest_s) {
      this.point(least_s, least);
    }
    this.least = Infinity;
    this.greatest = -Infinity;
  }

  private point(time_s: number, value: number): void {
    if (this.points === this.time_s.length) {
      this.grow();
    }
    this.time_s[this.points] = time_s;
    this.value[this.points++] = value;
  }

  private grow(): void {
    const time_s = new Float64Array(2 * this.points + 8);
    const value = new Float64Array(2 * this.points + 8);
    time_s.set(this.time_s);
    value.set(this.value);
    this.time_s = time_s;
    this.value = value;
  }
}
