// SPDX-License-Identifier: Apache-2.0
/// What a machine's parts are made of: outlines with a thickness. Nothing here knows how it is
/// drawn.

import type {Vector2} from '../model/api';
import {add} from '../model/geometry';
import {type Disc, hull_of_discs} from './outline';

export type Paint = 'body' | 'frame' | 'steel' | 'glass' | 'belt' | 'weight' | 'soil';

/// 'side': outline over x and z, reaching from `from_m` to `to_m` along y. 'top': outline over x
/// and y, reaching so along z. Frame of the part.
export interface Piece {
  seen: 'side' | 'top';
  outline: readonly Vector2[];
  hole?: readonly Vector2[];
  from_m: number;
  to_m: number;
  paint: Paint;
}

export const side = (
  paint: Paint, outline: readonly Vector2[], from_m: number, to_m: number): Piece =>
  ({seen: 'side', outline, from_m, to_m, paint});

export const top = (
  paint: Paint, outline: readonly Vector2[], from_m: number, to_m: number): Piece =>
  ({seen: 'top', outline, from_m, to_m, paint});

/// The same piece on both sides of the middle.
export const pair = (
  paint: Paint, outline: readonly Vector2[], inner_m: number, outer_m: number): Piece[] =>
  [side(paint, outline, inner_m, outer_m), side(paint, outline, -outer_m, -inner_m)];

/// A round pin across the middle.
export const pin = (at_m: Vector2, radius_m: number, half_width_m: number): Piece =>
  side('steel', hull_of_discs([{at_m, radius_m}], 14), -half_width_m, half_width_m);

export const plate = (paint: Paint, discs: readonly Disc[], half_width_m: number): Piece =>
  side(paint, hull_of_discs(discs), -half_width_m, half_width_m);

export const box = (
  paint: Paint, x: Vector2, y: Vector2, z: Vector2): Piece =>
  side(paint, rectangle(x, z), y[0], y[1]);

export const rectangle = (x: Vector2, y: Vector2): Vector2[] =>
  [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];

/// A unit outline made as large as the part is.
export const sized = (outline: readonly Vector2[], size_m: number, at_m: Vector2): Vector2[] =>
  outline.map((point) => add([point[0] * size_m, point[1] * size_m], at_m));

/// A cab for a person, who is as tall in a small machine as in a large one.
export function cab(x: Vector2, y: Vector2, floor_m: number): Piece[] {
  const [back, front] = x;
  const sill = floor_m + 0.72;
  const roof = floor_m + 1.68;
  const lean = 0.16 * (front - back);
  const frame = (from: number, to: number, tilt: number): Vector2[] =>
    [[from, sill - 0.01], [to, sill - 0.01], [to - tilt, roof], [from - tilt, roof]];
  const glass: Vector2[] = [
    [back + 0.03, sill], [front - 0.03, sill], [front - 0.03 - lean, roof], [back + 0.03, roof]];
  const pillars = [
    frame(back, back + 0.13, 0),
    frame(back + 0.48 * (front - back), back + 0.48 * (front - back) + 0.07, 0),
    frame(front - 0.08, front, lean)];
  return [
    box('body', x, y, [floor_m, sill]),
    side('glass', glass, y[0] + 0.03, y[1] - 0.03),
    ...pillars.flatMap((outline) => [
      side('body', outline, y[0], y[0] + 0.06), side('body', outline, y[1] - 0.06, y[1])]),
    box('body', [back - 0.03, front - lean + 0.05], [y[0] - 0.02, y[1] + 0.02],
      [roof, roof + 0.09]),
  ];
}
