// SPDX-License-Identifier: Apache-2.0
/// What holds lambda, as a strip of colours below its curve, with a key of names and shares.

import type uPlot from 'uplot';
import type {FrameStore} from '../../model/api';
import {el, Rows, set_text} from '../basics/dom';
import {fixed} from '../basics/format';
import {index_of, kind_of, limit_colour, limit_key} from './limit_colours';
import type {LimitShares} from './limit_shares';
import type {ThemeSwitch} from '../basics/theme';

/// By the numbers that EcuStatus has.
export type LimitWords = (kind: number, index: number) => string;

const TOP = -0.04;
const BOTTOM = -0.17;

interface Span {
  from_s: number;
  until_s: number;
  key: number;
}

interface KeyRow {
  node: HTMLElement;
  swatch: HTMLElement;
  words: HTMLElement;
}

export class LimitStrip {
  readonly key = el('ul', {class: 'strip-key', 'aria-label': 'What holds lambda, in this window'});
  private spans: Span[] = [];
  private written: LimitShares['rows'] | null = null;
  private readonly rows = new Rows<KeyRow>(this.key, () => {
    const swatch = el('span', {class: 'swatch block'});
    const words = el('span');
    return {node: el('li', {}, swatch, words), swatch, words};
  });

  constructor(
    private readonly theme: ThemeSwitch, private readonly words: LimitWords,
    private readonly shares: LimitShares,
  ) {}

  /// One look a pixel: what stands there is the limit of the last frame before it.
  sample(store: FrameStore, from_s: number, until_s: number, pixels: number): void {
    this.spans = [];
    const frames = store.rows('EcuStatus');
    const definition = store.database?.messages.get('EcuStatus');
    const kind = definition?.signals.get('LimitKind');
    const index = definition?.signals.get('LimitIndex');
    if (kind === undefined || index === undefined || pixels < 1) {
      this.write_key();
      return;
    }
    let last: Span | null = null;
    for (let x = 0; x < pixels; ++x) {
      const time_s = from_s + ((x + 0.5) / pixels) * (until_s - from_s);
      const at = frames.at(time_s);
      if (at < 0 || time_s - frames.time(at) > Math.max(0.2, (until_s - from_s) / pixels)) {
        last = null;
        continue;
      }
      const {buffer, at: byte} = frames.bytes(at);
      const raw_kind = kind.raw(buffer, byte);
      const key = limit_key(raw_kind, index.raw(buffer, byte));
      const width_s = (until_s - from_s) / pixels;
      if (last !== null && last.key === key) {
        last.until_s += width_s;
      } else {
        last = {from_s: time_s - width_s / 2, until_s: time_s + width_s / 2, key};
        this.spans.push(last);
      }
    }
    this.write_key();
  }

  draw(plot: uPlot, origin_s: number): void {
    const {ctx, bbox} = plot;
    const top = plot.valToPos(TOP, 'y', true);
    const height = plot.valToPos(BOTTOM, 'y', true) - top;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    for (const {from_s, until_s, key} of this.spans) {
      const left = plot.valToPos(from_s - origin_s, 'x', true);
      const right = plot.valToPos(until_s - origin_s, 'x', true);
      ctx.fillStyle = limit_colour(this.theme, key);
      ctx.fillRect(left, top, Math.max(1, right - left), height);
    }
    ctx.restore();
  }

  /// As drawn last, with their colours.
  get bands(): readonly {from_s: number; until_s: number; colour: string}[] {
    return this.spans.map(({from_s, until_s, key}) =>
      ({from_s, until_s, colour: limit_colour(this.theme, key)}));
  }

  /// The key as it is written, with its colours.
  get entries(): readonly {label: string; colour: string}[] {
    return this.shares.rows.map(({key, share}) =>
      ({label: share_words(key, share, this.words), colour: limit_colour(this.theme, key)}));
  }

  /// Shares are counted later than the strip is drawn: the key follows them.
  follow(): void {
    if (this.written !== this.shares.rows) {
      this.write_key();
    }
  }

  private write_key(): void {
    this.written = this.shares.rows;
    const rows = this.rows.take(this.shares.rows.length);
    this.shares.rows.forEach(({key, share}, k) => {
      const row = rows[k]!;
      row.swatch.style.setProperty('--line', limit_colour(this.theme, key));
      set_text(row.words, share_words(key, share, this.words));
    });
  }
}

const share_words = (key: number, share: number, words: LimitWords): string =>
  `${limit_name(key, words)} ${fixed(share * 100, 1)} %`;

export const limit_name = (key: number, words: LimitWords): string =>
  key === 0 ? 'nothing' : words(kind_of(key), index_of(key));
