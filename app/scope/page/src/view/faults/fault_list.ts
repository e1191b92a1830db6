// SPDX-License-Identifier: Apache-2.0
/// The faults as a list; a click shows the moment at which one began.

import {button, el, Rows, section, set_attribute, set_shown, set_text} from '../basics/dom';
import type {FaultLog} from './fault_log';
import {date_words, time_words} from '../basics/format';
import type {PageState, View} from '../basics/page_state';
import {snapshot} from '../basics/snapshot';
import type {PageWords} from '../basics/words';

/// So many can be scrolled through; the buttons go from each to the next beyond them too.
const LISTED = 200;

interface Row {
  node: HTMLElement;
  press: HTMLButtonElement;
  time: HTMLElement;
  number: HTMLElement;
  words: HTMLElement;
  time_s: number;
}

export class FaultList implements View {
  readonly node: HTMLElement;
  private readonly none = el('p', {class: 'quiet'}, 'No fault so far.');
  private readonly more = el('p', {class: 'quiet'});
  private readonly list = el('ol', {class: 'faults', reversed: true});
  private readonly rows: Rows<Row>;
  private known: unknown = null;

  constructor(
    private readonly log: FaultLog, private readonly words: PageWords,
    seek: (time_s: number) => void,
  ) {
    this.node = section('faults', 'Faults so far', this.none, this.list, this.more);
    this.rows = new Rows(this.list, () => {
      const [time, number, words] = [el('span', {class: 'time'}), el('span', {class: 'code'}),
        el('span', {class: 'words'})];
      const press = button('', () => seek(row.time_s), {class: 'fault-row'});
      press.append(time, number, words);
      const row: Row = {node: el('li', {}, press), press, time, number, words, time_s: 0};
      return row;
    });
  }

  update(state: PageState): void {
    set_shown(this.node, state.setup?.source.mode !== 'plan');
    this.log.update(state.store);
    const {events} = this.log;
    const listed = Math.min(events.length, LISTED);
    if (this.known !== events) {
      this.known = events;
      this.write(state);
    }
    set_shown(this.none, events.length === 0);
    set_shown(this.more, events.length > listed);
    set_text(this.more, `${events.length - listed} older ones are not listed.`);
    const {fault} = snapshot(state.store, state.playhead.now_s);
    const now = fault === 0 ? undefined : this.log.last(state.playhead.now_s, fault);
    for (const row of this.rows.take(listed)) {
      set_attribute(row.press, 'aria-current', row.time_s === now?.time_s ? 'true' : null);
    }
  }

  /// Newest first.
  private write(state: PageState): void {
    const {events} = this.log;
    const rows = this.rows.take(Math.min(events.length, LISTED));
    rows.forEach((row, k) => {
      const event = events[events.length - 1 - k]!;
      row.time_s = event.time_s;
      set_text(row.time, time_words(event.time_s - state.origin_s));
      set_text(row.number, String(event.code));
      set_text(row.words, this.words.fault(event.code) + (event.dm1_only ? ' (DM1)' : ''));
      set_attribute(row.press, 'title',
        `Show this moment. ${date_words(event.time_s)}`.trim());
      set_attribute(row.press, 'aria-label',
        `Fault ${event.code}, ${this.words.fault(event.code)}, at ${row.time.textContent}: show`);
    });
  }
}
