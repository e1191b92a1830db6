// SPDX-License-Identifier: Apache-2.0
/// Velocities as they are, beside those that are wanted: the slope of a measured stroke or angle
/// over a short stretch of time, long enough that the steps of its raw value do not show.

import type {Curve, FrameStore, Kind, Reading} from './api';
import {decimator, EMPTY, rows_of_window} from './curve';
import type {SignalLayout} from './dbc';
import {Series} from './series';

/// Half the stretch: 0.05 mm of a stroke over twice this is 0.6 mm/s.
const HALF_S = 0.04;

/// A drive's signals. The bus says a wanted velocity before it is scaled by EcuStatus.Lambda (so
/// does TaskStatus for the swing): lambda times it is what the real one should be. A dozer's blade
/// is wanted as it is: lambda slows its travel.
export interface DriveSignals {
  name: string;
  measured: string;  ///< Stroke in mm or angle in mrad.
  wanted: string;    ///< mm/s or mrad/s.
  scaled_by_lambda: boolean;
}

const EXCAVATOR: readonly DriveSignals[] = [
  {name: 'boom', measured: 'BoomStroke.BoomStroke', wanted: 'EcuMotion.BoomWantedVelocity',
    scaled_by_lambda: true},
  {name: 'arm', measured: 'ArmStroke.ArmStroke', wanted: 'EcuMotion.ArmWantedVelocity',
    scaled_by_lambda: true},
  {name: 'bucket', measured: 'BucketStroke.BucketStroke',
    wanted: 'EcuMotion.BucketWantedVelocity', scaled_by_lambda: true},
];
const SWING: DriveSignals = {name: 'swing', measured: 'SwingState.SwingAngle',
  wanted: 'TaskStatus.SwingWantedVelocity', scaled_by_lambda: true};
const BLADE: DriveSignals = {name: 'blade', measured: 'BladeStroke.BladeStroke',
  wanted: 'EcuMotion.WantedBladeVelocity', scaled_by_lambda: false};

export function drive_signals(kind: Kind, has_swing: boolean): readonly DriveSignals[] {
  return kind === 'dozer' ? [BLADE] : has_swing ? [...EXCAVATOR, SWING] : EXCAVATOR;
}

/// What lambda leaves of a wanted velocity at a time; the reading of the velocity where the drive's
/// is not scaled.
export function followed_velocity(
  store: FrameStore, drive: DriveSignals, time_s: number): Reading {
  const wanted = store.reading(drive.wanted, time_s);
  const lambda = drive.scaled_by_lambda ? store.reading('EcuStatus.Lambda', time_s).value : 1;
  return {...wanted, value: wanted.value * lambda};
}

/// Slope of a signal about a time, a second; at the newest frame, of the last moments before it.
export function velocity(store: FrameStore, signal: string, time_s: number): Reading {
  const at = store.reading(signal, time_s);
  const series = series_of(store, signal);
  if (at.state !== 'valid' || series === null) {
    return {...at, value: NaN};
  }
  const last = series.at(time_s + HALF_S);
  const first = Math.max(0, series.at(series.time(last) - 2 * HALF_S));
  const span_s = series.time(last) - series.time(first);
  const value = (value_at(store, signal, series, last) - value_at(store, signal, series, first)) /
    span_s;
  return {...at, value: span_s > 0 && span_s < 4 * HALF_S ? value : NaN};
}

interface Kept {
  revision: number;
  from_s: number;
  until_s: number;
  buckets: number;
  curve: Curve;
}
const kept = new WeakMap<FrameStore, Map<string, Kept>>();

/// The slope over a window, as FrameStore.curve has the signal.
export function velocity_curve(store: FrameStore, signal: string, from_s: number,
                               until_s: number, buckets: number): Curve {
  const curves = kept.get(store) ?? new Map<string, Kept>();
  kept.set(store, curves);
  const last = curves.get(signal);
  const {revision} = store;
  if (last !== undefined && last.revision === revision && last.from_s === from_s &&
      last.until_s === until_s && last.buckets === buckets) {
    return last.curve;
  }
  const curve = make_velocity_curve(store, signal, from_s, until_s, buckets);
  curves.set(signal, {revision, from_s, until_s, buckets, curve});
  return curve;
}

function make_velocity_curve(store: FrameStore, signal: string, from_s: number, until_s: number,
                             buckets: number): Curve {
  const series = series_of(store, signal);
  const window = series && rows_of_window(series, from_s - HALF_S, until_s + HALF_S);
  if (series === null || window === null || store.database === null || !(buckets >= 1)) {
    return EMPTY;
  }
  const def = store.database.signal(signal) as SignalLayout;
  const {first, last} = window;
  const rows = last - first + 1;
  const {time_s, value} = columns(series, def, first, rows);
  const curve = decimator(rows, from_s, until_s, buckets, def.message);
  for (let row = 0, begin = 0; row < rows; ++row) {
    while (time_s[row] - time_s[begin] > 2 * HALF_S + 1e-9) {
      ++begin;
    }
    const span_s = time_s[row] - time_s[begin];
    if (span_s >= HALF_S) {
      curve.add(0.5 * (time_s[row] + time_s[begin]), (value[row] - value[begin]) / span_s);
    }
  }
  return curve.curve();
}

/// Times and physical values, NaN where not valid, of these rows.
function columns(series: Series, def: SignalLayout, first: number, rows: number):
    {time_s: Float64Array; value: Float64Array} {
  const time_s = new Float64Array(rows);
  const value = new Float64Array(rows);
  for (const piece of series.pieces) {
    const begin = Math.max(0, first - piece.start);
    const end = Math.min(piece.rows, first + rows - piece.start);
    for (let row = begin; row < end; ++row) {
      const raw = def.raw(piece.bytes, 8 * row);
      const valid = raw >= def.raw_min && raw <= def.raw_max;
      time_s[piece.start + row - first] = piece.time_s[row];
      value[piece.start + row - first] = valid ? raw * def.factor + def.offset : NaN;
    }
  }
  return {time_s, value};
}

function series_of(store: FrameStore, signal: string): Series | null {
  const rows = store.rows(signal.split('.')[0]);
  return rows instanceof Series ? rows : null;
}

function value_at(store: FrameStore, signal: string, series: Series, row: number): number {
  return store.reading(signal, series.time(row)).value;
}
