// SPDX-License-Identifier: Apache-2.0
/// The page as people have it on three screens and a phone's two sides: people.mjs OUT GRABEN [SCENARIO]. What is
/// pressed most is in reach, words stand on a ground of their own, what is shown is true, nothing
/// that axe-core knows of is violated, in both themes.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {axe, looks_at_each} from './axe.mjs';
import {
  all_there, at_each_size, look, more_frames, open_browser, open_page, pressable, rest, run_scenarios, serve, SIZES,
  until,
} from './harness.mjs';

const [out, graben, only] = process.argv.slice(2);
const REPORTS = ['dig', 'grade', 'autodig', 'plan', 'check', 'compare', 'identify'];
/// Reports without a scene.
const FLAT = ['check', 'identify'];

const browser = await open_browser();
mkdirSync(out, {recursive: true});
for (const command of [['dig'], ['grade'], ['autodig'], ['plan'], ['check', 'excavator_22t']]) {
  execFileSync(graben, [...command, '--out', out], {stdio: 'ignore'});
}
const own_log = join(out, 'dig.log');
execFileSync(graben, ['compare', own_log, own_log, '--out', out], {stdio: 'ignore'});
// Of a machine that is as its profile says there is nothing to be found, and identify refuses.
execFileSync(graben, ['dig', '--found', 'exponent=1.7', '--loops', '2', '--soil', 'sand', '--out', join(out, 'another')], {stdio: 'ignore'});
execFileSync(graben, ['identify', '--log', join(out, 'another', 'dig.log'), '--profile', 'excavator_22t', '--force', '--out', join(out, 'better.toml'), '--report', join(out, 'identify.html')], {stdio: 'ignore'});

const scope = (...options) => serve(graben, ['scope', '--port', '0', ...options]);
const clean = (page) => assert.deepEqual(page.problems, []);
const url_of = (name) => pathToFileURL(join(out, `${name}.html`)).href;
const active = (page) => page.waitForFunction(() => window.grabenScope?.mode() === 'Active');

/// Play and Stop, not under the toolbar, and not a long way down.
async function in_reach() {
  const server = await scope('--sim', 'dig');
  await at_each_size(browser, server.url, active, async (page, size) => {
    assert.ok(await pressable(page, 'Pause'), `${size}: Pause cannot be pressed`);
    assert.ok(await pressable(page, 'Stop machine'), `${size}: Stop cannot be pressed`);
    // Paused it has most of them, and all are in sight.
    await page.getByRole('button', {name: 'Pause', exact: true}).click();
    await page.locator('.replay .live').waitFor();
    const bar = page.locator('.replay-buttons').locator('button:visible, select:visible');
    const names = await bar.evaluateAll((nodes) => nodes.map((node) => {
      const {x, y, width, height} = node.getBoundingClientRect();
      const at = document.elementFromPoint(x + width / 2, y + height / 2);
      const whole = x >= 0 && x + width <= innerWidth && y + height <= innerHeight && width >= 28 && height >= 28;
      return [node.getAttribute('aria-label') ?? node.innerText, whole && (at === node || node.contains(at))];
    }));
    assert.equal(names.length, 8, `${size}: ${names}`);
    for (const [name, seen] of names) assert.ok(seen, `${size}: ${name} is not in sight`);
    await page.getByRole('button', {name: 'Back to live'}).click();
    const over = await page.evaluate(() => {
      const bar = document.querySelector('.layers').getBoundingClientRect();
      const replay = document.querySelector('.replay').getBoundingClientRect();
      const across = document.documentElement.scrollWidth - innerWidth;
      return {layers: bar.bottom - replay.top, across};
    });
    assert.ok(over.layers <= 0 || size.startsWith('390'), `${size}: the layers are over the replay bar`);
    assert.ok(over.across <= 0, `${size}: the page is ${over.across} px too wide`);
    await page.getByRole('button', {name: 'Stop machine'}).click();
    await page.getByRole('button', {name: 'Start machine'}).click();
    await page.getByRole('button', {name: 'Stop machine'}).waitFor();
  });
  await server.stop();
  return SIZES.map((size) => size.join(' x ')).join(', ');
}

async function scene_is_large_enough() {
  const heights = [];
  await at_each_size(browser, url_of('dig'), all_there,
    async (page, size, {height}) => {
      const box = await page.locator('.scene-host').boundingBox();
      heights.push(`${size}: ${Math.round(box.height)}`);
      assert.ok(box.height >= Math.min(300, 0.5 * height), `${size}: the scene is ${box.height} px high`);
    });
  return heights.join(', ');
}

