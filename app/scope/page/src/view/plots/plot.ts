// SPDX-License-Identifier: Apache-2.0
/// One plot: uPlot with the page's theme, the playhead's line, a legend with values.

import uPlot from 'uplot';
import type {Curve, FrameStore} from '../../model/api';
import {on_processor} from '../basics/cpu_canvas';
import {align} from '../basics/curves';
import {el} from '../basics/dom';
import {digits_of, fixed, time_words, unit_words} from '../basics/format';
import {Greatest, greatest_of} from './greatest';
import {Legend} from './legend';
import type {LimitStrip} from '../limits/limit_strip';
import {DASHES, WIDTHS} from './line_styles';
import type {PlotSpec} from './plots';
import {save_menu, save_plot, type SaveKind} from './save_plot';
import {take_drops} from './signal_drag';
import type {ThemeSwitch} from '../basics/theme';
import {stable_range} from './plot_range';

/// What a plot asks of those beside it: they share cursor and window.
export interface PlotHost {
  readonly theme: ThemeSwitch;
  origin_s(): number;
  hover(time_s: number | null): void;
  seek(time_s: number): void;
  zoom(from_s: number, until_s: number): void;
  whole(): void;
  /// A signal that was dropped on the plot, and one that is to go.
  put(signal: string, plot: string): void;
  take_out(signal: string, plot: string): void;
}

const FONT = '12px system-ui, sans-serif';
const PIXELS_PER_BUCKET = 2;
const BAR = 10;  ///< Of one MPa.
const TIME_STEPS_S = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30,
  60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 28800, 86400];

export class Plot {
  readonly node: HTMLElement;
  visible = false;
  dirty = true;
  drawn_ms = 0;
  private readonly plot: uPlot;
  private readonly legend: Legend;
  private readonly greatest: Greatest;
  private readonly playhead_line = el('div', {class: 'playhead-line'});
  private window: readonly [number, number] = [0, 1];
  private store: FrameStore | null = null;
  private plain = false;  ///< While the cursor is set by the page and not by the pointer.

  constructor(
    readonly spec: PlotSpec, private readonly host: PlotHost,
    private readonly strip: LimitStrip | null,
  ) {
    this.legend = new Legend(spec, (line, shown) => this.plot.setSeries(line + 1, {show: shown}),
      (signal) => host.take_out(signal, spec.name));
    this.greatest = new Greatest((time_s) => host.seek(time_s));
    const canvas = el('div', {
      class: 'plot-canvas', tabindex: 0, role: 'group', 'data-plot': spec.name,
      'aria-label': `Plot: ${spec.title}. Arrows move the cursor, plus and minus zoom, 0 whole.`,
    });
    const unit = spec.unit === '' ? '' : `, ${unit_words(spec.unit)}`;
    this.node = el('figure', {class: 'plot', 'data-name': spec.name},
      el('figcaption', {},
        el('h3', {}, spec.title, el('span', {class: 'unit'}, unit)), this.greatest.node,
        el('p', {class: 'note'}, spec.note), save_menu(spec.title, (kind) => this.save(kind))),
      this.legend.node, canvas, strip?.key ?? null);
    this.plot = on_processor(() =>
      new uPlot(this.options(), [[], ...spec.lines.map(() => [])], canvas));
    this.plot.over.append(this.playhead_line);
    this.plot.over.addEventListener('click', (event) => {
      const left = event.clientX - this.plot.over.getBoundingClientRect().left;
      this.host.seek(this.plot.posToVal(left, 'x') + this.host.origin_s());
    });
    this.plot.over.addEventListener('mouseleave', () => this.host.hover(null));
    take_drops(this.node, (signal) => host.put(signal, spec.name));
  }

  resize(width: number, height: number): void {
    if (width > 0 && (width !== this.plot.width || height !== this.plot.height)) {
      this.plot.setSize({width, height});
      this.dirty = true;
    }
  }

  /// New curves for the window.
  refresh(store: FrameStore, window: readonly [number, number]): void {
    this.window = window;
    this.store = store;
    const [from_s, until_s] = window;
    const pixels = this.plot.bbox.width / uPlot.pxRatio;
    const buckets = Math.max(50, Math.round(pixels / PIXELS_PER_BUCKET));
    const shown = this.spec.lines.filter((_, line) => this.legend.shown(line));
    const curves = shown.map(({trace}) => trace.curve(store, from_s, until_s, buckets));
    this.tell_greatest(curves);
    this.strip?.sample(store, from_s, until_s, Math.round(pixels));
    const columns = align(curves, this.host.origin_s());
    const data: uPlot.AlignedData = [columns[0]];
    let next = 1;
    for (let line = 0; line < this.spec.lines.length; ++line) {
      data.push(this.legend.shown(line) ? columns[next++]! : []);
    }
    this.plot.batch(() => {
      this.plot.setData(data, false);
      const origin_s = this.host.origin_s();
      this.plot.setScale('x', {min: from_s - origin_s, max: until_s - origin_s});
    });
    this.dirty = false;
  }

  /// Of the plot's own line; where that is out of the picture, of none.
  private tell_greatest([curve]: readonly Curve[]): void {
    const {arrived, unit, lines} = this.spec;
    if (arrived !== undefined) {
      const there = curve !== undefined && this.legend.shown(0);
      this.greatest.show(there ? greatest_of(curve, this.window, arrived) : null, unit,
        lines[0]!.digits, this.host.origin_s());
    }
  }

