// SPDX-License-Identifier: Apache-2.0
/// From curves with times of their own to the columns that uPlot draws: one ascending time, a
/// value of each line, `undefined` where a line has no point then and null where it has a gap.

import type {Curve} from '../../model/api';

export type Columns = [number[], ...(number | null | undefined)[][]];

export const NO_CURVE: Curve = {time_s: new Float64Array(0), value: new Float64Array(0)};

/// Times count from `origin_s`, so that an axis has round numbers in a log stamped since 1970.
export function align(curves: readonly Curve[], origin_s: number): Columns {
  const columns: Columns = [[]];
  const next = curves.map(() => 0);
  for (let k = 0; k < curves.length; ++k) {
    columns.push([]);
  }
  const times = columns[0];
  for (;;) {
    let time_s = Infinity;
    for (let k = 0; k < curves.length; ++k) {
      const at = next[k]!;
      const own = curves[k]!.time_s;
      if (at < own.length && own[at]! < time_s) {
        time_s = own[at]!;
      }
    }
    if (time_s === Infinity) {
      return columns;
    }
    const row = times.length;
    times.push(time_s - origin_s);
    for (let k = 0; k < curves.length; ++k) {
      const column = columns[k + 1]!;
      const at = next[k]!;
      const curve = curves[k]!;
      if (at < curve.time_s.length && curve.time_s[at] === time_s) {
        const value = curve.value[at]!;
        column[row] = Number.isNaN(value) ? null : value;
        next[k] = at + 1;
      } else {
        column[row] = undefined;
      }
    }
  }
}

/// The part of a line known as a whole that lies in a window, with one point beyond each end.
export function cut(
  time_s: readonly number[], value: readonly (number | null)[], scale: number,
  from_s: number, until_s: number, buckets: number,
): Curve {
  const first = Math.max(0, lower_bound(time_s, from_s) - 1);
  const last = Math.min(time_s.length, lower_bound(time_s, until_s) + 1);
  const stride = Math.max(1, Math.ceil((last - first) / (2 * buckets)));
  const times: number[] = [];
  const values: number[] = [];
  // Within a stride the least and the greatest stay, in their order, like FrameStore.curve().
  for (let begin = first; begin < last; begin += stride) {
    let least = -1;
    let most = -1;
    for (let k = begin; k < Math.min(begin + stride, last); ++k) {
      const at = value[k];
      if (at === null || at === undefined) {
        continue;
      }
      least = least < 0 || at < value[least]! ? k : least;
      most = most < 0 || at > value[most]! ? k : most;
    }
    const kept = least < 0 ? [begin] : least === most ? [least]
      : [Math.min(least, most), Math.max(least, most)];
    for (const k of kept) {
      times.push(time_s[k]!);
      values.push((value[k] ?? NaN) * scale);
    }
  }
  return {time_s: Float64Array.from(times), value: Float64Array.from(values)};
}

/// Index of the first time not before `at_s`.
export function lower_bound(time_s: readonly number[], at_s: number): number {
  let low = 0;
  let high = time_s.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time_s[middle]! < at_s) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}
