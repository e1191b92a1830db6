// SPDX-License-Identifier: Apache-2.0
/// A log goes by itself, from where it is told or where the machine first moves, again and again:
/// there is nothing here to press.

import {moment_of} from '../model/moment';
import type {PageState} from '../view/basics/page_state';
import {telling_start} from '../view/page/first_sight';

export class Replay {
  private begun: unknown = null;

  /// `hash`: of the page's address, `#t=12.3` begins there.
  constructor(private readonly hash: string) {}

  update(state: PageState): void {
    const {setup, playhead, store} = state;
    if (setup?.source.mode !== 'log' || !state.ended || state.loaded_share < 1 || store.frames === 0) {
      return;
    }
    if (this.begun !== setup) {
      this.begun = setup;
      const told = moment_of(this.hash)?.time_s;
      playhead.seek(told !== undefined ? told + state.origin_s : telling_start(store) ?? store.from_s);
    }
    if (!playhead.playing) {
      playhead.playing = true;
    }
  }
}
