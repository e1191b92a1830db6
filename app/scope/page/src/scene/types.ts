/// What the page knows of the scene.

import type {FrameStore, Machine, Setup, Vector2, Vector3} from '../model/api';

export interface SceneUpdate {
  store: FrameStore;
  now_s: number;
  live: boolean;
  drives?: readonly number[];  ///< Of a plan, which has no frames: strokes in m, swing in rad.
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
  dispose(): void;
}
