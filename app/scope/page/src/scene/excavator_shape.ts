// SPDX-License-Identifier: Apache-2.0
/// The shapes of an excavator's parts, all from the numbers of its profile. What a profile does not
/// tell (widths, tracks, platform) is taken as the share of the boom's length or of the boom foot's
/// height that machines of 12 and 22 t have in their makers' sheets.

import type {ExcavatorMachine, Vector2} from '../model/api';
import {add, polar} from '../model/geometry';
import {beam, bent_line, hull_of_discs} from './outline';
import {box, cab, pair, type Piece, pin, rectangle, side, sized, top} from './pieces';
import {tracks} from './tracks';

export interface ExcavatorShape {
  undercarriage: Piece[];  ///< Ground frame.
  platform: Piece[];       ///< Ground frame at swing 0; turns about z.
  boom: Piece[];           ///< Frame of the link, as are arm and bucket: x from pin to pin.
  arm: Piece[];
  bucket: Piece[];
  rocker: Piece[];         ///< x from its pivot to its end.
  coupler: Piece[];        ///< x from the rocker's end to the lug.
  widths: ExcavatorWidths;
}

/// Across, m.
export interface ExcavatorWidths {
  boom_m: number;
  arm_m: number;
  bucket_m: number;
  boom_cylinder_y_m: number;  ///< Of a pair, to either side of the boom.
}

/// The tube round a bore.
export const barrel_radius = (bore_m: number): number => 0.5 * bore_m + 0.02;

export function excavator_widths(machine: ExcavatorMachine): ExcavatorWidths {
  const boom = 0.085 * machine.boom_m;
  return {
    boom_m: boom,
    arm_m: 0.068 * machine.boom_m,
    bucket_m: machine.bucket_width_m ?? 0.8 * machine.bucket_m,
    boom_cylinder_y_m: 0.5 * boom + barrel_radius(machine.cylinders.boom.bore_m) + 0.03,
  };
}

export function excavator_shape(machine: ExcavatorMachine): ExcavatorShape {
  const widths = excavator_widths(machine);
  return {
    undercarriage: undercarriage(machine),
    platform: platform(machine, widths),
    boom: boom(machine, widths),
    arm: arm(machine, widths),
    bucket: bucket(machine, widths),
    rocker: rocker(machine, widths),
    coupler: coupler(machine, widths),
    widths,
  };
}

/// Underside of the platform.
const deck_m = (machine: ExcavatorMachine): number => 0.6 * machine.boom_foot_m[1];

function undercarriage(machine: ExcavatorMachine): Piece[] {
  const size = machine.boom_m;
  const height = 0.52 * machine.boom_foot_m[1];
  const half_gauge = 0.21 * size;
  return [
    ...tracks({
      contact_m: 0.6 * size, height_m: height, overhang_m: 0.02 * size,
      shoe_m: 0.105 * size, half_gauge_m: half_gauge}),
    box('frame', [-0.16 * size, 0.16 * size], [-half_gauge, half_gauge],
      [0.34 * height, 0.8 * height]),
    top('frame', hull_of_discs([{at_m: [0, 0], radius_m: 0.115 * size}]), 0.7 * height,
      deck_m(machine)),
  ];
}

function platform(machine: ExcavatorMachine, widths: ExcavatorWidths): Piece[] {
  const size = machine.boom_m;
  const high = machine.boom_foot_m[1];
  const floor = deck_m(machine);
  const deck = floor + 0.09 * high;
  const half = 0.245 * size;
  const front = 0.235 * size;
  const notch = widths.boom_cylinder_y_m + barrel_radius(machine.cylinders.boom.bore_m) + 0.04;
  const hood = deck + 0.46 * high;
  return [
    top('frame', deck_outline(machine, half, front, notch), floor, deck),
    ...counterweight(size, half, floor + 0.02 * high, hood - 0.05 * high),
    box('body', [-0.37 * size, -0.06 * size], [-half, half], [deck, hood]),
    box('frame', [-0.3 * size, -0.14 * size], [-0.5 * half, 0.75 * half], [hood, hood + 0.03]),
    box('body', [-0.06 * size, 0.13 * size], [-half, -notch], [deck, deck + 0.36 * high]),
    box('frame', [0.13 * size, 0.2 * size], [-half, -notch], [deck, deck + 0.16 * high]),
    ...cab([front - Math.min(1.75, 0.3 * size), front], [notch, half], deck),
    ...foot(machine, widths),
  ];
}

