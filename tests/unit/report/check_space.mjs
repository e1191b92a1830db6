// What the report's page shows of the teeth's path in space: right, missing and malformed data, and
// what is drawn of it.
// Call: node check_space.mjs FOLDER_OF_THE_PAGE
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

const folder = process.argv[2];
// Stands in for the browser's: keeps what is drawn.
const document = {createElementNS: (space, name) => ({
  name, attributes: {}, children: [],
  setAttribute(key, value) { this.attributes[key] = String(value); },
  append(...nodes) { this.children.push(...nodes); },
})};
const files = ['report_checks.js', 'report_parts.js', 'report_svg.js', 'report_space.js'];
const space = new Function('document', `${
  files.map((file) => readFileSync(join(folder, file), 'utf8')).join('\n')}
  return reportSpace;`)(document);

/// A quarter turn at 5 m, 1 m up, then 2 m down; the real teeth a centimetre higher.
function good() {
  const turn = [0, 1, 2, 3, 4].map((i) => i * Math.PI / 8);
  const x = [...turn.map((a) => 5 * Math.cos(a)), 0, 0];
  const y = [...turn.map((a) => 5 * Math.sin(a)), 5, 5];
  const z = [1, 1, 1, 1, 1, 0, -1];
  return {series: {time_s: [0, 1, 2, 3, 4, 5, 6], planned_m: [x, y, z],
    teeth_m: [[...x], [...y], z.map((value) => value + 0.01)]}};
}
const NAMES = {planned: 'planned_m', real: 'teeth_m'};
const STEPS = [{from: 0, until: 4, number: 1}, {from: 4, until: 6, number: 2},
  {from: 9, until: 10, number: 3}];

const pictureOf = (change = () => {}, names = NAMES) => {
  const input = good();
  change(input.series);
  return space.picture(input, names, STEPS);
};

function drawn(picture, {width = 1200, hidden = []} = {}) {
  const made = space.draw(picture.value, width, new Set(hidden));
  const all = (node) => [node, ...node.children.flatMap(all)];
  const nodes = made.views.map(({svg}) => all(svg));
  return {...made,
    ofClass: (name) => nodes.map((list) => list.filter((node) => node.attributes.class === name)),
    texts: nodes.map((list) => list.map((node) => node.textContent).filter(Boolean))};
}

test('planned and real teeth are seen in three views, with axes and their units', () => {
  const picture = drawn(pictureOf());
  assert.equal(picture.views.length, 3);
  for (const name of ['planned', 'real']) {
    for (const [line] of picture.ofClass(name)) assert.match(line.attributes.d, /^M[\d.,L]+$/);
  }
  assert.ok(['x, forward (m)', 'y, left (m)'].every((text) => picture.texts[0].includes(text)));
  assert.ok(['radius from the swing axis (m)', 'z, up (m)'].every(
      (text) => picture.texts[1].includes(text)));
  assert.ok(['x (m)', 'y (m)', 'z (m)'].every((text) => picture.texts[2].includes(text)));
  for (const texts of picture.texts) {
    for (const text of ['start', 'end', '1', '2']) assert.ok(texts.includes(text), text);
  }
  assert.ok(picture.texts.slice(0, 2).every((texts) => texts.includes('swing axis')));
});

test('each view has one scale, and the swing axis in it', () => {
  for (const width of [320, 690, 1200, 2400]) {
    for (const plan of space.layout(pictureOf().value, width)) {
      const far = (a, b) => {
        const [p, q] = [a, b].map(plan.toPx);
        return Math.hypot(p[0] - q[0], p[1] - q[1]) / plan.view.scale;
      };
      const near = (value, wanted) => assert.ok(Math.abs(value - wanted) < 1e-9, plan.id);
      const {frame} = plan.view;
      const [x, y] = plan.toPx([0, 0, 0]);
      assert.ok(x > frame.left && x < frame.right && y > frame.top && y < frame.bottom, plan.id);
      if (plan.id === 'above') {
        near(far([0, 0, 0], [3, 4, 9]), 5);
      } else if (plan.id === 'side') {
        near(far([0, 0, 0], [3, 4, 0]), 5);
        near(far([0, 3, 0], [3, 0, 2]), 2);
      } else {
        // Of a true projection the squares of the three foreshortened metres have a sum of 2.
        const [a, b, c] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((unit) => far([0, 0, 0], unit));
        near(a * a + b * b + c * c, 2);
      }
      for (const [px, py] of [...plan.planned, ...plan.real].flat()) {
        assert.ok(px > frame.left && px < frame.right && py > frame.top && py < frame.bottom);
      }
    }
  }
});

