// SPDX-License-Identifier: Apache-2.0
/// Looking closer: closer.mjs OUT GRABEN [SCENARIO]. Any signal into any plot, one thing over
/// another, bookmarks, links to a moment, pictures and numbers to take away.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {axe, looks_at_each} from './axe.mjs';
import {look, open_browser, open_page, rest, run_scenarios, serve, SIZES, until} from './harness.mjs';

const [out, graben, only] = process.argv.slice(2);
const browser = await open_browser({pictures_ps: Infinity});
mkdirSync(out, {recursive: true});
for (const command of ['dig', 'grade']) {
  execFileSync(graben, [command, '--out', out], {stdio: 'ignore'});
}

const clean = (page) => assert.deepEqual(page.problems, []);
const url_of = (name, hash = '') => pathToFileURL(join(out, `${name}.html`)).href + hash;
const all_there = (page) => until('the log is whole', async () => {
  const seen = await look(page).catch(() => ({}));
  return seen.frames > 1000 && seen.loaded === 1;
});
const plot = (page, name) => page.locator(`.plot[data-name="${name}"]`);
const labels = (page, name) => plot(page, name).locator('.legend .label').allInnerTexts();

async function report(name = 'dig', hash = '') {
  const page = await open_page(browser, url_of(name, hash));
  await all_there(page);
  return page;
}

/// A value of the bus to a plot, by mouse, by keyboard, to a new one, and out again.
async function any_signal() {
  const page = await report();
  const message = page.locator('.disclose', {hasText: 'EcuStatus'});
  await message.click();
  const row = page.locator('.signals > div', {hasText: 'Cycle time'});
  const before = await labels(page, 'error');
  await row.dragTo(plot(page, 'error'));
  await until('it is in the plot', async () => (await labels(page, 'error')).length === before.length + 1);
  assert.match((await labels(page, 'error')).at(-1), /cycle time/i);
  // Its value is what the table says.
  const [shown, told] = await until('a value', async () => {
    const value = await plot(page, 'error').locator('.legend-entry .value').last().innerText();
    const table = await row.locator('dd').first().innerText();
    return /\d/.test(value) && [value, table];
  });
  assert.ok(told.startsWith(shown), `${shown} and ${told}`);
  // By keyboard, into a new one.
  const press = page.getByRole('button', {name: 'Plot Rejected frames'});
  await press.focus();
  await page.keyboard.press('Enter');
  await page.getByRole('button', {name: 'A new plot'}).waitFor();
  await page.keyboard.press('Enter');
  await plot(page, 'own1').waitFor();
  assert.match((await labels(page, 'own1')).join(), /rejected frames/i);
  // Another unit of the same kind is converted, and the reader's lines go as they came.
  await page.locator('.disclose', {hasText: 'BoomStroke'}).click();
  await page.getByRole('button', {name: 'Plot Boom stroke'}).click();
  await page.locator('.chooser-list button', {hasText: 'Own plot 1'}).click();
  await until('two lines', async () => (await labels(page, 'own1')).length === 2);
  for (let k = 2; k > 0; --k) await plot(page, 'own1').locator('.take-out').first().click();
  await plot(page, 'own1').waitFor({state: 'detached'});
  await plot(page, 'error').locator('.take-out').click();
  await until('it is out again', async () => (await labels(page, 'error')).length === before.length);
  clean(page);
}

