// What the report's page shows of forces, tip velocity, ground and obstacle: right, missing and
// malformed data, and what is drawn of it.
// Call: node check_scene.mjs FOLDER_OF_THE_PAGE
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

const folder = process.argv[2];
// Stands in for the browser's: keeps what is drawn.
const document = {
  documentElement: {},
  createElement: () => ({}),
  createElementNS: (space, name) => ({
    name, attributes: {}, children: [],
    setAttribute(key, value) { this.attributes[key] = String(value); },
    append(...nodes) { this.children.push(...nodes); },
  }),
};
const getComputedStyle = () => ({getPropertyValue: (name) => ` ${name}`});
const uPlot = {rangeNum: (min, max) => [min, max]};
const files = ['report_checks.js', 'report_parts.js', 'report_svg.js', 'report_drives.js',
  'report_scene.js', 'report_data.js', 'report_path.js', 'report_chart.js'];
const [data, path, chart] = new Function('document', 'getComputedStyle', 'uPlot', `${
  files.map((file) => readFileSync(join(folder, file), 'utf8')).join('\n')}
  return [reportData, reportPath, reportChart];`)(document, getComputedStyle, uPlot);

/// A run into an obstacle, in soil: free, held twice, gone.
function good() {
  const three = (value) => [0, 1, 2].map((i) => [value * i, value, -value, 0]);
  return {
    summary: [{label: 'error', value: 1}], limits_share: [{name: 'none', share: 1}],
    geometry: {
      path: [[3, 0], [4, 0], [4, -2], [3, -2]], tip_true: [[4, 0], [4, -1], [4, -1.5], [3.5, -2]],
      tip_measured: [[4, 0]], field: [[3, 0, 1, 0]], marks: [], start: [4, 0], ground_y_m: -0.5,
      obstacle: {point: [4, -1.5], normal: [0, 2], size_m: 0.5},
    },
    series: {
      time_s: [0, 1, 2, 3], lambda: [1, 0.5, 0, 1], limit: [0, 0, 0, 0], limit_names: ['none'],
      spool_command: three(0.5), spool_real: three(0.4),
      velocity_wanted: three(0.1), velocity_real: three(0.2),
      pump_pressure_expected: [[1, 2, 3, 4]], pump_pressure_real: [[1, 2, 3, 4]],
      error_true_m: [0, 0, 0, 0], error_measured_m: [0, 0, 0, 0],
      tip_force_n: [[0, 1000, null, 2500], [0, -500, 0, 0]],
      tip_velocity_mps: [[0, 0.25, 0, -1], [0, -0.5, null, 1]],
      obstruction: [0, 1, 1, 2],
    },
  };
}

const changed = (change) => {
  const input = good();
  change(input);
  return data.prepare(input);
};
const plot = (report, id) => report.plots.find((p) => p.id === id);
const ids = (report) => report.plots.map((p) => p.id);
const forget = (d) => {
  for (const key of ['tip_force_n', 'tip_velocity_mps', 'obstruction']) delete d.series[key];
  delete d.geometry.obstacle;
  delete d.geometry.ground_y_m;
};
const clear = (d) => {
  delete d.geometry.obstacle;
  d.series.obstruction.fill(0);
};

function drawn(report, hidden = []) {
  const {svg} = path.draw(report.path.value, 800, new Set(hidden));
  const all = (node) => [node, ...node.children.flatMap(all)];
  return {
    ofClass: (name) => all(svg).filter((node) => node.attributes.class === name),
    texts: all(svg).map((node) => node.textContent).filter(Boolean),
  };
}

test('a run into an obstacle is complete, in the order of the paper\'s figures', () => {
  const report = data.prepare(good());
  assert.deepEqual(report.problems, []);
  assert.deepEqual(report.plots.map((p) => p.source ?? ''), ['Kim, Fig. 10', 'Kim, Fig. 11',
    'Kim, Fig. 12', 'Kim, Fig. 13', 'Kim, Fig. 13', 'Kim, Fig. 13', 'Kim, Fig. 15', '', '']);
  for (const p of report.plots) assert.match(p.axis, /\(.+\)$/);
});