test('left and up are left and up of it', () => {
  const [above, side, corner] = space.layout(pictureOf().value, 1200);
  assert.ok(above.toPx([1, 0, 0])[0] > above.toPx([0, 0, 0])[0]);
  assert.ok(above.toPx([0, 1, 0])[1] < above.toPx([0, 0, 0])[1]);
  assert.ok(side.toPx([1, 0, 1])[1] < side.toPx([1, 0, 0])[1]);
  for (const [unit, dx, dy] of [[[1, 0, 0], 1, 1], [[0, 1, 0], 1, -1], [[0, 0, 1], 0, -1]]) {
    const [[x0, y0], [x1, y1]] = [corner.toPx([0, 0, 0]), corner.toPx(unit)];
    assert.deepEqual([Math.sign(Math.round(x1 - x0)), Math.sign(y1 - y0)], [dx, dy]);
  }
});

test('as many views beside each other as there is room for', () => {
  const widths = (width) => space.layout(pictureOf().value, width).map(({view}) => view.width);
  assert.deepEqual(widths(330), [330, 330, 330]);
  assert.deepEqual(widths(690), [336, 336, 336]);
  assert.deepEqual(widths(1200), [388, 388, 388]);
  assert.deepEqual(widths(2400), [788, 788, 788]);
});

test('points are at equal times, round and few, straight between samples', () => {
  const line = Array.from({length: 11}, (_, i) => [i * i, 0, 0]);
  const times = line.map((_, i) => i);
  const made = space.atEqualTimes(times, line);
  assert.equal(made.interval_s, 0.2);
  assert.equal(made.points.length, 51);
  assert.ok(Math.abs(made.points[13][0] - (4 + 0.6 * 5)) < 1e-9);
  assert.deepEqual(made.points[50], [100, 0, 0]);
  const long = space.atEqualTimes([0, 1e5], [[0, 0, 0], [1, 0, 0]]);
  assert.ok(long.points.length >= 60 && long.points.length <= 61);
  assert.equal(space.atEqualTimes([2, 2], [[0, 0, 0], [1, 0, 0]]).points.length, 1);
});

test('a gap stays a gap', () => {
  const picture = pictureOf((series) => {
    series.teeth_m[1][2] = null;
    series.teeth_m[2][6] = null;
  });
  assert.deepEqual(picture.problems, []);
  assert.deepEqual(picture.value.end.map(Math.round), [0, 5, 0]);
  assert.equal(picture.value.real[2], null);
  const [above] = drawn(picture).ofClass('real')[0];
  assert.equal(above.attributes.d.match(/M/g).length, 2);
  assert.ok(picture.value.points.every((point) => point.every(Number.isFinite)));
  assert.equal(picture.value.points.length, 61 - 19 - 10, 'no point beside a gap');
});

test('of points that lie on one another a picture keeps the ends, and every gap', () => {
  const slow = Array.from({length: 3001}, (_, i) => 5 + i * 1e-4);
  slow[1500] = null;
  const picture = space.picture({series: {time_s: slow.map((_, i) => i),
    planned_m: [slow, slow.map(() => 0), slow.map(() => 0)]}}, {planned: 'planned_m'});
  const {planned, main} = picture.value;
  assert.equal(main.length, 3001, 'the cursor needs them all');
  assert.ok(planned.length < 110, String(planned.length));
  const gap = planned.indexOf(null);
  assert.deepEqual([0, gap - 1, gap + 1, planned.length - 1].map((i) => planned[i][0]),
      [5, slow[1499], slow[1501], slow[3000]]);
});

