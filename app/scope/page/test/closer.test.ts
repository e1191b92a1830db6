// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {Vector2} from '../src/model/api';
import {bookmarks_of, hash_of, moment_of} from '../src/model/moment';
import {over_way, truth_over_way, way_of} from '../src/model/xy';
import {figure_svg, type Figure} from '../src/view/plots/figure_svg';
import {MOST_OWN, OwnLines, signal_words} from '../src/view/plots/own_lines';
import type {PlotSpec} from '../src/view/plots/plots';
import {csv_of, file_name} from '../src/view/plots/save';
import {EXCAVATOR_22T} from './machines';
import {graben_log} from './tool';
import {store_of} from './make';

test('a moment goes into the address and comes out of it', () => {
  for (const moment of [{time_s: 12.3456}, {time_s: 0, window_s: [0, 30.5] as const},
    {time_s: 3600.01, window_s: [3590, 3620] as const}]) {
    assert.deepEqual(moment_of(hash_of(moment)), moment);
  }
  for (const nothing of ['', '#', '#panel', '#t=', '#t=x', '#t=1e999']) {
    assert.equal(moment_of(nothing), null, nothing);
  }
  assert.deepEqual(moment_of('#t=5&w=9,3'), {time_s: 5}, 'a window that ends before it begins');
  assert.deepEqual(moment_of('#t=5&w=1,2,3'), {time_s: 5});
});

test('bookmarks keep their names, and an address that somebody made does no harm', () => {
  const marks = [{time_s: 3, name: ''}, {time_s: 7.25, name: 'pump 1 & 2, "stall" #4'}];
  assert.deepEqual(bookmarks_of(hash_of({time_s: 1}, marks)), marks);
  assert.deepEqual(bookmarks_of(hash_of(null, marks)), marks);
  assert.equal(moment_of(hash_of(null, marks)), null);
  assert.equal(hash_of(null, []), '');
  assert.deepEqual(bookmarks_of('#b=x&b=&b=5&b=2 a'), [{time_s: 2, name: 'a'}, {time_s: 5, name: ''}]);
  assert.equal(bookmarks_of(`#${'b=1&'.repeat(5000)}`).length, 100);
  assert.equal(bookmarks_of(`#b=1 ${'x'.repeat(5000)}`)[0]!.name.length, 80);
});

test('the way is as long as the teeth went, and carries what was told on it', () => {
  const store = store_of(graben_log('dig'));
  const steps = way_of(EXCAVATOR_22T, store, [2, 8], 600);
  assert.equal(steps.length, 600);
  const length = steps.at(-1)!.way_m;
  // At 0.6 m/s at most, and seldom held.
  assert.ok(length > 2 && length < 0.65 * 6, `${length} m in 6 s`);
  assert.ok(steps.every(({way_m}, i) => i === 0 || way_m >= steps[i - 1]!.way_m));
  const errors = over_way(steps, store, 'EcuHydraulics.PathError');
  assert.equal(errors.length, steps.length);
  const middle = errors[300] as Vector2;
  assert.equal(middle[0], steps[300]!.way_m);
  assert.equal(middle[1], store.reading('EcuHydraulics.PathError', steps[300]!.time_s).value);
  // Before the first frame nothing is known.
  assert.ok(way_of(EXCAVATOR_22T, store, [-5, -1], 20)
    .every(({at_m, way_m}) => at_m === null && way_m === 0));
  const run = {truth: {time_s: [2, 4, 6], lines: [{plot: 'error', label: 'e', unit: 'm',
    values: [0.001, null, 0.003]}]}} as never;
  const known = truth_over_way(steps, run, 'error', 1000);
  const at = (time_s: number) => known[steps.findIndex((step) => step.time_s > time_s)];
  assert.deepEqual([at(2.5)![1], at(4.5), at(6.5)![1]], [1, null, 3]);
  assert.deepEqual(truth_over_way(steps, undefined, 'error', 1), []);
});

