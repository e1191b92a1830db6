// SPDX-License-Identifier: Apache-2.0
/// One rigid part of a machine: its solid, its outline, and its outline behind soil.

import {
  BufferGeometry, EdgesGeometry, Group, LineSegments, Mesh, type Object3D,
} from 'three';
import {PartMaterial} from './light';
import {kOrder, type SharedMaterials} from './materials';
import type {Piece} from './pieces';
import {solid} from './solid';
import type {SceneColours} from './theme';

/// Edges that turn less than this, in degrees, are not drawn.
const kEdgeTurn_deg = 35;

/// What both the part and its ghost are made of.
export interface PartGeometry {
  surface: BufferGeometry;
  edges: BufferGeometry;
}

export function part_geometry(pieces: readonly Piece[]): PartGeometry {
  const surface = solid(pieces);
  return {surface, edges: new EdgesGeometry(surface, kEdgeTurn_deg)};
}

export class Part {
  readonly node = new Group();
  private readonly material: PartMaterial;

  constructor(
    private readonly geometry: PartGeometry, shared: SharedMaterials, seen_through_soil: boolean) {
    this.material = new PartMaterial(shared.light);
    this.add(new Mesh(geometry.surface, this.material), kOrder.machine);
    this.add(new LineSegments(geometry.edges, shared.edge), kOrder.machine);
    if (seen_through_soil) {
      this.add(new LineSegments(geometry.edges, shared.hidden), kOrder.hidden);
    }
    this.node.matrixAutoUpdate = false;
  }

  private add(object: Object3D, order: number): void {
    object.renderOrder = order;
    object.matrixAutoUpdate = false;
    this.node.add(object);
  }

  set_stale(stale: boolean): void {
    this.material.set_stale(stale);
  }

  set_theme(colours: SceneColours): void {
    this.material.set_theme(colours);
  }

  dispose(): void {
    this.geometry.surface.dispose();
    this.geometry.edges.dispose();
    this.material.dispose();
  }
}

/// The same geometry as a translucent body with an outline.
export class GhostPart {
  readonly node = new Group();

  constructor(geometry: PartGeometry, shared: SharedMaterials) {
    const body = new Mesh(geometry.surface, shared.ghost);
    const line = new LineSegments(geometry.edges, shared.ghost_line);
    for (const object of [body, line]) {
      object.renderOrder = kOrder.ghost;
      object.matrixAutoUpdate = false;
      this.node.add(object);
    }
    this.node.matrixAutoUpdate = false;
  }
}
