// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {CandumpParser} from '../src/model/candump';
import {loadDatabase} from '../src/model/dbc';
import type {FrameBlock} from '../src/model/frame_block';
import {PageStore} from '../src/model/store';
import {bytes_of, line, protected_bytes, random, store_of} from './make';

const DB = loadDatabase('excavator');
const BOOM = DB.messages.get('BoomStroke')!;
const STATUS = DB.messages.get('EcuStatus')!;
const IDENTITY = DB.messages.get('EcuIdentity')!;

const boom_line = (time_s: number, raw: number): string =>
  line(time_s, BOOM.id, protected_bytes(BOOM.data_id, 0, raw));

const status_line = (time_s: number, fault: number): string =>
  line(time_s, STATUS.id, [0x03, 0, 0x50, 0xc3, fault, 0x10, 0, 0]);

function identity_line(time_s: number, hash: number, version: number): string {
  const bytes = new Uint8Array(8).fill(255);
  new DataView(bytes.buffer).setUint32(0, hash, true);
  bytes[4] = version;
  return line(time_s, IDENTITY.id, bytes);
}

interface Sample {
  time_s: number;
  raw: number;
}

/// A log in blocks of random sizes, and its samples.
function random_log(seed: number, frames: number): {samples: Sample[]; blocks: FrameBlock[]} {
  const next = random(seed);
  const samples: Sample[] = [];
  const blocks: FrameBlock[] = [];
  const parser = new CandumpParser();
  let time_s = 100;
  for (let i = 0; i < frames; ++i) {
    time_s = Math.round((time_s + 0.02 * next() + (next() < 0.002 ? 3 : 0)) * 1e6) / 1e6;
    const raw = next() < 0.02 ? 0xffff : Math.floor(64000 * next());
    samples.push({time_s, raw});
    parser.feed(bytes_of(boom_line(time_s, raw) + line(time_s, 0x123456, [1, 2])));
    if (next() < (i % 1000 < 500 ? 0.2 : 0.001)) {
      blocks.push(parser.take());
    }
  }
  blocks.push(parser.take());
  return {samples, blocks};
}

function filled(blocks: readonly FrameBlock[]): PageStore {
  const store = new PageStore();
  blocks.forEach((block) => store.append(block));
  return store;
}

const physical = (raw: number): number => raw === 0xffff ? NaN : raw * 0.05;

test('rows, readings and searches are those of a plain list', () => {
  const {samples, blocks} = random_log(5, 12000);
  const store = filled(blocks);
  const rows = store.rows('BoomStroke');
  assert.equal(rows.count, samples.length);
  assert.equal(store.frames, 2 * samples.length);
  assert.equal(store.from_s, samples[0].time_s);
  assert.equal(store.until_s, samples[samples.length - 1].time_s);
  samples.forEach((sample, i) => assert.equal(rows.time(i), sample.time_s));
  const next = random(6);
  for (let i = 0; i < 3000; ++i) {
    const at_sample = samples[Math.floor(next() * samples.length)].time_s;
    const time_s = next() < 0.5 ? at_sample : at_sample + 0.05 * (next() - 0.5);
    const last = samples.filter((sample) => sample.time_s <= time_s).length - 1;
    assert.equal(rows.at(time_s), last);
    const reading = store.reading('BoomStroke.BoomStroke', time_s);
    if (last < 0) {
      assert.equal(reading.state, 'never');
      continue;
    }
    assert.equal(reading.raw, samples[last].raw);
    assert.equal(reading.value, physical(samples[last].raw));
    assert.equal(reading.state, samples[last].raw === 0xffff ? 'notAvailable' : 'valid');
    assert.equal(reading.age_s, time_s - samples[last].time_s);
  }
  assert.throws(() => rows.time(samples.length), RangeError);
  assert.throws(() => rows.bytes(-1), RangeError);
});

test('what is not there is said to be not there', () => {
  const store = new PageStore();
  assert.equal(store.database, null);
  assert.deepEqual([store.from_s, store.until_s, store.frames], [0, 0, 0]);
  assert.equal(store.reading('BoomStroke.BoomStroke', 1).state, 'never');
  assert.equal(store.curve('BoomStroke.BoomStroke', 0, 1, 10).time_s.length, 0);
  assert.equal(store.rows('BoomStroke').at(1), -1);
  const some = store_of(boom_line(1, 100));
  assert.equal(some.reading('ArmStroke.ArmStroke', 1).state, 'never');
  assert.equal(some.reading('BoomStroke.BoomStroke', 0.9).state, 'never');
  assert.equal(some.reading('No.Such', 1).state, 'never');
  assert.equal(some.reading('BoomStroke.BoomStroke', 1).value, 5);
});

