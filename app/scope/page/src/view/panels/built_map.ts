// SPDX-License-Identifier: Apache-2.0
/// How an area was built, seen from above: a cell for each place, coloured by how far the ground is
/// from its design, with what the colours mean.

import type {Built} from '../../model/api';
import {el} from '../basics/dom';
import {fixed} from '../basics/format';

/// Colours that also those tell apart who see no red and green: blue is too low, red too high.
interface Band {
  least_mm: number;  ///< From here on up to the next band.
  colour: string;
  words: string;
}
export const kBands: readonly Band[] = [
  {least_mm: -Infinity, colour: '#2166ac', words: 'more than 60 mm too low'},
  {least_mm: -60, colour: '#67a9cf', words: '30 to 60 mm too low'},
  {least_mm: -30, colour: '#b5d6e8', words: '10 to 30 mm too low'},
  {least_mm: -10, colour: '#f7f7f7', words: 'within 10 mm of the design'},
  {least_mm: 10, colour: '#fbc9ae', words: '10 to 30 mm left over it'},
  {least_mm: 30, colour: '#ef8a62', words: '30 to 60 mm left over it'},
  {least_mm: 60, colour: '#b2182b', words: 'more than 60 mm left over it'},
];
/// Firm ground that is gone from so far under the design was cut by the edge.
export const kCut_mm = -10;
const kDot = '#101418';

/// By its number in kBands.
export const band_of = (off_mm: number): number =>
  kBands.reduce((found, {least_mm}, i) => (off_mm >= least_mm ? i : found), 0);

export interface MapPlan {
  width: number;   ///< CSS pixels, as the next ones.
  height: number;
  cell: number;
  per_m: number;
  /// Upper left corner of a cell. x is up, y to the left.
  corner: (place: number) => readonly [number, number];
}

const range = (list: readonly number[]): [number, number] => list.reduce<[number, number]>(
  ([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);

/// The whole area as large as fits, with a margin for cells that are turned.
export function map_plan(built: Built, most_width: number, most_height: number): MapPlan {
  const {x_m, y_m, cell_m} = built;
  const [[x0, x1], [y0, y1]] = [range(x_m), range(y_m)];
  const [high, wide] = [x1 - x0 + 2 * cell_m, y1 - y0 + 2 * cell_m];
  const per_m = Math.min(most_width / wide, most_height / high);
  // Cells that are turned leave no gaps.
  const cell = Math.max(1.15 * cell_m * per_m, 1);
  return {
    width: Math.ceil(wide * per_m), height: Math.ceil(high * per_m), cell, per_m,
    corner: (place) => [
      (y1 + cell_m - y_m[place]!) * per_m - 0.5 * cell,
      (x1 + cell_m - x_m[place]!) * per_m - 0.5 * cell],
  };
}

type Brush = Pick<CanvasRenderingContext2D, 'fillStyle' | 'fillRect'>;

export function draw_map(brush: Brush, built: Built, plan: MapPlan): void {
  const {off_mm, firm_mm} = built;
  off_mm.forEach((off, place) => {
    const [x, y] = plan.corner(place);
    brush.fillStyle = kBands[band_of(off)]!.colour;
    brush.fillRect(x, y, plan.cell, plan.cell);
  });
  const dot = Math.max(0.35 * plan.cell, 1);
  brush.fillStyle = kDot;
  firm_mm.forEach((firm, place) => {
    if (firm < kCut_mm) {
      const [x, y] = plan.corner(place);
      const inset = 0.5 * (plan.cell - dot);
      brush.fillRect(x + inset, y + inset, dot, dot);
    }
  });
}

const span = (list: readonly number[]): string => {
  const [least, most] = range(list);
  return `${fixed(least, 1)} to ${fixed(most, 1)}`;
};

const kMostWidth = 300;
const kMostHeight = 340;

/// Of a run's report. Null where no area was built.
export function built_map(built: Built | undefined): HTMLElement | null {
  if (built === undefined || built.x_m.length === 0) {
    return null;
  }
  const plan = map_plan(built, kMostWidth, kMostHeight);
  const canvas = el('canvas', {
    role: 'img', width: 2 * plan.width, height: 2 * plan.height,
    style: `width: ${plan.width}px; height: ${plan.height}px`,
    'aria-label': 'The area seen from above, coloured by its distance from the design'});
  const brush = canvas.getContext?.('2d');
  if (brush) {
    brush.scale(2, 2);
    draw_map(brush, built, plan);
  }
  const used = new Set(built.off_mm.map(band_of));
  const line = (mark: HTMLElement, words: string) => el('li', {}, mark, words);
  const rows = kBands.map(({colour, words}, i) => (used.has(i) ?
    line(el('span', {class: 'band', style: `background: ${colour}`}), words) : null)).reverse();
  const is_cut = built.firm_mm.some((firm) => firm < kCut_mm);
  return el('figure', {class: 'built'},
    canvas,
    el('div', {class: 'scale', style: `width: ${plan.per_m.toFixed(1)}px`}, '1 m'),
    el('figcaption', {}, `From above: x ${span(built.x_m)} m is up, y ${span(built.y_m)} m is to ` +
      'the left'),
    el('ul', {class: 'bands'}, ...rows, is_cut ?
      line(el('span', {class: 'band dotted'}), 'firm ground cut under the design') : null));
}
