// SPDX-License-Identifier: Apache-2.0
/// The soil in the bucket, drawn as a mass as large as it is.

import {BufferGeometry, Mesh} from 'three';
import type {Vector2} from '../model/api';
import {fill_outline} from './fill_shape';
import {PartMaterial} from './light';
import {kOrder, type SharedMaterials} from './materials';
import {side} from './pieces';
import {solid} from './solid';
import type {SceneColours} from './theme';

/// Steps in which it is drawn anew.
const kShare = 0.02;
const kTurn_rad = 0.05;

export class BucketFill {
  readonly node: Mesh<BufferGeometry, PartMaterial>;
  private drawn = '';

  /// In the frame of the bucket.
  constructor(
    private readonly shell: readonly Vector2[], private readonly half_width_m: number,
    shared: SharedMaterials) {
    this.node = new Mesh(new BufferGeometry(), new PartMaterial(shared.light));
    this.node.renderOrder = kOrder.machine;
    this.node.matrixAutoUpdate = false;
    this.node.frustumCulled = false;
    this.node.visible = false;
  }

  /// `share` of what the bucket holds; see fill_outline().
  show(share: number, direction_rad: number): void {
    const [steps, turns] = [Math.round(share / kShare), Math.round(direction_rad / kTurn_rad)];
    this.node.visible = steps > 0;
    const wanted = `${steps} ${turns}`;
    if (steps <= 0 || wanted === this.drawn) {
      return;
    }
    this.drawn = wanted;
    const outline = fill_outline(this.shell, steps * kShare, turns * kTurn_rad);
    this.node.geometry.dispose();
    this.node.geometry = solid([side('soil', outline, -this.half_width_m, this.half_width_m)]);
  }

  set_theme(colours: SceneColours): void {
    this.node.material.set_theme(colours);
  }

  dispose(): void {
    this.node.geometry.dispose();
    this.node.material.dispose();
  }
}