test("an own line is told in the plot's unit where that can be, else in its own", () => {
  const store = store_of(graben_log('dig'));
  const error: PlotSpec = {name: 'error', title: 'Path error', unit: 'mm', note: '', lines: []};
  const own = new OwnLines();
  assert.ok(own.put('BoomStroke.BoomStroke', 'error'));
  assert.ok(own.put('EcuStatus.CycleTime', 'error'));
  assert.ok(!own.put('EcuStatus.CycleTime', 'error'), 'twice the same');
  assert.ok(own.put('EcuStatus.Lambda', null));
  const [fresh, plot] = own.into([error], store);
  assert.equal(fresh!.name, 'own1');
  assert.deepEqual(plot!.lines.map(({label, unit}) => [label, unit]),
    [['Boom stroke', undefined], ['Ecu status: cycle time, \u00b5s', 'us']]);
  assert.deepEqual(error.lines, [], 'the plot that was given stays');
  const {value} = plot!.lines[0]!.trace.reading(store, 5);
  assert.equal(value, store.reading('BoomStroke.BoomStroke', 5).value);
  own.take_out('BoomStroke.BoomStroke', 'error');
  assert.equal(own.into([error], store)[1]!.lines.length, 1);
  for (let k = 0; k < 20; ++k) own.put(`EcuHealth.x${k}`, 'error');
  assert.equal(own.lines.filter(({plot: name}) => name === 'error').length, MOST_OWN);
  assert.equal(signal_words('BoomPressure.BoomCapPressure'), 'Boom pressure: boom cap pressure');
});

const FIGURE: Figure = {
  title: 'a < b & "c"', x: {label: 'x', least: 0, most: 10}, y: {label: 'y', least: -1, most: 1},
  lines: [{label: '<script>', colour: '#123456', width: 2, dash: [2, 3],
    points: [[0, 0], [5, 1], null, [6, -1], [10, 0]]}],
  bands: [{from: 2, until: 4, colour: '#abcdef'}], at: [5, 1],
  colours: {sheet: '#fff', ink: '#000', muted: '#444', grid: '#ccc'}};

const path_in = (svg: string): string => /d="(M[^"]*L[^"]*)" stroke="#123456"/.exec(svg)![1]!;
const points_in = (svg: string): number[][] =>
  path_in(svg).match(/-?[\d.]+ -?[\d.]+/g)!.map((pair) => pair.split(' ').map(Number));

test('a figure is drawn to scale, with its gaps, and no name is markup', () => {
  const svg = figure_svg(FIGURE, 400, 200);
  assert.ok(!svg.includes('<script>') && svg.includes('&#60;script&#62;') && svg.includes('a &#60; b'));
  assert.ok(!/NaN|undefined|Infinity/.test(svg));
  assert.equal(path_in(svg).match(/M/g)!.length, 2);
  assert.deepEqual(points_in(svg)[1], [62 + (400 - 76) / 2, 52], 'in the middle and at the top');
  assert.ok(svg.includes('fill="#abcdef"') && svg.includes('<circle'));
  // A metre is a metre on both axes.
  const [a, b] = points_in(figure_svg({...FIGURE, equal: true}, 400, 200)) as [number[], number[]];
  assert.ok(Math.abs((b[0]! - a[0]!) / 5 - (a[1]! - b[1]!)) < 0.05, `${a}, ${b}`);
});

test('numbers go out as a table that a spreadsheet reads', () => {
  assert.equal(csv_of(['time, s', 'a "b"', 'c'], [[0.1, 0.2], [1.5, null], [undefined, -2]]),
    '"time, s","a ""b""",c\n0.1,1.5,\n0.2,,-2\n');
  assert.equal(file_name('Lambda and what holds it', 'csv'), 'lambda_and_what_holds_it.csv');
  assert.equal(file_name('../x', 'svg'), 'x.svg');
  assert.equal(file_name('', 'svg'), 'plot.svg');
});
