// SPDX-License-Identifier: Apache-2.0
/// Where the machine stands at a time, with what of it is still known.

import type {DozerMachine, ExcavatorMachine, FrameStore} from '../model/api';
import {type DozerPose, dozerPose} from '../model/dozer';
import {type DozerAcross, dozerAcross} from '../model/dozer_across';
import {type ExcavatorPose, excavatorPose} from '../model/excavator';
import {type Measured, measured} from './measured';

/// A part is stale where what places it on the part before it is, or that part is.
export interface ExcavatorState {
  pose: ExcavatorPose | null;  ///< Null: never placed, or the linkage can't be so.
  stale: {platform: boolean; boom: boolean; arm: boolean; bucket: boolean};
  /// Pa, cap and rod; NaN: not known.
  pressures_pa: Record<'boom' | 'arm' | 'bucket', readonly [number, number]>;
}

export interface DozerMachineState {
  pose: DozerPose | null;
  stale: {body: boolean; blade: boolean};
}

const kUnknown: ExcavatorState['pressures_pa'] =
  {boom: [NaN, NaN], arm: [NaN, NaN], bucket: [NaN, NaN]};

export function excavator_state(
  machine: ExcavatorMachine, store: FrameStore, now_s: number): ExcavatorState {
  const stroke = (axis: string): Measured => measured(store, `${axis}Stroke.${axis}Stroke`, now_s);
  const [boom, arm, bucket] = [stroke('Boom'), stroke('Arm'), stroke('Bucket')];
  const swing = machine.has_swing ?
    measured(store, 'SwingState.SwingAngle', now_s) : {value: 0, fresh: true};
  const platform_stale = !swing.fresh;
  const boom_stale = platform_stale || !boom.fresh;
  const arm_stale = boom_stale || !arm.fresh;
  const pressure = (axis: string, side: string): number => {
    const {value, fresh} = measured(store, `${axis}Pressure.${axis}${side}Pressure`, now_s);
    return fresh ? value : NaN;
  };
  const both = (axis: string): readonly [number, number] =>
    [pressure(axis, 'Cap'), pressure(axis, 'Rod')];
  return {
    pose: excavatorPose(machine, [boom.value, arm.value, bucket.value],
      Number.isNaN(swing.value) ? 0 : swing.value),
    stale: {
      platform: platform_stale, boom: boom_stale, arm: arm_stale,
      bucket: arm_stale || !bucket.fresh},
    pressures_pa: {boom: both('Boom'), arm: both('Arm'), bucket: both('Bucket')},
  };
}

export function dozer_state(
  machine: DozerMachine, store: FrameStore, now_s: number): DozerMachineState {
  const along = measured(store, 'BodyPosition.Position', now_s);
  const height = measured(store, 'BodyPosition.Height', now_s);
  const pitch = measured(store, 'BodyPitch.Pitch', now_s);
  const blade = measured(store, 'BladeStroke.BladeStroke', now_s);
  const body_stale = !(along.fresh && height.fresh && pitch.fresh);
  return {
    pose: dozerPose(machine, {
      position_m: along.value, height_m: height.value, pitch_rad: pitch.value,
      blade_stroke_m: blade.value}),
    stale: {body: body_stale, blade: body_stale || !blade.fresh},
  };
}

export interface AcrossNow {
  across: DozerAcross | null;  ///< Null: not known, or the blade does not tilt.
  stale: boolean;
}

export function dozer_across_now(
  machine: DozerMachine, store: FrameStore, now_s: number): AcrossNow {
  const value = (signal: string): Measured => measured(store, signal, now_s);
  const straight: Measured = {value: 0, fresh: true};
  const curves = machine.curvature !== undefined;
  const read = {
    position_m: value('BodyPosition.Position'), height_m: value('BodyPosition.Height'),
    pitch_rad: value('BodyPitch.Pitch'), blade_stroke_m: value('BladeStroke.BladeStroke'),
    tilt_stroke_m: value('TiltState.TiltStroke'), roll_rad: value('TiltState.Roll'),
    offset_m: curves ? value('BodyCourse.Offset') : straight,
    heading_rad: curves ? value('BodyCourse.Heading') : straight};
  return {
    across: dozerAcross(machine, {
      position_m: read.position_m.value, height_m: read.height_m.value,
      pitch_rad: read.pitch_rad.value, blade_stroke_m: read.blade_stroke_m.value,
      tilt_stroke_m: read.tilt_stroke_m.value, roll_rad: read.roll_rad.value,
      offset_m: read.offset_m.value, heading_rad: read.heading_rad.value}),
    stale: Object.values(read).some(({fresh}) => !fresh)};
}

/// A plan has no frames: its drives (strokes in m, swing in rad) are the machine.
export function planned_state(
  machine: ExcavatorMachine, drives: readonly number[]): ExcavatorState {
  const [boom = NaN, arm = NaN, bucket = NaN, swing = 0] = drives;
  return {
    pose: excavatorPose(machine, [boom, arm, bucket], swing),
    stale: {platform: false, boom: false, arm: false, bucket: false},
    pressures_pa: kUnknown,
  };
}
