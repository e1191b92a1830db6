// SPDX-License-Identifier: Apache-2.0
/// The dozer as nodes: body, blade on its pivot, cylinders between both.

import {Group, Matrix4, Object3D, Vector3} from 'three';
import type {DozerMachine, Vector2} from '../model/api';
import {type DozerPose, bladeLinkage, home_edge} from '../model/dozer';
import type {DozerAcross} from '../model/dozer_across';
import {minus, rotated} from '../model/geometry';
import {Cylinder} from './cylinder';
import {dozer_shape, type DozerShape} from './dozer_shape';
import type {DozerMachineState} from './machine_state';
import type {SharedMaterials} from './materials';
import {GhostPart, Part, part_geometry} from './part';
import type {SceneColours} from './theme';

export class DozerModel {
  readonly node = new Group();
  readonly ghost = new Group();
  readonly shape: DozerShape;
  readonly edge = new Object3D();
  private readonly body: Part;
  private readonly blade: Part;
  private readonly ghost_blade: GhostPart;
  private readonly cylinders: Cylinder[] = [];

  constructor(private readonly machine: DozerMachine, shared: SharedMaterials) {
    this.shape = dozer_shape(machine);
    const blade = part_geometry(this.shape.blade);
    this.body = new Part(part_geometry(this.shape.body), shared, false);
    this.blade = new Part(blade, shared, true);
    this.ghost_blade = new GhostPart(blade, shared);
    this.body.node.add(this.blade.node);
    this.node.add(this.body.node);
    this.ghost.add(this.ghost_blade.node);
    const linkage = bladeLinkage(machine);
    const edge = home_edge(machine);
    this.edge.position.set(edge[0], 0, edge[1]);
    this.blade.node.add(this.edge);
    for (let i = 0; i < machine.blade.cylinders; ++i) {
      const cylinder = new Cylinder({
        bore_m: machine.blade.bore_m, rod_m: machine.blade.rod_m,
        closed_length_m: linkage.shortest_m, stroke_m: linkage.stroke_max_m}, shared.light);
      this.cylinders.push(cylinder);
      this.body.node.add(cylinder.node);
    }
  }

  /// `across`: of a machine whose blade tilts.
  pose(pose: DozerPose, across: DozerAcross | null = null): void {
    const {offset_m = 0, heading_rad = 0, roll_rad = 0, tilt_rad = 0} = across ?? {};
    place(this.body.node, pose.body_m, pose.pitch_rad, roll_rad);
    this.body.node.matrix.setPosition(0, 0, 0)
      .premultiply(new Matrix4().makeRotationZ(heading_rad))
      .setPosition(pose.body_m[0], offset_m, pose.body_m[1]);
    place(this.blade.node, this.machine.blade.pivot_m, pose.blade_rad);
    this.tilt(this.blade.node, tilt_rad);
    const in_body = (point: Vector2): Vector2 =>
      rotated(minus(point, pose.body_m), -pose.pitch_rad);
    const base = in_body(pose.cylinder_base_m);
    const eye = in_body(pose.cylinder_eye_m);
    const last = this.cylinders.length - 1;
    this.cylinders.forEach((cylinder, i) => {
      const y = last === 0 ? 0 : (2 * i / last - 1) * this.shape.cylinder_y_m;
      cylinder.place(new Vector3(base[0], y, base[1]), new Vector3(eye[0], y, eye[1]));
    });
  }

  /// About the edge's middle.
  private tilt(blade: Object3D, left_up_rad: number): void {
    const {x, y, z} = this.edge.position;
    blade.matrix.multiply(new Matrix4().makeTranslation(x, y, z))
      .multiply(new Matrix4().makeRotationX(left_up_rad))
      .multiply(new Matrix4().makeTranslation(-x, -y, -z));
  }

  /// Null hides it. Its edge is at `offset_m` and as steep across as is told.
  pose_ghost(pose: DozerPose | null, offset_m = 0, left_up_rad = 0): void {
    this.ghost.visible = pose !== null;
    if (pose !== null) {
      place(this.ghost_blade.node, pose.pivot_m, pose.blade_rad + pose.pitch_rad);
      this.ghost_blade.node.matrix.setPosition(pose.pivot_m[0], offset_m, pose.pivot_m[1]);
      this.tilt(this.ghost_blade.node, left_up_rad);
    }
  }

  show(state: DozerMachineState): void {
    this.body.set_stale(state.stale.body);
    this.blade.set_stale(state.stale.blade);
    // The bus has no pressures of the blade's cylinders, which the legend says.
    this.cylinders.forEach((cylinder) => cylinder.show(null, null, state.stale.blade));
  }

  set_theme(colours: SceneColours): void {
    this.body.set_theme(colours);
    this.blade.set_theme(colours);
    this.cylinders.forEach((cylinder) => cylinder.set_theme(colours));
  }

  dispose(): void {
    this.body.dispose();
    this.blade.dispose();
    this.cylinders.forEach((cylinder) => cylinder.dispose());
  }
}

function place(node: Object3D, at_m: Vector2, turn_rad: number, roll_rad = 0): void {
  node.matrix.makeRotationY(-turn_rad).multiply(new Matrix4().makeRotationX(roll_rad))
    .setPosition(at_m[0], 0, at_m[1]);
  node.matrixWorldNeedsUpdate = true;
}
