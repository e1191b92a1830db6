// SPDX-License-Identifier: Apache-2.0
/// Words at places of the scene, as text over the canvas: sharp, and the reader's own size.

import {type Camera, Vector3 as Point} from 'three';
import type {Vector3} from '../model/api';
import type {SceneColours} from './theme';

/// Labels of one group are hidden and taken away together.
export type LabelGroup = 'path' | 'design' | 'fences' | 'scale';

interface Label {
  group: LabelGroup;
  at: Point;
  node: HTMLSpanElement;
}

export class Labels {
  readonly node = document.createElement('div');
  private readonly labels = new Map<string, Label>();
  private readonly hidden = new Set<LabelGroup>();
  private colours: SceneColours | null = null;

  constructor() {
    Object.assign(this.node.style, {
      position: 'absolute', inset: '0', overflow: 'hidden', pointerEvents: 'none'});
    this.node.className = 'scene-labels';
    this.node.setAttribute('aria-hidden', 'true');
  }

  put(name: string, group: LabelGroup, words: string, at_m: Vector3): void {
    let label = this.labels.get(name);
    if (!label) {
      label = {group, at: new Point(), node: document.createElement('span')};
      Object.assign(label.node.style, {
        position: 'absolute', left: '0', top: '0', whiteSpace: 'nowrap', willChange: 'transform',
        font: group === 'scale' ? '12px system-ui, sans-serif' : '600 13px system-ui, sans-serif'});
      this.labels.set(name, label);
      this.node.append(label.node);
      this.colour(label);
    }
    label.node.textContent = words;
    label.at.set(...at_m);
  }

  clear(group: LabelGroup): void {
    for (const [name, label] of this.labels) {
      if (label.group === group) {
        label.node.remove();
        this.labels.delete(name);
      }
    }
  }

  show(group: LabelGroup, visible: boolean): void {
    if (visible) {
      this.hidden.delete(group);
    } else {
      this.hidden.add(group);
    }
  }

  set_theme(colours: SceneColours): void {
    this.colours = colours;
    this.labels.forEach((label) => this.colour(label));
  }

  private colour(label: Label): void {
    const colours = this.colours;
    if (!colours) {
      return;
    }
    const own = {
      path: colours.path, design: colours.design, fences: colours.fence, scale: colours.text};
    label.node.style.color = own[label.group];
    label.node.style.textShadow = [[-1, 0], [1, 0], [0, -1], [0, 1]]
      .map(([x, y]) => `${x}px ${y}px 1.5px ${colours.halo}`).join(', ');
  }

  /// Puts each where its place is on the screen; those of the scale give way to each other.
  update(camera: Camera, width_px: number, height_px: number): void {
    const at = new Point();
    let last_x = -Infinity;
    let last_y = -Infinity;
    for (const label of this.labels.values()) {
      at.copy(label.at).project(camera);
      const x = (0.5 + 0.5 * at.x) * width_px;
      const y = (0.5 - 0.5 * at.y) * height_px;
      let seen = !this.hidden.has(label.group) && Math.abs(at.z) < 1;
      if (seen && label.group === 'scale') {
        seen = Math.hypot(x - last_x, y - last_y) > 26;
        if (seen) {
          [last_x, last_y] = [x, y];
        }
      }
      label.node.style.display = seen ? '' : 'none';
      label.node.style.transform =
        `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
  }
}
