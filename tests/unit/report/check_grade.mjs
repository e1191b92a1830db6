// What the report's page shows of a grading run: right, missing and malformed data.
// Call: node check_grade.mjs FOLDER_OF_THE_PAGE
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

const folder = process.argv[2];
const files = ['report_checks.js', 'report_parts.js', 'report_grade.js', 'report_chart.js'];
const uPlot = {rangeNum: (min, max) => [min, max]};
const getComputedStyle = () => ({getPropertyValue: (name) => ` ${name}`});
const [grade, chart] = new Function('document', 'getComputedStyle', 'uPlot', `${
  files.map((file) => readFileSync(join(folder, file), 'utf8')).join('\n')}
  return [reportGrade, reportChart];`)({documentElement: {}}, getComputedStyle, uPlot);

/// The edge goes from 0 to 3 m, back a little on its way, the body 2 m behind it.
function good() {
  const both = (value) => [0, 1].map((i) => [0, value + i, value, 1]);
  return {
    kind: 'grade', speed_mode: 'bounded',
    summary: [{label: 'error', value: 1}], limits_share: [{name: 'none', share: 1}],
    terrain: [[-5, 0], [1, 0], [2, -0.5], [10, -0.5]],
    series: {
      time_s: [0, 1, 2, 3], edge_x_m: [0, 1.5, 1.4, 3], edge_z_m: [0, -0.25, -0.2, -0.5],
      body_x_m: [-2, -0.5, 0.5, 1], body_z_m: [0, 0, -0.1, -0.2],
      design_m: [0, -0.26, -0.21, -0.5], pitch_rad: [0, 0.1, -0.1, null],
      error_true_m: [0, 0.01, 0.01, 0], error_measured_m: [null, 0.012, 0.01, 0],
      speed_wanted_mps: [0, 1, 1, 0.5], speed_true_mps: [0, 0.9, 1, 0.6],
      speed_limit_mps: [1.8, 1.2, 1, 0.5], speed_desired_mps: 1.6,
      flow_required_m3ps: [0, 0.001, 0.0015, 0.00101],
      flow_reported_m3ps: [0, 0.001, 0.0014, 0.00101],
      flow_available_m3ps: [0.001, 0.001, 0.001, 0.001],
      lambda: [0, 0.5, 0.4, 0.6], limit: [0, 1, 1, 0], limit_names: ['none', 'implement flow'],
      blade_wanted_mps: [0, 0.1, 0.1, 0], blade_true_mps: [0, 0.1, 0.1, 0],
      spool_command: [0, 0.5, -0.5, 0], spool_real: [0, 0.4, -0.4, 0],
      track_mps: both(1), pump_command: both(0.5), pump_real: both(0.4), motor_command: both(0.6),
      motor_real: both(0.7),
    },
  };
}

const changed = (change) => {
  const input = good();
  change(input);
  return grade.prepare(input);
};
const plot = (report, id) => report.plots.find((p) => p.id === id);
const line = (report, id, label) =>
  plot(report, id).body.value.lines.find((one) => one.label === label).values;

test('a grading run is complete, in the page\'s units, the paper\'s figures first', () => {
  const report = grade.prepare(good());
  assert.deepEqual(report.problems, []);
  assert.equal(report.path, null);
  assert.deepEqual(report.plots.map((p) => p.id), ['elevation', 'error', 'speed', 'flow', 'limit',
    'lambda', 'blade', 'spool', 'pitch', 'track', 'pump', 'motor']);
  assert.deepEqual(report.plots.slice(0, 5).map((p) => p.source), ['Mononen, Fig. 7 (a)',
    'Mononen, Fig. 7 (b)', 'Mononen, Fig. 7 (c)', 'Mononen, Fig. 7 (d)', 'Mononen, Fig. 8']);
  assert.deepEqual(line(report, 'error', 'measured'), [null, 12, 10, 0]);
  assert.deepEqual(line(report, 'speed', 'desired'), [1.6, 1.6, 1.6, 1.6]);
  assert.deepEqual(line(report, 'flow', 'available').map(Math.round), [60, 60, 60, 60]);
  assert.deepEqual(line(report, 'flow', 'required').map(Math.round), [0, 60, 90, 61]);
  assert.deepEqual(line(report, 'limit', 'largest by (14)'), [1.8, 1.2, 1, 0.5]);
  assert.deepEqual(line(report, 'spool', 'real'), [0, 40, -40, 0]);
  assert.deepEqual(line(report, 'pump', 'right command'), [0, 150, 50, 100]);
  assert.equal(Math.round(line(report, 'pitch', 'pitch, nose up')[1]), 6);
  assert.equal(line(report, 'pitch', 'pitch, nose up')[3], null);
});

