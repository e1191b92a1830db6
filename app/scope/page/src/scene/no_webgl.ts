// SPDX-License-Identifier: Apache-2.0
/// What stands in the scene's place where the browser has no WebGL.

import type {SceneView} from './types';

export function without_webgl(host: HTMLElement, why: string): SceneView {
  const words = document.createElement('p');
  words.textContent = 'The machine is not drawn: this browser gives no WebGL. Plots, state and ' +
    `replay work without it. (${why})`;
  Object.assign(words.style, {padding: '1rem', maxWidth: '40rem'});
  host.append(words);
  const nothing = (): void => {};
  return {
    setMachine: nothing, update: nothing, resize: nothing, setTheme: nothing,
    setLayers: nothing, resetCamera: nothing, tip: () => null, tipOnScreen: () => null,
    ground: () => null, settled: () => true, dispose: () => words.remove(),
  };
}
