// SPDX-License-Identifier: Apache-2.0
/// Curves for the screen straight from the frames: an hour of a 100 Hz signal is 360,000 of them,
/// read in some milliseconds, so that nothing has to be kept beside the frames.

import type {Curve, MessageDef} from './api';
import type {SignalLayout} from './dbc';
import {Decimator} from './decimator';
import type {Piece, Series} from './series';

/// A line is broken where frames are missing for longer than three cycles, and than this: a live
/// bus stutters.
const LEAST_GAP_S = 0.1;
const GAP_WITHOUT_CYCLE_S = 1;

export const EMPTY: Curve = {time_s: new Float64Array(0), value: new Float64Array(0)};

export function gap_s(message: MessageDef): number {
  const cycle_s = message.cycle_ms / 1000;
  return cycle_s > 0 ? Math.max(LEAST_GAP_S, 3 * cycle_s) : GAP_WITHOUT_CYCLE_S;
}

/// Rows of a window: from the last frame before it to the first one after it, so that lines reach
/// its edges. Null: none.
export function rows_of_window(
  series: Series, from_s: number, until_s: number): {first: number; last: number} | null {
  if (series.count === 0 || !(until_s > from_s)) {
    return null;
  }
  return {
    first: Math.max(0, series.at(from_s)),
    last: Math.min(series.count - 1, series.at(until_s) + 1),
  };
}

/// For so many rows of a window: buckets only where there are more than two rows each.
export function decimator(rows: number, from_s: number, until_s: number, buckets: number,
                          message: MessageDef): Decimator {
  const bucketed = rows > 2 * buckets;
  const width_s = bucketed ? (until_s - from_s) / buckets : 0;
  return new Decimator(width_s, gap_s(message), bucketed ? 2 * buckets + 8 : rows + 8);
}

export function make_curve(series: Series, signal: SignalLayout, from_s: number, until_s: number,
                           buckets: number): Curve {
  const window = rows_of_window(series, from_s, until_s);
  if (window === null || !(buckets >= 1)) {
    return EMPTY;
  }
  const {first, last} = window;
  const curve = decimator(last - first + 1, from_s, until_s, buckets, signal.message);
  for (const piece of series.pieces) {
    const begin = Math.max(0, first - piece.start);
    const end = Math.min(piece.rows, last + 1 - piece.start);
    if (begin < end) {
      add_rows(curve, signal, piece, begin, end);
    }
  }
  return curve.curve();
}

function add_rows(
  curve: Decimator, signal: SignalLayout, piece: Piece, begin: number, end: number): void {
  const {raw, raw_min, raw_max, word_at, factor, offset} = signal;
  const {time_s, bytes} = piece;
  for (let row = begin; row < end; ++row) {
    const at = 8 * row;
    // Nearly all signals are words; a call each for the others.
    const value = word_at >= 0 ? bytes[at + word_at] | (bytes[at + word_at + 1] << 8)
      : raw(bytes, at);
    const valid = value >= raw_min && value <= raw_max;
    curve.add(time_s[row], valid ? value * factor + offset : NaN);
  }
}