/// Key and scale have a ground that keeps 4.5 to 1 whatever the machine is behind them.
async function legend_has_a_ground() {
  await at_each_size(browser, url_of('dig'), all_there,
    async (page, size) => {
      const alphas = await page.locator('.scene-corner > *').evaluateAll((nodes) => nodes.map((node) => {
        const found = /\/ ([0-9.]+)\)|rgba\(.*, ([0-9.]+)\)/.exec(getComputedStyle(node).backgroundColor);
        return Number(found?.[1] ?? found?.[2] ?? 1);
      }));
      assert.equal(alphas.length, 2, size);
      assert.ok(alphas.every((alpha) => alpha >= 0.8), `${size}: ${alphas}`);
    });
}

/// Two lists of one name would be taken for one.
async function names_are_told_apart() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, server.url);
  await active(page);
  const names = await until('what can be injected has come', async () => {
    const shown = await page.locator('h2, h3').allInnerTexts();
    return shown.includes('Faults to inject') && shown;
  });
  assert.equal(new Set(names).size, names.length, names.join(', '));
  assert.ok(names.includes('Faults so far'), names.join(', '));
  clean(page);
  await server.stop();
}

/// The strip's key and the run's table say the same, in the same colours.
async function shares_of_one_window() {
  const page = await open_page(browser, url_of('dig'));
  await all_there(page);
  const read = () => page.evaluate(() => {
    const rgb = (node, what) => getComputedStyle(node)[what];
    return {
      strip: [...document.querySelectorAll('.strip-key li')].map((node) =>
        [node.innerText.trim(), rgb(node.firstChild, 'backgroundColor')].join(' ')),
      table: [...document.querySelectorAll('.shares tr')].map((row) =>
        [`${row.children[0].innerText} ${row.children[1].innerText}`,
          rgb(row.querySelector('.bar'), 'backgroundColor')].join(' ')),
    };
  });
  const whole = await until('shares are shown', async () => {
    const found = await read();
    return found.strip.length > 2 && found.table.length > 2 && found;
  });
  assert.deepEqual(whole.strip, whole.table);
  const plot = page.locator('[data-plot="lambda"]');
  await plot.focus();
  for (let k = 0; k < 4; ++k) await page.keyboard.press('+');
  const zoomed = await until('the window is another', async () => {
    const found = await read();
    return found.table.join() !== whole.table.join() && found.strip.join() === found.table.join() && found;
  });
  clean(page);
  return `${whole.table.length} limits, zoomed ${zoomed.table.length}`;
}

/// Loaded again, or opened later, a live page has what was.
async function history_is_kept() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, server.url);
  await active(page);
  await more_frames(page, 8000);
  const before = await look(page);
  await page.reload();
  const from = await until('all is there again', async () => {
    const seen = await look(page).catch(() => null);
    return seen !== null && seen.frames >= before.frames && seen;
  });
  const late = await open_page(browser, server.url);
  await until('so has one that comes late', async () => (await look(late)).frames >= before.frames);
  await late.getByRole('button', {name: 'Pause', exact: true}).click();
  await late.keyboard.press('Home');
  // One key is enough, whatever still comes in.
  await more_frames(late, 500);
  const {now, tip} = await look(late);
  assert.ok(now < 1, `its beginning was asked for, ${now} s is shown`);
  assert.ok(tip !== null);
  clean(late);
  await server.stop();
  return `${before.frames} frames before, ${from.frames} after, from ${now} s on`;
}

/// Without its server the clock stands, and what is shown is called old.
async function server_gone() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, server.url);
  await active(page);
  await more_frames(page, 2000);
  await server.stop();
  await page.locator('[data-alarm="link"]').waitFor();
  const {now} = await look(page);
  await rest(1500);
  assert.equal((await look(page)).now, now, 'the clock goes on without a server');
  assert.ok(await page.locator('#state').evaluate((node) => node.classList.contains('stale')));
  const fresh = await page.locator('tr.message:not(.stale)').count();
  assert.equal(fresh, 0, `${fresh} messages are shown as if they came`);
  assert.equal(await page.locator('[data-alarm="quiet"]').count(), 0);
}

/// How often a page that is held up calls the bus silent, and how fast the simulation went meanwhile, over real time.
async function said_silent() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, server.url);
  await active(page);
  await more_frames(page, 1000);
  await page.evaluate(() => {
    window.saidSilent = 0;
    new MutationObserver(() => {
      window.saidSilent += document.querySelectorAll(
        '[data-alarm="quiet"], #state.stale').length;
    }).observe(document.body, {subtree: true, childList: true, attributes: true});
  });
  const began = {at_ms: Date.now(), now: (await look(page)).now};
  for (let k = 0; k < 3; ++k) {
    await page.evaluate(() => { for (const end = performance.now() + 2500; performance.now() < end;); });
    await rest(300);
  }
  const said = await page.evaluate(() => window.saidSilent);
  const pace = 1000 * ((await look(page)).now - began.now) / (Date.now() - began.at_ms);
  clean(page);
  await server.stop();
  await page.context().close();
  return {said, pace};
}

