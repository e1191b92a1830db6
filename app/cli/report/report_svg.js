'use strict';
// What every picture drawn to scale has: metres to pixels, round ticks, places for labels, and the
// SVG elements. All but the last are pure.
const reportSvg = (() => {
  const LABEL = {width: 40, height: 18, distance: 20};

  /// Metres to pixels with one scale for both directions, inside `margin`; the shorter direction
  /// gets room on both sides.
  function fit(box, width, margin, maxHeight) {
    const innerWidth = Math.max(width - margin.left - margin.right, 50);
    const spanX = box.x1 - box.x0;
    const spanY = box.y1 - box.y0;
    const highest = maxHeight - margin.top - margin.bottom;
    const innerHeight = Math.min(innerWidth * spanY / spanX, highest);
    const scale = Math.min(innerWidth / spanX, innerHeight / spanY);
    const centre = (box.x0 + box.x1) / 2;
    const x0 = centre - innerWidth / scale / 2;
    return {
      scale, innerWidth, innerHeight,
      x0, x1: centre + innerWidth / scale / 2, y0: box.y0, y1: box.y1,
      width, height: innerHeight + margin.top + margin.bottom,
      frame: {left: margin.left, right: margin.left + innerWidth,
        top: margin.top, bottom: margin.top + innerHeight},
      px: (x) => margin.left + (x - x0) * scale,
      py: (y) => margin.top + (box.y1 - y) * scale,
    };
  }

  function ticks(from, to, about) {
    const raw = (to - from) / Math.max(about, 1);
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const list = [];
    for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i) {
      list.push({value: i * step, text: (i * step + 0).toFixed(digits).replace(/^-/, '−')});
    }
    return list;
  }

  /// Leaves out points nearer than `least` pixels to the last one kept, never the last one.
  function thin(points, least) {
    return points.filter(((kept) => (p, i) => {
      const far = !kept || Math.hypot(p[0] - kept[0], p[1] - kept[1]) >= least;
      if (far) kept = p;
      return far || i === points.length - 1;
    })(null));
  }

  const overlap = (a, b) =>
    Math.abs(a.x - b.x) < (a.w + b.w) / 2 && Math.abs(a.y - b.y) < (a.h + b.h) / 2;

  const clearOf = (box, lines) => !lines.some(([x, y]) => overlap(box, {x, y, w: 2, h: 2}));

  /// The places beside, above, below a mark and between these, outwards from the middle of the path
  /// first.
  function placesAt(mark, centre) {
    const eighth = Math.PI / 4;
    const outward = Math.round(Math.atan2(mark.y - centre.y, mark.x - centre.x) / eighth) * eighth;
    const w = mark.width ?? LABEL.width;
    return [0, 1, -1, 2, -2, 3, -3, 4].map((turn) => {
      const angle = outward + turn * eighth;
      return {x: mark.x + Math.cos(angle) * (w / 2 + 10),
        y: mark.y + Math.sin(angle) * LABEL.distance, w, h: LABEL.height};
    });
  }

  /// For each mark a place clear of the `lines` if there is one, else on them; null when every
  /// place is taken: a missing number is better than two on one spot. The first marks choose first;
  /// those with a longer text than an attitude have its `width`.
  function placeLabels(marks, centre, frame, taken, lines = []) {
    const dots = marks.map((m) => ({x: m.x, y: m.y, w: 8, h: 8}));
    const placed = [...taken];
    const inside = (box) => box.x - box.w / 2 > frame.left && box.x + box.w / 2 < frame.right &&
        box.y - box.h / 2 > frame.top && box.y + box.h / 2 < frame.bottom;
    return marks.map((mark) => {
      const free = placesAt(mark, centre).filter((box) => inside(box) &&
          ![...placed, ...dots].some((other) => overlap(box, other)));
      const box = free.find((place) => clearOf(place, lines)) ?? free[0] ?? null;
      if (box) placed.push(box);
      return box;
    });
  }

  function element(name, attributes, content) {
    const node = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (content !== undefined) node.textContent = content;
    return node;
  }

  const text = (kind, x, y, anchor, content) =>
    element('text', {class: kind, x, y, 'text-anchor': anchor}, content);

  const pair = (x, y) => `${x.toFixed(1)},${y.toFixed(1)}`;

  const polyline = (points, closed) => (points.length === 0 ? '' :
      `M${points.map((p) => pair(p[0], p[1])).join('L')}${closed ? 'Z' : ''}`);

  /// A grid with round numbers; `labels` for the axis below and the one at the left.
  function drawAxes(svg, plan, labels) {
    const {frame} = plan.view;
    for (const tick of plan.xTicks) {
      const x = plan.view.px(tick.value);
      svg.append(element('path', {class: 'grid', d: `M${x},${frame.top}V${frame.bottom}`}));
      svg.append(text('tick', x, frame.bottom + 20, 'middle', tick.text));
    }
    for (const tick of plan.yTicks) {
      const y = plan.view.py(tick.value);
      svg.append(element('path', {class: 'grid', d: `M${frame.left},${y}H${frame.right}`}));
      svg.append(text('tick', frame.left - 8, y + 4, 'end', tick.text));
    }
    svg.append(text('axis', (frame.left + frame.right) / 2, plan.view.height - 8, 'middle',
        labels[0]));
    const middle = (frame.top + frame.bottom) / 2;
    const label = text('axis', 16, middle, 'middle', labels[1]);
    label.setAttribute('transform', `rotate(-90 16 ${middle})`);
    svg.append(label);
  }

  return {fit, ticks, thin, clearOf, placeLabels, element, text, pair, polyline, drawAxes};
})();
