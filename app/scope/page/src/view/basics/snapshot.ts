// SPDX-License-Identifier: Apache-2.0
/// What the controller says of itself at one moment, read once for all parts of the panel.

import type {FrameStore, Reading} from '../../model/api';
import {is_stale} from '../../model/integrity';

export const MODES = ['Silent', 'Ready', 'Armed', 'Active', 'Stopping', 'Fault'] as const;
export type Mode = (typeof MODES)[number];

export interface Snapshot {
  mode: Mode | null;
  mode_age_s: number;
  lambda: Reading;
  limit_kind: number | null;
  limit_index: number;
  fault: number;         ///< 0: none.
  waits_for: number;     ///< The same of a controller that has not been ready yet, which is no fault.
  why_not_armed: Reading;
  stale: boolean;        ///< EcuStatus does not come any more.
}

const VALID_FAULTS = 250;

export function snapshot(store: FrameStore, time_s: number): Snapshot {
  const read = (signal: string): Reading => store.database === null
    ? {value: NaN, raw: 0, state: 'never', age_s: Infinity}
    : store.reading(signal, time_s);
  const mode = read('EcuStatus.Mode');
  const kind = read('EcuStatus.LimitKind');
  const fault = read('EcuStatus.Fault');
  const code = fault.state === 'valid' && fault.raw <= VALID_FAULTS ? fault.raw : 0;
  return {
    mode: mode.state === 'valid' ? MODES[mode.raw] ?? null : null,
    mode_age_s: mode.age_s,
    lambda: read('EcuStatus.Lambda'),
    limit_kind: kind.state === 'valid' ? kind.raw : null,
    limit_index: read('EcuStatus.LimitIndex').raw,
    fault: time_s >= store.ready_s ? code : 0,
    waits_for: time_s >= store.ready_s ? 0 : code,
    why_not_armed: read('EcuHealth.WhyNotArmed'),
    stale: is_stale(store, 'EcuStatus', mode.age_s),
  };
}

/// The trouble codes that DM1 names just then; several take turns within a second, or come together.
export function active_codes(store: FrameStore, time_s: number): number[] {
  if (store.database === null) {
    return [];
  }
  const rows = store.rows('DM1');
  const codes = new Set<number>();
  for (let row = rows.at(time_s); row >= 0 && time_s - rows.time(row) < DM1_TURN_S; --row) {
    const code = dm1_code(store, row);
    if (code > 0) {
      codes.add(code);
    }
  }
  return [...codes].sort((a, b) => a - b);
}

/// A broadcast of all of them is up to 0.3 s late where a workshop's tool asks for another one.
export const DM1_TURN_S = 1.35;
const FIRST_SPN = 520192;  ///< SPN of a fault: this and its number.

/// Number of the fault in one DM1; 0 for none.
export function dm1_code(store: FrameStore, row: number): number {
  const {buffer, at} = store.rows('DM1').bytes(row);
  const signals = store.database?.messages.get('DM1')?.signals;
  const low = signals?.get('SpnLow')?.raw(buffer, at) ?? 0;
  const high = signals?.get('SpnHigh')?.raw(buffer, at) ?? 0;
  const code = high * 65536 + low - FIRST_SPN;
  return code > 0 && code <= VALID_FAULTS ? code : 0;
}
