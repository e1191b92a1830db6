// SPDX-License-Identifier: Apache-2.0
/// The operator's view: operator.mjs OUT GRABEN [SCENARIO]. What it shows is true, large enough, and
/// old when it is old; it draws 30 pictures a second, which --thorough judges; it has nothing to press and says nothing.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {axe, looks_at_each} from './axe.mjs';
import {open_browser, open_page, rest, run_scenarios, serve, SIZES, until} from './harness.mjs';
import {tap} from './tap.mjs';

const [out, graben, only] = process.argv.slice(2);
const PICTURES = process.env.GRABEN_LOOKS === 'every' ? 30 : 3;
const browser = await open_browser({pictures_ps: Infinity});
mkdirSync(out, {recursive: true});
for (const command of ['dig', 'grade', 'autodig']) {
  execFileSync(graben, [command, '--out', out], {stdio: 'ignore'});
}

const scope = (...options) => serve(graben, ['scope', '--port', '0', ...options]);
const view = (server) => new URL('operator', server.url).href;
const clean = (page) => assert.deepEqual(page.problems, []);
const seen = (page) => page.evaluate(() => {
  const view = window.grabenOperator;
  const text = (what) => document.querySelector(what).textContent;
  return {now: view.now(), mode: view.mode(), frames: view.frames(), off_m: view.off_m(), fps: view.fps(),
    digits: text('.digits'), word: text('.cut-word'), state: text('.state-word'), more: text('.state-more'),
    lambda: text('.lambda p'), missing: text('.checklist')};
});
const active = (page) => page.waitForFunction(() => window.grabenOperator?.mode() === 'Active'
  && document.querySelector('.state-word').textContent === 'Active');

/// Every key, a click everywhere, and some seconds of frames: nothing but its two requests leaves it.
async function it_never_sends() {
  const server = await scope('--sim', 'dig');
  const wire = await tap(server.url);
  const page = await open_page(browser, view(wire), {width: 1024, height: 768});
  await active(page);
  for (const key of [' ', 'Enter', 'Tab', '.', 'p', 'n', 'l', '?', '+', '0', 'Escape', 'ArrowLeft']) {
    await page.keyboard.press(key);
  }
  for (let x = 20; x < 1024; x += 120) {
    for (let y = 20; y < 768; y += 120) await page.mouse.click(x, y);
  }
  const {frames} = await seen(page);
  await page.waitForFunction((wanted) => window.grabenOperator.frames() > wanted, frames + 5000);
  const words = wire.said.filter((said) => said !== 'frame pong');
  assert.deepEqual(words, ['GET /operator', 'socket /frames']);
  const pressable = await page.evaluate(() => document.querySelectorAll(
    'a, button, input, select, textarea, form, [tabindex], [onclick], [contenteditable]').length);
  assert.equal(pressable, 0, 'there is something to press');
  assert.equal((await seen(page)).mode, 'Active');
  clean(page);
  await page.context().close();
  // The same wire hears the scope's page speak.
  const other = await open_page(browser, wire.url);
  await other.waitForFunction(() => window.grabenScope?.mode() === 'Active');
  await other.locator('.replay .stop').click();
  await until('the stop is heard', () => wire.said.includes('frame text'));
  wire.close();
  await server.stop();
}

/// A connection of its kind that speaks is closed, and the machine goes on.
async function server_refuses_it() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, view(server));
  await active(page);
  const say = (protocol, patience_ms) => page.evaluate(([told, wait_ms]) => new Promise((done) => {
    const socket = new WebSocket(new URL('frames', location.href).href.replace('http', 'ws'), told);
    socket.onopen = () => socket.send('{"do":"stop"}');
    socket.onclose = (event) => done(event.code);
    setTimeout(() => done(0), wait_ms);
  }), [protocol, patience_ms]);
  assert.equal(await say('graben-look', 30_000), 1008, 'it is not closed with a word');
  await rest(500);
  assert.equal((await seen(page)).mode, 'Active', 'a page that only looks stopped the machine');
  // The same words of a page that may speak stop it.
  assert.equal(await say('graben-scope', 2000), 0);
  await page.waitForFunction(() => window.grabenOperator.mode() !== 'Active');
  clean(page);
  await server.stop();
}

