// What the report's page computes from good, empty and malformed data.
// Call: node check_report.mjs FOLDER_OF_THE_PAGE
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

const folder = process.argv[2];
// As in the page: one script after the other in one scope.
const files = ['report_checks.js', 'report_parts.js', 'report_svg.js', 'report_drives.js',
  'report_scene.js', 'report_data.js', 'report_path.js'];
const [checks, parts, svg, data, path] = new Function(`${
  files.map((file) => readFileSync(join(folder, file), 'utf8')).join('\n')}
  return [reportChecks, reportParts, reportSvg, reportData, reportPath];`)();

/// As written before forces, tip velocity and obstacle were recorded.
function good() {
  const three = (value) => [0, 1, 2].map((i) => [value * i, value, -value]);
  return {
    title: 'Run', subtitle: 'seed 1',
    summary: [{label: 'error', value: 42.5678, unit: 'mm', note: 'largest'},
      {label: 'laps', value: '2', unit: ''}],
    limits_share: [{name: 'none', share: 0.25}, {name: 'pump flow: Pump 1', share: 0.75}],
    geometry: {
      path: [[3, 0], [4, 0], [4, -1], [3, -1]], tip_true: [[3, 0], [3.5, 0], [4, 0]],
      tip_measured: [[3, 0], [null, null], [4, 0]], field: [[3, 0, 1, 0], [4, 0, 0, -2]],
      ground_y_m: -0.5,
      marks: [{x: 4, y: 0, attitude_deg: 44.6, time_s: 5}], start: [3, 0],
    },
    series: {
      time_s: [0, 0.01, 0.02], lambda: [1, 0.5, null], limit: [0, 1, 1],
      limit_names: ['none', 'pump flow: Pump 1'],
      spool_command: three(0.5), spool_real: three(0.4),
      velocity_wanted: three(0.1), velocity_real: three(0.2),
      pump_pressure_expected: [[1e6, 2e6, 3e6], [4e6, 5e6, 6e6]],
      pump_pressure_real: [[1e6, 2e6, 3e6], [4e6, 5e6, 6e6]],
      error_true_m: [0, 0.01, 0.046], error_measured_m: [0, null, 0.04],
    },
  };
}

const plot = (report, id) => report.plots.find((p) => p.id === id);
const broken = (change) => {
  const input = good();
  change(input);
  return data.prepare(input);
};

test('good data is complete and in the page\'s units', () => {
  const report = data.prepare(good());
  assert.deepEqual(report.problems, []);
  assert.deepEqual(report.plots.map((p) => p.id),
      ['lambda', 'spool', 'velocity-boom', 'velocity-arm', 'velocity-bucket', 'pressure', 'error']);
  assert.equal(report.summary.value[0].value, '42.57');
  assert.equal(report.summary.value[1].note, '');
  assert.deepEqual(plot(report, 'spool').body.value.lines[3].values, [0, 40, -40]);
  assert.equal(plot(report, 'spool').body.value.lines[3].label, 'boom real');
  assert.deepEqual(plot(report, 'pressure').body.value.lines[1].values, [4, 5, 6]);
  assert.deepEqual(plot(report, 'error').body.value.lines[0].values, [0, null, 40]);
  assert.deepEqual(plot(report, 'lambda').body.value.lines[0].values, [1, 0.5, null]);
  assert.equal(report.path.value.tipMeasured.length, 2);
  assert.deepEqual(report.limitsShare.value.map((row) => row.share), [0.75, 0.25]);
});

test('cycle time is shown only when it is there', () => {
  const report = broken((d) => { d.series.cycle_time_us = [200, 210, 190]; });
  assert.deepEqual(plot(report, 'cycle').body.value.lines[0].values, [200, 210, 190]);
});

test('every plot has an axis with a unit', () => {
  for (const p of data.prepare(good()).plots) assert.match(p.axis, /\(.+\)$/);
});

test('nothing at all gives sentences, not an exception', () => {
  for (const input of [{}, [], null, 'text', 3, {series: null, geometry: [], summary: {}}]) {
    const report = data.prepare(input);
    assert.ok(report.problems.length >= 3);
    assert.ok(report.plots.every((p) => !p.body.ok && p.body.problem.length > 10));
    assert.equal(report.title, 'Simulated run');
  }
});

test('an empty run says so', () => {
  const report = broken((d) => { d.series.time_s = []; });
  assert.match(report.x.problem, /time_s.*fewer than two/);
  assert.equal(report.path.ok, true);
});

test('each fault is named, and costs only its own part', () => {
  const faults = [
    ['pressure', /pump_pressure_real.*missing/, (d) => delete d.series.pump_pressure_real],
    ['pressure', /differ in the number of pumps/, (d) => d.series.pump_pressure_real.pop()],
    ['lambda', /series\.lambda.*value 2.*"x".*no number/, (d) => { d.series.lambda[1] = 'x'; }],
    ['lambda', /limit.*value 3.*no name/, (d) => { d.series.limit[2] = 9; }],
    ['error', /error_true_m.*2 values.*3/, (d) => d.series.error_true_m.pop()],
    ['spool', /spool_real.*2 lists, not 3/, (d) => d.series.spool_real.pop()],
    ['spool', /spool_command\[1\].*not a list/, (d) => { d.series.spool_command[1] = 0; }],
  ];
  for (const [id, sentence, change] of faults) {
    const report = broken(change);
    assert.match(plot(report, id).body.problem, sentence);
    assert.equal(report.plots.filter((p) => !p.body.ok).length, 1);
    assert.equal(report.problems.length, 1);
  }
});

