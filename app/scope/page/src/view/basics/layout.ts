// SPDX-License-Identifier: Apache-2.0
/// Where everything stands: landmarks in reading order, which is also the order of the Tab key.

import {el} from './dom';

export interface Parts {
  header: HTMLElement;
  alarms: HTMLElement;
  scene: HTMLElement;
  layers: HTMLElement;
  plots: readonly HTMLElement[];
  panel: readonly HTMLElement[];
  replay: HTMLElement;
}

export function lay_out(root: HTMLElement, parts: Parts): void {
  root.replaceChildren(
    el('a', {class: 'skip', href: '#panel'}, 'To the panel'),
    parts.header,
    el('main', {}, parts.alarms,
      el('section', {class: 'scene', 'aria-label': 'Scene: the machine in space'},
        parts.scene, parts.layers),
      el('section', {class: 'plot-column', 'aria-labelledby': 'plots-title'},
        el('h2', {class: 'hidden', id: 'plots-title'}, 'Plots'), ...parts.plots),
      el('section', {class: 'panel', id: 'panel', tabindex: -1, 'aria-label': 'Panel'},
        ...parts.panel)),
    parts.replay);
}