test('the path\'s figure is the one with or without an obstacle', () => {
  assert.equal(data.prepare(good()).path.source, 'Kim, Fig. 14');
  assert.equal(changed(clear).path.source, 'Kim, Fig. 9');
});

test('the force is in kN, x and y', () => {
  const {axis, body} = plot(data.prepare(good()), 'force');
  assert.match(axis, /kN/);
  assert.deepEqual(body.value.lines.map((line) => line.values),
      [[0, 1, null, 2.5], [0, -0.5, 0, 0]]);
});

test('no force, no plot of it, and no complaint', () => {
  for (const values of [[0, 0, 0, 0], [0, null, 0, 0]]) {
    const report = changed((d) => { d.series.tip_force_n = [values, values]; });
    assert.equal(plot(report, 'force'), undefined);
    assert.deepEqual(report.problems, []);
  }
});

test('the tip velocity has lambda with it, in its own unit and on its own axis', () => {
  const [x, y, lambda] = plot(data.prepare(good()), 'tip-velocity').body.value.lines;
  assert.deepEqual(x.values, [0, 0.25, 0, -1]);
  assert.deepEqual(y.values, [0, -0.5, null, 1]);
  assert.deepEqual([lambda.values, lambda.scale, lambda.unit], [[1, 0.5, 0, 1], 'lambda', '']);
  assert.equal(new Set([x, y, lambda].map((line) => line.colour)).size, 3);
});

test('without lambda the tip velocity stays; lambda\'s own plot complains', () => {
  const report = changed((d) => { d.series.lambda[1] = 'x'; });
  assert.equal(plot(report, 'tip-velocity').body.value.lines.length, 2);
  assert.equal(plot(report, 'lambda').body.ok, false);
  assert.equal(report.problems.length, 1);
});

test('a report from before all this misses nothing', () => {
  const report = changed(forget);
  assert.deepEqual(report.problems, []);
  assert.equal(plot(report, 'force'), undefined);
  assert.equal(plot(report, 'tip-velocity'), undefined);
  assert.deepEqual(report.shade.value, []);
  const {groundY, obstacle, changes} = report.path.value;
  assert.deepEqual([groundY, obstacle, changes], [null, null, []]);
});

test('each fault in a plot is named, and costs only this plot', () => {
  const faults = [
    ['force', /“series\.tip_force_n” is missing/, (d) => delete d.series.tip_force_n],
    ['force', /tip_force_n.*is missing/, (d) => { d.series.tip_force_n = null; }],
    ['force', /tip_force_n.*1 lists, not 2/, (d) => d.series.tip_force_n.pop()],
    ['force', /tip_force_n\[1\].*3 values.*4/, (d) => d.series.tip_force_n[1].pop()],
    ['force', /tip_force_n\[0\].*value 2.*no number/,
      (d) => { d.series.tip_force_n[0][1] = '1'; }],
    ['tip-velocity', /tip_velocity_mps” is missing/, (d) => delete d.series.tip_velocity_mps],
    ['tip-velocity', /tip_velocity_mps.*not a list/, (d) => { d.series.tip_velocity_mps = 1; }],
    ['tip-velocity', /tip_velocity_mps\[0\].*not a list/,
      (d) => { d.series.tip_velocity_mps[0] = {}; }],
  ];
  for (const [id, sentence, change] of faults) {
    const report = changed(change);
    assert.match(plot(report, id).body.problem, sentence);
    assert.equal(report.problems.length, 1);
    assert.deepEqual(report.plots.filter((p) => !p.body.ok).map((p) => p.id), [id]);
    assert.equal(report.path.problems.length, 0);
  }
});