test('faults of the other parts are named', () => {
  const faults = [
    [/“geometry\.tip_true” is missing/, (d) => delete d.geometry.tip_true],
    [/geometry\.path.*entry 2/, (d) => { d.geometry.path[1] = [1, null]; }],
    [/geometry\.path.*fewer than 3/, (d) => { d.geometry.path = [[0, 0]]; }],
    [/geometry\.marks.*entry 1/, (d) => { d.geometry.marks[0] = {x: 1}; }],
    [/geometry\.start/, (d) => { d.geometry.start = 'here'; }],
    [/limits_share.*entry 2/, (d) => { d.limits_share[1].share = 1.5; }],
    [/limits_share.*empty/, (d) => { d.limits_share = []; }],
    [/summary.*entry 1/, (d) => { d.summary[0] = null; }],
    [/time_s.*value 3.*follow/, (d) => { d.series.time_s[2] = 0; }],
  ];
  for (const [sentence, change] of faults) {
    const {problems} = broken(change);
    assert.equal(problems.length, 1);
    assert.match(problems[0], sentence);
  }
});

test('a limit holds until the next sample, and not across a gap', () => {
  const runs = checks.runs([0, 1, 2, 3, 4, 5], [0, 0, 1, null, 1, 0]);
  assert.deepEqual(runs, [
    {from: 0, until: 2, value: 0}, {from: 2, until: 3, value: 1},
    {from: 4, until: 5, value: 1}, {from: 5, until: 5, value: 0}]);
});

test('a limit has one colour everywhere, "none" the neutral one', () => {
  const input = good();
  input.series.limit_names.push('spool travel: arm');
  assert.deepEqual([...parts.limitColours(input)],
      [['none', 0], ['pump flow: Pump 1', 1], ['spool travel: arm', 2]]);
});

test('numbers read as they should', () => {
  assert.equal(parts.formatKey(12345.678), '12346');
  assert.equal(parts.formatKey(0.000123456), '0.0001235');
  assert.equal(parts.formatKey(NaN), '–');
  assert.equal(parts.formatLive(-0.25, 2, 'm/s'), '−0.25 m/s');
  assert.equal(parts.formatLive(null, 2, 'm/s'), '–');
  assert.equal(parts.formatShare(0.0004), '< 0.1 %');
  assert.equal(parts.formatShare(0), '0.0 %');
});

test('the path has one scale in both directions', () => {
  const geometry = data.prepare(good()).path.value;
  for (const width of [320, 800, 2000]) {
    const {view, arrows, marks, frame} = path.layout(geometry, width);
    assert.ok(Math.abs((view.px(4) - view.px(3)) - (view.py(0) - view.py(1))) < 1e-9);
    assert.ok(view.px(3) > frame.left && view.px(4) < frame.right);
    assert.ok(view.py(0) > frame.top && view.py(-1) < frame.bottom);
    assert.equal(arrows.length, 2);
    assert.ok(arrows[1].dy > 0, 'down in metres is down on the page');
    assert.equal(marks[0].text, '45°');
  }
});

test('a run that never moves can still be drawn', () => {
  const geometry = {path: [[1, 1], [1, 1], [1, 1]], tipTrue: [[1, 1]], tipMeasured: [], field: [],
    groundY: null, marks: [], start: [1, 1]};
  const {view} = path.layout(geometry, 600);
  assert.ok(Number.isFinite(view.px(1)) && Number.isFinite(view.height));
});

test('labels keep off the lines where they can, and stay where they cannot', () => {
  const frame = {left: 0, right: 400, top: 0, bottom: 400};
  const [centre, mark] = [{x: 200, y: 200}, {x: 300, y: 200, width: 60}];
  const place = (lines) => svg.placeLabels([mark], centre, frame, [], lines)[0];
  assert.ok(place([]).x - 30 > 300, 'outwards');
  const clear = place([[340, 200]]);
  assert.ok(Math.abs(clear.x - 340) > 30 || Math.abs(clear.y - 200) > 9);
  const everywhere = Array.from({length: 6400}, (_, i) => [i % 80 * 5, Math.floor(i / 80) * 5]);
  assert.deepEqual(place(everywhere), place([]));
});

test('labels never overlap, whatever the number of marks', () => {
  const marks = Array.from({length: 120}, (_, i) => (
    {x: 300 + 150 * Math.cos(i / 9), y: 300 + 150 * Math.sin(i / 9)}));
  const frame = {left: 60, right: 600, top: 10, bottom: 600};
  const places = svg.placeLabels(marks, {x: 300, y: 300}, frame, []).filter(Boolean);
  assert.ok(places.length > 10);
  places.forEach((a, i) => places.slice(0, i).forEach((b) => assert.ok(
      Math.abs(a.x - b.x) >= a.w || Math.abs(a.y - b.y) >= a.h)));
});

test('thinning keeps both ends', () => {
  const line = Array.from({length: 30000}, (_, i) => [i * 0.01, 0]);
  const kept = svg.thin(line, 0.5);
  assert.ok(kept.length < 700);
  assert.deepEqual([kept[0], kept[kept.length - 1]], [line[0], line[29999]]);
});

test('ticks are round and inside', () => {
  assert.deepEqual(svg.ticks(-2.9, 0.4, 7).map((t) => t.text),
      ['−2.5', '−2.0', '−1.5', '−1.0', '−0.5', '0.0']);
});

test('the lock pins contents, not a server', () => {
  const {packages} = JSON.parse(readFileSync(join(folder, 'package-lock.json'), 'utf8'));
  const locked = Object.entries(packages).filter(([name]) => name !== '');
  assert.ok(locked.length > 0);
  for (const [, entry] of locked) {
    assert.match(entry.integrity, /^sha512-/);
    assert.equal(entry.resolved, undefined);
  }
});
