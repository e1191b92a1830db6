// SPDX-License-Identifier: Apache-2.0
/// What a person sees first, of a report, a plan, a simulation: first_sight.mjs OUT GRABEN [SCENARIO].

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {look, open_browser, open_page, pressable, rest, run_scenarios, serve, SIZES, until} from './harness.mjs';

const [out, graben, only] = process.argv.slice(2);
const browser = await open_browser();
mkdirSync(out, {recursive: true});
for (const command of ['dig', 'grade', 'autodig', 'plan']) {
  execFileSync(graben, [command, '--out', out], {stdio: 'ignore'});
}

const scope = (...options) => serve(graben, ['scope', '--port', '0', ...options]);
const clean = (page) => assert.deepEqual(page.problems, []);
const url_of = (name) => pathToFileURL(join(out, `${name}.html`)).href;
const active = (page) => page.waitForFunction(() => window.grabenScope?.mode() === 'Active');

/// Opened as by somebody who has not asked for less motion.
async function open_moving(url, size = {width: 1400, height: 900}) {
  const context = await browser.newContext({viewport: size, reducedMotion: 'no-preference'});
  const page = await context.newPage();
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(`error: ${error.message}`));
  page.on('console', (words) => {
    if (words.type() === 'error') page.problems.push(`console: ${words.text()}`);
  });
  await page.goto(url);
  return page;
}

/// The first moment of the next `span_s` of a report at rest, s, at which a limit of the machine holds lambda. Looked for
/// with the slider: a page that plays on a slow machine leaves pictures out.
const held_from = (page, span_s) => page.evaluate(async (most_s) => {
  const slider = document.querySelector('input.scrub');
  const next = () => new Promise((done) => requestAnimationFrame(done));
  const from_s = window.grabenScope.now();
  for (let at_s = from_s; at_s < from_s + most_s; at_s += 0.1) {
    slider.value = String(at_s);
    slider.dispatchEvent(new Event('input', {bubbles: true}));
    await next();
    await next();
    if (document.querySelector('.reason').textContent.startsWith('Held by ')) return window.grabenScope.now();
  }
  return null;
}, span_s);

/// A healthy run: no fault anywhere, at what it has to tell, in motion.
async function first_sight() {
  const said = [];
  for (const name of ['dig', 'grade', 'autodig']) {
    const page = await open_moving(url_of(name));
    const seen = await until('it plays', async () => {
      const now = await look(page).catch(() => null);
      return now !== null && now.loaded === 1 && now.mode === 'Active' && now.now > 1 && now;
    });
    await until('it goes on', async () => (await look(page)).now > seen.now + 0.3);
    assert.equal(await page.locator('[data-alarm]').count(), 0, `${name}: an alarm`);
    assert.match(await page.locator('#faults').innerText(), /No fault so far/, name);
    said.push(`${name} at ${seen.now.toFixed(1)} s`);
    clean(page);
    await page.context().close();
  }
  // Whoever wants no motion gets the moment, at rest; within some seconds of it a limit holds lambda.
  for (const name of ['dig', 'grade', 'autodig']) {
    const still = await open_page(browser, url_of(name));
    const {now} = await until('the moment is shown', async () => {
      const seen = await look(still);
      return seen.loaded === 1 && seen.now > 0 && seen;
    });
    await rest(600);
    assert.equal((await look(still)).now, now);
    assert.ok(await pressable(still, 'Play'));
    const held_s = await held_from(still, 5);
    assert.ok(held_s !== null, `${name}: nothing holds lambda within 5 s of ${now} s`);
    said.push(`${name} held at ${held_s.toFixed(1)} s`);
    await still.context().close();
  }
  return said.join(', ');
}