test('a curve with few frames has each of them, and breaks where they are missing', () => {
  const text = [0, 1, 2, 3].map((i) => boom_line(1 + 0.01 * i, 100 * i)).join('') +
    boom_line(2, 0xffff) + boom_line(2.01, 700);
  const {time_s, value} = store_of(text).curve('BoomStroke.BoomStroke', 0, 10, 100);
  assert.deepEqual([...time_s], [1, 1.01, 1.02, 1.03, (1.03 + 2) / 2, 2, 2.01]);
  assert.deepEqual([...value], [0, 5, 10, 15, NaN, NaN, 35]);
});

test('a curve reaches the edges of its window', () => {
  const text = Array.from({length: 100}, (_, i) => boom_line(1 + 0.01 * i, i)).join('');
  const {time_s} = store_of(text).curve('BoomStroke.BoomStroke', 1.205, 1.305, 100);
  assert.deepEqual([time_s[0], time_s[time_s.length - 1]], [1.2, 1.31]);
});

test('a curve with many frames has the least and the greatest of each bucket', () => {
  const {samples, blocks} = random_log(9, 20000);
  const store = filled(blocks);
  const [from, until, buckets] = [130, 250, 300];
  const {time_s, value} = store.curve('BoomStroke.BoomStroke', from, until, buckets);
  assert.ok(time_s.length < 3 * buckets);
  const width = (until - from) / buckets;
  const shown = new Map<number, number[]>();
  time_s.forEach((time, i) => {
    assert.ok(i === 0 || time >= time_s[i - 1], 'times rise');
    const bucket = Math.floor(time / width);
    shown.set(bucket, [...shown.get(bucket) ?? [], value[i]]);
  });
  let compared = 0;
  for (let bucket = Math.ceil(from / width); bucket < Math.floor(until / width); ++bucket) {
    const raws = samples.filter(({time_s: time, raw}) =>
      Math.floor(time / width) === bucket && raw !== 0xffff).map(({raw}) => raw * 0.05);
    const found = (shown.get(bucket) ?? []).filter((one) => !Number.isNaN(one));
    if (raws.length > 0) {
      assert.equal(Math.min(...found), Math.min(...raws));
      assert.equal(Math.max(...found), Math.max(...raws));
      ++compared;
    }
  }
  assert.ok(compared > 120);
  const gaps = samples.filter(({time_s: time}, i) =>
    i > 0 && time > from && time < until && time - samples[i - 1].time_s > 1).length;
  assert.ok(gaps > 0);
  assert.ok(value.filter(Number.isNaN).length >= gaps);
});

test('buckets stand still while the window moves', () => {
  const {blocks} = random_log(10, 20000);
  const store = filled(blocks);
  const first = store.curve('BoomStroke.BoomStroke', 140, 200, 200);
  const moved = store.curve('BoomStroke.BoomStroke', 140.07, 200.07, 200);
  const inside = (curve: typeof first): string => [...curve.time_s].map((time, i) =>
    time > 142 && time < 198 ? `${time} ${curve.value[i]}` : '').join('\n').trim();
  assert.equal(inside(first), inside(moved));
});

test('a curve is kept until frames come or the window moves', () => {
  const store = store_of(boom_line(1, 1) + boom_line(1.01, 2));
  const first = store.curve('BoomStroke.BoomStroke', 0, 2, 10);
  assert.equal(store.curve('BoomStroke.BoomStroke', 0, 2, 10), first);
  assert.notEqual(store.curve('BoomStroke.BoomStroke', 0, 3, 10), first);
  store.curve('BoomStroke.BoomStroke', 0, 2, 10);
  const parser = new CandumpParser();
  parser.feed(bytes_of(boom_line(1.02, 3)));
  store.append(parser.take());
  assert.equal(store.curve('BoomStroke.BoomStroke', 0, 2, 10).time_s.length, 3);
});

