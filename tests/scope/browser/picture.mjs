// SPDX-License-Identifier: Apache-2.0
/// The README's pictures: picture.mjs GRABEN OUT.png [operator]. A simulated dig, some seconds after
/// its start; or the operator's view while a trench is dug.

import {rename} from 'node:fs/promises';
import {open_browser, open_page, rest, serve} from './harness.mjs';

const [graben, file, which = 'scope'] = process.argv.slice(2);
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

const browser = await open_browser({pictures_ps: Infinity});
const {server, page} = await (which === 'operator' ? operator : scope)(browser);
await page.screenshot({path: `${file}.part.png`});
await rename(`${file}.part.png`, file);
await browser.close();
await server.stop();