test('a missing line costs itself, and is told; without both there is no picture', () => {
  const faults = [
    [/“series.planned_m” is missing/, (series) => delete series.planned_m, 'planned'],
    [/“series.teeth_m” has 2 lists, not 3/, (series) => series.teeth_m.pop(), 'real'],
    [/“series.teeth_m\[1\]” has 6 values/, (series) => series.teeth_m[1].pop(), 'real'],
    [/“series.teeth_m\[0\]”, value 3: "x" is no number/,
      (series) => { series.teeth_m[0] = [0, 0, 'x', 0, 0, 0, 0]; }, 'real'],
    [/“series.teeth_m” has no point that is known/,
      (series) => { series.teeth_m[2] = Array(7).fill(null); }, 'real'],
  ];
  for (const [sentence, change, lost] of faults) {
    const picture = pictureOf(change);
    assert.ok(picture.ok);
    assert.equal(picture.value[lost], null);
    assert.equal(picture.problems.length, 1);
    assert.match(picture.problems[0], sentence);
    assert.equal(drawn(picture).views.length, 3);
  }
  const nothing = pictureOf((series) => delete series.time_s);
  assert.deepEqual([nothing.ok, nothing.problems], [false, []]);
  assert.match(nothing.problem, /time_s/);
  const both = pictureOf((series) => { delete series.planned_m; delete series.teeth_m; });
  assert.match(both.problem, /teeth_m/);
  assert.match(both.problems.join(), /planned_m/);
  for (const input of [{}, [], null, 'text', {series: 3}]) {
    assert.equal(space.picture(input, NAMES, STEPS).ok, false);
  }
});

test('teeth that never move can still be drawn, and those far below the ground too', () => {
  for (const at of [[3, 0, 0], [0, 0, 0]]) {
    const still = pictureOf((series) => {
      series.planned_m = at.map((value) => Array(7).fill(value));
      delete series.teeth_m;
    });
    for (const {view} of space.layout(still.value, 400)) {
      assert.ok(Number.isFinite(view.height) && Number.isFinite(view.px(0)));
    }
  }
  const deep = pictureOf((series) => { series.planned_m[2].fill(-6); });
  const [, side, corner] = space.layout(deep.value, 400);
  for (const plan of [side, corner]) {
    assert.ok(plan.planned.flat().every(([, y]) => y < plan.view.frame.bottom));
  }
  const floor = Math.max(...corner.corner.edges[0].map(([, y]) => y));
  assert.ok(corner.planned.flat().every(([, y]) => y < floor), 'the floor is below what was dug');
});

test('the reader can hide a layer, and sees the sample under the cursor in every view', () => {
  const picture = drawn(pictureOf(), {hidden: ['planned-teeth', 'points']});
  for (const name of ['planned', 'point']) assert.equal(picture.ofClass(name).flat().length, 0);
  assert.equal(picture.ofClass('real').flat().length, 3);
  const seen = () => picture.ofClass('cursor').flat().map((dot) => dot.attributes.visibility);
  picture.showAt(6);
  assert.deepEqual(seen(), Array(3).fill('visible'));
  const above = space.layout(pictureOf().value, 1200)[0];
  assert.equal(Number(picture.ofClass('cursor')[0][0].attributes.cx), above.toPx([0, 5, 0])[0]);
  picture.showAt(null);
  assert.deepEqual(seen(), Array(3).fill('hidden'));
  picture.showAt(99);
  assert.deepEqual(seen(), Array(3).fill('hidden'));
});

test('names never lie on each other', () => {
  for (const width of [320, 690, 1200]) {
    for (const plan of space.layout(pictureOf().value, width)) {
      const places = [...plan.names.map(({place}) => place).filter(Boolean),
        ...plan.corner?.taken ?? []];
      const named = plan.names.filter(({place}) => place).length;
      assert.ok(named >= 3);
      places.slice(0, named).forEach((a, i) => places.forEach((b, k) => assert.ok(i === k ||
          Math.abs(a.x - b.x) >= (a.w + b.w) / 2 || Math.abs(a.y - b.y) >= (a.h + b.h) / 2)));
    }
  }
});
