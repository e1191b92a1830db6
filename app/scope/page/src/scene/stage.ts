/// What a machine of either kind brings to the scene.

import type {Group, Object3D, Sphere} from 'three';
import type {GroundLayer} from './ground_layer';
import type {KeyEntry} from './key';
import type {SceneColours} from './theme';
import type {SceneLayers, SceneUpdate} from './types';

export interface Stage {
  readonly node: Group;
  readonly ground: GroundLayer;
  readonly home: Sphere;      ///< What the first view has to hold, with the machine at x = 0.
  readonly tip: Object3D;     ///< Teeth or edge.
  readonly relief_pa: number | null;  ///< Null: no pressures to show.
  readonly along_m: number;   ///< Driven so far.
  readonly placed: boolean;   ///< The machine has been somewhere; until then it is not drawn.
  update(view: SceneUpdate): void;
  face(eye_y_m: number): void;  ///< Where the reader's eye is.
  key(): readonly KeyEntry[];   ///< Of the layers that are on now.
  set_layers(layers: SceneLayers): void;
  set_theme(colours: SceneColours): void;
  dispose(): void;
}
