// SPDX-License-Identifier: Apache-2.0
/// The operator's view put together. It shows; there is nothing to press, and nothing that could
/// send (feed/look_feed.ts).

import {look} from '../feed/look_feed';
import {State} from '../state';
import {el} from '../view/basics/dom';
import {FrameRate} from '../view/basics/frame_rate';
import {snapshot} from '../view/basics/snapshot';
import {create_theme} from '../view/basics/theme';
import {page_words} from '../view/basics/words';
import {off_of, type Off} from './cut_fill';
import {fit_digits} from './fit_digits';
import {FrameMaker} from './frame';
import {Checklist, Digits, LambdaBar, LightBar, StateBand} from './parts';
import {PlanView} from './plan_view';
import {Replay} from './replay';
import {Section} from './section';

/// Digits that change faster cannot be read.
const WORDS_MS = 200;

/// `window.grabenOperator`: what a test may read. It steers nothing.
export interface GrabenOperator {
  fps(): number;       ///< Pictures drawn in the last second.
  now(): number;       ///< The moment shown, in the log's seconds.
  mode(): string | null;
  frames(): number;
  off_m(): number | null;
  value(signal: string): number | null;  ///< As of now; null where not valid.
}

declare global {
  interface Window {
    grabenOperator: Readonly<GrabenOperator>;
  }
}

export function start(root: HTMLElement): void {
  const state = new State(false);
  look(state);
  const theme = create_theme();
  const words = page_words(state);
  const band = new StateBand(words);
  const digits = new Digits();
  const lights = new LightBar();
  const section = new Section();
  const plan = new PlanView();
  const lambda = new LambdaBar(words, theme);
  const checklist = new Checklist(words);
  root.replaceChildren(band.node, el('main', {}, digits.node, lights.node,
    el('div', {class: 'pictures'}, section.node, plan.node), checklist.node, lambda.node));
  fit_digits(root, digits.digits);

  const maker = new FrameMaker();
  const replay = new Replay(location.hash);
  const rate = new FrameRate();
  let off: Off | null = null;
  let words_ms = -Infinity;
  let last_ms: number | null = null;
  const frame = (now_ms: number): void => {
    requestAnimationFrame(frame);
    state.playhead.tick(last_ms === null ? 0 : (now_ms - last_ms) / 1000);
    last_ms = now_ms;
    state.know_machine();
    replay.update(state);
    const drawn = state.drawn ? maker.at(state, theme.dark) : null;
    off = drawn === null || drawn.old ? null
      : off_of(drawn.now.machine, state.store, state.playhead.now_s, drawn.task);
    if (drawn !== null) {
      section.draw(drawn);
      plan.draw(drawn);
      rate.count(now_ms);
    }
    lights.show(off);
    if (now_ms - words_ms >= WORDS_MS) {
      words_ms = now_ms;
      digits.show(off);
      band.update(state);
      lambda.update(state);
      checklist.update(state);
    }
  };
  requestAnimationFrame(frame);
  window.grabenOperator = Object.freeze({
    fps: () => rate.per_second(performance.now()),
    now: () => state.playhead.now_s,
    mode: () => snapshot(state.store, state.playhead.now_s).mode,
    frames: () => state.store.frames,
    off_m: () => off?.off_m ?? null,
    value: (signal: string) => {
      const {value} = state.store.reading(signal, state.playhead.now_s);
      return Number.isFinite(value) ? value : null;
    },
  });
}