/// A page that is held up does not call the bus silent. On a starved machine the simulation behind it is held up
/// too and the bus is silent indeed: such a try does not count.
async function own_lateness() {
  let tried = await said_silent();
  for (let n = 0; tried.said > 0 && tried.pace < 0.9 && n < 4; ++n) tried = await said_silent();
  if (tried.said > 0 && tried.pace < 0.9) return `NOT judged: the simulation goes at ${tried.pace} of real time`;
  assert.equal(tried.said, 0, `its own lateness is called silence, at ${tried.pace} of real time`);
}

/// The first Tab, and Enter: the panel is in sight and has the focus.
async function skip_link() {
  await at_each_size(browser, url_of('dig'), all_there,
    async (page, size) => {
      await page.keyboard.press('Tab');
      const link = page.locator('.skip');
      const seen = await link.evaluate((node) => {
        const box = node.getBoundingClientRect();
        return document.activeElement === node && box.left >= 0 && box.top >= 0
          && document.elementFromPoint(box.x + 5, box.y + 5) === node;
      });
      assert.ok(seen, `${size}: the skip link is not seen`);
      await page.keyboard.press('Enter');
      const there = await page.evaluate(() => {
        const panel = document.getElementById('panel');
        const box = panel.getBoundingClientRect();
        return {focus: document.activeElement === panel, top: box.top, height: innerHeight};
      });
      assert.ok(there.focus && there.top >= -2 && there.top < 0.8 * there.height, `${size}: ${JSON.stringify(there)}`);
    });
}

/// Paper has the scene, the figures and every plot, and no button.
async function print() {
  const page = await open_page(browser, url_of('dig'));
  await all_there(page);
  await page.emulateMedia({media: 'print'});
  await until('plots are drawn', () => page.evaluate(() =>
    [...document.querySelectorAll('.plot')].filter((node) => node.getClientRects().length > 0).length >= 8));
  const shown = await page.evaluate(() => {
    const seen = (node) => node.getClientRects().length > 0;
    return {
      buttons: [...document.querySelectorAll('button')].filter((node) => seen(node)
        && !node.closest('.legend, .fault-row, table, .faults')).map((node) => node.textContent),
      plots: [...document.querySelectorAll('.plot')].filter(seen).length,
      scene: document.querySelector('.scene').getBoundingClientRect().height,
      wide: document.documentElement.scrollWidth - innerWidth,
    };
  });
  assert.deepEqual(shown.buttons, []);
  assert.ok(shown.plots >= 8 && shown.scene > 250 && shown.wide <= 0, JSON.stringify(shown));
  const pdf = await page.pdf({format: 'A4', path: join(out, 'dig.pdf')});
  const pages = pdf.toString('latin1').match(/\/Type\s*\/Page\b/g)?.length ?? 0;
  assert.ok(pages >= 2 && pages <= 6, `${pages} sheets`);
  clean(page);
  return `${pages} sheets, ${shown.plots} plots`;
}

/// A log with more faults than a list can have: the button leads back to the first.
async function fault_before() {
  const log = readFileSync(join(out, 'dig.log'), 'utf8').split('\n').filter((line) => line !== '');
  const lines = [];
  const id = '18FF3182';  // EcuStatus
  assert.ok(log.some((line) => line.includes(` ${id}#`)));
  // An hour in little: a fault comes and goes four times a second.
  for (let k = 0; k < 1500; ++k) {
    const at = (time) => `(${(30 + time).toFixed(6).padStart(17, '0')}) vcan0 ${id}#`;
    lines.push(`${at(k / 4)}0500000015000000`, `${at(k / 4 + 0.1)}0300000000000000`);
  }
  writeFileSync(join(out, 'many.log'), [...log, ...lines, ''].join('\n'));
  const server = await scope('--log', join(out, 'many.log'));
  const page = await open_page(browser, server.url);
  await all_there(page);
  const end = await until('its end is shown', async () => {
    await page.keyboard.press('End');
    const {now} = await look(page);
    return now > 300 && now;
  });
  for (let k = 0; k < 400; ++k) await page.keyboard.press('p');
  // A fault is a quarter of a second; one key in a hundred or so is lost where they come as fast as this.
  const {now} = await look(page);
  assert.ok(Math.abs(end - now - 100) < 5, `400 faults before ${end} s is ${now} s`);
  await server.stop();
  return `from ${end.toFixed(1)} to ${now.toFixed(1)} s`;
}

