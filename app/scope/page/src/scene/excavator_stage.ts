// SPDX-License-Identifier: Apache-2.0
/// The excavator with its path, its soil and what bounds it.

import {Box3, Group, Object3D, Sphere, Vector3 as Point} from 'three';
import type {ExcavatorMachine, FrameStore, Setup, Task, Vector3} from '../model/api';
import {excavatorPose} from '../model/excavator';
import {wantedExcavator} from '../model/wanted';
import {teeth_walk} from './edges';
import {ExcavatorModel} from './excavator_model';
import {GroundLayer} from './ground_layer';
import {KeepOutBody} from './keep_out';
import {excavator_key} from './key';
import type {Labels} from './labels';
import {excavator_state, planned_state} from './machine_state';
import type {SharedMaterials} from './materials';
import {DigLayer, TaskLayer} from './path_layer';
import {type Pane, plane_pane} from './planes';
import {Ruler} from './ruler';
import {type ShownTask, TaskChoice} from './shown_task';
import {excavator_soil} from './soil';
import {reach_m} from './soil_shape';
import type {Stage} from './types';
import type {SceneColours} from './theme';
import {TrailLayer} from './trail_layer';
import type {KeyEntry, SceneLayers, SceneUpdate} from './types';

export class ExcavatorStage implements Stage {
  readonly node = new Group();
  readonly ground: GroundLayer;
  readonly home: Sphere;
  readonly tip: Object3D;
  readonly relief_pa: number | undefined;
  readonly along_m = 0;
  placed = false;
  private readonly model: ExcavatorModel;
  private readonly dig: DigLayer;
  private readonly trail: TrailLayer;
  private readonly ruler: Ruler;
  private readonly choice: TaskChoice;
  private readonly task_node = new Group();
  private readonly fences = new Group();
  private readonly design = new Group();
  private task_parts: (TaskLayer | Pane | KeepOutBody)[] = [];
  private shown: ShownTask = 'none';
  private layers: SceneLayers | null = null;
  private colours: SceneColours | null = null;

  constructor(
    private readonly machine: ExcavatorMachine, private readonly setup: Setup,
    shared: SharedMaterials, private readonly labels: Labels) {
    this.model = new ExcavatorModel(machine, shared);
    this.tip = this.model.teeth;
    this.relief_pa = this.is_plan ? undefined : machine.relief_pa;
    this.dig = new DigLayer(machine.dig);
    this.trail = new TrailLayer(teeth_walk(machine));
    this.ground = new GroundLayer(
      excavator_soil(machine, (share) => this.model.show_fill(share)), shared.light);
    const far = Math.ceil(reach_m(machine));
    this.ground.set_centre(0, 0, 5 * far);
    this.ruler = new Ruler({
      from_x_m: 0, to_x_m: far, aside_m: 0.35 * machine.boom_m + 0.3, low_z_m: -2, high_z_m: 4},
    labels);
    this.choice = new TaskChoice(machine, setup);
    this.home = home_of(machine);
    this.model.node.visible = false;
    this.node.add(
      this.model.node, this.model.ghost, this.dig.path, this.dig.field, this.trail.node,
      this.task_node, this.fences, this.design, this.ground.node, this.ruler.node);
    this.model.pose_ghost(null);
    this.choose('none');
  }

  update({store, now_s, drives}: SceneUpdate): void {
    const state = drives ?
      planned_state(this.machine, drives) : excavator_state(this.machine, store, now_s);
    if (state.pose !== null) {
      this.model.pose(state.pose);
      this.dig.turn(state.pose.swing_rad);
      this.placed = true;
      this.model.node.visible = true;
    }
    this.model.show(state);
    this.pose_ghost(store, now_s);
    this.trail.update(store, now_s);
    const task = this.choice.at(store, now_s);
    if (task !== this.shown) {
      this.choose(task);
    }
  }

  private get is_plan(): boolean {
    return this.setup.source.mode === 'plan';
  }

  face(eye_y_m: number): void {
    this.ruler.face(eye_y_m);
  }

