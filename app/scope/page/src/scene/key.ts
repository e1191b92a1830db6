// SPDX-License-Identifier: Apache-2.0
/// What the colours of the scene mean: a mark and words for each layer that is on, in its corner.

import type {ExcavatorMachine} from '../model/api';
import {fastest_mps, field_colour} from './path_layer';
import type {ShownTask} from './shown_task';
import type {SceneColours} from './theme';
import type {KeyEntry, SceneLayers} from './types';

/// Without frames (`has_frames` false) nothing was measured or wanted at any time.
export function excavator_key(
  machine: ExcavatorMachine, layers: SceneLayers, shown: ShownTask, has_frames: boolean,
): KeyEntry[] {
  const task = typeof shown === 'number' ? machine.tasks[shown] : undefined;
  const fastest = fastest_mps(machine.dig);
  const own_fences = task ? task.fences.length - (task.design || task.surface ? 1 : 0) : 0;
  const entries: (KeyEntry | false)[] = [
    layers.ghost && has_frames && {mark: 'ghost', words: 'wanted pose'},
    layers.path && shown === 'dig' && {mark: 'path', words: 'wanted path'},
    layers.path && task !== undefined &&
      {mark: 'path', words: has_frames ? 'steps of the task (moves dashed)'
        : 'planned line, poses of the bucket along it'},
    layers.ghost && !has_frames && task !== undefined && {mark: 'ghost', words: 'pose at its end'},
    layers.path && has_frames && {mark: 'trail', words: 'way of the teeth'},
    layers.field && shown === 'dig' && fastest > 0 &&
      {mark: 'field', words: `field, longest arrow ${fastest.toPrecision(2)} m/s`},
    layers.design && task?.design != null && {mark: 'design', words: 'design'},
    layers.fences && own_fences > 0 && {mark: 'fence', words: 'fences'},
  ];
  return entries.filter((entry) => entry !== false);
}

export function dozer_key(layers: SceneLayers): KeyEntry[] {
  const entries: (KeyEntry | false)[] = [
    layers.ghost && {mark: 'ghost', words: 'wanted blade'},
    layers.path && {mark: 'trail', words: 'way of the edge'},
    layers.design && {mark: 'design', words: 'design'},
  ];
  return entries.filter((entry) => entry !== false);
}

export class Key {
  readonly node = document.createElement('div');
  private entries: readonly KeyEntry[] = [];
  private written = '';
  private colours: SceneColours | null = null;

  constructor() {
    Object.assign(this.node.style, {display: 'flex', flexWrap: 'wrap', gap: '0 14px'});
  }

  show(entries: readonly KeyEntry[]): void {
    const written = entries.map(({mark, words}) => `${mark} ${words}`).join('\n');
    if (written !== this.written) {
      this.written = written;
      this.entries = entries;
      this.write();
    }
  }

  set_theme(colours: SceneColours): void {
    this.colours = colours;
    this.write();
  }

  private write(): void {
    const {colours} = this;
    if (colours === null) {
      return;
    }
    this.node.replaceChildren(...this.entries.map(({mark, words}) => {
      const line = document.createElement('span');
      line.style.whiteSpace = 'nowrap';
      line.append(mark_of(mark, colours), words);
      return line;
    }));
  }
}

/// A line for what is drawn as lines, a pane for what is a body or a surface, an arrow.
function mark_of(mark: KeyEntry['mark'], colours: SceneColours): HTMLSpanElement {
  const node = document.createElement('span');
  const colour = mark === 'field' ? field_colour(colours).getStyle() : colours[mark];
  Object.assign(node.style, {
    display: 'inline-block', boxSizing: 'border-box', width: '14px', marginRight: '5px',
    verticalAlign: 'middle', color: colour});
  node.setAttribute('aria-hidden', 'true');
  if (mark === 'field') {
    node.textContent = '→';
  } else if (mark === 'path' || mark === 'trail') {
    Object.assign(node.style, {height: '3px', background: 'currentColor'});
  } else {
    Object.assign(node.style, {
      height: '9px', border: '2px solid currentColor',
      background: 'color-mix(in srgb, currentColor 25%, transparent)'});
  }
  return node;
}
