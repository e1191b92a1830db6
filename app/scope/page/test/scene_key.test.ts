// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {ExcavatorMachine, Task} from '../src/model/api';
import {Corner} from '../src/scene/corner';
import {dozer_key, excavator_key, type KeyEntry} from '../src/scene/key';
import type {Stage} from '../src/scene/types';
import {scene_colours} from '../src/scene/theme';
import type {SceneLayers} from '../src/scene/types';
import {EXCAVATOR_22T as PLAIN} from './machines';

const ALL: SceneLayers =
  {ghost: true, path: true, field: true, design: true, fences: true, terrain: true};
const EXCAVATOR_22T: ExcavatorMachine =
  {...PLAIN, dig: {...PLAIN.dig, field: [[5, 0, 0.3, -0.4], [6, 0, 0.1, 0]]}};
const marks = (entries: readonly KeyEntry[]): string => entries.map(({mark}) => mark).join(' ');

test('the key has what is drawn: of the dig, of a task, of a plan, of a dozer', () => {
  assert.equal(marks(excavator_key(EXCAVATOR_22T, ALL, 'dig', true)), 'ghost path trail field');
  const fence = {words: 'a pipe', normal: [0, 0, 1], offset_m: 1} as const;
  const design = {through_m: [6, 0, -1], up: [0, 0, 1]} as const;
  // The last fence of a task with a design is the design's own.
  const of = (task: Partial<Task>, has_frames = true): string => marks(excavator_key(
    {...EXCAVATOR_22T, tasks: [{name: '', steps: [], fences: [], design: null, ...task}]}, ALL, 0,
    has_frames));
  assert.equal(of({}), 'ghost path trail');
  assert.equal(of({design, fences: [fence]}), 'ghost path trail design');
  assert.equal(of({design, fences: [fence, fence]}), 'ghost path trail design fence');
  assert.equal(of({fences: [fence]}, false), 'path ghost fence');
  assert.equal(marks(excavator_key(EXCAVATOR_22T, ALL, 'none', true)), 'ghost trail');
  assert.equal(marks(dozer_key(ALL)), 'ghost trail design');
});

test('a layer that is off is not in the key', () => {
  const key = (layers: Partial<SceneLayers>): string =>
    marks(excavator_key(EXCAVATOR_22T, {...ALL, ...layers}, 'dig', true));
  assert.equal(key({ghost: false}), 'path trail field');
  assert.equal(key({path: false}), 'ghost field');
  assert.equal(key({field: false}), 'ghost path trail');
  assert.equal(marks(dozer_key({...ALL, path: false, design: false})), 'ghost');
});

test('the key has the speed of the longest arrow, and none of no field', () => {
  const words = excavator_key(EXCAVATOR_22T, ALL, 'dig', true).at(-1)!.words;
  assert.equal(words, 'field, longest arrow 0.50 m/s');
  assert.equal(marks(excavator_key(PLAIN, ALL, 'dig', true)), 'ghost path trail');
});

/// As much of an element as the corner needs.
class Element {
  readonly style: Record<string, string> = {};
  private children: (Element | string)[] = [];

  append(...children: (Element | string)[]): void {
    this.children.push(...children);
  }

  replaceChildren(...children: (Element | string)[]): void {
    this.children = children;
  }

  set textContent(words: string) {
    this.children = [words];
  }

  setAttribute(): void {}

  /// What is seen of it.
  get words(): string {
    return this.style.display === 'none' ? '' :
      this.children.map((child) => (typeof child === 'string' ? child : child.words)).join('|');
  }
}

/// The corner's words for a machine with this relief's pressure; undefined: no machine.
function corner_words(relief_pa: number | null | undefined): string {
  Object.assign(globalThis, {document: {createElement: () => new Element()}});
  try {
    const corner = new Corner();
    corner.set_theme(scene_colours(false));
    corner.show(relief_pa === undefined ? null :
      {relief_pa, key: () => dozer_key(ALL)} as unknown as Stage);
    return (corner.node as unknown as Element).words;
  } finally {
    Reflect.deleteProperty(globalThis, 'document');
  }
}

test('the corner says why no cylinder has a colour, or what the colours are', () => {
  assert.match(corner_words(null), /no cylinder pressures on this bus/);
  assert.doesNotMatch(corner_words(null), /MPa/);
  assert.match(corner_words(34e6), /Cylinder pressure, MPa.*17 \(170\)\|34 \(340\) relief/);
  assert.doesNotMatch(corner_words(34e6), /no cylinder/);
  assert.match(corner_words(null), /old or not available.*wanted blade.*way of the edge.*design/);
  assert.equal(corner_words(undefined).replaceAll('|', ''), '');
});
