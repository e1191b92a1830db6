// SPDX-License-Identifier: Apache-2.0
/// What the frames say of the machine at a time, and whether that still holds.

import type {FrameStore, SignalDef} from '../model/api';

/// A value that is older than this many of its message's cycles is no longer true.
export const kStaleCycles = 3;
/// So far back in frames a valid value is looked for; what it stands at then is not known at all.
const kFramesBack = 500;

export interface Measured {
  value: number;   ///< SI; the last valid one before now, NaN if there is none.
  fresh: boolean;  ///< Of now, and valid.
}

const kNone: Measured = {value: NaN, fresh: false};

/// To SI, by the DBC's unit.
export function si_factor(unit: string): number {
  switch (unit) {
    case 'mm': case 'mm/s': case 'mrad': case 'mrad/s': return 1e-3;
    case 'MPa': return 1e6;
    case 'kN': return 1e3;
    case '%': return 1e-2;
    default: return 1;
  }
}

export function is_fresh(age_s: number, cycle_ms: number): boolean {
  return age_s <= kStaleCycles * (cycle_ms > 0 ? cycle_ms : 100) / 1000 + 1e-9;
}

/// `signal` as 'BoomStroke.BoomStroke', which the store's database has to have.
export function measured(store: FrameStore, signal: string, now_s: number): Measured {
  const def = store.database?.signal(signal);
  const reading = store.reading(signal, now_s);
  if (!def || reading.state === 'never') {
    return kNone;
  }
  if (reading.state === 'valid') {
    return {
      value: reading.value * si_factor(def.unit),
      fresh: is_fresh(reading.age_s, def.message.cycle_ms)};
  }
  return {value: last_valid(store, def, now_s), fresh: false};
}

function last_valid(store: FrameStore, def: SignalDef, now_s: number): number {
  const rows = store.rows(def.message.name);
  const from = rows.at(now_s);
  for (let i = from; i >= 0 && i > from - kFramesBack; --i) {
    const value = decoded(def, rows.bytes(i));
    if (!Number.isNaN(value)) {
      return value;
    }
  }
  return NaN;
}

/// SI; NaN unless valid.
export function decoded(def: SignalDef, frame: {buffer: Uint8Array; at: number}): number {
  const raw = def.raw(frame.buffer, frame.at);
  return def.state(raw) === 'valid' ?
    (raw * def.factor + def.offset) * si_factor(def.unit) : NaN;
}

/// The values of one signal for someone who goes through time: no search for each.
export class SignalWalk {
  private readonly def: SignalDef;
  private readonly rows: ReturnType<FrameStore['rows']>;
  private index: number;
  private read = -2;
  private value = NaN;

  /// Valid until frames come or go.
  constructor(store: FrameStore, signal: string, from_s: number) {
    this.def = store.database!.signal(signal);
    this.rows = store.rows(this.def.message.name);
    this.index = this.rows.at(from_s);
  }

  /// SI; NaN unless valid and fresh. Times must not fall.
  at(time_s: number): number {
    while (this.index + 1 < this.rows.count && this.rows.time(this.index + 1) <= time_s) {
      ++this.index;
    }
    if (this.index < 0 ||
        !is_fresh(time_s - this.rows.time(this.index), this.def.message.cycle_ms)) {
      return NaN;
    }
    if (this.read !== this.index) {
      this.read = this.index;
      this.value = decoded(this.def, this.rows.bytes(this.index));
    }
    return this.value;
  }
}
