// SPDX-License-Identifier: Apache-2.0
/// `window.grabenScope`: what a test, or an engineer at the browser's console, may read. It steers
/// nothing.

import {snapshot} from '../basics/snapshot';
import type {FrameRate} from '../basics/frame_rate';
import type {PageState} from '../basics/page_state';
import type {SceneFrame} from './scene_frame';

export interface GrabenScope {
  /// The teeth or the edge as drawn, ground frame, m; null while there is no machine.
  tip(): readonly [number, number, number] | null;
  /// The same in CSS pixels from the picture's upper left corner.
  tipOnScreen(): readonly [number, number] | null;
  /// The moment shown, in the log's seconds.
  now(): number;
  /// EcuStatus.Mode in words; null while it is not known.
  mode(): string | null;
  frames(): number;      ///< Seen since the source began.
  loaded(): number;      ///< Share of a log that was read; 1 when all is there.
  heldFrames(): number;  ///< Of the DBC's messages, in memory.
  fps(): number;         ///< Frames of the screen drawn in the last second.
  /// All signals of a message as of now, physical; null where not valid.
  values(message: string): Readonly<Record<string, number | null>>;
  messages(): readonly {name: string; age_s: number; integrity: string; rate_hz: number}[];
}

declare global {
  interface Window {
    grabenScope: Readonly<GrabenScope>;
  }
}

export function tell_tests(state: PageState, scene: SceneFrame, rate: FrameRate): void {
  window.grabenScope = Object.freeze({
    tip: () => scene.tip(),
    tipOnScreen: () => scene.tipOnScreen(),
    now: () => state.playhead.now_s,
    mode: () => snapshot(state.store, state.playhead.now_s).mode,
    frames: () => state.store.frames,
    loaded: () => state.loaded_share,
    heldFrames: () => [...state.store.database?.messages.keys() ?? []]
      .reduce((sum, name) => sum + state.store.rows(name).count, 0),
    fps: () => rate.per_second(performance.now()),
    values: (message: string) => Object.fromEntries(
      [...state.store.database?.messages.get(message)?.signals.keys() ?? []].map((name) => {
        const {value} = state.store.reading(`${message}.${name}`, state.playhead.now_s);
        return [name, Number.isFinite(value) ? value : null];
      })),
    messages: () => state.messages().map(({message, age_s, integrity, rate_hz}) =>
      ({name: message.name, age_s, integrity, rate_hz})),
  });
}
