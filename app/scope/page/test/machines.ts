// SPDX-License-Identifier: Apache-2.0
/// The shipped machines as the setup would have them, from app/machines/*.toml. What matters of
/// them is compared with the program that reads those files.

import type {DozerMachine, ExcavatorMachine, Vector3} from '../src/model/api';

const cylinder = (
  count: number, bore_m: number, rod_m: number, closed_length_m: number, stroke_m: number,
  base_m: [number, number], eye_m: [number, number],
) => ({count, bore_m, rod_m, closed_length_m, stroke_m, base_m, eye_m});

export const EXCAVATOR_22T: ExcavatorMachine = {
  kind: 'excavator', name: 'excavator_22t', hash: 0,
  boom_m: 5.7, arm_m: 2.9, bucket_m: 1.5, boom_foot_m: [0.1, 1.75],
  cylinders: {
    boom: cylinder(2, 0.12, 0.085, 1.76, 1.26, [0.46, -0.63], [2.33, 0.85]),
    arm: cylinder(1, 0.14, 0.1, 1.795, 1.504, [3.35, 1.02], [-0.8, 0.28]),
    bucket: cylinder(1, 0.12, 0.085, 1.622, 1.104, [0.42, 0.72], [0, 0]),
  },
  linkage: {rocker_pivot_m: [2.48, 0.02], rocker_m: 0.64, coupler_m: 0.6, lug_m: [-0.06, 0.47]},
  has_swing: false, pumps: 2, relief_pa: 35e6,
  dig: {path: dig_path(), speed_mps: 0.6, field: [], ground_z_m: 0.75},
  tasks: [],
};

const BOOM_EYE = 0.492322;
const BOOM_BASE = 0.780407;

export const EXCAVATOR_12T: ExcavatorMachine = {
  kind: 'excavator', name: 'excavator_12t', hash: 0,
  boom_m: 4.6, arm_m: 2.52, bucket_m: 1.23, boom_foot_m: [0.14, 1.424],
  cylinders: {
    boom: cylinder(2, 0.105, 0.07, 1.45, 0.95,
      [0.56 * Math.cos(BOOM_BASE), -0.56 * Math.sin(BOOM_BASE)],
      [1.922 * Math.cos(BOOM_EYE), 1.922 * Math.sin(BOOM_EYE)]),
    arm: cylinder(1, 0.116, 0.08, 1.56, 1.13, [2.631, 0.842], [-0.628, 0.185]),
    bucket: cylinder(1, 0.1, 0.07, 1.2795, 0.875, [0.487, 0.537], [0, 0]),
  },
  linkage: {
    rocker_pivot_m: [2.1568, 0.019], rocker_m: 0.491, coupler_m: 0.502, lug_m: [-0.076, 0.375]},
  has_swing: true, pumps: 1, relief_pa: 35e6,
  dig: {path: [], speed_mps: 0, field: [], ground_z_m: 0},
  tasks: [],
};

export const DOZER_9T: DozerMachine = {
  kind: 'dozer', name: 'dozer_9t', hash: 0,
  blade: {
    pivot_m: [0.6718, 0.386], arm_m: [1.5881, -0.1037], cutting_edge_m: 1.6,
    base_m: [0.544, 0.904], length_home_m: 1.007, edge_min_m: -0.38, edge_max_m: 0.8,
    cylinders: 2, bore_m: 0.11, rod_m: 0.06,
  },
  track_contact_m: 2.4, half_gauge_m: 0.9, mass_centre_height_m: 0.85,
  design: [[0, 0], [4, 0], [5, -0.35], [9, -0.35], [9.8, -0.12], [13, -0.12], [13.8, -0.35],
    [18, -0.35], [20, 0], [27, 0]],
  length_m: 27,
};

/// Rounded rectangle, clockwise from the upper end of the far side; attitude linear in x.
function dig_path(): Vector3[] {
  const [left, right, bottom, top, radius] = [3.5, 6.5, -2.2, 0.2, 0.5];
  const points: Vector3[] = [];
  const add = (x: number, y: number): void => {
    const attitude = 0.785398 + (x - left) / (right - left) * (2.094395 - 0.785398);
    points.push([x + 0.1, y + 1.75, attitude]);
  };
  const corner = (x: number, y: number, from_deg: number): void => {
    for (let deg = from_deg; deg >= from_deg - 90; --deg) {
      const rad = deg * Math.PI / 180;
      add(x + radius * Math.cos(rad), y + radius * Math.sin(rad));
    }
  };
  corner(right - radius, bottom + radius, 0);
  corner(left + radius, bottom + radius, -90);
  corner(left + radius, top - radius, -180);
  corner(right - radius, top - radius, -270);
  points.push(points[0]);
  return points;
}