test('a constant speed gives the paper\'s Fig. 9', () => {
  const report = changed((d) => { d.speed_mode = 'constant'; });
  assert.deepEqual(report.plots.slice(0, 4).map((p) => p.source), Array(4).fill('Mononen, Fig. 9'));
});

test('every plot has an axis with a unit', () => {
  for (const p of grade.prepare(good()).plots) assert.match(p.axis, /\(.+\)$/);
});

test('the axis is the edge\'s way and never goes back', () => {
  const report = grade.prepare(good());
  assert.deepEqual(report.x.value, [0, 1.5, 1.5, 3]);
  const made = chart.options(plot(report, 'error'), 600,
      {x: report.x, shade: [], limitColour: () => 'limit0', mountLegend() {}, showAt() {}});
  assert.match(made.axes[0].label, /cutting edge.*\(m\)/);
  assert.equal(made.series[0].value(null, 1.5), '1.50 m');
});

test('ground and body stand where they are, not where they were seen from', () => {
  const report = grade.prepare(good());
  assert.deepEqual(line(report, 'elevation', 'ground as left'), [0, -0.25, -0.25, -0.5]);
  const body = line(report, 'elevation', 'body');
  assert.ok(Math.abs(body[0] - -0.05) < 1e-12);
  assert.deepEqual(body.slice(1), [null, null, null], 'the body has not been there yet');
  assert.deepEqual(grade.heights([[0, 0], [1, 2], [1, 3], [2, 4]], [-1, 0.5, 1, 2, 1.5, 3]),
      [null, 1, 2, 4, 3.5, null]);
});

test('where the blade needs more than there is, the plots are shaded', () => {
  const report = grade.prepare(good());
  assert.deepEqual(report.shade.value, [{from: 1.5, until: 3, value: true}]);
  assert.deepEqual(report.shade.named, [{from: 1.5, until: 3}]);
  assert.deepEqual(changed((d) => d.series.flow_required_m3ps.fill(0)).shade.value, []);
  const apart = changed((d) => {
    d.series.edge_x_m = [0, 1, 1.4, 3];
    d.series.flow_required_m3ps = [1, 0, 1, 0];
  });
  assert.deepEqual(apart.shade.named, [{from: 0, until: 3}], 'one occasion');
  const further = changed((d) => {
    d.series.edge_x_m = [0, 1, 1.6, 3];
    d.series.flow_required_m3ps = [1, 0, 1, 0];
  });
  assert.deepEqual(further.shade.named, [{from: 0, until: 1}, {from: 1.6, until: 3}]);
});

test('nothing at all gives sentences, not an exception', () => {
  for (const input of [{}, [], null, {series: null, terrain: 1}]) {
    const report = grade.prepare(input);
    assert.ok(report.problems.length >= 3);
    assert.ok(report.plots.every((p) => !p.body.ok && p.body.problem.length > 10));
  }
});

test('each fault is named, and costs only its own part', () => {
  const faults = [
    ['elevation', /“terrain” is missing/, (d) => delete d.terrain],
    ['elevation', /“terrain”, entry 2/, (d) => { d.terrain[1] = [1]; }],
    ['elevation', /“terrain” goes back/, (d) => { d.terrain[1][0] = -9; }],
    ['elevation', /“terrain” has fewer/, (d) => { d.terrain.length = 1; }],
    ['elevation', /series\.design_m.*3 values.*4/, (d) => d.series.design_m.pop()],
    ['error', /error_true_m” is missing/, (d) => delete d.series.error_true_m],
    ['speed', /speed_desired_mps” is missing/, (d) => delete d.series.speed_desired_mps],
    ['speed', /speed_desired_mps” is no number/, (d) => { d.series.speed_desired_mps = 'fast'; }],
    ['flow', /flow_reported_m3ps.*value 1.*"x".*no number/,
      (d) => { d.series.flow_reported_m3ps[0] = 'x'; }],
    ['limit', /speed_limit_mps” is missing/, (d) => delete d.series.speed_limit_mps],
    ['lambda', /limit.*value 3.*no name/, (d) => { d.series.limit[2] = 9; }],
    ['motor', /motor_real.*1 lists, not 2/, (d) => d.series.motor_real.pop()],
  ];
  for (const [id, sentence, change] of faults) {
    const report = changed(change);
    assert.match(plot(report, id).body.problem, sentence);
    assert.deepEqual(report.plots.filter((p) => !p.body.ok).map((p) => p.id), [id]);
    assert.equal(report.problems.length, 1);
  }
});

test('a gap in the way is named', () => {
  const report = changed((d) => { d.series.edge_x_m[2] = null; });
  assert.match(report.x.problem, /edge_x_m”, value 3/);
});