test('each fault in what the bucket met is named, and the path stays', () => {
  const faults = [
    [/ground_y_m”: "high" is no number/, (d) => { d.geometry.ground_y_m = 'high'; }],
    [/obstacle\.point” is missing/, (d) => delete d.geometry.obstacle.point],
    [/obstacle” is missing/, (d) => delete d.geometry.obstacle],
    [/obstacle\.point” is missing/, (d) => { d.geometry.obstacle = 'rock'; }],
    [/obstacle\.normal.*not 2 numbers/, (d) => { d.geometry.obstacle.normal = [1]; }],
    [/obstacle\.normal.*no direction/, (d) => { d.geometry.obstacle.normal = [0, 0]; }],
    [/size_m.*-1 is no size/, (d) => { d.geometry.obstacle.size_m = -1; }],
    [/size_m.*"1" is no size/, (d) => { d.geometry.obstacle.size_m = '1'; }],
    [/tip_true.*3 points.*4 values/, (d) => d.geometry.tip_true.pop()],
    [/“series\.obstruction” is missing/, (d) => delete d.series.obstruction],
    [/obstruction.*value 4: 7 is not 0, 1 or 2/, (d) => { d.series.obstruction[3] = 7; }],
    [/obstruction.*value 1: null is not/, (d) => { d.series.obstruction[0] = null; }],
    [/obstruction.*3 values.*4/, (d) => d.series.obstruction.pop()],
  ];
  for (const [sentence, change] of faults) {
    const report = changed(change);
    assert.deepEqual(report.path.problems, report.problems);
    assert.equal(report.problems.length, 1);
    assert.match(report.problems[0], sentence);
    assert.ok(report.plots.every((p) => p.body.ok));
    assert.equal(drawn(report).ofClass('path').length, 1);
  }
});

test('what the path and the obstacle both miss is said once', () => {
  const report = changed((d) => delete d.geometry.tip_true);
  assert.match(report.path.problem, /tip_true” is missing/);
  assert.deepEqual([report.problems.length, report.path.problems], [1, []]);
});

test('without an obstacle nobody asks when it held', () => {
  const report = changed((d) => { clear(d); d.geometry.tip_true.pop(); });
  assert.deepEqual(report.problems, []);
  assert.deepEqual(report.shade.value, []);
  assert.deepEqual(report.path.value.changes, []);
});

test('the obstacle holds until the sample that finds it gone', () => {
  const report = data.prepare(good());
  assert.deepEqual(report.shade.value.map((run) => [run.from, run.until]), [[1, 3]]);
  assert.deepEqual(report.path.value.changes, [
    {x: 4, y: -1, time_s: 1, holds: true}, {x: 3.5, y: -2, time_s: 3, holds: false}]);
});

test('an obstacle is marked too where nothing ever touches it', () => {
  const report = changed((d) => d.series.obstruction.fill(0));
  assert.deepEqual(report.problems, []);
  assert.equal(drawn(report).ofClass('obstacle').length, 1);
  assert.equal(drawn(report).ofClass('held').length, 0);
});

test('the obstacle lies behind its face, whatever the length of the normal', () => {
  const outline = (normal) => changed((d) => { d.geometry.obstacle.normal = normal; })
      .path.value.obstacle.outline;
  assert.deepEqual(outline([0, 2]), [[4.5, -1.5], [3.5, -1.5], [3.5, -2], [4.5, -2]]);
  assert.deepEqual(outline([2, 0]), [[4, -2], [4, -1], [3.5, -1], [3.5, -2]]);
});

test('ground, obstacle and where it held are drawn', () => {
  const picture = drawn(data.prepare(good()));
  const [ground] = picture.ofClass('ground');
  const y = path.layout(data.prepare(good()).path.value, 800).view.py(-0.5);
  assert.match(ground.attributes.d, new RegExp(`^M66,${y}H`));
  for (const text of ['ground', 'held 1.0 s', 'let go 3.0 s']) {
    assert.ok(picture.texts.includes(text), text);
  }
  for (const name of ['obstacle', 'face', 'held', 'let-go']) {
    assert.equal(picture.ofClass(name).length, 1, name);
  }
});

