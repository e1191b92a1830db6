// SPDX-License-Identifier: Apache-2.0
/// What the scene shows, as toggles; and its camera's way home.

import type {Machine} from '../../model/api';
import {button, el, set_attribute, set_shown} from './dom';

export const LAYERS = ['ghost', 'path', 'field', 'design', 'fences', 'terrain'] as const;
export type Layer = (typeof LAYERS)[number];

const WORDS: Readonly<Record<Layer, readonly [string, string]>> = {
  ghost: ['Ghost', 'Wanted pose'],
  path: ['Path', 'Wanted path and the way of the tip'],
  field: ['Field', 'Velocity field around the path'],
  design: ['Design', 'Surface to make'],
  fences: ['Fences', 'Where the machine may not go'],
  terrain: ['Terrain', 'Ground as it was cut'],
};

/// Which layers a machine can have something in; a plan has no velocity field.
export function layers_of(machine: Machine | null, is_plan: boolean): ReadonlySet<Layer> {
  if (machine?.kind === 'dozer') {
    return new Set(['ghost', 'path', 'design', 'terrain']);
  }
  const fenced = machine !== null && machine.tasks.some(({fences}) => fences.length > 0);
  const designed = machine !== null && machine.tasks.some(({design}) => design !== null);
  return new Set(LAYERS.filter((layer) =>
    layer === 'fences' ? fenced : layer === 'design' ? designed
      : layer !== 'field' || !is_plan));
}

export class LayerBar {
  readonly node: HTMLElement;
  readonly shown = Object.fromEntries(
    LAYERS.map((layer) => [layer, true])) as Record<Layer, boolean>;
  private readonly toggles: readonly {layer: Layer; node: HTMLButtonElement}[];

  constructor(changed: () => void, camera: () => void) {
    this.toggles = LAYERS.map((layer) => {
      const [words, title] = WORDS[layer];
      const node = button(words, () => {
        this.shown[layer] = !this.shown[layer];
        set_attribute(node, 'aria-pressed', String(this.shown[layer]));
        changed();
      }, {class: 'switch', 'aria-pressed': 'true', title, 'data-layer': layer});
      return {layer, node};
    });
    this.node = el('div', {class: 'layers', role: 'toolbar', 'aria-label': 'Layers of the scene'},
      ...this.toggles.map(({node}) => node),
      button('Reset view', camera, {class: 'switch plain'}));
  }

  offer(machine: Machine | null, is_plan: boolean): void {
    const offered = layers_of(machine, is_plan);
    for (const {layer, node} of this.toggles) {
      set_shown(node, offered.has(layer));
    }
  }
}
