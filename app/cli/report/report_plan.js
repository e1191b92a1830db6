'use strict';
// What the page shows of a planned line, computed from its JSON object; pure, like report_data.js.
// The figures are those of the paper: teeth first, then the drives.
const reportPlan = (() => {
  const {part, time, seriesList, seriesGroup} = reportChecks;
  const MM_PER_M = 1e3;
  const DEGREES = 180 / Math.PI;

  const single = (data, name, label, factor, digits) =>
    ({lines: [{label, colour: 'true', values: seriesList(data, name, factor), digits}]});

  function placePlot(data) {
    const [x, y, z] = seriesGroup(data, 'teeth_m', [3, 3]);
    return {lines: [
      {label: 'x', colour: 'vector-x', values: x, digits: 3},
      {label: 'y', colour: 'vector-y', values: y, digits: 3},
      {label: 'z, up', colour: 'true', values: z, digits: 3},
    ]};
  }

  const drivePlots = (data, name, per, figure) =>
    reportDrives.plots(data, name, [{name}], name, per, `Zhang, Fig. ${figure}`);

  function plots(data) {
    return [
      {id: 'way', title: 'Way of the bucket teeth', source: 'Zhang, Fig. 5 (a)', axis: 'way (mm)',
        unit: 'mm', height: 200, body: part(() => single(data, 'way_m', 'way', MM_PER_M, 1))},
      {id: 'speed', title: 'Speed of the bucket teeth', source: 'Zhang, Fig. 5 (b)',
        axis: 'speed (mm/s)', unit: 'mm/s', height: 200,
        body: part(() => single(data, 'speed_mps', 'speed', MM_PER_M, 1))},
      {id: 'place', title: 'Place of the bucket teeth', source: 'Zhang, Fig. 6',
        axis: 'place (m)', unit: 'm', height: 240, body: part(() => placePlot(data))},
      {id: 'attitude', title: 'Attitude of the bucket', source: 'Zhang, Fig. 6',
        axis: 'attitude (°)', unit: '°', height: 190,
        body: part(() => single(data, 'attitude_rad', 'attitude', DEGREES, 2))},
      ...drivePlots(data, 'displacement', '', 8),
      ...drivePlots(data, 'velocity', '/s', 9),
      ...drivePlots(data, 'acceleration', '/s²', 10),
    ];
  }

  function prepare(data) {
    const space = reportSpace.picture(data, {planned: 'teeth_m'});
    const report = {
      ...reportParts.head(data),
      limitsShare: null,
      paper: reportParts.ZHANG,
      path: null,
      space,
      x: {...part(() => time(data)), name: 'time', unit: 's', digits: 2, label: 'time (s)'},
      shade: {ok: true, value: []},
      plots: plots(data),
    };
    report.problems = reportParts.problems([report.summary, space, report.x,
      ...report.plots.map((plot) => plot.body)], space.problems);
    return report;
  }

  return {prepare};
})();
