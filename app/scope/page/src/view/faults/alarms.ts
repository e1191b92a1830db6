// SPDX-License-Identifier: Apache-2.0
/// The banner of alarms below the header. Each keeps its place in the page for as long as it lasts:
/// a screen reader hears it once, and a number that changes in one disturbs no other.

import {alarms_of, type Alarm} from './alarm_rules';
import {button, el, set_shown, set_text} from '../basics/dom';
import type {PageState, View} from '../basics/page_state';
import type {PageWords} from '../basics/words';

export class Alarms implements View {
  readonly node = el('div', {class: 'alarms', role: 'region', 'aria-label': 'Alarms'});
  private readonly loud: AlarmList;
  private readonly quiet: AlarmList;

  constructor(private readonly words: PageWords, to_fault: () => void) {
    this.loud = new AlarmList('alert', 'Alarm', to_fault);
    this.quiet = new AlarmList('status', 'Notice', to_fault);
    this.node.append(this.loud.node, this.quiet.node);
  }

  update(state: PageState): void {
    const alarms = alarms_of(state, this.words);
    set_shown(this.node, alarms.length > 0);
    this.loud.show(alarms.filter(({level}) => level === 'alarm'));
    this.quiet.show(alarms.filter(({level}) => level === 'warning'));
  }
}

interface Shown {
  node: HTMLElement;
  words: HTMLElement;
}

/// By id; the order is that in which they are told. A list that is no list to who hears it says
/// nothing of its items, so that the role is that of what holds it.
export class AlarmList {
  readonly node: HTMLElement;
  private readonly list = el('ul');
  private readonly shown = new Map<string, Shown>();

  constructor(
    role: 'alert' | 'status', private readonly name: string, private readonly to_fault: () => void,
  ) {
    // What changes is read out, not all the list with it; of a notice, only that it came.
    this.node = el('div', {
      role, 'aria-atomic': 'false',
      'aria-relevant': role === 'alert' ? 'additions text' : 'additions',
    }, this.list);
  }

  show(alarms: readonly Alarm[]): void {
    for (const [id, {node}] of this.shown) {
      if (!alarms.some((alarm) => alarm.id === id)) {
        node.remove();
        this.shown.delete(id);
      }
    }
    alarms.forEach((alarm, place) => {
      const shown = this.shown.get(alarm.id) ?? this.make(alarm);
      set_text(shown.words, alarm.words);
      if (this.list.children[place] !== shown.node) {
        this.list.insertBefore(shown.node, this.list.children[place] ?? null);
      }
    });
  }

  private make({id, level, at}: Alarm): Shown {
    const words = el('span');
    const node = el('li', {class: level, 'data-alarm': id}, el('strong', {}, this.name), words,
      at === 'fault' ? button('Show its start', this.to_fault, {class: 'link'}) : null);
    const shown = {node, words};
    this.shown.set(id, shown);
    return shown;
  }
}
