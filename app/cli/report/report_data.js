'use strict';
// What the page shows of a digging run, computed from the run's JSON object. Pure: no document, no drawing, so that
// it runs outside a browser too. A part that is missing or malformed becomes a sentence that
// the page prints in that part's place; the other parts stay.
const reportData = (() => {
  const AXES = ['boom', 'arm', 'bucket'];
  const {Problem, part, isObject, need, needList, checkTuples, time, seriesList, seriesGroup} =
    reportChecks;
  const N_PER_KN = 1e3;

  function axisPair(wide, narrow, i, words, digits) {
    return [
      {label: words[0], colour: `${AXES[i]}-soft`, wide: true, values: wide[i], digits},
      {label: words[1], colour: AXES[i], values: narrow[i], digits},
    ];
  }

  function spoolPlot(data) {
    const series = [{name: 'spool_command', words: 'command'}, {name: 'spool_real', words: 'real'}];
    return {lines: reportDrives.lines(data, series, reportDrives.CYLINDERS,
        {count: AXES.length, factor: 100, digits: 1})};
  }

  function velocityPlot(data, i) {
    const wanted = seriesGroup(data, 'velocity_wanted', [3, 3]);
    const real = seriesGroup(data, 'velocity_real', [3, 3]);
    return {lines: axisPair(wanted, real, i, ['wanted', 'real'], 3)};
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
        axis: 'λ (1)', unit: '', height: 240, body: part(() => reportParts.lambdaPlot(data, time(data)))},
      {id: 'spool', title: 'Spools, commanded and real', source: 'Kim, Fig. 12',
        axis: 'spool (% of travel)', unit: '%', height: 270, body: part(() => spoolPlot(data))},
      ...velocityPlots(data),
      ...(recorded ? [{id: 'tip-velocity', title: 'Velocity of the bucket tip, and λ',
        source: 'Kim, Fig. 15', axis: 'velocity (m/s)', unit: 'm/s', height: 320,
        body: part(() => tipVelocityPlot(data))}] : []),
      {id: 'pressure', title: 'Pump pressures, expected and real', axis: 'pressure (MPa)',
        unit: 'MPa', height: 240, body: part(() => reportParts.pressurePlot(
            data, 'pump_pressure_expected', 'pump_pressure_real'))},
      {id: 'error', title: 'Path error of the bucket tip', axis: 'path error (mm)', unit: 'mm',
        height: 230, body: part(() => reportParts.errorPlot(data))},
      ...reportParts.cyclePlots(data),
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
    const picture = pathPicture(data);
    const shade = part(() => reportScene.holds(data));
    const holds = shade.ok ? shade.value : [];
    const report = {
      ...reportParts.head(data),
      paper: 'K. Kim et al., Modeling and Velocity-Field Control of Autonomous Excavator with ' +
          'Main Control Valve',
      path: {...picture.base, problems: picture.problems, source: picture.source},
      x: {...part(() => time(data)), name: 'time', unit: 's', digits: 2, label: 'time (s)'},
      shade: {...shade, words: 'the obstacle holds', digits: 1,
        named: holds, around: holds, button: 'Around the obstacle'},
      plots: plots(data),
    };
    report.problems = reportParts.problems([report.summary, report.limitsShare, report.path,
      report.x, report.shade, ...report.plots.map((plot) => plot.body)], report.path.problems);
    return report;
  }

  return {prepare};
})();
