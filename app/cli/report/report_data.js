'use strict';
// What the page shows, computed from the run's JSON object. Pure: no document, no drawing, so that
// it runs outside a browser too. A part that is missing or malformed becomes a sentence that
// the page prints in that part's place; the other parts stay.
const reportData = (() => {
  const AXES = ['boom', 'arm', 'bucket'];
  const PA_PER_MPA = 1e6;
  const MM_PER_M = 1e3;

  class Problem extends Error {}

  function part(compute) {
    try {
      return {ok: true, value: compute()};
    } catch (error) {
      if (error instanceof Problem) return {ok: false, problem: error.message};
      throw error;
    }
  }

  const isObject = (value) => value !== null && typeof value === 'object' && !Array.isArray(value);

  function show(value) {
    const text = JSON.stringify(value);
    return text.length > 30 ? `${text.slice(0, 30)}…` : text;
  }

  /// The value at a dotted path; a Problem naming the first missing piece otherwise.
  function need(data, path) {
    let value = data;
    let walked = '';
    for (const key of path.split('.')) {
      walked = walked ? `${walked}.${key}` : key;
      if (!isObject(value) || value[key] === undefined || value[key] === null) {
        throw new Problem(`“${walked}” is missing from the data.`);
      }
      value = value[key];
    }
    return value;
  }

  function needList(data, path) {
    const list = need(data, path);
    if (!Array.isArray(list)) throw new Problem(`“${path}” is not a list.`);
    return list;
  }

  /// null is a gap: the JSON writer turns not-a-number into it.
  function checkNumbers(list, path, count) {
    if (!Array.isArray(list)) throw new Problem(`“${path}” is not a list.`);
    if (count !== undefined && list.length !== count) {
      throw new Problem(`“${path}” has ${list.length} values, “series.time_s” has ${count}.`);
    }
    const bad = list.findIndex((value) => value !== null && typeof value !== 'number');
    if (bad >= 0) {
      throw new Problem(`“${path}”, value ${bad + 1}: ${show(list[bad])} is no number.`);
    }
    return list;
  }

  function checkTuples(list, path, width) {
    const bad = list.findIndex((tuple) => !Array.isArray(tuple) || tuple.length !== width ||
        tuple.some((value) => typeof value !== 'number'));
    if (bad >= 0) {
      throw new Problem(`“${path}”, entry ${bad + 1}: ${show(list[bad])} is not ${width} numbers.`);
    }
    return list;
  }

  function time(data) {
    const list = checkNumbers(needList(data, 'series.time_s'), 'series.time_s');
    if (list.length < 2) throw new Problem('“series.time_s” has fewer than two values.');
    const bad = list.findIndex((value, i) => value === null || (i > 0 && value < list[i - 1]));
    if (bad >= 0) {
      throw new Problem(`“series.time_s”, value ${bad + 1}, does not follow the one before.`);
    }
    return list;
  }

  const scaled = (list, factor) => list.map((value) => (value === null ? null : value * factor));

  function seriesList(data, name, factor = 1) {
    const path = `series.${name}`;
    return scaled(checkNumbers(needList(data, path), path, time(data).length), factor);
  }

  /// One list for each axis or pump.
  function seriesGroup(data, name, counts, factor = 1) {
    const path = `series.${name}`;
    const group = needList(data, path);
    if (group.length < counts[0] || group.length > counts[1]) {
      const wanted = counts[0] === counts[1] ? counts[0] : counts.join(' to ');
      throw new Problem(`“${path}” has ${group.length} lists, not ${wanted}.`);
    }
    const count = time(data).length;
    return group.map((list, i) => scaled(checkNumbers(list, `${path}[${i}]`, count), factor));
  }

  /// Stretches of time during which one limit holds; a sample holds until the next one.
  function limitRuns(times, limits) {
    const runs = [];
    for (let i = 0; i < times.length; ++i) {
      const until = times[Math.min(i + 1, times.length - 1)];
      const last = runs[runs.length - 1];
      if (last && last.limit === limits[i] && last.until === times[i]) {
        last.until = until;
      } else if (limits[i] !== null) {
        runs.push({from: times[i], until, limit: limits[i]});
      }
    }
    return runs;
  }

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
      strip: {label: 'held by', values: limits, names, runs: limitRuns(times, limits)},
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

  function cyclePlot(data) {
    const values = seriesList(data, 'cycle_time_us');
    return {lines: [{label: 'cycle', colour: 'ink', values, digits: 1}]};
  }

  function plots(data) {
    const list = [
      {id: 'lambda', title: 'Speed factor λ and what holds it', axis: 'λ (1)', unit: '',
        height: 240, body: part(() => lambdaPlot(data))},
      {id: 'spool', title: 'Spools, commanded and real', axis: 'spool (% of travel)', unit: '%',
        height: 270, body: part(() => spoolPlot(data))},
      ...AXES.map((axis, i) => ({
        id: `velocity-${axis}`, title: `${axis[0].toUpperCase()}${axis.slice(1)} cylinder velocity`,
        axis: `${axis} (m/s)`, unit: 'm/s', height: 200, body: part(() => velocityPlot(data, i))})),
      {id: 'pressure', title: 'Pump pressures, expected and real', axis: 'pressure (MPa)',
        unit: 'MPa', height: 240, body: part(() => pressurePlot(data))},
      {id: 'error', title: 'Path error of the bucket tip', axis: 'path error (mm)', unit: 'mm',
        height: 230, body: part(() => errorPlot(data))},
    ];
    // Optional: without it there is nothing to miss.
    if (isObject(data) && isObject(data.series) && data.series.cycle_time_us) {
      list.push({id: 'cycle', title: 'Computing time of a control cycle', axis: 'cycle (µs)',
        unit: 'µs', height: 190, body: part(() => cyclePlot(data))});
    }
    return list;
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
    const ground = data.geometry.ground_y_m;
    return {
      path: points('path', 3),
      tipTrue: points('tip_true', 1),
      tipMeasured: points('tip_measured', 0, true),
      field: checkTuples(needList(data, 'geometry.field'), 'geometry.field', 4),
      groundY: typeof ground === 'number' ? ground : null,
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

  function prepare(data) {
    const text = (key, otherwise) =>
      (isObject(data) && typeof data[key] === 'string' ? data[key] : otherwise);
    const report = {
      title: text('title', 'Simulated run'),
      subtitle: text('subtitle', ''),
      summary: part(() => summary(data)),
      limitsShare: part(() => limitsShare(data)),
      limitColours: limitColours(data),
      geometry: part(() => geometry(data)),
      time: part(() => time(data)),
      plots: plots(data),
    };
    const parts = [report.summary, report.limitsShare, report.geometry, report.time,
      ...report.plots.map((plot) => plot.body)];
    report.problems = [...new Set(parts.filter((p) => !p.ok).map((p) => p.problem))];
    return report;
  }

  return {prepare, limitRuns, limitColours, formatKey, formatLive, formatShare};
})();
