// SPDX-License-Identifier: Apache-2.0
/// The way of the teeth or the edge over a stretch of time, its error over the way, and beside them
/// what a simulation knows.

import type {FrameStore, Machine, Run, Vector2} from './api';
import {dozerPose} from './dozer';
import {excavatorPose} from './excavator';
import {dozerState, excavatorDrives} from './wanted';

/// At one time: reach and height, m; the way so far, m; null: not known.
export interface Step {
  time_s: number;
  at_m: Vector2 | null;
  way_m: number;
}

/// A curve over the way or over the reach; null: a gap.
export type Points = (Vector2 | null)[];

/// As the measured strokes have it, at so many times of the window. Where nothing is known the way
/// does not go on.
export function way_of(
  machine: Machine, store: FrameStore, [from_s, until_s]: readonly [number, number], count: number,
): Step[] {
  const steps: Step[] = [];
  let last: Vector2 | null = null;
  let way_m = 0;
  for (let i = 0; i < count; ++i) {
    const time_s = from_s + (until_s - from_s) * i / Math.max(1, count - 1);
    const inside = time_s >= store.from_s && time_s <= store.until_s;
    const at_m = inside && store.database?.kind === machine.kind ? place(machine, store, time_s) : null;
    if (at_m !== null && last !== null) {
      way_m += Math.hypot(at_m[0] - last[0], at_m[1] - last[1]);
    }
    last = at_m ?? last;
    steps.push({time_s, at_m, way_m});
  }
  return steps;
}

function place(machine: Machine, store: FrameStore, time_s: number): Vector2 | null {
  if (machine.kind === 'dozer') {
    return dozerPose(machine, dozerState(store, time_s))?.edge_m ?? null;
  }
  const [boom, arm, bucket, swing] = excavatorDrives(store, machine, time_s);
  const teeth = excavatorPose(machine, [boom, arm, bucket], swing)?.position_m;
  return teeth === undefined ? null : [Math.hypot(teeth[0], teeth[1]), teeth[2]];
}

/// The simulation's own, within the window.
export function true_way(run: Run | undefined, [from_s, until_s]: readonly [number, number]): Points {
  const times = run?.truth.time_s ?? [];
  return (run?.way ?? []).filter((_, i) => times[i]! >= from_s && times[i]! <= until_s)
    .map(([x, y, z]): Vector2 => [Math.hypot(x, y), z]);
}

/// A signal over the way, in its own unit.
export function over_way(steps: readonly Step[], store: FrameStore, signal: string): Points {
  return steps.map(({time_s, at_m, way_m}) => {
    const {value, age_s} = store.reading(signal, time_s);
    return at_m === null || !(age_s < FRESH_S) || !Number.isFinite(value) ? null : [way_m, value];
  });
}

const FRESH_S = 0.5;

/// What a simulation knows over time, over the same way; `scale` to the signal's unit.
export function truth_over_way(
  steps: readonly Step[], run: Run | undefined, plot: string, scale: number): Points {
  const line = run?.truth.lines.find((one) => one.plot === plot);
  const times = run?.truth.time_s ?? [];
  let next = 0;
  return line === undefined ? [] : steps.map(({time_s, at_m, way_m}) => {
    while (next + 1 < times.length && times[next + 1]! <= time_s) {
      ++next;
    }
    const value = line.values[next];
    return at_m === null || value == null || times[next]! > time_s || Number.isNaN(scale) ? null : [way_m, value * scale];
  });
}
