// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {Run, Setup} from '../src/model/api';
import {loadDatabase, oldest_version} from '../src/model/dbc';
import {State} from '../src/state';
import {alarms_of} from '../src/view/faults/alarm_rules';
import {active_codes} from '../src/view/basics/snapshot';
import {align, cut, lower_bound} from '../src/view/basics/curves';
import {BARS, distribution} from '../src/view/plots/plot_range';
import {file_setup} from '../src/feed/file_setup';
import {link_words} from '../src/view/panels/header';
import {FaultLog} from '../src/view/faults/fault_log';
import {digits_of, fixed, time_words} from '../src/view/basics/format';
import {stable_range} from '../src/view/plots/plot_range';
import {empty_words, plots_of, plotted} from '../src/view/plots/plots';
import {unit_factor} from '../src/view/plots/traces';
import {page_words} from '../src/view/basics/words';
import {CandumpParser} from '../src/model/candump';
import {bytes_of, line, store_of} from './make';
import {SETUP, EXCAVATOR, id, stroke, status, trouble, troubles, identity, page} from './status';
import {DOZER_9T, EXCAVATOR_12T, EXCAVATOR_22T} from './machines';

const alarms = (state: State): Record<string, string> => Object.fromEntries(
  alarms_of(state, page_words(state))
    .map(({id: name, level, words}) => [name, `${level}: ${words}`]));

test('curves of other times share one axis, without points that none has', () => {
  const one = {time_s: Float64Array.of(10, 12), value: Float64Array.of(1, NaN)};
  const two = {time_s: Float64Array.of(11, 12), value: Float64Array.of(5, 6)};
  assert.deepEqual(align([one, two], 10),
    [[0, 1, 2], [1, undefined, null], [undefined, 5, 6]]);
  assert.deepEqual(align([], 0), [[]]);
});

test('a line is cut with a point beyond each end, and peaks stay', () => {
  const times = Array.from({length: 1000}, (_, k) => k / 100);
  const values = times.map((_, k) => (k === 555 ? 9 : 0));
  const part = cut(times, values, 1000, 5, 6, 10);
  assert.equal(part.time_s[0], 4.99);
  assert.ok(part.time_s.length <= 2 * 10 + 2);
  assert.equal(Math.max(...part.value), 9000);
  const gap = cut([0, 1, 2], [1, null, 3], 1, 0, 2, 50);
  assert.ok(Number.isNaN(gap.value[1]));
  assert.equal(lower_bound(times, 9.99), 999);
  assert.equal(lower_bound(times, 99), 1000);
});

test('numbers and times as they are read', () => {
  assert.equal(fixed(-0.04, 1), '0.0');
  assert.equal(fixed(-1234567.25, 1), '\u22121\u202f234\u202f567.3');
  assert.equal(fixed(NaN, 1), '–');
  assert.deepEqual([1, 0.05, 0.00002, 0.125, 10].map(digits_of), [0, 2, 4, 3, 0]);
  assert.equal(time_words(59.996), '1:00.00');
  assert.equal(time_words(3723.4, 1), '1:02:03.4');
  assert.equal(time_words(-5, 0), '\u22120:05');
});

test('the vertical range holds the data and the least that is asked', () => {
  const range = stable_range([0, 5], false) as
    (plot: unknown, min: number, max: number) => [number, number];
  for (const [min, max] of [[0, 3], [-20, 700], [1e-3, 2e-3], [4.9, 5]] as const) {
    const [low, high] = range(null, min, max);
    assert.ok(low <= Math.min(min, 0) && high >= Math.max(max, 5), `${min} .. ${max}`);
  }
  assert.equal(range(null, 0, 3)[0], 0);
});

test('a histogram counts every time once', () => {
  const times = Float64Array.from({length: 1000}, (_, k) => (k === 7 ? 5000 : 4 + (k % 10) / 10));
  const of = distribution(times);
  assert.equal(of.bars.length, BARS);
  assert.equal(of.bars.reduce((sum, bar) => sum + bar), 1000);
  assert.equal(of.max_us, 5000);
  assert.ok(of.median_us > 4 && of.median_us < 5);
  assert.ok(of.bar_us * BARS < 100);  // the outlier does not squeeze the others
  assert.equal(distribution(new Float64Array(5)).all_zero, true);
});

