// SPDX-License-Identifier: Apache-2.0
/// Surfaces that a machine must not pass or has to make: fences, a task's design, a dozer's grade.

import {BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial} from 'three';
import type {Vector2, Vector3} from '../model/api';
import {designHeight} from '../model/wanted';
import {Lines, chained} from './lines';
import {kOrder} from './materials';
import {simplified} from './outline';
import type {SceneColours} from './theme';

type Corners = readonly [Vector3, Vector3, Vector3, Vector3];

/// A wall reaches from this far below the ground to this far above it, in shares of the reach.
const kWall = [-0.15, 0.45] as const;

/// Four corners around the foot of the swing axis on the plane: a level one as a square about it,
/// a steep one as a wall that stands on the ground.
export function plane_outline(through_m: Vector3, normal: Vector3, reach_m: number): Corners {
  const length = Math.hypot(...normal) || 1;
  const unit = normal.map((part) => part / length) as unknown as Vector3;
  const distance = through_m.reduce((sum, part, i) => sum + part * unit[i], 0);
  const foot = unit.map((part) => part * distance) as unknown as Vector3;
  const level = Math.hypot(unit[0], unit[1]);
  // Along the plane: level, and uphill within it.
  const along: Vector3 = level > 1e-6 ? [-unit[1] / level, unit[0] / level, 0] : [0, 1, 0];
  const up: Vector3 = level > 1e-6 ?
    [-unit[0] * unit[2] / level, -unit[1] * unit[2] / level, level] : [1, 0, 0];
  const steep = level > 0.7;
  // A wall is measured from the ground, not from its foot.
  const [low, high] = steep ?
    kWall.map((share) => (share * reach_m - foot[2]) / up[2]) as [number, number] :
    [-0.75 * reach_m, 0.75 * reach_m];
  const wide = 0.75 * reach_m;
  const at = (a: number, b: number): Vector3 =>
    [0, 1, 2].map((i) => foot[i] + a * along[i] + b * up[i]) as unknown as Vector3;
  return [at(-wide, low), at(wide, low), at(wide, high), at(-wide, high)];
}

/// A translucent surface with an edge.
export class Pane {
  readonly node = new Group();
  private readonly surface: Mesh<BufferGeometry, MeshBasicMaterial>;
  private readonly edge: Lines;

  /// `strip` as pairs of opposite points along it.
  constructor(
    strip: readonly (readonly [Vector3, Vector3])[], private readonly kind: 'design' | 'fence') {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position',
      new BufferAttribute(new Float32Array(strip.flatMap(([a, b]) => [...a, ...b])), 3));
    geometry.setIndex(strip.slice(1).flatMap((_, i) => {
      const at = 2 * i;
      return [at, at + 2, at + 1, at + 1, at + 2, at + 3];
    }));
    this.surface = new Mesh(geometry, new MeshBasicMaterial({
      side: DoubleSide, forceSinglePass: true, transparent: true, depthWrite: false,
      polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -4,
      opacity: kind === 'design' ? 0.3 : 0.1}));
    this.surface.renderOrder = kOrder.planes;
    const round = [...strip.map(([a]) => a), ...strip.map(([, b]) => b).reverse()];
    this.edge = new Lines(
      {width_px: kind === 'design' ? 2.5 : 2, seen_through: true}, chained(round, true));
    this.node.add(this.surface, this.edge.node);
  }

  set_theme(colours: SceneColours): void {
    const colour = this.kind === 'design' ? colours.design : colours.fence;
    this.surface.material.color.set(colour);
    this.edge.set_colour(colour, colours.cut);
  }

  dispose(): void {
    this.surface.geometry.dispose();
    this.surface.material.dispose();
    this.edge.dispose();
  }
}

/// A plane through a point, cut to what is in reach, and where its words go.
export function plane_pane(
  kind: 'design' | 'fence', through_m: Vector3, normal: Vector3, reach_m: number,
): {pane: Pane; label_m: Vector3} {
  const [a, b, c, d] = plane_outline(through_m, normal, reach_m);
  // Not both in the middle: a design and the fence below it are near each other.
  const share = kind === 'design' ? 0.85 : 0.5;
  const middle = (i: 0 | 1 | 2): number => d[i] + share * (c[i] - d[i]);
  return {
    pane: new Pane([[a, d], [b, c]], kind), label_m: [middle(0), middle(1), middle(2)]};
}

/// A ribbon of a width along x and z, level across or with the slope there, left up positive.
export function ribbon(
  line: readonly Vector2[], width_m: number, cross?: readonly Vector2[]): Pane {
  const half = 0.5 * width_m;
  const across = ([x, z]: Vector2): [Vector3, Vector3] => {
    const rise = cross === undefined ? 0 : half * designHeight(cross, x);
    return [[x, -half, z - rise], [x, half, z + rise]];
  };
  // What is straight along may yet turn.
  return new Pane((cross === undefined ? simplified(line, 0.001) : line).map(across), 'design');
}
