// SPDX-License-Identifier: Apache-2.0
/// Every message of the bus: age, rate, counter, whether it is whole; its values on demand.

import type {Integrity, MessageDef, MessageState} from '../../model/api';
import {el, section, set_attribute, set_shown, set_text} from '../basics/dom';
import {count, fixed} from '../basics/format';
import {MessageValues} from './message_values';
import type {PageState, View} from '../basics/page_state';

export const INTEGRITY_WORDS: Readonly<Record<Integrity, string>> = {
  ok: 'whole',
  crc: 'CRC wrong',
  repeated: 'repeated',
  lost: 'frames lost',
  sequence: 'out of sequence',
  silent: 'silent',
  unprotected: 'no CRC',
};

/// `wrong`: frames of the last second.
export function integrity_words(integrity: Integrity, wrong: number): string {
  return INTEGRITY_WORDS[integrity] + (wrong > 0 ? `, ${wrong} wrong in 1 s` : '');
}

const COLUMNS = 5;

class MessageRow {
  readonly node = el('tr', {class: 'message'});
  readonly detail = el('tr', {class: 'values', hidden: true});
  private readonly press: HTMLButtonElement;
  private readonly age = el('td', {class: 'number'});
  private readonly rate = el('td', {class: 'number'});
  private readonly counter = el('td', {class: 'number'});
  private readonly integrity = el('td', {class: 'integrity'});
  private values: MessageValues | null = null;

  constructor(
    private readonly definition: MessageDef, private readonly plot: (signal: string) => void) {
    const id = `values-${definition.name}`;
    this.press = el('button', {
      type: 'button', class: 'disclose', 'aria-expanded': 'false', 'aria-controls': id,
      title: `Id ${definition.id.toString(16).toUpperCase().padStart(8, '0')}, `
        + (definition.cycle_ms > 0 ? `every ${definition.cycle_ms} ms` : 'on demand'),
    }, ...breakable(definition.name));
    this.press.addEventListener('click', () => this.toggle());
    this.node.append(el('th', {scope: 'row'}, this.press), this.age, this.rate, this.counter,
      this.integrity);
    set_attribute(this.detail, 'id', id);
  }

  update(message: MessageState, state: PageState): void {
    const {age_s, stale, counter, integrity, wrong, rate_hz} = message;
    const never = !Number.isFinite(age_s);
    this.node.classList.toggle('stale', stale || never);
    set_text(this.age, never ? 'never' : age_s < 100 ? count(age_s * 1000) : '> 100 s');
    set_text(this.rate, never ? '–' : fixed(rate_hz, rate_hz < 10 ? 1 : 0));
    set_text(this.counter, counter < 0 ? '–' : String(counter));
    set_text(this.integrity, integrity_words(integrity, wrong));
    set_attribute(this.integrity, 'data-integrity', integrity);
    if (!this.detail.hidden) {
      this.values?.update(state);
    }
  }

  private toggle(): void {
    const open = this.detail.hidden;
    set_shown(this.detail, open);
    set_attribute(this.press, 'aria-expanded', String(open));
    if (open) {
      this.values = new MessageValues(this.definition, this.plot);
      this.detail.replaceChildren(el('td', {colspan: COLUMNS}, this.values.node));
    } else {
      this.values = null;
      this.detail.replaceChildren();
    }
  }
}

/// A long name may break where a word begins.
function breakable(name: string): (Node | string)[] {
  return name.split(/(?=[A-Z][a-z])/).flatMap((part, k) => (k === 0 ? [part] : [el('wbr'), part]));
}

export class MessageTable implements View {
  readonly node: HTMLElement;
  private readonly load = el('p', {class: 'bus-load'});
  private readonly table: HTMLTableElement;
  private readonly rows = new Map<string, MessageRow>();
  private readonly none = el('p', {class: 'quiet'}, 'No frames yet.');
  private built_for: unknown = null;

  constructor(private readonly plot: (signal: string) => void) {
    this.table = el('table', {class: 'messages'},
      el('caption', {class: 'hidden'}, 'Messages of the bus by sender'),
      el('colgroup', {}, el('col'), ...['age', 'rate', 'counter', 'state'].map((name) =>
        el('col', {class: name}))),
      el('thead', {}, el('tr', {},
        el('th', {scope: 'col'}, 'Message'),
        el('th', {scope: 'col', class: 'number'}, 'Age, ms'),
        el('th', {scope: 'col', class: 'number', title: 'Frames in the last second'}, 'Rate, Hz'),
        el('th', {scope: 'col', class: 'number', title: 'Counter, 0 to 14'}, 'Counter'),
        el('th', {scope: 'col'}, 'State'))));
    this.node = section('messages', 'Bus', this.load, this.none,
      el('div', {class: 'table-frame'}, this.table));
  }

  update(state: PageState): void {
    set_shown(this.node, state.setup?.source.mode !== 'plan');
    const messages = state.messages();
    set_shown(this.none, messages.length === 0);
    set_shown(this.table, messages.length > 0);
    if (state.store.database !== this.built_for) {
      this.built_for = state.store.database;
      this.build(messages);
    }
    for (const message of messages) {
      this.rows.get(message.message.name)?.update(message, state);
    }
    this.write_load(state);
  }

  private write_load({setup, store, playhead}: PageState): void {
    const bitrate = setup?.source.bitrate ?? 0;
    set_shown(this.load, bitrate > 0 && store.database !== null);
    if (bitrate > 0 && store.database !== null) {
      const share = store.bus_load(playhead.now_s, bitrate);
      set_text(this.load, `Bus load ${fixed(share * 100, 1)} % of ${count(bitrate / 1000)} kbit/s: `
        + 'every bit of every frame in the last second.');
    }
  }

  /// A body of the table for each sender, the controller's first.
  private build(messages: readonly MessageState[]): void {
    this.rows.clear();
    for (const body of [...this.table.tBodies]) {
      body.remove();
    }
    const senders = new Map<string, MessageState[]>();
    for (const message of messages) {
      const {sender} = message.message;
      senders.set(sender, [...(senders.get(sender) ?? []), message]);
    }
    const rank = (sender: string) => (sender === 'Graben' ? 0 : 1);
    for (const [sender, own] of [...senders].sort((a, b) => rank(a[0]) - rank(b[0]))) {
      const body = el('tbody', {}, el('tr', {class: 'sender'},
        el('th', {scope: 'rowgroup', colspan: COLUMNS},
          `From ${sender === 'Graben' ? 'the controller (Graben)' : sender}`)));
      for (const {message} of own) {
        const row = new MessageRow(message, this.plot);
        this.rows.set(message.name, row);
        body.append(row.node, row.detail);
      }
      this.table.append(body);
    }
  }
}
