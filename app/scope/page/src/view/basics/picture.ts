// SPDX-License-Identifier: Apache-2.0
/// A canvas that fills its frame, metres on it, and the strokes that flat pictures are made of.

import type {Vector2} from '../../model/api';
import {el} from './dom';

/// A stretch of a plane, m: least and most of both axes.
export interface Span {
  u: readonly [number, number];
  v: readonly [number, number];
}

/// To pixels; u to the right, v upwards, alike in both.
export class Metres {
  readonly per_m: number;
  private readonly left: number;
  private readonly bottom: number;

  constructor(readonly span: Span, readonly width: number, readonly height: number) {
    const [u, v] = [span.u[1] - span.u[0], span.v[1] - span.v[0]];
    this.per_m = Math.min(width / u, height / v);
    this.left = 0.5 * (width - this.per_m * u) - this.per_m * span.u[0];
    this.bottom = 0.5 * (height + this.per_m * v) + this.per_m * span.v[0];
  }

  at([u, v]: Vector2): Vector2 {
    return [this.left + this.per_m * u, this.bottom - this.per_m * v];
  }

  /// All that is in the picture, which may be more than the span.
  get seen(): Span {
    return {
      u: [-this.left / this.per_m, (this.width - this.left) / this.per_m],
      v: [(this.bottom - this.height) / this.per_m, this.bottom / this.per_m]};
  }
}

const MOST_RATIO = 2;

export class Picture {
  readonly node: HTMLElement;
  private readonly canvas = el('canvas', {'aria-hidden': 'true'});
  readonly pen: CanvasRenderingContext2D;
  private width = 1;
  private height = 1;
  private ratio = 1;

  constructor(name: string, words: string) {
    this.pen = this.canvas.getContext('2d', {alpha: false})!;
    this.node = el('div', {class: `picture ${name}`, role: 'img', 'aria-label': words}, this.canvas);
    new ResizeObserver(() => this.fit()).observe(this.node);
  }

  private fit(): void {
    this.width = Math.max(1, this.node.clientWidth);
    this.height = Math.max(1, this.node.clientHeight);
    this.ratio = Math.min(MOST_RATIO, devicePixelRatio);
    this.canvas.width = Math.round(this.width * this.ratio);
    this.canvas.height = Math.round(this.height * this.ratio);
  }

  /// A clean sheet.
  begin(span: Span, background: string): Metres {
    this.pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    this.pen.fillStyle = background;
    this.pen.fillRect(0, 0, this.width, this.height);
    return new Metres(span, this.width, this.height);
  }

  line(points: readonly Vector2[], colour: string, width: number, dash: readonly number[] = []): void {
    this.trace(points);
    this.pen.setLineDash([...dash]);
    this.pen.strokeStyle = colour;
    this.pen.lineWidth = width;
    this.pen.lineJoin = 'round';
    this.pen.stroke();
    this.pen.setLineDash([]);
  }

  area(points: readonly Vector2[], fill: string, edge: string | null = null, width = 1.5): void {
    this.trace(points);
    this.pen.closePath();
    this.pen.fillStyle = fill;
    this.pen.fill();
    if (edge !== null) {
      this.pen.strokeStyle = edge;
      this.pen.lineWidth = width;
      this.pen.lineJoin = 'round';
      this.pen.stroke();
    }
  }

  /// A line with strokes on the side where nothing may be: not by its colour alone.
  fence(from: Vector2, to: Vector2, beyond: Vector2, colour: string): void {
    this.line([from, to], colour, 4);
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const length = Math.hypot(dx, dy);
    this.pen.beginPath();
    for (let at = 0; at <= length; at += 14) {
      const [x, y] = [from[0] + dx * at / length, from[1] + dy * at / length];
      this.pen.moveTo(x, y);
      this.pen.lineTo(x + 10 * beyond[0] + 5 * dx / length, y + 10 * beyond[1] + 5 * dy / length);
    }
    this.pen.strokeStyle = colour;
    this.pen.lineWidth = 2;
    this.pen.stroke();
  }

  /// How long a metre is.
  scale(metres: Metres, colour: string, size_px = 15): void {
    const [x, y] = [12, this.height - 12];
    this.line([[x, y - 6], [x, y], [x + metres.per_m, y], [x + metres.per_m, y - 6]], colour, 2);
    this.words('1 m', [x + 5, y - 7], colour, size_px);
  }

  /// On its base line from there to the right, or to the left. `halo`: behind it, over lines.
  words(
    text: string, at: Vector2, colour: string, size_px: number, to: 'left' | 'right' = 'right',
    halo: string | null = null): void {
    this.pen.font = `600 ${size_px}px system-ui, sans-serif`;
    this.pen.textAlign = to === 'right' ? 'left' : 'right';
    if (halo !== null) {
      this.pen.strokeStyle = halo;
      this.pen.lineWidth = 4;
      this.pen.lineJoin = 'round';
      this.pen.strokeText(text, ...at);
    }
    this.pen.fillStyle = colour;
    this.pen.fillText(text, ...at);
  }

  private trace(points: readonly Vector2[]): void {
    this.pen.beginPath();
    points.forEach(([x, y], i) => (i === 0 ? this.pen.moveTo(x, y) : this.pen.lineTo(x, y)));
  }
}