/// The plan's page draws the plan: its line, its poses, its limits.
async function plan_draws_itself() {
  const page = await open_moving(url_of('plan'));
  await until('the plan moves', async () => (await look(page).catch(() => ({now: 0}))).now > 0.5);
  const setup = JSON.parse(/id="graben-setup">(.*?)<\/script/s.exec(readFileSync(join(out, 'plan.html'), 'utf8'))[1]);
  const [task] = setup.machines[0].tasks;
  const [{from, to}] = task.steps;
  assert.deepEqual(task.steps.length, 1);
  assert.deepEqual(setup.run.way[0].map((v) => v.toFixed(3)), from.position_m.map((v) => v.toFixed(3)));
  assert.deepEqual(setup.run.way.at(-1).map((v) => v.toFixed(3)), to.position_m.map((v) => v.toFixed(3)));
  const key = await page.locator('.scene-key').innerText();
  assert.match(key, /planned line, poses of the bucket along it/);
  assert.match(key, /pose at its end/);
  assert.doesNotMatch(key, /wanted path|field/);
  // A plan has no cylinder's pressure and no field, nor anything to show or hide them with.
  assert.doesNotMatch(await page.locator('.scene-corner').innerText(), /pressure|old or not available/);
  assert.equal(await page.locator('[data-layer="field"]').isVisible(), false, 'a button for no field');
  // The teeth are on the line that is drawn.
  const {tip} = await look(page);
  const along = to.position_m.map((v, i) => v - from.position_m[i]);
  const off = tip.map((v, i) => v - from.position_m[i]);
  const share = along.reduce((sum, v, i) => sum + v * off[i], 0) / along.reduce((sum, v) => sum + v * v, 0);
  const beside = Math.hypot(...off.map((v, i) => v - share * along[i]));
  assert.ok(beside < 0.01 && share >= 0 && share <= 1, `${beside} m beside the line`);
  const legends = await page.locator('.plot').evaluateAll((plots) => plots.map((plot) => plot.innerText));
  for (const what of ['Velocity of the cylinders', 'Velocity of the swing', 'Acceleration of the cylinders']) {
    assert.ok(legends.some((words) => words.includes(what) && words.includes(', limit')), what);
  }
  assert.ok(legends.some((words) => words.includes('deg/s')), 'the swing is not in degrees');
  clean(page);
  return `teeth ${(beside * 1000).toFixed(1)} mm beside the line`;
}

/// Whether one of those that a selector finds is whole on the screen, and nothing over it.
const on_screen = (page, selector) => page.locator(selector).evaluateAll((nodes) => nodes.some((node) => {
  const {x, y, width, height} = node.getBoundingClientRect();
  const at = document.elementFromPoint(x + width / 2, y + height / 2);
  return width > 0 && x >= 0 && y >= 0 && x + width <= innerWidth && y + height <= innerHeight
    && (at === node || node.contains(at));
}));

/// What the controller does and how fast is on the first screen, of a phone as well.
async function first_screen() {
  const server = await scope('--sim', 'dig');
  for (const [width, height] of SIZES) {
    const page = await open_page(browser, server.url, {width, height});
    await active(page);
    await rest(300);
    for (const what of ['.mode, .now-mode', '.figure, .now-lambda']) {
      assert.ok(await on_screen(page, what), `${width} x ${height}: no ${what} on the first screen`);
    }
    await page.screenshot({path: join(out, `first_screen_${width}.png`)});
    clean(page);
    await page.context().close();
  }
  await server.stop();
}

/// On a narrow page keys and scale stand below the picture, and what is written in it ends with it.
async function keys_beside_the_machine() {
  const said = [];
  for (const [width, height] of [[768, 1024], [390, 844]]) {
    const page = await open_page(browser, url_of('dig'), {width, height});
    await page.locator('.scene-corner').waitFor();
    await rest(300);
    const [host, picture, words, corner] = await Promise.all(['', ' canvas', ' .scene-labels', ' .scene-corner']
      .map((name) => page.locator(`.scene-host${name}`).boundingBox()));
    const end = (box) => box.y + box.height;
    const all = `${width}: ${JSON.stringify({host, picture, words, corner})}`;
    assert.ok(corner.y >= end(picture) - 0.5 && end(corner) <= end(host) + 0.5 && picture.height >= 200, all);
    assert.ok(end(words) <= end(picture) + 0.5, all);
    said.push(`${width}: ${Math.round(picture.height)} px`);
    clean(page);
    await page.context().close();
  }
  return said.join(', ');
}

