// SPDX-License-Identifier: Apache-2.0
/// Every fault that began, by EcuStatus and by DM1, in the order of time.

import type {FrameStore} from '../../model/api';
import {dm1_code, DM1_TURN_S} from '../basics/snapshot';

export interface FaultEvent {
  time_s: number;
  code: number;
  dm1_only: boolean;
}

const MOST_BY_DM1 = 2000;
/// The same code in EcuStatus and DM1 is one fault.
const TOGETHER_S = 1.2;
const SAME_S = 1e-6;  ///< Closer than frames can be.

export class FaultLog {
  events: readonly FaultEvent[] = [];  ///< Oldest first.
  private store: FrameStore | null = null;
  private revision = -1;
  private read_s = -Infinity;
  private from_dm1: FaultEvent[] = [];
  private readonly seen_s = new Map<number, number>();

  /// Whether there is something new.
  update(store: FrameStore): boolean {
    const other = store !== this.store;
    if (!other && store.revision === this.revision) {
      return false;
    }
    this.store = store;
    if (other || store.until_s < this.read_s) {
      this.begin_anew();
    }
    this.revision = store.revision;
    this.read_dm1(store);
    const status = store.faults().map(({time_s, code}) => ({time_s, code, dm1_only: false}));
    const more = this.from_dm1.filter(({time_s, code}) => {
      let at = first_after(status, time_s - TOGETHER_S);
      while (at < status.length && status[at]!.time_s < time_s + TOGETHER_S
          && status[at]!.code !== code) {
        ++at;
      }
      return !(at < status.length && status[at]!.time_s < time_s + TOGETHER_S);
    }).filter(({time_s}) => time_s >= store.ready_s);
    const all = more.length === 0 ? status
      : [...status, ...more].sort((a, b) => a.time_s - b.time_s);
    const ends = (list: readonly FaultEvent[]) =>
      `${list.length} ${list.at(0)?.time_s} ${list.at(-1)?.time_s}`;
    const changed = other || ends(all) !== ends(this.events);
    if (changed) {
      this.events = all;
    }
    return changed;
  }

  /// The fault that began last, at a time or before it; with a code, the last one of that code.
  last(time_s: number, code?: number): FaultEvent | undefined {
    let at = first_after(this.events, time_s) - 1;
    while (at >= 0 && code !== undefined && this.events[at]!.code !== code) {
      --at;
    }
    return this.events[at];
  }

  /// The next one to begin.
  next(time_s: number): FaultEvent | undefined {
    return this.events[first_after(this.events, time_s + SAME_S)];
  }

  private begin_anew(): void {
    this.read_s = -Infinity;
    this.from_dm1 = [];
    this.seen_s.clear();
  }

  /// Only the frames that are new.
  private read_dm1(store: FrameStore): void {
    if (store.database === null) {
      return;
    }
    const rows = store.rows('DM1');
    for (let row = rows.at(this.read_s) + 1; row < rows.count; ++row) {
      const code = dm1_code(store, row);
      const time_s = rows.time(row);
      this.read_s = time_s;
      if (code === 0) {
        continue;
      }
      if (time_s - (this.seen_s.get(code) ?? -Infinity) > 2 * DM1_TURN_S) {
        this.from_dm1.push({time_s, code, dm1_only: true});
        this.from_dm1.splice(0, this.from_dm1.length - MOST_BY_DM1);
      }
      this.seen_s.set(code, time_s);
    }
  }
}

/// Index of the first event later than this.
function first_after(events: readonly FaultEvent[], time_s: number): number {
  let [low, high] = [0, events.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (events[middle]!.time_s <= time_s) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}
