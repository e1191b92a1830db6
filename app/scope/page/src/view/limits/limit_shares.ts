// SPDX-License-Identifier: Apache-2.0
/// How long what held lambda, over the window of the plots: counted once, for the strip's key and the
/// run's table alike.

import type {FrameStore} from '../../model/api';
import {limit_key} from './limit_colours';
import type {PageState} from '../basics/page_state';

export interface LimitShare {
  key: number;    ///< As limit_key makes it.
  share: number;  ///< Of the window's frames that say Active.
}

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
  const counts = new Map<number, number>();
  const last = rows.at(until_s);
  let all = 0;
  for (let row = rows.at(from_s) + 1; row <= last; ++row) {
    const {buffer, at} = rows.bytes(row);
    if (mode.raw(buffer, at) !== ACTIVE) {
      continue;
    }
    ++all;
    const key = limit_key(kind.raw(buffer, at), index.raw(buffer, at));
    counts.set(key, (counts.get(key) ?? 0) + 1);
  }
  return [...counts].map(([key, count]) => ({key, share: count / all}))
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