/// The way of the teeth, and the error over it, as the simulation had them.
async function over_each_other() {
  const said = [];
  for (const name of ['dig', 'grade']) {
    const page = await report(name);
    await plot(page, 'xy_error').scrollIntoViewIfNeeded();
    const drawn = await until('they are drawn', async () => {
      const found = await page.locator('.xy-host svg').evaluateAll((nodes) => nodes.map((node) => ({
        words: [...node.querySelectorAll('text')].map((text) => text.textContent),
        longest: Math.max(...[...node.querySelectorAll('g path')].map((path) => path.getAttribute('d').length)),
      })));
      return found.length > 0 && found;
    });
    const words = drawn.flatMap(({words: own}) => own);
    assert.ok(words.includes('error, measured') && words.includes('distance, m'), words.join());
    assert.ok(words.includes('true error'), words.join());
    assert.ok(drawn.every(({longest}) => longest > 1000), JSON.stringify(drawn.map(({longest}) => longest)));
    await plot(page, 'xy_path').scrollIntoViewIfNeeded();
    const path = await until('the path is drawn', async () =>
      (await plot(page, 'xy_path').locator('text').allTextContents()).join());
    assert.match(path, name === 'dig' ? /path,measured tip,true tip/ : /design,measured edge/);
    // It is of the window: half of it is another drawing.
    const shape = () => plot(page, 'xy_path').locator('svg').innerHTML();
    const whole = await shape();
    await page.locator('[data-plot="lambda"]').focus();
    await page.keyboard.press('+');
    await page.keyboard.press('+');
    await plot(page, 'xy_path').scrollIntoViewIfNeeded();
    await until('it follows the window', async () => (await shape()) !== whole);
    const [download] = await Promise.all([page.waitForEvent('download'),
      plot(page, 'xy_error').getByRole('button', {name: /as CSV/}).click()]);
    const lines = readFileSync(await download.path(), 'utf8').trim().split('\n');
    assert.ok(lines.length > 300 && lines[0].includes('distance, m'), lines[0]);
    // What was measured and what the simulation knows are of one size, in one unit.
    const heads = lines[0].match(/"[^"]*"|[^,]+/g);
    const column = (label) => heads.findIndex((head) => head.includes(label) && head.includes('mm'));
    const middle = (label) => lines.slice(1).map((line) => line.split(',')[column(label)])
      .filter((value) => value !== '').map((value) => Math.abs(Number(value))).sort((a, b) => a - b).at(200);
    const [measured, real] = [middle('error, measured'), middle('true error')];
    assert.ok(measured < 20 && real < 20, `${measured} and ${real} mm`);
    said.push(`${name} ${lines.length} points, ${measured} and ${real} mm`);
    clean(page);
    await page.context().close();
  }
  return said.join(', ');
}

/// A bookmark comes back with the address, by its name, and leads to its moment.
async function bookmarks() {
  const page = await report();
  await page.keyboard.press('End');
  await page.keyboard.press('b');
  const {now: end} = await look(page);
  await page.keyboard.press('Home');
  await page.getByRole('button', {name: 'Mark this moment'}).click();
  const names = page.locator('.bookmarks input');
  await until('both are there', async () => await names.count() === 2);
  await names.last().fill('the end, & all');
  await names.last().press('Tab');
  await until('the address has it', () => page.evaluate(() => location.hash.includes('the+end')));
  const again = await open_page(browser, page.url());
  await all_there(again);
  assert.deepEqual(await again.locator('.bookmarks input').evaluateAll((all) => all.map(({value}) => value)),
    ['', 'the end, & all']);
  await again.locator('.bookmarks .jump').last().click();
  await until('it is shown', async () => Math.abs((await look(again)).now - end) < 0.01);
  await again.locator('.bookmarks').getByRole('button', {name: 'Remove'}).first().click();
  await until('one is left', async () => await again.locator('.bookmarks li').count() === 1);
  // Writing a name is no command to the page.
  const {now} = await look(again);
  await again.locator('.bookmarks input').fill('n p b l 0 .');
  await again.locator('.bookmarks input').press('.');
  assert.equal((await look(again)).now, now);
  await until('one is left', async () => await again.locator('.bookmarks li').count() === 1);
  clean(page);
  clean(again);
}