/// From above, open in front of the boom cylinders' pins.
function deck_outline(
  machine: ExcavatorMachine, half: number, front: number, notch: number): Vector2[] {
  const rear = -0.38 * machine.boom_m;
  const inner = machine.boom_foot_m[0] + 0.4 * machine.cylinders.boom.base_m[0];
  return [
    [rear, -half], [front, -half], [front, -notch], [inner, -notch], [inner, notch],
    [front, notch], [front, half], [rear, half]];
}

function counterweight(size: number, half: number, floor: number, roof: number): Piece[] {
  const radius = 0.49 * size;
  const widest = Math.asin(half / radius);
  const back: Vector2[] = [];
  for (let i = 0; i <= 10; ++i) {
    back.push(polar(radius, Math.PI - widest + 2 * widest * i / 10));
  }
  return [top('weight', [...back, [-0.36 * size, -half], [-0.36 * size, half]], floor, roof)];
}

/// Brackets of boom and boom cylinders.
function foot(machine: ExcavatorMachine, widths: ExcavatorWidths): Piece[] {
  const size = machine.boom_m;
  const at = machine.boom_foot_m;
  const base = add(at, machine.cylinders.boom.base_m);
  const bracket = hull_of_discs([
    {at_m: at, radius_m: 0.03 * size}, {at_m: base, radius_m: 0.022 * size},
    {at_m: [at[0] - 0.09 * size, base[1]], radius_m: 0.022 * size}]);
  const inner = 0.5 * widths.boom_m + 0.005;
  return [
    ...pair('frame', bracket, inner, inner + 0.025),
    pin(at, 0.016 * size, inner + 0.05),
    pin(base, 0.012 * size, widths.boom_cylinder_y_m + 0.06),
  ];
}

function boom(machine: ExcavatorMachine, widths: ExcavatorWidths): Piece[] {
  const size = machine.boom_m;
  const {boom: lift, arm: crowd} = machine.cylinders;
  // The knee where the boom cylinders push, a little above the middle of the box.
  const line = bent_line([0, 0], lift.eye_m, [size, 0], 0.36, 8);
  const last = line.length - 1;
  const half = line.map((_, i) => size * thickness(i / last));
  const near = line.reduce((best, point) =>
    Math.abs(point[0] - crowd.base_m[0]) < Math.abs(best[0] - crowd.base_m[0]) ? point : best);
  const lug = hull_of_discs([
    {at_m: crowd.base_m, radius_m: 0.02 * size},
    {at_m: add(near, [-0.045 * size, 0.03 * size]), radius_m: 0.015 * size},
    {at_m: add(near, [0.06 * size, 0]), radius_m: 0.015 * size}]);
  const box_half = 0.5 * widths.boom_m;
  return [
    side('body', beam(line, half), -box_half, box_half),
    ...pair('body', lug, 0.35 * box_half, 0.6 * box_half),
    pin(crowd.base_m, 0.012 * size, 0.7 * box_half),
    pin(lift.eye_m, 0.012 * size, widths.boom_cylinder_y_m + 0.06),
    pin([size, 0], 0.015 * size, box_half + 0.03),
  ];
}

/// Half thickness of the boom over its length, as shares of it.
function thickness(along: number): number {
  const [foot_share, knee_share, tip_share] = [0.03, 0.058, 0.026];
  const rise = Math.sin(Math.PI * Math.min(1, Math.max(0, along)));
  return foot_share + (tip_share - foot_share) * along + (knee_share - foot_share) * rise;
}

function arm(machine: ExcavatorMachine, widths: ExcavatorWidths): Piece[] {
  const size = machine.arm_m;
  const {arm: crowd, bucket: curl} = machine.cylinders;
  const half = 0.5 * widths.arm_m;
  const outline = hull_of_discs([
    {at_m: crowd.eye_m, radius_m: 0.045 * size}, {at_m: [0, 0], radius_m: 0.075 * size},
    {at_m: [0.1 * size, 0.05 * size], radius_m: 0.085 * size},
    {at_m: [size, 0], radius_m: 0.04 * size}]);
  const lug = hull_of_discs([
    {at_m: curl.base_m, radius_m: 0.035 * size}, {at_m: [0, 0.1 * size], radius_m: 0.02 * size},
    {at_m: [0.24 * size, 0.08 * size], radius_m: 0.02 * size}]);
  return [
    side('body', outline, -half, half),
    ...pair('body', lug, 0.4 * half, 0.65 * half),
    pin(crowd.eye_m, 0.025 * size, half + 0.03),
    pin(curl.base_m, 0.02 * size, 0.75 * half),
    pin(machine.linkage.rocker_pivot_m, 0.02 * size, half + 0.06),
    pin([size, 0], 0.024 * size, half + 0.1),
  ];
}

