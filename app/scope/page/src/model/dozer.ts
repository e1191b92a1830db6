// SPDX-License-Identifier: Apache-2.0
/// Where body, blade and cylinders of a dozer are, from its measured pose and blade stroke. Ground
/// frame of api.ts; the machine drives in the plane y = 0.

import type {DozerMachine, Vector2} from './api';
import {add, clamp, direction, minus, norm, polar, rotated} from './geometry';

export interface DozerState {
  position_m: number;      ///< Along the grade, of the body frame's origin.
  height_m: number;        ///< Of it, above z = 0.
  pitch_rad: number;       ///< Nose up is positive.
  blade_stroke_m: number;  ///< From the raised blade; extension lowers it.
}

/// Points are x and z of the ground frame.
export interface DozerPose {
  body_m: Vector2;        ///< Origin of the body frame: the tracks' ground line.
  pitch_rad: number;
  blade_rad: number;      ///< theta_1: 0 with the edge at the ground line, rising with the blade.
  blade_direction_rad: number;  ///< Pivot to edge, against the ground frame's x.
  pivot_m: Vector2;
  foot_m: Vector2;        ///< Blade's foot.
  edge_m: Vector2;        ///< Cutting edge.
  cylinder_base_m: Vector2;
  cylinder_eye_m: Vector2;
}

/// What follows from a blade's pins alone.
export interface BladeLinkage {
  edge_home_rad: number;    ///< Direction of the edge from the pivot, at home.
  l11_m: number;            ///< Pivot to cylinder base.
  l12_m: number;            ///< Pivot to rod eye, on the line to the blade's foot.
  enclosed_home_rad: number;
  shortest_m: number;       ///< Cylinder with the blade fully raised.
  stroke_max_m: number;
}

const linkages = new WeakMap<DozerMachine, BladeLinkage>();

export function bladeLinkage(machine: DozerMachine): BladeLinkage {
  let linkage = linkages.get(machine);
  if (linkage === undefined) {
    linkage = solve_linkage(machine.blade);
    linkages.set(machine, linkage);
  }
  return linkage;
}

function solve_linkage(blade: DozerMachine['blade']): BladeLinkage {
  const to_base = minus(blade.base_m, blade.pivot_m);
  const l11 = norm(to_base);
  const enclosed_home = direction(to_base) - direction(blade.arm_m);
  const across = l11 * Math.sin(enclosed_home);
  // Law of cosines: the side that makes the cylinder as long at home as it is.
  const l12 = l11 * Math.cos(enclosed_home) + Math.sqrt(blade.length_home_m ** 2 - across ** 2);
  const edge_home = Math.asin(-blade.pivot_m[1] / blade.cutting_edge_m);
  const length_with_edge_at = (height_m: number): number => {
    const angle = Math.asin((height_m - blade.pivot_m[1]) / blade.cutting_edge_m) - edge_home;
    return cylinder_length(l11, l12, enclosed_home - angle);
  };
  const shortest = length_with_edge_at(blade.edge_max_m);
  return {
    edge_home_rad: edge_home, l11_m: l11, l12_m: l12, enclosed_home_rad: enclosed_home,
    shortest_m: shortest, stroke_max_m: length_with_edge_at(blade.edge_min_m) - shortest,
  };
}

const cylinder_length = (l11: number, l12: number, enclosed: number): number =>
  Math.sqrt(l11 ** 2 + l12 ** 2 - 2 * l11 * l12 * Math.cos(enclosed));

/// The edge from the pivot at home, axes of the body.
export const home_edge = (machine: DozerMachine): Vector2 =>
  polar(machine.blade.cutting_edge_m, bladeLinkage(machine).edge_home_rad);

/// theta_1 at a stroke; strokes outside the blade's reach are taken for its end.
export function bladeAngle(machine: DozerMachine, stroke_m: number): number {
  const {l11_m, l12_m, enclosed_home_rad, shortest_m, stroke_max_m} = bladeLinkage(machine);
  const length = shortest_m + clamp(stroke_m, 0, stroke_max_m);
  const cosine = (l11_m ** 2 + l12_m ** 2 - length ** 2) / (2 * l11_m * l12_m);
  return enclosed_home_rad - Math.acos(clamp(cosine, -1, 1));
}

/// Stroke at an angle, which is taken into the blade's reach.
export function bladeStroke(machine: DozerMachine, blade_rad: number): number {
  const {l11_m, l12_m, enclosed_home_rad, shortest_m, stroke_max_m} = bladeLinkage(machine);
  const length = cylinder_length(l11_m, l12_m, enclosed_home_rad - blade_rad);
  return clamp(length - shortest_m, 0, stroke_max_m);
}

/// Null where a number is none.
export function dozerPose(machine: DozerMachine, state: DozerState): DozerPose | null {
  const {position_m, height_m, pitch_rad, blade_stroke_m} = state;
  if (![position_m, height_m, pitch_rad, blade_stroke_m].every(Number.isFinite)) {
    return null;
  }
  return pose_at(machine, state, bladeAngle(machine, blade_stroke_m));
}

/// The same body with its edge on a height of the ground frame, as near as the blade gets there:
/// `height_at` is asked at the edge's own place, which moves as the blade turns.
export function dozerPoseWithEdgeOn(
  machine: DozerMachine, state: DozerState, height_at: (x_m: number) => number): DozerPose | null {
  if (!Object.values(state).every(Number.isFinite)) {
    return null;
  }
  let [low, high] = [
    bladeAngle(machine, bladeLinkage(machine).stroke_max_m), bladeAngle(machine, 0)];
  // The edge rises with the angle over the whole reach, and a design is far less steep than that.
  for (let i = 0; i < 40; ++i) {
    const middle = 0.5 * (low + high);
    const [x, z] = pose_at(machine, state, middle).edge_m;
    if (z < height_at(x)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return pose_at(machine, state, 0.5 * (low + high));
}

function pose_at(machine: DozerMachine, state: DozerState, blade_rad: number): DozerPose {
  const {blade} = machine;
  const {edge_home_rad, l12_m} = bladeLinkage(machine);
  const body: Vector2 = [state.position_m, state.height_m];
  const space = (point: Vector2): Vector2 => add(body, rotated(point, state.pitch_rad));
  const arm = rotated(blade.arm_m, blade_rad);
  return {
    body_m: body,
    pitch_rad: state.pitch_rad,
    blade_rad,
    blade_direction_rad: edge_home_rad + blade_rad + state.pitch_rad,
    pivot_m: space(blade.pivot_m),
    foot_m: space(add(blade.pivot_m, arm)),
    edge_m: space(add(blade.pivot_m, polar(blade.cutting_edge_m, edge_home_rad + blade_rad))),
    cylinder_base_m: space(blade.base_m),
    cylinder_eye_m: space(add(blade.pivot_m, polar(l12_m, direction(arm)))),
  };
}
