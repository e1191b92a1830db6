// SPDX-License-Identifier: Apache-2.0
/// How far the teeth or the blade's edge are off what they are to make.

import type {
  DozerMachine, ExcavatorMachine, FrameStore, Machine, Task, Vector2, Vector3,
} from '../model/api';
import {ahead_on_path, designHeight, fresh} from '../model/wanted';
import {fixed} from '../view/basics/format';
import {dozer_state, excavator_state} from '../scene/machine_state';
import type {ShownTask} from '../scene/shown_task';
import {design_of, type HeightAt} from './design';

/// So near is on it: what a dozer is held to (README, Numbers).
export const ON_GRADE_M = 0.01;

export interface Off {
  off_m: number;  ///< Upwards; of a closed path inwards, where there is soil left.
  /// 'design': a surface, vertically. 'path': the closed path, the shortest way. 'line': a straight
  /// step of a task, vertically.
  from: 'design' | 'path' | 'line';
}

/// Null where nothing is to be made here, or where the edge is not known now.
export function off_of(
  machine: Machine, store: FrameStore, now_s: number, task: ShownTask,
): Off | null {
  if (store.database === null || store.database.kind !== machine.kind) {
    return null;
  }
  return machine.kind === 'dozer' ? off_grade(machine, store, now_s)
    : off_task(machine, store, now_s, task);
}

const ACTIVE = 3;  ///< EcuStatus.Mode.

/// While the controller grades, what it says itself: it knows where the edge is to within a cycle,
/// which over the steep parts of a design is more than its frames tell.
function off_grade(machine: DozerMachine, store: FrameStore, now_s: number): Off | null {
  const off_m = edge_off(machine, store, now_s);
  const told_m = fresh(store, 'EcuStatus.Mode', now_s) === ACTIVE
    ? 1e-3 * fresh(store, 'EcuGrade.GradeError', now_s) : NaN;
  return off_m === null ? null
    : {off_m: Number.isFinite(told_m) ? told_m : off_m, from: 'design'};
}

/// As the measured pose has it; null where the edge is not on the grade or not known.
export function edge_off(machine: DozerMachine, store: FrameStore, now_s: number): number | null {
  const {pose, stale} = dozer_state(machine, store, now_s);
  if (pose === null || stale.blade) {
    return null;
  }
  const [x, z] = pose.edge_m;
  return x < 0 || x > machine.length_m ? null : z - designHeight(machine.design, x);
}

function off_task(
  machine: ExcavatorMachine, store: FrameStore, now_s: number, task: ShownTask,
): Off | null {
  const {pose, stale} = excavator_state(machine, store, now_s);
  if (pose === null || stale.bucket || task === 'none') {
    return null;
  }
  const teeth = pose.position_m;
  if (task === 'dig') {
    const reach: Vector2 = [Math.hypot(teeth[0], teeth[1]), teeth[2]];
    return {off_m: off_path(machine.dig.path, reach), from: 'path'};
  }
  const told = machine.tasks[task];
  if (told === undefined) {
    return null;
  }
  if (told.surface) {
    return off_surface(design_of(told)!, machine, pose.swing_rad, teeth);
  }
  return told.design !== null ? {off_m: off_plane(told.design, teeth), from: 'design'}
    : off_step(told, fresh(store, 'TaskStatus.Step', now_s), teeth);
}

/// Vertically, of the lowest of the edge's middle and its corners; null beyond the design's border.
function off_surface(
  design: HeightAt, machine: ExcavatorMachine, swing_rad: number, [x, y, z]: Vector3): Off | null {
  const half = 0.5 * (machine.bucket_width_m ?? 0);
  const off = [-half, 0, half].map((aside) =>
    z - design(x - aside * Math.sin(swing_rad), y + aside * Math.cos(swing_rad)));
  return off.some(Number.isNaN) ? null : {off_m: Math.min(...off), from: 'design'};
}

/// Along the vertical.
export function off_plane({through_m, up}: NonNullable<Task['design']>, at_m: Vector3): number {
  const out = up.reduce((sum, part, i) => sum + part * (at_m[i]! - through_m[i]!), 0);
  return out / up[2];
}

/// Of a closed path over reach and height: positive inside of it.
export function off_path(path: readonly Vector3[], at_m: Vector2): number {
  const [x, z] = ahead_on_path(path, at_m, 0);
  const far = Math.hypot(at_m[0] - x, at_m[1] - z);
  return is_inside(path, at_m) ? far : -far;
}

function is_inside(path: readonly Vector3[], [x, z]: Vector2): boolean {
  let inside = false;
  for (let i = 0; i + 1 < path.length; ++i) {
    const [x0, z0] = path[i]!;
    const [x1, z1] = path[i + 1]!;
    if ((z0 > z) !== (z1 > z) && x < x0 + (x1 - x0) * (z - z0) / (z1 - z0)) {
      inside = !inside;
    }
  }
  return inside;
}

/// Over the line of the step that runs, where that is straight and goes along the ground.
function off_step(task: Task, number: number, at_m: Vector3): Off | null {
  const step = task.steps[number];
  if (step === undefined || !step.straight) {
    return null;
  }
  const [from, to] = [step.from.position_m, step.to.position_m];
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const square = dx * dx + dy * dy;
  if (!(square > 0)) {
    return null;
  }
  const share = ((at_m[0] - from[0]) * dx + (at_m[1] - from[1]) * dy) / square;
  return share < 0 || share > 1 ? null
    : {off_m: at_m[2] - from[2] - share * (to[2] - from[2]), from: 'line'};
}

export interface OffWords {
  digits: string;  ///< At most three, and a point.
  unit: string;
  word: string;
  side: 'over' | 'under' | 'on' | 'unknown';
}

const WORDS = {
  design: {over: 'Cut', under: 'Fill', on: 'On grade'},
  line: {over: 'Above line', under: 'Below line', on: 'On line'},
  path: {over: 'Inside path', under: 'Outside path', on: 'On path'},
} as const;

/// Millimetres up to a metre, then metres. `null`: nothing to say.
export function off_words(off: Off | null): OffWords {
  if (off === null || !Number.isFinite(off.off_m)) {
    return {digits: '–', unit: '', word: 'No design here', side: 'unknown'};
  }
  const size_m = Math.abs(off.off_m);
  const mm = Math.round(1000 * size_m);
  const side = mm <= 1000 * ON_GRADE_M ? 'on' : off.off_m > 0 ? 'over' : 'under';
  const near = mm < 1000;
  return {
    digits: near ? String(mm) : fixed(size_m, size_m < 9.95 ? 1 : 0),
    unit: near ? 'mm' : 'm', word: WORDS[off.from][side], side};
}

/// Lights on either side of the middle.
export const LIGHTS = 5;
/// From here on each of them is lit, m.
const STEPS_M = [ON_GRADE_M, 0.02, 0.04, 0.08, 0.16];

/// How many lights are lit, above the middle positive; 0 is the middle alone.
export function lights_of(off: Off | null): number | null {
  if (off === null || !Number.isFinite(off.off_m)) {
    return null;
  }
  const mm = Math.round(1000 * Math.abs(off.off_m)) / 1000;
  const lit = STEPS_M.filter((step) => mm > step).length;
  return off.off_m > 0 ? lit : 0 - lit;
}
