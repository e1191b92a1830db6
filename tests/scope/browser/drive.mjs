// SPDX-License-Identifier: Apache-2.0
/// The scope as a user has it: drive.mjs OUT RUN GRABEN [--blind]. RUN is the script `run`, GRABEN the
/// tool; what is left of a failure is in OUT. With --blind the page gets a log without the boom's
/// strokes from 1 s on, whose machine must be found to stand elsewhere.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {appendFileSync, mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {connect} from 'node:net';
import {dirname, join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {distance, look, more_frames, open_browser, open_page, rest, run_scenarios, serve, until} from
  './harness.mjs';

const [out, run, graben, blind] = process.argv.slice(2);
const here = join(dirname(run), 'tests', 'scope', 'browser');
const CENTIMETRE = 0.01;
const LINE_BYTES = 48;  ///< Of a candump line, at most.

const browser = await open_browser();
mkdirSync(out, {recursive: true});
execFileSync(graben, ['dig', '--out', out], {stdio: 'ignore'});
execFileSync(graben, ['grade', '--out', out], {stdio: 'ignore'});
execFileSync(graben, ['autodig', '--out', out], {stdio: 'ignore'});
execFileSync(graben, ['plan', '--profile', 'excavator_12t', '--out', out], {stdio: 'ignore'});
const log = readFileSync(join(out, 'dig.log'), 'utf8');

const scope = (...options) => serve(graben, ['scope', '--port', '0', ...options]);
const alarm = (page, id) => page.locator(`[data-alarm="${id}"]`).textContent();
const clean = (page) => assert.deepEqual(page.problems, []);

function file_of(name, text) {
  writeFileSync(join(out, name), text);
  return join(out, name);
}

const without_boom_from_1_s = () => log.split('\n').filter((line) =>
  !line.includes(' 0CFF2080#') || line < '(0000000001').join('\n');

async function seek(page, time_s) {
  await page.locator('input.scrub').fill(String(time_s));
  await until(`the page shows ${time_s} s`, async () => {
    const {now} = await look(page);
    return Math.abs(now - time_s) < 1e-3;
  });
  await page.evaluate(() => new Promise((drawn) =>
    requestAnimationFrame(() => requestAnimationFrame(drawn))));
}

async function loaded(page) {
  return until('the log is whole', async () => {
    const seen = await look(page);
    return seen.frames > 1000 && seen.tip && seen.loaded === 1 && seen;
  });
}

/// Where the teeth are by the last strokes of the log, as the controller's kinematics have it.
function teeth_at(time_s) {
  const words = execFileSync('python3', ['-B', join(here, 'teeth_at.py'), graben,
    join(out, 'dig.log'), String(time_s)], {encoding: 'utf8'});
  return JSON.parse(words);
}

async function live_dig() {
  const began = Date.now();
  const server = await serve(run, ['--scope', '--port', '0']);
  const page = await open_page(browser, server.url);
  await page.waitForFunction(() => window.grabenScope?.mode() === 'Active'
    && window.grabenScope.tip() !== null);
  const live_s = (Date.now() - began) / 1000;
  const first = await look(page);
  const moved = await until('the teeth move', async () => {
    const seen = await look(page);
    return distance(seen.tip, first.tip) > 0.1 && seen;
  });
  assert.ok(distance(moved.screen, first.screen) > 3, 'the teeth do not move on the screen');
  assert.equal(await server.stop(), 0);
  await page.locator('[data-alarm="link"]').waitFor();
  page.problems = page.problems.filter((line) => !line.includes('WebSocket'));
  clean(page);
  return `the dig is live ${live_s.toFixed(1)} s after ./run --scope, with the browser's start`;
}

async function pose_on_screen() {
  const shown = blind ? file_of('blind.log', without_boom_from_1_s()) : join(out, 'dig.log');
  const server = await scope('--log', shown);
  const page = await open_page(browser, server.url);
  await loaded(page);
  let worst = 0;
  for (const time_s of [0.5, 4.005, 9.999, 15.25, 17.5]) {
    await seek(page, time_s);
    const {tip, screen} = await look(page);
    const off = distance(tip, teeth_at(time_s));
    worst = Math.max(worst, off);
    const box = await page.locator('section.scene canvas').first().boundingBox();
    assert.ok(screen[0] > 0 && screen[0] < box.width && screen[1] > 0 && screen[1] < box.height,
      `the teeth are off the picture at ${time_s} s: ${screen}`);
  }
  assert.ok(worst < CENTIMETRE, `the teeth are ${worst} m from where the log has them`);
  clean(page);
  await server.stop();
  return `teeth within ${(worst * 1000).toFixed(3)} mm of the log's`;
}

/// Against the plant's own truth, which the report has beside the frames; sensors are late by up to
/// two cycles, so that the nearest of those times counts.
async function reports_from_a_file() {
  const words = [];
  for (const name of ['dig', 'grade', 'autodig']) {
    const file = join(out, `${name}.html`);
    const page = await open_page(browser, pathToFileURL(file).href);
    const end = await loaded(page);
    const {run: of} = JSON.parse(/id="graben-setup">(.*?)<\/script/s.exec(readFileSync(file))[1]);
    const times = of.truth.time_s;
    let worst = 0;
    for (const share of [0.2, 0.5, 0.8]) {
      const at = Math.round(share * (times.length - 1));
      await seek(page, times[at]);
      const {tip} = await look(page);
      worst = Math.max(worst, Math.min(...[-2, -1, 0, 1].map((k) =>
        distance(tip, of.way[at + k]))));
    }
    assert.ok(worst < CENTIMETRE, `${name}: ${worst} m from the true one`);
    assert.ok((await page.locator('body').innerText()).includes(of.subtitle), `${name}: subtitle`);
    assert.ok(end.frames > 10_000);
    clean(page);
    words.push(`${name} ${(worst * 1000).toFixed(1)} mm`);
    await page.context().close();
  }
  const page = await open_page(browser, pathToFileURL(join(out, 'plan.html')).href);
  const begin = await until('the plan is shown', async () => (await look(page)).tip);
  await seek(page, 12);
  assert.ok(distance((await look(page)).tip, begin) > 0.5, 'the plan does not move');
  clean(page);
  return `edge or teeth from the plant's: ${words.join(', ')}`;
}

async function replay_and_pause() {
  const server = await scope('--log', join(out, 'dig.log'));
  const page = await open_page(browser, server.url);
  await loaded(page);
  await seek(page, 3);
  await page.getByRole('button', {name: 'Play', exact: true}).click();
  await until('replay goes on', async () => (await look(page)).now > 3.5);
  await page.keyboard.press('Space');
  const {now} = await look(page);
  await rest(500);
  assert.equal((await look(page)).now, now, 'a pause that goes on');
  await page.getByLabel('Replay speed').selectOption('10');
  const began = Date.now();
  await page.getByRole('button', {name: 'Play', exact: true}).click();
  await until('ten seconds at ten times the speed', async () => (await look(page)).now > now + 10);
  assert.ok(Date.now() - began < 9000, 'replay at 10 times the speed takes longer');
  await server.stop();

  const live = await scope('--sim', 'dig');
  const other = await open_page(browser, live.url);
  await other.waitForFunction(() => window.grabenScope?.mode() === 'Active');
  await other.getByRole('button', {name: 'Pause', exact: true}).click();
  const paused = await look(other);
  await more_frames(other, 500);
  const later = await look(other);
  assert.equal(later.now, paused.now);
  await other.getByRole('button', {name: 'Back to live'}).click();
  await until('live again', async () => (await look(other)).now > later.now + 0.3);
  clean(page);
  clean(other);
  await live.stop();
}

/// The values of a message, as its row of the table has them when opened.
async function values_of(page, message) {
  const row = page.locator(`[aria-controls="values-${message}"]`);
  if (await row.getAttribute('aria-expanded') !== 'true') await row.click();
  return page.evaluate((name) => window.grabenScope.values(name), message);
}

async function fault_by_button() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, server.url);
  const other = await open_page(browser, server.url);
  for (const one of [page, other]) {
    await one.waitForFunction(() => window.grabenScope?.mode() === 'Active');
  }
  await until('the spools are open', async () =>
    Math.abs((await values_of(page, 'SpoolCommand')).BoomDuty) > 10);
  await page.locator('[data-fault="stroke-silent"]').click();
  await page.waitForFunction(() => window.grabenScope.mode() === 'Fault');
  const words = await alarm(page, 'fault');
  assert.match(words, /Stopped by fault 1: a stroke or angle is missing/);
  assert.match(await page.locator('ol.faults').textContent(), /1a stroke or angle is missing/);
  const {BoomDuty, ArmDuty, BucketDuty, Enable} = await values_of(page, 'SpoolCommand');
  assert.deepEqual([BoomDuty, ArmDuty, BucketDuty, Enable], [0, 0, 0, 0]);
  const shown = await until('the table shows it', async () => {
    const text = await page.locator('#values-SpoolCommand').innerText();
    return /Off \(0\)/.test(text) && text;
  });
  assert.equal(shown.match(/\b0\.0\d* ‰/g)?.length, 3, shown);
  const pressed = '[data-fault="stroke-silent"][aria-pressed="true"]';
  await other.locator(pressed).waitFor({state: 'attached'});
  assert.match(await alarm(other, 'fault'), /fault 1:/);
  await other.getByRole('button', {name: /Take all faults back/}).click();
  await page.waitForFunction(() => window.grabenScope.mode() === 'Active');
  assert.equal(await page.locator(pressed).count(), 0);
  assert.equal(await page.locator('[data-alarm="fault"]').count(), 0);
  clean(page);
  clean(other);
  await server.stop();
  return words.trim();
}

