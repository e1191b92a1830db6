// SPDX-License-Identifier: Apache-2.0
/// The dozer with its grade and the ground that its blade cuts.

import {Group, Object3D, Sphere, Vector3 as Point} from 'three';
import type {DozerMachine, Vector2} from '../model/api';
import {design_line, slope_of} from '../model/dozer_across';
import {designHeight, wantedDozer} from '../model/wanted';
import {DozerModel} from './dozer_model';
import {blade_walk} from './edges';
import {GroundLayer} from './ground_layer';
import {dozer_key} from './key';
import type {Labels} from './labels';
import {dozer_across_now, dozer_state} from './machine_state';
import type {SharedMaterials} from './materials';
import {type Pane, ribbon} from './planes';
import {Ruler} from './ruler';
import {dozer_soil} from './soil';
import type {Stage} from './types';
import type {SceneColours} from './theme';
import {TrailLayer} from './trail_layer';
import type {KeyEntry, SceneLayers, SceneUpdate} from './types';

/// How far around the machine the ground is seen, m.
const kSeen_m = 55;

export class DozerStage implements Stage {
  readonly node = new Group();
  readonly ground: GroundLayer;
  readonly home: Sphere;
  readonly tip: Object3D;
  readonly relief_pa = null;
  along_m = 0;
  placed = false;
  private readonly model: DozerModel;
  private readonly design: Pane;
  private readonly trail: TrailLayer;
  private readonly ruler: Ruler;
  private layers: SceneLayers | null = null;

  constructor(
    private readonly machine: DozerMachine, shared: SharedMaterials, labels: Labels) {
    this.model = new DozerModel(machine, shared);
    this.tip = this.model.edge;
    const width = this.model.shape.blade_width_m;
    const soil = dozer_soil(machine);
    const {grid} = soil;
    this.ground = new GroundLayer(soil, shared.light);
    this.design = ribbon(graded(machine), width, machine.cross);
    this.trail = new TrailLayer(blade_walk(machine));
    this.ruler = new Ruler({
      from_x_m: Math.ceil(grid.x_m) + 4, to_x_m: Math.ceil(machine.length_m) + 2,
      aside_m: 0.5 * width + 0.5, low_z_m: -1, high_z_m: 1},
    labels);
    this.home = new Sphere(
      new Point(0.5 * machine.track_contact_m, 0, 0.6), 1.2 * machine.track_contact_m + 0.8);
    this.model.node.visible = false;
    this.model.pose_ghost(null);
    this.node.add(
      this.model.node, this.model.ghost, this.design.node, this.trail.node, this.ground.node,
      this.ruler.node);
  }

  update({store, now_s}: SceneUpdate): void {
    const state = dozer_state(this.machine, store, now_s);
    const across = this.machine.tilt === undefined ? null :
      dozer_across_now(this.machine, store, now_s).across;
    if (state.pose !== null) {
      this.model.pose(state.pose, across);
      this.along_m = state.pose.body_m[0];
      this.placed = true;
      this.model.node.visible = true;
      this.ground.set_centre(this.along_m, 0, kSeen_m);
    }
    this.model.show(state);
    this.model.pose_ghost(this.layers?.ghost && store.database !== null ?
      wantedDozer(store, this.machine, now_s) : null,
    across?.middle.place_m[1], Math.atan(across === null ? 0 : slope_of(design_line(across, 0))));
    this.trail.update(store, now_s);
  }

  face(eye_y_m: number): void {
    this.ruler.face(eye_y_m);
  }

  key(): readonly KeyEntry[] {
    return this.layers ? dozer_key(this.layers) : [];
  }

  set_layers(layers: SceneLayers): void {
    this.layers = layers;
    this.design.node.visible = layers.design;
    this.trail.node.visible = layers.path;
    this.ground.show(layers.terrain);
  }

  set_theme(colours: SceneColours): void {
    for (const part of [this.model, this.design, this.trail, this.ruler, this.ground]) {
      part.set_theme(colours);
    }
  }

  dispose(): void {
    for (const part of [this.model, this.design, this.trail, this.ruler, this.ground]) {
      part.dispose();
    }
  }
}

/// The design from x = 0 to the grade's end, and no farther.
function graded(machine: DozerMachine): Vector2[] {
  const {design, length_m} = machine;
  const inside = design.filter(([x]) => x > 0 && x < length_m);
  return [
    [0, designHeight(design, 0)], ...inside, [length_m, designHeight(design, length_m)]];
}