/// The digits are what the controller itself has as its error, and the bar agrees.
async function digits_are_true() {
  const server = await scope('--log', join(out, 'grade.log'));
  const page = await open_page(browser, view(server));
  await active(page);
  const pairs = [];
  await until('it has graded', async () => {
    const pair = await page.evaluate(() => {
      const grabbed = window.grabenOperator;
      return [grabbed.off_m(), grabbed.value('EcuGrade.GradeError'), grabbed.mode()];
    });
    if (pair[0] !== null && pair[1] !== null && pair[2] === 'Active') pairs.push(pair);
    return pairs.length >= 60;
  });
  const worst = Math.max(...pairs.map(([off, told]) => Math.abs(1000 * off - told)));
  assert.ok(worst < 3, `${worst} mm from what the controller says`);
  assert.ok(pairs.some(([, told]) => Math.abs(told) > 1), 'the error never was one');
  clean(page);
  await server.stop();
  const dig = await scope('--log', join(out, 'dig.log'));
  const digger = await open_page(browser, view(dig));
  await active(digger);
  const dug = [];
  await until('it has dug', async () => {
    const pair = await digger.evaluate(() => [window.grabenOperator.off_m(),
      window.grabenOperator.value('EcuHydraulics.PathError'), window.grabenOperator.mode()]);
    if (pair[0] !== null && pair[1] !== null && pair[2] === 'Active') dug.push(pair);
    return dug.length >= 60;
  });
  // On the way to the path a cycle is some millimetres.
  const off = dug.map(([found, told]) => Math.abs(Math.abs(1000 * found) - told)).sort((a, b) => a - b)[45];
  assert.ok(off < 3, `${off} mm from what the controller says`);
  clean(digger);
  await dig.stop();
  return `within ${worst.toFixed(1)} mm of the grade error, ${off.toFixed(1)} mm of the path error`;
}

/// Pictures in each of nine seconds, sorted; once more where others held the processor for most of them.
async function median_second(page) {
  for (let attempt = 1; ; ++attempt) {
    const rates = [];
    while (rates.length < 9) {
      await rest(1000);
      rates.push((await seen(page)).fps);
    }
    rates.sort((a, b) => a - b);
    if (rates[4] >= PICTURES || attempt === 3) return rates;
  }
}

/// A log and a live machine of either kind, on the largest screen: pictures in the median second, a tenth where others may be at work.
async function pictures_a_second() {
  const said = [];
  const sources = [['--sim', 'dig'], ['--sim', 'grade'], ['--sim', 'autodig'],
    ...['dig', 'grade', 'autodig'].map((name) => ['--log', join(out, `${name}.log`)])];
  for (const source of sources) {
    const server = await scope(...source);
    const page = await open_page(browser, view(server));
    await active(page);
    const rates = await median_second(page);
    said.push(`${source.join(' ').replace(out, '').replace('/', '')} ${rates[4]} (${rates[0]} to ${rates[8]})`);
    assert.ok(rates[4] >= PICTURES, `${source.join(' ')}: ${rates} pictures a second`);
    // They are pictures of other moments.
    const before = await seen(page);
    await rest(300);
    assert.ok((await seen(page)).now > before.now, source.join(' '));
    clean(page);
    await page.context().close();
    await server.stop();
  }
  return `pictures a second, median (least to most): ${said.join(', ')}`;
}

