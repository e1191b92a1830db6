// What the report's page shows of a planned line: right, missing and malformed data.
// Call: node check_plan.mjs FOLDER_OF_THE_PAGE
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

const folder = process.argv[2];
const files = ['report_checks.js', 'report_parts.js', 'report_svg.js', 'report_drives.js',
  'report_space.js', 'report_plan.js'];
const plan = new Function(`${
  files.map((file) => readFileSync(join(folder, file), 'utf8')).join('\n')}
  return reportPlan;`)();

function good() {
  const drives = (value) => [0, 1, 2, 3].map((i) => [0, value + i, 0]);
  return {
    kind: 'plan', title: 'line', summary: [{label: 'Line', value: '3.730', unit: 'm'}],
    series: {
      time_s: [0, 1, 2], way_m: [0, 0.5, 1], speed_mps: [0, 1, 0],
      teeth_m: [[0, 1, 2], [6, 5, 4], [0, 0, 0.1]], attitude_rad: [Math.PI, Math.PI / 2, 0],
      displacement: drives(0.5), velocity: drives(0.1), acceleration: drives(0.2),
    },
  };
}

const changed = (change) => {
  const input = good();
  change(input);
  return plan.prepare(input);
};
const lines = (report, id) => report.plots.find((p) => p.id === id).body.value.lines;

test('a plan is complete, in the page\'s units, in the order of the paper\'s figures', () => {
  const report = plan.prepare(good());
  assert.deepEqual(report.problems, []);
  assert.equal(report.limitsShare, null);
  assert.equal(report.path, null);
  assert.deepEqual(report.plots.map((p) => p.source), ['Zhang, Fig. 5 (a)', 'Zhang, Fig. 5 (b)',
    'Zhang, Fig. 6', 'Zhang, Fig. 6', 'Zhang, Fig. 8', 'Zhang, Fig. 8', 'Zhang, Fig. 9',
    'Zhang, Fig. 9', 'Zhang, Fig. 10', 'Zhang, Fig. 10']);
  assert.deepEqual(lines(report, 'way')[0].values, [0, 500, 1000]);
  assert.deepEqual(lines(report, 'speed')[0].values, [0, 1000, 0]);
  assert.deepEqual(lines(report, 'attitude')[0].values, [180, 90, 0]);
  assert.deepEqual(lines(report, 'place').map((line) => line.values[1]), [1, 5, 0]);
  assert.deepEqual(lines(report, 'cylinder-displacement').map((line) => line.label),
      ['boom', 'arm', 'bucket']);
  assert.deepEqual(lines(report, 'cylinder-velocity').map((line) => line.values[1]),
      [100, 1100, 2100]);
  assert.deepEqual(lines(report, 'cylinder-velocity').map((line) => [line.colour, line.wide]),
      [['boom', undefined], ['arm', undefined], ['bucket', undefined]]);
  assert.deepEqual(lines(report, 'swing-acceleration')[0].values[1], 3.2 * (180 / Math.PI));
});

test('the planned teeth are seen in space, and cost only themselves where they are missing', () => {
  const {value, problems} = plan.prepare(good()).space;
  assert.deepEqual(problems, []);
  assert.equal(value.real, null);
  assert.deepEqual(value.main, [[0, 6, 0], [1, 5, 0], [2, 4, 0.1]]);
  const report = changed((data) => delete data.series.teeth_m);
  assert.match(report.space.problem, /“series.teeth_m” is missing/);
  assert.deepEqual(report.problems, [report.space.problem], 'told once, of picture and plot');
  const unknown = changed((data) => data.series.teeth_m[2].fill(null));
  assert.deepEqual(unknown.problems, ['“series.teeth_m” has no point that is known.']);
});

test('what is missing or malformed is told once, and the rest stays', () => {
  const report = changed((data) => delete data.series.velocity);
  assert.deepEqual(report.problems, ['“series.velocity” is missing from the data.']);
  assert.equal(report.plots.filter((p) => p.body.ok).length, 8);
  assert.match(changed((data) => data.series.acceleration.pop()).problems.join(),
      /“series.acceleration” has 3 lists, not 4/);
  assert.match(changed((data) => data.series.way_m.pop()).problems.join(), /“series.way_m” has 2/);
  assert.match(changed((data) => delete data.series.time_s).problems.join(), /“series.time_s”/);
  assert.match(changed((data) => delete data.summary).problems.join(), /“summary”/);
  assert.ok(plan.prepare(null).problems.length > 0);
});
