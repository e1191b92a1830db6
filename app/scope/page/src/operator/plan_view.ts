// SPDX-License-Identifier: Apache-2.0
/// The machine from above, forward up: fences, keep-outs, the strip that is graded.

import type {Vector2, Vector3} from '../model/api';
import {blade_width} from '../scene/dozer_shape';
import {reach_m} from '../scene/soil_shape';
import {draw_bound, in_plan, own_fences, ring_of, shown_task} from './bounds';
import {dozer_above, excavator_above, type Flat} from '../scene/figure';
import {built_as, design_of} from './design';
import type {Frame} from './frame';
import {type Metres, Picture, type Span} from '../view/basics/picture';

/// Around a dozer, m.
const BEHIND_M = 4;
const AHEAD_M = 8;
const ASIDE_M = 5;
const LINE = 4;

/// From x and y of the ground to right and up.
const turned = ([x, y]: Vector2 | Vector3): Vector2 => [-y, x];

export class PlanView {
  private readonly picture = new Picture('plan', 'The machine from above, with fences and keep-outs');
  readonly node = this.picture.node;

  draw(frame: Frame): void {
    const {now, colours} = frame;
    const {pose} = now.at;
    const metres = this.picture.begin(span_of(frame), colours.ground);
    if (now.kind === 'dozer') {
      const half = 0.5 * blade_width(now.machine);
      const strip: Vector2[] = [[0, half], [now.machine.length_m, half],
        [now.machine.length_m, -half], [0, -half]];
      this.picture.area(strip.map((point) => metres.at(turned(point))), `${colours.design}33`,
        colours.design, LINE);
      this.machine(now.at.pose === null ? [] : dozer_above(now.machine, now.at.pose), metres, frame);
    } else {
      this.built(metres, frame);
      this.task(metres, frame);
      this.machine(now.at.pose === null ? [] : excavator_above(now.machine, now.at.pose), metres, frame);
      this.bounds(metres, frame, pose === null || now.at.pose === null ? 0 : now.at.pose.position_m[2]);
    }
    this.picture.scale(metres, colours.text);
  }

  private machine(shapes: readonly Flat[], metres: Metres, {colours, old}: Frame): void {
    for (const {outline, paint} of shapes) {
      this.picture.area(outline.map((point) => metres.at(turned(point))),
        old ? colours.stale : paint, colours.edge);
    }
  }

  /// Ground that the edge has cut, by how far it is off the design: cut and fill in colours.
  private built(metres: Metres, {now, task, ground, colours}: Frame): void {
    const design = now.kind === 'excavator' ? design_of(shown_task(now.machine, task)) : null;
    if (design === null) {
      return;
    }
    const paint = {over: colours.over, under: colours.under, on: colours.design};
    // A little more: no gaps between cells.
    const half = 0.52 * ground.grid.cell_m;
    ground.each_cut((x, y, z) => {
      const off_m = z - design(x, y);
      if (!Number.isNaN(off_m)) {
        const ring: Vector2[] = [[x - half, y - half], [x + half, y - half], [x + half, y + half],
          [x - half, y + half]];
        this.picture.area(ring.map((point) => metres.at(turned(point))), paint[built_as(off_m)]);
      }
    });
  }

  /// The lines of the task that runs.
  private task(metres: Metres, {now, task, colours}: Frame): void {
    const told = now.kind === 'excavator' ? shown_task(now.machine, task) : null;
    for (const {straight, from, to} of told?.steps ?? []) {
      this.picture.line([from, to].map(({position_m}) => metres.at(turned(position_m))),
        colours.path, straight ? LINE : 2, straight ? [] : [6, 6]);
    }
  }

  private bounds(metres: Metres, {now, task, colours}: Frame, z_m: number): void {
    for (const fence of now.kind === 'excavator' ? own_fences(shown_task(now.machine, task)) : []) {
      const bound = in_plan(fence, z_m);
      if (bound !== null) {
        draw_bound(this.picture, metres, bound, colours.fence);
      }
      const ring = ring_of(fence);
      if (ring.length > 0) {
        this.picture.area(ring.map((point) => metres.at(turned(point))), `${colours.fence}55`,
          colours.fence, LINE);
      }
    }
  }
}

function span_of({now}: Frame): Span {
  if (now.kind === 'dozer') {
    const x = now.at.pose?.body_m[0] ?? 0;
    return {u: [-ASIDE_M, ASIDE_M], v: [x - BEHIND_M, x + AHEAD_M]};
  }
  const far = 0.95 * reach_m(now.machine);
  return now.machine.has_swing ? {u: [-0.8 * far, 0.8 * far], v: [-0.35 * far, far]}
    : {u: [-0.4 * far, 0.4 * far], v: [-0.3 * far, far]};
}
