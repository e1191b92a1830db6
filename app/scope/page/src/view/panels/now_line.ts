// SPDX-License-Identifier: Apache-2.0
/// What the controller does and how fast, in one line beside the time: where there is no room for more.

import {el, set_attribute, set_shown, set_text} from '../basics/dom';
import {fixed} from '../basics/format';
import type {PageState, View} from '../basics/page_state';
import {snapshot} from '../basics/snapshot';
import type {PageWords} from '../basics/words';

export class NowLine implements View {
  private readonly mode = el('b', {class: 'now-mode'});
  private readonly lambda = el('span', {class: 'now-lambda'});
  private readonly held = el('span', {class: 'now-held'});
  readonly node = el('p', {class: 'now-line', hidden: true}, this.mode, this.lambda, this.held);

  constructor(private readonly words: PageWords) {}

  update(state: PageState): void {
    const now = snapshot(state.store, state.playhead.now_s);
    set_shown(this.node, state.setup !== null && state.setup.source.mode !== 'plan');
    this.node.classList.toggle('stale', now.stale || state.is_gone);
    set_text(this.mode, now.mode ?? 'Unknown');
    set_attribute(this.mode, 'data-mode', now.mode ?? 'none');
    const valid = now.lambda.state === 'valid';
    set_text(this.lambda, `lambda ${valid ? fixed(now.lambda.value, 3) : '–'}`);
    const held = valid && now.limit_kind !== null && now.limit_kind !== 0;
    set_text(this.held, held ? `held by ${this.words.limit(now.limit_kind!, now.limit_index)}` : '');
  }
}
