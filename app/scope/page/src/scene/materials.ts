/// Matt surfaces that can turn grey as a whole, and the lines of a part's outline.

import {
  Color, DoubleSide, GreaterDepth, LineBasicMaterial, MeshBasicMaterial, MeshLambertMaterial,
} from 'three';
import type {SceneColours} from './theme';

/// One for each part of the machine: a part greys alone.
export interface PartMaterial {
  surface: MeshLambertMaterial;
  set_stale(stale: boolean): void;
  set_theme(colours: SceneColours): void;
}

/// A part that is not known keeps its shading and loses its colour.
export function part_material(): PartMaterial {
  const surface = new MeshLambertMaterial({vertexColors: true});
  const grey = {value: new Color()};
  const share = {value: 0};
  surface.onBeforeCompile = (shader) => {
    shader.uniforms.staleColour = grey;
    shader.uniforms.staleShare = share;
    shader.fragmentShader = shader.fragmentShader
      .replace('void main() {',
        'uniform vec3 staleColour;\nuniform float staleShare;\nvoid main() {')
      .replace('#include <color_fragment>', `#include <color_fragment>
        float light = dot(diffuseColor.rgb, vec3(0.3, 0.5, 0.2));
        diffuseColor.rgb = mix(diffuseColor.rgb, staleColour * (0.5 + light), staleShare);`);
  };
  surface.customProgramCacheKey = () => 'part';
  return {
    surface,
    set_stale: (stale) => {
      share.value = stale ? 1 : 0;
    },
    set_theme: (colours) => {
      grey.value.set(colours.stale);
    },
  };
}

/// Materials that all parts share; `set_theme` recolours them.
export class SharedMaterials {
  readonly edge = new LineBasicMaterial();
  /// Outlines where soil is in front of them, as a drawing has its hidden edges.
  readonly hidden = new LineBasicMaterial({depthFunc: GreaterDepth, depthWrite: false});
  readonly ghost_line = new LineBasicMaterial({transparent: true, opacity: 0.75});
  readonly ghost = new MeshBasicMaterial({
    transparent: true, opacity: 0.13, depthWrite: false, side: DoubleSide});

  set_theme(colours: SceneColours): void {
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

/// Order in which things are drawn, which is not that of their distance.
export const kOrder = {ground: 0, hidden: 1, machine: 2, lines: 3, ghost: 4, planes: 5} as const;
