// SPDX-License-Identifier: Apache-2.0
/// Strokes of a machine on a bus of its own, from what that bus tells of its links: strokes, joint
/// angles, or slopes against the horizontal. The profile of the bus says where they are.

import type {BusMessage, BusSignal, ExcavatorMachine, MessageDef} from './api';
import {identity_of, type SignalLayout} from './dbc';
import {EXTENDED} from './frame_block';
import {strokes_of} from './imu_strokes';
import {Series} from './series';
import {append_strokes} from './stroke_frames';

/// What is older says nothing of now.
const GAP_S = 0.3;
const LINKS = 3;
const BODY = 3;

type Told = Partial<Record<BusSignal['tells'], Map<number, number>>>;

/// The field's number; `at`: of the frame's first byte.
export function raw_of({start, width, motorola, signed}: BusSignal, buffer: Uint8Array, at: number): number {
  let raw = 0;
  let bit = start;
  for (let n = 0; n < width; ++n) {
    const one = buffer[at + (bit >> 3)]! >> (bit & 7) & 1;
    raw = motorola ? 2 * raw + one : raw + one * 2 ** n;
    bit = !motorola ? bit + 1 : (bit & 7) === 0 ? bit + 15 : bit - 1;
  }
  return signed && raw >= 2 ** (width - 1) ? raw - 2 ** width : raw;
}

/// As the controller has it (hal/can_frame.hpp): of 29 bits PGN and source count, and source FE is
/// any.
function is_named_by(key: number, id: number, extended: boolean): boolean {
  if (!extended || key < EXTENDED) {
    return !extended && key === id;
  }
  const any = (id & 0xff) === 0xfe ? 0xff : 0;
  return (identity_of(key - EXTENDED) | any) === (identity_of(id) | any);
}

/// Goes on as frames come, by every frame of the bus' first message of links.
export class BusEstimate {
  private read = 0;  ///< Of that message, ever.

  constructor(private readonly machine: ExcavatorMachine) {}

  /// Appends to `into`, a series for each of the strokes, what the frames among `all` give anew.
  go_on(all: Iterable<Series>, strokes: readonly MessageDef[], into: readonly Series[]): void {
    const {messages} = this.machine.bus!;
    const kept = [...all];
    const sent = messages.map(({id, extended, length}) =>
      kept.find((one) => one.length === length && is_named_by(one.key, id, extended)));
    const leader = sent[0];
    if (leader === undefined) {
      return;
    }
    const time_s: number[] = [];
    const found: (readonly number[])[] = [];
    for (let row = Math.max(0, leader.count - (leader.seen - this.read)); row < leader.count; ++row) {
      const now_s = leader.time(row);
      const drives = this.strokes_in(this.told(messages, sent, now_s));
      if (drives !== null) {
        time_s.push(now_s);
        found.push(drives);
      }
    }
    this.read = leader.seen;
    append_strokes(strokes.map(({name, signals}) => signals.get(name) as SignalLayout), time_s, found, into);
  }

  private told(messages: readonly BusMessage[], sent: readonly (Series | undefined)[], now_s: number): Told {
    const told: Told = {};
    messages.forEach(({signals}, k) => {
      const series = sent[k];
      const row = series?.at(now_s) ?? -1;
      if (series === undefined || row < 0 || now_s - series.time(row) > GAP_S) {
        return;
      }
      const {buffer, at} = series.bytes(row);
      for (const signal of signals) {
        const value = raw_of(signal, buffer, at) * signal.scale + signal.offset;
        if (value >= signal.least && value <= signal.most) {
          (told[signal.tells] ??= new Map()).set(signal.of, value);
        }
      }
    });
    return told;
  }

  private strokes_in({stroke, joint_angle, slope}: Told): readonly number[] | null {
    const three = (values: Map<number, number> | undefined): readonly number[] | null => {
      const of = [...Array(LINKS).keys()].map((i) => values?.get(i) ?? NaN);
      return of.every(Number.isFinite) ? of : null;
    };
    const slopes = three(slope);
    const joints = three(joint_angle) ?? slopes?.map((value, i) =>
      value - (i > 0 ? slopes[i - 1]! : slope?.get(BODY) ?? 0)) ?? null;
    return three(stroke) ?? (joints === null ? null : strokes_of(this.machine, joints));
  }
}