/// What plots write on their axes: minutes and seconds, and bar beside every MPa.
async function axes_have_units() {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}, reducedMotion: 'reduce'});
  const page = await context.newPage();
  await page.addInitScript(() => {
    const write = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function fillText(words, ...where) {
      (this.canvas.saidWords ??= new Set()).add(String(words));
      return write.call(this, words, ...where);
    };
  });
  const found = new Map();
  for (const name of ['dig', 'grade', 'autodig']) {
    await page.goto(url_of(name));
    await all_there(page);
    await page.waitForFunction(() => document.querySelectorAll('.plot:has([data-plot])').length >= 8);
    for (const plot of await page.locator('.plot:has([data-plot])').all()) {
      await plot.scrollIntoViewIfNeeded();
      const [title, unit] = await plot.evaluate((node) => [node.querySelector('h3').firstChild.textContent,
        node.querySelector('h3 .unit').textContent.replace(/^, /, '')]);
      const written = await until(`${name}: ${title} has a unit of time`, async () => {
        const words = await plot.evaluate((node) =>
          [...node.querySelectorAll('canvas')].flatMap((canvas) => [...canvas.saidWords ?? []]));
        return words.includes('time, min:s') && words;
      });
      found.set(`${name}: ${title}`, {unit, written});
    }
  }
  for (const [plot, {unit, written}] of found) {
    assert.equal(written.includes('bar'), unit === 'MPa', `${plot}, ${unit}: ${written}`);
  }
  const units = [...found.values()].map(({unit}) => unit);
  for (const unit of ['MPa', 'km/h']) assert.ok(units.includes(unit), `${unit}: ${units}`);
  assert.ok(units.some((unit) => /^(deg|°)\/s$/.test(unit)), `deg/s: ${units}`);
  await context.close();
  return `${found.size} plots`;
}

async function notices() {
  for (const name of ['dig', 'plan']) {
    const page = await open_page(browser, url_of(name));
    await page.getByRole('button', {name: /^Help/}).click();
    await page.locator('.notices summary').click();
    const words = await page.locator('.notices').innerText();
    for (const owner of ['three.js authors', 'Leon Sorokin', 'bit-dream', 'Permission is hereby granted',
      'Apache-2.0']) {
      assert.ok(words.includes(owner), `${name}: ${owner}`);
    }
    clean(page);
    await page.context().close();
  }
}

/// Every kind of page, at each size and in each theme that is looked at, and the help that is over it.
async function axe_clean() {
  const server = await scope('--sim', 'dig');
  const log = await scope('--log', own_log);
  const found = [];
  let looks = 0;
  const pages = [['sim', server.url], ['log', log.url], ['film', `${log.url}?film`], ...REPORTS.map((name) => [name, url_of(name)])];
  for (const [name, url] of pages) {
    for (const [colorScheme, sizes] of looks_at_each(SIZES)) {
      const context = await browser.newContext({reducedMotion: 'reduce', colorScheme, bypassCSP: true});
      const page = await context.newPage();
      await page.goto(url);
      if (!FLAT.includes(name)) await page.waitForFunction(() => window.grabenScope?.tip() != null);
      for (const [width, height] of sizes) {
        await page.setViewportSize({width, height});
        await rest(200);
        found.push(...(await axe(page)).map((words) => `${name} ${width} ${colorScheme}: ${words}`));
        const across = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        if (across > 0) found.push(`${name} ${width}: ${across} px too wide`);
        const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        const bright = Number(/\d+/.exec(ground)[0]) > 127;
        if (bright !== (colorScheme === 'light')) found.push(`${name} ${colorScheme}: its ground is ${ground}`);
        ++looks;
      }
      if (name === 'sim') {
        await page.keyboard.press('?');
        found.push(...(await axe(page)).map((words) => `help ${colorScheme}: ${words}`));
        ++looks;
        await page.getByRole('button', {name: /tour/i}).click();
        await page.locator('.tour').waitFor();
        for (const [width, height] of sizes) {
          await page.setViewportSize({width, height});
          found.push(...(await axe(page)).map((words) => `tour ${width} ${colorScheme}: ${words}`));
          ++looks;
        }
      }
      await context.close();
    }
  }
  assert.deepEqual(found, [], found.join('\n'));
  await server.stop();
  await log.stop();
  return `${looks} looks`;
}

const scenarios = {in_reach, scene_is_large_enough, legend_has_a_ground, names_are_told_apart, shares_of_one_window,
  history_is_kept, server_gone, own_lateness, skip_link, print, fault_before, axes_have_units,
  notices, axe_clean};
const failed = await run_scenarios(join(out, 'failed'), browser, only === undefined ? scenarios
  : {[only]: scenarios[only]});
await browser.close();
console.log(`scope: ${failed} scenarios failed`);
process.exit(failed > 0 ? 1 : 0);
