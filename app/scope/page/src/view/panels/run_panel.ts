// SPDX-License-Identifier: Apache-2.0
/// Of a run that is over: its figures, and what held lambda for how long in the plots' window.

import type {Run} from '../../model/api';
import {built_map} from './built_map';
import {el, section, set_shown, set_text} from '../basics/dom';
import {fixed, time_words} from '../basics/format';
import {limit_colour} from '../limits/limit_colours';
import type {LimitShares} from '../limits/limit_shares';
import {limit_name} from '../limits/limit_strip';
import type {PageState, View} from '../basics/page_state';
import type {ThemeSwitch} from '../basics/theme';
import type {PageWords} from '../basics/words';

export class RunPanel implements View {
  readonly node = section('run', 'Run');
  private built_for: Run | null = null;
  private readonly held = el('div');
  private readonly held_note = el('p', {class: 'note'});
  private readonly held_rows = el('tbody');
  private held_written: unknown = null;

  constructor(
    private readonly theme: ThemeSwitch, private readonly words: PageWords,
    private readonly shares: LimitShares,
  ) {
    this.held.append(el('h3', {}, 'What held lambda'), this.held_note,
      el('table', {class: 'shares'},
        el('caption', {class: 'hidden'}, 'Share of the time per limit'), this.held_rows));
    theme.on_change(() => {
      this.held_written = null;
    });
  }

  update(state: PageState): void {
    const {setup} = state;
    this.write_held(state);
    const run = setup?.run ?? null;
    set_shown(this.node, run !== null);
    if (run === null || run === this.built_for) {
      return;
    }
    this.built_for = run;
    const heading = this.node.querySelector('h2')!;
    heading.textContent = run.title === '' ? 'Run' : run.title;
    this.node.replaceChildren(heading, el('p', {class: 'subtitle'}, run.subtitle),
      ...listed('As built', built_map(run.built)), figures(run), this.held,
      ...(setup?.version === undefined ? [] :
        [el('p', {class: 'subtitle'}, `Graben ${setup.version}`)]));
  }

  private write_held({playhead, origin_s}: PageState): void {
    set_shown(this.held, this.shares.rows.length > 0);
    if (this.held_written === this.shares.rows) {
      return;
    }
    this.held_written = this.shares.rows;
    const [from_s, until_s] = playhead.window;
    set_text(this.held_note, `${time_words(from_s - origin_s)} to `
      + `${time_words(until_s - origin_s)}, what the plots show`);
    this.held_rows.replaceChildren(...this.shares.rows.map(({key, share}) => {
      const colour = limit_colour(this.theme, key);
      const style = `--line: ${colour}; --share: ${Math.max(0.3, share * 100)}%`;
      return el('tr', {},
        el('th', {scope: 'row'}, limit_name(key, this.words.limit)),
        el('td', {class: 'number'}, `${fixed(share * 100, 1)} %`),
        el('td', {class: 'bar-cell', 'aria-hidden': 'true'}, el('span', {class: 'bar', style})));
    }));
  }
}

const listed = (title: string, node: HTMLElement | null): HTMLElement[] =>
  node === null ? [] : [el('h3', {}, title), node];

function figures(run: Run): HTMLElement {
  return el('table', {class: 'summary'},
    el('caption', {class: 'hidden'}, 'Figures of the run'),
    el('tbody', {}, ...run.summary.map(({label, value, unit, note}) => el('tr', {},
      el('th', {scope: 'row'}, label, note === '' ? null : el('span', {class: 'note'}, note)),
      el('td', {class: 'number'}, String(value)),
      el('td', {class: 'unit'}, unit)))));
}
