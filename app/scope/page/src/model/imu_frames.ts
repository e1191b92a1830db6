// SPDX-License-Identifier: Apache-2.0
/// Frames of IMUs by SAE J1939-71 (can_dbc/j1939.dbc): ARI (PGN 61482) and ACS (PGN 61485), and from
/// them the strokes that no frame tells.

import type {ExcavatorMachine, MessageDef, Vector2} from './api';
import type {SignalLayout} from './dbc';
import {EXTENDED} from './frame_block';
import {ImuStrokes, type ImuReading} from './imu_strokes';
import {Series} from './series';
import {append_strokes} from './stroke_frames';

const ARI = 0x0f02a;
const ACS = 0x0f02d;
const MOST_RAW = 0xfaff;  ///< Above it a word of J1939 is no number.
const RATE_RADPS = Math.PI / 180 / 128;
const RATE_LEAST_RADPS = 250 * Math.PI / 180;
const MOST_LATENCY_RAW = 250;
const LATENCY_S = 0.5e-3;

interface Sensor {
  rates: Series;
  forces: Series;
}

const word = (buffer: Uint8Array, at: number): number => {
  const raw = buffer[at]! | buffer[at + 1]! << 8;
  return raw <= MOST_RAW ? raw : NaN;
};

/// Of a sensor, as of the last frames until a time; null where one lacks or is no number.
function reading_of({rates, forces}: Sensor, time_s: number): ImuReading | null {
  const [row, of_force] = [rates.at(time_s), forces.at(time_s)];
  if (row < 0 || of_force < 0) {
    return null;
  }
  const told = rates.bytes(row);
  const rate = (byte: number): number => RATE_RADPS * word(told.buffer, told.at + byte) - RATE_LEAST_RADPS;
  const felt = forces.bytes(of_force);
  const force = (byte: number): number => 0.01 * word(felt.buffer, felt.at + byte) - 320;
  const late = told.buffer[told.at + 7]!;
  const reading = {
    time_s: rates.time(row) - (late <= MOST_LATENCY_RAW ? late * LATENCY_S : 0),
    rates_radps: [rate(0), rate(2), rate(4)] as const, force_mps2: [force(2), force(4)] as Vector2};
  return [...reading.rates_radps, ...reading.force_mps2].every(Number.isFinite) ? reading : null;
}

/// Goes on as frames come, by every frame of the boom's gyro.
export class ImuEstimate {
  private readonly strokes: ImuStrokes;
  private sensors: readonly Sensor[] | null = null;
  private read = 0;  ///< Of the boom's gyro, ever.

  constructor(private readonly machine: ExcavatorMachine) {
    this.strokes = new ImuStrokes(machine);
  }

  /// Appends to `into`, a series for each of the strokes, what the frames among `all` give anew.
  go_on(all: Iterable<Series>, strokes: readonly MessageDef[], into: readonly Series[]): void {
    this.sensors ??= this.find([...all]);
    if (this.sensors === null) {
      return;
    }
    const {rates} = this.sensors[0]!;
    const first = Math.max(0, rates.count - (rates.seen - this.read));
    this.read = rates.seen;
    const time_s: number[] = [];
    const found: (readonly number[])[] = [];
    for (let row = first; row < rates.count; ++row) {
      const now_s = rates.time(row);
      const readings = this.sensors.map((sensor) => reading_of(sensor, now_s));
      const drives = readings.some((reading) => reading === null) ? null
        : this.strokes.next(readings as ImuReading[], now_s);
      if (drives !== null) {
        time_s.push(now_s);
        found.push(drives);
      }
    }
    append_strokes(strokes.map(({name, signals}) => signals.get(name) as SignalLayout), time_s, found, into);
  }

  /// Null until each has sent both; the standard leaves their priorities open.
  private find(all: readonly Series[]): readonly Sensor[] | null {
    const {imus} = this.machine;
    const sent = (pgn: number, address: number): Series | undefined => all.find(({key, length}) =>
      length === 8 && key >= EXTENDED && ((key - EXTENDED) & 0x3ffffff) === ((pgn << 8) | address));
    const found = (imus === undefined ? [] : [imus.boom, imus.arm, imus.bucket]).map(({address}) =>
      ({rates: sent(ARI, address), forces: sent(ACS, address)}));
    return found.length > 0 && found.every(({rates, forces}) => rates !== undefined && forces !== undefined)
      ? found as Sensor[] : null;
  }
}