test('the ground line is dashed', () => {
  const css = readFileSync(join(folder, 'report.css'), 'utf8');
  assert.match(css, /#path \.ground \{[^}]*stroke-dasharray/);
});

test('neither soil nor obstacle, nothing of them drawn', () => {
  const picture = drawn(changed((d) => { clear(d); d.geometry.ground_y_m = null; }));
  for (const name of ['ground', 'obstacle', 'face', 'held', 'let-go']) {
    assert.equal(picture.ofClass(name).length, 0, name);
  }
  assert.ok(!picture.texts.includes('ground'));
});

test('the reader can hide the obstacle', () => {
  const picture = drawn(data.prepare(good()), ['obstacle']);
  assert.deepEqual([...picture.ofClass('obstacle'), ...picture.ofClass('held')], []);
});

test('an obstacle beside the path is inside the picture', () => {
  const report = changed((d) => { d.geometry.obstacle.point = [9, -5]; });
  const {obstacle, frame} = path.layout(report.path.value, 800);
  for (const [x, y] of obstacle) {
    assert.ok(x > frame.left && x < frame.right && y > frame.top && y < frame.bottom);
  }
});

test('the ground\'s name keeps off the path', () => {
  const report = changed((d) => { d.geometry.path = [[3, 0], [9, -0.45], [9.2, -0.45], [3, -2]]; });
  const narrow = path.layout(report.path.value, 360);
  const {groundLabel: box} = narrow;
  assert.ok(box.x + box.w / 2 < narrow.frame.right && box.x - box.w / 2 > narrow.frame.left);
  for (const [x, y] of [...narrow.path, ...narrow.tipTrue]) {
    assert.ok(Math.abs(x - box.x) > box.w / 2 || Math.abs(y - box.y) > box.h / 2);
  }
});

/// A chart of 100 pixels to the second that keeps what is filled.
function canvas(seen = {from: 0, until: 3}) {
  const filled = [];
  const ctx = {save() {}, restore() {}, beginPath() {}, rect() {}, clip() {},
    fillRect(...box) { filled.push({colour: this.fillStyle, box}); }};
  return {ctx, filled, series: [{}, {}, {show: true}],
    bbox: {left: seen.from * 100, top: 10, width: (seen.until - seen.from) * 100, height: 50},
    valToPos: (value) => value * 100};
}

const optionsOf = (report, id) => chart.options(plot(report, id), 600,
    {x: report.x, shade: report.shade.value, limitColour: () => 'limit0', mountLegend() {}, showAt() {}});

test('every plot over time is shaded while the obstacle holds, and only then', () => {
  const report = data.prepare(good());
  for (const id of ids(report)) {
    const sheet = canvas();
    optionsOf(report, id).hooks.drawAxes.forEach((hook) => hook(sheet));
    const shades = sheet.filled.filter(({colour}) => colour === '--shade');
    assert.deepEqual(shades.map(({box}) => box), [[100, 10, 200, 50]], id);
  }
  const free = canvas();
  optionsOf(changed(clear), 'lambda').hooks.drawAxes.forEach((hook) => hook(free));
  assert.deepEqual(free.filled, []);
});

test('a shade outside the zoomed time is not drawn, a short one is', () => {
  const far = canvas({from: 5, until: 8});
  chart.drawShade(far, [{from: 1, until: 3}]);
  assert.deepEqual(far.filled, []);
  const short = canvas();
  chart.drawShade(short, [{from: 1, until: 1}]);
  assert.equal(short.filled[0].box[2], 1);
});

test('lambda and the velocity have a band each, and one instant one column', () => {
  const report = data.prepare(good());
  const {scales, axes, series, padding} = optionsOf(report, 'tip-velocity');
  const [low, top] = scales.y.range({}, -1, 1);
  const [lambdaLow, lambdaTop] = scales.lambda.range;
  const share = (value, from, until) => (value - from) / (until - from);
  assert.ok(share(1, low, top) < share(0, lambdaLow, lambdaTop));
  assert.ok(share(1, lambdaLow, lambdaTop) < 1);
  assert.deepEqual(axes[1].filter({scales: {y: {min: low, max: top}}}, [0, 1, 1.5]), [0, 1, null]);
  assert.ok(scales.y.range({}, null, null).every(Number.isFinite), 'nothing but gaps');
  assert.equal(series[3].scale, 'lambda');
  assert.match(series[3].value(null, 0.5), /^0\.500$/);
  assert.match(series[1].value(null, 0.5), /m\/s$/);
  const right = (made) => made.padding[1] +
      made.axes.filter((axis) => axis.side === 1).reduce((sum, axis) => sum + axis.size, 0);
  assert.equal(padding[1], 0);
  for (const id of ids(report)) {
    assert.equal(right(optionsOf(report, id)), right(optionsOf(report, 'tip-velocity')), id);
  }
});
