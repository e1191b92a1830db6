// SPDX-License-Identifier: Apache-2.0
/// Materials that all parts share, and the order in which things are drawn.

import {GreaterDepth, LineBasicMaterial, MeshBasicMaterial} from 'three';
import {make_light} from './light';
import type {SceneColours} from './theme';

export class SharedMaterials {
  readonly light = make_light();
  readonly edge = new LineBasicMaterial();
  /// Outlines where soil is in front of them, as a drawing has its hidden edges.
  readonly hidden = new LineBasicMaterial({depthFunc: GreaterDepth, depthWrite: false});
  readonly ghost_line = new LineBasicMaterial({transparent: true, opacity: 0.75});
  /// Where it is the same as the machine's own surface it is not seen.
  readonly ghost = new MeshBasicMaterial({
    transparent: true, opacity: 0.13, depthWrite: false,
    polygonOffset: true, polygonOffsetFactor: 4, polygonOffsetUnits: 40});

  set_theme(colours: SceneColours): void {
    this.light.set_theme(colours);
    this.edge.color.set(colours.edge);
    this.hidden.color.set(colours.hidden);
    this.ghost_line.color.set(colours.ghost);
    this.ghost.color.set(colours.ghost);
  }

  dispose(): void {
    for (const material of [this.edge, this.hidden, this.ghost_line, this.ghost]) {
      material.dispose();
    }
  }
}

/// Order in which things are drawn, which is not that of their distance: what lies behind soil is
/// drawn while there is nothing but soil.
export const kOrder = {ground: 0, hidden: 1, machine: 2, lines: 3, ghost: 4, planes: 5} as const;
