// What the report's page shows of a task's run: right, missing and malformed data.
// Call: node check_autodig.mjs FOLDER_OF_THE_PAGE
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {autodigRun as good} from './autodig_run.mjs';

const folder = process.argv[2];
/// Stands in for the browser's: keeps what is put together.
function node(name) {
  return {name, children: [], listeners: {}, append(...nodes) { this.children.push(...nodes); },
    remove() { this.removed = true; },
    addEventListener(kind, listener) { this.listeners[kind] = listener; }};
}
const byId = new Map();
const document = {
  documentElement: {}, createElement: node,
  getElementById: (id) => byId.get(id) ?? byId.set(id, node(id)).get(id),
};
const uPlot = {rangeNum: (min, max) => [min, max]};
const getComputedStyle = () => ({getPropertyValue: (name) => ` ${name}`});
const files = ['report_checks.js', 'report_parts.js', 'report_svg.js', 'report_drives.js',
  'report_space.js', 'report_autodig.js', 'report_chart.js', 'report_dom.js', 'report_task.js'];
const [autodig, chart, task] = new Function('document', 'getComputedStyle', 'uPlot', `${
  files.map((file) => readFileSync(join(folder, file), 'utf8')).join('\n')}
  return [reportAutodig, reportChart, reportTask];`)(document, getComputedStyle, uPlot);

const changed = (change) => {
  const input = good();
  change(input);
  return autodig.prepare(input);
};
const plot = (report, id) => report.plots.find((p) => p.id === id);
const lines = (report, id) => plot(report, id).body.value.lines;
const line = (report, id, label) => lines(report, id).find((one) => one.label === label).values;
const gaps = (list) => list.fill(null);

test('a task\'s run is complete, in the page\'s units', () => {
  const run = good();
  const report = autodig.prepare(run);
  assert.deepEqual(report.problems, []);
  assert.equal(report.path, null);
  assert.deepEqual(report.plots.map((p) => p.id), ['error', 'lambda', 'progress', 'attitude',
    'cylinder-displacement', 'swing-displacement', 'cylinder-velocity', 'swing-velocity', 'spool',
    'pressure', 'cycle']);
  assert.deepEqual(['displacement', 'velocity'].map((id) => plot(report, `swing-${id}`).source),
      ['Zhang, Fig. 8', 'Zhang, Fig. 9']);
  for (const p of report.plots) assert.match(p.axis, /\(.+\)$/);
  const {series} = run;
  const last = series.time_s.length - 1;
  assert.equal(line(report, 'error', 'true')[50], series.error_true_m[50] * 1e3);
  assert.equal(line(report, 'error', 'true')[last], null);
  assert.equal(line(report, 'progress', 'progress')[50], series.progress[50] * 100);
  assert.equal(line(report, 'attitude', 'planned')[0], 2.27 * (180 / Math.PI));
  assert.equal(line(report, 'cylinder-displacement', 'arm planned')[9], series.planned[1][9] * 1e3);
  assert.equal(line(report, 'cylinder-displacement', 'bucket real')[9], series.real[2][9] * 1e3);
  assert.equal(line(report, 'swing-displacement', 'swing real')[last],
      series.real[3][last] * (180 / Math.PI));
  assert.equal(line(report, 'cylinder-velocity', 'boom wanted')[9],
      series.velocity_wanted[0][9] * 1e3);
  assert.equal(line(report, 'swing-velocity', 'swing real')[300],
      series.velocity_real[3][300] * (180 / Math.PI));
  assert.equal(line(report, 'spool', 'swing command')[300], series.spool_command[3][300] * 100);
  assert.equal(line(report, 'pressure', 'Pump 1 expected')[0], series.pump_expected_pa[0][0] / 1e6);
});

test('what was wanted is pale and broad, and below what came of it', () => {
  for (const id of ['cylinder-displacement', 'swing-velocity', 'spool', 'pressure', 'attitude']) {
    const all = lines(autodig.prepare(good()), id);
    assert.deepEqual(all.map(({wide}) => Boolean(wide)), all.map((_, i) => i < all.length / 2), id);
    assert.equal(new Set(all.map(({colour}) => colour)).size, all.length);
  }
});

test('one pump or two, as many as there are', () => {
  assert.deepEqual(lines(autodig.prepare(good()), 'pressure').map(({label}) => label),
      ['Pump 1 expected', 'Pump 1 real']);
  const two = changed(({series}) => {
    for (const name of ['pump_expected_pa', 'pump_real_pa']) series[name].push(series[name][0]);
  });
  assert.deepEqual(two.problems, []);
  assert.equal(lines(two, 'pressure').length, 4);
});

