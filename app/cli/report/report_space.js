'use strict';
// The path of the bucket teeth in space, from the run's JSON object: from above, from the side and
// in axonometry. Frame: from the swing axis on the ground, x forward, y left, z up. `picture` and
// `layout` are pure; `draw` turns a layout into SVGs.
const reportSpace = (() => {
  const {Problem, part, time, seriesGroup} = reportChecks;
  const {fit, ticks, thin, placeLabels, element, text, polyline, drawAxes} = reportSvg;
  const INTERVALS_S = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60];
  const POINTS_MOST = 60;
  const APART_M = 0.003;
  const MARGIN = {left: 58, right: 28, top: 12, bottom: 50};
  const AXONOMETRIC_MARGIN = {left: 44, right: 34, top: 24, bottom: 34};
  const MAX_HEIGHT = 430;
  const VIEW_GAP_PX = 18;
  const VIEW_LEAST_PX = 300;
  const BESIDE_SHARE = 0.09;  // of a flat view, free on each side: room for a name
  const DUG_M = 0.05;
  const LEAST_RISE = 0.25;  // of the z axis, to the ground's extent: room for its name
  const FLATTEST = 0.35;  // height to width of a view: a level line still has room for its labels
  const TICK_BESIDE = {x: [-5, 15, 'end'], y: [5, 15, 'start'], z: [-7, 4, 'end']};
  const AXIS = {right: [Math.cos(0.61), Math.sin(0.61)], up: Math.sin(0.49), rise: Math.cos(0.49)};

  /// A point for each sample, null where one of its numbers is not known.
  function pointList(data, name) {
    const [x, y, z] = seriesGroup(data, name, [3, 3]);
    const list = x.map((value, i) => [value, y[i], z[i]])
        .map((point) => (point.includes(null) ? null : point));
    if (!list.some(Boolean)) throw new Problem(`“series.${name}” has no point that is known.`);
    return list;
  }

  /// Without the points that no picture can show apart; gaps, and what is beside them, stay. A run
  /// has up to 30 000 samples and three views, drawn again at each new width.
  function thinned(list) {
    let kept = null;
    return list.filter((point, i) => {
      const stays = !point || !kept || !list[i + 1] ||
          Math.hypot(...point.map((value, k) => value - kept[k])) >= APART_M;
      if (stays) kept = point;
      return stays;
    });
  }

  /// Straight between samples; null beside a gap.
  function placeAt(times, list, at_s) {
    const next = times.findIndex((t) => t >= at_s);
    if (next < 0) return null;
    if (times[next] === at_s || next === 0) return list[next];
    const [a, b] = [list[next - 1], list[next]];
    if (!a || !b) return null;
    const share = (at_s - times[next - 1]) / (times[next] - times[next - 1]);
    return a.map((value, k) => value + (b[k] - value) * share);
  }

  /// As the paper's control points: near to each other where the teeth are slow.
  function atEqualTimes(times, list) {
    const duration = times[times.length - 1] - times[0];
    const interval = INTERVALS_S.find((s) => duration / s <= POINTS_MOST) ?? duration / POINTS_MOST;
    const count = Math.floor(duration / interval + 1e-9) + 1;
    const points = Array.from({length: count}, (_, n) => placeAt(times, list,
        Math.min(times[0] + n * interval, times[times.length - 1])));
    return {interval_s: interval, points: points.filter(Boolean)};
  }

  /// `names` has the series of the planned teeth and, of a run, of the real ones; `stretches` of
  /// time have their number along the path. What of the two is missing costs only itself.
  function picture(data, names, stretches = []) {
    const [planned, real] = ['planned', 'real'].map((key) => (
      names[key] ? part(() => pointList(data, names[key])) : null));
    const faults = [real, planned].filter((one) => one && !one.ok).map((one) => one.problem);
    const problems = [...new Set(faults)];
    const main = real?.ok ? real.value : planned?.ok ? planned.value : null;
    if (!main) return {ok: false, problem: problems[0], problems: problems.slice(1)};
    const times = time(data);
    const known = main.filter(Boolean);
    return {ok: true, problems, value: {
      main,
      planned: planned.ok ? thinned(planned.value) : null,
      real: real?.ok ? thinned(real.value) : null,
      ...atEqualTimes(times, main), start: known[0], end: known[known.length - 1],
      numbers: stretches.map(({from, until, number}) => (
        {text: String(number), at: placeAt(times, main, (from + until) / 2)}))
          .filter((number) => number.at),
    }};
  }

  const axonometric = ([x, y, z]) => {
    const [c, s] = AXIS.right;
    return [x * c + y * s, z * AXIS.rise + (y * c - x * s) * AXIS.up];
  };

  const VIEWS = [
    {id: 'above', title: 'From above', project: ([x, y]) => [x, y],
      labels: ['x, forward (m)', 'y, left (m)'], margin: MARGIN},
    {id: 'side', title: 'From the side, all turned into one plane',
      project: ([x, y, z]) => [Math.hypot(x, y), z],
      labels: ['radius from the swing axis (m)', 'z, up (m)'], margin: MARGIN},
    {id: 'corner', title: 'Axonometry, from the right and above', project: axonometric,
      margin: AXONOMETRIC_MARGIN},
  ];

  /// Of all that is drawn, in space, with the swing axis on the ground.
  function extent(geometry) {
    const all = [[0, 0, 0], ...geometry.planned ?? [], ...geometry.real ?? []].filter(Boolean);
    const [low, high] = [all[0].slice(), all[0].slice()];
    for (const point of all) {
      point.forEach((value, k) => {
        low[k] = Math.min(low[k], value);
        high[k] = Math.max(high[k], value);
      });
    }
    const span = Math.max(high[0] - low[0], high[1] - low[1]);
    const pad = Math.max(0.05 * span, 0.1);
    high[2] = Math.max(high[2], LEAST_RISE * span);
    // The floor is the ground, or what lies below all that was dug.
    const floor = low[2] < -DUG_M ? low[2] - pad : 0;
    return {low: [low[0] - pad, low[1] - pad, floor], high: high.map((v) => v + pad)};
  }

  /// The eight corners of what is drawn, from `low` to `high`.
  const corners = ({low, high}) => [0, 1, 2, 3, 4, 5, 6, 7].map((n) =>
    [0, 1, 2].map((k) => ((n >> k) & 1 ? high[k] : low[k])));

  function bounds(points) {
    let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const [x, y] of points) {
      [x0, x1] = [Math.min(x0, x), Math.max(x1, x)];
      [y0, y1] = [Math.min(y0, y), Math.max(y1, y)];
    }
    return {x0, x1, y0, y1};
  }

  function box(geometry, view) {
    if (view.id === 'corner') return bounds(corners(extent(geometry)).map(view.project));
    const all = [[0, 0, 0], ...geometry.planned ?? [], ...geometry.real ?? []].filter(Boolean);
    const {x0, x1, y0, y1} = bounds(all.map(view.project));
    const pad = Math.max(BESIDE_SHARE * Math.max(x1 - x0, y1 - y0), 0.1);
    const more = Math.max(pad, (FLATTEST * (x1 - x0) - (y1 - y0)) / 2);
    return {x0: x0 - pad, x1: x1 + pad, y0: y0 - more, y1: y1 + more};
  }

  /// Pieces of a line between its gaps, in pixels.
  function pieces(list, toPx) {
    const found = [[]];
    for (const point of list ?? []) {
      if (point) found[found.length - 1].push(toPx(point));
      else if (found[found.length - 1].length > 0) found.push([]);
    }
    return found.map((piece) => thin(piece, 0.5)).filter((piece) => piece.length > 0);
  }

  const name = (at, dx, dy, anchor, words, kind = 'axis') =>
    ({kind, x: at[0] + dx, y: at[1] + dy, anchor, text: words});

  const beside = (axis, {at, text: words}) => name(at, ...TICK_BESIDE[axis], words, 'tick');

  /// Some 8 px a letter.
  function boxOf({x, y, anchor, text: words}) {
    const w = 8 * words.length;
    return {x: x + {start: w / 2, middle: 0, end: -w / 2}[anchor], y: y - 5, w, h: 18};
  }

  /// The floor, and the axes at its edges, with their ticks. The z axis stands at the left corner.
  function cornerAxes(geometry, toPx) {
    const {low, high} = extent(geometry);
    const [x0, y0, z0] = low;
    const [x1, y1, z1] = high;
    const marks = (from, to, place) => {
      const [a, b] = [toPx(place(from)), toPx(place(to))];
      const about = Math.hypot(b[0] - a[0], b[1] - a[1]) / 42;
      return ticks(from, to, about).map((tick) => ({...tick, at: toPx(place(tick.value))}));
    };
    const along = {
      x: marks(x0, x1, (x) => [x, y0, z0]), y: marks(y0, y1, (y) => [x1, y, z0]),
      z: marks(z0, z1, (z) => [x0, y0, z]),
    };
    const line = (a, b) => [toPx(a), toPx(b)];
    const words = [
      ...Object.entries(along).flatMap(([axis, list]) => list.map((tick) => beside(axis, tick))),
      name(toPx([(x0 + x1) / 2, y0, z0]), -16, 34, 'end', 'x (m)'),
      name(toPx([x1, (y0 + y1) / 2, z0]), 18, 34, 'start', 'y (m)'),
      name(toPx([x0, y0, z1]), 0, -10, 'middle', 'z (m)'),
    ];
    return {
      words, taken: words.map(boxOf),
      grid: [...along.x.map((tick) => line([tick.value, y0, z0], [tick.value, y1, z0])),
        ...along.y.map((tick) => line([x0, tick.value, z0], [x1, tick.value, z0]))],
      edges: [[[x0, y0, z1], [x0, y0, z0], [x1, y0, z0], [x1, y1, z0]].map(toPx)],
      swing: line([0, 0, z0], [0, 0, z1]),
      shadow: pieces((geometry.real ?? geometry.planned).map((point) => (
        point && [point[0], point[1], z0])), toPx),
      drops: [geometry.start, geometry.end].map((point) => line(point, [point[0], point[1], z0])),
    };
  }

  /// From above a point, from the side as high as the picture, but for its name's half height.
  function swingAxis(view, frame, [x, y]) {
    return view.id === 'above' ? [[x, y], [x, y]] : [[x, frame.bottom], [x, frame.top + 12]];
  }

  /// Start, end, the steps' numbers and the swing axis, each where there is room for it.
  function namesOf(geometry, {toPx, way, swing, frame, taken}) {
    const mark = ([x, y], words, width, kind = 'halo') => ({x, y, text: words, width, kind});
    const marks = [mark(toPx(geometry.start), 'start', 46), mark(toPx(geometry.end), 'end', 38),
      ...geometry.numbers.map((number) => mark(toPx(number.at), number.text, 18)),
      mark(swing[1], 'swing axis', 68, 'name')];
    const middle = (k) => way.reduce((sum, point) => sum + point[k], 0) / way.length;
    const [low, high] = swing;
    const room = {...frame, right: frame.right + MARGIN.right};
    const upright = {x: low[0], y: (low[1] + high[1]) / 2, w: 4, h: low[1] - high[1]};
    return placeLabels(marks, {x: middle(0), y: middle(1)}, room, [...taken, upright], way)
        .map((place, i) => ({text: marks[i].text, kind: marks[i].kind, place}));
  }

  function layoutView(geometry, view, width) {
    const scaled = fit(box(geometry, view), width, view.margin, MAX_HEIGHT);
    const toPx = (point) => {
      const [x, y] = view.project(point);
      return [scaled.px(x), scaled.py(y)];
    };
    const lines = {planned: pieces(geometry.planned, toPx), real: pieces(geometry.real, toPx)};
    const way = [...lines.planned.flat(), ...lines.real.flat()];
    const corner = view.id === 'corner' ? cornerAxes(geometry, toPx) : null;
    const swing = corner?.swing ?? swingAxis(view, scaled.frame, toPx([0, 0, 0]));
    return {
      view: scaled, id: view.id, title: view.title, labels: view.labels, toPx, ...lines,
      points: geometry.points.map(toPx), start: toPx(geometry.start), end: toPx(geometry.end),
      names: namesOf(geometry, {toPx, way, swing, frame: scaled.frame, taken: corner?.taken ?? []}),
      ...(corner ? {corner} : {
        xTicks: ticks(scaled.x0, scaled.x1, scaled.innerWidth / 52),
        yTicks: ticks(scaled.y0, scaled.y1, scaled.innerHeight / 44)}),
    };
  }

  /// As many views beside each other as there is room for.
  function layout(geometry, width) {
    const columns = Math.min(VIEWS.length,
        Math.max(1, Math.floor((width + VIEW_GAP_PX) / (VIEW_LEAST_PX + VIEW_GAP_PX))));
    const each = Math.floor((width - (columns - 1) * VIEW_GAP_PX) / columns);
    return VIEWS.map((view) => layoutView(geometry, view, each));
  }

  const path = (kind, list) => element('path', {class: kind,
    d: list.map((points) => polyline(points)).join('')});

  function drawFlat(svg, plan) {
    drawAxes(svg, plan, plan.labels);
    const {frame} = plan.view;
    const [x, y] = plan.toPx([0, 0, 0]);
    if (plan.id === 'above') {
      svg.append(path('centre', [[[x - 9, y], [x + 9, y]], [[x, y - 9], [x, y + 9]]]),
          element('circle', {class: 'centre', cx: x, cy: y, r: 5}));
    } else {
      svg.append(path('ground', [[[frame.left, y], [frame.right, y]]]),
          path('swing', [[[x, frame.top], [x, frame.bottom]]]));
    }
  }

  function drawCorner(svg, {corner}) {
    svg.append(path('grid', corner.grid), path('edge', corner.edges), path('swing', [corner.swing]),
        path('shadow', corner.shadow), path('drop', corner.drops));
    svg.append(...corner.words.map(({kind, x, y, anchor, text: words}) =>
      text(kind, x, y, anchor, words)));
  }

  function drawView(plan, hidden) {
    const {width, height} = plan.view;
    const svg = element('svg', {width, height, role: 'img', viewBox: `0 0 ${width} ${height}`,
      'aria-label': `Path of the bucket teeth: ${plan.title}`});
    plan.corner ? drawCorner(svg, plan) : drawFlat(svg, plan);
    const layer = (name, ...nodes) => {
      if (!hidden.has(name)) svg.append(...nodes);
    };
    layer('planned-teeth', path('planned', plan.planned));
    layer('real-teeth', path('real', plan.real));
    layer('points', ...plan.points.map(([x, y]) =>
      element('circle', {class: 'point', cx: x.toFixed(1), cy: y.toFixed(1), r: 1.8})));
    const [end, start] = [plan.end, plan.start];
    svg.append(element('circle', {class: 'start', cx: start[0], cy: start[1], r: 6}),
        element('rect', {class: 'end', x: end[0] - 5, y: end[1] - 5, width: 10, height: 10}),
        ...plan.names.filter(({place}) => place).map(({text: words, kind, place}) =>
          text(kind, place.x, place.y + 5, 'middle', words)));
    const cursor = element('circle', {class: 'cursor', r: 6, visibility: 'hidden'});
    svg.append(cursor);
    return {svg, cursor};
  }

  /// The views, {title, svg}, and a function that shows the teeth in all of them at a sample, or
  /// nothing for null. `hidden` holds the layers that the reader has switched off.
  function draw(geometry, width, hidden) {
    const views = layout(geometry, width).map((plan) => ({plan, ...drawView(plan, hidden)}));
    const showAt = (index) => {
      const point = index === null ? null : geometry.main[index];
      for (const {plan, cursor} of views) {
        cursor.setAttribute('visibility', point ? 'visible' : 'hidden');
        if (!point) continue;
        const [x, y] = plan.toPx(point);
        cursor.setAttribute('cx', x);
        cursor.setAttribute('cy', y);
      }
    };
    return {views: views.map(({plan, svg}) => ({title: plan.title, svg})), showAt};
  }

  return {picture, atEqualTimes, layout, draw};
})();
