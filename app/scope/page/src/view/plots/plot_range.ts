// SPDX-License-Identifier: Apache-2.0
/// Ranges and bars of plots.

import type uPlot from 'uplot';

const STRIP_SHARE = 0.2;  ///< Below 0, for the coloured strip of limits.

export const stable_range = (
  least: readonly [number, number] | undefined, strip: boolean,
): uPlot.Range.Function => (_plot, data_min, data_max) =>
  plain_range(least, strip, data_min, data_max);

export function plain_range(
  least: readonly [number, number] | undefined, strip: boolean, data_min: number, data_max: number,
): [number, number] {
  let min = Number.isFinite(data_min) ? data_min : 0;
  let max = Number.isFinite(data_max) ? data_max : 1;
  if (least !== undefined) {
    min = Math.min(min, least[0]);
    max = Math.max(max, least[1]);
  }
  if (strip) {
    return [-STRIP_SHARE, Math.max(1.04, max)];
  }
  if (min === max) {
    min -= 1;
    max += 1;
  }
  const step = nice_step((max - min) / 5);
  const low = Math.floor(min / step + 1e-9) * step;
  const high = Math.ceil(max / step - 1e-9) * step;
  // A curve along the frame could be taken for the frame; one that is 0 at rest needs no room.
  return [min === low && min !== 0 ? low - step / 2 : low, max === high ? high + step / 4 : high];
}

/// 1, 2 or 5 times a power of ten, not below `step`.
export function nice_step(step: number): number {
  const power = 10 ** Math.floor(Math.log10(step));
  const lead = step / power;
  return power * (lead <= 1.0001 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

export const BARS = 24;

export interface Distribution {
  cycles: number;
  all_zero: boolean;
  median_us: number;
  p99_us: number;
  max_us: number;
  bar_us: number;
  bars: Uint32Array;
}

/// Of times in us; they are sorted in place.
export function distribution(times_us: Float64Array): Distribution {
  times_us.sort();
  const cycles = times_us.length;
  const at = (share: number) =>
    cycles === 0 ? NaN : times_us[Math.min(cycles - 1, Math.floor(share * cycles))]!;
  const max_us = cycles === 0 ? NaN : times_us[cycles - 1]!;
  // A single outlier must not squeeze all others into one bar: the last bar holds what is beyond.
  const bar_us = Math.max(1, nice_step((at(0.995) * 1.1) / BARS || 1));
  const bars = new Uint32Array(BARS);
  for (const time_us of times_us) {
    ++bars[Math.min(BARS - 1, Math.floor(time_us / bar_us))]!;
  }
  return {
    cycles, all_zero: max_us === 0, median_us: at(0.5), p99_us: at(0.99), max_us, bar_us, bars,
  };
}
