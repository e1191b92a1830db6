// SPDX-License-Identifier: Apache-2.0
/// All plots of a machine: one window, one cursor. Curves are fetched only for plots in sight, at
/// most fifteen times a second, and a few at a time, so that the scene keeps its frames.

import type {Run} from '../../model/api';
import {el, set_shown, set_text} from '../basics/dom';
import type {LimitShares} from '../limits/limit_shares';
import {LimitStrip, type LimitWords} from '../limits/limit_strip';
import type {PageState} from '../basics/page_state';
import {OwnLines} from './own_lines';
import {Plot, type PlotHost} from './plot';
import {plot_gestures} from './plot_gestures';
import {empty_words, plots_of, plotted, type PlotSpec} from './plots';
import {take_drops} from './signal_drag';
import type {ThemeSwitch} from '../basics/theme';

const REFRESH_MS = 66;
const BUDGET_MS = 7;
const SLOW_MS = 40;
const HEIGHT_PX = 164;
const PRINT_WIDTH_PX = 310;  ///< Two beside each other on A4.
const STRIP_HEIGHT_PX = 190;

export class PlotBoard {
  readonly node = el('div', {class: 'plots'});
  private readonly empty = el('p', {class: 'quiet'});
  private plots: Plot[] = [];
  private chosen_for = '';
  private run: Run | undefined;
  private pumps = 0;  ///< Most that were ever seen in this store.
  private store: unknown = null;
  private machine: unknown = null;
  readonly own = new OwnLines();
  private own_revision = 0;
  private readonly came = new Set<string>();  ///< Messages, at least once.
  private hover_s: number | null = null;
  private revision = -1;
  private window: readonly [number, number] = [0, 0];
  private values_ms = 0;
  private frame_ms = 0;
  private marked = '';
  private readonly sight = new IntersectionObserver((entries) => {
    for (const {target, isIntersecting} of entries) {
      const plot = this.plots.find(({node}) => node === target);
      if (plot !== undefined) {
        plot.visible = isIntersecting;
        // The playhead went on while the plot was out of sight.
        plot.mark(this.state.playhead.now_s, this.hover_s);
      }
    }
  });
  private readonly size = new ResizeObserver(() => this.fit());

  constructor(
    private readonly state: PageState, private readonly theme: ThemeSwitch,
    private readonly words: LimitWords, private readonly shares: LimitShares,
  ) {
    this.node.append(this.empty);
    this.size.observe(this.node);
    theme.on_change(() => {
      for (const plot of this.plots) {
        plot.retheme();
      }
    });
    plot_gestures(this.node, state);
    take_drops(this.node, (signal) => this.put(signal, null));
    state.playhead.on_change(() => this.mark());
    // Paper shows what was never scrolled to, too.
    addEventListener('beforeprint', () => this.draw_all(PRINT_WIDTH_PX));
    addEventListener('afterprint', () => this.fit());
  }

  /// To be called a frame of the screen: does as much as there is time for.
  frame(now_ms: number): void {
    const {store, playhead, machine} = this.state;
    const [from_s, until_s] = playhead.window;
    const begun_ms = performance.now();
    const slow = now_ms - this.frame_ms > SLOW_MS;
    this.frame_ms = now_ms;
    if (store !== this.store || store.revision !== this.revision || machine !== this.machine
        || this.own.revision !== this.own_revision
        || from_s !== this.window[0] || until_s !== this.window[1]) {
      this.revision = store.revision;
      this.machine = machine;
      this.own_revision = this.own.revision;
      this.choose();
      this.window = [from_s, until_s];
      for (const plot of this.plots) {
        plot.dirty = true;
      }
    }
    // Whoever has waited longest is first.
    const waiting = this.plots
      .filter(({visible, dirty, drawn_ms}) => visible && dirty && now_ms - drawn_ms >= REFRESH_MS)
      .sort((a, b) => a.drawn_ms - b.drawn_ms);
    for (const plot of waiting) {
      plot.refresh(store, this.window);
      plot.drawn_ms = now_ms;
      plot.mark(playhead.now_s, this.hover_s);
      // Where frames come slowly as it is, one plot in each is enough.
      if (slow || performance.now() - begun_ms > BUDGET_MS) {
        break;
      }
    }
    if (now_ms - this.values_ms >= REFRESH_MS) {
      this.values_ms = now_ms;
      this.values();
    }
  }

