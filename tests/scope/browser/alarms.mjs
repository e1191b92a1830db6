// SPDX-License-Identifier: Apache-2.0
/// Pages that have something to complain of: alarms.mjs OUT GRABEN [SCENARIO]. axe-core finds nothing in
/// an alarm, a notice, what the tour ends in.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {axe, looks_at_each} from './axe.mjs';
import {open_browser, rest, run_scenarios, serve, SIZES} from './harness.mjs';

const [out, graben, only] = process.argv.slice(2);
const browser = await open_browser();
mkdirSync(out, {recursive: true});
const SHORT = [SIZES[0], SIZES.at(-1)];

/// Both themes; `prepare` brings about what has to be looked at.
async function looks_at(name, url, sizes, prepare) {
  const found = [];
  for (const [colorScheme, shown] of looks_at_each(sizes)) {
    const context = await browser.newContext({reducedMotion: 'reduce', colorScheme, bypassCSP: true});
    const page = await context.newPage();
    await page.goto(url);
    await prepare(page);
    for (const [width, height] of shown) {
      await page.setViewportSize({width, height});
      await rest(200);
      assert.ok(await page.locator('.alarms [data-alarm]').count() > 0, `${name}: no alarm to look at`);
      found.push(...(await axe(page)).map((words) => `${name} ${width} ${colorScheme}: ${words}`));
      await page.screenshot({path: join(out, `${name}_${colorScheme}_${width}.png`)});
    }
    const back = page.getByRole('button', {name: /Take all faults back/});
    if (await back.isVisible()) await back.click();
    await context.close();
  }
  return found;
}

const judge = (found) => assert.deepEqual(found, [], found.join('\n'));
const active = (page) => page.waitForFunction(() => window.grabenScope?.mode() === 'Active');

async function faulty(page) {
  await active(page);
  const silent = '[data-fault="stroke-silent"]';
  await page.locator(await page.locator(silent).count() > 0 ? silent : '[data-fault$="silent"]').first().click();
  await page.locator('[data-alarm="fault"]').waitFor();
}

async function faults() {
  const found = [];
  for (const [task, sizes] of [['dig', SIZES], ['autodig', SHORT], ['grade', SHORT]]) {
    const server = await serve(graben, ['scope', '--port', '0', '--sim', task]);
    found.push(...await looks_at(task, server.url, sizes, faulty));
    await server.stop();
  }
  judge(found);
}

/// Of the first EcuStatus that says Active and held by a fence, s from the log's first frame.
function held_by_a_fence(log) {
  const lines = readFileSync(log, 'utf8').split('\n');
  const time_s = (line) => Number(line.slice(1, line.indexOf(')')));
  return time_s(lines.find((line) => line.includes(' 18FF3182#63'))) - time_s(lines[0]);
}

/// A trench's report has notices of its fence.
async function notices_of_a_report() {
  execFileSync(graben, ['autodig', '--task', 'trench', '--out', out], {stdio: 'ignore'});
  const at_s = held_by_a_fence(join(out, 'autodig.log')) + 0.001;
  const report = `${pathToFileURL(join(out, 'autodig.html')).href}#t=${at_s.toFixed(4)}`;
  judge(await looks_at('trench', report, SHORT, (page) => page.locator('[data-alarm="fence"]').waitFor()));
}

async function end_of_the_tour() {
  const server = await serve(graben, ['scope', '--port', '0', '--sim', 'dig']);
  judge(await looks_at('tour', server.url, SHORT, async (page) => {
    await active(page);
    await page.getByRole('button', {name: /^Help/}).click();
    await page.getByRole('button', {name: /tour/i}).click();
    const next = page.getByRole('button', {name: 'Next', exact: true});
    // It goes on by itself too, perhaps between a look and the press.
    let pressed = 0;
    for (let n = 0; n < 10 && await next.isVisible(); ++n) {
      await next.click({timeout: 1000}).then(() => ++pressed, () => {});
    }
    assert.ok(pressed > 0, 'Next can never be pressed');
    await page.getByText(/The controller stopped by itself/).waitFor();
  }));
  await server.stop();
}

const scenarios = {faults, notices_of_a_report, end_of_the_tour};
const failed = await run_scenarios(join(out, 'failed'), browser, only === undefined ? scenarios
  : {[only]: scenarios[only]});
await browser.close();
console.log(`scope: ${failed} scenarios failed`);
process.exit(failed > 0 ? 1 : 0);