/// A WebSocket that asks for frames and never reads a byte.
function deaf_client(url) {
  const {hostname, port, host} = new URL(url);
  const socket = connect({host: hostname, port: Number(port)});
  socket.pause();
  socket.write(`GET /frames HTTP/1.1\r\nHost: ${host}\r\nUpgrade: websocket\r\n`
    + 'Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: graben-scope\r\n'
    + 'Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n');
  return socket;
}

async function time_of(what) {
  const began = Date.now();
  await what();
  return Date.now() - began;
}

const resident_kb = (pid) =>
  Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]);

async function frames_in_a_second(page) {
  const {frames} = await look(page);
  await page.waitForTimeout(1000);
  return (await look(page)).frames - frames;
}

/// Until the page has all that the server has: what is behind comes faster than the clock's pace. On a
/// machine that was too busy to tell that pace, for half a minute.
async function caught_up(page, clocks_rate) {
  await page.locator('#sim-pace').selectOption('1');
  for (let n = 0; n < 30 && await frames_in_a_second(page) > 1.5 * clocks_rate; ++n);
}

async function client_that_stops_reading() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, server.url);
  await page.waitForFunction(() => window.grabenScope?.mode() === 'Active');
  const clocks_rate = await frames_in_a_second(page);
  // Ten times as many frames, so that a socket's buffers fill in time.
  await page.locator('#sim-pace').selectOption('10');
  const alone_ms = await time_of(() => more_frames(page, 30_000));
  const deaf = [deaf_client(server.url), deaf_client(server.url)];
  // Until what the server keeps for whoever is slow is full.
  await more_frames(page, 90_000);
  await caught_up(page, clocks_rate);
  const before = resident_kb(server.pid);
  const {frames} = await look(page);
  await page.locator('#sim-pace').selectOption('10');
  const beside_ms = await time_of(() => more_frames(page, 120_000));
  await caught_up(page, clocks_rate);
  const after = await look(page);
  // Waiting for one that is deaf takes for ever; others on this machine take what they take.
  assert.ok(beside_ms < 4 * 10 * alone_ms, `30 000 frames took ${alone_ms} ms, 120 000 ${beside_ms} ms`);
  assert.equal(await page.locator('[data-alarm="dropped"]').count(), 0, 'another page loses frames');
  const grown = resident_kb(server.pid) - before;
  // What came is kept once, for pages that come later; a deaf page makes it no more.
  const kept = (after.frames - frames) * LINE_BYTES / 1024;
  assert.ok(grown < 2048 + kept, `the server grew by ${grown} kB`);
  deaf.forEach((socket) => socket.destroy());
  clean(page);
  await server.stop();
  return `the other page had ${after.frames - frames} frames, the server grew by ${grown} kB`;
}

