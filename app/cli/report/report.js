'use strict';
// Puts the prepared data on the page: key figures, table, path and the plots.
const reportPage = (() => {
  const PRINT_WIDTH_PX = 690;  // A4 less its margins, at 96 px to the inch
  const PALETTE_SIZE = 9;
  const KINDS =
    {dig: reportData, grade: reportGrade, plan: reportPlan, autodig: reportAutodig};
  const AROUND = 2;  // of the x axis: shown before and after what the reader wants to see closely

  let report = null;
  let figures = [];  // {plot, holder, legend, chart}
  let pathFigure = {showAt: () => {}};
  let spaceFigure = {showAt: () => {}};
  const hiddenLayers = new Set();

  const {$, make, complaint} = reportDom;
  const root = document.documentElement;

  /// Beyond the palette, tones repeat; the live legend still names the limit.
  function limitColour(name) {
    const i = report.limitColours.get(name) ?? 0;
    return `limit${i === 0 ? 0 : (i - 1) % PALETTE_SIZE + 1}`;
  }

  function swatch(name) {
    const node = make('span', {className: 'swatch'});
    node.style.background = `var(--${limitColour(name)})`;
    return node;
  }

  function fillHead() {
    document.title = report.title;
    $('title').textContent = report.title;
    $('subtitle').textContent = report.subtitle;
    if (report.problems.length > 0) {
      $('problems').hidden = false;
      $('problems').replaceChildren(
          make('strong', {textContent: 'Parts of this report could not be shown'}),
          make('ul', {}, ...report.problems.map((text) => make('li', {textContent: text}))));
    }
    if (!report.summary.ok) return $('summary').append(complaint(report.summary.problem));
    for (const row of report.summary.value) {
      $('summary').append(make('div', {className: 'figure'},
          make('dt', {textContent: row.label}),
          make('dd', {}, make('span', {className: 'value', textContent: row.value}),
              make('span', {className: 'unit', textContent: row.unit ? ` ${row.unit}` : ''})),
          ...(row.note ? [make('dd', {className: 'note', textContent: row.note})] : [])));
    }
  }

  function fillLimits() {
    // A plan has no shares of time.
    if (!report.limitsShare) return $('limits-section').remove();
    if (!report.limitsShare.ok) {
      return $('limits-table').replaceWith(complaint(report.limitsShare.problem));
    }
    for (const {name, share} of report.limitsShare.value) {
      const bar = make('span', {className: 'bar'});
      bar.style.width = share > 0 ? `max(2px, ${Math.min(share, 1) * 100}%)` : '0';
      bar.style.background = `var(--${limitColour(name)})`;
      $('limits').append(make('tr', {},
          make('th', {scope: 'row'}, name, bar),
          make('td', {textContent: reportParts.formatShare(share)})));
    }
  }

  /// Which figure of the paper shows the same.
  function sourceNote(text) {
    return make('small', {className: 'source', textContent: text, title: report.paper});
  }

  function fillPath(width) {
    const box = $('path');
    if (!report.path) return;
    if (!report.path.ok) return box.replaceChildren(complaint(report.path.problem));
    const geometry = report.path.value;
    const drawn = reportPath.draw(geometry, width ?? box.clientWidth, hiddenLayers);
    // The dot follows the plots only where samples of both are the same.
    const same = report.x.ok && geometry.tipTrue.length === report.x.value.length;
    pathFigure = same ? drawn : {showAt: () => {}};
    box.replaceChildren(drawn.svg);
  }

  function fillPathHead() {
    if (!report.path) return $('path-section').remove();
    $('path-title').append(' ', sourceNote(report.path.source));
    $('path').after(...report.path.problems.map(complaint));
  }

  function fillPathLegend() {
    if (!report.path?.ok) return;
    const layers = [['path', 'wanted path'], ['true', 'true tip'], ['measured', 'measured tip'],
      ['field', 'velocity field'], ['attitude', 'attitude every 5 s']];
    const {obstacle, changes} = report.path.value;
    if (obstacle || changes.length > 0) layers.push(['obstacle', 'obstacle, held and let go']);
    fillLayers($('path-legend'), layers, fillPath);
  }

  /// Buttons that show and hide layers of a picture, which `refill` draws again.
  function fillLayers(legend, layers, refill) {
    for (const [name, text] of layers) {
      const button = make('button', {type: 'button', className: 'layer'},
          make('span', {className: `line ${name}`}), text);
      button.setAttribute('aria-pressed', 'true');
      button.addEventListener('click', () => {
        hiddenLayers.has(name) ? hiddenLayers.delete(name) : hiddenLayers.add(name);
        button.setAttribute('aria-pressed', String(!hiddenLayers.has(name)));
        refill();
      });
      legend.append(button);
    }
  }

  function fillSpaceHead() {
    const {space} = report;
    if (!space) return $('space-section').remove();
    $('space-section').hidden = false;
    $('space-title').append(' ', sourceNote('Zhang, Fig. 7'));
    $('space').after(...space.problems.map(complaint));
    if (!space.ok) return;
    const {planned, real, interval_s: interval} = space.value;
    fillLayers($('space-legend'), [
      ...(planned ? [['planned-teeth', 'planned']] : []), ...(real ? [['real-teeth', 'real']] : []),
      ['points', `a point every ${reportParts.formatKey(interval)} s`]], fillSpace);
  }

  function fillSpace(width) {
    if (!report.space) return;
    const box = $('space');
    if (!report.space.ok) return box.replaceChildren(complaint(report.space.problem));
    spaceFigure = reportSpace.draw(report.space.value, width ?? box.clientWidth, hiddenLayers);
    box.replaceChildren(...spaceFigure.views.map(({title, svg}) =>
      make('figure', {}, make('figcaption', {textContent: title}), svg)));
  }

  /// One alone has the whole width.
  function layOutTop() {
    const top = document.querySelector('.top');
    top.classList.toggle('single', top.childElementCount < 2);
  }

  /// The library's legend is for the mouse; the same rows for the keyboard.
  function makeLegendKeys(figure) {
    [...figure.legend.querySelectorAll('.u-series')].forEach((row, i) => {
      const head = row.querySelector('th');
      if (i === 0) return row.classList.add('x');
      if (figure.plot.body.value.lines[i - 1]?.wide) row.classList.add('wide');
      if (i > figure.plot.body.value.lines.length) row.classList.add('strip');
      head.tabIndex = 0;
      head.setAttribute('role', 'button');
      head.title = 'Show or hide';
      head.addEventListener('keydown', (event) => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        head.dispatchEvent(new MouseEvent('click', {bubbles: true}));
      });
    });
  }

  function zoomAll(min, max) {
    for (const figure of figures) figure.chart.setScale('x', {min, max});
  }

  function wholeRun() {
    if (report.x.ok) zoomAll(report.x.value[0], report.x.value.at(-1));
  }

  /// What the shade in the plots means, and a button to see that time closely.
  function fillShade() {
    const {shade, x} = report;
    if (!shade.ok) return $('shade').replaceWith(complaint(shade.problem));
    if (shade.value.length === 0) return;
    const words = shade.named.map((run) =>
      `${run.from.toFixed(shade.digits)} to ${run.until.toFixed(shade.digits)} ${x.unit}`);
    $('shade').append(make('span', {className: 'swatch shade'}),
        `${shade.words}: ${words.join(', ')}`);
    $('shade').hidden = false;
    const from = Math.max(shade.around[0].from - AROUND, x.value[0]);
    const until = Math.min(shade.around.at(-1).until + AROUND, x.value.at(-1));
    $('around').textContent = shade.button;
    $('around').hidden = false;
    $('around').addEventListener('click', () => zoomAll(from, until));
  }

  function zoomBy(chart, factor) {
    const times = report.x.value;
    const {min, max} = chart.scales.x;
    const at = chart.cursor.left >= 0 ? chart.posToVal(chart.cursor.left, 'x') : (min + max) / 2;
    const from = Math.max(at - (at - min) * factor, times[0]);
    const until = Math.min(at + (max - at) * factor, times.at(-1));
    if (until > from) zoomAll(from, until);
  }

  function moveCursor(chart, pixels) {
    const width = chart.over.clientWidth;
    const left = chart.cursor.left >= 0 ? chart.cursor.left + pixels : width / 2;
    chart.setCursor({left: Math.min(Math.max(left, 0), width), top: 10}, true, true);
  }

  function onKey(event, chart) {
    const step = event.shiftKey ? 40 : 4;
    const actions = {
      ArrowLeft: () => moveCursor(chart, -step), ArrowRight: () => moveCursor(chart, step),
      '+': () => zoomBy(chart, 0.5), '-': () => zoomBy(chart, 2), '0': wholeRun,
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    actions[event.key]();
  }

  function stripKey(strip) {
    const present = [...new Set(strip.runs.map((run) => strip.names[run.value]))];
    return make('p', {className: 'key'}, 'limit: ',
        ...present.map((name) => make('span', {}, swatch(name), name)));
  }

  function makeFigures() {
    for (const plot of report.plots) {
      const legend = make('div', {className: 'legend'});
      // Wanted above real, a column for each axis or pump.
      const wide = plot.body.ok ? plot.body.value.lines.filter((line) => line.wide).length : 0;
      if (wide > 1) legend.classList.add('pairs');
      legend.style.setProperty('--pairs', wide);
      const holder = make('div', {className: 'chart'});
      const section = make('section', {id: plot.id},
          make('div', {className: 'bar-top'}, make('h2', {}, plot.title,
              ...(plot.source ? [' ', sourceNote(plot.source)] : [])), legend),
          holder);
      $('plots').append(section);
      if (!plot.body.ok) {
        holder.append(complaint(plot.body.problem));
        continue;
      }
      if (plot.body.value.strip) section.append(stripKey(plot.body.value.strip));
      const figure = {plot, holder, legend, chart: null};
      holder.tabIndex = 0;
      holder.setAttribute('role', 'group');
      holder.setAttribute('aria-label',
          `${plot.title}: arrow keys move the cursor, plus and minus zoom, 0 shows the whole run`);
      holder.addEventListener('keydown', (event) => onKey(event, figure.chart));
      figures.push(figure);
    }
  }

  /// Colours are read from the style sheet when a chart is made: a new theme needs new charts,
  /// with the reader's zoom and choice of lines.
  function drawCharts(width) {
    for (const figure of figures) {
      const old = figure.chart;
      const zoom = old && {min: old.scales.x.min, max: old.scales.x.max};
      const hidden = old ? old.series.map((s, i) => (s.show ? 0 : i)).filter((i) => i > 0) : [];
      old?.destroy();
      const {lines, strip} = figure.plot.body.value;
      const data = [report.x.value, ...lines.map((line) => line.values)];
      if (strip) data.push(strip.values);
      const options = reportChart.options(figure.plot, width ?? figure.holder.clientWidth, {
        x: report.x,
        shade: report.shade.ok ? report.shade.value : [],
        limitColour,
        mountLegend: (table) => figure.legend.replaceChildren(table),
        stages: report.stages,
        showAt: (index) => {
          pathFigure.showAt(index);
          spaceFigure.showAt(index);
        },
      });
      figure.chart = new uPlot(options, data, figure.holder);
      makeLegendKeys(figure);
      if (zoom) figure.chart.setScale('x', zoom);
      hidden.forEach((i) => figure.chart.setSeries(i, {show: false}));
    }
  }

  function resize() {
    if (printing()) return;
    for (const figure of figures) {
      figure.chart.setSize({width: figure.holder.clientWidth, height: figure.plot.height});
    }
    fillPath();
    fillSpace();
  }

  // Browsers may report the sheet as a new window size or a new theme; print() has chosen both.
  const printing = () => root.classList.contains('printing');

  function retheme() {
    if (!printing()) drawCharts();
  }

  function print(on) {
    root.classList.toggle('printing', on);
    drawCharts(on ? PRINT_WIDTH_PX : undefined);
    fillPath(on ? PRINT_WIDTH_PX : undefined);
    fillSpace(on ? PRINT_WIDTH_PX : undefined);
  }

  function show(data) {
    report = KINDS[Object.hasOwn(KINDS, data?.kind) ? data.kind : 'dig'].prepare(data);
    fillHead();
    fillLimits();
    fillPathHead();
    fillPathLegend();
    fillPath();
    fillSpaceHead();
    fillSpace();
    reportTask.fill(report, zoomAll);
    layOutTop();
    fillShade();
    makeFigures();
    drawCharts();
    $('whole').addEventListener('click', wholeRun);
    addEventListener('resize', resize);
    addEventListener('beforeprint', () => print(true));
    addEventListener('afterprint', () => print(false));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', retheme);
  }

  function start() {
    const fail = (text) => {
      $('problems').hidden = false;
      $('problems').append(make('p', {textContent: text}));
    };
    addEventListener('error', (event) => fail(`The page could not be drawn: ${event.message}`));
    let data;
    try {
      data = JSON.parse($('data').textContent);
    } catch (error) {
      return fail(`The data in this file cannot be read: ${error.message}`);
    }
    show(data);
  }

  return {start};
})();
