'use strict';
// A task's steps and fences on the page, from what reportAutodig has prepared.
const reportTask = (() => {
  const {$, make, complaint} = reportDom;
  const HEADS =
    ['step', 'way', 'time (s)', 'teeth from x, y, z (m)', 'to x, y, z (m)'];

  const orDash = (value, format) => (value === null ? '–' : format(value));
  const seconds = (value) => orDash(value, (s) => reportParts.formatLive(s, 2));
  const place = (value) =>
    orDash(value, (at) => at.map((v) => reportParts.formatLive(v, 2)).join(', '));

  /// The step's name; of one that has lasted, a button that shows its time closely.
  function heading(words, stage, zoom) {
    if (!stage || !(stage.until > stage.from)) return words;
    const button =
      make('button', {type: 'button', title: 'Show this step in the plots', textContent: words});
    button.addEventListener('click', () => zoom(stage.from, stage.until));
    return button;
  }

  function row(step, i, stages, zoom) {
    const stage = stages.find(({number}) => number === i + 1);
    const cells = [step.way, `${seconds(step.from)} to ${seconds(step.until)}`, place(step.start),
      place(step.end)];
    return make('tr', {},
        make('th', {scope: 'row'}, heading(`${i + 1} ${step.name}`, stage, zoom)),
        ...cells.map((textContent) => make('td', {textContent})));
  }

  function stepTable(steps, stages, zoom) {
    return make('table', {},
        make('thead', {}, make('tr', {}, ...HEADS.map((textContent) =>
          make('th', {scope: 'col', textContent})))),
        make('tbody', {}, ...steps.map((step, i) => row(step, i, stages, zoom))));
  }

  function fenceList(fences) {
    if (fences.length === 0) return make('p', {textContent: 'none'});
    return make('ul', {}, ...fences.map((textContent) => make('li', {textContent})));
  }

  /// `zoom` shows a stretch of time in every plot.
  function fill({task, stages}, zoom) {
    if (!task) return $('task-section').remove();
    $('task-section').hidden = false;
    const {steps, fences} = task;
    $('steps').append(steps.ok ? stepTable(steps.value, stages, zoom) : complaint(steps.problem));
    $('fences').append(fences.ok ? fenceList(fences.value) : complaint(fences.problem));
  }

  return {fill};
})();
