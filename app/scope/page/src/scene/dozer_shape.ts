// SPDX-License-Identifier: Apache-2.0
/// The shapes of a dozer's parts, all from the numbers of its profile; what it does not tell as
/// shares of gauge, contact and cutting edge that a small dozer has in its maker's sheet.

import type {DozerMachine, Vector2} from '../model/api';
import {add, direction, minus, norm, polar} from '../model/geometry';
import {beam, hull_of_discs} from './outline';
import {box, cab, pair, type Piece, pin, plate, side, sized, top} from './pieces';
import {tracks} from './tracks';

export interface DozerShape {
  body: Piece[];     ///< Body frame.
  blade: Piece[];    ///< Turns about the pivot, which is its origin; axes of the body at home.
  blade_width_m: number;
  cylinder_y_m: number;  ///< To either side of the middle.
}

const shoe_m = (machine: DozerMachine): number => 0.45 * machine.half_gauge_m;

/// A blade cuts as wide as its machine and a little more: the tracks go where it has cut.
export const blade_width = (machine: DozerMachine): number =>
  machine.tilt?.edge_width_m ??
  2 * machine.half_gauge_m + shoe_m(machine) + 0.25 * machine.half_gauge_m;

export function dozer_shape(machine: DozerMachine): DozerShape {
  const cylinder_y = 0.55 * machine.half_gauge_m;
  return {
    body: [...running_gear(machine), ...house(machine, cylinder_y)],
    blade: blade(machine, cylinder_y),
    blade_width_m: blade_width(machine),
    cylinder_y_m: cylinder_y,
  };
}

const track_height_m = (machine: DozerMachine): number => 0.34 * machine.track_contact_m;

function running_gear(machine: DozerMachine): Piece[] {
  const contact = machine.track_contact_m;
  const height = track_height_m(machine);
  const inside = machine.half_gauge_m - 0.5 * shoe_m(machine);
  return [
    ...tracks({
      contact_m: contact, height_m: height, overhang_m: 0.03 * contact,
      shoe_m: shoe_m(machine), half_gauge_m: machine.half_gauge_m}),
    box('frame', [-0.5 * contact, 0.42 * contact], [-0.62 * inside, 0.62 * inside],
      [0.3 * height, 1.05 * height]),
    box('frame', [-0.12 * contact, -0.02 * contact],
      [-machine.half_gauge_m, machine.half_gauge_m], [0.4 * height, 0.7 * height]),
  ];
}

function house(machine: DozerMachine, cylinder_y: number): Piece[] {
  const contact = machine.track_contact_m;
  const half = machine.half_gauge_m;
  const deck = 1.08 * track_height_m(machine);
  const hood = deck + 0.8 * machine.mass_centre_height_m;
  const narrow = cylinder_y - 0.5 * machine.blade.bore_m - 0.06;
  const nose = 0.5 * contact;
  const hood_side: Vector2[] = [
    [-0.06 * contact, deck - 0.1], [nose, deck - 0.25], [nose + 0.03, hood - 0.14],
    [nose - 0.04, hood - 0.08], [-0.06 * contact, hood]];
  const fender = 0.92 * half;
  return [
    side('body', hood_side, -narrow, narrow),
    box('frame', [nose, nose + 0.05], [-0.85 * narrow, 0.85 * narrow], [deck - 0.2, hood - 0.22]),
    box('body', [-0.56 * contact, -0.02 * contact], [-fender, fender], [deck - 0.02, deck + 0.1]),
    box('weight', [-0.56 * contact, -0.4 * contact], [-fender, fender], [deck, hood - 0.1]),
    ...cab([-0.4 * contact, -0.02 * contact], [-0.74 * half, 0.74 * half], deck + 0.02),
    top('steel', hull_of_discs([{at_m: [0.22 * contact, 0.4 * narrow], radius_m: 0.05}], 12),
      hood - 0.1, hood + 0.55),
    ...cylinder_brackets(machine, cylinder_y, narrow),
  ];
}

/// What holds the cylinders to the hood and the arms to the frame.
function cylinder_brackets(machine: DozerMachine, cylinder_y: number, narrow: number): Piece[] {
  const {base_m, pivot_m} = machine.blade;
  const ear = hull_of_discs([
    {at_m: base_m, radius_m: 0.09}, {at_m: add(base_m, [-0.1, -0.12]), radius_m: 0.09}]);
  return [
    ...pair('frame', ear, narrow, cylinder_y - 0.03),
    pin(base_m, 0.045, cylinder_y + 0.05),
    pin(pivot_m, 0.06, cylinder_y + 0.1),
  ];
}

/// Front of the mouldboard from the edge up, over its height.
const kMouldboard: readonly Vector2[] = [
  [0, 0], [-0.06, 0.12], [-0.105, 0.28], [-0.12, 0.45], [-0.11, 0.62], [-0.07, 0.8], [0, 0.97]];

const kFootRadius_m = 0.11;

function blade(machine: DozerMachine, cylinder_y: number): Piece[] {
  const {cutting_edge_m, pivot_m, arm_m} = machine.blade;
  const edge_home = Math.asin(-pivot_m[1] / cutting_edge_m);
  const edge = polar(cutting_edge_m, edge_home);
  const height = 0.56 * cutting_edge_m;
  const half = 0.5 * blade_width(machine);
  // Its front face passes through the edge.
  const thick = 0.03 * height;
  const board = sized(kMouldboard, height, add(edge, [-thick, thick]));
  const back = edge[0] - 0.13 * height - 2 * thick;
  const foot = polar(
    Math.min(norm(arm_m), back / Math.cos(direction(arm_m))) - kFootRadius_m, direction(arm_m));
  const end = hull_of_discs(board.map((at_m) => ({at_m, radius_m: thick})), 8);
  return [
    side('body', beam(board, board.map(() => thick)), -half, half),
    side('steel', cutting_edge(edge, height), -half, half),
    ...pair('body', end, half - 0.03, half),
    side('body', hull_of_discs([
      {at_m: [back, edge[1] + 0.24 * height], radius_m: 0.13 * height},
      {at_m: [back + 0.02 * height, edge[1] + 0.68 * height], radius_m: 0.07 * height}]),
    -0.9 * half, 0.9 * half),
    ...arms(cylinder_y, foot),
  ];
}

/// A blade bolted under the mouldboard, its lower corner where the profile has the edge.
const cutting_edge = (edge: Vector2, height: number): Vector2[] => [
  edge, add(edge, [-0.03 * height, 0.17 * height]), add(edge, [-0.075 * height, 0.17 * height]),
  add(edge, [-0.035 * height, 0]),
].reverse() as Vector2[];

function arms(cylinder_y: number, foot: Vector2): Piece[] {
  const eye = polar(0.5 * norm(foot), direction(foot));
  const bar = hull_of_discs([
    {at_m: [0, 0], radius_m: 0.09}, {at_m: eye, radius_m: 0.1},
    {at_m: foot, radius_m: kFootRadius_m}]);
  const cross = minus(foot, polar(0.12, direction(foot)));
  return [
    ...pair('frame', bar, cylinder_y - 0.07, cylinder_y + 0.07),
    plate('frame', [{at_m: cross, radius_m: 0.1}], cylinder_y),
  ];
}
