'use strict';
// What the page shows, computed from the run's JSON object. Pure: no document, no drawing, so that
// it runs outside a browser too. A part that is missing or malformed becomes a sentence that
// the page prints in that part's place; the other parts stay.
const reportData = (() => {
  const AXES = ['boom', 'arm', 'bucket'];
  const {Problem, part, isObject, need, needList, checkTuples, time, runs, seriesList,
    seriesGroup} = reportChecks;
  const PA_PER_MPA = 1e6;
  const N_PER_KN = 1e3;
  const MM_PER_M = 1e3;

  /// Each limit's number in the palette, the same in the table, the strip and its key. 'none' has
  /// its own neutral tone (0); the others follow in the order of the table, then of the series.
  function limitColours(data) {
    const names = [];
    const add = (name) => {
      if (typeof name === 'string' && name !== 'none' && !names.includes(name)) names.push(name);
    };
    if (isObject(data) && Array.isArray(data.limits_share)) {
      [...data.limits_share].filter(isObject).sort((a, b) => b.share - a.share)
          .forEach((row) => add(row.name));
    }
    if (isObject(data) && isObject(data.series) && Array.isArray(data.series.limit_names)) {
      data.series.limit_names.forEach(add);
    }
    return new Map([['none', 0], ...names.map((name, i) => [name, i + 1])]);
  }

  function lambdaPlot(data) {
    const times = time(data);
    const limits = seriesList(data, 'limit');
    const names = needList(data, 'series.limit_names');
    const bad = limits.findIndex((i) => i !== null && typeof names[i] !== 'string');
    if (bad >= 0) {
      throw new Problem(
          `“series.limit”, value ${bad + 1}: ${limits[bad]} has no name in “limit_names”.`);
    }
    return {
      lines: [{label: 'λ', colour: 'ink', values: seriesList(data, 'lambda'), digits: 3}],
      strip: {label: 'held by', values: limits, names, runs: runs(times, limits)},
    };
  }

  function axisPair(wide, narrow, i, words, digits) {
    return [
      {label: words[0], colour: `${AXES[i]}-soft`, wide: true, values: wide[i], digits},
      {label: words[1], colour: AXES[i], values: narrow[i], digits},
    ];
  }

  function spoolPlot(data) {
    const command = seriesGroup(data, 'spool_command', [3, 3], 100);
    const real = seriesGroup(data, 'spool_real', [3, 3], 100);
    const lines = AXES.map((axis, i) => axisPair(
        command, real, i, [`${axis} command`, `${axis} real`], 1));
    // All commands first: the pale lines must not cover another axis' real line.
    return {lines: [...lines.map((pair) => pair[0]), ...lines.map((pair) => pair[1])]};
  }

  function velocityPlot(data, i) {
    const wanted = seriesGroup(data, 'velocity_wanted', [3, 3]);
    const real = seriesGroup(data, 'velocity_real', [3, 3]);
    return {lines: axisPair(wanted, real, i, ['wanted', 'real'], 3)};
  }

  function pressurePlot(data) {
    const expected = seriesGroup(data, 'pump_pressure_expected', [1, 3], 1 / PA_PER_MPA);
    const real = seriesGroup(data, 'pump_pressure_real', [1, 3], 1 / PA_PER_MPA);
    if (expected.length !== real.length) {
      throw new Problem(
          '“series.pump_pressure_expected” and “_real” differ in the number of pumps.');
    }
    return {
      lines: [
        ...expected.map((values, i) => ({
          label: `Pump ${i + 1} expected`, colour: `pump${i + 1}-soft`, wide: true,
          values, digits: 2,
        })),
        ...real.map((values, i) => (
          {label: `Pump ${i + 1} real`, colour: `pump${i + 1}`, values, digits: 2})),
      ],
    };
  }

  function errorPlot(data) {
    const measured = seriesList(data, 'error_measured_m', MM_PER_M);
    const real = seriesList(data, 'error_true_m', MM_PER_M);
    return {
      lines: [
        {label: 'measured', colour: 'measured', values: measured, digits: 1},
        {label: 'true', colour: 'true', values: real, digits: 1},
      ],
    };
  }

  /// x and y of a vector over time.
  function xyLines(data, name, digits, factor = 1) {
    const [x, y] = seriesGroup(data, name, [2, 2], factor);
    return [{label: 'x, forward', colour: 'vector-x', values: x, digits},
      {label: 'y, up', colour: 'vector-y', values: y, digits}];
  }

  const forcePlot = (data) => ({lines: xyLines(data, 'tip_force_n', 1, 1 / N_PER_KN)});

  /// Lambda with it, on an axis of its own. A fault in lambda is told in lambda's own plot, and the
  /// velocity stays.
  function tipVelocityPlot(data) {
    const lambda = part(() => seriesList(data, 'lambda'));
    const lines = xyLines(data, 'tip_velocity_mps', 3);
    if (lambda.ok) {
      lines.push({label: 'λ', colour: 'ink', scale: 'lambda', unit: '', values: lambda.value,
        digits: 3});
    }
    return {lines};
  }

  function cyclePlot(data) {
    const values = seriesList(data, 'cycle_time_us');
    return {lines: [{label: 'cycle', colour: 'ink', values, digits: 1}]};
  }

  /// Only where there is something to see: no force, no plot.
  function forcePlots(data) {
    const body = part(() => forcePlot(data));
    if (body.ok && !body.value.lines.some((line) => line.values.some(Boolean))) return [];
    return [{id: 'force', title: 'Force on the bucket tip', source: 'Kim, Fig. 10',
      axis: 'force (kN)', unit: 'kN', height: 230, body}];
  }

  function velocityPlots(data) {
    return AXES.map((axis, i) => ({
      id: `velocity-${axis}`, title: `${axis[0].toUpperCase()}${axis.slice(1)} cylinder velocity`,
      source: 'Kim, Fig. 13', axis: `${axis} (m/s)`, unit: 'm/s', height: 200,
      body: part(() => velocityPlot(data, i))}));
  }

  /// In the order of the paper's figures, `source` naming them; then what the paper does not show.
  function plots(data) {
    const recorded = reportScene.isRecorded(data);
    return [
      ...(recorded ? forcePlots(data) : []),
      {id: 'lambda', title: 'Speed factor λ and what holds it', source: 'Kim, Fig. 11',
        axis: 'λ (1)', unit: '', height: 240, body: part(() => lambdaPlot(data))},
      {id: 'spool', title: 'Spools, commanded and real', source: 'Kim, Fig. 12',
        axis: 'spool (% of travel)', unit: '%', height: 270, body: part(() => spoolPlot(data))},
      ...velocityPlots(data),
      ...(recorded ? [{id: 'tip-velocity', title: 'Velocity of the bucket tip, and λ',
        source: 'Kim, Fig. 15', axis: 'velocity (m/s)', unit: 'm/s', height: 320,
        body: part(() => tipVelocityPlot(data))}] : []),
      {id: 'pressure', title: 'Pump pressures, expected and real', axis: 'pressure (MPa)',
        unit: 'MPa', height: 240, body: part(() => pressurePlot(data))},
      {id: 'error', title: 'Path error of the bucket tip', axis: 'path error (mm)', unit: 'mm',
        height: 230, body: part(() => errorPlot(data))},
      // Optional: without it there is nothing to miss.
      ...(isObject(data) && isObject(data.series) && data.series.cycle_time_us ?
        [{id: 'cycle', title: 'Computing time of a control cycle', axis: 'cycle (µs)', unit: 'µs',
          height: 190, body: part(() => cyclePlot(data))}] : []),
    ];
  }

  /// A sensor may fail during a run: its point is then null, or has null in it.
  const known = (point) => point !== null && !(Array.isArray(point) && point.includes(null));

  function geometry(data) {
    const points = (name, least, gaps = false) => {
      const whole = needList(data, `geometry.${name}`);
      const list = checkTuples(gaps ? whole.filter(known) : whole, `geometry.${name}`, 2);
      if (list.length < least) {
        throw new Problem(`“geometry.${name}” has fewer than ${least} points.`);
      }
      return list;
    };
    const marks = needList(data, 'geometry.marks');
    const bad = marks.findIndex((mark) => !isObject(mark) ||
        ['x', 'y', 'attitude_deg', 'time_s'].some((key) => typeof mark[key] !== 'number'));
    if (bad >= 0) throw new Problem(`“geometry.marks”, entry ${bad + 1}, lacks a number.`);
    const start = need(data, 'geometry.start');
    checkTuples([start], 'geometry.start', 2);
    return {
      path: points('path', 3),
      tipTrue: points('tip_true', 1),
      tipMeasured: points('tip_measured', 0, true),
      field: checkTuples(needList(data, 'geometry.field'), 'geometry.field', 4),
      marks,
      start,
    };
  }

  function summary(data) {
    return needList(data, 'summary').map((row, i) => {
      if (!isObject(row) || typeof row.label !== 'string' || row.value === undefined) {
        throw new Problem(`“summary”, entry ${i + 1}, lacks a label or a value.`);
      }
      return {
        label: row.label,
        value: typeof row.value === 'number' ? formatKey(row.value) : String(row.value ?? '–'),
        unit: row.unit ?? '',
        note: row.note ?? '',
      };
    });
  }

  function limitsShare(data) {
    const rows = needList(data, 'limits_share').map((row, i) => {
      if (!isObject(row) || typeof row.name !== 'string' ||
          !(row.share >= 0 && row.share <= 1 + 1e-9)) {
        throw new Problem(`“limits_share”, entry ${i + 1}, is no name with a share of 0 to 1.`);
      }
      return {name: row.name, share: row.share};
    });
    if (rows.length === 0) throw new Problem('“limits_share” is empty.');
    return rows.sort((a, b) => b.share - a.share);
  }

  /// Four significant digits at least, no exponent: a key figure is read, not computed with.
  function formatKey(value) {
    if (!Number.isFinite(value)) return '–';
    return String(Math.abs(value) >= 1000 ? Math.round(value) : Number(value.toPrecision(4)));
  }

  function formatLive(value, digits, unit) {
    if (typeof value !== 'number') return '–';
    // U+2212 is as wide as a plus, so the legend does not jump with the sign.
    const number = value.toFixed(digits).replace('-', '−');
    return unit ? `${number} ${unit}` : number;
  }

  function formatShare(share) {
    return share > 0 && share < 0.001 ? '< 0.1 %' : `${(share * 100).toFixed(1)} %`;
  }

  /// What the bucket met is part of the picture of the path, but a fault there must not cost the
  /// path: the picture then lacks it, and the sentence stands below.
  function pathPicture(data) {
    const base = part(() => geometry(data));
    const met = {
      groundY: part(() => reportScene.groundY(data)),
      obstacle: part(() => reportScene.obstacle(data)),
      changes: part(() => reportScene.changes(data)),
    };
    const value = (one, otherwise) => (one.ok ? one.value : otherwise);
    if (base.ok) {
      Object.assign(base.value, {groundY: value(met.groundY, null),
        obstacle: value(met.obstacle, null), changes: value(met.changes, [])});
    }
    const problems = Object.values(met).filter((one) => !one.ok).map((one) => one.problem)
        .filter((problem) => problem !== base.problem);
    const hit = value(met.obstacle, null) !== null || value(met.changes, []).length > 0;
    return {base, problems: [...new Set(problems)],
      source: hit ? 'Kim, Fig. 14' : 'Kim, Fig. 9'};
  }

  function prepare(data) {
    const text = (key, otherwise) =>
      (isObject(data) && typeof data[key] === 'string' ? data[key] : otherwise);
    const picture = pathPicture(data);
    const report = {
      title: text('title', 'Simulated run'),
      subtitle: text('subtitle', ''),
      summary: part(() => summary(data)),
      limitsShare: part(() => limitsShare(data)),
      limitColours: limitColours(data),
      geometry: picture.base,
      geometryProblems: picture.problems,
      geometrySource: picture.source,
      time: part(() => time(data)),
      holds: part(() => reportScene.holds(data)),
      plots: plots(data),
    };
    const parts = [report.summary, report.limitsShare, report.geometry, report.time, report.holds,
      ...report.plots.map((plot) => plot.body)];
    report.problems = [...new Set(
        [...parts.filter((p) => !p.ok).map((p) => p.problem), ...report.geometryProblems])];
    return report;
  }

  return {prepare, limitColours, formatKey, formatLive, formatShare};
})();
