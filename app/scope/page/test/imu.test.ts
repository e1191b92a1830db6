// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';
import type {ExcavatorMachine, Setup, Vector3} from '../src/model/api';
import {CandumpParser} from '../src/model/candump';
import {excavatorPose} from '../src/model/excavator';
import {excavatorDrives} from '../src/model/wanted';
import {PageStore} from '../src/model/store';
import {excavator_state} from '../src/scene/machine_state';
import {page} from './status';
import {graben} from './tool';

interface Run {
  setup: Setup;
  log: Uint8Array;
}

/// A run and what its report knows of it.
function run_of(task: string, ...options: string[]): Run {
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

function store_of_run({setup, log}: Run): PageStore {
  const store = new PageStore(setup.machines);
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

const machine_of = ({setup}: Run): ExcavatorMachine => setup.machines[0] as ExcavatorMachine;

/// Distances of the drawn teeth from the true ones, m, sorted, after the filter's first seconds.
function off_truth(run: Run, store: PageStore): number[] {
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

test("strokes that no frame tells are what the IMUs' frames give, near enough for a picture", () => {
  for (const [task, ...options] of [['dig'], ['dig', '--errors', 'all', '--seed', '3'], ['autodig']]) {
    const run = run_of(task!, '--sensors', 'imu', ...options);
    const store = store_of_run(run);
    assert.equal(store.rows('BoomStroke').count > 1000, true, task);
    const off_m = off_truth(run, store);
    assert.ok(off_m.length > 100, `${off_m.length}`);
    const [half, most] = [off_m[off_m.length >> 1]!, off_m.at(-1)!];
    assert.ok(half < 0.05 && most < 0.2, `${task} ${options}: ${half} m, most ${most} m`);
    console.log(`# ${task} ${options.join(' ')}: ${(1000 * half).toFixed(0)} mm median, ${(1000 * most).toFixed(0)} mm most`);
    const {pose, stale} = excavator_state(machine_of(run), store, store.until_s - 1);
    assert.ok(pose !== null && !stale.bucket, task);
  }
});

test('an estimate is called one, is no message of the bus, and begins anew with the source', () => {
  const run = run_of('dig', '--sensors', 'imu', '--loops', '0.2');
  const store = store_of_run(run);
  assert.ok(store.is_estimate('BoomStroke') && !store.is_estimate('SpoolCommand'));
  const state = page(new TextDecoder().decode(run.log), {...run.setup, source: {...run.setup.source, mode: 'log'}});
  assert.ok(state.store.is_estimate('ArmStroke'));
  assert.ok(!state.messages().some(({message}) => /Stroke$/.test(message.name)));
  assert.ok(state.messages().some(({message}) => message.name === 'SpoolCommand'));
  store.clear();
  assert.ok(!store.is_estimate('BoomStroke'));
  assert.equal(store.rows('BoomStroke').count, 0);
  // A machine that tells its strokes is drawn by them, whatever an IMU says.
  const told = run_of('dig', '--loops', '0.2');
  assert.ok(!store_of_run(told).is_estimate('BoomStroke'));
});

