// SPDX-License-Identifier: Apache-2.0
/// Signals that the reader has put into plots: any signal of the bus into any plot, or a new one.

import type {FrameStore} from '../../model/api';
import {digits_of, name_words, unit_words} from '../basics/format';
import {in_unit, signal_trace, unit_factor} from './traces';
import type {Line, PlotSpec} from './plots';

/// What is dragged.
export const SIGNAL_TYPE = 'text/x-graben-signal';
/// More lines than this nobody tells apart.
export const MOST_OWN = 8;

const COLOURS = ['first', 'true', 'second', 'error', 'lambda', 'boom', 'arm', 'bucket'];

export interface OwnLine {
  plot: string;    ///< Name of a plot, of an own one too.
  signal: string;  ///< 'BoomStroke.BoomStroke'.
}

export class OwnLines {
  private own: OwnLine[] = [];
  private made = 0;
  revision = 0;

  get lines(): readonly OwnLine[] {
    return this.own;
  }

  /// `plot` null: a new one. False: it is there already, or too many are.
  put(signal: string, plot: string | null): boolean {
    const into = plot ?? `own${++this.made}`;
    const there = this.own.filter((line) => line.plot === into);
    if (there.length >= MOST_OWN || there.some((line) => line.signal === signal)) {
      return false;
    }
    this.own.push({plot: into, signal});
    ++this.revision;
    return true;
  }

  take_out(signal: string, plot: string): void {
    this.own = this.own.filter((line) => line.plot !== plot || line.signal !== signal);
    ++this.revision;
  }

  /// The plots with the reader's lines in them; own plots come first, where they are seen.
  into(plots: readonly PlotSpec[], store: FrameStore): PlotSpec[] {
    const all = plots.map((plot) => ({...plot, lines: [...plot.lines]}));
    const fresh: (PlotSpec & {lines: Line[]})[] = [];
    for (const {plot: name, signal} of this.own) {
      const unit = unit_of(store, signal);
      let plot = [...all, ...fresh].find((one) => one.name === name);
      if (plot === undefined) {
        plot = {name, title: `Own plot ${name.replace('own', '')}`, unit, note: 'Put together here', lines: []};
        fresh.push(plot);
      }
      plot.lines.push(own_line(store, signal, plot));
    }
    return [...fresh, ...all];
  }
}

const definition = (store: FrameStore, signal: string) => {
  const [message, name] = signal.split('.') as [string, string];
  return store.database?.messages.get(message)?.signals.get(name);
};

const unit_of = (store: FrameStore, signal: string): string => definition(store, signal)?.unit ?? '';

/// 'Boom pressure: cap'; a message that is named as its signal is told once.
export function signal_words(signal: string): string {
  const [message = '', name = ''] = signal.split('.');
  return message === name ? name_words(name) : `${name_words(message)}: ${name_words(name).toLowerCase()}`;
}

/// In the plot's unit where that can be, else in its own, which its name tells.
function own_line(store: FrameStore, signal: string, plot: PlotSpec): Line {
  const unit = unit_of(store, signal);
  const factor = unit_factor(unit, plot.unit);
  const trace = signal_trace(signal);
  const alike = factor !== null;
  return {
    label: alike || unit === '' ? signal_words(signal) : `${signal_words(signal)}, ${unit_words(unit)}`,
    colour: COLOURS[plot.lines.length % COLOURS.length]!, style: 'real', own: signal,
    digits: alike && factor !== 1 ? plot.lines[0]?.digits ?? 1
      : digits_of(definition(store, signal)?.factor ?? 1),
    unit: alike ? undefined : unit, trace: alike && factor !== 1 ? in_unit(trace, factor) : trace};
}
