// SPDX-License-Identifier: Apache-2.0
/// Where the curves of the plots come from: a signal of a frame, what the model makes of signals,
/// or what only the simulation of a finished run knew.

import type {Curve, FrameStore, Reading, Run} from '../../model/api';
import {cut, lower_bound} from '../basics/curves';

export interface Trace {
  /// Of whose frames it is made; null: of none.
  readonly message: string | null;
  readonly signals: readonly string[];  ///< All that it reads.
  curve(store: FrameStore, from_s: number, until_s: number, buckets: number): Curve;
  reading(store: FrameStore, time_s: number): Reading;
}

export function signal_trace(signal: string): Trace {
  return {
    message: signal.split('.')[0]!,
    signals: [signal],
    curve: (store, from_s, until_s, buckets) => store.curve(signal, from_s, until_s, buckets),
    reading: (store, time_s) => store.reading(signal, time_s),
  };
}

/// The same in another unit.
export function in_unit(trace: Trace, factor: number): Trace {
  return {
    ...trace,
    curve(store, from_s, until_s, buckets) {
      const {time_s, value} = trace.curve(store, from_s, until_s, buckets);
      return {time_s, value: value.map((one) => one * factor)};
    },
    reading(store, time_s) {
      const reading = trace.reading(store, time_s);
      return {...reading, value: reading.value * factor};
    },
  };
}

type TruthLine = Run['truth']['lines'][number];

export function truth_trace(run: Run, line: TruthLine, scale: number): Trace {
  const times = run.truth.time_s;
  return {
    message: null,
    signals: [],
    curve: (_store, from_s, until_s, buckets) =>
      cut(times, line.values, scale, from_s, until_s, buckets),
    reading(_store, time_s) {
      const after = lower_bound(times, time_s);
      const at = times[after] === time_s ? after : after - 1;
      const value = line.values[at];
      return value === null || value === undefined
        ? {value: NaN, raw: 0, state: at < 0 ? 'never' : 'notAvailable', age_s: Infinity}
        : {value: value * scale, raw: 0, state: 'valid', age_s: 0};
    },
  };
}

const DEG = 180 / Math.PI;

/// Factors into the units that the plots have.
const FACTORS: Readonly<Record<string, number>> = {
  'm>mm': 1e3,
  'm/s>mm/s': 1e3,
  'rad/s>deg/s': DEG,
  'mrad/s>deg/s': 1e-3 * DEG,
  'm/s>km/h': 3.6,
  'mm/s>km/h': 3.6e-3,
  'Pa>MPa': 1e-6,
  'm3/s>L/min': 6e4,
  '>per mille': 1e3,
  '%>per mille': 10,
  '>%': 100,
};

/// What a value in `from` is multiplied with to be one in `to`; nothing where they are not alike.
export function unit_factor(from: string, to: string): number | null {
  return from === to ? 1 : FACTORS[`${from}>${to}`] ?? null;
}
