/// Every fault that began, by EcuStatus and by DM1, in the order of time; at most so many.

import type {FrameStore} from '../model/api';
import {dm1_code, DM1_TURN_S} from './snapshot';

export interface FaultEvent {
  time_s: number;
  code: number;
  dm1_only: boolean;
}

const MOST = 200;
/// The same code in EcuStatus and DM1 is one fault.
const TOGETHER_S = 1.2;
const SAME_S = 1e-6;  ///< Closer than frames can be.

export class FaultLog {
  /// Oldest first, the newest `MOST` of them.
  events: readonly FaultEvent[] = [];
  total = 0;
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
    const more = this.from_dm1.filter((event) => !status.some((one) =>
      one.code === event.code && Math.abs(one.time_s - event.time_s) < TOGETHER_S));
    const all = more.length === 0 ? status
      : [...status, ...more].sort((a, b) => a.time_s - b.time_s);
    const ends = (list: readonly FaultEvent[]) =>
      `${list.length} ${list.at(0)?.time_s} ${list.at(-1)?.time_s}`;
    const kept = all.slice(-MOST);
    const changed = other || ends(kept) !== ends(this.events) || all.length !== this.total;
    if (changed) {
      this.total = all.length;
      this.events = kept;
    }
    return changed;
  }

  /// The fault that began last, at a time or before it; with a code, the last one of that code.
  last(time_s: number, code?: number): FaultEvent | undefined {
    let found: FaultEvent | undefined;
    for (const event of this.events) {
      const meant = event.time_s <= time_s && (code === undefined || event.code === code);
      found = meant ? event : found;
    }
    return found;
  }

  /// The next one to begin.
  next(time_s: number): FaultEvent | undefined {
    return this.events.find((event) => event.time_s > time_s + SAME_S);
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
        this.from_dm1.splice(0, this.from_dm1.length - MOST);
      }
      this.seen_s.set(code, time_s);
    }
  }
}
