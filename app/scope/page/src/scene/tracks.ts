// SPDX-License-Identifier: Apache-2.0
/// Tracks of both machines: a belt of shoes around wheels.

import type {Vector2} from '../model/api';
import {add, scaled} from '../model/geometry';
import {type Disc, evenly_along, hull_of_discs} from './outline';
import {type Piece, plate, side} from './pieces';

export interface TrackSize {
  contact_m: number;     ///< First to last wheel, on the ground; the middle at x = 0.
  height_m: number;
  overhang_m: number;    ///< From the last wheel to the middle of sprocket or idler.
  shoe_m: number;        ///< Width of the belt.
  half_gauge_m: number;  ///< Middle of the machine to the middle of a belt.
}

/// Least length of a shoe along the belt: more of them are no better to be seen.
const kShoes = 44;

/// Pieces of both sides. The belt's lowest point is at z = 0.
export function tracks(size: TrackSize): Piece[] {
  const belt = 0.07 * size.height_m;
  const outside = band(size, 0);
  const inside = band(size, belt);
  const shoes = evenly_along(outside, 2 * kShoes);
  const middle: Vector2 = [0, 0.5 * size.height_m];
  // Every other corner stands back: so the shoes show at the belt's outline.
  const cleats = shoes.map((point, i) => Math.floor(i / 2) % 2 === 0 ?
    point : add(middle, scaled(add(point, scaled(middle, -1)), 0.985)));
  return [-1, 1].flatMap((sign) => one_side(size, sign * size.half_gauge_m, cleats, inside));
}

function one_side(
  size: TrackSize, y_m: number, cleats: Vector2[], inside: Vector2[]): Piece[] {
  const half = 0.5 * size.shoe_m;
  const moved = (piece: Piece): Piece =>
    ({...piece, from_m: piece.from_m + y_m, to_m: piece.to_m + y_m});
  const wheel = 0.5 * size.height_m;
  const end = 0.5 * size.contact_m + size.overhang_m;
  const frame: Disc[] = [-1, 1].map((sign) =>
    ({at_m: [sign * 0.42 * size.contact_m, 0.5 * size.height_m],
      radius_m: 0.22 * size.height_m}));
  const rollers = Array.from({length: 6}, (_, i): Piece => plate('frame', [{
    at_m: [(i / 5 - 0.5) * size.contact_m, 0.19 * size.height_m],
    radius_m: 0.115 * size.height_m}], 0.62 * half));
  const ends = [-1, 1].flatMap((sign): Piece[] => [
    plate('frame', [{at_m: [sign * end, wheel], radius_m: 0.41 * size.height_m}], 0.5 * half),
    plate('steel', [{at_m: [sign * end, wheel], radius_m: 0.17 * size.height_m}], 0.8 * half)]);
  return [
    {...side('belt', cleats, -half, half), hole: inside},
    plate('frame', frame, 0.75 * half), ...rollers, ...ends,
  ].map(moved);
}

/// The belt's outer side, or what is `inset_m` within.
function band(size: TrackSize, inset_m: number): Vector2[] {
  const wheel = 0.5 * size.height_m;
  const end = 0.5 * size.contact_m + size.overhang_m;
  const roller = 0.3 * size.height_m;
  // Sprocket and idler stand a little off the ground, so that the belt bears on the rollers alone.
  const lift = 0.04 * size.height_m;
  return hull_of_discs([-1, 1].flatMap((sign): Disc[] => [
    {at_m: [sign * end, wheel + 0.5 * lift], radius_m: wheel - 0.5 * lift - inset_m},
    {at_m: [sign * 0.5 * size.contact_m, roller], radius_m: roller - inset_m}]), 24);
}
