// SPDX-License-Identifier: Apache-2.0
/// A figure as SVG text that needs nothing beside it: what is saved of a plot, and how the x-y plots
/// are drawn.

import type {Vector2} from '../../model/api';
import {digits_of, fixed} from '../basics/format';
import {nice_step} from './plot_range';

export interface FigureAxis {
  label: string;
  least: number;
  most: number;
  words?: (value: number, step: number) => string;
  /// So far from 0 it is straight, beyond it goes by powers of ten.
  straight_to?: number;
  marked?: readonly [number, number];  ///< Marks stand only there.
}

export interface FigureLine {
  label: string;
  colour: string;
  width: number;
  dash: readonly number[];
  points: readonly (Vector2 | null)[];  ///< Null: a gap.
}

export interface Figure {
  title: string;
  x: FigureAxis;
  y: FigureAxis;
  lines: readonly FigureLine[];
  /// Below the curves, from one x to another.
  bands?: readonly {from: number; until: number; colour: string}[];
  /// What the bands' colours mean, below the axis.
  key?: readonly {label: string; colour: string}[];
  at?: Vector2 | null;   ///< A mark.
  equal?: boolean;       ///< A metre is as long on both axes.
  colours: {sheet: string; ink: string; muted: string; grid: string};
}

const MARGIN = {left: 62, right: 14, top: 52, bottom: 44};
const LETTER = 6.6;  ///< Of 12 px, on the average.

