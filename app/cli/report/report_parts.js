'use strict';
// What the page of every kind of run shows: key figures, shares of time, lambda with what holds it,
// numbers as they are read. Pure: no document, no drawing, so that it runs outside a browser too.
const reportParts = (() => {
  const {Problem, part, isObject, needList, runs, seriesList, seriesGroup} = reportChecks;
  const PA_PER_MPA = 1e6;
  const MM_PER_M = 1e3;
  const ZHANG =
    'B. Zhang et al., Research on Trajectory Planning and Autodig of Hydraulic Excavator';

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

  /// Lambda, and below it a strip of what holds it, over the page's `x`.
  function lambdaPlot(data, x) {
    const limits = seriesList(data, 'limit');
    const names = needList(data, 'series.limit_names');
    const bad = limits.findIndex((i) => i !== null && typeof names[i] !== 'string');
    if (bad >= 0) {
      throw new Problem(
          `“series.limit”, value ${bad + 1}: ${limits[bad]} has no name in “limit_names”.`);
    }
    return {
      lines: [{label: 'λ', colour: 'ink', values: seriesList(data, 'lambda'), digits: 3}],
      strip: {label: 'held by', values: limits, names, runs: runs(x, limits)},
    };
  }

  /// One list a pump; as many expected as real ones.
  function pressurePlot(data, expectedName, realName) {
    const expected = seriesGroup(data, expectedName, [1, 3], 1 / PA_PER_MPA);
    const real = seriesGroup(data, realName, [1, 3], 1 / PA_PER_MPA);
    if (expected.length !== real.length) {
      throw new Problem(
          `“series.${expectedName}” and “${realName}” differ in the number of pumps.`);
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

  /// Of a tip or an edge that is both measured and known.
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

  /// Optional: without it there is nothing to miss.
  function cyclePlots(data) {
    if (!isObject(data) || !isObject(data.series) || !data.series.cycle_time_us) return [];
    return [{id: 'cycle', title: 'Computing time of a control cycle', axis: 'cycle (µs)', unit: 'µs',
      height: 190, body: part(() => cyclePlot(data))}];
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

  /// What is the same at the head of each page.
  function head(data) {
    const text = (key, otherwise) =>
      (isObject(data) && typeof data[key] === 'string' ? data[key] : otherwise);
    return {
      title: text('title', 'Simulated run'),
      subtitle: text('subtitle', ''),
      summary: part(() => summary(data)),
      limitsShare: part(() => limitsShare(data)),
      limitColours: limitColours(data),
    };
  }

  /// Every sentence once, for the top of the page.
  const problems = (parts, more = []) =>
    [...new Set([...parts.filter((p) => !p.ok).map((p) => p.problem), ...more])];

  return {ZHANG, limitColours, lambdaPlot, pressurePlot, errorPlot, cyclePlots, head, problems,
    formatKey, formatLive, formatShare};
})();
