// SPDX-License-Identifier: Apache-2.0
/// Velocities of a drive: as it moves, and as lambda leaves them of what was wanted. Lambda times
/// wanted is what the real one should be.

import type {Curve, FrameStore, Kind} from '../../model/api';
import {drive_signals, followed_velocity, velocity, velocity_curve} from '../../model/motion';
import type {DriveSignals} from '../../model/motion';
import type {Trace} from './traces';

function drive_of(kind: Kind, name: string): DriveSignals {
  const drive = drive_signals(kind, true).find((one) => one.name === name);
  if (drive === undefined) {
    throw new RangeError(`a ${kind} has no drive ${name}`);
  }
  return drive;
}

/// Faster, in mm/s or mrad/s, no drive goes: what was measured jumped, as where a simulation begins
/// anew. It would leave no room on the axis for what is a velocity.
const MOST = 1500;

function without_jumps(curve: Curve): Curve {
  return curve.value.every((value) => !(Math.abs(value) > MOST)) ? curve : {
    time_s: curve.time_s,
    value: curve.value.map((value) => (Math.abs(value) > MOST ? NaN : value)),
  };
}

export function moved_trace(kind: Kind, name: string): Trace {
  const {measured} = drive_of(kind, name);
  return {
    message: measured.split('.')[0]!,
    signals: [measured],
    curve: (store, from_s, until_s, buckets) =>
      without_jumps(velocity_curve(store, measured, from_s, until_s, buckets)),
    reading(store, time_s) {
      const reading = velocity(store, measured, time_s);
      return Math.abs(reading.value) > MOST
        ? {...reading, value: NaN, state: 'notAvailable' as const} : reading;
    },
  };
}

export function followed_trace(kind: Kind, name: string): Trace {
  const drive = drive_of(kind, name);
  return {
    message: drive.wanted.split('.')[0]!,
    signals: drive.scaled_by_lambda ? [drive.wanted, 'EcuStatus.Lambda'] : [drive.wanted],
    curve: (store, from_s, until_s, buckets) =>
      scaled(store, drive, store.curve(drive.wanted, from_s, until_s, buckets)),
    reading: (store, time_s) => followed_velocity(store, drive, time_s),
  };
}

function scaled(store: FrameStore, drive: DriveSignals, wanted: Curve): Curve {
  if (!drive.scaled_by_lambda) {
    return wanted;
  }
  const value = wanted.value.map((velocity, k) =>
    velocity * store.reading('EcuStatus.Lambda', wanted.time_s[k]!).value);
  return {time_s: wanted.time_s, value};
}