/// Shell of a bucket over its length, seen from the side: from the back of its mouth round to the
/// lip. The pins stand outside on ears.
const kShell: readonly Vector2[] = [
  [0.13, -0.03], [0.115, 0.15], [0.12, 0.33], [0.17, 0.45], [0.27, 0.53], [0.4, 0.555],
  [0.54, 0.515], [0.67, 0.41], [0.8, 0.25], [0.93, 0.045]];

/// In the bucket's frame.
export const bucket_shell = (machine: ExcavatorMachine): Vector2[] =>
  sized(kShell, machine.bucket_m, [0, 0]);

/// Loose soil that it holds, heaped; what buckets of its size do unless the profile says.
export const bucket_capacity_m3 = (machine: ExcavatorMachine, widths: ExcavatorWidths): number =>
  machine.bucket_capacity_m3 ?? 0.3 * widths.bucket_m * machine.bucket_m ** 2;

function bucket(machine: ExcavatorMachine, widths: ExcavatorWidths): Piece[] {
  const size = machine.bucket_m;
  const {lug_m} = machine.linkage;
  const half = 0.5 * widths.bucket_m;
  const shell = bucket_shell(machine);
  const ear = hull_of_discs([
    {at_m: [0, 0], radius_m: 0.06 * size}, {at_m: lug_m, radius_m: 0.055 * size},
    {at_m: [0.13 * size, 0.04 * size], radius_m: 0.03 * size},
    {at_m: [0.14 * size, Math.min(lug_m[1] + 0.04 * size, 0.38 * size)],
      radius_m: 0.03 * size}]);
  const ear_inner = 0.5 * widths.arm_m + 0.03;
  return [
    side('body', beam(shell, shell.map(() => 0.014 * size)), -half, half),
    ...pair('body', shell, half - 0.018 * size, half + 0.002 * size),
    ...pair('body', ear, ear_inner, ear_inner + 0.03),
    ...teeth(size, widths.bucket_m),
    pin([0, 0], 0.03 * size, ear_inner + 0.06),
    pin(lug_m, 0.03 * size, ear_inner + 0.06),
  ];
}

const kTooth: readonly Vector2[] = [
  [0.86, 0.1], [0.88, 0.02], [1, 0], [0.94, 0.075], [0.87, 0.15]];

function teeth(size: number, width: number): Piece[] {
  const tooth = sized(kTooth, size, [0, 0]);
  const count = 5;
  const wide = 0.5 * width / count;
  return Array.from({length: count}, (_, i) => {
    const middle = (i / (count - 1) - 0.5) * (width - wide);
    return side('steel', tooth, middle - 0.5 * wide, middle + 0.5 * wide);
  });
}

function rocker(machine: ExcavatorMachine, widths: ExcavatorWidths): Piece[] {
  const {rocker_m} = machine.linkage;
  const radius = 0.022 * machine.arm_m;
  const inner = 0.5 * widths.arm_m + 0.012;
  const bar = hull_of_discs([
    {at_m: [0, 0], radius_m: radius}, {at_m: [rocker_m, 0], radius_m: radius}]);
  return [
    ...pair('body', bar, inner, inner + 0.03),
    pin([rocker_m, 0], 0.6 * radius, inner + 0.05),
  ];
}

function coupler(machine: ExcavatorMachine, widths: ExcavatorWidths): Piece[] {
  const {coupler_m} = machine.linkage;
  const radius = 0.024 * machine.arm_m;
  const bar = hull_of_discs([
    {at_m: [0, 0], radius_m: radius}, {at_m: [coupler_m, 0], radius_m: radius}]);
  const inner = 0.3 * widths.arm_m;
  return [
    ...pair('frame', bar, inner, 0.47 * widths.arm_m),
    side('frame', rectangle([0.3 * coupler_m, 0.7 * coupler_m], [-0.6 * radius, 0.6 * radius]),
      -inner, inner),
  ];
}
