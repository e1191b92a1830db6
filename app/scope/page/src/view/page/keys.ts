// SPDX-License-Identifier: Apache-2.0
/// Keys for the whole page; what is being typed into or adjusted keeps its own.

import {is_live, type PageState} from '../basics/page_state';
import {plot_key} from '../plots/plot_gestures';
import type {ReplayBar} from './replay_bar';

export interface KeyTargets {
  state: PageState;
  replay: ReplayBar;
  mark(): void;
  theme(): void;
  help(): void;
}

export function listen_to_keys(targets: KeyTargets): void {
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) {
      return;
    }
    const target = event.target instanceof HTMLElement ? event.target : document.body;
    if (document.querySelector('dialog[open]') !== null || keeps(target, event.key)) {
      return;
    }
    if (press(targets, event.key, event.shiftKey)) {
      event.preventDefault();
    }
  });
}

function keeps(target: HTMLElement, key: string): boolean {
  if (target.closest('.scene') !== null && key.startsWith('Arrow')) {
    return true;
  }
  const {tagName} = target;
  if (tagName === 'SELECT' || tagName === 'TEXTAREA') {
    return true;
  }
  if (tagName === 'INPUT') {
    return (target as HTMLInputElement).type === 'text' || key.startsWith('Arrow')
      || key === 'Home' || key === 'End' || key.startsWith('Page');
  }
  return (tagName === 'BUTTON' || tagName === 'SUMMARY') && (key === ' ' || key === 'Enter');
}

function press({state, replay, mark, theme, help}: KeyTargets, key: string, shift: boolean): boolean {
  const {playhead, extent} = state;
  switch (key) {
    case ' ': replay.toggle(); return true;
    case ',': replay.step(-1); return true;
    case '.': replay.step(1); return true;
    case 'p': replay.jump(true); return true;
    case 'n': replay.jump(false); return true;
    case '[': replay.faster(-1); return true;
    case ']': replay.faster(1); return true;
    case 'l': playhead.follow = playhead.follow || is_live(state); return true;
    case 'Home': playhead.seek(extent.from_s); return true;
    case 'End': playhead.seek(extent.until_s); return true;
    case 'b': mark(); return true;
    case 't': theme(); return true;
    case '?': help(); return true;
    default: return plot_key(state, key, shift);
  }
}
