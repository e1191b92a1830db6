// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {Built} from '../src/model/api';
import {band_of, built_map, draw_map, kBands, map_plan} from '../src/view/panels/built_map';
import {fake_document, type FakeNode} from './dom';

fake_document();

/// Ahead of the machine, 2 m by 1 m: left high on the left, over-cut at the far end.
const BUILT: Built = {
  cell_m: 0.5,
  x_m: [4, 4, 5, 5, 6, 6],
  y_m: [0.5, -0.5, 0.5, -0.5, 0.5, -0.5],
  off_mm: [45, 3, 12, -4, -20, -80],
  firm_mm: [45, 3, 12, -4, -8, -80],
};

test('a place is coloured by how far it is off: too low and left over are told apart', () => {
  const words = (off: number): string => kBands[band_of(off)]!.words;
  assert.equal(words(0), 'within 10 mm of the design');
  assert.equal(words(-10), 'within 10 mm of the design');
  assert.equal(words(10), '10 to 30 mm left over it');
  assert.equal(words(500), 'more than 60 mm left over it');
  assert.equal(words(-500), 'more than 60 mm too low');
  assert.ok(words(-20).includes('low') && words(-45).includes('30 to 60'));
  assert.equal(new Set(kBands.map(({colour}) => colour)).size, kBands.length);
  // Too low is blue, left over red: more than another lightness.
  const blue = (off: number): boolean => {
    const colour = kBands[band_of(off)]!.colour;
    return parseInt(colour.slice(5, 7), 16) > parseInt(colour.slice(1, 3), 16);
  };
  assert.deepEqual([-80, -40, -20, 20, 40, 80].map(blue), [true, true, true, false, false, false]);
});

test('the map has what is ahead above, what is left on the left, and all of it', () => {
  const plan = map_plan(BUILT, 300, 340);
  assert.ok(plan.width <= 301 && plan.height <= 341);
  const corners = BUILT.x_m.map((_, place) => plan.corner(place));
  assert.ok(corners[4]![1] < corners[0]![1], 'x 6 is over x 4');
  assert.ok(corners[0]![0] < corners[1]![0], 'y 0.5 is left of y -0.5');
  for (const [x, y] of corners) {
    assert.ok(x >= 0 && y >= 0 && x + plan.cell <= plan.width && y + plan.cell <= plan.height);
  }
  assert.ok(plan.cell > 0.5 * plan.per_m, 'no gaps');
});

test('each place is drawn once in its colour, and once more where the edge cut too deep', () => {
  const drawn: string[] = [];
  const brush = {
    fillStyle: '', fillRect(this: {fillStyle: string}): void { drawn.push(this.fillStyle); }};
  draw_map(brush as never, BUILT, map_plan(BUILT, 300, 340));
  assert.deepEqual(drawn.slice(0, 6), BUILT.off_mm.map((off) => kBands[band_of(off)]!.colour));
  assert.equal(drawn.length, 7);
});

test('the legend has the colours that are there, highest first, and words for the dots', () => {
  const words = (built_map(BUILT) as unknown as FakeNode).find('ul')!.children
    .map(({textContent}) => textContent);
  assert.deepEqual(words, [
    '30 to 60 mm left over it', '10 to 30 mm left over it', 'within 10 mm of the design',
    '10 to 30 mm too low', 'more than 60 mm too low', 'firm ground cut under the design']);
  assert.equal((built_map(BUILT) as unknown as FakeNode).find('figcaption')!.textContent,
    'From above: x 4.0 to 6.0 m is up, y \u22120.5 to 0.5 m is to the left');
  assert.equal(built_map(undefined), null);
  assert.equal(built_map({cell_m: 0.05, x_m: [], y_m: [], off_mm: [], firm_mm: []}), null);
});
