// SPDX-License-Identifier: Apache-2.0
/// The parts beside the pictures: the state, the digits, the lights, lambda, what is missing.

import {limit_colour, limit_key} from '../view/limits/limit_colours';
import {el, Rows, set_attribute, set_shown, set_text} from '../view/basics/dom';
import {count} from '../view/basics/format';
import type {PageState} from '../view/basics/page_state';
import {snapshot} from '../view/basics/snapshot';
import type {ThemeSwitch} from '../view/basics/theme';
import type {PageWords} from '../view/basics/words';
import {big_state, missing, not_live} from './big_state';
import {LIGHTS, lights_of, off_words, type Off} from './cut_fill';
import {Shrinking, tell_em} from './fit_words';

export class StateBand {
  private readonly word = el('p', {class: 'state-word'});
  private readonly more = el('p', {class: 'state-more'});
  private readonly kind = el('b');
  private readonly source = el('span');
  private readonly tag = el('p', {class: 'not-live', hidden: true}, this.kind, this.source);
  private readonly band = el('div', {class: 'state', role: 'status'}, this.word, this.more, this.tag);
  private readonly shrinking = new Shrinking(this.more, () => this.more.scrollHeight <= this.more.clientHeight + 1
    && this.more.getBoundingClientRect().bottom <= this.band.getBoundingClientRect().bottom);
  readonly node = el('header', {}, el('h1', {class: 'heard'}, "Graben: the operator's view"), this.band);

  constructor(private readonly words: PageWords) {}

  update(state: PageState): void {
    const {word, mode, more} = big_state(state, this.words);
    set_attribute(this.band, 'data-mode', mode);
    set_text(this.word, word);
    set_text(this.more, more);
    const told = not_live(state.setup);
    set_attribute(this.band, 'data-not-live', told !== null);
    set_shown(this.tag, told !== null);
    set_text(this.kind, told?.kind ?? '');
    set_text(this.source, told?.of ?? '');
    this.shrinking.update();
  }
}

/// As operator.css has them, and a little more.
const GAPS_EM = 0.7;
const SHARE_EM = 3.4;
const ARROWS = {over: '▼', under: '▲', on: '', unknown: ''};

export class Digits {
  readonly digits = el('p', {class: 'digits', 'aria-hidden': 'true'});
  private readonly arrow = el('span', {class: 'arrow', 'aria-hidden': 'true'});
  private readonly word = el('span');
  private readonly unit = el('span', {class: 'unit'});
  private readonly line = el('p', {class: 'cut-word'}, this.arrow, this.word, this.unit);
  readonly node = el('section', {class: 'cut-fill', 'aria-label': 'Cut or fill'}, this.digits, this.line);

  show(off: Off | null): void {
    const {digits, unit, word, side} = off_words(off);
    set_attribute(this.node, 'data-side', side);
    set_text(this.digits, digits);
    set_text(this.arrow, ARROWS[side]);
    set_text(this.word, word);
    set_text(this.unit, unit);
    tell_em(this.line, [ARROWS[side], word, unit], GAPS_EM);
  }
}

/// From far above to far below, the middle broad.
export class LightBar {
  private readonly lights = Array.from({length: 2 * LIGHTS + 1}, (_, i) =>
    el('div', {class: i === LIGHTS ? 'light middle' : i < LIGHTS ? 'light high' : 'light low'}));
  readonly node = el('div', {class: 'light-bar', role: 'img'}, ...this.lights);

  show(off: Off | null): void {
    const lit = lights_of(off);
    this.lights.forEach((light, i) => {
      const place = LIGHTS - i;
      const on = lit !== null && (place === 0 ? lit === 0
        : place > 0 ? lit >= place : lit <= place);
      set_attribute(light, 'data-on', on);
    });
    const {word} = off_words(off);
    set_attribute(this.node, 'aria-label', `Light bar: ${word}`);
  }
}

export class LambdaBar {
  private readonly share = el('span', {class: 'share'});
  private readonly word = el('span', {class: 'held'});
  private readonly bar = el('div', {class: 'bar', 'aria-hidden': 'true'}, el('div'));
  private readonly line = el('p', {}, this.share, this.word);
  readonly node = el('section', {class: 'lambda', 'aria-label': 'Lambda: share of the wanted speed'},
    this.bar, this.line);

  constructor(private readonly words: PageWords, private readonly theme: ThemeSwitch) {}

  update({store, playhead, is_gone}: PageState): void {
    const now = snapshot(store, playhead.now_s);
    const valid = now.lambda.state === 'valid' && !now.stale && !is_gone && now.mode === 'Active';
    const held = valid && now.limit_kind !== null && now.limit_kind !== 0;
    const share = valid ? Math.max(0, Math.min(1, now.lambda.value)) : 0;
    this.bar.style.setProperty('--share', `${100 * share}%`);
    this.bar.style.setProperty('--line', held
      ? limit_colour(this.theme, limit_key(now.limit_kind!, now.limit_index)) : 'var(--primary)');
    set_text(this.share, valid ? `${count(100 * share)} %` : '–');
    set_text(this.word, held ? `held by ${this.words.limit(now.limit_kind!, now.limit_index)}`
      : valid ? 'full speed, nothing holds' : 'of the wanted speed: not active');
    tell_em(this.line, [this.word.textContent ?? ''], SHARE_EM);
  }
}

const MOST = 4;

export class Checklist {
  private readonly title = el('h2');
  private readonly list = el('ul');
  private readonly rows = new Rows(this.list, () => ({node: el('li')}));
  readonly node = el('section', {class: 'checklist', 'aria-label': 'Arming checklist'}, this.title,
    this.list);

  private readonly shrinking = new Shrinking(this.node, () => this.node.scrollHeight <= this.node.clientHeight + 1);

  constructor(private readonly words: PageWords) {}

  update(state: PageState): void {
    const items = missing(state, this.words);
    const mode = snapshot(state.store, state.playhead.now_s).mode;
    const enabled = mode === 'Armed' || mode === 'Active';
    set_attribute(this.node, 'data-ready', items !== null && (enabled || items.length === 0));
    set_text(this.title, items === null ? 'Not known what is missing'
      : enabled || items.length === 0 ? 'Nothing is missing' : 'Missing before it can arm');
    const shown = items === null || enabled ? []
      : items.length > MOST ? [...items.slice(0, MOST - 1), `And ${items.length - MOST + 1} more.`]
        : items;
    this.rows.take(shown.length).forEach(({node}, k) => set_text(node, shown[k]!));
    set_shown(this.list, shown.length > 0);
    if (this.node.parentElement !== null) {
      set_attribute(this.node.parentElement, 'data-missing', shown.length > 0);
    }
    this.shrinking.update();
  }
}
