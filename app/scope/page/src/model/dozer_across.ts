// SPDX-License-Identifier: Apache-2.0
/// Across the track: the edge of a dozer whose blade tilts, from its measured pose and strokes, with
/// the heights of its ends over the design. Left end up is positive, of roll, tilt and slope alike.

import type {DozerMachine, Tilt, Vector2, Vector3} from './api';
import {bladeAngle, type DozerState, home_edge} from './dozer';
import {add, clamp, direction, minus, norm, rotated} from './geometry';
import {PlanTrack} from './plan_track';
import {designHeight} from './wanted';

export interface AcrossState extends DozerState {
  tilt_stroke_m: number;  ///< From where the cylinder is shortest.
  roll_rad: number;
  offset_m: number;       ///< Of the body's origin, left of a track that curves; else 0, as the next.
  heading_rad: number;    ///< Of the body against the track beside it, to the left positive.
}

export interface EdgePoint {
  at_m: Vector2;      ///< From behind: right of the body's origin, and height.
  place_m: Vector3;   ///< Along the track, left of it, height.
  off_m: number;      ///< Over the design, straight up; NaN beside the grade.
}

export interface DozerAcross {
  body_m: number;     ///< Height of the body's origin.
  offset_m: number;   ///< As AcrossState's, as the next two.
  heading_rad: number;
  roll_rad: number;
  tilt_rad: number;   ///< Of the blade against the body.
  left: EdgePoint;
  middle: EdgePoint;
  right: EdgePoint;
  /// Along the track and left of it, so far to the right of the body's origin along the edge.
  beside: (right_m: number) => Vector2;
}

interface TiltLinkage {
  base_m: number;        ///< From the axis, as the next.
  eye_m: number;
  enclosed_rad: number;  ///< From base to eye, level.
  shortest_m: number;
  stroke_max_m: number;
}

const linkages = new WeakMap<Tilt, TiltLinkage>();

function linkage_of(tilt: Tilt): TiltLinkage {
  let linkage = linkages.get(tilt);
  if (linkage === undefined) {
    const enclosed_rad = direction(rotated(tilt.eye_m, -direction(tilt.base_m)));
    const pins = {base_m: norm(tilt.base_m), eye_m: norm(tilt.eye_m), enclosed_rad};
    const [right, left] = [-1, 1].map((side) => length_at(pins, side * tilt.angle_most_rad)) as [number, number];
    linkage = {...pins, shortest_m: Math.min(right, left), stroke_max_m: Math.abs(left - right)};
    linkages.set(tilt, linkage);
  }
  return linkage;
}

type Pins = Pick<TiltLinkage, 'base_m' | 'eye_m' | 'enclosed_rad'>;

const length_at = ({base_m, eye_m, enclosed_rad}: Pins, tilt_rad: number): number =>
  Math.sqrt(base_m ** 2 + eye_m ** 2 - 2 * base_m * eye_m * Math.cos(enclosed_rad + tilt_rad));

/// Of the blade at this stroke; strokes out of the range are taken for its end.
export function tiltAngle(tilt: Tilt, stroke_m: number): number {
  const {base_m, eye_m, enclosed_rad, shortest_m, stroke_max_m} = linkage_of(tilt);
  const length = shortest_m + clamp(stroke_m, 0, stroke_max_m);
  const cosine = (base_m ** 2 + eye_m ** 2 - length ** 2) / (2 * base_m * eye_m);
  return Math.sign(enclosed_rad) * Math.acos(clamp(cosine, -1, 1)) - enclosed_rad;
}

const tracks = new WeakMap<DozerMachine, PlanTrack>();

function track_of(machine: DozerMachine): PlanTrack | null {
  if (machine.curvature === undefined) {
    return null;
  }
  const track = tracks.get(machine) ?? new PlanTrack(machine.curvature);
  tracks.set(machine, track);
  return track;
}

/// Null where a number is none, or where the blade does not tilt.
export function dozerAcross(machine: DozerMachine, state: AcrossState): DozerAcross | null {
  const {tilt} = machine;
  if (tilt === undefined || !Object.values(state).every(Number.isFinite)) {
    return null;
  }
  const blade_rad = bladeAngle(machine, state.blade_stroke_m);
  const tilt_rad = tiltAngle(tilt, state.tilt_stroke_m);
  const track = track_of(machine);
  const place = (ahead_m: number, left_m: number): Vector2 => (track === null ?
    [state.position_m + ahead_m, left_m] :
    track.place_of([state.position_m, state.offset_m], state.heading_rad, [ahead_m, left_m]));
  const point = (along_m: number): {ahead_m: number} & Omit<EdgePoint, 'off_m'> => {
    const [ahead_m, left_m, up_m] = from_origin(machine, state, blade_rad, tilt_rad, along_m);
    const height_m = state.height_m + up_m;
    return {ahead_m, at_m: [-left_m, height_m], place_m: [...place(ahead_m, left_m), height_m]};
  };
  const half = 0.5 * tilt.edge_width_m;
  const [left, middle, right] = [point(half), point(0), point(-half)];
  const beside_grade = middle.place_m[0] < 0 || middle.place_m[0] > machine.length_m;
  const judged = ({at_m, place_m}: Omit<EdgePoint, 'off_m'>): EdgePoint =>
    ({at_m, place_m, off_m: beside_grade ? NaN : off_design(machine, place_m)});
  return {
    body_m: state.height_m, offset_m: state.offset_m, heading_rad: state.heading_rad,
    roll_rad: state.roll_rad, tilt_rad,
    left: judged(left), middle: judged(middle), right: judged(right),
    // Its ends lie askew to the body by no more than a tilt's cosine: as if straight across.
    beside: (right_m) => place(middle.ahead_m, -right_m),
  };
}

/// A point of the edge, so far to the left of its middle, from the body's origin: ahead, left, up.
/// The body is pitched, and rolled about its own longitudinal axis; the blade is tilted, then lifted.
function from_origin(
  machine: DozerMachine, {pitch_rad, roll_rad}: AcrossState, blade_rad: number, tilt_rad: number,
  along_m: number): Vector3 {
  const edge = add(machine.blade.pivot_m, rotated(home_edge(machine), blade_rad));
  const [x, z] = add(edge, rotated([0, along_m * Math.sin(tilt_rad)], blade_rad));
  const [y, up] = rotated([along_m * Math.cos(tilt_rad), z], roll_rad);
  const [ahead, height] = rotated([x, up], pitch_rad);
  return [ahead, y, height];
}

/// Straight up.
function off_design({design, cross = []}: DozerMachine, [x, y, z]: Vector3): number {
  return z - designHeight(design, x) - (cross.length > 0 ? designHeight(cross, x) * y : 0);
}

/// The design under the edge's line, continued so far beyond its ends: two places in the picture.
export function design_line({left, right}: DozerAcross, beyond_m: number): readonly [Vector2, Vector2] {
  const under = ({at_m, off_m}: EdgePoint): Vector2 => [at_m[0], at_m[1] - off_m];
  const [from, to] = [under(left), under(right)];
  const [dx, dz] = minus(to, from);
  const more = beyond_m / dx;
  return [[from[0] - beyond_m, from[1] - more * dz], [to[0] + beyond_m, to[1] + more * dz]];
}

/// dz over dy of a line from behind, left up positive.
export const slope_of = ([left, right]: readonly [Vector2, Vector2]): number =>
  (left[1] - right[1]) / (right[0] - left[0]);
