/// The banner of alarms below the header. A sentence that stays is not written again, so that a
/// screen reader hears it once.

import {alarms_of, type Alarm} from './alarm_rules';
import {button, el, set_shown} from './dom';
import type {PageState, View} from './page_state';
import type {PageWords} from './words';

export class Alarms implements View {
  readonly node = el('div', {class: 'alarms', role: 'region', 'aria-label': 'Alarms'});
  private readonly loud = el('ul', {role: 'alert'});
  private readonly quiet = el('ul', {role: 'status'});
  private written = '';

  constructor(private readonly words: PageWords, private readonly to_fault: () => void) {
    this.node.append(this.loud, this.quiet);
  }

  update(state: PageState): void {
    const alarms = alarms_of(state, this.words);
    const key = alarms.map(({level, words}) => `${level} ${words}`).join('\n');
    if (key === this.written) {
      return;
    }
    this.written = key;
    set_shown(this.node, alarms.length > 0);
    this.write(this.loud, alarms.filter(({level}) => level === 'alarm'));
    this.write(this.quiet, alarms.filter(({level}) => level === 'warning'));
  }

  private write(list: HTMLElement, alarms: readonly Alarm[]): void {
    list.replaceChildren(...alarms.map(({id, level, words, at}) => el('li', {
      class: level, 'data-alarm': id,
    }, el('strong', {}, level === 'alarm' ? 'Alarm' : 'Notice'), el('span', {}, words),
    at === 'fault' ? button('Show its start', this.to_fault, {class: 'link'}) : null)));
  }
}
