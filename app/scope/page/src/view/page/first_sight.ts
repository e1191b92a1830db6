// SPDX-License-Identifier: Apache-2.0
/// Where a run that is over is first looked at: what it has to tell, in motion.

import type {FrameStore} from '../../model/api';
import type {PageState} from '../basics/page_state';

const ACTIVE = 3;        ///< EcuStatus.Mode.
const RISE = 5;          ///< LimitKind of every start, which tells nothing.
const BEFORE_S = 1.5;    ///< So that what comes is seen coming.

/// Just before the first fault; of a healthy run, before lambda is least while a limit of the machine
/// holds it, or before the error is greatest where none does. Null: nothing was ever active.
export function telling_moment(store: FrameStore): number | null {
  const [fault] = store.faults();
  const first_s = store.from_s;
  if (fault !== undefined) {
    return Math.max(first_s, fault.time_s - BEFORE_S);
  }
  const rows = store.rows('EcuStatus');
  const signals = store.database?.messages.get('EcuStatus')?.signals;
  const [mode, kind, lambda] = ['Mode', 'LimitKind', 'Lambda'].map((name) => signals?.get(name));
  let least = Infinity;
  let found_s: number | null = null;
  let active_s: number | null = null;
  for (let row = 0; row < rows.count; ++row) {
    const {buffer, at} = rows.bytes(row);
    if (mode?.raw(buffer, at) !== ACTIVE) {
      continue;
    }
    active_s ??= rows.time(row);
    const limit = kind?.raw(buffer, at) ?? 0;
    const raw = lambda?.raw(buffer, at) ?? 0;
    if (limit !== 0 && limit !== RISE && raw < least && lambda?.state(raw) === 'valid') {
      least = raw;
      found_s = rows.time(row);
    }
  }
  const moment_s = found_s ?? active_s;
  // Before it was first ready a controller says what is missing, which looks like a fault.
  return moment_s === null ? null
    : Math.max(first_s, Math.min(moment_s, store.ready_s), moment_s - BEFORE_S);
}

/// Just before the machine first moves; null where it never does.
export function telling_start(store: FrameStore): number | null {
  const rows = store.rows('EcuStatus');
  const mode = store.database?.messages.get('EcuStatus')?.signals.get('Mode');
  for (let row = 0; row < rows.count; ++row) {
    const {buffer, at} = rows.bytes(row);
    if (mode?.raw(buffer, at) === ACTIVE) {
      return Math.max(store.from_s, rows.time(row) - BEFORE_S);
    }
  }
  return null;
}

/// Opens reports and plans once all of them is there, unless somebody was quicker. They play, but
/// where the reader has asked for less motion.
export class FirstSight {
  private seen: unknown = null;

  update(state: PageState, has_motion: boolean): void {
    const {setup, playhead, extent} = state;
    const mode = setup?.source.mode;
    if (setup === null || this.seen === setup || (mode !== 'report' && mode !== 'plan')
        || !state.ended || state.loaded_share < 1) {
      return;
    }
    this.seen = setup;
    if (playhead.playing || playhead.now_s > extent.from_s) {
      return;
    }
    const moment_s = mode === 'plan' ? extent.from_s : telling_moment(state.store);
    if (moment_s !== null) {
      playhead.seek(moment_s);
      playhead.playing = has_motion;
    }
  }
}

export const has_motion = (): boolean => !matchMedia('(prefers-reduced-motion: reduce)').matches;