/// An address opens the moment and the window that it tells, of a report, a log and the operator's view.
async function links() {
  const page = await report('dig', '#t=7.25&w=6,9');
  const opened = await until('the moment', async () => {
    const seen = await look(page);
    return Math.abs(seen.now - 7.25) < 1e-6 && seen;
  });
  assert.equal((await look(page)).now, opened.now, 'it stands');
  const hash = await page.evaluate(() => location.hash);
  assert.equal(hash, '#t=7.25&w=6,9');
  await page.keyboard.press('.');
  await until('the address goes with it', () => page.evaluate((old) => location.hash !== old, hash));
  assert.match(await page.evaluate(() => location.hash), /^#t=7\.2[5-7]\d*&w=6,9$/);
  await page.evaluate(() => { location.hash = '#t=3'; });
  await until('another address is followed', async () => Math.abs((await look(page)).now - 3) < 1e-6);
  for (const bad of ['#t=nonsense', '#t=', '#panel', '#t=1e99&w=5']) {
    const other = await report('dig', bad);
    clean(other);
    await other.context().close();
  }
  clean(page);
  const server = await serve(graben, ['scope', '--port', '0', '--log', join(out, 'dig.log')]);
  const log = await open_page(browser, `${server.url}#t=4.5`);
  await all_there(log);
  await until('the moment of the log', async () => Math.abs((await look(log)).now - 4.5) < 0.01);
  const link = log.getByRole('link', {name: "Operator's view"});
  assert.equal(await link.getAttribute('href'), 'operator');
  clean(log);
  await server.stop();
}

/// A link to a moment of a live run opens that moment, however much of it came before the page did.
async function live_links() {
  const server = await serve(graben, ['scope', '--port', '0', '--sim', 'dig']);
  const page = await open_page(browser, server.url);
  await page.waitForFunction(() => window.grabenScope?.mode() === 'Active');
  await page.locator('#sim-pace').selectOption('10');
  await until('there is a past', async () => (await look(page)).now > 25);
  // Ten minutes are kept: at ten times real time a slow machine would lose the moment.
  await page.locator('#sim-pace').selectOption('1');
  await page.getByRole('button', {name: 'Pause', exact: true}).click();
  await page.keyboard.press(',');
  const {now} = await look(page);
  // The pause has written its own moment there: the step's comes with the next picture.
  const told = () => Number(new URLSearchParams(new URL(page.url()).hash.slice(1)).get('t') ?? NaN);
  const url = await until('the address has it', async () => Math.abs(told() - now) < 0.001 && page.url());
  for (let k = 0; k < 3; ++k) {
    const other = await open_page(browser, url);
    await until('its past has come', async () => (await look(other).catch(() => ({frames: 0}))).frames > 8000);
    await until('it stands', async () => Math.abs((await look(other)).now - now) < 0.001);
    await rest(700);
    assert.ok(Math.abs((await look(other)).now - now) < 0.001, 'it went on');
    assert.equal(new URL(other.url()).hash.replace(/&w=[^&]*/, ''), new URL(url).hash.replace(/&w=[^&]*/, ''));
    clean(other);
    await other.context().close();
  }
  // Another moment is not shown in the place of one that is gone.
  const gone = await open_page(browser, url.replace(/#t=[^&]*/, '#t=-50'));
  await gone.getByText('not in what is kept').waitFor();
  assert.ok(await gone.evaluate(() => document.querySelector('.replay .live').hidden), 'it is not live');
  clean(gone);
  clean(page);
  await server.stop();
  return url.replace(/.*#/, '#');
}

/// What is saved is what is shown: as many points as the window has frames, with their values.
async function saved() {
  const page = await report('dig', '#t=8&w=6,10');
  await until('it is there', async () => Math.abs((await look(page)).now - 8) < 1e-6);
  const take = async (kind, name = 'error') => {
    await plot(page, name).scrollIntoViewIfNeeded();
    const [download] = await Promise.all([page.waitForEvent('download'),
      plot(page, name).getByRole('button', {name: new RegExp(`as ${kind}$`)}).click()]);
    return {name: download.suggestedFilename(), bytes: readFileSync(await download.path())};
  };
  const csv = await take('CSV');
  assert.equal(csv.name, 'path_error.csv');
  const [head, ...rows] = csv.bytes.toString().trim().split('\n');
  assert.match(head, /^"time, s","Path error, mm"/);
  const measured = rows.map((row) => row.split(',')).filter(([, value]) => value !== '');
  assert.ok(measured.length >= 198 && measured.length <= 202, `${measured.length} frames in 4 s`);
  assert.ok(measured.every(([time]) => Number(time) >= 6 && Number(time) <= 10));
  const now = await page.evaluate(() => window.grabenScope.values('EcuHydraulics').PathError);
  const at = measured.filter(([time]) => Number(time) <= 8).at(-1);
  assert.ok(Math.abs(Number(at[1]) - now) < 1e-6, `${at} is not ${now}`);
  const svg = await take('SVG', 'lambda');
  const text = svg.bytes.toString();
  assert.match(text, /^<svg xmlns/);
  assert.ok(text.includes('Lambda and what holds it') && text.includes('>lambda<') && !text.includes('NaN'));
  const seen = await page.evaluate((content) => {
    const drawing = new DOMParser().parseFromString(content, 'image/svg+xml');
    return {broken: drawing.querySelector('parsererror') !== null, bands: drawing.querySelectorAll('rect').length};
  }, text);
  assert.ok(!seen.broken && seen.bands > 2, JSON.stringify(seen));
  // The strip's key goes with it, and no share is below nothing.
  const shares = await page.locator('.strip-key li').allInnerTexts();
  assert.ok(shares.length > 0 && shares.every((share) => text.includes(`>${share.trim()}<`)), `${shares} in ${text}`);
  assert.ok(!/>[-−–]0\.\d+</.test(text), 'a mark below 0');
  assert.match((await take('SVG', 'xy_path')).bytes.toString(), />Path and tip</);
  const png = await take('PNG', 'spools');
  assert.equal(png.bytes.subarray(0, 8).toString('latin1'), '\x89PNG\r\n\x1a\n');
  assert.deepEqual([png.bytes.readUInt32BE(16), png.bytes.readUInt32BE(20)], [1800, 720]);
  assert.ok(png.bytes.length > 10_000, `${png.bytes.length} bytes`);
  clean(page);
  return `${measured.length} frames, ${text.length} B of SVG, ${png.bytes.length} B of PNG`;
}

/// The button over the error leads to where it was greatest, as the log has it.
async function worst_error() {
  const page = await report();
  const press = plot(page, 'error').locator('.greatest');
  const [, size, at] = /^Greatest: ([\d.]+) mm at 0:([\d.]+)$/.exec(await until('it is told', async () =>
    await press.isVisible() && press.innerText()));
  await press.click();
  const {now} = await look(page);
  assert.ok(Math.abs(now - Number(at)) < 0.006, `${now} s, told ${at}`);
  const {PathError} = await page.evaluate(() => window.grabenScope.values('EcuHydraulics'));
  assert.ok(Math.abs(PathError - Number(size)) < 0.06, `${PathError} mm, told ${size}`);
  // As `graben compare` has it, from the log alone.
  const log = join(out, 'dig.log');
  const said = execFileSync(graben, ['compare', log, log, '--out', join(out, 'same')], {encoding: 'utf8'});
  const most = Number(/path error, largest +([\d.]+)/.exec(said)[1]);
  assert.ok(Math.abs(most - Number(size)) < 0.06, `${most} and ${size} mm`);
  clean(page);
  return `${size} mm at ${at} s`;
}

async function axe_clean() {
  const found = [];
  let looks = 0;
  for (const [colorScheme, sizes] of looks_at_each(SIZES)) {
    const context = await browser.newContext({reducedMotion: 'reduce', colorScheme, bypassCSP: true});
    const page = await context.newPage();
    await page.goto(url_of('dig', '#t=8&b=3&b=8 here'));
    await page.waitForFunction(() => window.grabenScope?.loaded() === 1);
    await page.locator('.disclose', {hasText: 'EcuStatus'}).click();
    await page.getByRole('button', {name: 'Plot Cycle time'}).click();
    found.push(...(await axe(page)).map((words) => `chooser ${colorScheme}: ${words}`));
    await page.getByRole('button', {name: 'A new plot'}).click();
    for (const [width, height] of sizes) {
      await page.setViewportSize({width, height});
      await page.locator('.xy-plots').scrollIntoViewIfNeeded();
      await until('x-y plots are drawn', async () => (await page.locator('.xy-host svg').count()) > 0);
      found.push(...(await axe(page)).map((words) => `${width} ${colorScheme}: ${words}`));
      await page.screenshot({path: join(out, `closer_${colorScheme}_${width}.png`)});
      looks += 1;
    }
    await context.close();
  }
  assert.deepEqual(found, [], found.join('\n'));
  return `${looks} looks`;
}

const scenarios = {any_signal, over_each_other, bookmarks, links, live_links, saved, worst_error, axe_clean};
const failed = await run_scenarios(join(out, 'failed'), browser, only === undefined ? scenarios
  : {[only]: scenarios[only]});
await browser.close();
console.log(`scope: ${failed} scenarios failed`);
process.exit(failed > 0 ? 1 : 0);
