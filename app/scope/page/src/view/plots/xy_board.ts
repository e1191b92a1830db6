// SPDX-License-Identifier: Apache-2.0
/// Plots of one thing over another: the path and the true tip, the error over the distance. Of the
/// window that all plots show.

import type {Machine, Vector2, Vector3} from '../../model/api';
import {over_way, true_way, truth_over_way, way_of, type Points, type Step} from '../../model/xy';
import {runningTask} from '../../model/wanted';
import {el, set_shown} from '../basics/dom';
import {figure_svg, type Figure, type FigureLine} from './figure_svg';
import {DASHES, WIDTHS} from './line_styles';
import type {PageState} from '../basics/page_state';
import {csv_of, file_name, save_png, save_text} from './save';
import {figure_colours, save_menu, type SaveKind} from './save_plot';
import type {ThemeSwitch} from '../basics/theme';
import {unit_factor} from './traces';

/// Points of a curve; a step of some centimetres in half a minute.
const COUNT = 900;
const REFRESH_MS = 300;
const HEIGHT_PX = 260;
const SAVED = [900, 420] as const;

type Style = keyof typeof WIDTHS;

class XyPlot {
  readonly node: HTMLElement;
  private readonly host: HTMLElement;
  visible = false;
  private figure: Figure | null = null;

  constructor(private readonly title: string, name: string, note: string) {
    this.host = el('div', {class: 'xy-host', role: 'img', 'aria-label': title});
    this.node = el('figure', {class: 'plot xy', 'data-name': name},
      el('figcaption', {}, el('h3', {}, title), el('p', {class: 'note'}, note),
        save_menu(title, (kind) => this.save(kind))), this.host);
  }

  show(figure: Figure): void {
    this.figure = figure;
    const width = Math.max(200, this.host.clientWidth);
    const drawn = new DOMParser().parseFromString(figure_svg(figure, width, HEIGHT_PX), 'image/svg+xml');
    this.host.replaceChildren(document.importNode(drawn.documentElement, true));
  }

  private save(kind: SaveKind): void {
    if (this.figure === null) {
      return;
    }
    if (kind === 'csv') {
      save_text(file_name(this.title, kind), 'text/csv', xy_csv(this.figure));
      return;
    }
    // On the page the title stands above it.
    const drawing = figure_svg({...this.figure, title: this.title}, ...SAVED);
    if (kind === 'svg') {
      save_text(file_name(this.title, kind), 'image/svg+xml', drawing);
    } else {
      void save_png(file_name(this.title, kind), drawing);
    }
  }
}

/// Two columns a line, one below the other's end.
export function xy_csv({lines, x, y}: Figure): string {
  const longest = Math.max(0, ...lines.map(({points}) => points.length));
  const rows = Array.from({length: longest}, (_, row) => row);
  const columns = lines.flatMap(({points}) => [0, 1].map((part) =>
    rows.map((row) => points[row]?.[part] ?? null)));
  const heads = lines.flatMap(({label}) => [`${label}: ${x.label}`, `${label}: ${y.label}`]);
  return csv_of(['point', ...heads], [rows, ...columns]);
}

/// What the teeth or the edge are to follow, over reach and height.
export function wanted_way(machine: Machine, state: PageState): Points {
  if (machine.kind === 'dozer') {
    return machine.design.map(([x, z]): Vector2 => [x, z]);
  }
  const task = state.store.database === null ? null
    : runningTask(state.store, machine, state.playhead.now_s);
  const flat = ([x, y, z]: Vector3): Vector2 => [Math.hypot(x, y), z];
  return task === null ? machine.dig.path.map(([x, z]): Vector2 => [x, z])
    : task.steps.flatMap(({from, to, straight}): Points =>
      (straight ? [flat(from.position_m), flat(to.position_m), null] : []));
}

/// Least and most with a little around them.
function range(values: readonly number[], least: number): [number, number] {
  const from = values.reduce((a, b) => Math.min(a, b), Infinity);
  const until = values.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!(until >= from)) {
    return [0, least];
  }
  const around = Math.max(0.04 * (until - from), 0.5 * (least - (until - from)), 0);
  return [from - around, until + around];
}

export class XyBoard {
  readonly node: HTMLElement;
  private readonly path = new XyPlot('Path and tip', 'xy_path', 'Height over reach, m');
  private readonly error = new XyPlot('Error over distance', 'xy_error', 'Along the measured way');
  private drawn_ms = -Infinity;
  private drawn_for = '';
  private state: PageState | null = null;
  private readonly sight = new IntersectionObserver((entries) => {
    for (const {target, isIntersecting} of entries) {
      for (const plot of [this.path, this.error]) {
        plot.visible = plot.node === target ? isIntersecting : plot.visible;
      }
    }
    this.drawn_for = '';
  });

