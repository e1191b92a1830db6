// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {excavator_state} from '../src/scene/machine_state';
import {machine_of, off_truth, run_of, store_of_run} from './runs';
import {page} from './status';

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

