// SPDX-License-Identifier: Apache-2.0
/// `window.grabenFilm`, only with `?film` in the page's address: a log shown picture by picture, for
/// who photographs the page.

import type {PageState} from '../basics/page_state';
import type {SceneFrame} from './scene_frame';

export interface GrabenFilm {
  /// '' while the log is read, then 'ready', or what is wrong with it.
  state(): string;
  extent(): readonly [number, number];  ///< The log's seconds.
  /// Shows a moment; done when all of it has been drawn, the soil as it was cut until then as well.
  show(time_s: number): Promise<void>;
}

declare global {
  interface Window {
    grabenFilm?: Readonly<GrabenFilm>;
  }
}

export const is_film = (search: string): boolean => new URLSearchParams(search).has('film');

/// An hour's soil takes seconds, once: a picture without all of it is better than none.
const MOST_MS = 60_000;

/// `draw_all` makes the page's next frame draw what it otherwise draws now and then.
export function offer_film(state: PageState, scene: SceneFrame, draw_all: () => void): void {
  window.grabenFilm = Object.freeze({
    state: () => state.trouble || (state.ended && state.loaded_share === 1 ? 'ready' : ''),
    extent: () => [state.extent.from_s, state.extent.until_s] as const,
    show: (time_s: number) => new Promise<void>((done) => {
      state.playhead.playing = false;
      state.playhead.seek(time_s);
      draw_all();
      const until_ms = performance.now() + MOST_MS;
      const look = (): void => {
        if (scene.settled() || performance.now() > until_ms) {
          done();
        } else {
          requestAnimationFrame(look);
        }
      };
      // The first frame draws, the second is asked for once that is done.
      requestAnimationFrame(() => requestAnimationFrame(look));
    }),
  });
}
