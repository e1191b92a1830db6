// SPDX-License-Identifier: Apache-2.0
/// The README's pictures: picture.mjs GRABEN OUT.png [operator | FOLDER near | FOLDER holds]. A simulated dig, some
/// seconds after its start; the operator's view while a trench is dug; or of a new operator's walk, by what
/// hil_first_metre has left in that folder.

import {readFileSync} from 'node:fs';
import {rename} from 'node:fs/promises';
import {join} from 'node:path';
import {open_browser, open_page, rest, serve} from './harness.mjs';

const [graben, file, which = 'scope', moment] = process.argv.slice(2);
const SHOWN_S = 33;

async function scope(browser) {
  const server = await serve(graben, ['scope', '--sim', 'dig', '--port', '0']);
  const page = await open_page(browser, server.url, {width: 1440, height: 900});
  await page.waitForFunction(() => window.grabenScope?.mode() === 'Active');
  // The same moment in every picture, and long enough for one without haste.
  await page.waitForFunction((at_s) => window.grabenScope.now() > at_s, SHOWN_S, {timeout: 120_000});
  await page.keyboard.press('Space');
  await rest(1500);
  return {server, page};
}

async function operator(browser) {
  const server = await serve(graben, ['scope', '--sim', 'autodig', '--task', 'trench', '--port', '0']);
  const page = await open_page(browser, new URL('operator', server.url).href, {width: 1280, height: 800});
  await page.waitForFunction(() => window.grabenOperator?.now() > 20
    && /^\d{3}$/.test(document.querySelector('.digits').textContent), null, {timeout: 240_000});
  return {server, page};
}

/// Seconds after a mark of the walk's hand (tests/hil/first_metre.pad), and what the band says then.
const WALK = {near: {mark: 4, after_s: -2.2, says: /Assist is ready/}, holds: {mark: 4, after_s: 2.5, says: /Assist holds/}};

async function walk(browser) {
  if (!WALK[moment]) throw new Error(`'${moment}' is no moment of the walk; wanted: ${Object.keys(WALK).join(', ')}`);
  const {mark, after_s, says} = WALK[moment];
  const log = join(which, 'vcan0.log');
  const lines = readFileSync(log, 'latin1').split('\n');
  const time_s = (line) => Number(/^\((\d+\.\d+)\)/.exec(line)?.[1]);
  const marked = lines.find((line) => line.includes(` 7F0#0${mark}`));
  if (!marked) throw new Error(`${log}: no mark ${mark}`);
  const at_s = time_s(marked) - time_s(lines[0]) + after_s;
  const server = await serve(graben, ['scope', '--port', '0', '--log', log, '--task', join(which, 'first_metre.toml')]);
  const page = await open_page(browser, `${new URL('operator', server.url).href}#t=${at_s.toFixed(2)}`,
    {width: 1280, height: 800});
  await page.waitForFunction((words) => new RegExp(words).test(document.querySelector('.state-more').textContent),
    says.source);
  // A replay goes on: what is in the picture is asked for again, once it is taken.
  return {server, page, says: says.source};
}

const browser = await open_browser({pictures_ps: Infinity});
const {server, page, says} = await (which === 'operator' ? operator : which === 'scope' ? scope : walk)(browser);
await page.screenshot({path: `${file}.part.png`});
if (says && !new RegExp(says).test(await page.locator('.state-more').textContent())) {
  throw new Error(`the moment is over: the band no longer says ${says}`);
}
await rename(`${file}.part.png`, file);
await browser.close();
await server.stop();