  /// Plots go by the machine and by the messages that came so far.
  private choose(): void {
    const {machine, setup, store} = this.state;
    if (store !== this.store) {
      this.store = store;
      this.came.clear();
      this.pumps = 0;
    }
    for (const name of store.database?.messages.keys() ?? []) {
      if (!this.came.has(name) && store.rows(name).count > 0) {
        this.came.add(name);
      }
    }
    const of = plotted(machine, store);
    // A pump that fails has been there.
    this.pumps = machine !== null ? of?.pumps ?? 0 : Math.max(this.pumps, of?.pumps ?? 0);
    const {run} = setup ?? {};
    const key = `${of?.kind} ${this.pumps} ${[...this.came].join()} ${this.own.revision}`;
    if (key === this.chosen_for && run === this.run) {
      set_text(this.empty, empty_words(store));
      return;
    }
    this.chosen_for = key;
    this.build(this.own.into(plots_of(of && {...of, pumps: this.pumps}, run, this.came), store), run);
    set_shown(this.empty, this.plots.length === 0);
    set_text(this.empty, empty_words(store));
  }

  /// A plot whose lines are the same stays as it is, with what is hidden in it.
  private build(specs: readonly PlotSpec[], run: Run | undefined): void {
    const kept = new Map(run === this.run ? this.plots.map((plot) => [plot_key(plot.spec), plot])
      : []);
    this.run = run;
    if (kept.size === specs.length && specs.every((spec) => kept.has(plot_key(spec)))) {
      return;
    }
    const host = this.host();
    const before = this.plots;
    this.plots = specs.map((spec) => kept.get(plot_key(spec)) ?? new Plot(spec, host,
      spec.strip === true ? new LimitStrip(this.theme, this.words, this.shares) : null));
    for (const plot of before.filter((one) => !this.plots.includes(one))) {
      this.sight.unobserve(plot.node);
      plot.destroy();
    }
    let last: Element = this.empty;
    for (const {node} of this.plots) {
      if (last.nextElementSibling !== node) {
        last.after(node);
      }
      this.sight.observe(node);
      last = node;
    }
    this.fit();
  }

  /// What there is to put a signal into.
  plots_there(): readonly {name: string; title: string}[] {
    return this.plots.map(({spec: {name, title}}) => ({name, title}));
  }

  /// `plot` null: into a new one. It is brought into sight.
  put(signal: string, plot: string | null): void {
    if (this.own.put(signal, plot)) {
      const {plot: name} = this.own.lines.at(-1)!;
      this.frame(performance.now());
      this.plots.find(({spec}) => spec.name === name)?.node.scrollIntoView({block: 'nearest'});
    }
  }

  private draw_all(width_px: number): void {
    const {store, playhead} = this.state;
    for (const plot of this.plots) {
      plot.resize(width_px, plot.spec.strip === true ? STRIP_HEIGHT_PX : HEIGHT_PX);
      plot.refresh(store, playhead.window);
      plot.mark(playhead.now_s, null);
      plot.values(store, playhead.now_s);
    }
  }

  private host(): PlotHost {
    const {playhead} = this.state;
    return {
      theme: this.theme,
      origin_s: () => this.state.origin_s,
      hover: (time_s) => {
        this.hover_s = time_s;
        this.mark();
        this.values();
      },
      put: (signal, plot) => this.put(signal, plot),
      take_out: (signal, plot) => this.own.take_out(signal, plot),
      seek: (time_s) => playhead.seek(time_s),
      zoom: (from_s, until_s) => {
        // A zoom into what comes would be pushed out of sight by it.
        playhead.follow = false;
        playhead.window = [from_s, until_s];
      },
      whole: () => {
        playhead.window = [this.state.extent.from_s, this.state.extent.until_s];
      },
    };
  }

  private mark(): void {
    const {now_s} = this.state.playhead;
    const key = `${now_s} ${this.hover_s}`;
    if (key === this.marked) {
      return;
    }
    this.marked = key;
    for (const plot of this.plots) {
      if (plot.visible) {
        plot.mark(now_s, this.hover_s);
      }
    }
  }

  private values(): void {
    const time_s = this.hover_s ?? this.state.playhead.now_s;
    for (const plot of this.plots) {
      if (plot.visible) {
        plot.values(this.state.store, time_s);
      }
    }
  }

  private fit(): void {
    for (const plot of this.plots) {
      const style = getComputedStyle(plot.node);
      const width = plot.node.clientWidth - parseFloat(style.paddingLeft)
        - parseFloat(style.paddingRight);
      plot.resize(Math.floor(width), plot.spec.strip === true ? STRIP_HEIGHT_PX : HEIGHT_PX);
    }
  }
}

/// Plots of the same key are the same, but for what a run knows.
function plot_key({name, title, unit, lines}: PlotSpec): string {
  return [name, title, unit, ...lines.map(({label, trace}) =>
    `${label} ${trace.signals.join()}`)].join('|');
}
