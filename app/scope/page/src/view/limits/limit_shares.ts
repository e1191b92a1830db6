// SPDX-License-Identifier: Apache-2.0
/// How long what held lambda, over the window of the plots: counted once, by time, for the strip's key and the run's table alike.
/// Across a gap a frame stands for as long as the one before it.

import type {FrameStore} from '../../model/api';
import {limit_key} from './limit_colours';
import type {PageState} from '../basics/page_state';

export interface LimitShare {
  key: number;    ///< As limit_key makes it.
  share: number;  ///< Of the window's time up to each frame that says Active.
}

/// Without a frame for longer, a piece of a log ends (model/stamps.ts).
const GAP_S = 1;
const EVERY_MS = 500;
const ACTIVE = 3;  ///< EcuStatus.Mode.

/// From every EcuStatus in the window that says Active, greatest first: over a whole run the shares of
/// the terminal and of `graben compare` (logged_limit_shares() of runs).
export function limit_shares(store: FrameStore, from_s: number, until_s: number): LimitShare[] {
  const signals = store.database?.messages.get('EcuStatus')?.signals;
  const kind = signals?.get('LimitKind');
  const index = signals?.get('LimitIndex');
  const mode = signals?.get('Mode');
  if (kind === undefined || index === undefined || mode === undefined) {
    return [];
  }
  const rows = store.rows('EcuStatus');
  const held = new Map<number, {time_s: number; frames: number}>();
  const last = rows.at(until_s);
  const passed = (row: number): number => row > 0 ? rows.time(row) - rows.time(row - 1) : 0;
  let [all_s, all] = [0, 0];
  for (let row = rows.at(from_s) + 1; row <= last; ++row) {
    const {buffer, at} = rows.bytes(row);
    if (mode.raw(buffer, at) !== ACTIVE) {
      continue;
    }
    const passed_s = passed(row);
    const time_s = passed_s <= GAP_S ? passed_s : Math.min(passed(row - 1), GAP_S);
    const key = limit_key(kind.raw(buffer, at), index.raw(buffer, at));
    const before = held.get(key) ?? {time_s: 0, frames: 0};
    held.set(key, {time_s: before.time_s + time_s, frames: before.frames + 1});
    all_s += time_s;
    ++all;
  }
  // A single frame has no time before it.
  return [...held].map(([key, {time_s, frames}]) => ({key, share: all_s > 0 ? time_s / all_s : frames / all}))
    .sort((a, b) => b.share - a.share);
}

export class LimitShares {
  rows: readonly LimitShare[] = [];
  private counted = '';
  private store: FrameStore | null = null;
  private counted_ms = -Infinity;

  /// An hour has 360 000 frames: not more often than anybody reads.
  update({store, playhead}: PageState, now_ms: number): void {
    const [from_s, until_s] = playhead.window;
    const key = `${from_s} ${until_s} ${store.revision}`;
    if ((key === this.counted && store === this.store) || now_ms - this.counted_ms < EVERY_MS) {
      return;
    }
    this.counted = key;
    this.store = store;
    this.counted_ms = now_ms;
    this.rows = limit_shares(store, from_s, until_s);
  }
}
