// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {loadDatabase} from '../src/model/dbc';
import type {SimState} from '../src/model/api';
import type {Alarm} from '../src/view/faults/alarm_rules';
import {AlarmList} from '../src/view/faults/alarms';
import {limit_colour, limit_key} from '../src/view/limits/limit_colours';
import {limit_shares} from '../src/view/limits/limit_shares';
import {integrity_words} from '../src/view/panels/message_table';
import {SimPanel} from '../src/view/panels/sim_panel';
import {snapshot} from '../src/view/basics/snapshot';
import {task_line} from '../src/view/panels/state_panel';
import {is_stale} from '../src/model/integrity';
import theme from '../src/view/styles/theme.css?raw';
import {fake_document, type FakeNode} from './dom';
import {line, store_of} from './make';

fake_document();
const EXCAVATOR = loadDatabase('excavator');
const id = (message: string): number => EXCAVATOR.messages.get(message)!.id;

const notice = (name: string, words: string): Alarm => ({id: name, level: 'warning', words});

test('an alarm keeps its place in the page while others come, change and go', () => {
  const list = new AlarmList('status', 'Notice', () => undefined);
  const shown = () => (list.node as unknown as FakeNode).find('ul')!.children;
  const words = () => shown().map(({textContent}) => textContent);
  list.show([notice('quiet', 'No frames for 2 s.'), notice('dropped', '5')]);
  const [quiet, dropped] = shown();
  list.show([notice('quiet', 'No frames for 3 s.'), notice('dropped', '5')]);
  assert.deepEqual(shown(), [quiet, dropped]);
  assert.deepEqual(words(), ['NoticeNo frames for 3 s.', 'Notice5']);
  list.show([notice('bus', 'down'), notice('dropped', '6')]);
  assert.deepEqual(words(), ['Noticedown', 'Notice6']);
  assert.equal(shown()[1], dropped);
  list.show([]);
  assert.equal(shown().length, 0);
});

/// The custom properties of a theme, as written.
function theme_of(dark: boolean): {colour(name: string): string} {
  const [light, night] = theme.split("[data-theme='dark']");
  const of = (text: string, name: string) => new RegExp(`--${name}: (#[0-9a-f]{6})`).exec(text)?.[1];
  return {colour: (name) => (dark ? of(night!, name) : undefined) ?? of(light!, name)!};
}

