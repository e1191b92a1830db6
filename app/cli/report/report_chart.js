'use strict';
// What the chart library is told about a plot: lines, axes, the strip of limits, the shade behind
// the lines. Colours come from the style sheet at the moment of drawing.
const reportChart = (() => {
  const SYNC_KEY = 'run';
  const STRIP = {top: -0.08, bottom: -0.2};  // in units of lambda, below its 0
  const FONT = '13px system-ui, sans-serif';
  // Room for the axis of lambda on the right, in every chart: one instant stays in one column.
  const RIGHT_PX = 48;
  const SOFT_ZERO = {pad: 0.08, soft: 0, mode: 3};
  const RANGE = {min: SOFT_ZERO, max: SOFT_ZERO};
  const [TOP_PX, STAGE_GAP_PX] = [10, 6];
  const STAGES_PX = 24;  // room for their names above a plot
  const LOWER_SHARE = 2 / 3;  // of a plot that has lambda above its own quantity

  const colour = (name) =>
    getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

  /// What is seen of a stretch, in pixels; less than nothing where it is out of sight.
  function seen(chart, {from, until}) {
    const {left, width} = chart.bbox;
    const first = Math.max(chart.valToPos(from, 'x', true), left);
    const last = Math.min(chart.valToPos(until, 'x', true), left + width);
    return {from: first, width: last - first};
  }

  /// Lets `draw` paint inside the plotting area only, from stretch to stretch in pixels.
  function clipped(chart, draw) {
    const {ctx, bbox} = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    draw(ctx, (run) => {
      const from = chart.valToPos(run.from, 'x', true);
      const until = chart.valToPos(run.until, 'x', true);
      const seen = until >= bbox.left && from <= bbox.left + bbox.width;
      return seen ? {from, width: Math.max(until - from, 1)} : null;
    });
    ctx.restore();
  }

  /// Behind the lines: a stretch that means something in every plot.
  function drawShade(chart, runs) {
    const {bbox} = chart;
    clipped(chart, (ctx, place) => {
      for (const at of runs.map(place)) {
        if (!at) continue;
        ctx.fillStyle = colour('shade');
        ctx.fillRect(at.from, bbox.top, at.width, bbox.height);
        ctx.fillStyle = colour('shade-edge');
        for (const edge of [at.from, at.from + at.width]) {
          ctx.fillRect(edge - 0.5, bbox.top, 1, bbox.height);
        }
      }
    });
  }

  /// Behind the lines every second step of a task; above them what the steps are called, by number
  /// where the name is too long, and nothing where even that is.
  function drawStages(chart, stages) {
    drawShade(chart, stages.filter((stage, i) => i % 2 === 1));
    const {ctx, bbox} = chart;
    const ratio = globalThis.devicePixelRatio ?? 1;
    ctx.save();
    ctx.font = FONT.replace(/^\d+/, (size) => size * ratio);
    ctx.fillStyle = colour('ink');
    ctx.textAlign = 'center';
    for (const stage of stages) {
      const at = seen(chart, stage);
      const words = [`${stage.number} ${stage.name}`, String(stage.number)]
          .find((text) => ctx.measureText(text).width + STAGE_GAP_PX * ratio <= at.width);
      if (words) ctx.fillText(words, at.from + at.width / 2, bbox.top - STAGE_GAP_PX * ratio);
    }
    ctx.restore();
  }

  function drawStrip(chart, strip, limitColour) {
    if (!chart.series[2].show) return;
    const top = chart.valToPos(STRIP.top, 'y', true);
    const bottom = chart.valToPos(STRIP.bottom, 'y', true);
    clipped(chart, (ctx, place) => {
      // Free stretches first: at this scale a short limit between two of them would vanish.
      for (const free of [true, false]) {
        for (const run of strip.runs) {
          const name = strip.names[run.value];
          const at = (name === 'none') === free ? place(run) : null;
          if (!at) continue;
          ctx.fillStyle = colour(limitColour(name));
          ctx.fillRect(at.from, top, at.width, bottom - top);
        }
      }
    });
  }

  function lineSeries(line, unit) {
    return {
      label: line.label,
      scale: line.scale ?? 'y',
      stroke: () => colour(line.colour),
      width: line.wide ? 5 : 1.6,
      points: {show: false},
      value: (chart, value) => reportParts.formatLive(value, line.digits, line.unit ?? unit),
    };
  }

  function axisLook(more) {
    return {
      stroke: () => colour('ink'), font: FONT, labelFont: FONT,
      grid: {stroke: () => colour('grid'), width: 1},
      ticks: {stroke: () => colour('grid'), width: 1, size: 5},
      ...more,
    };
  }

  /// Lambda above the plot's own quantity, which keeps the lower part: two units, two bands, two
  /// axes.
  function addLambdaBand(options) {
    options.scales.y = {range: (chart, min, max) => {
      const [low, high] = min === null ? [-1, 1] : uPlot.rangeNum(min, max, RANGE);
      return [low, low + (high - low) / LOWER_SHARE];
    }};
    const lower = (chart, splits) => {
      const {min, max} = chart.scales.y;
      return splits.map((v) => (v <= min + (max - min) * LOWER_SHARE ? v : null));
    };
    const own = options.axes[1];
    Object.assign(own, {filter: lower, grid: {...own.grid, filter: lower},
      ticks: {...own.ticks, filter: lower}});
    const top = 1.1;
    const zero = LOWER_SHARE + 0.03;
    options.scales.lambda = {range: [-top * zero / (1 - zero), top]};
    // The sign is in the numbers: a label would stand in the middle, beside the other quantity.
    options.axes.push(axisLook({scale: 'lambda', side: 1, size: RIGHT_PX, splits: () => [0, 0.5, 1],
      values: (chart, splits) => splits.map((v) => `λ ${v}`)}));
    options.padding[1] = 0;
  }

  function addStrip(options, {lines, strip}, limitColour) {
    options.scales.y = {range: [STRIP.bottom - 0.03, 1.05]};
    options.scales.limit = {range: [0, 1]};
    options.axes[1].splits = () => [(STRIP.top + STRIP.bottom) / 2, 0, 0.25, 0.5, 0.75, 1];
    options.axes[1].values = (chart, splits) => splits.map((v) => (v < 0 ? 'limit' : String(v)));
    // In the legend, and for drawStrip; the library draws neither a line nor a dot for it.
    options.series.push({
      label: strip.label, scale: 'limit', paths: () => null, points: {show: false},
      value: (chart, value) => strip.names[value] ?? '–',
    });
    options.cursor.points.show = (chart, i) => (i > lines.length ? undefined :
        Object.assign(document.createElement('div'), {className: 'u-cursor-pt'}));
    options.hooks.draw = [(chart) => drawStrip(chart, strip, limitColour)];
  }

  /// `page` has what a chart shares with the others: its x axis, the shaded stretches of it, the
  /// steps of a task, the limits' colours, what to do with its legend and with the sample under the
  /// cursor.
  function options(plot, width, page) {
    const {lines, strip} = plot.body.value;
    const stages = page.stages ?? [];
    const made = {
      width,
      height: plot.height,
      padding: [stages.length > 0 ? STAGES_PX : TOP_PX, RIGHT_PX, 0, 0],
      scales: {x: {time: false}, y: {range: RANGE}},
      // The y axes are equally wide, so one instant is in one column all down the page.
      axes: [axisLook({label: page.x.label, labelSize: 19, size: 30}),
        axisLook({label: plot.axis, labelSize: 22, size: 54, space: 26})],
      series: [
        {label: page.x.name,
          value: (chart, value) => reportParts.formatLive(value, page.x.digits, page.x.unit)},
        ...lines.map((line) => lineSeries(line, plot.unit)),
      ],
      cursor: {
        y: false,
        drag: {x: true, y: false, setScale: true, dist: 4},
        sync: {key: SYNC_KEY, setSeries: false},
        points: {size: 7},
      },
      legend: {
        mount: (chart, table) => page.mountLegend(table),
        // The x value and the strip have no line, so no marker either.
        markers: {width: 0, fill: (chart, i) => (lines[i - 1] ? colour(lines[i - 1].colour) : '')},
      },
      hooks: {
        drawAxes: [(chart) => drawShade(chart, page.shade),
          (chart) => drawStages(chart, stages)],
        setCursor: [(chart) => page.showAt(chart.cursor.idx ?? null)],
      },
    };
    if (lines.some((line) => line.scale === 'lambda')) addLambdaBand(made);
    if (strip) addStrip(made, plot.body.value, page.limitColour);
    return made;
  }

  return {options, drawShade, drawStages};
})();
