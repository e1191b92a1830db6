// SPDX-License-Identifier: Apache-2.0
/// A plot as a picture, as a drawing, or as the numbers of its frames.

import type {FrameStore, Vector2} from '../../model/api';
import {align} from '../basics/curves';
import {button, el} from '../basics/dom';
import {figure_svg, type Figure} from './figure_svg';
import {time_words, unit_words} from '../basics/format';
import type {LimitStrip} from '../limits/limit_strip';
import {DASHES, WIDTHS} from './line_styles';
import {plain_range} from './plot_range';
import type {Line, PlotSpec} from './plots';
import {csv_of, file_name, save_png, save_text} from './save';
import type {ThemeSwitch} from '../basics/theme';

export type SaveKind = 'png' | 'svg' | 'csv';

export interface Saved {
  spec: PlotSpec;
  lines: readonly Line[];
  store: FrameStore | null;
  window: readonly [number, number];
  origin_s: number;
  theme: ThemeSwitch;
  strip: LimitStrip | null;
}

const SIZE = [900, 360] as const;
const BUCKETS = 900;
/// So many that every frame has its own.
const ALL = Number.MAX_SAFE_INTEGER / 4;

export function save_menu(title: string, save: (kind: SaveKind) => void): HTMLElement {
  const kinds: readonly SaveKind[] = ['png', 'svg', 'csv'];
  return el('p', {class: 'save', role: 'group', 'aria-label': `Save ${title}`},
    ...kinds.map((kind) => button(kind.toUpperCase(), () => save(kind),
      {class: 'link', 'aria-label': `Save ${title} as ${kind.toUpperCase()}`})));
}

export const figure_colours = (theme: ThemeSwitch): Figure['colours'] => ({
  sheet: theme.colour('sheet'), ink: theme.colour('ink'), muted: theme.colour('muted'),
  grid: theme.colour('grid')});

export function save_plot(kind: SaveKind, saved: Saved): void {
  const {spec, store} = saved;
  if (store === null) {
    return;
  }
  if (kind === 'csv') {
    save_text(file_name(spec.title, kind), 'text/csv', plot_csv(saved, store));
  } else if (kind === 'svg') {
    save_text(file_name(spec.title, kind), 'image/svg+xml', plot_svg(saved, store));
  } else {
    void save_png(file_name(spec.title, kind), plot_svg(saved, store));
  }
}

/// Every frame of the window; a lambda that was wanted, as it was drawn, is one too.
export function plot_csv({spec, lines, window, origin_s}: Saved, store: FrameStore): string {
  const [from_s, until_s] = window;
  const curves = lines.map(({trace}) => {
    const {time_s, value} = trace.curve(store, from_s, until_s, ALL);
    const inside = [...time_s.keys()].filter((k) => time_s[k]! >= from_s && time_s[k]! <= until_s);
    return {time_s: Float64Array.from(inside, (k) => time_s[k]!),
      value: Float64Array.from(inside, (k) => value[k]!)};
  });
  const unit = (line: Line): string => line.unit ?? spec.unit;
  return csv_of(['time, s', ...lines.map((line) =>
    (unit(line) === '' ? line.label : `${line.label}, ${unit(line)}`))], align(curves, origin_s));
}

export function plot_svg(saved: Saved, store: FrameStore): string {
  const {spec, lines, window: [from_s, until_s], origin_s, theme, strip} = saved;
  const drawn = lines.map((line) => {
    const {time_s, value} = line.trace.curve(store, from_s, until_s, BUCKETS);
    return {
      label: line.label, colour: theme.colour(line.colour), width: WIDTHS[line.style],
      dash: DASHES[line.style] ?? [],
      points: [...time_s].map((time, k): Vector2 | null =>
        (Number.isNaN(value[k]!) ? null : [time - origin_s, value[k]!]))};
  });
  const heights = drawn.flatMap(({points}) => points.map((point) => point?.[1] ?? NaN))
    .filter(Number.isFinite);
  const [least, most] = plain_range(spec.least, strip !== null,
    heights.reduce((a, b) => Math.min(a, b), Infinity), heights.reduce((a, b) => Math.max(a, b), -Infinity));
  return figure_svg({
    title: spec.unit === '' ? spec.title : `${spec.title}, ${unit_words(spec.unit)}`, lines: drawn,
    x: {label: 'time, min:s', least: from_s - origin_s, most: until_s - origin_s,
      words: (value, step) => time_words(value, step >= 1 ? 0 : step >= 0.1 ? 1 : 2)},
    y: {label: unit_words(spec.unit), least, most, straight_to: spec.straight_to,
      ...(strip === null ? {} : {marked: [0, 1] as const})},
    key: strip?.entries,
    bands: strip?.bands.map(({from_s: from, until_s: until, colour}) =>
      ({from: from - origin_s, until: until - origin_s, colour})),
    colours: figure_colours(theme),
  }, ...SIZE);
}
