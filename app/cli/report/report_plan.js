'use strict';
// What the page shows of a planned line, computed from its JSON object; pure, like report_data.js.
// The figures are those of the paper: teeth first, then the drives.
const reportPlan = (() => {
  const {part, time, seriesList, seriesGroup} = reportChecks;
  const MM_PER_M = 1e3;
  const DEGREES = 180 / Math.PI;
  const CYLINDERS = ['boom', 'arm', 'bucket'];
  const SWING = 3;

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

  const cylinderPlot = (data, name) => ({lines: seriesGroup(data, name, [4, 4], MM_PER_M)
      .slice(0, SWING).map((values, i) => (
        {label: CYLINDERS[i], colour: CYLINDERS[i], values, digits: 1}))});

  const swingPlot = (data, name) => ({lines: [{label: 'swing', colour: 'measured', digits: 2,
    values: seriesGroup(data, name, [4, 4], DEGREES)[SWING]}]});

  /// Cylinders and swing have two units: two plots of one figure of the paper.
  function drivePlots(data, name, words, per, figure) {
    const source = `Zhang, Fig. ${figure}`;
    return [
      {id: `cylinder-${name}`, title: `Cylinders: ${words}`, source,
        axis: `${words} (mm${per})`, unit: `mm${per}`, height: 240,
        body: part(() => cylinderPlot(data, name))},
      {id: `swing-${name}`, title: `Swing: ${words}`, source, axis: `${words} (°${per})`,
        unit: `°${per}`, height: 190, body: part(() => swingPlot(data, name))},
    ];
  }

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
      ...drivePlots(data, 'displacement', 'displacement', '', 8),
      ...drivePlots(data, 'velocity', 'velocity', '/s', 9),
      ...drivePlots(data, 'acceleration', 'acceleration', '/s²', 10),
    ];
  }

  function prepare(data) {
    const report = {
      ...reportParts.head(data),
      limitsShare: null,
      paper: 'B. Zhang et al., Research on Trajectory Planning and Autodig of Hydraulic Excavator',
      path: null,
      x: {...part(() => time(data)), name: 'time', unit: 's', digits: 2, label: 'time (s)'},
      shade: {ok: true, value: []},
      plots: plots(data),
    };
    report.problems = reportParts.problems(
        [report.summary, report.x, ...report.plots.map((plot) => plot.body)]);
    return report;
  }

  return {prepare};
})();
