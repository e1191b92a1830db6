'use strict';
// Lines of an excavator's drives, each in its own colour; pure, like report_data.js.
const reportDrives = (() => {
  const {part, seriesGroup} = reportChecks;
  const NAMES = ['boom', 'arm', 'bucket', 'swing'];
  const CYLINDERS = [0, 1, 2];
  const SWING = [3];
  const ALL = [...CYLINDERS, ...SWING];
  const MM_PER_M = 1e3;
  const DEGREES = 180 / Math.PI;

  /// A line for each of `drives` from each of `series`, {name, words}. Of two series the first is
  /// pale and broad, and before the other as a whole: it must not cover another drive's real line.
  function lines(data, series, drives, {count = ALL.length, factor = 1, digits}) {
    const groups = series.map(({name}) => seriesGroup(data, name, [count, count], factor));
    return series.flatMap(({words}, k) => drives.map((i) => {
      const values = groups[k][i];
      const label = words ? `${NAMES[i]} ${words}` : NAMES[i];
      return series.length > 1 && k === 0 ?
        {label, colour: `${NAMES[i]}-soft`, wide: true, values, digits} :
        {label, colour: NAMES[i], values, digits};
    }));
  }

  /// Cylinders and swing have two units: two plots of one figure of the paper. `per` is what
  /// follows the unit of length or angle.
  function plots(data, id, series, words, per, source) {
    return [
      {id: `cylinder-${id}`, title: `Cylinders: ${words}`, source, axis: `${words} (mm${per})`,
        unit: `mm${per}`, height: 240, body: part(() => (
          {lines: lines(data, series, CYLINDERS, {factor: MM_PER_M, digits: 1})}))},
      {id: `swing-${id}`, title: `Swing: ${words}`, source, axis: `${words} (°${per})`,
        unit: `°${per}`, height: 190, body: part(() => (
          {lines: lines(data, series, SWING, {factor: DEGREES, digits: 2})}))},
    ];
  }

  return {CYLINDERS, ALL, lines, plots};
})();
