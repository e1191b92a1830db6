// SPDX-License-Identifier: Apache-2.0
/// How long the control cycles took, over the window of the plots.

import uPlot from 'uplot';
import {on_processor} from '../basics/cpu_canvas';
import {el, set_shown, set_text} from '../basics/dom';
import {BARS, distribution, type Distribution} from './plot_range';
import {count, fixed, time_words} from '../basics/format';
import type {PageState} from '../basics/page_state';
import type {ThemeSwitch} from '../basics/theme';

const EVERY_MS = 500;
const HEIGHT_PX = 144;

export class Histogram {
  readonly node: HTMLElement;
  private readonly words = el('p', {class: 'note', role: 'status', 'aria-live': 'off'});
  private readonly canvas = el('div', {class: 'plot-canvas'});
  private plot: uPlot | null = null;
  private key = '';
  private store: unknown = null;
  private done_ms = 0;
  private visible = false;

  constructor(private readonly theme: ThemeSwitch) {
    this.node = el('figure', {class: 'plot', 'data-name': 'cycle'},
      el('figcaption', {}, el('h3', {}, 'Cycle times, how often', el('span', {class: 'unit'}, ', µs'))),
      this.words, this.canvas);
    new IntersectionObserver(([entry]) => {
      this.visible = entry?.isIntersecting ?? false;
    }).observe(this.node);
    theme.on_change(() => this.plot?.redraw(false, true));
    new ResizeObserver(() => this.fit()).observe(this.canvas);
  }

  frame(now_ms: number, state: PageState): void {
    set_shown(this.node, state.store.database !== null);
    const [from_s, until_s] = state.playhead.window;
    const key = `${from_s} ${until_s} ${state.store.revision}`;
    const same = key === this.key && state.store === this.store;
    if (!this.visible || same || now_ms - this.done_ms < EVERY_MS) {
      return;
    }
    this.key = key;
    this.store = state.store;
    this.done_ms = now_ms;
    this.write(distribution(cycle_times(state, from_s, until_s)), until_s - from_s);
  }

  private write(of: Distribution, span_s: number): void {
    const nothing = of.cycles === 0 || of.all_zero;
    set_shown(this.canvas, !nothing);
    if (of.cycles === 0) {
      set_text(this.words, 'No EcuStatus in this window.');
    } else if (of.all_zero) {
      set_text(this.words, 'Not measured: simulated time.');
    } else {
      set_text(this.words, `${count(of.cycles)} reported cycles in ${time_words(span_s, 1)}: `
        + `median ${fixed(of.median_us, 0)} µs, 99 % below ${fixed(of.p99_us, 0)} µs, largest `
        + `${fixed(of.max_us, 0)} µs. The last bar holds all beyond.`);
      this.draw(of);
    }
  }

  private draw(of: Distribution): void {
    const data: uPlot.AlignedData = [
      Array.from(of.bars, (_, bar) => (bar + 0.5) * of.bar_us), Array.from(of.bars),
    ];
    if (this.plot === null) {
      this.plot = on_processor(() => new uPlot(this.options(), data, this.canvas));
      this.fit();
    } else {
      this.plot.setData(data);
    }
  }

  private fit(): void {
    const width = Math.floor(this.canvas.clientWidth);
    if (width > 0) {
      this.plot?.setSize({width, height: HEIGHT_PX});
    }
  }

  private options(): uPlot.Options {
    const {theme} = this;
    const axis = {
      stroke: () => theme.colour('muted'), font: '12px system-ui, sans-serif',
      grid: {stroke: () => theme.colour('grid'), width: 1},
      ticks: {stroke: () => theme.colour('grid'), width: 1, size: 4},
    };
    return {
      width: 400, height: HEIGHT_PX, legend: {show: false}, padding: [6, 10, 0, 0],
      cursor: {show: false},
      scales: {
        x: {time: false, range: (plot) => {
          const centre_us = plot.data[0]?.[0] ?? 1;
          return [0, centre_us * 2 * BARS];
        }},
        y: {range: (_plot, _min, max) => [0, Math.max(1, max * 1.05)]},
      },
      axes: [{
        ...axis, size: 24, space: 60, label: 'cycle time, µs', labelSize: 16, labelGap: 0,
        labelFont: '12px system-ui, sans-serif',
      }, {
        ...axis, size: 48, space: 28, label: 'cycles', labelSize: 16, labelGap: 2,
        labelFont: '12px system-ui, sans-serif',
      }],
      series: [{}, {
        stroke: () => theme.colour('first'), fill: () => theme.colour('available-soft'), width: 1,
        points: {show: false}, paths: uPlot.paths.bars!({size: [1, Infinity], gap: 1}),
      }],
    };
  }
}

function cycle_times({store}: PageState, from_s: number, until_s: number): Float64Array {
  const signal = store.database?.messages.get('EcuStatus')?.signals.get('CycleTime');
  if (signal === undefined) {
    return new Float64Array(0);
  }
  const rows = store.rows('EcuStatus');
  const first = rows.at(from_s) + 1;
  const last = rows.at(until_s);
  const times = new Float64Array(Math.max(0, last - first + 1));
  let kept = 0;
  for (let row = first; row <= last; ++row) {
    const {buffer, at} = rows.bytes(row);
    const raw = signal.raw(buffer, at);
    if (signal.state(raw) === 'valid') {
      times[kept++] = raw * signal.factor + signal.offset;
    }
  }
  return times.subarray(0, kept);
}