/// Digits as high as a third of the screen, upright as wide as it, and all of it in sight.
async function large_enough() {
  const server = await scope('--sim', 'autodig', '--task', 'trench');
  const said = [];
  for (const [width, height] of SIZES) {
    const page = await open_page(browser, view(server), {width, height});
    await active(page);
    await page.waitForFunction(() => /^\d/.test(document.querySelector('.digits').textContent));
    await rest(300);
    const shown = await page.evaluate(() => {
      const digits = document.querySelector('.digits');
      const style = getComputedStyle(digits);
      const pen = document.createElement('canvas').getContext('2d');
      pen.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
      const ink = pen.measureText('0');
      const box = (what) => {
        const {left, right, top, bottom} = document.querySelector(what).getBoundingClientRect();
        return {left, right, top, bottom, width: right - left, height: bottom - top};
      };
      return {high: ink.actualBoundingBoxAscent + ink.actualBoundingBoxDescent,
        wide: parseFloat(getComputedStyle(document.getElementById('app')).getPropertyValue('--digits-wide')), digits: box('.digits'), lights: box('.light-bar'),
        section: box('.section'), plan: box('.plan'), lambda: box('.lambda p'), state: box('.state-word'),
        held: document.querySelector('.held').scrollWidth, across: document.documentElement.scrollWidth,
        down: document.documentElement.scrollHeight};
    });
    const size = `${width} x ${height}`;
    if (width > height) {
      assert.ok(shown.high > 0.32 * height && shown.high < 0.36 * height, `${size}: ${shown.high} px high`);
    } else {
      assert.ok(shown.wide > 0.75 * width, `${size}: ${shown.wide} px wide`);
    }
    assert.ok(shown.across <= width && shown.down <= height, `${size}: does not fit`);
    assert.ok(shown.digits.left >= 0 && shown.digits.left + shown.wide <= shown.lights.right, `${size}: digits`);
    for (const part of ['lights', 'section', 'plan', 'lambda', 'state']) {
      const {left, right, top, bottom, height: high} = shown[part];
      assert.ok(left >= 0 && right <= width + 1 && top >= 0 && bottom <= height + 1 && high > 15,
        `${size}: ${part} ${JSON.stringify(shown[part])}`);
    }
    assert.ok(shown.section.height >= 0.2 * height && shown.plan.height >= 0.15 * height, `${size}: pictures`);
    said.push(`${size}: ${Math.round(shown.high)}`);
    await page.screenshot({path: join(out, `operator_${width}.png`)});
    clean(page);
    await page.context().close();
  }
  await server.stop();
  return `digits, px high: ${said.join(', ')}`;
}

/// What is not of now is not shown as if it were.
async function old_is_called_old() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, view(server));
  await active(page);
  await page.waitForFunction(() => /^\d/.test(document.querySelector('.digits').textContent));
  await server.stop();
  await page.waitForFunction(() => document.querySelector('.state-word').textContent === 'No server');
  await page.waitForFunction(() => document.querySelector('.digits').textContent === '–');
  const gone = await seen(page);
  assert.equal(gone.off_m, null);
  assert.match(gone.lambda, /^–/);
  await page.context().close();
  // A log whose strokes end early: the machine is drawn grey, and there is no digit.
  const lines = readFileSync(join(out, 'dig.log'), 'utf8').split('\n');
  const cut = lines.filter((line) => !line.includes(' 0CFF2080#') || Number(line.slice(1, 18)) < 4);
  writeFileSync(join(out, 'cut.log'), cut.join('\n'));
  const log = await scope('--log', join(out, 'cut.log'));
  const other = await open_page(browser, `${view(log)}#t=6`);
  await until('it is beyond', async () => (await seen(other).catch(() => ({now: 0}))).now > 6);
  await rest(400);
  const cut_short = await seen(other);
  assert.equal(cut_short.off_m, null, 'a digit without a boom');
  assert.equal(cut_short.digits, '–');
  clean(other);
  await log.stop();
}

