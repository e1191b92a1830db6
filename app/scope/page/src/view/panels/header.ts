// SPDX-License-Identifier: Apache-2.0
/// Name, source in words, machine, connection.

import type {Machine} from '../../model/api';
import {button, el, set_attribute, set_shown, set_text} from '../basics/dom';
import {count, hash_words} from '../basics/format';
import type {PageState, View} from '../basics/page_state';
import type {ThemeSwitch} from '../basics/theme';

const TASKS: Readonly<Record<string, string>> = {
  dig: 'simulated dig', grade: 'simulated grade', autodig: 'simulated autodig',
};

/// Sources of a server, which has the operator's view of them too.
const SERVED = new Set(['can', 'sim', 'log']);

export function source_words({setup, link}: PageState): string {
  if (setup === null) {
    return link.state === 'connecting' ? 'connecting …' : 'no source';
  }
  const {mode, name} = setup.source;
  switch (mode) {
    case 'can':
      return `live from ${name}`;
    case 'sim':
      return TASKS[setup.sim?.task ?? name] ?? `simulated ${name}`;
    case 'log':
      return `log ${name}`;
    case 'report':
      return `report ${setup.run?.title ?? name}`;
    case 'plan':
      return `plan ${setup.run?.title ?? name}`;
  }
}

export class Header implements View {
  readonly node: HTMLElement;
  private readonly source = el('p', {class: 'source'});
  private readonly machine = el('p', {class: 'machine'});
  private readonly link = el('p', {class: 'link-state', role: 'status'});
  /// Another page, of the same server.
  private readonly operators = el('a', {class: 'button', href: 'operator', target: '_blank', hidden: true},
    "Operator's view");
  private readonly theme_button: HTMLButtonElement;

  constructor(private readonly theme: ThemeSwitch, help: () => void) {
    this.theme_button = button('', () => theme.toggle(), {class: 'quiet-button'});
    this.node = el('header', {class: 'top'},
      el('h1', {}, 'Graben scope'), this.source, this.machine, this.link,
      el('div', {class: 'top-buttons'}, this.operators, this.theme_button,
        button('Help (?)', help, {class: 'quiet-button', 'aria-haspopup': 'dialog'})));
    theme.on_change(() => this.name_theme());
    this.name_theme();
  }

  update(state: PageState): void {
    const words = source_words(state);
    set_text(this.source, words);
    const title = `${words} – Graben scope`;
    if (document.title !== title) {
      document.title = title;
    }
    const mode = state.setup?.source.mode;
    set_shown(this.operators, mode !== undefined && SERVED.has(mode) && location.protocol.startsWith('http'));
    const {machine, store} = state;
    const hash = store.health.profile_hash;
    set_text(this.machine, machine !== null ? machine_words(machine)
      : hash !== null ? `unknown machine ${hash_words(hash)}` : 'no machine yet');
    set_attribute(this.link, 'data-state', state.link.state);
    set_text(this.link, link_words(state));
  }

  private name_theme(): void {
    set_text(this.theme_button, this.theme.dark ? 'Light theme' : 'Dark theme');
  }
}

/// Names of shipped profiles tell the kind themselves.
function machine_words({kind, name}: Machine): string {
  return name.startsWith(kind) ? name : `${kind} ${name}`;
}

export function link_words({link, loaded_share, store, setup, ended}: PageState): string {
  const frames = `${count(store.frames)} frames`;
  if (link.state === 'lost') {
    return 'connection lost';
  }
  if (link.state === 'connecting') {
    return 'connecting …';
  }
  if (loaded_share < 1 && !ended) {
    return setup?.source.bytes === undefined ? 'reading'
      : `reading, ${count(loaded_share * 100)} %`;
  }
  if (link.state === 'file') {
    return setup?.source.mode === 'plan' ? 'no frames: a plan' : `all here, ${frames}`;
  }
  return ended ? `all here, ${frames}` : `connected, ${frames}`;
}
