/// Times in bars, for a histogram.

import {nice_step} from './plot_range';

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
