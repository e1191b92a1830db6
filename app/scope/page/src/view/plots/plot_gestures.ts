// SPDX-License-Identifier: Apache-2.0
/// Zoom and cursor without dragging: keys on a plot, the wheel with Ctrl (and so the pinch of a
/// trackpad), two fingers on a screen.

import type {Playhead} from '../../model/api';
import type {PageState} from '../basics/page_state';

const ZOOM_STEP = 1.5;
const STEPS_PER_WINDOW = 200;

/// Scales the window about a time that stays where it is. Live, the newest frame stays.
export function zoom_about(playhead: Playhead, time_s: number, factor: number): void {
  const [from_s, until_s] = playhead.window;
  playhead.window = [
    time_s - (time_s - from_s) * factor, time_s + (until_s - time_s) * factor,
  ];
}

type Shown = Pick<PageState, 'playhead' | 'extent'>;

/// Whether the key meant something to the plots.
export function plot_key({playhead, extent}: Shown, key: string, fast: boolean): boolean {
  const [from_s, until_s] = playhead.window;
  const step_s = ((until_s - from_s) / STEPS_PER_WINDOW) * (fast ? 10 : 1);
  switch (key) {
    case '+':
    case '=':
      zoom_about(playhead, playhead.now_s, 1 / ZOOM_STEP);
      return true;
    case '-':
      zoom_about(playhead, playhead.now_s, ZOOM_STEP);
      return true;
    case '0':
      playhead.window = [extent.from_s, extent.until_s];
      return true;
    case 'ArrowLeft':
      playhead.seek(playhead.now_s - step_s);
      return true;
    case 'ArrowRight':
      playhead.seek(playhead.now_s + step_s);
      return true;
    default:
      return false;
  }
}

export function plot_gestures(node: HTMLElement, shown: Shown): void {
  const {playhead} = shown;
  node.addEventListener('keydown', (event) => {
    const on_plot = (event.target as HTMLElement).dataset.plot !== undefined;
    const plain = !event.ctrlKey && !event.metaKey && !event.altKey;
    if (on_plot && plain && plot_key(shown, event.key, event.shiftKey)) {
      event.preventDefault();
      event.stopPropagation();
    }
  });
  node.addEventListener('wheel', (event) => {
    const time_s = time_under(event.target, event.clientX, playhead);
    if (event.ctrlKey && time_s !== null) {
      event.preventDefault();
      zoom_about(playhead, time_s, Math.exp(Math.max(-50, Math.min(50, event.deltaY)) * 0.01));
    }
  }, {passive: false});
  pinch(node, playhead);
}

function pinch(node: HTMLElement, playhead: Playhead): void {
  let apart = 0;
  const distance = (touches: TouchList) => Math.abs(touches[0]!.clientX - touches[1]!.clientX);
  node.addEventListener('touchstart', (event) => {
    apart = event.touches.length === 2 ? distance(event.touches) : 0;
  }, {passive: true});
  node.addEventListener('touchmove', (event) => {
    if (event.touches.length !== 2 || apart < 10) {
      return;
    }
    const now = Math.max(10, distance(event.touches));
    const middle = (event.touches[0]!.clientX + event.touches[1]!.clientX) / 2;
    const time_s = time_under(event.target, middle, playhead);
    if (time_s !== null) {
      event.preventDefault();
      zoom_about(playhead, time_s, apart / now);
      apart = now;
    }
  }, {passive: false});
}

function time_under(target: EventTarget | null, x: number, playhead: Playhead): number | null {
  const over = target instanceof Element ? target.closest('.u-over') : null;
  if (over === null) {
    return null;
  }
  const {left, width} = over.getBoundingClientRect();
  const [from_s, until_s] = playhead.window;
  return width > 0 ? from_s + ((x - left) / width) * (until_s - from_s) : null;
}
