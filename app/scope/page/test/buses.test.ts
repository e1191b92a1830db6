// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';
import type {BusSignal, Setup} from '../src/model/api';
import {raw_of} from '../src/model/bus_frames';
import {machines_of} from '../src/model/on_bus';
import {off_truth, run_of, store_of_run} from './runs';
import {graben} from './tool';

const field = (start: number, width: number, motorola: boolean, signed: boolean): BusSignal =>
  ({tells: 'stroke', of: 0, start, width, motorola, signed, scale: 1, offset: 0, least: 0, most: 0});

test('a field of any order and sign is the number that its bits are', () => {
  const bytes = Uint8Array.from([0xff, 0x12, 0x34, 0xfe, 0x80]);
  assert.equal(raw_of(field(0, 16, false, false), bytes, 1), 0x3412);
  assert.equal(raw_of(field(7, 16, true, false), bytes, 1), 0x1234);
  assert.equal(raw_of(field(4, 8, false, false), bytes, 1), 0x41);
  assert.equal(raw_of(field(3, 12, true, false), bytes, 1), 0x234);
  assert.equal(raw_of(field(16, 8, false, true), bytes, 1), -2);
  assert.equal(raw_of(field(16, 8, false, false), bytes, 1), 0xfe);
  assert.equal(raw_of(field(31, 8, true, true), bytes, 1), -128);
});

test('a machine on a bus of its own is drawn where it is', () => {
  for (const bus of ['zx200', 'encoders', 'slopes', 'inclinometers']) {
    const run = run_of('dig', '--bus', bus, '--loops', '0.5');
    const off_m = off_truth(run, store_of_run(run));
    assert.ok(off_m.length > 50, `${bus}: ${off_m.length}`);
    const [half, most] = [off_m[off_m.length >> 1]!, off_m.at(-1)!];
    assert.ok(half < 0.03 && most < 0.06, `${bus}: ${half} m, most ${most} m`);
    console.log(`# ${bus}: ${(1000 * half).toFixed(0)} mm median, ${(1000 * most).toFixed(0)} mm most`);
  }
});

/// What `compare` gives its page of two logs.
function compared(folder: string, ...options: string[]): Setup {
  graben('compare', join(folder, 'dig.log'), join(folder, 'dig.log'), '--out', folder, ...options);
  const html = readFileSync(join(folder, 'compare.html'), 'utf8');
  return JSON.parse(/id="graben-setup">(.*?)<\/script/s.exec(html)![1]!);
}

test('a log of a machine that was put on a bus names both, a shipped one or one that is told', () => {
  const folder = mkdtempSync(join(tmpdir(), 'graben-page-'));
  try {
    const named = (setup: Setup): string | undefined => {
      const log = readFileSync(join(folder, 'dig.log'));
      const store = store_of_run({setup, log});
      return machines_of(setup).find(({hash}) => hash === store.health.profile_hash)?.name;
    };
    graben('dig', '--bus', 'zx200', '--loops', '0.1', '--out', folder);
    const shipped = compared(folder);
    assert.equal(named(shipped), 'excavator_22t on zx200');
    assert.ok(store_of_run({setup: shipped, log: readFileSync(join(folder, 'dig.log'))})
      .rows('BoomStroke').count > 100);
    const shipped_file = join(process.env.GRABEN_DBC!, '../app/machines/buses/zx200.toml');
    const own = join(folder, 'mine.toml');
    writeFileSync(own, readFileSync(shipped_file, 'utf8').replace('timeout = 0.035', 'timeout = 0.034'));
    graben('dig', '--bus', own, '--loops', '0.1', '--out', folder);
    assert.equal(named(compared(folder)), undefined);
    assert.equal(named(compared(folder, '--bus', own)), 'excavator_22t on mine');
  } finally {
    rmSync(folder, {recursive: true});
  }
});