/// The word, the fault and what is missing, as the controller has them.
async function states() {
  const server = await scope('--sim', 'dig');
  const scope_page = await open_page(browser, server.url);
  const page = await open_page(browser, view(server));
  await active(page);
  assert.match((await seen(page)).missing, /Nothing is missing/);
  await scope_page.waitForFunction(() => window.grabenScope?.mode() === 'Active');
  await scope_page.locator('[data-fault="stroke-silent"]').click();
  const stopped = await until('the fault is shown', async () => {
    const now = await seen(page);
    return /^Fault \d+$/.test(now.state) && /before it can arm/.test(now.missing) && now;
  });
  assert.ok(stopped.more.length > 10 && stopped.missing.length > 30, JSON.stringify(stopped));
  assert.equal(await page.locator('.state').getAttribute('data-mode'), 'Fault');
  clean(page);
  await server.stop();
  return `${stopped.state}: ${stopped.more}`;
}

const MORE_SIZES = [...SIZES, [1280, 800], [800, 1280], [600, 960]];

/// Where the words of each of these are, to the end of their last letter, and where they may be.
const words_in = (page, selectors) => page.evaluate((all) => all.flatMap((selector) =>
  [...document.querySelectorAll(selector)].filter((node) => node.innerText !== '').map((node) => {
    const range = document.createRange();
    range.selectNodeContents(node);
    const {left, right, top, bottom} = range.getBoundingClientRect();
    return {selector, words: node.innerText, left, right, top, bottom};
  })), selectors);

/// All of them whole in their part of the screen, which nothing else covers.
async function assert_in_sight(page, size, selectors) {
  const {width, height} = page.viewportSize();
  const room = await page.evaluate(() => {
    const of = (what) => document.querySelector(what).getBoundingClientRect();
    return {lights: of('.light-bar').left, bar: of('.lambda').top, band: of('.state').bottom};
  });
  for (const {selector, words, left, right, top, bottom} of await words_in(page, selectors)) {
    const most = selector === '.cut-word' ? room.lights : width;
    const low = selector.startsWith('.checklist') ? room.bar : selector.startsWith('.state') ? room.band : height;
    assert.ok(left >= 0 && right <= most && top >= 0 && bottom <= low,
      `${size}: '${words}' is from ${left} to ${right} of ${most}, ${top} to ${bottom} of ${low} px`);
  }
}

/// With a fault there is most to say: every line of it is whole, and the digits are as high as ever.
async function all_that_is_missing() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, view(server));
  const other = await open_page(browser, server.url);
  await active(page);
  await other.locator('[data-fault="stroke-silent"]').click();
  await page.waitForFunction(() => document.querySelectorAll('.checklist li').length >= 4);
  const said = [];
  for (const [width, height] of MORE_SIZES) {
    await page.setViewportSize({width, height});
    await rest(400);
    await assert_in_sight(page, `${width} x ${height}`, ['.checklist h2', '.checklist li', '.state p', '.lambda p']);
    const [digits_px, letters_px] = await page.evaluate(() => [
      parseFloat(getComputedStyle(document.getElementById('app')).getPropertyValue('--digits-high')),
      parseFloat(getComputedStyle(document.querySelector('.checklist li')).fontSize)]);
    assert.ok(width < height || digits_px > 0.32 * height, `${width}: digits ${digits_px} px high`);
    assert.ok(letters_px >= 12, `${width}: letters of ${letters_px} px`);
    said.push(`${width} x ${height}: ${letters_px.toFixed(0)} px`);
    await page.screenshot({path: join(out, `missing_${width}.png`)});
  }
  clean(page);
  await server.stop();
  return said.join(', ');
}

/// The longest word beside the digits, at a dig's begin: beside the lights, not under them.
async function words_are_whole() {
  const server = await scope('--log', join(out, 'dig.log'));
  for (const [width, height] of MORE_SIZES) {
    const page = await open_page(browser, `${view(server)}#t=0.7`, {width, height});
    await page.waitForFunction(() => /Outside path/.test(document.querySelector('.cut-word').textContent));
    await assert_in_sight(page, `${width} x ${height}`, ['.cut-word', '.lambda p', '.state p']);
    await page.screenshot({path: join(out, `outside_${width}.png`)});
    clean(page);
    await page.context().close();
  }
  await server.stop();
}