test('lines that only a simulation knows join the plot they name, in its unit', () => {
  assert.equal(unit_factor('m', 'mm'), 1000);
  assert.equal(unit_factor('m', 'MPa'), null);
  const run: Run = {
    title: 'a', subtitle: '', summary: [], limits_share: [],
    truth: {time_s: [0, 1], lines: [
      {plot: 'error', label: 'True tip', unit: 'm', values: [0.001, null]},
      {plot: 'force', title: 'Force', label: 'x', unit: 'N', values: [1, 2]},
      {plot: 'force', label: 'z', unit: 'N', values: [3, 4]},
    ]},
  };
  const plots = plots_of(null, run, new Set());
  assert.deepEqual(plots.map(({name, unit, lines}) => [name, unit, lines.length]),
    [['error', 'm', 1], ['force', 'N', 2]]);
});

test('each fault is listed once, whether EcuStatus or DM1 tells it', () => {
  const text = stroke(0) + status(0, 3, 0) + status(1, 5, 21) + trouble(1.01, 21)
    + trouble(1.11, 17) + trouble(1.21, 21) + trouble(2.1, 17) + status(3, 3, 0) + trouble(3, 0)
    + status(9, 5, 21) + trouble(9.01, 21);
  const log = new FaultLog();
  log.update(page(text).store);
  assert.deepEqual(log.events.map(({time_s, code, dm1_only}) => [time_s, code, dm1_only]),
    [[1, 21, false], [1.11, 17, true], [9, 21, false]]);
  assert.equal(log.last(8)?.code, 17);
  assert.equal(log.next(1.11)?.time_s, 9);
  assert.equal(log.next(9), undefined);
});

test('several faults in one broadcast are each listed, and none of one that is not whole', () => {
  const text = stroke(0) + status(0, 3, 0) + trouble(0.5, 17) + status(1, 5, 21) + troubles(1, [21, 17, 3])
    + troubles(2, [21, 17, 3]) + troubles(3, [5, 6], 2) + trouble(3.5, 0);
  const {store} = page(text);
  const log = new FaultLog();
  log.update(store);
  assert.deepEqual(log.events.map(({time_s, code, dm1_only}) => [time_s, code, dm1_only]),
    [[0.5, 17, true], [1, 21, false], [1.12, 3, true]]);
  assert.deepEqual(active_codes(store, 1.5), [3, 17, 21]);
  assert.deepEqual(active_codes(store, 3.4), [3, 17, 21]);
  assert.deepEqual(active_codes(store, 3.6), []);
  assert.equal(store.health.foreign, 0);
  assert.equal(store.rows('DM1').count, 8);
});

test('a stopped machine and a plan that cannot work are alarms', () => {
  const good = alarms(page(stroke(0) + status(0, 3, 0, 0, 1)));
  assert.deepEqual(good, {});
  const stopped = alarms(page(stroke(0) + status(0, 5, 21)));
  assert.equal(stopped.fault, 'alarm: Stopped by fault 21: a spool does not obey.');
  const task = alarms(page(stroke(0) + status(0, 1, 37)));
  assert.equal(task.plan, 'alarm: This plan cannot work: no such task (fault 37).');
  assert.match(alarms(page(stroke(0) + status(0, 3, 0, 12, 0))).fence!, /^alarm: This plan cannot/);
  assert.match(alarms(page(stroke(0) + status(0, 3, 0, 12, 0.5))).fence!, /^warning: Slowed by/);
});

test('what is wrong with a log is said with place and number', () => {
  const frames = stroke(0) + status(0, 3, 0);
  const own = EXCAVATOR.version;
  const oldest = oldest_version('excavator');
  for (const version of [oldest - 1, own + 1]) {
    assert.equal(alarms(page(frames + identity(0, 0xdeadbeef, version))).dbc, 'alarm: Written with '
      + `DBC version ${version}, this page reads versions ${oldest} to ${own}: values may be wrong.`);
  }
  const other = alarms(page(frames + identity(0, 0xdeadbeef, oldest)));
  assert.equal(other.dbc, undefined);
  assert.match(other.profile!, /hash 0xDEADBEEF is known here/);
  assert.equal(alarms(page(`${frames}rubbish\n`)).malformed,
    'warning: 1 line is not candump, the first is line 3: ‘rubbish’.');
  assert.match(alarms(page('hello\n')).malformed!, /^alarm: This is no candump log, .*line 1/);
  assert.match(alarms(page('')).empty!, /^alarm: This log is empty/);
});