  constructor(private readonly theme: ThemeSwitch) {
    this.node = el('div', {class: 'plots xy-plots', hidden: true}, this.path.node, this.error.node);
    this.sight.observe(this.path.node);
    this.sight.observe(this.error.node);
    theme.on_change(() => { this.drawn_for = ''; });
    addEventListener('resize', () => { this.drawn_for = ''; });
    // Paper shows what was never scrolled to, too.
    addEventListener('beforeprint', () => {
      if (this.state?.machine != null && !this.node.hidden) {
        this.draw(this.state.machine, this.state, true);
      }
    });
  }

  frame(now_ms: number, state: PageState): void {
    this.state = state;
    const {machine, store, playhead, setup} = state;
    const there = machine !== null && store.frames > 0 && setup?.source.mode !== 'plan'
      && store.database?.kind === machine.kind;
    set_shown(this.node, there);
    if (!there || now_ms - this.drawn_ms < REFRESH_MS || !(this.path.visible || this.error.visible)) {
      return;
    }
    const key = `${store.revision} ${playhead.window.join()} ${playhead.now_s}`;
    if (key === this.drawn_for) {
      return;
    }
    this.drawn_for = key;
    this.drawn_ms = now_ms;
    this.draw(machine, state, false);
  }

  private draw(machine: Machine, state: PageState, all: boolean): void {
    const steps = way_of(machine, state.store, state.playhead.window, COUNT);
    if (all || this.path.visible) {
      this.path.show(this.path_figure(machine, state, steps));
    }
    if (all || this.error.visible) {
      this.error.show(this.error_figure(machine, state, steps));
    }
  }

  private line(label: string, colour: string, style: Style, points: Points): FigureLine {
    return {label, colour: this.theme.colour(colour), width: WIDTHS[style], dash: DASHES[style] ?? [],
      points};
  }

  private path_figure(machine: Machine, state: PageState, steps: readonly Step[]): Figure {
    const tip = machine.kind === 'dozer' ? 'edge' : 'tip';
    const measured = steps.map(({at_m}) => at_m);
    const real = true_way(state.setup?.run, state.playhead.window);
    const near = [...measured, ...real].flatMap((point) => (point === null ? [] : [point]));
    const wanted = wanted_way(machine, state);
    const all = machine.kind === 'dozer' ? near
      : [...near, ...wanted.flatMap((point) => (point === null ? [] : [point]))];
    const now = steps.filter(({time_s, at_m}) => time_s <= state.playhead.now_s && at_m !== null).at(-1);
    const [x, z] = [range(all.map(([at]) => at), 1), range(all.map(([, at]) => at), 0.5)];
    return {
      title: '', lines: [
        this.line(machine.kind === 'dozer' ? 'design' : 'path', 'primary', 'wanted', wanted),
        this.line(`measured ${tip}`, 'lambda', 'real', measured),
        ...(real.length > 0 ? [this.line(`true ${tip}`, 'true', 'truth', real)] : [])],
      x: {label: machine.kind === 'dozer' ? 'x, m' : 'reach, m', least: x[0], most: x[1]},
      y: {label: 'height, m', least: z[0], most: z[1]}, at: now?.at_m ?? null,
      // A grade is far longer than high.
      equal: machine.kind !== 'dozer', colours: figure_colours(this.theme)};
  }

  private error_figure(machine: Machine, state: PageState, steps: readonly Step[]): Figure {
    const signal = machine.kind === 'dozer' ? 'EcuGrade.GradeError' : 'EcuHydraulics.PathError';
    const told = over_way(steps, state.store, signal);
    const {run} = state.setup ?? {};
    const known = run?.truth.lines.find(({plot}) => plot === 'error');
    const real = truth_over_way(steps, run, 'error', unit_factor(known?.unit ?? '', 'mm') ?? NaN);
    const values = [...told, ...real].flatMap((point) => (point === null ? [] : [point[1]]));
    const [least, most] = range(values, 10);
    const now = steps.filter(({time_s}) => time_s <= state.playhead.now_s).at(-1);
    const at = now === undefined ? null
      : told.filter((point) => point !== null && point[0] <= now.way_m).at(-1) ?? null;
    return {
      title: '', lines: [this.line('error, measured', 'error', 'real', told),
        ...(real.length > 0 ? [this.line('true error', 'true', 'truth', real)] : [])],
      x: {label: 'distance, m', least: 0, most: Math.max(0.1, steps.at(-1)?.way_m ?? 0)},
      y: {label: 'error, mm', least: Math.min(0, least), most, straight_to: 10}, at,
      colours: figure_colours(this.theme)};
  }
}
