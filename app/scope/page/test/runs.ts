// SPDX-License-Identifier: Apache-2.0
/// Runs with their logs, and how far what the page draws of them is from what the simulation knows.

import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import type {ExcavatorMachine, Setup, Vector3} from '../src/model/api';
import {CandumpParser} from '../src/model/candump';
import {excavatorPose} from '../src/model/excavator';
import {machines_of} from '../src/model/on_bus';
import {PageStore} from '../src/model/store';
import {excavatorDrives} from '../src/model/wanted';
import {graben} from './tool';

export interface Run {
  setup: Setup;
  log: Uint8Array;
}

/// A run and what its report knows of it.
export function run_of(task: string, ...options: string[]): Run {
  const folder = mkdtempSync(join(tmpdir(), 'graben-page-'));
  try {
    graben(task, ...options, '--out', folder);
    const html = readFileSync(join(folder, `${task}.html`), 'utf8');
    return {log: readFileSync(join(folder, `${task}.log`)),
      setup: JSON.parse(/id="graben-setup">(.*?)<\/script/s.exec(html)![1]!)};
  } finally {
    rmSync(folder, {recursive: true});
  }
}

export function store_of_run({setup, log}: Run): PageStore {
  const store = new PageStore(machines_of(setup));
  const parser = new CandumpParser();
  // In pieces, as a bus brings them.
  for (let from = 0; from < log.length; from += 20_000) {
    parser.feed(log.subarray(from, from + 20_000));
    store.append(parser.take());
  }
  parser.end();
  store.append(parser.take());
  return store;
}

export const machine_of = ({setup}: Run): ExcavatorMachine => setup.machines[0] as ExcavatorMachine;

/// Distances of the drawn teeth from the true ones, m, sorted, after the filter's first seconds.
export function off_truth(run: Run, store: PageStore): number[] {
  const machine = machine_of(run);
  const {truth: {time_s}, way} = run.setup.run!;
  return time_s.flatMap((now_s, k) => {
    const [boom, arm, bucket, swing] = excavatorDrives(store, machine, now_s);
    const at = excavatorPose(machine, [boom, arm, bucket], swing)?.position_m;
    const truth = way![k] as Vector3;
    return now_s < time_s[0]! + 5 ? [] : [at === undefined ? Infinity
      : Math.hypot(...at.map((value, i) => value - truth[i]!))];
  }).sort((a, b) => a - b);
}
