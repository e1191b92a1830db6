// SPDX-License-Identifier: Apache-2.0
/// What task Assist does about its design, and what it waits for.

import type {FrameStore} from '../model/api';
import {fresh} from '../model/wanted';
import {kAssist} from '../scene/shown_task';

/// By the number that EcuMotion.Assist has.
const WORDS = [
  'Assist has no design here: the levers alone',
  'Assist waits: the edge is not near the design',
  "Assist is ready: it holds once the arm's lever moves",
  'Assist holds: boom and bucket follow the arm',
  "Assist has let go: let the arm's lever rest, then move it",
  'Assist waits: beyond the border of the design',
] as const;

/// Null: another task, or nobody says so now.
export function assist_of(store: FrameStore, now_s: number): number | null {
  if (store.database?.kind !== 'excavator' || fresh(store, 'OperatorCommand.Task', now_s) !== kAssist) {
    return null;
  }
  const state = fresh(store, 'EcuMotion.Assist', now_s);
  return WORDS[state] === undefined ? null : state;
}

export function assist_words(store: FrameStore, now_s: number): string | null {
  const state = assist_of(store, now_s);
  return state === null ? null : WORDS[state]!;
}