  private pose_ghost(store: FrameStore, now_s: number): void {
    const drives = !this.layers?.ghost ? null :
      store.database !== null ? wantedExcavator(store, this.machine, now_s)?.drives :
      this.is_plan ? this.machine.tasks[0]?.steps.at(-1)?.to_drives : null;
    this.model.pose_ghost(drives ?
      excavatorPose(this.machine, [drives[0]!, drives[1]!, drives[2]!], drives[3]!) : null);
  }

  private choose(task: ShownTask): void {
    this.shown = task;
    this.task_parts.forEach((part) => part.dispose());
    this.task_parts = [];
    for (const group of [this.task_node, this.fences, this.design]) {
      group.clear();
    }
    for (const group of ['path', 'fences', 'design'] as const) {
      this.labels.clear(group);
    }
    const program = typeof task === 'number' ? this.machine.tasks[task] : undefined;
    if (program) {
      this.add_task(program);
    }
    if (this.colours) {
      this.set_theme(this.colours);
    }
    this.apply_layers();
  }

  private add_task(task: Task): void {
    const layer = new TaskLayer(this.machine, task, this.is_plan);
    layer.label(this.labels);
    this.task_node.add(layer.node);
    this.task_parts.push(layer);
    const reach = reach_m(this.machine);
    // The last fence is the design's own.
    const fences = task.design || task.surface ? task.fences.slice(0, -1) : task.fences;
    fences.forEach((fence, i) => {
      const {normal, offset_m, centre_m, half_m, round, turn_rad} = fence;
      if (normal && offset_m !== undefined) {
        const through = normal.map((part) => part * offset_m) as unknown as Vector3;
        this.add_plane('fence', `fence${i}`, fence.words, through, normal, reach);
      } else if (centre_m && half_m) {
        const body = new KeepOutBody({centre_m, half_m, round, turn_rad});
        this.task_parts.push(body);
        this.fences.add(body.node);
        this.labels.put(`fence${i}`, 'fences', fence.words, body.label_m);
      }
    });
    if (task.design) {
      this.add_plane(
        'design', 'design', 'design', task.design.through_m, task.design.up, reach);
    }
  }

  private add_plane(
    kind: 'design' | 'fence', name: string, words: string, through: Vector3, normal: Vector3,
    reach: number): void {
    const {pane, label_m} = plane_pane(kind, through, normal, reach);
    this.task_parts.push(pane);
    (kind === 'design' ? this.design : this.fences).add(pane.node);
    this.labels.put(name, kind === 'design' ? 'design' : 'fences', words, label_m);
  }

  key(): readonly KeyEntry[] {
    const has_frames = this.setup.source.mode !== 'plan';
    return this.layers ?
      excavator_key(this.machine, this.layers, this.shown, has_frames) : [];
  }

  set_layers(layers: SceneLayers): void {
    this.layers = layers;
    this.apply_layers();
  }

  private apply_layers(): void {
    const {layers} = this;
    if (!layers) {
      return;
    }
    this.dig.path.visible = layers.path && this.shown === 'dig';
    this.dig.field.visible = layers.field && this.shown === 'dig';
    this.task_node.visible = layers.path;
    this.trail.node.visible = layers.path;
    this.fences.visible = layers.fences;
    this.design.visible = layers.design;
    this.ground.show(layers.terrain);
  }

  set_theme(colours: SceneColours): void {
    this.colours = colours;
    for (const part of [
      this.model, this.dig, this.trail, this.ruler, this.ground, ...this.task_parts]) {
      part.set_theme(colours);
    }
  }

  dispose(): void {
    for (const part of [
      this.model, this.dig, this.trail, this.ruler, this.ground, ...this.task_parts]) {
      part.dispose();
    }
  }
}

/// Machine and path, seen from the side.
function home_of(machine: ExcavatorMachine): Sphere {
  const box = new Box3(
    new Point(-0.45 * machine.boom_m, 0, 0),
    new Point(0.6 * reach_m(machine), 0, machine.boom_foot_m[1] + 0.6 * machine.boom_m));
  for (const [x, z] of machine.dig.path) {
    box.expandByPoint(new Point(x, 0, z));
  }
  for (const task of machine.tasks) {
    for (const {from, to} of task.steps) {
      for (const {position_m} of [from, to]) {
        box.expandByPoint(new Point(Math.hypot(position_m[0], position_m[1]), 0, position_m[2]));
      }
    }
  }
  return box.getBoundingSphere(new Sphere());
}
