// SPDX-License-Identifier: Apache-2.0
/// Where the controller wants the machine to be, as far as the bus and the setup tell: the ghost
/// beside the machine.

import type {
  DozerMachine, ExcavatorMachine, FrameStore, Pose, Task, Vector2, Vector3,
} from './api';
import {dozerPoseWithEdgeOn, type DozerPose, type DozerState} from './dozer';
import {drivesFromPose, excavatorPose, type Drives} from './excavator';
import {clamp, wrap_near} from './geometry';

/// Numbers of EcuStatus.Mode, OperatorCommand.Task and TaskStatus.StepKind.
const ACTIVE = 3;
const DIG = 1;
const GRADE = 2;
const PROGRAM = 3;
const APPROACH = 1;
const DONE = 7;

/// How far ahead on the path the ghost is; about what spool lag and oil take to follow.
const LEAD_S = 0.25;
/// Older than this, a signal tells nothing of now.
const FRESH_S = 0.5;

export interface WantedExcavator {
  pose: Pose;
  drives: Drives | null;  ///< Null where no cylinders give the pose.
}

/// The value at a time, NaN where it is not valid or too old.
export function fresh(store: FrameStore, signal: string, time_s: number): number {
  const reading = store.reading(signal, time_s);
  return reading.age_s <= FRESH_S ? reading.value : NaN;
}

/// Null while the controller follows nothing, and on the way to a task's first pose, which only it
/// knows.
export function wantedExcavator(
  store: FrameStore, machine: ExcavatorMachine, time_s: number): WantedExcavator | null {
  if (fresh(store, 'EcuStatus.Mode', time_s) !== ACTIVE) {
    return null;
  }
  switch (fresh(store, 'OperatorCommand.Task', time_s)) {
    case DIG: return wanted_on_path(store, machine, time_s);
    case PROGRAM: return wanted_of_task(store, machine, time_s);
    default: return null;
  }
}

/// The body as it is, its cutting edge on the design.
export function wantedDozer(
  store: FrameStore, machine: DozerMachine, time_s: number): DozerPose | null {
  const grades = fresh(store, 'EcuStatus.Mode', time_s) === ACTIVE &&
    fresh(store, 'OperatorCommand.Task', time_s) === GRADE;
  return grades ? dozerPoseWithEdgeOn(machine, dozerState(store, time_s),
    (x_m) => designHeight(machine.design, x_m)) : null;
}

/// As the frames have it; NaN where they do not.
export function dozerState(store: FrameStore, time_s: number): DozerState {
  const value = (signal: string): number => store.reading(signal, time_s).value / 1000;
  return {
    position_m: value('BodyPosition.Position'), height_m: value('BodyPosition.Height'),
    pitch_rad: value('BodyPitch.Pitch'), blade_stroke_m: value('BladeStroke.BladeStroke'),
  };
}

/// As the frames have it; NaN where they do not, but 0 for the swing of a machine that has none.
export function excavatorDrives(
  store: FrameStore, machine: ExcavatorMachine, time_s: number): Drives {
  const value = (signal: string): number => store.reading(signal, time_s).value / 1000;
  return [
    value('BoomStroke.BoomStroke'), value('ArmStroke.ArmStroke'),
    value('BucketStroke.BucketStroke'), machine.has_swing ? value('SwingState.SwingAngle') : 0,
  ];
}

/// Height of a design; before its first point and after its last one it goes on level.
export function designHeight(design: readonly Vector2[], x_m: number): number {
  let [after, end] = [0, design.length];  // The first point behind x.
  while (after < end) {
    const middle = (after + end) >> 1;
    if (design[middle][0] > x_m) {
      end = middle;
    } else {
      after = middle + 1;
    }
  }
  if (after === 0 || after === design.length) {
    return design[Math.max(after - 1, 0)]?.[1] ?? NaN;
  }
  const [x0, z0] = design[after - 1];
  const [x1, z1] = design[after];
  return z0 + (z1 - z0) * (x_m - x0) / (x1 - x0);
}

