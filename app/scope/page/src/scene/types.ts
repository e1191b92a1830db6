// SPDX-License-Identifier: Apache-2.0
/// Interfaces of the scene, and of a machine of either kind in it.

import type {Group, Object3D, Sphere} from 'three';
import type {FrameStore, Machine, Setup, Vector2, Vector3} from '../model/api';
import type {GroundLayer} from './ground_layer';
import type {HeightField} from './height_field';
import type {SceneColours} from './theme';

export interface SceneUpdate {
  store: FrameStore;
  now_s: number;
  live: boolean;
  drives?: readonly number[];  ///< Of a plan, which has no frames: strokes in m, swing in rad.
}

/// A line of the scene's legend.
export interface KeyEntry {
  mark: 'ghost' | 'path' | 'trail' | 'field' | 'design' | 'fence';
  words: string;
}

export type SceneLayer = 'ghost' | 'path' | 'field' | 'design' | 'fences' | 'terrain';
export type SceneLayers = Record<SceneLayer, boolean>;

export interface SceneView {
  /// Null: nobody knows yet which machine it is.
  setMachine(setup: Setup, machine: Machine | null): void;
  update(view: SceneUpdate): void;
  resize(): void;
  setTheme(dark: boolean): void;
  setLayers(layers: Partial<SceneLayers>): void;
  /// The first view again, as the Home key has it.
  resetCamera(): void;
  /// Teeth or blade's edge as the scene graph has them, ground frame, m.
  tip(): Vector3 | null;
  /// The same in CSS pixels from the host's upper left corner.
  tipOnScreen(): Vector2 | null;
  /// The ground as it is shown; null where none is.
  ground(): HeightField | null;
  /// Whether the picture is drawn, with all frames until its moment worked into the soil.
  settled(): boolean;
  dispose(): void;
}

export interface Stage {
  readonly node: Group;
  readonly ground: GroundLayer;
  readonly home: Sphere;      ///< What the first view has to hold, with the machine at x = 0.
  readonly tip: Object3D;     ///< Teeth or edge.
  /// Null: the bus has no pressures to show. Undefined: nor is there anything that could be old.
  readonly relief_pa: number | null | undefined;
  readonly along_m: number;   ///< Driven so far.
  readonly placed: boolean;   ///< The machine has been somewhere; until then it is not drawn.
  update(view: SceneUpdate): void;
  face(eye_y_m: number): void;  ///< Where the reader's eye is.
  key(): readonly KeyEntry[];   ///< Of the layers that are on now.
  set_layers(layers: SceneLayers): void;
  set_theme(colours: SceneColours): void;
  dispose(): void;
}
