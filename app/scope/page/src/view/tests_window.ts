/// `window.grabenScope`: what a test, or an engineer at the browser's console, may read. It steers
/// nothing.

import {snapshot} from './snapshot';
import type {FrameRate} from './frame_rate';
import type {PageState} from './page_state';
import type {SceneFrame} from './scene_frame';

export interface GrabenScope {
  /// The teeth or the edge as drawn, ground frame, m; null while there is no machine.
  tip(): readonly [number, number, number] | null;
  /// The moment shown, in the log's seconds.
  now(): number;
  /// EcuStatus.Mode in words; null while it is not known.
  mode(): string | null;
  frames(): number;      ///< Seen since the source began.
  heldFrames(): number;  ///< Of the DBC's messages, in memory.
  fps(): number;         ///< Frames of the screen drawn in the last second.
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
    now: () => state.playhead.now_s,
    mode: () => snapshot(state.store, state.playhead.now_s).mode,
    frames: () => state.store.frames,
    heldFrames: () => [...state.store.database?.messages.keys() ?? []]
      .reduce((sum, name) => sum + state.store.rows(name).count, 0),
    fps: () => rate.per_second(performance.now()),
    messages: () => state.messages().map(({message, age_s, integrity, rate_hz}) =>
      ({name: message.name, age_s, integrity, rate_hz})),
  });
}
