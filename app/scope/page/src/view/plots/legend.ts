// SPDX-License-Identifier: Apache-2.0
/// The lines of a plot by name, colour and value at the cursor; each can be put out of the picture.

import type {FrameStore, Reading} from '../../model/api';
import {is_stale} from '../../model/integrity';
import {button, el, set_attribute, set_text} from '../basics/dom';
import {fixed, unit_words} from '../basics/format';
import type {Line, PlotSpec} from './plots';

interface Entry {
  node: HTMLButtonElement;
  value: HTMLElement;
  line: Line;
  shown: boolean;
}

export class Legend {
  readonly node = el('div', {class: 'legend'});
  private readonly entries: Entry[];

  /// `take_out`: a line that the reader has put there goes.
  constructor(
    spec: PlotSpec, toggled: (line: number, shown: boolean) => void,
    take_out: (signal: string) => void) {
    this.entries = spec.lines.map((line, index) => {
      const value = el('span', {class: 'value'}, '–');
      const node = button('', () => {
        entry.shown = !entry.shown;
        set_attribute(node, 'aria-pressed', String(entry.shown));
        toggled(index, entry.shown);
      }, {class: 'legend-entry', 'aria-pressed': 'true', title: 'Show or hide this line'});
      node.append(
        el('span', {class: `swatch ${line.style}`, style: `--line: var(--${line.colour})`}),
        el('span', {class: 'label'}, line.label), value,
        el('span', {class: 'unit'}, unit_words(line.unit ?? spec.unit)));
      const entry: Entry = {node, value, line, shown: true};
      return entry;
    });
    this.node.append(...this.entries.flatMap(({node, line}) => (line.own === undefined ? [node]
      : [node, button('×', () => take_out(line.own!), {
        class: 'legend-entry take-out', 'aria-label': `Take ${line.label} out of the plot`})])));
  }

  shown(line: number): boolean {
    return this.entries[line]?.shown ?? false;
  }

  values(store: FrameStore, time_s: number): void {
    for (const {value, line, shown} of this.entries) {
      if (shown) {
        const {message} = line.trace;
        const reading = line.trace.reading(store, time_s);
        set_text(value, reading_words(reading, line.digits));
        const stale = message !== null && is_stale(store, message, reading.age_s);
        value.classList.toggle('stale', stale);
      }
    }
  }
}

export function reading_words(reading: Reading, digits: number): string {
  switch (reading.state) {
    case 'valid':
      return fixed(reading.value, digits);
    case 'error':
      return 'error';
    case 'notAvailable':
      return 'n/a';
    case 'never':
      return '–';
  }
}
