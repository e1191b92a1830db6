'use strict';
// What the page shows of a grading run, computed from the run's JSON object; pure, like
// report_data.js. Everything is drawn over the way of the cutting edge, as in the paper.
const reportGrade = (() => {
  const {Problem, part, isObject, need, needList, checkTuples, time, runs, seriesList, seriesGroup} =
    reportChecks;
  const LPM_PER_M3PS = 6e4;
  const DEGREES = 180 / Math.PI;
  // As the summary counts: what is kept, and what belongs to one occasion.
  const FLOW_TOLERANCE = 1.02;
  const OCCASION_M = 0.5;
  const TRACKS = ['left', 'right'];

  /// How far the edge has come. It may go back a little as the body pitches; the axis does not.
  function way(data) {
    time(data);
    const list = seriesList(data, 'edge_x_m');
    const bad = list.findIndex((value) => value === null);
    if (bad >= 0) throw new Problem(`“series.edge_x_m”, value ${bad + 1}, is missing.`);
    let furthest = -Infinity;
    return list.map((value) => (furthest = Math.max(furthest, value)));
  }

  /// Height at each of `places`, straight between points; null beyond them. Neither falls in x.
  function heights(points, places) {
    let i = 0;
    return places.map((x) => {
      if (x < points[0][0] || x > points[points.length - 1][0]) return null;
      while (i + 2 < points.length && points[i + 1][0] < x) ++i;
      const [[x0, z0], [x1, z1]] = [points[i], points[i + 1]];
      return x1 > x0 ? z0 + (z1 - z0) * Math.min((x - x0) / (x1 - x0), 1) : z1;
    });
  }

  function ground(data) {
    const points = checkTuples(needList(data, 'terrain'), 'terrain', 2);
    if (points.length < 2) throw new Problem('“terrain” has fewer than 2 points.');
    if (points.some((point, i) => i > 0 && point[0] < points[i - 1][0])) {
      throw new Problem('“terrain” goes back.');
    }
    return points;
  }

  /// Where the body was when it was at x, not when the edge was.
  function bodyHeights(data, places) {
    const [x, z] = [seriesList(data, 'body_x_m'), seriesList(data, 'body_z_m')];
    const points = [];
    x.forEach((value, i) => {
      const last = points[points.length - 1];
      if (value !== null && z[i] !== null && (!last || value > last[0])) points.push([value, z[i]]);
    });
    return points.length > 1 ? heights(points, places) : places.map(() => null);
  }

  function elevationPlot(data) {
    const places = way(data);
    return {lines: [
      {label: 'design', colour: 'design-soft', wide: true, values: seriesList(data, 'design_m'),
        digits: 3},
      {label: 'ground as left', colour: 'ground', values: heights(ground(data), places), digits: 3},
      {label: 'body', colour: 'body', values: bodyHeights(data, places), digits: 3},
      {label: 'cutting edge', colour: 'true', values: seriesList(data, 'edge_z_m'), digits: 3},
    ]};
  }

  function speedPlot(data) {
    const desired = need(data, 'series.speed_desired_mps');
    if (typeof desired !== 'number') {
      throw new Problem('“series.speed_desired_mps” is no number.');
    }
    return {lines: [
      {label: 'desired', colour: 'ink', values: time(data).map(() => desired), digits: 3},
      {label: 'measured', colour: 'measured', digits: 3,
        values: seriesList(data, 'speed_measured_mps')},
      {label: 'true', colour: 'true', values: seriesList(data, 'speed_true_mps'), digits: 3},
      {label: 'commanded', colour: 'design', digits: 3,
        values: seriesList(data, 'speed_wanted_mps')},
    ]};
  }

  function flowPlot(data) {
    return {lines: [
      {label: 'available', colour: 'available', digits: 1,
        values: seriesList(data, 'flow_available_m3ps', LPM_PER_M3PS)},
      {label: 'required, as the controller has it', colour: 'measured', digits: 1,
        values: seriesList(data, 'flow_reported_m3ps', LPM_PER_M3PS)},
      {label: 'required', colour: 'required', digits: 1,
        values: seriesList(data, 'flow_required_m3ps', LPM_PER_M3PS)},
    ]};
  }

  function limitPlot(data) {
    return {lines: [
      {label: 'largest by (14)', colour: 'design-soft', wide: true, digits: 3,
        values: seriesList(data, 'speed_limit_mps')},
      {label: 'commanded', colour: 'design', digits: 3,
        values: seriesList(data, 'speed_wanted_mps')},
    ]};
  }

  function pairPlot(data, wanted, real, words, factor, digits) {
    return {lines: [
      {label: words[0], colour: 'design-soft', wide: true, digits,
        values: seriesList(data, wanted, factor)},
      {label: words[1], colour: 'design', values: seriesList(data, real, factor), digits},
    ]};
  }

  /// Both tracks' commands first: a pale line must not cover the other track's real one.
  function displacementPlot(data, name) {
    const command = seriesGroup(data, `${name}_command`, [2, 2], 100);
    const real = seriesGroup(data, `${name}_real`, [2, 2], 100);
    return {lines: [
      ...TRACKS.map((track, i) => ({label: `${track} command`, colour: `${track}-soft`, wide: true,
        values: command[i], digits: 1})),
      ...TRACKS.map((track, i) => (
        {label: `${track} real`, colour: track, values: real[i], digits: 1})),
    ]};
  }

  function trackPlot(data) {
    const speeds = seriesGroup(data, 'track_mps', [2, 2]);
    return {lines: TRACKS.map((track, i) => (
      {label: track, colour: track, values: speeds[i], digits: 3}))};
  }

  const pitchPlot = (data) => ({lines: [{label: 'pitch, nose up', colour: 'body', digits: 2,
    values: seriesList(data, 'pitch_rad', DEGREES)}]});

  /// The paper's figures first, then what it does not show.
  function paperPlots(data) {
    // Fig. 9 is Fig. 7 at a constant speed.
    const constant = isObject(data) && data.speed_mode === 'constant';
    const source = (letter) => (constant ? 'Mononen, Fig. 9' : `Mononen, Fig. 7 (${letter})`);
    return [
      {id: 'elevation', title: 'Elevation: design, cut and body', source: source('a'),
        axis: 'elevation (m)', unit: 'm', height: 300, body: part(() => elevationPlot(data))},
      {id: 'error', title: 'Elevation error of the cutting edge', source: source('b'),
        axis: 'error (mm)', unit: 'mm', height: 230, body: part(() => reportParts.errorPlot(data))},
      {id: 'speed', title: 'Travel speed', source: source('c'), axis: 'speed (m/s)', unit: 'm/s',
        height: 230, body: part(() => speedPlot(data))},
      {id: 'flow', title: 'Flow that the blade needs, and what there is', source: source('d'),
        axis: 'flow (L/min)', unit: 'L/min', height: 250, body: part(() => flowPlot(data))},
      {id: 'limit', title: 'Largest speed by flow and transmission, and the commanded one',
        source: 'Mononen, Fig. 8', axis: 'speed (m/s)', unit: 'm/s', height: 230,
        body: part(() => limitPlot(data))},
    ];
  }

  function plots(data) {
    return [
      ...paperPlots(data),
      {id: 'lambda', title: 'Share λ of the desired speed, and what holds it', axis: 'λ (1)',
        unit: '', height: 240, body: part(() => reportParts.lambdaPlot(data, way(data)))},
      {id: 'blade', title: 'Velocity of the blade cylinders', axis: 'blade (m/s)', unit: 'm/s',
        height: 200, body: part(() => pairPlot(data, 'blade_wanted_mps', 'blade_true_mps',
            ['wanted', 'real'], 1, 3))},
      {id: 'spool', title: 'Blade spool, commanded and real', axis: 'spool (% of travel)', unit: '%',
        height: 200, body: part(() => pairPlot(data, 'spool_command', 'spool_real',
            ['command', 'real'], 100, 1))},
      {id: 'pitch', title: 'Pitch of the body', axis: 'pitch (°)', unit: '°', height: 190,
        body: part(() => pitchPlot(data))},
      {id: 'track', title: 'Track speeds', axis: 'tracks (m/s)', unit: 'm/s', height: 200,
        body: part(() => trackPlot(data))},
      {id: 'pump', title: 'Displacement of the transmission\'s pumps', axis: 'pumps (%)', unit: '%',
        height: 200, body: part(() => displacementPlot(data, 'pump'))},
      {id: 'motor', title: 'Displacement of the transmission\'s motors', axis: 'motors (%)',
        unit: '%', height: 200, body: part(() => displacementPlot(data, 'motor'))},
      ...reportParts.cyclePlots(data),
    ];
  }

  /// Stretches of the way on which the blade would need more than there is.
  function overdriven(data) {
    const required = seriesList(data, 'flow_required_m3ps');
    const available = seriesList(data, 'flow_available_m3ps');
    const above = required.map((flow, i) => flow > FLOW_TOLERANCE * available[i]);
    return runs(way(data), above).filter((run) => run.value);
  }

  /// Stretches that are near to each other in one.
  function occasions(stretches) {
    const list = [];
    for (const {from, until} of stretches) {
      const last = list[list.length - 1];
      if (last && from - last.until < OCCASION_M) {
        last.until = until;
      } else {
        list.push({from, until});
      }
    }
    return list;
  }

  function prepare(data) {
    const shade = part(() => overdriven(data));
    const named = shade.ok ? occasions(shade.value) : [];
    const report = {
      ...reportParts.head(data),
      paper: 'T. Mononen, J. Mattila, Flow-Bounded Velocity Controller for Hydraulic Bulldozers',
      path: null,
      x: {...part(() => way(data)), name: 'edge at', unit: 'm', digits: 2,
        label: 'way of the cutting edge, x (m)'},
      shade: {...shade, words: 'the blade needs more flow than there is', digits: 1,
        named, around: named.slice(0, 1), button: 'Around the first'},
      plots: plots(data),
    };
    report.problems = reportParts.problems([report.summary, report.limitsShare, report.x,
      report.shade, ...report.plots.map((plot) => plot.body)]);
    return report;
  }

  return {prepare, heights};
})();
