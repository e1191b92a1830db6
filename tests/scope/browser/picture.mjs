// SPDX-License-Identifier: Apache-2.0
/// The README's picture: picture.mjs GRABEN OUT.png. A simulated dig, some seconds after its start.

import {rename} from 'node:fs/promises';
import {open_browser, open_page, rest, serve} from './harness.mjs';

const [graben, file] = process.argv.slice(2);
const SHOWN_S = 33;

const browser = await open_browser();
const server = await serve(graben, ['scope', '--sim', 'dig', '--port', '0']);
const page = await open_page(browser, server.url, {width: 1440, height: 900});
await page.waitForFunction(() => window.grabenScope?.mode() === 'Active');
// The same moment in every picture, and long enough for one without haste.
await page.waitForFunction((at_s) => window.grabenScope.now() > at_s, SHOWN_S, {timeout: 120_000});
await page.keyboard.press('Space');
await rest(1500);
await page.screenshot({path: `${file}.part.png`});
await rename(`${file}.part.png`, file);
await browser.close();
await server.stop();
