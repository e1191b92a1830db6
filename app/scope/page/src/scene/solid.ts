// SPDX-License-Identifier: Apache-2.0
/// Pieces become one mesh: triangles with a normal and a colour at each corner.

import {BufferAttribute, BufferGeometry, Color, ShapeUtils, Vector2 as Point} from 'three';
import type {Vector2} from '../model/api';
import {doubled_area} from './outline';
import {kPaints} from './paints';
import type {Piece} from './pieces';

/// Sides that turn less than this are shaded as one round surface.
const kRoundCosine = Math.cos(0.7);

export function solid(pieces: readonly Piece[]): BufferGeometry {
  const position: number[] = [];
  const normal: number[] = [];
  const colour: number[] = [];
  for (const piece of pieces) {
    const before = position.length;
    extrude(piece, position, normal);
    const {r, g, b} = new Color(kPaints[piece.paint]);
    for (let i = before; i < position.length; i += 3) {
      colour.push(r, g, b);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(position), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normal), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colour), 3));
  return geometry;
}

function extrude(piece: Piece, position: number[], normal: number[]): void {
  const outline = wound(piece.outline, 1);
  const hole = piece.hole ? wound(piece.hole, -1) : null;
  // (u, v, w) of the outline and the thickness: x, z, y seen from the side and x, y, z from above.
  // From the side that is a mirror image: the triangles have to run the other way round.
  const mirrored = piece.seen === 'side';
  const put = (list: number[], u: number, v: number, w: number): void => {
    list.push(u, mirrored ? w : v, mirrored ? v : w);
  };
  const triangle = (corners: readonly (readonly [Vector2, number, Vector2, number])[]): void => {
    for (const i of mirrored ? [0, 2, 1] : [0, 1, 2]) {
      const [[u, v], w, [nu, nv], nw] = corners[i];
      put(position, u, v, w);
      put(normal, nu, nv, nw);
    }
  };
  const {from_m, to_m} = piece;
  caps(outline, hole, (a, b, c) => {
    triangle([[a, to_m, [0, 0], 1], [b, to_m, [0, 0], 1], [c, to_m, [0, 0], 1]]);
    triangle([[a, from_m, [0, 0], -1], [c, from_m, [0, 0], -1], [b, from_m, [0, 0], -1]]);
  });
  for (const ring of hole ? [outline, hole] : [outline]) {
    walls(ring, (a, na, b, nb) => {
      triangle([[a, from_m, na, 0], [b, from_m, nb, 0], [b, to_m, nb, 0]]);
      triangle([[a, from_m, na, 0], [b, to_m, nb, 0], [a, to_m, na, 0]]);
    });
  }
}

const wound = (outline: readonly Vector2[], sign: 1 | -1): readonly Vector2[] =>
  Math.sign(doubled_area(outline)) === sign ? outline : [...outline].reverse();

function caps(
  outline: readonly Vector2[], hole: readonly Vector2[] | null,
  take: (a: Vector2, b: Vector2, c: Vector2) => void): void {
  const points = [...outline, ...(hole ?? [])];
  const as_points = (ring: readonly Vector2[]): Point[] => ring.map(([x, y]) => new Point(x, y));
  const faces = ShapeUtils.triangulateShape(as_points(outline), hole ? [as_points(hole)] : []);
  for (const [a, b, c] of faces) {
    take(points[a!], points[b!], points[c!]);
  }
}

/// Each side of a ring with the normals at its two ends.
function walls(
  ring: readonly Vector2[],
  take: (a: Vector2, na: Vector2, b: Vector2, nb: Vector2) => void): void {
  const count = ring.length;
  const flat = ring.map((a, i): Vector2 => {
    const b = ring[(i + 1) % count];
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    return [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
  });
  const shared = (own: Vector2, other: Vector2): Vector2 => {
    if (own[0] * other[0] + own[1] * other[1] < kRoundCosine) {
      return own;
    }
    const sum: Vector2 = [own[0] + other[0], own[1] + other[1]];
    const length = Math.hypot(sum[0], sum[1]);
    return [sum[0] / length, sum[1] / length];
  };
  for (let i = 0; i < count; ++i) {
    const own = flat[i];
    take(ring[i], shared(own, flat[(i + count - 1) % count]),
      ring[(i + 1) % count], shared(own, flat[(i + 1) % count]));
  }
}
