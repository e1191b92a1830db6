// SPDX-License-Identifier: Apache-2.0
/// The ground as heights over a grid, changed in the order of time and shown as it was at any time.

export interface Grid {
  x_m: number;  ///< Of the first node.
  y_m: number;
  cell_m: number;
  columns: number;  ///< Nodes along x.
  rows: number;     ///< Along y.
}

/// Less than this is not worth an entry: a tip that goes the same way again, with the noise of its
/// sensors, would fill the memory.
const kLeastCut_m = 0.002;

/// Every change is kept with its time, the height before and after it: so any time between the
/// first and the last is shown by undoing or redoing what lies between.
export class HeightField {
  readonly grid: Grid;
  readonly heights: Float32Array;  ///< As shown; row by row from the first.
  private readonly latest: Float32Array;
  private readonly start: Float32Array;
  private time = new Float64Array(1024);
  private node = new Int32Array(1024);
  private before = new Float32Array(1024);
  private after = new Float32Array(1024);
  private count = 0;
  private shown = 0;
  private readonly most: number;
  /// Changed where entries were forgotten; the next `show` tells of them.
  private readonly untold = new Set<number>();

  /// Of more than `most` entries the older half is forgotten: before their time the field shows
  /// what they left.
  constructor(grid: Grid, start: (x_m: number, y_m: number) => number, most = 1 << 21) {
    this.grid = grid;
    this.most = most;
    this.heights = new Float32Array(grid.columns * grid.rows);
    for (let row = 0; row < grid.rows; ++row) {
      for (let column = 0; column < grid.columns; ++column) {
        this.heights[row * grid.columns + column] =
          start(grid.x_m + column * grid.cell_m, grid.y_m + row * grid.cell_m);
      }
    }
    this.latest = this.heights.slice();
    this.start = this.heights.slice();
  }

  get entries(): number {
    return this.count;
  }

  /// After all changes.
  latest_m(node: number): number {
    return this.latest[node];
  }

  /// Of the node that is nearest; NaN beyond the grid.
  latest_at(x_m: number, y_m: number): number {
    return this.at_nearest(this.latest, x_m, y_m);
  }

  /// The same as it is shown.
  shown_at(x_m: number, y_m: number): number {
    return this.at_nearest(this.heights, x_m, y_m);
  }

  /// Calls `tell` with each node that is shown lower than at the start.
  each_cut(tell: (x_m: number, y_m: number, z_m: number) => void): void {
    const {x_m, y_m, cell_m, columns} = this.grid;
    this.heights.forEach((z_m, node) => {
      if (z_m < this.start[node]!) {
        tell(x_m + cell_m * (node % columns), y_m + cell_m * Math.floor(node / columns), z_m);
      }
    });
  }

  private at_nearest(heights: Float32Array, x_m: number, y_m: number): number {
    const {cell_m, columns, rows} = this.grid;
    const column = Math.round((x_m - this.grid.x_m) / cell_m);
    const row = Math.round((y_m - this.grid.y_m) / cell_m);
    const is_inside = column >= 0 && row >= 0 && column < columns && row < rows;
    return is_inside ? heights[row * columns + column] : NaN;
  }

  /// Takes the node down to a height, if it is above; returns by how much. Times must not fall.
  lower(time_s: number, node: number, height_m: number): number {
    const was = this.latest[node];
    if (height_m > was - kLeastCut_m) {
      return 0;
    }
    this.enter(time_s, node, was, height_m);
    return was - height_m;
  }

  /// Brings the node up to a height, if it is below. Times must not fall.
  raise(time_s: number, node: number, height_m: number): void {
    const was = this.latest[node];
    if (height_m >= was + kLeastCut_m) {
      this.enter(time_s, node, was, height_m);
    }
  }

  /// From then on the soil lies as it did at the start. Times must not fall.
  lay_anew(time_s: number): void {
    this.latest.forEach((was, node) => {
      if (was !== this.start[node]) {
        this.enter(time_s, node, was, this.start[node]);
      }
    });
  }

  private enter(time_s: number, node: number, was: number, height_m: number): void {
    if (this.count === this.time.length) {
      this.make_room();
    }
    this.time[this.count] = time_s;
    this.node[this.count] = node;
    this.before[this.count] = was;
    this.after[this.count] = height_m;
    this.latest[node] = height_m;
    ++this.count;
  }

  /// Shows the field as it was; calls `changed` for each node whose height that changes, perhaps
  /// more than once.
  show(time_s: number, changed: (node: number) => void): void {
    this.untold.forEach((node) => changed(node));
    this.untold.clear();
    const target = this.entries_until(time_s);
    for (; this.shown < target; ++this.shown) {
      this.put(this.node[this.shown], this.after[this.shown], changed);
    }
    for (; this.shown > target; --this.shown) {
      this.put(this.node[this.shown - 1], this.before[this.shown - 1], changed);
    }
  }

