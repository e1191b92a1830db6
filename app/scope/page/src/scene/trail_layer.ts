// SPDX-License-Identifier: Apache-2.0
/// The trail as a line that fades with age.

import {Color, type Group} from 'three';
import type {FrameStore} from '../model/api';
import {Lines} from './lines';
import type {EdgeWalk} from './terrain_history';
import type {SceneColours} from './theme';
import {Trail, trail_segments} from './trail';

const kLength_s = 8;

export class TrailLayer {
  private readonly lines = new Lines({width_px: 3, seen_through: true});
  private readonly trail: Trail;
  private readonly young = new Color();
  private readonly old = new Color();

  constructor(walk: (store: FrameStore, after_s: number) => EdgeWalk) {
    this.trail = new Trail(kLength_s, walk);
  }

  get node(): Group {
    return this.lines.node;
  }

  update(store: FrameStore, now_s: number): void {
    const points = this.trail.at(store, now_s);
    const {segments, ages} = trail_segments(points, now_s, kLength_s);
    const shade = new Color();
    this.lines.set(segments, ages.flatMap((age) => {
      shade.copy(this.young).lerp(this.old, Math.min(Math.max(age, 0), 1));
      return [shade.r, shade.g, shade.b];
    }));
  }

  set_theme(colours: SceneColours): void {
    this.young.set(colours.trail);
    this.old.set(colours.ground);
    this.lines.set_colour(colours.trail, colours.cut);
    this.lines.set_shaded();
  }

  dispose(): void {
    this.lines.dispose();
  }
}