  /// Where the page looks, and where the pointer is, on whichever plot.
  mark(now_s: number, hover_s: number | null): void {
    const [from_s, until_s] = this.window;
    const width = this.plot.bbox.width / uPlot.pxRatio;
    const at = (time_s: number) => ((time_s - from_s) / (until_s - from_s)) * width;
    const inside = now_s >= from_s && now_s <= until_s;
    this.playhead_line.style.transform = `translateX(${inside ? at(now_s) : -10}px)`;
    const hidden = hover_s === null || hover_s < from_s || hover_s > until_s;
    this.plain = true;
    this.plot.setCursor(hidden ? {left: -10, top: -10} : {left: at(hover_s), top: 10}, false);
    this.plain = false;
  }

  values(store: FrameStore, time_s: number): void {
    this.legend.values(store, time_s);
    this.strip?.follow();
  }

  /// Of the window that is shown: as it is drawn, or every frame of it.
  private save(kind: SaveKind): void {
    const lines = this.spec.lines.filter((_, line) => this.legend.shown(line));
    save_plot(kind, {
      spec: this.spec, lines, store: this.store, window: this.window,
      origin_s: this.host.origin_s(), theme: this.host.theme, strip: this.strip});
  }

  retheme(): void {
    this.plot.redraw(false, true);
  }

  destroy(): void {
    this.plot.destroy();
    this.node.remove();
  }

  private options(): uPlot.Options {
    const {theme} = this.host;
    const axis = {
      stroke: () => theme.colour('muted'), font: FONT, labelFont: FONT,
      grid: {stroke: () => theme.colour('grid'), width: 1},
      ticks: {stroke: () => theme.colour('grid'), width: 1, size: 4},
    };
    return {
      width: 400, height: 150, pxAlign: 0, legend: {show: false}, padding: [6, 10, 0, 0],
      cursor: {
        y: false, points: {show: false}, drag: {x: true, y: false, setScale: false},
        bind: {
          dblclick: () => () => {
            this.host.whole();
            return null;
          },
        },
      },
      scales: {
        x: {time: false, auto: false},
        y: {
          range: stable_range(this.spec.least, this.strip !== null),
          ...(this.spec.straight_to === undefined ? {} : {distr: 4, asinh: this.spec.straight_to}),
        },
      },
      axes: [
        {
          ...axis, size: 24, space: 70, incrs: TIME_STEPS_S, label: 'time, min:s', labelSize: 16,
          labelGap: 0, values: (_u, splits, _a, _s, step) => time_ticks(splits, step),
        },
        {
          ...axis, size: 48, space: 28, values: (_u, splits) => numbers(splits),
          ...(this.strip === null ? {} : {splits: () => [0, 0.25, 0.5, 0.75, 1]}),
          ...(this.spec.straight_to === undefined ? {} : {
            splits: bent_splits, filter: (_u: uPlot, splits: number[]) => splits,
          }),
        },
        // A hydraulics engineer reads MPa, an operator bar.
        ...(this.spec.unit !== 'MPa' ? [] : [{
          ...axis, scale: 'y', side: 1 as const, size: 40, space: 28, grid: {show: false},
          label: 'bar', labelSize: 16, labelGap: 0,
          values: (_u: uPlot, splits: number[]) => numbers(splits.map((value) => value * BAR)),
        }]),
      ],
      series: [{}, ...this.spec.lines.map((line): uPlot.Series => ({
        stroke: () => theme.colour(line.colour), points: {show: false},
        width: WIDTHS[line.style], dash: DASHES[line.style] ?? [],
      }))],
      hooks: {
        setCursor: [(plot) => this.pointed(plot)],
        setSelect: [(plot) => this.selected(plot)],
        drawAxes: [(plot) => this.strip?.draw(plot, this.host.origin_s())],
      },
    };
  }

  private pointed(plot: uPlot): void {
    const left = plot.cursor.left ?? -10;
    if (!this.plain && left >= 0) {
      this.host.hover(plot.posToVal(left, 'x') + this.host.origin_s());
    }
  }

  private selected(plot: uPlot): void {
    const {left, width} = plot.select;
    if (width > 4) {
      const origin_s = this.host.origin_s();
      this.host.zoom(
        plot.posToVal(left, 'x') + origin_s, plot.posToVal(left + width, 'x') + origin_s);
    }
    plot.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
  }
}

function numbers(splits: readonly number[]): string[] {
  const step = splits.length > 1 ? Math.abs(splits[1]! - splits[0]!) : 1;
  return splits.map((value) => fixed(value, digits_of(step)));
}

/// Marks of an axis that is straight about 0 and then goes by powers of ten.
function bent_splits(_plot: uPlot, _axis: number, min: number, max: number): number[] {
  const marks = [1000, 100, 30, 10, 5].flatMap((mark) => [-mark, mark]);
  return [0, ...marks].filter((mark) => mark >= min && mark <= max).sort((a, b) => a - b);
}

/// Times of the axis, with as many digits as its steps need.
function time_ticks(splits: readonly number[], step_s: number): string[] {
  const digits = step_s >= 1 ? 0 : step_s >= 0.1 ? 1 : step_s >= 0.01 ? 2 : 3;
  return splits.map((time_s) => time_words(time_s, digits));
}