test('the steps are stretches of time, one that does not end as long as the run', () => {
  const report = changed(({steps}) => {
    steps[3].until_s = null;
    Object.assign(steps[4], {from_s: null, until_s: null, from_m: null, to_m: null});
  });
  assert.deepEqual(report.problems, []);
  assert.deepEqual(report.stages.map(({name, number}) => `${number} ${name}`),
      ['1 dig', '2 lift', '3 swing', '4 dump']);
  const end = good().series.time_s.at(-1);
  assert.deepEqual(report.stages.map(({from, until}) => [from, until]),
      [[0, 9], [9, 13], [13, 19], [19, end]]);
  assert.deepEqual(report.space.value.numbers.map(({text}) => text), ['1', '2', '3', '4']);
});

/// A chart of 10 pixels to the second in which a letter has 8, that keeps what is put into it.
function canvas(seen = {from: 0, until: 30}) {
  const [filled, words] = [[], []];
  const ctx = {save() {}, restore() {}, beginPath() {}, rect() {}, clip() {},
    measureText: (text) => ({width: 8 * text.length}),
    fillText(text, x) { words.push([text, x]); },
    fillRect(...box) { filled.push({colour: this.fillStyle, box}); }};
  return {ctx, filled, words, valToPos: (value) => value * 10,
    bbox: {left: seen.from * 10, top: 24, width: (seen.until - seen.from) * 10, height: 50}};
}

test('every plot names the steps above it and shades every second one', () => {
  const report = autodig.prepare(good());
  for (const p of report.plots) {
    const made = chart.options(p, 600, {x: report.x, shade: [], stages: report.stages,
      limitColour: () => 'limit0', mountLegend() {}, showAt() {}});
    assert.ok(made.padding[0] >= 20, 'room for the names');
    const sheet = canvas();
    made.hooks.drawAxes.forEach((hook) => hook(sheet));
    assert.deepEqual(sheet.words,
        [['1 dig', 45], ['2', 110], ['3', 160], ['4', 202.5], ['5 return', 250]]);
    assert.deepEqual(sheet.filled.filter(({colour}) => colour === '--shade').map(({box}) => box),
        [[90, 24, 40, 50], [190, 24, 25, 50]]);
  }
});

test('of a step that is seen in part the name stands over this part', () => {
  const {stages} = autodig.prepare(good());
  const sheet = canvas({from: 5, until: 12});
  chart.drawStages(sheet, stages);
  assert.deepEqual(sheet.words, [['1', 70], ['2', 105]]);
});

test('without steps a chart is as it was', () => {
  const report = autodig.prepare(good());
  const made = chart.options(plot(report, 'error'), 600,
      {x: report.x, shade: [], limitColour: () => 'limit0', mountLegend() {}, showAt() {}});
  assert.equal(made.padding[0], 10);
  const sheet = canvas();
  made.hooks.drawAxes.forEach((hook) => hook(sheet));
  assert.deepEqual([sheet.words, sheet.filled], [[], []]);
});

const textsOf = (one) => (typeof one === 'string' ? [one] :
    [one.textContent ?? [], ...one.children.map(textsOf)].flat(9));

function filled(report, zoom = () => {}) {
  byId.clear();
  task.fill(report, zoom);
  return Object.fromEntries(['steps', 'fences', 'task-section'].map((id) => (
    [id, document.getElementById(id)])));
}

test('steps and fences are listed in words, and a step shows its time closely', () => {
  const zooms = [];
  const page = filled(autodig.prepare(good()), (...run) => zooms.push(run));
  const rows = page.steps.children[0].children[1].children;
  assert.deepEqual(textsOf(rows[0]),
      ['1 dig', 'straight line', '0.00 to 9.00', '7.40, 0.00, 0.00', '4.60, 0.00, −0.90']);
  assert.equal(textsOf(rows[1])[1], 'drive space');
  rows[2].children[0].children[0].listeners.click();
  assert.deepEqual(zooms, [[13, 19]]);
  assert.deepEqual(textsOf(page.fences), ['design: level at −0.90 m, teeth stay above it',
    'ceiling at 3.0 m', 'wall at y = −2.0 m']);
  assert.equal(page['task-section'].hidden, false);
});

test('what is not known of a step is a dash, no fence is said, no task no section', () => {
  const page = filled(changed((run) => {
    Object.assign(run.steps[4], {from_s: null, until_s: null, from_m: null, to_m: null});
    Object.assign(run, {fences: [], design: null});
  }));
  assert.deepEqual(textsOf(page.steps.children[0].children[1].children[4]),
      ['5 return', 'drive space', '– to –', '–', '–']);
  assert.deepEqual(textsOf(page.fences), ['none']);
  assert.ok(filled({})['task-section'].removed);
});

