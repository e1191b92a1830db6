/// How much of an endless plane is worth seeing.

import type {Vector3} from '../model/api';

type Corners = readonly [Vector3, Vector3, Vector3, Vector3];

/// A wall reaches from this far below the ground to this far above it, in shares of the reach.
const kWall = [-0.15, 0.45] as const;

/// Four corners around the foot of the swing axis on the plane: a level one as a square about it,
/// a steep one as a wall that stands on the ground.
export function plane_outline(through_m: Vector3, normal: Vector3, reach_m: number): Corners {
  const length = Math.hypot(...normal) || 1;
  const unit = normal.map((part) => part / length) as unknown as Vector3;
  const distance = through_m.reduce((sum, part, i) => sum + part * unit[i]!, 0);
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
    [0, 1, 2].map((i) => foot[i]! + a * along[i]! + b * up[i]!) as unknown as Vector3;
  return [at(-wide, low), at(wide, low), at(wide, high), at(-wide, high)];
}
