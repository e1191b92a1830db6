// SPDX-License-Identifier: Apache-2.0
/// A browser, servers of the scope, and how a test reads the page. Everything that is started here
/// ends with the test.

import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {existsSync, mkdirSync} from 'node:fs';
import {join} from 'node:path';
import {chromium} from 'playwright-core';

const BROWSERS = ['/usr/bin/chromium', '/usr/bin/chromium-browser'];
/// WebGL by the processor, where there is no graphics card; a container's root has no sandbox.
const BROWSER_OPTIONS = ['--no-sandbox', '--enable-unsafe-swiftshader'];
/// A starved machine is slow, not wrong.
const PATIENCE_MS = 120_000;
/// What ctest takes for a test that could not be tried.
const SKIPPED = 77;

/// Of a page's own script, so that a picture is drawn so many times a second at most: without a graphics card
/// each takes as long as anything that is tried here.
function draw_seldom(pictures_ps) {
  const next = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (draw) => setTimeout(() => next(draw), 1000 / pictures_ps);
  window.cancelAnimationFrame = clearTimeout.bind(window);
}

/// The browser, or the end of the process: skipped aloud, and failed where CI=true. `pictures_ps` is how often a page
/// may draw in a second; Infinity: as the screen does.
export async function open_browser({pictures_ps = 10} = {}) {
  const executablePath = BROWSERS.find(existsSync);
  if (executablePath === undefined) {
    console.log('scope: no Chromium here (Debian: chromium); the page is NOT driven');
    process.exit(process.env.CI === 'true' ? 1 : SKIPPED);
  }
  const browser = await chromium.launch({executablePath, args: BROWSER_OPTIONS});
  const new_context = browser.newContext.bind(browser);
  browser.newContext = async (...options) => {
    const context = await new_context(...options);
    context.setDefaultTimeout(PATIENCE_MS);
    if (pictures_ps < Infinity) await context.addInitScript(draw_seldom, pictures_ps);
    return context;
  };
  return browser;
}

const started = new Set();
process.on('exit', () => started.forEach((child) => child.kill('SIGKILL')));

/// Runs `program` until it says where it listens.
export async function serve(program, options) {
  const child = spawn(program, options, {stdio: ['ignore', 'pipe', 'pipe']});
  started.add(child);
  let said = '';
  let errors = '';
  child.stderr.on('data', (data) => {
    errors += data;
  });
  const ended = new Promise((done) => child.on('exit', (code) => {
    started.delete(child);
    done(code);
  }));
  const url = await new Promise((done, fail) => {
    child.stdout.on('data', (data) => {
      said += data;
      const found = /http:\/\/\S+/.exec(said);
      if (found) done(found[0]);
    });
    ended.then((code) => fail(new Error(`${program} ${options.join(' ')} ended with ${code}: `
      + `${said}${errors}`)));
  });
  return {
    url, pid: child.pid, errors: () => errors,
    async stop() {
      child.kill('SIGTERM');
      return ended;
    },
  };
}

/// A page that complains of what it should not do: errors, and requests to anywhere else.
export async function open_page(browser, url, size = {width: 1400, height: 900}) {
  const context = await browser.newContext({viewport: size, reducedMotion: 'reduce'});
  const page = await context.newPage();
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(`error: ${error.message}`));
  page.on('console', (line) => {
    if (line.type() === 'error') page.problems.push(`console: ${line.text()}`);
  });
  const allowed = new URL(url).protocol === 'file:' ? 'file:' : new URL(url).origin;
  page.on('request', (request) => {
    const to = request.url();
    if (!to.startsWith(allowed) && !/^(data|blob):/.test(to)) {
      page.problems.push(`request to ${to}`);
    }
  });
  await page.goto(url);
  return page;
}

/// A desk, a tablet, a phone's two sides.
export const SIZES = [[1400, 900], [1024, 768], [844, 390], [390, 844]];

/// Whether what is in the middle of a node can be pressed there, without scrolling.
export const pressable = (page, name) => page.getByRole('button', {name, exact: true}).first().evaluate((node) => {
  const box = node.getBoundingClientRect();
  const at = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
  return box.width >= 40 && box.height >= 28 && (at === node || node.contains(at));
});

/// What window.grabenScope says, all of one moment.
export function look(page) {
  return page.evaluate(() => {
    const scope = window.grabenScope;
    return {tip: scope.tip(), screen: scope.tipOnScreen(), now: scope.now(), mode: scope.mode(),
      frames: scope.frames(), held: scope.heldFrames(), loaded: scope.loaded(), fps: scope.fps()};
  });
}

/// Until so many more frames have come, however slow the machine is.
export async function more_frames(page, count) {
  const {frames} = await look(page);
  await page.waitForFunction((wanted) => window.grabenScope.frames() >= wanted, frames + count,
    {timeout: 3 * PATIENCE_MS});
}

export function distance(a, b) {
  return Math.hypot(...a.map((value, i) => value - b[i]));
}

/// Until `holds` gives something true, which is returned.
export async function until(what, holds, patience_ms = PATIENCE_MS) {
  const begin = Date.now();
  for (;;) {
    const found = await holds();
    if (found) return found;
    if (Date.now() - begin > patience_ms) throw new Error(`not within ${patience_ms} ms: ${what}`);
    await new Promise((done) => setTimeout(done, 50));
  }
}

/// Until a report's log is read to its end.
export const all_there = (page) => until('the log is whole', async () => {
  const seen = await look(page);
  return seen.frames > 1000 && seen.loaded === 1;
});

/// A page of its own for each size, judged once it is ready; it may complain of nothing.
export async function at_each_size(browser, url, ready, judge) {
  for (const [width, height] of SIZES) {
    const page = await open_page(browser, url, {width, height});
    await ready(page);
    await judge(page, `${width} x ${height}`, {width, height});
    assert.deepEqual(page.problems, []);
    await page.context().close();
  }
}

export const rest = (ms) => new Promise((done) => setTimeout(done, ms));

/// Each scenario by its name; a red one does not hide the next and leaves a picture.
export async function run_scenarios(out, browser, scenarios) {
  mkdirSync(out, {recursive: true});
  let failed = 0;
  for (const [name, scenario] of Object.entries(scenarios)) {
    const began = Date.now();
    try {
      const words = await scenario();
      console.log(`ok   ${name}: ${words ?? ''} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
    } catch (error) {
      failed += 1;
      console.log(`FAIL ${name}: ${error.stack}`);
      for (const [i, page] of browser.contexts().flatMap((c) => c.pages()).entries()) {
        const file = join(out, `${name}_${i}.png`);
        await page.screenshot({path: file}).then(() => console.log(`     ${file}`), () => {});
      }
    }
    for (const context of browser.contexts()) await context.close();
  }
  return failed;
}
