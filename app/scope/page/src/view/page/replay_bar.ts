// SPDX-License-Identifier: Apache-2.0
/// The moment that is shown: play, pause, speed, scrub, step, jump from fault to fault.

import {button, el, set_attribute, set_shown, set_text} from '../basics/dom';
import type {FaultLog} from '../faults/fault_log';
import {date_words, time_words} from '../basics/format';
import {FaultMarks} from '../faults/fault_marks';
import {is_live, type PageState, type View} from '../basics/page_state';
import {snapshot} from '../basics/snapshot';
import type {ThemeSwitch} from '../basics/theme';

export const RATES = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50];
const CYCLE_S = 0.01;
/// A button that has few letters where there is little room; its name stays.
function terse(name: string, few: string, press: () => void, title: string): HTMLButtonElement {
  const node = button('', press, {'aria-label': name, title});
  node.append(el('span', {class: 'long'}, name), el('span', {class: 'short'}, few));
  return node;
}

/// Standing on the begin of a fault, the one before is meant.
const JUST_BEFORE_S = 1e-6;

export class ReplayBar implements View {
  readonly node: HTMLElement;
  private readonly play = button('Play', () => this.toggle(), {class: 'primary play'});
  /// Always in reach, on a phone as well: the panel's is a long way down there.
  private readonly stop = button('Stop', () => this.state.send({
    do: this.stop.dataset.running === 'true' ? 'stop' : 'run',
  }), {class: 'stop', title: 'Stop or start the simulation'});
  private readonly live = terse('Back to live', 'Live', () => {
    this.state.playhead.follow = true;
  }, 'To what comes in now (l)');
  private readonly rate = el('select', {id: 'replay-rate', 'aria-label': 'Replay speed'},
    ...RATES.map((value) => el('option', {value}, `${value}×`)));
  private readonly slider = el('input', {
    type: 'range', class: 'scrub', min: 0, max: 1, step: 'any', 'aria-label': 'Time in the log',
  });
  private readonly marks: FaultMarks;
  private readonly now = el('span', {class: 'now'});
  private readonly until = el('span', {class: 'until'});
  private readonly date = el('span', {class: 'date'});
  private readonly steps: HTMLButtonElement[];
  private readonly jumps: HTMLButtonElement[];
  private range = '';
  private shown_rate = 1;

  constructor(
    private readonly state: PageState, private readonly log: FaultLog, theme: ThemeSwitch,
  ) {
    this.marks = new FaultMarks(theme);
    this.steps = [
      terse('Step back', '◂', () => this.step(-1), 'One control cycle back (,)'),
      terse('Step on', '▸', () => this.step(1), 'One control cycle on (.)'),
    ];
    this.jumps = [
      terse('Fault before', '◂ !', () => this.jump(true), 'To the fault before (p)'),
      terse('Next fault', '! ▸', () => this.jump(false), 'To the next fault (n)'),
    ];
    this.live.classList.add('live');
    this.rate.value = '1';
    this.rate.addEventListener('change', () => {
      state.playhead.rate = Number(this.rate.value);
    });
    this.slider.addEventListener('input', () =>
      state.playhead.seek(Number(this.slider.value) + state.origin_s));
    this.node = el('footer', {class: 'replay', 'aria-label': 'Replay'},
      el('div', {class: 'replay-buttons'}, this.play, this.stop, this.live, ...this.steps, ...this.jumps, this.rate),
      el('div', {class: 'scrubber'}, this.marks.node, this.slider),
      el('p', {class: 'times'}, this.now, this.until, this.date));
    state.playhead.on_change(() => this.show_now());
  }

  toggle(): void {
    const {playhead} = this.state;
    if (playhead.follow) {
      playhead.follow = false;
    } else {
      playhead.playing = !playhead.playing;
    }
  }

  step(direction: 1 | -1): void {
    const {playhead} = this.state;
    playhead.playing = false;
    playhead.seek(this.next_cycle(direction));
  }

  jump(back: boolean): void {
    const {now_s} = this.state.playhead;
    const event = back ? this.log.last(now_s - JUST_BEFORE_S) : this.log.next(now_s);
    if (event !== undefined) {
      this.state.playhead.seek(event.time_s);
    }
  }

  /// To the beginning of the fault that is on now.
  jump_to_current(): void {
    const {playhead, store} = this.state;
    const {fault} = snapshot(store, playhead.now_s);
    const event = this.log.last(playhead.now_s, fault === 0 ? undefined : fault);
    if (event !== undefined) {
      playhead.seek(event.time_s);
    }
  }

  faster(by: 1 | -1): void {
    const {playhead} = this.state;
    const at = RATES.findIndex((rate) => rate >= playhead.rate);
    playhead.rate = RATES[Math.max(0, Math.min(RATES.length - 1, at + by))]!;
  }

  update(state: PageState): void {
    const {playhead, store, extent} = state;
    set_shown(this.live, is_live(state) && !playhead.follow);
    const {sim} = state;
    set_shown(this.stop, state.setup?.source.mode === 'sim');
    set_attribute(this.stop, 'data-running', String(sim?.running === true));
    set_text(this.stop, sim?.running === true ? 'Stop machine' : 'Start machine');
    this.stop.disabled = sim === null || state.link.state !== 'open';
    const moving = playhead.follow || playhead.playing;
    set_text(this.play, moving ? 'Pause' : 'Play');
    set_attribute(this.play, 'title', `${moving ? 'Pause' : 'Play'} (space)`);
    set_attribute(this.play, 'data-moving', String(moving));
    this.rate.disabled = playhead.follow;
    // Someone may be choosing: only what changed otherwise is written over that.
    if (playhead.rate !== this.shown_rate || document.activeElement !== this.rate) {
      this.shown_rate = playhead.rate;
      this.rate.value = String(playhead.rate);
    }
    for (const node of this.steps) {
      node.disabled = store.frames === 0 && state.setup?.run === undefined;
    }
    this.jumps[0]!.disabled = this.log.last(playhead.now_s - JUST_BEFORE_S) === undefined;
    this.jumps[1]!.disabled = this.log.next(playhead.now_s) === undefined;
    this.marks.draw(this.log.events, extent.from_s, extent.until_s);
    this.show_now();
  }

  /// Cheap: runs with every move of the playhead.
  private show_now(): void {
    const {playhead, extent, origin_s} = this.state;
    const range = `${extent.from_s} ${extent.until_s} ${origin_s}`;
    if (range !== this.range) {
      this.range = range;
      this.slider.min = String(extent.from_s - origin_s);
      this.slider.max = String(extent.until_s - origin_s);
      set_text(this.until, `of ${time_words(extent.until_s - origin_s)}`);
    }
    const words = time_words(playhead.now_s - origin_s);
    this.slider.value = String(playhead.now_s - origin_s);
    set_attribute(this.slider, 'aria-valuetext', words);
    set_text(this.now, words);
    set_text(this.date, date_words(playhead.now_s));
  }

  /// The controller commands once a cycle.
  private next_cycle(direction: 1 | -1): number {
    const {playhead, store} = this.state;
    const rows = store.database === null ? null : store.rows('SpoolCommand');
    if (rows === null || rows.count === 0) {
      return playhead.now_s + direction * CYCLE_S;
    }
    const at = rows.at(playhead.now_s);
    const on_frame = at >= 0 && rows.time(at) === playhead.now_s;
    const next = direction > 0 ? at + 1 : on_frame ? at - 1 : at;
    return next < 0 || next >= rows.count ? playhead.now_s + direction * CYCLE_S : rows.time(next);
  }
}