/// A log and a simulation are called so, whole and in sight: no machine does now what they show.
async function not_live_is_told() {
  for (const [source, told] of [[['--log', join(out, 'dig.log')], 'Replay'], [['--sim', 'dig'], 'Simulation']]) {
    const server = await scope(...source);
    for (const [width, height] of SIZES) {
      const page = await open_page(browser, view(server), {width, height});
      await active(page);
      const found = await page.evaluate(() => {
        const node = document.querySelector('.not-live b');
        const {x, y, width: wide, height: high} = node.getBoundingClientRect();
        return {words: node.textContent, seen: node.contains(document.elementFromPoint(x + wide / 2, y + high / 2)),
          cut: node.scrollWidth > node.clientWidth + 1, high: parseFloat(getComputedStyle(node).fontSize)};
      });
      assert.equal(found.words, told);
      assert.ok(found.seen && !found.cut && found.high >= 12, `${told} ${width}: ${JSON.stringify(found)}`);
      await assert_in_sight(page, `${told} ${width}`, ['.state p', '.not-live b']);
      await page.screenshot({path: join(out, `${told}_${width}.png`)});
      clean(page);
      await page.context().close();
    }
    await server.stop();
  }
}

async function axe_clean() {
  const found = [];
  let looks = 0;
  for (const source of [['--sim', 'grade'], ['--sim', 'autodig']]) {
    const server = await scope(...source);
    for (const [colorScheme, sizes] of looks_at_each(SIZES)) {
      const context = await browser.newContext({colorScheme, bypassCSP: true});
      const page = await context.newPage();
      await page.goto(view(server));
      await active(page);
      for (const [width, height] of sizes) {
        await page.setViewportSize({width, height});
        await rest(300);
        found.push(...(await axe(page)).map((words) => `${source[1]} ${width} ${colorScheme}: ${words}`));
        await page.screenshot({path: join(out, `${source[1]}_${colorScheme}_${width}.png`)});
        ++looks;
      }
      await context.close();
    }
    await server.stop();
  }
  // With a fault, and with what is old greyed.
  for (const [colorScheme, sizes] of looks_at_each(SIZES)) {
    const server = await scope('--sim', 'dig');
    const other = await open_page(browser, server.url);
    const context = await browser.newContext({colorScheme, bypassCSP: true});
    const page = await context.newPage();
    await page.goto(view(server));
    await active(page);
    await other.locator('[data-fault="stroke-silent"]').click();
    const shows = (words) => page.waitForFunction((begin) =>
      document.querySelector('.state-word').textContent.startsWith(begin), words);
    for (const state of ['Fault', 'No server']) {
      if (state === 'No server') await server.stop();
      await shows(state);
      for (const [width, height] of sizes) {
        await page.setViewportSize({width, height});
        await rest(300);
        found.push(...(await axe(page)).map((words) => `${state} ${width} ${colorScheme}: ${words}`));
        await page.screenshot({path: join(out, `${state.replace(' ', '_')}_${colorScheme}_${width}.png`)});
        ++looks;
      }
    }
    await context.close();
    await other.context().close();
  }
  assert.deepEqual(found, [], found.join('\n'));
  return `${looks} looks`;
}

const scenarios = {it_never_sends, server_refuses_it, digits_are_true, pictures_a_second, large_enough,
  old_is_called_old, states, all_that_is_missing, words_are_whole, not_live_is_told, axe_clean};
const failed = await run_scenarios(join(out, 'failed'), browser, only === undefined ? scenarios
  : {[only]: scenarios[only]});
await browser.close();
console.log(`scope: ${failed} scenarios failed`);
process.exit(failed > 0 ? 1 : 0);
