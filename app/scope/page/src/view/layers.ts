/// What the scene shows, as toggles; and its camera's way home.

import {button, el, set_attribute} from './dom';

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

export function layer_bar(
  shown: Record<Layer, boolean>, changed: () => void, camera: () => void,
): HTMLElement {
  const toggles = LAYERS.map((layer) => {
    const [words, title] = WORDS[layer];
    const node = button(words, () => {
      shown[layer] = !shown[layer];
      set_attribute(node, 'aria-pressed', String(shown[layer]));
      changed();
    }, {class: 'switch', 'aria-pressed': String(shown[layer]), title, 'data-layer': layer});
    return node;
  });
  return el('div', {class: 'layers', role: 'toolbar', 'aria-label': 'Layers of the scene'},
    ...toggles, button('Reset view', camera, {class: 'switch plain'}));
}