test('what is wrong with the way here is said', () => {
  const state = page(stroke(0) + status(0, 3, 0));
  state.onMessage({kind: 'dropped', frames: 1234});
  state.onMessage({kind: 'bus', up: false, words: 'bus-off'});
  state.onMessage({kind: 'refused', why: 'not now'});
  state.onClosed('the server does not answer', 2);
  const all = alarms(state);
  assert.equal(all.dropped, 'warning: This page is too slow: 1\u202f234 frames were left out.');
  assert.equal(all.bus, 'alarm: The bus is down: bus-off.');
  assert.equal(all.refused, 'warning: Refused: not now');
  assert.match(all.link!, /^alarm: The connection to the server is lost/);
});

test('every signal that a plot reads is in the DBC of its machine', () => {
  for (const machine of [EXCAVATOR_22T, EXCAVATOR_12T, DOZER_9T]) {
    const database = loadDatabase(machine.kind);
    const store = store_of(stroke(0));
    const plots = plots_of(plotted(machine, store), undefined, new Set(database.messages.keys()));
    assert.ok(plots.length >= 8, machine.name);
    for (const {trace} of plots.flatMap(({lines}) => lines)) {
      assert.ok(trace.signals.length > 0);
      trace.signals.forEach((signal) => database.signal(signal));
    }
  }
});

test('a machine whose profile nobody knows has plots, by what its frames tell', () => {
  const text = stroke(0) + status(0, 3, 0) + identity(0, 0xdeadbeef, EXCAVATOR.version);
  const pumps = (second: number): string => line(0, id('PumpState'), [0, 0xf0, 0, 0, second & 0xff,
    second >> 8, second & 0xff, second >> 8]);
  const names = (log: string, more: readonly string[]): string[] => {
    const state = page(log);
    assert.equal(state.machine, null);
    const came = new Set([...EXCAVATOR.messages.keys()]
      .filter((name) => state.store.rows(name).count > 0).concat(more));
    return plots_of(plotted(null, state.store), undefined, came)
      .flatMap(({name, lines}) => lines.map(({label}) => `${name}: ${label}`));
  };
  assert.deepEqual(names(text, []).filter((name) => name.startsWith('lambda')), ['lambda: lambda']);
  const swash = (log: string) => names(log, ['PumpState']).filter((name) => /^swash/.test(name));
  assert.deepEqual(swash(text + pumps(0xffff)), ['swash: Pump 1']);
  assert.deepEqual(swash(text + pumps(100)), ['swash: Pump 1', 'swash: Pump 2']);
  assert.ok(!names(text, ['TaskStatus']).some((name) => name.startsWith('swing')));
  assert.ok(names(text, ['SwingState']).includes('swing: Swing'));
});

test('why there is no plot', () => {
  assert.match(empty_words(store_of('')), /^No frames yet/);
  assert.match(empty_words(store_of(line(0, 0x123, new Uint8Array(8)))), /excavator or a dozer/);
  assert.match(empty_words(store_of(stroke(0))), /^No message that is plotted/);
});

test('another log in a new store has its own faults, whatever its revision', () => {
  const log = new FaultLog();
  const one = page(stroke(0) + status(1, 5, 21) + trouble(2, 17)).store;
  const two = page(stroke(0) + status(1, 5, 37) + trouble(3, 18)).store;
  assert.equal(one.revision, two.revision);
  assert.ok(log.update(one));
  assert.ok(log.update(two));
  assert.deepEqual(log.events.map(({code}) => code), [37, 18]);
  assert.ok(!log.update(two));
});

test('the beginning of a fault is that of its own code', () => {
  const log = new FaultLog();
  log.update(page(stroke(0) + status(1, 5, 21) + trouble(1.5, 17)).store);
  assert.equal(log.last(2)?.code, 17);
  assert.equal(log.last(2, 21)?.time_s, 1);
  assert.equal(log.last(0.5, 21), undefined);
});

const source = (mode: Setup['source']['mode']): Setup =>
  ({...SETUP, source: {...SETUP.source, mode}});

