// SPDX-License-Identifier: Apache-2.0
/// The bucket's teeth or the blade's edge, frame by frame.

import type {DozerMachine, ExcavatorMachine, FrameStore, Vector3} from '../model/api';
import {dozerPose} from '../model/dozer';
import {dozerAcross} from '../model/dozer_across';
import {excavatorPose} from '../model/excavator';
import type {Edge} from './height_field';
import {SignalWalk} from './measured';
import type {EdgeWalk} from './terrain_history';

/// A walk over the frames of one message, with a value of each of the signals at their times.
function walk_over(
  store: FrameStore, message: string, signals: readonly string[], after_s: number,
  edge_of: (values: readonly number[]) => Edge | null): EdgeWalk {
  const rows = store.rows(message);
  const walks = signals.map((signal) => new SignalWalk(store, signal, after_s));
  let index = rows.at(after_s);
  return {
    next: () => (++index < rows.count ? rows.time(index) : NaN),
    edge: () => {
      const time = rows.time(index);
      const values = walks.map((walk) => walk.at(time));
      return values.some(Number.isNaN) ? null : edge_of(values);
    },
  };
}

export const teeth_walk = (machine: ExcavatorMachine) =>
  (store: FrameStore, after_s: number): EdgeWalk => {
    const signals = ['BoomStroke.BoomStroke', 'ArmStroke.ArmStroke', 'BucketStroke.BucketStroke'];
    if (machine.has_swing) {
      signals.push('SwingState.SwingAngle');
    }
    return walk_over(store, 'BoomStroke', signals, after_s, ([boom, arm, bucket, swing = 0]) => {
      const pose = excavatorPose(machine, [boom!, arm!, bucket!], swing);
      return pose && {
        x_m: pose.position_m[0], y_m: pose.position_m[1], z_m: pose.position_m[2],
        heading_rad: swing, drives: [boom!, arm!, bucket!, swing], tilt_rad: pose.attitude_rad};
    });
  };

/// What a bucket in the ground has to overcome at least, N; the empty one's error is less.
const kResists_n = 4e3;
const kTipLoad = ['TipForceOutwards', 'TipForceUp', 'TipForceDeviation', 'PayloadMass',
  'PayloadDeviation'].map((name) => `EcuTipLoad.${name}`);

/// The same with what the controller tells of the bucket's load.
export const bucket_walk = (machine: ExcavatorMachine) =>
  (store: FrameStore, after_s: number): EdgeWalk => {
    const teeth = teeth_walk(machine)(store, after_s);
    const loads = kTipLoad.map((signal) => new SignalWalk(store, signal, after_s));
    let time_s = NaN;
    return {
      next: () => (time_s = teeth.next()),
      edge: () => {
        const edge = teeth.edge();
        const [out, up, force, payload, deviation] = loads.map((walk) => walk.at(time_s));
        return edge && {...edge, bucket: {
          payload_kg: payload!, deviation_kg: deviation!,
          resists: Math.hypot(out!, up!) > Math.max(kResists_n, 3 * force!)}};
      },
    };
  };

const kBlade = ['BodyPosition.Position', 'BodyPosition.Height', 'BodyPitch.Pitch',
  'BladeStroke.BladeStroke'];

export const blade_walk = (machine: DozerMachine) =>
  (store: FrameStore, after_s: number): EdgeWalk => {
    if (machine.tilt !== undefined) {
      return tilting_walk(machine, store, after_s);
    }
    return walk_over(store, 'BladeStroke', kBlade, after_s, ([along, height, pitch, stroke]) => {
      const pose = dozerPose(machine, {
        position_m: along!, height_m: height!, pitch_rad: pitch!, blade_stroke_m: stroke!});
      return pose && {x_m: pose.edge_m[0], y_m: 0, z_m: pose.edge_m[1], heading_rad: 0};
    });
  };

/// As it lies on the track, from end to end.
function tilting_walk(machine: DozerMachine, store: FrameStore, after_s: number): EdgeWalk {
  const signals = [...kBlade, 'TiltState.TiltStroke', 'TiltState.Roll'];
  if (machine.curvature !== undefined) {
    signals.push('BodyCourse.Offset', 'BodyCourse.Heading');
  }
  return walk_over(store, 'BladeStroke', signals, after_s,
    ([along, height, pitch, stroke, tilt_stroke, roll, offset = 0, heading = 0]) => {
      const across = dozerAcross(machine, {
        position_m: along!, height_m: height!, pitch_rad: pitch!, blade_stroke_m: stroke!,
        tilt_stroke_m: tilt_stroke!, roll_rad: roll!, offset_m: offset, heading_rad: heading});
      if (across === null) {
        return null;
      }
      const [left, middle, right] = [across.left, across.middle, across.right].map(({place_m}) => place_m) as
        [Vector3, Vector3, Vector3];
      const [dx, dy, dz] = [0, 1, 2].map((i) => left[i]! - right[i]!) as [number, number, number];
      return {x_m: middle[0], y_m: middle[1], z_m: middle[2], heading_rad: Math.atan2(-dx, dy),
        left_up: dz / Math.hypot(dx, dy)};
    });
}
