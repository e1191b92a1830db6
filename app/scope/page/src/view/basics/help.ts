// SPDX-License-Identifier: Apache-2.0
/// The keys, and what the picture means.

import {button, el, set_shown} from './dom';
import {notices} from './notices';

export const KEYS: readonly (readonly [string, string])[] = [
  ['Space', 'play or pause'],
  ['← →', 'cursor back and on (Shift: ten times as far)'],
  [', .', 'one control cycle back and on'],
  ['p n', 'to the fault before, to the next fault'],
  ['[ ]', 'replay slower, faster'],
  ['+ −', 'zoom the plots in and out about the cursor'],
  ['0', 'whole log in the plots'],
  ['l', 'back to live'],
  ['b', 'bookmark this moment'],
  ['Home End', 'to the start, to the end'],
  ['t', 'light or dark theme'],
  ['?', 'this help'],
];

const MORE: readonly string[] = [
  'In a plot: move to read values, click to look at a moment, drag to zoom, double-click for the '
    + 'whole log; Ctrl and wheel or two fingers zoom too. A name in the legend hides its line.',
  'Any value of the bus goes into any plot: open its message, and drag it there or press Plot. PNG, '
    + 'SVG and CSV save what a plot shows.',
  'In the scene: drag turns, right drag or two fingers move, wheel zooms.',
  'Grey, slanted values are stale: older than three cycles of their message.',
  'This page only listens. On a real bus it sends nothing; in a simulation it asks the server.',
];

export interface Help {
  node: HTMLDialogElement;
  offer_tour(offered: boolean): void;
}

export function help_dialog(tour: () => void): Help {
  const show_tour = button('Show the tour', () => {
    dialog.close();
    tour();
  });
  const dialog = el('dialog', {class: 'help', 'aria-labelledby': 'help-title'},
    el('h2', {id: 'help-title'}, 'Help'),
    el('dl', {}, ...KEYS.flatMap(([keys, words]) => [
      el('dt', {}, ...keys.split(' ').map((key) => el('kbd', {}, key))), el('dd', {}, words)])),
    ...MORE.map((words) => el('p', {}, words)), notices());
  dialog.append(el('div', {class: 'row'},
    button('Close', () => dialog.close(), {class: 'primary'}), show_tour));
  document.body.append(dialog);
  return {node: dialog, offer_tour: (offered) => set_shown(show_tour, offered)};
}