function live_page(mode: 'can' | 'sim'): State {
  const state = new State(false);
  const parser = new CandumpParser();
  parser.feed(bytes_of(stroke(0) + status(0, 3, 0)));
  parser.end();
  state.onOpened();
  state.onSetup(source(mode));
  state.onFrames({...parser.take(), restart: true}, 1);
  state.know_machine();
  return state;
}

test('without its server the clock stands and everything is old', () => {
  for (const mode of ['can', 'sim'] as const) {
    const state = live_page(mode);
    state.onClosed('the server does not answer', 1);
    state.playhead.tick(2);
    state.playhead.tick(2);
    assert.equal(state.playhead.now_s, 0, mode);
    assert.ok(state.messages().every(({stale, message}) => stale || message.cycle_ms === 0));
    state.onOpened();
    state.onMessage({kind: 'sim', running: false, pace: 1, speed: 1, soil: false, obstacle: false,
      faults: []});
    state.playhead.tick(2);
    state.playhead.tick(2);
    assert.equal(state.playhead.now_s, mode === 'sim' ? 0 : 2, mode);
  }
});

test('a page counts what is left out by connection', () => {
  const state = live_page('can');
  state.onMessage({kind: 'dropped', frames: 3});
  state.onClosed('the server does not answer', 1);
  state.onOpened();
  assert.equal(state.dropped, 0);
});

test('a log that is still read is not called empty, and a packed one has no share', () => {
  const state = new State(true);
  const run = {log: 'x', truth: {time_s: [], lines: []}} as unknown as Run;
  state.onSetup({...source('report'), run});
  assert.ok(!('empty' in alarms(state)) && !('foreign' in alarms(state)));
  state.onMessage({kind: 'end'});
  assert.match(alarms(state).empty!, /^alarm: This log is empty/);

  const opened = (name: string, bytes: number): string => {
    state.file_opened();
    state.onSetup(file_setup(SETUP, {name, size: 100}));
    state.onFrames({columns: [], restart: true, count: {lines: 0, malformed: 0,
      first_malformed: null, backwards: 0, unheard: 0, lost: 0, breaks: 0, first_break: null}}, bytes);
    return link_words(state);
  };
  assert.equal(opened('a.log.gz', 900), 'reading');
  assert.equal(opened('a.log', 50), 'reading, 50 %');
  assert.equal(opened('a.log', 100), 'reading, 99 %');
});

test('a log that was cut off and comes again is no trouble any more', () => {
  const state = new State(false);
  const parser = new CandumpParser();
  parser.feed(bytes_of(stroke(0)));
  parser.end();
  const block = {...parser.take(), restart: true};
  state.onOpened();
  state.onSetup({...SETUP, source: {...SETUP.source, bytes: 1000}});
  state.onFrames(block, 10);
  assert.equal(state.drawn, false);
  state.onClosed('the server does not answer', 1);
  assert.equal(state.drawn, true);
  state.onClosed('the log could not be read to its end: cut', null);
  assert.match(state.trouble, /^The log could not/);
  state.onOpened();
  state.onFrames(block, 10);
  state.onMessage({kind: 'end'});
  assert.equal(state.trouble, '');
  assert.equal(state.loaded_share, 1);
});

test('a pose out of reach is the fault of the plan only where a plan is followed', () => {
  const strokes = (raw: number) => ['BoomStroke', 'ArmStroke', 'BucketStroke'].map((name) =>
    line(0, id(name), [0, 0xf0, raw & 0xff, raw >> 8, raw & 0xff, raw >> 8, 0xff, 0xff])).join('');
  const operator = (task: number) => line(0, id('OperatorCommand'),
    [0, 0xf0, 0, task, 0, 0, 0xff, 0xff]);
  const unreachable = (text: string) => alarms(page(text + status(0, 5, 7)));
  assert.match(unreachable(strokes(100) + operator(3)).plan!, /^alarm: This plan cannot work/);
  for (const text of [strokes(100) + operator(1), strokes(0xffff) + operator(3)]) {
    assert.equal(unreachable(text).plan, undefined);
    assert.match(unreachable(text).fault!, /^alarm: Stopped by fault 7/);
  }
});

test('one frame is one', () => {
  const state = page(stroke(1) + stroke(0.9) + stroke(1.1));
  assert.equal(alarms(state).backwards,
    'warning: 1 frame is stamped before the one before it.');
});