test('a live store forgets what is old, and stays right about the rest', () => {
  const store = new PageStore();
  store.keep_s = 60;
  const parser = new CandumpParser();
  let most = 0;
  for (let i = 0; i < 60000; ++i) {
    parser.feed(bytes_of(boom_line(0.01 * i, i % 64000)));
    if (i % 3000 === 0) {
      parser.feed(bytes_of(identity_line(0.01 * i, 77, 4)));
    }
    if (i % 4 === 3) {
      store.append(parser.take());
      most = Math.max(most, store.rows('BoomStroke').count);
    }
  }
  assert.ok(most < 6000 + 500 + 4096 + 8, `${most} rows were kept`);
  assert.equal(store.frames, 60020);
  assert.ok(store.from_s >= store.until_s - 66 && store.from_s <= store.until_s - 59);
  const rows = store.rows('BoomStroke');
  assert.equal(rows.time(rows.count - 1), 599.99);
  for (const time_s of [545, 570.005, 599.99]) {
    const row = Math.floor(time_s * 100 + 1e-6);
    assert.equal(store.reading('BoomStroke.BoomStroke', time_s).raw, row % 64000);
    assert.ok(Math.abs(rows.time(rows.at(time_s)) - row / 100) < 1e-9);
  }
  assert.equal(store.reading('BoomStroke.BoomStroke', 100).state, 'never');
  // A message of which nothing has come for long stays with what it said last.
  assert.equal(store.health.profile_hash, 77);
});

test('faults begin where their number changes, trimmed or not', () => {
  const codes = [0, 0, 5, 5, 5, 0, 5, 17, 255, 17, 0, 254, 0, 3];
  const text = boom_line(0, 1) + codes.map((code, i) => status_line(i, code)).join('');
  const expected = [[2, 5], [6, 5], [7, 17], [13, 3]];
  const found = (store: PageStore): number[][] =>
    store.faults().map(({time_s, code}) => [time_s, code]);
  assert.deepEqual(found(store_of(text)), expected);
  const store = new PageStore();
  const parser = new CandumpParser();
  for (const one of text.split('\n').slice(0, -1)) {
    parser.feed(bytes_of(`${one}\n`));
    store.append(parser.take());
  }
  assert.deepEqual(found(store), expected);
});

test('no fault is found twice or missed where old frames are forgotten', () => {
  const store = new PageStore();
  store.keep_s = 50;
  const parser = new CandumpParser();
  const expected: number[] = [];
  parser.feed(bytes_of(boom_line(0, 1)));
  for (let i = 0; i < 30000; ++i) {
    const code = i % 700 < 350 ? 0 : 1 + (i / 700 | 0) % 30;
    parser.feed(bytes_of(status_line(i / 100, code)));
    if (i % 700 === 350) {
      expected.push(i / 100);
    }
    if (i % 13 === 0) {
      store.append(parser.take());
    }
  }
  store.append(parser.take());
  assert.ok(store.rows('EcuStatus').count < 15000);
  assert.deepEqual(store.faults().map(({time_s}) => time_s), expected);
});

test('the database is the one whose machine is on the bus', () => {
  const blade = loadDatabase('dozer').messages.get('BladeStroke')!;
  assert.equal(store_of(boom_line(1, 1)).database?.kind, 'excavator');
  assert.equal(store_of(line(1, blade.id, new Uint8Array(8))).database?.kind, 'dozer');
  assert.equal(store_of(status_line(1, 0)).database, null);
  const by_hash = new PageStore([{kind: 'dozer', hash: 99} as never]);
  const parser = new CandumpParser();
  parser.feed(bytes_of(identity_line(1, 99, 2)));
  by_hash.append(parser.take());
  assert.equal(by_hash.database?.kind, 'dozer');
});

test('what the sender says of itself, and what was not understood', () => {
  const store = store_of(boom_line(1, 1) + identity_line(1, 0xdeadbeef, 3) + 'rubbish\n' +
    line(1, 0x1234, [1, 2, 3]) + line(1, BOOM.id, [1, 2]) + boom_line(0.9, 2));
  assert.deepEqual(store.health, {
    lines: 6, malformed: 1, first_malformed: {line: 3, text: 'rubbish'}, foreign: 2, backwards: 1,
    lost: 0, breaks: 0, first_break: null,
    profile_hash: 0xdeadbeef, dbc_version: 3,
  });
});

test('a source that begins anew begins the store anew', () => {
  const store = store_of(status_line(100, 5) + boom_line(100, 1));
  const parser = new CandumpParser();
  parser.feed(bytes_of(boom_line(100, 1) + boom_line(0, 2) + boom_line(0.01, 3)));
  store.append(parser.take());
  assert.equal(store.until_s, 0.01);
  assert.equal(store.rows('BoomStroke').count, 2);
  assert.deepEqual(store.faults(), []);
});

test('a message is known by PGN and source, whatever its priority', () => {
  const store = store_of(line(0, (BOOM.id & 0x3ffffff) | 0x18000000, protected_bytes(BOOM.data_id, 0, 1000)));
  assert.equal(store.health.foreign, 0);
  assert.equal(store.rows('BoomStroke').count, 1);
  assert.equal(store.reading('BoomStroke.BoomStroke', 0).state, 'valid');
});