test('a limit has one colour of its own, whatever was seen before it, in both themes', () => {
  const drives = [0, 1, 2, 3];
  const keys = [0, ...[2, 3, 4].flatMap((kind) => drives.map((drive) => limit_key(kind, drive))),
    limit_key(1, 0), limit_key(1, 1), limit_key(8, 0), limit_key(8, 1),
    ...[5, 6, 7, 9, 10, 11, 12, 13].map((kind) => limit_key(kind, 0))];
  for (const dark of [false, true]) {
    const colours = keys.map((key) => limit_colour(theme_of(dark), key));
    assert.equal(new Set(colours).size, keys.length, colours.join());
    assert.ok(colours.every((colour) => /^#[0-9a-f]{6}$/.test(colour)), colours.join());
    assert.ok(!colours.includes(limit_colour(theme_of(dark), limit_key(14, 0))));
  }
});

const status_bytes = (kind: number, index: number) => [3 | (kind << 3), index, 0, 0, 0, 0, 0, 0];

test('shares are counted by time up to each frame that says Active, in the window that is told', () => {
  const status = (time_s: number, kind: number, index: number) =>
    line(time_s, id('EcuStatus'), status_bytes(kind, index));
  const store = store_of(line(0, id('BoomStroke'), new Uint8Array(8))
    + status(0, 0, 0) + status(0.01, 3, 0) + status(0.02, 3, 0) + status(0.03, 3, 1)
    + status(0.04, 0, 0) + line(0.05, id('EcuStatus'), [2, 0, 0, 0, 0, 0, 0, 0]));
  const words = (from_s: number, until_s: number) => limit_shares(store, from_s, until_s)
    .map(({key, share}) => [key, Math.round(share * 100)]);
  assert.deepEqual(words(-1, 1), [[limit_key(3, 0), 50], [0, 25], [limit_key(3, 1), 25]]);
  assert.deepEqual(words(0.005, 0.025), [[limit_key(3, 0), 100]]);
  assert.deepEqual(words(2, 3), []);
});

test('across a gap a frame stands for as long as the one before it', () => {
  const status = (time_s: number, kind: number) => line(time_s, id('EcuStatus'), status_bytes(kind, 0));
  const store = store_of(line(0, id('BoomStroke'), new Uint8Array(8))
    + status(0, 3) + status(0.01, 3) + status(600, 5) + status(600.01, 3) + status(600.02, 3));
  assert.deepEqual(limit_shares(store, -1, 601).map(({key, share}) => [key, Math.round(share * 100)]),
    [[limit_key(3, 0), 75], [limit_key(5, 0), 25]]);
});

test('a message is stale after three of its cycles, whoever shows it', () => {
  const text = line(0, id('BoomStroke'), new Uint8Array(8))
    + line(0, id('EcuStatus'), [3, 0, 0, 0, 0, 0, 0, 0])
    + line(0, id('OperatorCommand'), [0, 0, 0, 3, 200, 0, 0xff, 0xff]);
  const store = store_of(text);
  const cycle_s = (message: string) => EXCAVATOR.messages.get(message)!.cycle_ms / 1000;
  for (const message of ['EcuStatus', 'EcuHealth', 'OperatorCommand']) {
    assert.equal(is_stale(store, message, 2.9 * cycle_s(message)), false);
    assert.equal(is_stale(store, message, 3.1 * cycle_s(message)), true);
  }
  assert.equal(is_stale(store, 'NoSuchMessage', Infinity), true);
  assert.equal(snapshot(store, 2.9 * cycle_s('EcuStatus')).stale, false);
  assert.equal(snapshot(store, 3.1 * cycle_s('EcuStatus')).stale, true);
  const command_s = cycle_s('OperatorCommand');
  assert.deepEqual(task_line(store, 2.9 * command_s, null),
    {words: 'Task Program, speed 100 %', stale: false});
  assert.deepEqual(task_line(store, 3.1 * command_s, null),
    {words: 'Task Program, speed 100 % (old)', stale: true});
});

test('wrong frames are counted with their unit', () => {
  assert.equal(integrity_words('ok', 3), 'whole, 3 wrong in 1 s');
  assert.equal(integrity_words('crc', 0), 'CRC wrong');
});

/// Of WCAG 2.
function contrast(one: string, other: string): number {
  const light = (colour: string): number => [1, 3, 5]
    .map((at) => parseInt(colour.slice(at, at + 2), 16) / 255)
    .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4))
    .reduce((sum, part, k) => sum + part * [0.2126, 0.7152, 0.0722][k], 0);
  const [low, high] = [light(one), light(other)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

test('what was wanted can be seen in both themes', () => {
  assert.ok(contrast('#ffffff', '#000000') > 20.9);
  for (const part of theme.split(":root[data-theme='dark']")) {
    const sheet = /--sheet: (#\w+)/.exec(part)![1];
    const soft = [...part.matchAll(/--(\w+)-soft: (#\w+)/g)];
    assert.equal(soft.length, 11);
    for (const [, name, colour] of soft) {
      assert.ok(contrast(colour, sheet) >= 3, `${name} ${colour} on ${sheet}`);
    }
  }
});

test('a choice that has the focus gives way to the next word of the server', () => {
  const panel = new SimPanel(() => undefined);
  const setup = {source: {mode: 'sim'}, sim: {task: 'dig', can: {}, faults: []}};
  const said = (): SimState =>
    ({running: true, pace: 1, speed: 1, soil: false, obstacle: false, faults: []});
  const show = (sim: SimState, refused = '') =>
    panel.update({setup, sim, refused, link: {state: 'open'}} as never);
  const first = said();
  show(first);
  const pace = (panel.node as unknown as FakeNode).find('sim-pace')!;
  assert.equal(pace.value, '1');
  Object.assign(document, {activeElement: pace});
  pace.value = '10';
  show(first);
  assert.equal(pace.value, '10');
  show(said());
  assert.equal(pace.value, '1');
  const last = said();
  show(last);
  pace.value = '10';
  show(last, 'not now');
  assert.equal(pace.value, '1');
});
