// SPDX-License-Identifier: Apache-2.0
/// Twenty seconds that show what there is to see, on the first simulation that a browser opens: they
/// end in a fault, and in what the controller did of it. Whoever has asked for less motion is not
/// shown them unless asked for in the help.

import type {SimSetup} from '../../model/api';
import {button, el, set_shown, set_text} from '../basics/dom';
import {has_motion} from './first_sight';
import type {PageState, View} from '../basics/page_state';
import {snapshot} from '../basics/snapshot';

const KEY = 'graben-scope-toured';
const STOP_MS = 4000;

interface Stop {
  at: string;     ///< What is looked at.
  words: string;
  fault?: true;   ///< One is injected as it begins.
}

const STOPS: readonly Stop[] = [
  {at: '.scene', words: 'A simulated machine, drawn from the frames on its bus and nothing else. '
    + 'Blue: the path it is to follow.'},
  {at: '#state', words: 'Lambda is the share of the wanted speed that the hydraulics allow just now, '
    + 'and below it stands what holds it. The direction is never given up for speed.'},
  {at: '[data-name="lambda"]', words: 'The same over time: each colour of the strip is one limit. Drag '
    + 'to zoom, click to look at a moment.'},
  {at: '#sim', words: 'Now a fault: the frames of a stroke stop coming.', fault: true},
  {at: '#state', words: ''},
];

function remembered(): boolean {
  try {
    return localStorage.getItem(KEY) !== null;
  } catch {
    return true;  // Where nothing can be remembered, it would come each time.
  }
}

function remember(): void {
  try {
    localStorage.setItem(KEY, 'yes');
  } catch {
    // Lasts until the page is closed, then.
  }
}

/// A fault that stays, best the silence of a stroke.
const fault_of = (sim: SimSetup): string | undefined =>
  (sim.faults.find(({id}) => id === 'stroke-silent') ?? sim.faults.find(({once}) => !once))?.id;

export class Tour implements View {
  readonly node: HTMLElement;
  private readonly words = el('p', {role: 'status'});
  private readonly next = button('Next', () => this.go_on());
  private readonly end = button('Skip the tour', () => this.finish());
  private readonly back = button('Take the fault back', () => {
    this.state?.send({do: 'clear'});
    this.finish();
  }, {class: 'primary'});
  private state: PageState | null = null;
  private stop = -1;
  private since_ms = 0;
  private offered = remembered();

  constructor() {
    this.node = el('aside', {class: 'tour', 'aria-label': 'Tour', hidden: true}, this.words,
      el('div', {class: 'row'}, this.back, this.next, this.end));
  }

  update(state: PageState): void {
    this.state = state;
    const sim = state.setup?.source.mode === 'sim' ? state.setup.sim : undefined;
    const active = snapshot(state.store, state.playhead.now_s).mode === 'Active';
    if (!this.offered && sim !== undefined && state.sim !== null && active && has_motion()) {
      this.offered = true;
      this.start();
    }
    if (this.stop >= 0 && this.stop < STOPS.length - 1
        && performance.now() - this.since_ms > STOP_MS) {
      this.go_on();
    }
    if (this.stop === STOPS.length - 1) {
      this.write_end(state);
    }
  }

  /// Also by the help's button.
  start(): void {
    this.stop = -1;
    this.go_on();
  }

  private go_on(): void {
    this.look_at(null);
    this.stop = Math.min(this.stop + 1, STOPS.length - 1);
    this.since_ms = performance.now();
    const {at, words, fault} = STOPS[this.stop]!;
    set_text(this.words, words);
    const is_last = this.stop === STOPS.length - 1;
    set_shown(this.node, true);
    set_shown(this.back, is_last);
    set_shown(this.next, !is_last);
    set_text(this.end, is_last ? 'Close' : 'Skip the tour');
    this.look_at(document.querySelector(at));
    const sim = this.state?.setup?.sim;
    const id = sim === undefined ? undefined : fault_of(sim);
    if (fault === true && id !== undefined) {
      this.state?.send({do: 'fault', id, value: true});
    }
  }

  private write_end({store, playhead}: PageState): void {
    const {mode, fault} = snapshot(store, playhead.now_s);
    set_text(this.words, mode === 'Fault' || mode === 'Stopping'
      ? `The controller stopped by itself: fault ${fault}, every spool in neutral. The list of faults has `
        + 'the moment; a click shows it.'
      : 'What the controller does of it stands here.');
  }

  private look_at(node: Element | null): void {
    document.querySelectorAll('.toured').forEach((one) => one.classList.remove('toured'));
    node?.classList.add('toured');
    node?.scrollIntoView({block: 'center'});
  }

  private finish(): void {
    this.stop = -1;
    this.look_at(null);
    set_shown(this.node, false);
    remember();
  }
}
