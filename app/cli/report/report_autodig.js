'use strict';
// What the page shows of a task's run, computed from its JSON object; pure, like report_data.js.
// The figures are those of the paper, planned and real, then what the paper does not show.
const reportAutodig = (() => {
  const {Problem, part, isObject, show, needList, time, seriesList} = reportChecks;
  const DEGREES = 180 / Math.PI;
  const KINDS = {line: 'straight line', drives: 'drive space'};

  const isNumber = (value) => typeof value === 'number';
  const given = (value) => value !== undefined && value !== null;

  /// null where it is not known: a step that never came has neither time nor place.
  function optional(step, key, i, right, words) {
    if (!given(step[key])) return null;
    if (!right(step[key])) {
      throw new Problem(`“steps”, entry ${i + 1}, “${key}”: ${show(step[key])} is ${words}.`);
    }
    return step[key];
  }

  function readStep(step, i) {
    if (!isObject(step) || typeof step.name !== 'string') {
      throw new Problem(`“steps”, entry ${i + 1}, has no name.`);
    }
    if (!Object.hasOwn(KINDS, step.kind)) {
      throw new Problem(
          `“steps”, entry ${i + 1}, “kind”: ${show(step.kind ?? null)} is not ${
            Object.keys(KINDS).map((kind) => `"${kind}"`).join(' or ')}.`);
    }
    const moment = (key) => optional(step, key, i, isNumber, 'no number');
    const place = (key) => optional(step, key, i,
        (value) => Array.isArray(value) && value.length === 3 && value.every(isNumber),
        'not 3 numbers');
    const read = {name: step.name, kind: step.kind, way: KINDS[step.kind], from: moment('from_s'),
      until: moment('until_s'), start: place('from_m'), end: place('to_m')};
    if (read.from !== null && read.until !== null && read.until < read.from) {
      throw new Problem(`“steps”, entry ${i + 1}, ends before it begins.`);
    }
    return read;
  }

  function steps(data) {
    const list = needList(data, 'steps').map(readStep);
    if (list.length === 0) throw new Problem('“steps” is empty.');
    return list;
  }

  /// Of the steps that have begun; one that does not end lasts as long as the run.
  function stretches(data, list) {
    const last = time(data).at(-1);
    return list.flatMap(({name, from, until}, i) => (
      from === null ? [] : [{from, until: until ?? Math.max(last, from), name, number: i + 1}]));
  }

  /// What the machine may not pass, the surface to dig to among it.
  function fences(data) {
    const words = (one, name) => {
      if (!isObject(one) || typeof one.words !== 'string') {
        throw new Problem(`${name} has no words.`);
      }
      return one.words;
    };
    const list = needList(data, 'fences')
        .map((fence, i) => words(fence, `“fences”, entry ${i + 1},`));
    return given(data.design) ? [`design: ${words(data.design, '“design”')}`, ...list] : list;
  }

  const single = (data, name, label, colour, factor, digits) =>
    ({lines: [{label, colour, values: seriesList(data, name, factor), digits}]});

  function attitudePlot(data) {
    return {lines: [
      {label: 'planned', colour: 'design-soft', wide: true, digits: 2,
        values: seriesList(data, 'planned_attitude_rad', DEGREES)},
      {label: 'real', colour: 'true', values: seriesList(data, 'attitude_rad', DEGREES), digits: 2},
    ]};
  }

  function spoolPlot(data) {
    const series = [{name: 'spool_command', words: 'command'}, {name: 'spool_real', words: 'real'}];
    return {lines: reportDrives.lines(data, series, reportDrives.ALL, {factor: 100, digits: 1})};
  }

  const isKnown = (body) => body.lines.some(({values}) => values.some((value) => value !== null));

  /// A plot of nothing but gaps says so.
  function withWords(plot) {
    if (!plot.body.ok || isKnown(plot.body.value)) return plot;
    return {...plot, body: {ok: false, problem: `${plot.title}: no value is known.`}};
  }

  /// A task without a line has no distance from one, and misses nothing.
  function errorPlots(data, list) {
    const body = part(() => reportParts.errorPlot(data));
    const noLine = list.ok && list.value.every(({kind}) => kind !== 'line');
    if (noLine && body.ok && !isKnown(body.value)) return [];
    return [{id: 'error', title: 'Distance of the bucket teeth from the line',
      axis: 'distance (mm)', unit: 'mm', height: 230, body}];
  }

  /// The paper's figures and what belongs to them first.
  function plots(data, list) {
    const planned = [{name: 'planned', words: 'planned'}, {name: 'real', words: 'real'}];
    const wanted =
      [{name: 'velocity_wanted', words: 'wanted'}, {name: 'velocity_real', words: 'real'}];
    return [
      ...errorPlots(data, list),
      {id: 'lambda', title: 'Speed factor λ and what holds it', axis: 'λ (1)', unit: '',
        height: 240, body: part(() => reportParts.lambdaPlot(data, time(data)))},
      {id: 'progress', title: 'Progress of the step', axis: 'progress (%)', unit: '%', height: 180,
        body: part(() => single(data, 'progress', 'progress', 'ink', 100, 1))},
      {id: 'attitude', title: 'Attitude of the bucket', source: 'Zhang, Fig. 6',
        axis: 'attitude (°)', unit: '°', height: 200, body: part(() => attitudePlot(data))},
      ...reportDrives.plots(data, 'displacement', planned, 'displacement', '', 'Zhang, Fig. 8'),
      ...reportDrives.plots(data, 'velocity', wanted, 'velocity', '/s', 'Zhang, Fig. 9'),
      {id: 'spool', title: 'Spools, commanded and real', axis: 'spool (% of travel)', unit: '%',
        height: 270, body: part(() => spoolPlot(data))},
      {id: 'pressure', title: 'Pump pressures, expected and real', axis: 'pressure (MPa)',
        unit: 'MPa', height: 240,
        body: part(() => reportParts.pressurePlot(data, 'pump_expected_pa', 'pump_real_pa'))},
      ...reportParts.cyclePlots(data),
    ].map(withWords);
  }

  function prepare(data) {
    const list = part(() => steps(data));
    const named = part(() => (list.ok ? stretches(data, list.value) : []));
    const stages = named.ok ? named.value : [];
    const space = reportSpace.picture(data, {planned: 'planned_m', real: 'teeth_m'}, stages);
    const report = {
      ...reportParts.head(data),
      paper: reportParts.ZHANG,
      path: null,
      space,
      task: {steps: list, fences: part(() => fences(data))},
      stages,
      x: {...part(() => time(data)), name: 'time', unit: 's', digits: 2, label: 'time (s)'},
      shade: {ok: true, value: []},
      plots: plots(data, list),
    };
    report.problems = reportParts.problems([report.summary, report.limitsShare, space, list,
      named, report.task.fences, report.x, ...report.plots.map((plot) => plot.body)],
    space.problems);
    return report;
  }

  return {prepare};
})();
