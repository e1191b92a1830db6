// SPDX-License-Identifier: Apache-2.0
/// Frames of strokes that the page made itself, for nobody sent them: without counter or CRC.

import type {SignalLayout} from './dbc';
import type {Series} from './series';

function write(signal: SignalLayout, stroke_m: number, bytes: Uint8Array, at: number): void {
  const raw = Math.round((1000 * stroke_m - signal.offset) / signal.factor);
  const told = raw >= signal.raw_min && raw <= signal.raw_max ? raw : 0xffff;
  bytes[at + signal.word_at] = told & 0xff;
  bytes[at + signal.word_at + 1] = told >> 8;
}

/// `found`: strokes in m, a row for each time; `signals` and `into`: one for each stroke.
export function append_strokes(signals: readonly SignalLayout[], time_s: readonly number[],
  found: readonly (readonly number[])[], into: readonly Series[]): void {
  signals.forEach((signal, k) => {
    const bytes = new Uint8Array(8 * found.length);
    found.forEach((drives, row) => write(signal, drives[k]!, bytes, 8 * row));
    into[k]!.append(Float64Array.from(time_s), bytes);
  });
}