/// A film has the machine, its mode and its lambda at every size, and nothing to press.
async function film() {
  const server = await scope('--log', join(out, 'dig.log'));
  const pressed = /^(Play|Pause|Step|Fault before|Next fault|Open|PNG|SVG|CSV|Mark|Copy|Reset|Help|Dark|Light|Path$|Ghost)/;
  for (const [width, height] of [[1280, 720], [640, 360], [320, 320]]) {
    const size = `${width} x ${height}`;
    const page = await open_page(browser, `${server.url}?film`, {width, height});
    await page.waitForFunction(() => window.grabenFilm?.state() === 'ready');
    await page.evaluate(() => window.grabenFilm.show(10));
    await rest(300);
    await page.screenshot({path: join(out, `film_${width}.png`)});
    const names = await page.locator('button:visible, select:visible, a:visible').evaluateAll((all) =>
      all.map((node) => node.innerText));
    assert.deepEqual(names.filter((name) => pressed.test(name)), [], size);
    const scene = await page.locator('.scene-host').boundingBox();
    assert.ok(scene.y >= 0 && scene.y + scene.height <= height && scene.height >= 0.4 * height,
      `${size}: the scene is ${JSON.stringify(scene)}`);
    const {screen: [x, y]} = await look(page);
    assert.ok(x > 0 && x < scene.width && y > 0 && y < scene.height, `${size}: the teeth are at ${x}, ${y}`);
    for (const what of ['.mode, .now-mode', '.figure, .now-lambda']) {
      assert.ok(await on_screen(page, what), `${size}: no ${what}`);
    }
    clean(page);
    await page.context().close();
  }
  await server.stop();
}

/// Once, some twenty seconds, to a fault and what became of it.
async function tour() {
  const server = await scope('--sim', 'dig');
  const page = await open_moving(server.url);
  await page.locator('.tour').waitFor();
  // No sooner by the clock, no later by the simulation's: a starved machine is slower than real time.
  const began = Date.now();
  const began_s = (await look(page)).now;
  await page.waitForFunction(() => window.grabenScope.mode() === 'Fault');
  await page.getByText(/The controller stopped by itself: fault 1/).waitFor();
  const took_s = (await look(page)).now - began_s;
  assert.ok(Date.now() - began > 8000 && took_s < 25, `the fault comes after ${took_s} s`);
  for (const [width, height] of SIZES) {
    await page.setViewportSize({width, height});
    await rest(200);
    assert.ok(await pressable(page, 'Take the fault back'), `${width} x ${height}`);
    assert.ok(await pressable(page, 'Stop machine'), `${width} x ${height}: the tour is over Stop`);
  }
  await page.getByRole('button', {name: 'Take the fault back'}).click();
  await active(page);
  assert.equal(await page.locator('.tour').isVisible(), false);
  await page.reload();
  await active(page);
  await rest(1500);
  assert.equal(await page.locator('.tour').isVisible(), false, 'it comes a second time');
  clean(page);
  await server.stop();
  return `fault after ${took_s.toFixed(1)} s`;
}

const scenarios = {first_sight, plan_draws_itself, first_screen, keys_beside_the_machine, film, tour};
const failed = await run_scenarios(join(out, 'failed'), browser, only === undefined ? scenarios
  : {[only]: scenarios[only]});
await browser.close();
console.log(`scope: ${failed} scenarios failed`);
process.exit(failed > 0 ? 1 : 0);