async function bounded_memory() {
  const server = await scope('--sim', 'dig');
  const page = await open_page(browser, `${server.url}?keep=10`);
  await page.waitForFunction(() => window.grabenScope?.mode() === 'Active');
  await page.locator('#sim-pace').selectOption('10');
  const session = await page.context().newCDPSession(page);
  const bytes = async () => {
    await session.send('HeapProfiler.collectGarbage');
    const {usedSize, backingStorageSize = 0} = await session.send('Runtime.getHeapUsage');
    return usedSize + backingStorageSize;
  };
  // A message's frames go in pieces of 4096, some 40 s of the simulation's time, most of them at once:
  // what is held rises and falls, and only its most over such a stretch says something. The page
  // itself looks for it: on a busy machine a question from here comes too seldom to meet it.
  await page.evaluate(() => {
    window.most_held = 0;
    setInterval(() => { window.most_held = Math.max(window.most_held, window.grabenScope.heldFrames()); }, 20);
  });
  const most_of = async (count) => {
    await page.evaluate(() => { window.most_held = 0; });
    const until_frame = (await look(page)).frames + count;
    const most = {held: 0, bytes: 0};
    do {
      most.bytes = Math.max(most.bytes, await bytes());
      await page.waitForTimeout(250);
    } while ((await look(page)).frames < until_frame);
    most.held = await page.evaluate(() => window.most_held);
    return most;
  };
  await more_frames(page, 60_000);
  const first = await most_of(100_000);
  const last = await most_of(100_000);
  const {frames} = await look(page);
  assert.ok(frames > 2 * last.held, `${frames} frames came, ${last.held} were kept`);
  assert.ok(last.held < 1.25 * first.held, `${first.held} frames were kept, then ${last.held}`);
  assert.ok(last.bytes < 1.25 * first.bytes, `${first.bytes} bytes, then ${last.bytes}`);
  clean(page);
  await server.stop();
  return `at most ${last.held} of ${frames} frames kept; ${(first.bytes / 1e6).toFixed(1)} MB, then `
    + `${(last.bytes / 1e6).toFixed(1)} MB`;
}

