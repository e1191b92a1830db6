// SPDX-License-Identifier: Apache-2.0
/// The excavator as nodes: each link hangs on the one before it, as the pins have it.

import {Group, Matrix4, type Object3D, Object3D as Node, Vector3} from 'three';
import type {Cylinder as CylinderData, ExcavatorMachine, Vector2} from '../model/api';
import {direction, minus, rotated} from '../model/geometry';
import type {ExcavatorPose} from '../model/excavator';
import {BucketFill} from './bucket_fill';
import {Cylinder} from './cylinder';
import {bucket_shell, excavator_shape, type ExcavatorShape} from './excavator_shape';
import type {ExcavatorState} from './machine_state';
import type {SharedMaterials} from './materials';
import {GhostPart, Part, part_geometry, type PartGeometry} from './part';
import type {SceneColours} from './theme';

type LinkName = 'platform' | 'boom' | 'arm' | 'bucket' | 'rocker' | 'coupler';
const kLinks: readonly LinkName[] = ['platform', 'boom', 'arm', 'bucket', 'rocker', 'coupler'];

type Links = Record<LinkName, Object3D>;
type Geometries = Record<LinkName | 'undercarriage', PartGeometry>;

/// A link's frame in its parent's: x along it, turned in the plane that the swing faces.
function place(node: Object3D, at_m: Vector2, turn_rad: number): void {
  node.matrix.makeRotationY(-turn_rad).setPosition(at_m[0], 0, at_m[1]);
  node.matrixWorldNeedsUpdate = true;
}

/// Pins are of the pose's space; links and cylinders stand in the plane that turns with the swing.
const in_plane = (point: readonly number[], swing_rad: number): Vector2 =>
  [point[0] * Math.cos(swing_rad) + point[1] * Math.sin(swing_rad), point[2]];

function chain(links: Links): void {
  links.platform.add(links.boom);
  links.boom.add(links.arm);
  links.arm.add(links.bucket, links.rocker, links.coupler);
}

function pose_links(links: Links, machine: ExcavatorMachine, pose: ExcavatorPose): void {
  const [boom, arm, bucket] = pose.joints_rad;
  links.platform.matrix.makeRotationZ(pose.swing_rad);
  links.platform.matrixWorldNeedsUpdate = true;
  place(links.boom, machine.boom_foot_m, boom);
  place(links.arm, [machine.boom_m, 0], arm);
  place(links.bucket, [machine.arm_m, 0], bucket);
  const arm_pin = in_plane(pose.arm_pin_m, pose.swing_rad);
  const of_arm = (point: readonly number[]): Vector2 =>
    rotated(minus(in_plane(point, pose.swing_rad), arm_pin), -pose.directions_rad[1]);
  const pivot = of_arm(pose.rocker_pivot_m);
  const end = of_arm(pose.rocker_end_m);
  const lug = of_arm(pose.lug_m);
  place(links.rocker, pivot, direction(minus(end, pivot)));
  place(links.coupler, end, direction(minus(lug, end)));
}

export class ExcavatorModel {
  readonly node = new Group();
  readonly ghost = new Group();
  readonly shape: ExcavatorShape;
  readonly teeth = new Node();
  private readonly fill: BucketFill;
  private bucket_rad = 0;  ///< Direction against the level.
  private readonly geometries: Geometries;
  private readonly parts: Record<LinkName | 'undercarriage', Part>;
  private readonly links: Links;
  private readonly ghosts: Links;
  private readonly cylinders: {axis: 'boom' | 'arm' | 'bucket'; y_m: number; part: Cylinder}[] = [];