  private put(node: number, height_m: number, changed: (node: number) => void): void {
    this.heights[node] = height_m;
    changed(node);
  }

  private entries_until(time_s: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time[middle] <= time_s) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }

  private make_room(): void {
    if (this.count < this.most) {
      const size = Math.min(2 * this.count, this.most);
      this.time = grown(this.time, new Float64Array(size));
      this.node = grown(this.node, new Int32Array(size));
      this.before = grown(this.before, new Float32Array(size));
      this.after = grown(this.after, new Float32Array(size));
      return;
    }
    const gone = this.count >> 1;
    // What is forgotten has to be in what is shown.
    for (; this.shown < gone; ++this.shown) {
      this.put(this.node[this.shown], this.after[this.shown], (node) => this.untold.add(node));
    }
    for (const list of [this.time, this.node, this.before, this.after]) {
      list.copyWithin(0, gone, this.count);
    }
    this.count -= gone;
    this.shown -= gone;
  }
}

function grown<List extends Float64Array | Float32Array | Int32Array>(from: List, to: List): List {
  to.set(from);
  return to;
}

/// What the frames say of the bucket's load, beside where its edge is; NaN: not known.
export interface BucketSigns {
  payload_kg: number;
  deviation_kg: number;  ///< Of the payload.
  resists: boolean;      ///< The ground holds against the teeth.
}

/// An edge that cuts: as wide as the bucket or the blade, square to where it looks, level unless it
/// has a slope.
export interface Edge {
  x_m: number;
  y_m: number;
  z_m: number;
  heading_rad: number;
  left_up?: number;            ///< Slope along the edge, its left end up.
  drives?: readonly number[];  ///< That hold it, m and rad, where each has a sensor of its own.
  tilt_rad?: number;           ///< Of a bucket's mouth against level.
  bucket?: BucketSigns;
}

/// Lowers the nodes that an edge of this width passes over between two of its places; returns the
/// volume that they had, m3.
export function cut(
  field: HeightField, time_s: number, from: Edge, to: Edge, width_m: number): number {
  const {cell_m} = field.grid;
  const way = Math.hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  const steps = Math.max(1, Math.ceil(way / (0.5 * cell_m)));
  let lowered_m = 0;
  for (let i = 1; i <= steps; ++i) {
    const share = i / steps;
    lowered_m += stamp(field, time_s, width_m, {
      x_m: from.x_m + share * (to.x_m - from.x_m),
      y_m: from.y_m + share * (to.y_m - from.y_m),
      z_m: from.z_m + share * (to.z_m - from.z_m),
      heading_rad: from.heading_rad + share * (to.heading_rad - from.heading_rad),
      left_up: (1 - share) * (from.left_up ?? 0) + share * (to.left_up ?? 0),
    });
  }
  return lowered_m * cell_m ** 2;
}

/// Nodes under the edge: half a cell before and behind it, or it would slip between them.
function stamp(field: HeightField, time_s: number, width_m: number, edge: Edge): number {
  const {x_m, y_m, cell_m, columns, rows} = field.grid;
  const [cos, sin] = [Math.cos(edge.heading_rad), Math.sin(edge.heading_rad)];
  const half = Math.max(0.5 * width_m, 0.5 * cell_m) + 1e-6;
  const thick = 0.5 * cell_m + 1e-6;
  const reach_x = half * Math.abs(sin) + thick * Math.abs(cos);
  const reach_y = half * Math.abs(cos) + thick * Math.abs(sin);
  const first = Math.max(0, Math.ceil((edge.x_m - reach_x - x_m) / cell_m));
  const last = Math.min(columns - 1, Math.floor((edge.x_m + reach_x - x_m) / cell_m));
  const bottom = Math.max(0, Math.ceil((edge.y_m - reach_y - y_m) / cell_m));
  const top = Math.min(rows - 1, Math.floor((edge.y_m + reach_y - y_m) / cell_m));
  let lowered_m = 0;
  for (let row = bottom; row <= top; ++row) {
    const dy = y_m + row * cell_m - edge.y_m;
    for (let column = first; column <= last; ++column) {
      const dx = x_m + column * cell_m - edge.x_m;
      const left = dy * cos - dx * sin;
      if (Math.abs(dx * cos + dy * sin) <= thick && Math.abs(left) <= half) {
        lowered_m += field.lower(
          time_s, row * columns + column, edge.z_m + left * (edge.left_up ?? 0));
      }
    }
  }
  return lowered_m;
}
