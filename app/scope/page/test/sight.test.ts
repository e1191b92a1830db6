// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {loadDatabase} from '../src/model/dbc';
import {alarms_of} from '../src/view/faults/alarm_rules';
import {FaultLog} from '../src/view/faults/fault_log';
import {telling_moment} from '../src/view/page/first_sight';
import {plots_of} from '../src/view/plots/plots';
import {snapshot} from '../src/view/basics/snapshot';
import {in_unit, signal_trace, unit_factor} from '../src/view/plots/traces';
import {page_words} from '../src/view/basics/words';
import theme from '../src/view/styles/theme.css?raw';
import type {State} from '../src/state';
import {page, status, stroke, trouble} from './status';

const alarms = (state: State): Record<string, string> => Object.fromEntries(
  alarms_of(state, page_words(state)).map(({id, words}) => [id, words]));

/// Lines of all plots of a kind, with every message there.
function all_lines(kind: 'excavator' | 'dozer') {
  const came = new Set(loadDatabase(kind).messages.keys());
  return plots_of({kind, pumps: 2}, undefined, came).flatMap(({lines}) => lines);
}

test('a drive has one colour in all plots, and nothing else has it', () => {
  const hex = (name: string, part: string) => new RegExp(`--${name}: (#[0-9a-f]{6})`).exec(part)?.[1];
  const [light, night] = theme.split("[data-theme='dark']");
  for (const kind of ['excavator', 'dozer'] as const) {
    const owners = new Map<string, Set<string>>();
    for (const {label, colour} of all_lines(kind)) {
      const owner = /^(boom|arm|bucket|swing|blade|left|right|pump [12])\b/.exec(label.toLowerCase())?.[1]
        ?? 'no drive';
      for (const part of [light!, night!]) {
        const shown = hex(colour, part) ?? hex(colour, light!)!;
        owners.set(shown, (owners.get(shown) ?? new Set()).add(owner));
      }
    }
    for (const [shown, who] of owners) {
      assert.equal(who.size, 1, `${kind}: ${shown} is of ${[...who].join(' and ')}`);
    }
    const own = all_lines(kind).filter(({label}) => /^(Boom|Arm|Bucket|Swing|Blade)/.test(label));
    for (const {label, colour} of own) {
      assert.equal(colour.replace('-soft', ''), label.split(' ')[0]!.toLowerCase(), label);
    }
  }
});

test('an operator reads km/h and deg/s', () => {
  const units = new Map(['excavator', 'dozer'].flatMap((kind) =>
    plots_of({kind: kind as 'excavator', pumps: 2}, undefined,
      new Set(loadDatabase(kind as 'excavator').messages.keys())).map(({name, unit}) => [name, unit])));
  assert.equal(units.get('speeds'), 'km/h');
  assert.equal(units.get('swing'), 'deg/s');
  assert.equal(unit_factor('m/s', 'km/h'), 3.6);
  assert.ok(Math.abs(unit_factor('rad/s', 'deg/s')! - 57.29578) < 1e-5);
  const speed = in_unit(signal_trace('EcuStatus.Lambda'), 2);
  const {store} = page(stroke(0) + status(0, 3, 0, 0, 0.25) + status(1, 3, 0, 0, 0.5));
  assert.ok(Math.abs(speed.reading(store, 1).value - 1) < 1e-4);
  const most = Math.max(...speed.curve(store, 0, 2, 10).value.filter(Number.isFinite));
  assert.ok(Math.abs(most - 1) < 1e-4);
});

test('in an hour with a fault every second the button leads back to the first', () => {
  let text = stroke(0);
  for (let k = 1; k <= 3600; ++k) {
    text += status(k, 5, 21) + status(k + 0.5, 3, 0);
  }
  const log = new FaultLog();
  log.update(page(text).store);
  assert.equal(log.events.length, 3600);
  let steps = 0;
  for (let at = log.last(Infinity); at !== undefined; at = log.last(at.time_s - 1e-6)) {
    assert.equal(at.time_s, 3600 - steps++);
  }
  assert.equal(steps, 3600);
  assert.equal(log.next(0)?.time_s, 1);
});

test('a report opens before its first fault, or before what held it most', () => {
  const moment = (text: string) => telling_moment(page(text).store);
  assert.equal(moment(stroke(0) + status(0, 0, 0)), null);
  // Rise of lambda (5) tells nothing; of the machine's limits the least lambda does.
  const run = stroke(0) + status(0, 1, 0) + status(1, 3, 0, 5, 0.1) + status(5, 3, 0, 0, 1)
    + status(6, 3, 0, 3, 0.8) + status(7, 3, 0, 2, 0.6) + status(8, 3, 0, 3, 0.9);
  assert.equal(moment(run), 5.5);
  assert.equal(moment(run + status(9, 5, 21)), 7.5);
  // Not before the controller was ready, however early it is held.
  assert.equal(moment(stroke(0) + status(0, 0, 1) + status(0.5, 1, 0) + status(1, 3, 0, 3, 0.9)), 0.5);
  assert.equal(moment(stroke(0) + status(0, 1, 0) + status(4, 3, 0, 0, 1) + status(5, 3, 0, 0, 1)), 2.5);
});

test('what a controller still waits for before it is ready is no fault', () => {
  const text = stroke(0) + status(0, 0, 1) + trouble(0.01, 1) + status(0.5, 0, 2) + status(1, 1, 0)
    + status(2, 3, 0, 0, 1) + status(3, 5, 21) + status(4, 0, 1);
  const state = page(text);
  const log = new FaultLog();
  log.update(state.store);
  assert.deepEqual(log.events.map(({time_s, code}) => [time_s, code]), [[3, 21], [4, 1]]);
  state.playhead.seek(0.2);
  assert.ok(!('fault' in alarms(state)) && !('dm1' in alarms(state)));
  const {fault, waits_for} = snapshot(state.store, 0.2);
  assert.deepEqual([fault, waits_for], [0, 1]);
  state.playhead.seek(3.5);
  assert.match(alarms(state).fault!, /fault 21/);
  // One that begins in a fault has one.
  const broken = page(stroke(0) + status(0, 5, 21));
  assert.match(alarms(broken).fault!, /fault 21/);
});

test('of an area that was built no moment of the teeth is told as the worst', () => {
  const came = new Set(loadDatabase('excavator').messages.keys());
  const run = {title: '', subtitle: '', summary: [], limits_share: [], truth: {time_s: [], lines: []}};
  const built = {x_m: [1], y_m: [0], cell_m: 0.1, off_mm: [1], firm_mm: [1]};
  const arrived = (of: typeof run) => plots_of({kind: 'excavator', pumps: 2}, of, came)
    .find(({name}) => name === 'error')!.arrived;
  assert.equal(typeof arrived(run), 'number');
  assert.equal(arrived({...run, built} as typeof run), undefined);
});
