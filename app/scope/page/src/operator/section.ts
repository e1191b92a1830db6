// SPDX-License-Identifier: Apache-2.0
/// The machine from the side, cut along where it works: ground, design, bucket or blade.

import type {DozerMachine, ExcavatorMachine, Vector2} from '../model/api';
import type {HeightField} from '../scene/height_field';
import {reach_m} from '../scene/soil_shape';
import {draw_bound, in_section, kept_out, own_fences, shown_task} from './bounds';
import {dozer_side, excavator_side, type Flat} from '../scene/figure';
import {design_lines, design_of} from './design';
import type {Frame} from './frame';
import {type Metres, Picture, type Span} from '../view/basics/picture';

/// Before and behind a dozer's edge, m.
const AHEAD_M = 3.2;
const BEHIND_M = 5;
const LINE = 4;

export class Section {
  private readonly picture = new Picture('section', 'The machine from the side, with ground and design');
  readonly node = this.picture.node;

  draw(frame: Frame): void {
    const {now, colours} = frame;
    const metres = this.picture.begin(
      now.kind === 'dozer' ? dozer_span(now.at.pose?.edge_m ?? [0, 0]) : excavator_span(now.machine),
      colours.background);
    const swing_rad = now.kind === 'excavator' ? now.at.pose?.swing_rad ?? 0 : 0;
    this.ground(metres, frame, swing_rad);
    if (now.kind === 'dozer') {
      this.line(metres, graded(now.machine), colours.design);
      this.machine(now.at.pose === null ? [] : dozer_side(now.machine, now.at.pose), metres, frame);
    } else {
      this.machine(now.at.pose === null ? [] : excavator_side(now.machine, now.at.pose), metres, frame);
      this.task(now.machine, metres, frame, swing_rad);
    }
    this.picture.scale(metres, colours.text);
  }

  private line(metres: Metres, points: readonly Vector2[], colour: string): void {
    this.picture.line(points.map((point) => metres.at(point)), colour, LINE);
  }

  private ground(metres: Metres, {ground, colours}: Frame, swing_rad: number): void {
    const {u, v} = metres.seen;
    const profile = profile_of(ground, swing_rad, u);
    this.picture.area([[u[0], v[0]] as Vector2, ...profile, [u[1], v[0]] as Vector2]
      .map((point) => metres.at(point)), colours.cut);
    this.line(metres, profile, colours.text);
  }

  private machine(shapes: readonly Flat[], metres: Metres, {colours, old}: Frame): void {
    for (const {outline, paint} of shapes) {
      this.picture.area(outline.map((point) => metres.at(point)), old ? colours.stale : paint,
        colours.edge);
    }
  }

  private task(
    machine: ExcavatorMachine, metres: Metres, frame: Frame, swing_rad: number): void {
    const {colours} = frame;
    if (frame.task === 'dig') {
      this.line(metres, machine.dig.path.map(([x, z]): Vector2 => [x, z]), colours.path);
      return;
    }
    const task = shown_task(machine, frame.task);
    for (const fence of own_fences(task)) {
      const bound = in_section(fence, swing_rad);
      if (bound !== null) {
        draw_bound(this.picture, metres, bound, colours.fence);
      }
      for (const [from, to] of kept_out(fence, swing_rad, reach_m(machine))) {
        const [z, half] = [fence.centre_m![2], fence.half_m![2]];
        this.picture.area(([[from, z - half], [to, z - half], [to, z + half], [from, z + half]] as
          Vector2[]).map((point) => metres.at(point)), `${colours.fence}55`, colours.fence, LINE);
      }
    }
    const design = design_of(task);
    for (const line of design === null ? [] : design_lines(design, swing_rad, metres.seen.u)) {
      this.line(metres, line, colours.design);
      const window_m = frame.assists ? machine.assist_window_m ?? 0 : 0;
      if (window_m > 0) {
        this.picture.line(line.map(([reach, z]) => metres.at([reach, z + window_m])), colours.design, 2,
          [10, 8]);
      }
    }
  }
}

const dozer_span = ([x, z]: Vector2): Span =>
  ({u: [x - BEHIND_M, x + AHEAD_M], v: [z - 1.2, z + 2.4]});

/// All that the teeth reach in front of the machine, and how deep its tasks go.
function excavator_span(machine: ExcavatorMachine): Span {
  const deep = Math.min(-1, ...machine.dig.path.map(([, z]) => z), ...machine.tasks.flatMap((task) =>
    task.steps.flatMap(({from, to}) => [from.position_m[2], to.position_m[2]])));
  return {u: [0, 0.9 * reach_m(machine)], v: [deep - 0.4, machine.boom_foot_m[1] + 0.2 * machine.boom_m]};
}

/// The grade from x = 0 to its end.
const graded = ({design, length_m}: DozerMachine): Vector2[] =>
  design.filter(([x]) => x >= 0 && x <= length_m).map(([x, z]): Vector2 => [x, z]);

/// Heights from one reach to another, beyond the field level.
export function profile_of(
  field: HeightField, swing_rad: number, [from, to]: readonly [number, number]): Vector2[] {
  const {cell_m} = field.grid;
  const points: Vector2[] = [];
  for (let reach = from; reach <= to + cell_m; reach += 0.5 * cell_m) {
    const z = field.shown_at(reach * Math.cos(swing_rad), reach * Math.sin(swing_rad));
    points.push([reach, Number.isNaN(z) ? 0 : z]);
  }
  return points;
}
