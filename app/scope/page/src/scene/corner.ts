// SPDX-License-Identifier: Apache-2.0
/// The scene's lower left corner: the scale of pressures and the key of the layers, side by side
/// where there is room.

import {Key} from './key';
import {Legend} from './legend';
import type {Stage} from './types';
import type {SceneColours} from './theme';

export class Corner {
  readonly node = document.createElement('div');
  private readonly legend = new Legend();
  private readonly key = new Key();

  constructor() {
    Object.assign(this.node.style, {
      position: 'absolute', left: '8px', right: '8px', bottom: '8px', display: 'flex',
      flexWrap: 'wrap-reverse', alignItems: 'flex-end', gap: '4px 18px', pointerEvents: 'none',
      font: '12px/1.35 system-ui, sans-serif'});
    this.node.className = 'scene-corner';
    this.key.node.className = 'scene-key';
    for (const {style} of [this.legend.node, this.key.node]) {
      Object.assign(style, {padding: '3px 8px', borderRadius: '6px'});
    }
    this.node.append(this.legend.node, this.key.node);
  }

  /// Of the machine; null: there is none.
  show(stage: Stage | null): void {
    if (stage?.relief_pa === undefined) {
      this.legend.hide();
    } else {
      this.legend.show(stage.relief_pa);
    }
    this.show_key(stage);
  }

  /// Of what the machine has in the picture now.
  show_key(stage: Stage | null): void {
    this.key.show(stage?.key() ?? []);
  }

  set_theme(colours: SceneColours): void {
    this.node.style.color = colours.text;
    // Words stay legible over the machine, the grid and the soil.
    for (const {style} of [this.legend.node, this.key.node]) {
      style.background = `color-mix(in srgb, ${colours.background} 88%, transparent)`;
    }
    this.legend.set_theme(colours);
    this.key.set_theme(colours);
  }
}