function wanted_on_path(
  store: FrameStore, machine: ExcavatorMachine, time_s: number): WantedExcavator | null {
  const [boom, arm, bucket, swing] = excavatorDrives(store, machine, time_s);
  const now = excavatorPose(machine, [boom, arm, bucket], swing);
  const {path, speed_mps} = machine.dig;
  if (now === null || path.length < 2) {
    return null;
  }
  const share = fresh(store, 'EcuStatus.Lambda', time_s) *
    fresh(store, 'OperatorCommand.SpeedOverride', time_s) / 100;
  const lead_m = Number.isFinite(share) ? speed_mps * share * LEAD_S : 0;
  const reach = Math.hypot(now.position_m[0], now.position_m[1]);
  const [x, z, attitude] = ahead_on_path(path, [reach, now.position_m[2]], lead_m);
  const pose: Pose = {
    position_m: [x * Math.cos(swing), x * Math.sin(swing), z], attitude_rad: attitude};
  return {pose, drives: with_swing(drivesFromPose(machine, pose), swing)};
}

const with_swing = (drives: Drives | null, swing_rad: number): Drives | null =>
  drives && [drives[0], drives[1], drives[2], swing_rad];

/// From the path's nearest point to `from_m` so far on along it; the path is closed.
export function ahead_on_path(path: readonly Vector3[], from_m: Vector2, lead_m: number): Vector3 {
  let nearest = Infinity;
  let [segment, share] = [0, 0];
  for (let i = 0; i + 1 < path.length; ++i) {
    const at = share_nearest(path[i], path[i + 1], from_m);
    const [x, z] = between(path[i], path[i + 1], at);
    const distance = Math.hypot(x - from_m[0], z - from_m[1]);
    if (distance < nearest) {
      [nearest, segment, share] = [distance, i, at];
    }
  }
  let left_m = lead_m;
  // Bounded, for a path whose points are all one.
  for (let steps = 0; steps < 2 * path.length; ++steps) {
    const [from, to] = [path[segment], path[segment + 1]];
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (left_m <= length * (1 - share)) {
      return between(from, to, length > 0 ? share + left_m / length : share);
    }
    left_m -= length * (1 - share);
    segment = (segment + 1) % (path.length - 1);
    share = 0;
  }
  return path[segment];
}

function share_nearest(from: Vector3, to: Vector3, at: Vector2): number {
  const [dx, dz] = [to[0] - from[0], to[1] - from[1]];
  const square = dx * dx + dz * dz;
  const along = (at[0] - from[0]) * dx + (at[1] - from[1]) * dz;
  return square > 0 ? clamp(along / square, 0, 1) : 0;
}

/// x and z, and the attitude in the turn of the first one's.
function between(from: Vector3, to: Vector3, share: number): Vector3 {
  const turn = wrap_near(to[2] - from[2], 0);
  return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]),
    from[2] + share * turn];
}

/// The task that runs, by TaskStatus; null where none does or the setup does not have it.
export function runningTask(
  store: FrameStore, machine: ExcavatorMachine, time_s: number): Task | null {
  return machine.tasks[fresh(store, 'TaskStatus.TaskNumber', time_s)] ?? null;
}

function wanted_of_task(
  store: FrameStore, machine: ExcavatorMachine, time_s: number): WantedExcavator | null {
  const task = runningTask(store, machine, time_s);
  const kind = fresh(store, 'TaskStatus.StepKind', time_s);
  const step = task?.steps[fresh(store, 'TaskStatus.Step', time_s)];
  const share = kind === DONE ? 1 : fresh(store, 'TaskStatus.Progress', time_s);
  if (step === undefined || kind === APPROACH || !Number.isFinite(share)) {
    return null;
  }
  const at = (from: number, to: number): number => from + share * (to - from);
  const drives = step.from_drives.map((from, i) => at(from, step.to_drives[i])) as
    unknown as Drives;
  if (!step.straight) {
    const pose = excavatorPose(machine, [drives[0], drives[1], drives[2]], drives[3]);
    return pose && {pose, drives};
  }
  const {from, to} = step;
  const pose: Pose = {
    position_m: [0, 1, 2].map((i) => at(from.position_m[i], to.position_m[i])) as
      unknown as Vector3,
    attitude_rad: at(from.attitude_rad, to.attitude_rad),
  };
  return {pose, drives: drivesFromPose(machine, pose)};
}
