// SPDX-License-Identifier: Apache-2.0
/// A dozer whose blade tilts, seen from behind: roll, tilt, the ground and the design across the
/// track, and how far both ends of the edge are off the design.

import type {DozerMachine, Machine, Vector2} from '../../model/api';
import {type DozerAcross, design_line, type EdgePoint, slope_of} from '../../model/dozer_across';
import {dozer_behind} from '../../scene/figure';
import type {HeightField} from '../../scene/height_field';
import {type AcrossNow, dozer_across_now} from '../../scene/machine_state';
import {type SceneColours, scene_colours} from '../../scene/theme';
import {el, section, set_shown, set_text} from '../basics/dom';
import {fixed} from '../basics/format';
import type {PageState, View} from '../basics/page_state';
import {type Metres, Picture, type Span} from '../basics/picture';
import type {ThemeSwitch} from '../basics/theme';

/// Beyond either end of the edge, m: room for its digits.
const ASIDE_M = 1.05;
const BELOW_M = 0.5;
const ABOVE_M = 1.55;
const BEYOND_M = 0.3;
const GROUND_STEP_M = 0.05;
const LINE = 2.5;
const DIGITS_PX = 12;
const BORDER_PX = 5;
/// So near is on the design: what a dozer is held to (README, Numbers).
const ON_GRADE_MM = 10;

/// What the view reads of the scene and its switches.
export interface Shown {
  ground(): HeightField | null;
  design(): boolean;
}

export const tilts = (machine: Machine | null): machine is DozerMachine =>
  machine?.kind === 'dozer' && machine.tilt !== undefined;

export class BehindView implements View {
  private readonly picture = new Picture('behind',
    'The machine from behind, with ground, design and the blade\u2019s edge; its figures are below');
  private readonly ends = el('p', {class: 'ends'});
  private readonly slopes = el('p', {class: 'quiet'});
  readonly node = section('behind', 'From behind', this.picture.node, this.ends, this.slopes);

  constructor(private readonly theme: ThemeSwitch, private readonly shown: Shown) {}

  update({machine, store, playhead: {now_s}, is_gone}: PageState): void {
    const offered = tilts(machine) && store.database?.kind === 'dozer';
    set_shown(this.node, offered);
    if (!offered) {
      return;
    }
    const {across, stale} = dozer_across_now(machine, store, now_s);
    const now: AcrossNow = {across, stale: stale || is_gone};
    this.node.classList.toggle('stale', now.stale);
    const {ends, slopes} = behind_words(now);
    set_text(this.ends, ends);
    set_text(this.slopes, slopes);
    this.draw(machine, now);
  }

  private draw(machine: DozerMachine, {across, stale}: AcrossNow): void {
    const colours = scene_colours(this.theme.dark);
    const half = 0.5 * machine.tilt!.edge_width_m;
    const metres = this.picture.begin(behind_span(half, across), colours.background);
    if (across === null) {
      return;
    }
    const line = (points: readonly Vector2[], colour: string): void =>
      this.picture.line(points.map((point) => metres.at(point)), colour, LINE);
    this.ground(metres, across, colours);
    for (const {outline, paint} of dozer_behind(machine, across)) {
      this.picture.area(outline.map((point) => metres.at(point)), stale ? colours.stale : paint,
        colours.edge, 1);
    }
    if (this.shown.design() && Number.isFinite(across.middle.off_m)) {
      line(design_line(across, BEYOND_M), colours.design);
    }
    line([across.left.at_m, across.right.at_m], stale ? colours.stale : colours.trail);
    this.digits(metres, across.left, 'left', stale);
    this.digits(metres, across.right, 'right', stale);
    this.picture.scale(metres, colours.text, 12);
  }

  private ground(metres: Metres, across: DozerAcross, colours: SceneColours): void {
    const field = this.shown.ground();
    if (field === null) {
      return;
    }
    const {u, v} = metres.seen;
    const profile = ground_behind(field, across, u);
    this.picture.area([[u[0], v[0]] as Vector2, ...profile, [u[1], v[0]] as Vector2]
      .map((point) => metres.at(point)), colours.cut);
    this.picture.line(profile.map((point) => metres.at(point)), colours.text, 1.5);
  }

  /// Beside that end, from the picture's border inwards: there is room for four digits.
  private digits(metres: Metres, {at_m, off_m}: EdgePoint, end: 'left' | 'right', stale: boolean): void {
    const [, y] = metres.at(at_m);
    const side = Math.abs(1000 * off_m) <= ON_GRADE_MM ? 'on-grade' : off_m > 0 ? 'over' : 'under';
    this.picture.words(off_digits(off_m),
      [end === 'left' ? BORDER_PX : metres.width - BORDER_PX, y - DIGITS_PX],
      this.theme.colour(stale || !Number.isFinite(off_m) ? 'muted' : side), DIGITS_PX,
      end === 'left' ? 'right' : 'left', scene_colours(this.theme.dark).halo);
  }
}

/// What the picture has to hold: wherever the edge is, body and ground with it.
export function behind_span(half_width_m: number, across: DozerAcross | null): Span {
  const aside = half_width_m + ASIDE_M;
  const [low, high] = across === null ? [0, 0] :
    [Math.min(across.body_m, across.middle.at_m[1]), Math.max(across.body_m, across.middle.at_m[1])];
  return {u: [-aside, aside], v: [low - BELOW_M, Math.max(high, low + 0.3) + ABOVE_M]};
}

/// The ground under the edge's line, from one place of the picture to another; level where nobody
/// knows it.
export function ground_behind(
  field: HeightField, {beside}: DozerAcross, [from, to]: readonly [number, number]): Vector2[] {
  const points: Vector2[] = [];
  for (let u = from; u <= to + GROUND_STEP_M; u += GROUND_STEP_M) {
    const z = field.shown_at(...beside(u));
    points.push([u, Number.isNaN(z) ? 0 : z]);
  }
  return points;
}

/// Above is positive.
export function off_digits(off_m: number): string {
  const mm = Math.round(1000 * off_m);
  return Number.isFinite(mm) ? `${mm > 0 ? '+' : ''}${fixed(mm, 0)}\u00a0mm` : '\u2013';
}

const DEGREE = 180 / Math.PI;

/// `left up`, where a slope has a side to go up to.
const to_side = (left_up: number, digits: number, unit: string): string => {
  const size = fixed(Math.abs(left_up), digits);
  return Number(size) === 0 ? `${size}${unit}` : `${size}${unit}\u00a0${left_up > 0 ? 'left' : 'right'}\u00a0up`;
};

export function behind_words({across, stale}: AcrossNow): {ends: string; slopes: string} {
  if (across === null) {
    return {ends: 'Roll and tilt are not known', slopes: ''};
  }
  const {left, middle, right} = across;
  const slope = (100 * slope_of([left.at_m, right.at_m]));
  const parts = [`Roll ${to_side(DEGREE * across.roll_rad, 1, '°')}`,
    `blade\u2019s tilt ${to_side(DEGREE * across.tilt_rad, 1, '°')}`,
    `edge ${to_side(slope, 1, '\u00a0%')}`];
  if (Number.isFinite(middle.off_m)) {
    parts.push(`design ${to_side(100 * slope_of(design_line(across, 0)), 1, '\u00a0%')}`);
  }
  return {
    ends: (Number.isFinite(middle.off_m) ?
      `Off the design: left ${off_digits(left.off_m)}, right ${off_digits(right.off_m)}` :
      'The edge is beside the grade') + (stale ? ' (old)' : ''),
    slopes: parts.join(', ')};
}