async function bad_logs() {
  const said = [];
  const shown = async (name, text, id) => {
    const server = await scope('--log', file_of(name, text));
    const page = await open_page(browser, server.url);
    const words = await alarm(page, id);
    clean(page);
    await page.context().close();
    await server.stop();
    said.push(words);
    return words;
  };
  const lines = log.split('\n');
  lines[40] = 'this is no frame';
  lines[70] = '(0000000000.700000) vcan0 18FF2080#001';
  assert.match(await shown('bent.log', lines.join('\n'), 'malformed'),
    /2 lines are not candump, the first is line 41: .this is no frame/);
  assert.match(await shown('novel.log', 'Call me Ishmael.\nSome years ago\n', 'malformed'),
    /This is no candump log/);
  assert.match(await shown('foreign.log', '(0000000000.100000) vcan0 123#00\n'.repeat(50), 'foreign'),
    /No frame of this log is in a DBC/);
  // EcuIdentity and MachineIdentity: the profile's hash, the DBC's version, counted up by one a change, a
  // stamp or its echo.
  const identity = /( (?:18FF3482|0CFF3080)#)([0-9A-F]{8})([0-9A-F]{2})(?=[0-9A-F]{4}FF$)/gm;
  const version = Number.parseInt(/ 18FF3482#[0-9A-F]{8}([0-9A-F]{2})/.exec(log)[1], 16);
  const byte = (value) => value.toString(16).toUpperCase().padStart(2, '0');
  // Older than the oldest that the page reads of an excavator (dbc.ts).
  const oldest = 10;
  const older = log.replace(identity, `$1$2${byte(oldest - 1)}`);
  assert.notEqual(older, log);
  assert.match(await shown('older.log', older, 'dbc'), new RegExp(
    `Written with DBC version ${oldest - 1}, this page reads versions ${oldest} to ${version}: `
    + 'values may be wrong'));
  const other = log.replace(identity, '$1DEADBEEF$3');
  assert.match(await shown('other.log', other, 'profile'),
    /No profile with hash 0xEFBEADDE is known here/i);
  const empty = ['scope', '--log', file_of('empty.log', ''), '--port', '0'];
  assert.throws(() => execFileSync(graben, empty, {stdio: 'pipe'}),
    (error) => error.status === 1 && /is empty/.test(error.stderr.toString()));
  return said[0].trim();
}

async function no_webgl() {
  // The page goes on without its picture.
  const server = await scope('--log', join(out, 'dig.log'));
  const context = await browser.newContext();
  await context.addInitScript(() => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith('webgl') ? null : get.call(this, kind, ...rest);
    };
  });
  const page = await context.newPage();
  await page.goto(server.url);
  await page.waitForFunction(() => window.grabenScope?.frames() > 1000);
  assert.match(await page.locator('section.scene').innerText(), /WebGL/);
  await server.stop();
}

const failed = await run_scenarios(join(out, 'failed'), browser, blind ? {pose_on_screen} : {
  live_dig, pose_on_screen, reports_from_a_file, replay_and_pause, fault_by_button,
  client_that_stops_reading, bounded_memory, bad_logs, no_webgl,
});
await browser.close();
console.log(`scope: ${failed} scenarios failed`);
process.exit(failed > 0 ? 1 : 0);