test('faults of the steps and fences are named, and the rest stays', () => {
  const faults = [
    [/“steps” is missing/, (run) => delete run.steps],
    [/“steps” is empty/, (run) => { run.steps = []; }],
    [/“steps”, entry 2, has no name/, (run) => delete run.steps[1].name],
    [/“steps”, entry 2, “kind”: "arc" is not "line" or "drives"/,
      (run) => { run.steps[1].kind = 'arc'; }],
    [/“steps”, entry 1, “kind”: null is not/, (run) => delete run.steps[0].kind],
    [/“steps”, entry 1, “kind”: "toString" is not/, (run) => { run.steps[0].kind = 'toString'; }],
    [/“steps”, entry 3, “from_s”: "0" is no number/, (run) => { run.steps[2].from_s = '0'; }],
    [/“steps”, entry 3, “to_m”: \[1,2\] is not 3 numbers/,
      (run) => { run.steps[2].to_m = [1, 2]; }],
    [/“steps”, entry 1, “from_m”: \[1,2,null\] is not 3 numbers/,
      (run) => { run.steps[0].from_m = [1, 2, null]; }],
    [/“steps”, entry 3, ends before it begins/, (run) => { run.steps[2].until_s = 1; }],
    [/“fences” is missing/, (run) => delete run.fences],
    [/“fences”, entry 2, has no words/, (run) => { run.fences[1] = 'wall'; }],
    [/“design” has no words/, (run) => { run.design = {}; }],
    [/“design” has no words/, (run) => { run.design = 0; }],
  ];
  for (const [sentence, change] of faults) {
    const report = changed(change);
    assert.equal(report.problems.length, 1);
    assert.match(report.problems[0], sentence);
    assert.ok(report.plots.every((p) => p.body.ok) && report.space.ok);
    const page = filled(report);
    assert.ok([...textsOf(page.steps), ...textsOf(page.fences)].includes(report.problems[0]));
  }
});

test('each fault in a plot is named, and costs only this plot', () => {
  const faults = [
    ['error', /error_true_m” is missing/, (s) => delete s.error_true_m],
    ['error', /error_measured_m.*569 values.*570/, (s) => s.error_measured_m.pop()],
    ['lambda', /limit.*value 3.*no name/, (s) => { s.limit[2] = 9; }],
    ['progress', /progress”, value 2: "half" is no number/, (s) => { s.progress[1] = 'half'; }],
    ['attitude', /planned_attitude_rad” is missing/, (s) => delete s.planned_attitude_rad],
    ['attitude', /Attitude of the bucket: no value is known/,
      (s) => { gaps(s.attitude_rad); gaps(s.planned_attitude_rad); }],
    ['spool', /spool_real” has 3 lists, not 4/, (s) => s.spool_real.pop()],
    ['spool', /spool_command\[3\].*569 values/, (s) => s.spool_command[3].pop()],
    ['pressure', /differ in the number of pumps/, (s) => s.pump_real_pa.push(s.pump_real_pa[0])],
    ['pressure', /pump_expected_pa” has 0 lists/, (s) => { s.pump_expected_pa = []; }],
    ['swing-velocity', /Swing: velocity: no value is known/,
      (s) => { gaps(s.velocity_wanted[3]); gaps(s.velocity_real[3]); }],
    ['cycle', /cycle_time_us” has 569/, (s) => s.cycle_time_us.pop()],
  ];
  for (const [id, sentence, change] of faults) {
    const report = changed(({series}) => change(series));
    assert.match(plot(report, id).body.problem, sentence);
    assert.deepEqual(report.plots.filter((p) => !p.body.ok).map((p) => p.id), [id]);
    assert.deepEqual(report.problems, [plot(report, id).body.problem]);
  }
});

test('unknown values are gaps, no faults', () => {
  const report = changed(({series}) => {
    for (const list of [series.lambda, series.progress, series.attitude_rad, series.real[1],
      series.velocity_real[3], series.pump_real_pa[0], series.teeth_m[0], series.limit]) {
      list[7] = null;
    }
    gaps(series.pump_expected_pa[0]);
    gaps(series.error_measured_m);
  });
  assert.deepEqual(report.problems, []);
  assert.equal(line(report, 'cylinder-displacement', 'arm real')[7], null);
});

test('no line, no distance from one; a line without a distance is told', () => {
  const noErrors = (run) => {
    gaps(run.series.error_true_m);
    gaps(run.series.error_measured_m);
  };
  assert.match(changed(noErrors).problems.join(), /Distance .* no value is known/);
  const report = changed((run) => {
    noErrors(run);
    run.steps[0].kind = 'drives';
  });
  assert.equal(plot(report, 'error'), undefined);
  assert.deepEqual(report.problems, []);
});

test('nothing at all gives sentences, not an exception', () => {
  for (const input of [{}, [], null, 'text', {series: null, steps: 1, fences: {}, design: 0},
    {kind: 'autodig', steps: good().steps, fences: []}]) {
    const report = autodig.prepare(input);
    assert.ok(report.problems.length >= 3);
    assert.ok(!report.space.ok && report.plots.every((p) => !p.body.ok));
    filled(report);
  }
});