  constructor(
    private readonly machine: ExcavatorMachine, private readonly shared: SharedMaterials) {
    this.shape = excavator_shape(machine);
    const names = [...kLinks, 'undercarriage'] as const;
    this.geometries = Object.fromEntries(
      names.map((name) => [name, part_geometry(this.shape[name])])) as unknown as Geometries;
    this.parts = Object.fromEntries(names.map((name) => [name, new Part(
      this.geometries[name], shared, name === 'bucket' || name === 'arm')],
    )) as unknown as Record<LinkName | 'undercarriage', Part>;
    this.links = Object.fromEntries(
      kLinks.map((name) => [name, this.parts[name].node])) as unknown as Links;
    this.ghosts = Object.fromEntries(kLinks.map((name) => [name,
      // What the swing carries is the same as the machine's own but for the angle: only its front.
      name === 'platform' ? still() : new GhostPart(this.geometries[name], shared).node],
    )) as unknown as Links;
    chain(this.links);
    chain(this.ghosts);
    this.node.add(this.parts.undercarriage.node, this.links.platform);
    this.ghost.add(this.ghosts.platform);
    this.teeth.position.set(machine.bucket_m, 0, 0);
    this.fill = new BucketFill(
      bucket_shell(machine), 0.5 * this.shape.widths.bucket_m - 0.02 * machine.bucket_m, shared);
    this.links.bucket.add(this.teeth, this.fill.node);
    this.add_cylinders();
  }

  private add_cylinders(): void {
    for (const axis of ['boom', 'arm', 'bucket'] as const) {
      const data: CylinderData = this.machine.cylinders[axis];
      const spread = axis === 'boom' ? this.shape.widths.boom_cylinder_y_m : 0.13;
      for (let i = 0; i < data.count; ++i) {
        const part = new Cylinder(data, this.shared.light);
        const y = data.count === 1 ? 0 : (i / (data.count - 1) - 0.5) * 2 * spread;
        this.cylinders.push({axis, y_m: y, part});
        this.links.platform.add(part.node);
      }
    }
  }

  pose(pose: ExcavatorPose): void {
    pose_links(this.links, this.machine, pose);
    this.bucket_rad = pose.directions_rad[2];
    for (const {axis, y_m, part} of this.cylinders) {
      const {base_m, eye_m} = pose.cylinders[axis];
      const [base, eye] =
        [in_plane(base_m, pose.swing_rad), in_plane(eye_m, pose.swing_rad)];
      part.place(new Vector3(base[0], y_m, base[1]), new Vector3(eye[0], y_m, eye[1]));
    }
  }

  /// What the bucket holds, as a share of its capacity.
  show_fill(share: number): void {
    this.fill.show(share, this.bucket_rad);
  }

  /// Where the drawn cylinders begin and end, in the frame of this model's parent.
  cylinder_ends(): {axis: 'boom' | 'arm' | 'bucket'; base: Vector3; eye: Vector3}[] {
    return this.cylinders.map(({axis, part}) => ({axis, ...part.ends()}));
  }

  /// Null hides it.
  pose_ghost(pose: ExcavatorPose | null): void {
    this.ghost.visible = pose !== null;
    if (pose !== null) {
      pose_links(this.ghosts, this.machine, pose);
    }
  }

  show(state: ExcavatorState): void {
    const {stale, pressures_pa} = state;
    this.parts.platform.set_stale(stale.platform);
    this.parts.boom.set_stale(stale.boom);
    this.parts.arm.set_stale(stale.arm);
    for (const name of ['bucket', 'rocker', 'coupler'] as const) {
      this.parts[name].set_stale(stale.bucket);
    }
    for (const {axis, part} of this.cylinders) {
      const [cap, rod] = pressures_pa[axis];
      part.show(cap / this.machine.relief_pa, rod / this.machine.relief_pa, stale[axis]);
    }
  }

  set_theme(colours: SceneColours): void {
    Object.values(this.parts).forEach((part) => part.set_theme(colours));
    this.cylinders.forEach(({part}) => part.set_theme(colours));
    this.fill.set_theme(colours);
  }

  dispose(): void {
    Object.values(this.parts).forEach((part) => part.dispose());
    this.cylinders.forEach(({part}) => part.dispose());
    this.fill.dispose();
  }
}

function still(): Object3D {
  const node = new Group();
  node.matrixAutoUpdate = false;
  node.matrix = new Matrix4();
  return node;
}
