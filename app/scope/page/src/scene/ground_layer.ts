// SPDX-License-Identifier: Apache-2.0
/// The ground around the machine: soil that is cut, and flat land to all sides.

import {
  BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh,
} from 'three';
import type {FrameStore} from '../model/api';
import {GroundMaterial} from './ground';
import {GroundSurface} from './ground_surface';
import type {Grid, HeightField} from './height_field';
import type {Light} from './light';
import {kOrder} from './materials';
import {type Soil, soil_history} from './soil';
import type {TerrainHistory} from './terrain_history';
import type {SceneColours} from './theme';

/// Of a picture's time, for frames that the soil has not seen yet.
const kBudget_ms = 4;
const kFar_m = 300;

export class GroundLayer {
  readonly node = new Group();
  private readonly material: GroundMaterial;
  private history: TerrainHistory;
  private surface: GroundSurface;
  private readonly soil_mesh: Mesh;
  private readonly flat: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly land: Mesh;
  private visible = true;

  constructor(private readonly soil: Soil, light: Light) {
    this.material = new GroundMaterial(light);
    this.history = this.begin();
    this.surface = new GroundSurface(this.history.field);
    this.soil_mesh = new Mesh(this.surface.geometry, this.material);
    this.soil_mesh.frustumCulled = false;
    this.land = new Mesh(land(soil.grid), this.material);
    this.flat = new LineSegments(metre_lines(soil.grid), new LineBasicMaterial());
    this.flat.visible = false;
    for (const object of [this.soil_mesh, this.land, this.flat]) {
      object.renderOrder = kOrder.ground;
      this.node.add(object);
    }
  }

  private begin(): TerrainHistory {
    return soil_history(this.soil);
  }

  /// Works frames in for a while and shows the soil of `now_s`, or of as far as it knows.
  /// `behind_s`: what is left to work in; 0 when there is nothing.
  update(store: FrameStore, now_s: number): {changed: boolean; behind_s: number} {
    if (!this.visible) {
      return {changed: false, behind_s: 0};
    }
    if (this.history.outlived(store)) {
      this.renew();
    }
    const done = this.history.advance(store, now_s, kBudget_ms);
    this.history.field.show(now_s, this.surface.changed);
    this.show_load(now_s);
    const known = Math.max(this.history.known_until_s, store.from_s);
    return {changed: this.surface.update(), behind_s: done ? 0 : Math.max(now_s - known, 0)};
  }

  /// Null where it is not shown.
  get shown(): HeightField | null {
    return this.visible ? this.history.field : null;
  }

  private show_load(now_s: number): void {
    const {load} = this.history;
    if (load !== null) {
      this.soil.load?.show(load.at(now_s) / load.capacity_m3);
    }
  }

  private renew(): void {
    this.history = this.begin();
    this.surface.dispose();
    this.surface = new GroundSurface(this.history.field);
    this.soil_mesh.geometry = this.surface.geometry;
  }

  /// Without soil only lines of its metres are left, through which everything is seen.
  show(visible: boolean): void {
    this.visible = visible;
    if (!visible) {
      this.soil.load?.show(0);
    }
    this.soil_mesh.visible = visible;
    this.flat.visible = !visible;
  }

  set_centre(x_m: number, y_m: number, reach_m: number): void {
    this.material.set_centre(x_m, y_m, reach_m);
  }

  set_theme(colours: SceneColours): void {
    this.material.set_theme(colours);
    this.flat.material.color.set(colours.grid);
  }

  dispose(): void {
    this.surface.dispose();
    this.land.geometry.dispose();
    this.flat.geometry.dispose();
    this.flat.material.dispose();
    this.material.dispose();
  }
}

const ends = ({x_m, y_m, cell_m, columns, rows}: Grid): [number, number, number, number] =>
  [x_m, y_m, x_m + (columns - 1) * cell_m, y_m + (rows - 1) * cell_m];

/// Level land around the grid, at z = 0.
function land(grid: Grid): BufferGeometry {
  const [x0, y0, x1, y1] = ends(grid);
  const [w, s, e, n] = [x0 - kFar_m, y0 - kFar_m, x1 + kFar_m, y1 + kFar_m];
  const quads = [[w, s, e, y0], [w, y1, e, n], [w, y0, x0, y1], [x1, y0, e, y1]] as const;
  const place = quads.flatMap(([a, b, c, d]) => [a, b, 0, c, b, 0, c, d, 0, a, b, 0, c, d, 0, a,
    d, 0]);
  const geometry = new BufferGeometry();
  const count = place.length / 3;
  const normal = Array.from({length: count}, () => [0, 0, 1]).flat();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(place), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normal), 3));
  geometry.setAttribute('cutDepth', new BufferAttribute(new Float32Array(count), 1));
  return geometry;
}

function metre_lines(grid: Grid): BufferGeometry {
  const [x0, y0, x1, y1] = ends(grid);
  const place: number[] = [];
  for (let x = Math.ceil(x0); x <= x1; ++x) {
    place.push(x, y0, 0, x, y1, 0);
  }
  for (let y = Math.ceil(y0); y <= y1; ++y) {
    place.push(x0, y, 0, x1, y, 0);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(place), 3));
  return geometry;
}
