// SPDX-License-Identifier: Apache-2.0
/// Boxes and upright cylinders that a task keeps the machine out of.

import {BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial} from 'three';
import type {Vector2, Vector3} from '../model/api';
import {type KeepOut, keep_out_ring} from './keep_out_ring';
import {chained, Lines} from './lines';
import {kOrder} from './materials';
import type {SceneColours} from './theme';

/// Upright lines, of a box at its corners.
const kUprights = 4;

/// A translucent body with its edges.
export class KeepOutBody {
  readonly node = new Group();
  readonly label_m: Vector3;  ///< Over it.
  private readonly surface: Mesh<BufferGeometry, MeshBasicMaterial>;
  private readonly edge: Lines;

  constructor(fence: KeepOut) {
    const ring = keep_out_ring(fence);
    const [low, high] = [fence.centre_m[2] - fence.half_m[2], fence.centre_m[2] + fence.half_m[2]];
    this.label_m = [fence.centre_m[0], fence.centre_m[1], high];
    this.surface = new Mesh(body(ring, low, high), new MeshBasicMaterial({
      side: DoubleSide, forceSinglePass: true, transparent: true, depthWrite: false, opacity: 0.12}));
    this.surface.renderOrder = kOrder.planes;
    const at = (z: number) => ring.map(([x, y]): Vector3 => [x, y, z]);
    const every = ring.length / kUprights;
    const uprights = ring.filter((_, i) => i % every === 0)
      .flatMap(([x, y]): Vector3[] => [[x, y, low], [x, y, high]]);
    this.edge = new Lines({width_px: 2, seen_through: true}, [
      ...chained(at(low), true), ...chained(at(high), true), ...uprights]);
    this.node.add(this.surface, this.edge.node);
  }

  set_theme(colours: SceneColours): void {
    this.surface.material.color.set(colours.fence);
    this.edge.set_colour(colours.fence, colours.cut);
  }

  dispose(): void {
    this.surface.geometry.dispose();
    this.surface.material.dispose();
    this.edge.dispose();
  }
}

/// Sides and lid; nobody sees it from below.
function body(ring: readonly Vector2[], low_m: number, high_m: number): BufferGeometry {
  const count = ring.length;
  const place = [...ring.flatMap(([x, y]) => [x, y, low_m]),
    ...ring.flatMap(([x, y]) => [x, y, high_m])];
  const index: number[] = [];
  for (let i = 0; i < count; ++i) {
    const next = (i + 1) % count;
    index.push(i, next, count + next, i, count + next, count + i);
    if (i > 0 && i < count - 1) {
      index.push(count, count + i, count + i + 1);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(place), 3));
  geometry.setIndex(index);
  return geometry;
}
