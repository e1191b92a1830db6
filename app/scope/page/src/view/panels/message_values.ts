// SPDX-License-Identifier: Apache-2.0
/// All values of one message, decoded, with units.

import type {MessageDef, Reading, SignalDef} from '../../model/api';
import {is_stale} from '../../model/integrity';
import {button, el, set_text} from '../basics/dom';
import {digits_of, fixed, name_words, unit_words} from '../basics/format';
import type {PageState} from '../basics/page_state';
import {drag_from} from '../plots/signal_drag';

export class MessageValues {
  readonly node = el('dl', {class: 'facts signals'});
  private readonly rows: {signal: SignalDef; row: HTMLElement; value: HTMLElement}[] = [];

  /// `plot`: where a signal is to go is asked.
  constructor(private readonly message: MessageDef, plot: (signal: string) => void) {
    for (const signal of message.signals.values()) {
      const path = `${message.name}.${signal.name}`;
      const value = el('dd');
      const row = el('div', {title: signal.description},
        el('dt', {}, name_words(signal.name)), value,
        el('dd', {}, button('Plot', () => plot(path),
          {class: 'link', 'aria-label': `Plot ${name_words(signal.name)}`})));
      drag_from(row, path);
      this.rows.push({signal, row, value});
      this.node.append(row);
    }
  }

  update({store, playhead}: PageState): void {
    for (const {signal, row, value} of this.rows) {
      const reading = store.reading(`${this.message.name}.${signal.name}`, playhead.now_s);
      set_text(value, value_words(signal, reading));
      row.classList.toggle('stale', is_stale(store, this.message.name, reading.age_s));
    }
  }
}

export function value_words(signal: SignalDef, reading: Reading): string {
  switch (reading.state) {
    case 'never':
      return 'not received';
    case 'error':
      return 'error';
    case 'notAvailable':
      return 'not available';
    case 'valid': {
      const name = signal.states.get(reading.raw);
      const value = fixed(reading.value, digits_of(signal.factor));
      return name !== undefined ? `${name_words(name)} (${reading.raw})`
        : signal.unit === '' ? value : `${value} ${unit_words(signal.unit)}`;
    }
  }
}