const escaped = (text: string): string => text.replace(/[&<>"']/g, (letter) =>
  `&#${letter.charCodeAt(0)};`);
const short = (value: number): string => String(Math.round(value * 100) / 100);

/// From a value to a share of the axis.
function placer({least, most, straight_to}: FigureAxis): (value: number) => number {
  const bent = (value: number): number =>
    straight_to === undefined ? value : Math.asinh(value / straight_to);
  const [from, until] = [bent(least), bent(most)];
  return (value) => (bent(value) - from) / (until - from || 1);
}

function marks_of({least, most, straight_to}: FigureAxis, count: number): {step: number; at: number[]} {
  if (straight_to !== undefined) {
    const at = [0, ...[1000, 100, 30, 10, 5].flatMap((mark) => [-mark, mark])];
    return {step: 1, at: at.filter((mark) => mark >= least && mark <= most)};
  }
  const step = nice_step((most - least) / Math.max(2, count) || 1);
  const at: number[] = [];
  for (let mark = Math.ceil(least / step - 1e-9) * step; mark <= most + 1e-9 * step; mark += step) {
    at.push(mark);
  }
  return {step, at};
}

/// Widens one axis so that both have the same scale.
function made_equal(figure: Figure, width: number, height: number): [FigureAxis, FigureAxis] {
  const {x, y} = figure;
  const per = Math.max((x.most - x.least) / width, (y.most - y.least) / height);
  const wide = (axis: FigureAxis, pixels: number): FigureAxis => {
    const middle = 0.5 * (axis.least + axis.most);
    return {...axis, least: middle - 0.5 * per * pixels, most: middle + 0.5 * per * pixels};
  };
  return [wide(x, width), wide(y, height)];
}

const KEY_ROW = 18;

/// Entries of a key side by side, as many in a row as fit.
function placed<E extends {label: string}>(entries: readonly E[], width: number): (E & {left: number; row: number})[] {
  let [left, row] = [0, 0];
  return entries.map((entry) => {
    const wide = 34 + LETTER * entry.label.length;
    if (left > 0 && left + wide > width) {
      [left, row] = [0, row + 1];
    }
    const place = {...entry, left, row};
    left += wide;
    return place;
  });
}

export function figure_svg(figure: Figure, width: number, height: number): string {
  const {colours, lines} = figure;
  const across_px = width - MARGIN.left - MARGIN.right;
  const key = placed(figure.key ?? [], across_px);
  const key_px = KEY_ROW * ((key.at(-1)?.row ?? -1) + 1);
  const inner = [across_px, height - MARGIN.top - MARGIN.bottom - key_px] as const;
  const [x, y] = figure.equal === true ? made_equal(figure, ...inner) : [figure.x, figure.y];
  const [to_x, to_y] = [placer(x), placer(y)];
  const px = (value: number): string => short(MARGIN.left + inner[0] * to_x(value));
  const py = (value: number): string => short(MARGIN.top + inner[1] * (1 - to_y(value)));
  const text = (at: string, anchor: string, words: string, colour = colours.muted, more = ''): string =>
    `<text ${at} text-anchor="${anchor}" fill="${colour}" ${more}>${escaped(words)}</text>`;
  const parts: string[] = [
    `<rect width="${width}" height="${height}" fill="${colours.sheet}"/>`,
    text(`x="${MARGIN.left}" y="18"`, 'start', figure.title, colours.ink, 'font-weight="600" font-size="14"'),
  ];
  const across = marks_of(x, inner[0] / 90);
  for (const mark of across.at) {
    const words = x.words?.(mark, across.step) ?? fixed(mark, digits_of(across.step));
    parts.push(`<path d="M${px(mark)} ${MARGIN.top}V${MARGIN.top + inner[1]}" stroke="${colours.grid}"/>`,
      text(`x="${px(mark)}" y="${MARGIN.top + inner[1] + 16}"`, 'middle', words));
  }
  const up = marks_of(y, inner[1] / 42);
  const [lowest, highest] = y.marked ?? [-Infinity, Infinity];
  for (const mark of up.at.filter((at) => at >= lowest - 1e-9 && at <= highest + 1e-9)) {
    parts.push(`<path d="M${MARGIN.left} ${py(mark)}H${MARGIN.left + inner[0]}" stroke="${colours.grid}"/>`,
      text(`x="${MARGIN.left - 6}" y="${Number(py(mark)) + 4}"`, 'end',
        y.words?.(mark, up.step) ?? fixed(mark, digits_of(up.step))));
  }
  parts.push(text(`x="${MARGIN.left + inner[0] / 2}" y="${height - 8 - key_px}"`, 'middle', x.label),
    text('x="0" y="0"', 'middle', y.label, colours.muted,
      `transform="translate(14 ${MARGIN.top + inner[1] / 2}) rotate(-90)"`));
  const foot = MARGIN.top + inner[1];
  for (const {from, until, colour} of figure.bands ?? []) {
    parts.push(`<rect x="${px(from)}" y="${foot - 12}" width="${short(Number(px(until)) - Number(px(from)))}" `
      + `height="12" fill="${colour}"/>`);
  }
  for (const {label, colour, left, row} of key) {
    const [x0, top] = [short(MARGIN.left + left), height - key_px + KEY_ROW * row];
    parts.push(`<rect x="${x0}" y="${top}" width="11" height="11" fill="${colour}"/>`,
      text(`x="${short(MARGIN.left + left + 16)}" y="${top + 10}"`, 'start', label, colours.ink));
  }
  parts.push(`<clipPath id="inside"><rect x="${MARGIN.left}" y="${MARGIN.top}" width="${inner[0]}" `
    + `height="${inner[1]}"/></clipPath><g clip-path="url(#inside)" fill="none" stroke-linejoin="round">`);
  for (const line of lines) {
    parts.push(`<path d="${path_of(line.points, px, py)}" stroke="${line.colour}" `
      + `stroke-width="${line.width}" stroke-dasharray="${line.dash.join(' ')}"/>`);
  }
  if (figure.at) {
    parts.push(`<circle cx="${px(figure.at[0])}" cy="${py(figure.at[1])}" r="5" fill="${colours.ink}"/>`);
  }
  parts.push('</g>');
  let left = MARGIN.left;
  for (const {label, colour, width: stroke, dash} of lines) {
    parts.push(`<path d="M${short(left)} 36h18" stroke="${colour}" stroke-width="${stroke}" `
      + `stroke-dasharray="${dash.join(' ')}"/>`, text(`x="${short(left + 23)}" y="40"`, 'start', label, colours.ink));
    left += 40 + LETTER * label.length;
  }
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" `
    + `height="${height}" font-family="system-ui, sans-serif" font-size="12">${parts.join('')}</svg>`;
}

function path_of(
  points: readonly (Vector2 | null)[], px: (value: number) => string, py: (value: number) => string,
): string {
  let pen = 'M';
  return points.map((point) => {
    if (point === null) {
      pen = 'M';
      return '';
    }
    const stroke = `${pen}${px(point[0])} ${py(point[1])}`;
    pen = 'L';
    return stroke;
  }).join('');
}
