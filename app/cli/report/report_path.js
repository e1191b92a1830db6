'use strict';
// The path seen from the side, with equal scales in x and y. `layout` is pure (metres to pixels,
// ticks, arrows, places of the labels); `draw` turns its result into an SVG.
const reportPath = (() => {
  const MARGIN = {left: 66, right: 14, top: 12, bottom: 54};
  const MAX_HEIGHT = 600;
  const {fit, ticks, thin, clearOf, placeLabels, element, text, pair, polyline, drawAxes} =
    reportSvg;

  function bounds(geometry) {
    let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const points of [geometry.path, geometry.tipTrue, geometry.tipMeasured, geometry.field,
      [geometry.start], geometry.obstacle?.outline ?? []]) {
      for (const [x, y] of points) {
        x0 = Math.min(x0, x);
        x1 = Math.max(x1, x);
        y0 = Math.min(y0, y);
        y1 = Math.max(y1, y);
      }
    }
    if (geometry.groundY !== null) {
      y0 = Math.min(y0, geometry.groundY);
      y1 = Math.max(y1, geometry.groundY);
    }
    // A point has no extent; a metre about it can still be drawn.
    const pad = Math.max(0.04 * Math.max(x1 - x0, y1 - y0), 0.05);
    return {x0: x0 - pad, x1: x1 + pad, y0: y0 - pad, y1: y1 + pad};
  }

  /// The longest arrow is as long as the grid's spacing allows, so that arrows never touch.
  function arrows(field, scale) {
    const fastest = field.reduce((top, [, , vx, vy]) => Math.max(top, Math.hypot(vx, vy)), 0);
    if (fastest === 0) return [];
    const xs = [...new Set(field.map((f) => f[0]))].sort((a, b) => a - b);
    let spacing = Infinity;
    for (let i = 1; i < xs.length; ++i) {
      if (xs[i] - xs[i - 1] > 1e-6) spacing = Math.min(spacing, xs[i] - xs[i - 1]);
    }
    const longest = Math.min(Math.max(spacing * scale * 0.8, 6), 30);
    return field.map(([x, y, vx, vy]) => {
      const speed = Math.hypot(vx, vy);
      return {x, y, dx: vx / fastest * longest, dy: -vy / fastest * longest, speed};
    }).filter((a) => Math.hypot(a.dx, a.dy) > 1);
  }

  /// On the ground line, where neither the path nor the tip runs through the word.
  function placeOnGround(y, frame, lines) {
    const places = [frame.right - 32, frame.left + 32, (frame.left + frame.right) / 2]
        .map((x) => ({x, y: y - 11, w: 60, h: 20}));
    return places.find((box) => clearOf(box, lines)) ?? places[0];
  }

  function layout(geometry, width) {
    const view = fit(bounds(geometry), width, MARGIN, MAX_HEIGHT);
    const toPx = ([x, y]) => [view.px(x), view.py(y)];
    const {frame} = view;
    const path = thin(geometry.path.map(toPx), 0.5);
    const centre = {
      x: path.reduce((sum, p) => sum + p[0], 0) / path.length,
      y: path.reduce((sum, p) => sum + p[1], 0) / path.length,
    };
    const marks = geometry.marks.map((m) => (
      {x: view.px(m.x), y: view.py(m.y), text: `${Math.round(m.attitude_deg)}°`, time: m.time_s}));
    const start = toPx(geometry.start);
    const changes = (geometry.changes ?? []).map((change) => ({
      x: view.px(change.x), y: view.py(change.y), width: 96, holds: change.holds,
      text: `${change.holds ? 'held' : 'let go'} ${change.time_s.toFixed(1)} s`}));
    const tipTrue = thin(geometry.tipTrue.map(toPx), 0.5);
    const lines = [...path, ...tipTrue];
    const groundY = geometry.groundY === null ? null : view.py(geometry.groundY);
    const groundLabel = placeOnGround(groundY ?? -99, frame, lines);
    const [startLabel, ...places] = placeLabels(
        [{x: start[0], y: start[1], width: 44}, ...changes, ...marks], centre, frame,
        [groundLabel], lines);
    return {
      view, frame, path, tipTrue, start, startLabel, groundY, groundLabel,
      tipMeasured: thin(geometry.tipMeasured.map(toPx), 0.5),
      arrows: arrows(geometry.field, view.scale)
          .map((arrow) => ({...arrow, x: view.px(arrow.x), y: view.py(arrow.y)})),
      obstacle: geometry.obstacle ? geometry.obstacle.outline.map(toPx) : null,
      changes: changes.map((change, i) => ({...change, label: places[i]})),
      marks: marks.map((m, i) => ({...m, label: places[changes.length + i]})),
      xTicks: ticks(view.x0, view.x1, view.innerWidth / 90),
      yTicks: ticks(view.y0, view.y1, view.innerHeight / 60),
    };
  }

  /// A shaft with a head of two short strokes, all arrows in one path element.
  function arrowPath(list) {
    return list.map(({x, y, dx, dy}) => {
      const [endX, endY] = [x + dx, y + dy];
      const size = Math.min(5, Math.hypot(dx, dy) * 0.4);
      const head = (turn) => {
        const angle = Math.atan2(dy, dx) + Math.PI + turn;
        return pair(endX + size * Math.cos(angle), endY + size * Math.sin(angle));
      };
      const tip = pair(endX, endY);
      return `M${pair(x, y)}L${tip}M${head(0.5)}L${tip}L${head(-0.5)}`;
    }).join('');
  }

  /// The face that the bucket meets is the outline's first side.
  function rock(outline) {
    return [element('path', {class: 'obstacle', d: polyline(outline, true)}),
      element('path', {class: 'face', d: polyline(outline.slice(0, 2))})];
  }

  /// A full square where the obstacle began to hold, a larger open one where it let go: the two are
  /// often nearly on one spot. Labels last.
  function changeMarks(changes) {
    const squares = changes.map(({x, y, holds}) => {
      const half = holds ? 4 : 7;
      return element('rect', {class: holds ? 'held' : 'let-go', x: x - half, y: y - half,
        width: 2 * half, height: 2 * half});
    });
    const labels = changes.filter((change) => change.label).map((change) =>
      text('halo', change.label.x, change.label.y + 5, 'middle', change.text));
    return [...squares, ...labels];
  }

  /// `hidden` holds the layers that the reader has switched off. Returns the SVG and a function
  /// that shows the tip at a sample, or nothing for null.
  function draw(geometry, width, hidden) {
    const plan = layout(geometry, width);
    const {frame} = plan;
    const svg = element('svg', {width, height: plan.view.height, role: 'img',
      viewBox: `0 0 ${width} ${plan.view.height}`,
      'aria-label': 'Path of the bucket tip seen from the side, with the attitude in degrees'});
    drawAxes(svg, plan, ['x, forward from the boom foot (m)', 'y, up (m)']);
    const layer = (name, ...nodes) => {
      if (!hidden.has(name)) svg.append(...nodes);
    };
    layer('field', element('path', {class: 'field', d: arrowPath(plan.arrows)}));
    if (plan.obstacle) layer('obstacle', ...rock(plan.obstacle));
    if (plan.groundY !== null) {
      const line = `M${frame.left},${plan.groundY}H${frame.right}`;
      svg.append(element('path', {class: 'ground', d: line}),
          text('halo', plan.groundLabel.x, plan.groundLabel.y + 5, 'middle', 'ground'));
    }
    layer('true', element('path', {class: 'tip-true', d: polyline(plan.tipTrue)}));
    layer('measured', element('path', {class: 'tip-measured', d: polyline(plan.tipMeasured)}));
    layer('path', element('path', {class: 'path', d: polyline(plan.path, true)}));
    layer('attitude', ...plan.marks.map((mark) => {
      const group = element('g', {});
      group.append(element('title', {}, `${mark.text} at ${mark.time.toFixed(1)} s`),
          element('circle', {class: 'mark', cx: mark.x, cy: mark.y, r: 4}));
      if (mark.label) {
        group.append(text('halo', mark.label.x, mark.label.y + 5, 'middle', mark.text));
      }
      return group;
    }));
    layer('obstacle', ...changeMarks(plan.changes));
    svg.append(element('circle', {class: 'start', cx: plan.start[0], cy: plan.start[1], r: 7}));
    if (plan.startLabel) {
      svg.append(text('halo', plan.startLabel.x, plan.startLabel.y + 5, 'middle', 'start'));
    }
    const cursor = element('circle', {class: 'cursor', r: 6, visibility: 'hidden'});
    svg.append(cursor);
    const showAt = (index) => {
      const point = index === null ? undefined : geometry.tipTrue[index];
      cursor.setAttribute('visibility', point ? 'visible' : 'hidden');
      if (!point) return;
      cursor.setAttribute('cx', plan.view.px(point[0]));
      cursor.setAttribute('cy', plan.view.py(point[1]));
    };
    return {svg, showAt};
  }

  return {layout, draw};
})();
