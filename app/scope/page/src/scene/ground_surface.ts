// SPDX-License-Identifier: Apache-2.0
/// A height field as triangles: coarse where it is flat and nothing was cut, fine where it is not.

import {BufferAttribute, BufferGeometry} from 'three';
import type {HeightField} from './height_field';

/// Cells along a tile's side.
const kTile = 10;

export class GroundSurface {
  readonly geometry = new BufferGeometry();
  private readonly height: BufferAttribute;
  private readonly normal: BufferAttribute;
  private readonly depth: BufferAttribute;
  private readonly start: Float32Array;
  private readonly fine: Uint8Array;
  private readonly tiles_x: number;
  private readonly tiles_y: number;
  private moved = new Set<number>();
  private retile = true;

  constructor(private readonly field: HeightField) {
    const {columns, rows, x_m, y_m, cell_m} = field.grid;
    const count = columns * rows;
    const place = new Float32Array(3 * count);
    for (let node = 0; node < count; ++node) {
      place[3 * node] = x_m + (node % columns) * cell_m;
      place[3 * node + 1] = y_m + Math.floor(node / columns) * cell_m;
      place[3 * node + 2] = field.heights[node];
    }
    this.start = field.heights.slice();
    this.height = new BufferAttribute(place, 3);
    this.normal = new BufferAttribute(new Float32Array(3 * count), 3);
    this.depth = new BufferAttribute(new Float32Array(count), 1);
    this.geometry.setAttribute('position', this.height);
    this.geometry.setAttribute('normal', this.normal);
    this.geometry.setAttribute('cutDepth', this.depth);
    this.tiles_x = Math.ceil((columns - 1) / kTile);
    this.tiles_y = Math.ceil((rows - 1) / kTile);
    this.fine = new Uint8Array(this.tiles_x * this.tiles_y);
    for (let node = 0; node < count; ++node) {
      this.shade(node);
    }
    this.fine.forEach((_, tile) => {
      this.fine[tile] = this.is_plane(tile) ? 0 : 1;
    });
  }

  /// A node of the field has another height.
  readonly changed = (node: number): void => {
    this.moved.add(node);
  };

  /// Takes the changes over; whether there were any.
  update(): boolean {
    const {columns, rows} = this.field.grid;
    if (this.moved.size === 0 && !this.retile) {
      return false;
    }
    const around = new Set<number>();
    for (const node of this.moved) {
      const height = this.field.heights[node];
      this.height.array[3 * node + 2] = height;
      this.depth.array[node] = this.start[node] - height;
      this.refine(node);
      const column = node % columns;
      const row = Math.floor(node / columns);
      around.add(node);
      if (column > 0) around.add(node - 1);
      if (column < columns - 1) around.add(node + 1);
      if (row > 0) around.add(node - columns);
      if (row < rows - 1) around.add(node + columns);
    }
    around.forEach((node) => this.shade(node));
    this.moved.clear();
    for (const attribute of [this.height, this.normal, this.depth]) {
      attribute.needsUpdate = true;
    }
    if (this.retile) {
      this.index();
    }
    return true;
  }

  /// Tiles that share the node; coarse ones around it would leave a gap.
  private refine(node: number): void {
    const column = node % this.field.grid.columns;
    const row = Math.floor(node / this.field.grid.columns);
    for (const x of tiles_at(column, this.tiles_x)) {
      for (const y of tiles_at(row, this.tiles_y)) {
        const tile = y * this.tiles_x + x;
        if (!this.fine[tile]) {
          this.fine[tile] = 1;
          this.retile = true;
        }
      }
    }
  }

  /// Whether two triangles are enough for the tile before anything is cut.
  private is_plane(tile: number): boolean {
    const {column, row, wide, high} = this.tile(tile);
    const at = (x: number, y: number): number =>
      this.start[(row + y) * this.field.grid.columns + column + x];
    const corner = at(0, 0);
    const [along, up] = [(at(wide, 0) - corner) / wide, (at(0, high) - corner) / high];
    for (let y = 0; y <= high; ++y) {
      for (let x = 0; x <= wide; ++x) {
        if (Math.abs(at(x, y) - corner - x * along - y * up) > 1e-5) {
          return false;
        }
      }
    }
    return true;
  }

  private tile(tile: number): {column: number; row: number; wide: number; high: number} {
    const {columns, rows} = this.field.grid;
    const column = (tile % this.tiles_x) * kTile;
    const row = Math.floor(tile / this.tiles_x) * kTile;
    return {
      column, row, wide: Math.min(kTile, columns - 1 - column),
      high: Math.min(kTile, rows - 1 - row)};
  }

  private shade(node: number): void {
    const {columns, rows, cell_m} = this.field.grid;
    const {heights} = this.field;
    const column = node % columns;
    const row = Math.floor(node / columns);
    const left = heights[column > 0 ? node - 1 : node];
    const right = heights[column < columns - 1 ? node + 1 : node];
    const below = heights[row > 0 ? node - columns : node];
    const above = heights[row < rows - 1 ? node + columns : node];
    const x = (left - right) / (2 * cell_m);
    const y = (below - above) / (2 * cell_m);
    const length = Math.hypot(x, y, 1);
    this.normal.array[3 * node] = x / length;
    this.normal.array[3 * node + 1] = y / length;
    this.normal.array[3 * node + 2] = 1 / length;
  }

  private index(): void {
    const {columns} = this.field.grid;
    const list: number[] = [];
    const quad = (column: number, row: number, wide: number, high: number): void => {
      const a = row * columns + column;
      const [b, c] = [a + wide, a + high * columns];
      list.push(a, b, c + wide, a, c + wide, c);
    };
    for (let tile = 0; tile < this.fine.length; ++tile) {
      const {column, row, wide, high} = this.tile(tile);
      if (!this.fine[tile]) {
        quad(column, row, wide, high);
        continue;
      }
      for (let i = 0; i < wide; ++i) {
        for (let j = 0; j < high; ++j) {
          quad(column + i, row + j, 1, 1);
        }
      }
    }
    this.geometry.setIndex(list);
    this.retile = false;
  }

  dispose(): void {
    this.geometry.dispose();
  }
}

/// One tile, or two for a node between them.
function tiles_at(place: number, tiles: number): number[] {
  const tile = Math.min(Math.floor(place / kTile), tiles - 1);
  return tile > 0 && tile * kTile === place ? [tile - 1, tile] : [tile];
}
