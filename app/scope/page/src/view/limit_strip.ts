/// What holds lambda, as a strip of colours below its curve, with a key of names and shares.

import type uPlot from 'uplot';
import type {FrameStore} from '../model/api';
import {el, Rows, set_text} from './dom';
import {fixed} from './format';
import type {ThemeSwitch} from './theme';

/// By the numbers that EcuStatus has.
export type LimitWords = (kind: number, index: number) => string;

const COLOURS = 13;
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
  private readonly colours = new Map<number, string>();
  private readonly rows = new Rows<KeyRow>(this.key, () => {
    const swatch = el('span', {class: 'swatch block'});
    const words = el('span');
    return {node: el('li', {}, swatch, words), swatch, words};
  });

  constructor(private readonly theme: ThemeSwitch, private readonly words: LimitWords) {}

  /// One look a pixel: what stands there is the limit of the last frame before it.
  sample(store: FrameStore, from_s: number, until_s: number, pixels: number): void {
    this.spans = [];
    const frames = store.rows('EcuStatus');
    const definition = store.database?.messages.get('EcuStatus');
    const kind = definition?.signals.get('LimitKind');
    const index = definition?.signals.get('LimitIndex');
    if (kind === undefined || index === undefined || pixels < 1) {
      this.write_key(0);
      return;
    }
    let last: Span | null = null;
    let seen_s = 0;
    for (let x = 0; x < pixels; ++x) {
      const time_s = from_s + ((x + 0.5) / pixels) * (until_s - from_s);
      const at = frames.at(time_s);
      if (at < 0 || time_s - frames.time(at) > Math.max(0.2, (until_s - from_s) / pixels)) {
        last = null;
        continue;
      }
      const {buffer, at: byte} = frames.bytes(at);
      const raw_kind = kind.raw(buffer, byte);
      const key = raw_kind === 0 ? 0 : raw_kind * 256 + index.raw(buffer, byte);
      const width_s = (until_s - from_s) / pixels;
      seen_s += width_s;
      if (last !== null && last.key === key) {
        last.until_s += width_s;
      } else {
        last = {from_s: time_s - width_s / 2, until_s: time_s + width_s / 2, key};
        this.spans.push(last);
      }
    }
    this.write_key(seen_s);
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
      ctx.fillStyle = this.theme.colour(this.colour(key));
      ctx.fillRect(left, top, Math.max(1, right - left), height);
    }
    ctx.restore();
  }

  /// Colours are given in the order in which limits appear, and kept.
  colour(key: number): string {
    if (key === 0) {
      return 'limit0';
    }
    let colour = this.colours.get(key);
    if (colour === undefined) {
      // More than there are colours share one that none else has.
      colour = this.colours.size < COLOURS ? `limit${this.colours.size + 1}` : 'limit-more';
      this.colours.set(key, colour);
    }
    return colour;
  }

  private write_key(seen_s: number): void {
    const shares = new Map<number, number>();
    for (const {from_s, until_s, key} of this.spans) {
      shares.set(key, (shares.get(key) ?? 0) + until_s - from_s);
    }
    const sorted = [...shares].sort((a, b) => b[1] - a[1]);
    const rows = this.rows.take(sorted.length);
    sorted.forEach(([key, share_s], k) => {
      const row = rows[k]!;
      row.swatch.style.setProperty('--line', `var(--${this.colour(key)})`);
      const name = key === 0 ? 'nothing' : this.words(key >> 8, key & 0xff);
      set_text(row.words, `${name} ${fixed((share_s / seen_s) * 100, 1)} %`);
    });
  }
}
