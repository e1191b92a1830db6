// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {CandumpParser} from '../src/model/candump';
import type {FrameBlock} from '../src/model/frame_block';
import cases from './candump_cases.json';
import {bytes_of, hex, line, random} from './make';

interface Row {
  key: number;
  length: number;
  time_s: number;
  bytes: number[];
}

function rows_of(block: FrameBlock): Row[] {
  return block.columns.flatMap(({key, length, time_s, bytes}) => Array.from(time_s, (time, i) => ({
    key, length, time_s: time, bytes: [...bytes.subarray(8 * i, 8 * i + 8)]})));
}

function parse(text: string): {rows: Row[]; block: FrameBlock} {
  const parser = new CandumpParser();
  parser.feed(bytes_of(text));
  parser.end();
  const block = parser.take();
  return {rows: rows_of(block), block};
}

test('a frame of each kind', () => {
  const {rows, block} = parse([
    '(1699999999.000000) vcan0 18FF2080#0011223344556677',
    '(1700000000.123456) can0 123#AB',
    '(1700000000.123457) can0 1FFFFFFF#',
    '(1700000000.123458) can0 7FF#R',
    '(1700000000.123459) can0 00000123#R8',
    '(1700000000.2) can0 18ff2080#00112233445566aa T\r',
    '(1700000000.200000) can0 18FF2080#0011223344556677_9 R',
    '(1700000000.300000) can0 123##1AABBCC',
    '(1700000000.400000) can0 20000040#0000000000000000',
    '',
    '(1700000000.500000) can0 18FF2080#0011223344556677',
  ].join('\n'));
  assert.deepEqual(block.count,
    {lines: 10, malformed: 0, first_malformed: null, backwards: 0, unheard: 2, lost: 0, breaks: 1,
      first_break: {line: 2, by_s: 1700000000.123456 - 1699999999}});
  const known = (time_s: number): Row[] => rows.filter((row) => row.time_s === time_s);
  assert.deepEqual(known(1699999999), [{key: 0x98ff2080, length: 8, time_s: 1699999999,
    bytes: [0, 17, 34, 51, 68, 85, 102, 119]}]);
  assert.deepEqual(known(1700000000.123456),
    [{key: 0x123, length: 1, time_s: 1700000000.123456, bytes: [0xab, ...Array(7).fill(255)]}]);
  assert.deepEqual(known(1700000000.123457),
    [{key: 0x9fffffff, length: 0, time_s: 1700000000.123457, bytes: Array(8).fill(255)}]);
  assert.deepEqual(known(1700000000.123458).map(({key}) => key), [0x400007ff]);
  assert.deepEqual(known(1700000000.123459).map(({key, length}) => [key, length]),
    [[0xc0000123, 8]]);
  assert.deepEqual(known(1700000000.2).map(({bytes}) => bytes[7]), [0xaa, 0x77]);
  assert.equal(known(1700000000.5).length, 1);
});

test('stamps are the very numbers that their text is', () => {
  for (const text of ['0.000001', '4102444799.999999', '12.5', '3.000000001']) {
    const [row] = parse(`(${text}) can0 123#00\n`).rows;
    assert.equal(row.time_s, Number(text));
  }
  const next = random(5);
  for (let i = 0; i < 3000; ++i) {
    const micros = String(Math.floor(1e6 * next())).padStart(6, '0');
    const text = `${Math.floor((i % 2 === 0 ? 20 : 2e9) * next())}.${micros}`;
    for (const rest of ['123#00', '18FF2080#0011223344556677']) {
      assert.equal(parse(`(${text}) can0 ${rest}\n`).rows[0].time_s, Number(text));
    }
  }
});

const MALFORMED = [
  'x', '()', '(1.0 can0 123#00', '(1) can0 123#00', '(1.) can0 123#00', '(.5) can0 123#00',
  '(1.0)can0 123#00', '(1.0)  123#00', '(1.0) can0 12#00', '(1.0) can0 1234#00', '(1.0) can0 800#',
  '(1.0) can0 8FF20800#00', '(1.0) can0 40000000#00', '(1.0) can0 123 #00', '(1.0) can0 123#0',
  '(1.0) can0 123#0G', '(1.0) can0 123#001122334455667788', '(1.0) can0 123#00 x',
  '(1.0) can0 123#00T', '(1.0) can0 123#R9', '(1.0) can0 123##', '(1.0) can0 123#00_9',
  '(1.0) can0 18FF208#00', '(1.0) can0 018FF2080#00', '(1.0) can0', '(1.0)',
  '(-1.0) can0 123#00', '(1.0000000000) can0 123#00', '(1.0) can0 123#00\r\r', '\0\0\0',
];

test('malformed lines are counted, and the first one is kept', () => {
  for (const bad of MALFORMED) {
    const {rows, block} = parse(`(1.0) can0 123#00\n${bad}\n(1.0) can0 123#01\n`);
    assert.equal(block.count.malformed, 1, bad);
    assert.equal(block.count.lines, 3, bad);
    assert.equal(block.count.first_malformed?.line, 2, bad);
    assert.equal(rows.length, 2, bad);
  }
  const {block} = parse(`garbage \u0007${'x'.repeat(5000)}\nmore\n`);
  assert.equal(block.count.malformed, 2);
  assert.match(block.count.first_malformed!.text, /^garbage \.x+\.\.\.$/);
  assert.ok(block.count.first_malformed!.text.length < 100);
});

test('the same frames wherever the text is cut, CRLF or not', () => {
  const next = random(3);
  let text = '';
  for (let i = 0; i < 400; ++i) {
    const id = next() < 0.5 ? hex(0x18ff0000 + Math.floor(8 * next()), 8) :
      hex(0x100 + Math.floor(4 * next()), 3);
    const data = Array.from({length: Math.floor(9 * next())}, () =>
      hex(Math.floor(256 * next()), 2)).join('');
    text += `(${(i * 0.01).toFixed(6)}) vcan0 ${id}#${data}${next() < 0.3 ? '\r\n' : '\n'}`;
    text += next() < 0.05 ? 'not a line\n' : '';
    text += next() < 0.01 ? `${'long'.repeat(600)}\n` : '';
  }
  const all = bytes_of(text);
  const whole = parse(text);
  assert.ok(whole.rows.length > 300 && whole.block.count.malformed > 10);
  for (let round = 0; round < 60; ++round) {
    const parser = new CandumpParser();
    for (let from = 0; from < all.length;) {
      const until = from + 1 + Math.floor(next() * (round % 2 === 0 ? 20 : 3000));
      parser.feed(all.slice(from, until));
      from = until;
    }
    parser.end();
    const block = parser.take();
    assert.deepEqual(rows_of(block), whole.rows);
    assert.deepEqual(block.count, whole.block.count);
  }
});

test('a last line without its end is one', () => {
  assert.equal(parse('(1.0) can0 123#00\n(2.0) can0 123#01').rows.length, 2);
  assert.equal(parse('(1.0) can0 123#00\n(2.0) can').block.count.malformed, 1);
});

test('after a lost connection the half line is forgotten', () => {
  const parser = new CandumpParser();
  parser.feed(bytes_of('(1.0) can0 123#00\n(2.0) can0 12'));
  parser.forget_rest();
  parser.feed(bytes_of('(3.0) can0 123#00\n'));
  const {count} = parser.take();
  assert.deepEqual([count.lines, count.malformed], [2, 0]);
});

test('stamps out of order by a little are levelled, and counted', () => {
  const {rows, block} = parse(
    '(5.0) a 123#00\n(5.2) a 123#01\n(5.1) a 123#02\n(5.15) a 123#03\n(5.3) a 123#04\n');
  assert.deepEqual(rows.map(({time_s}) => time_s), [5, 5.2, 5.2, 5.2, 5.3]);
  assert.equal(block.count.backwards, 2);
  assert.equal(block.restart, false);
});

test('one garbled stamp loses its frame alone', () => {
  for (const odd of ['0000000001.000000', '9999999999.000000']) {
    const {rows, block} = parse('(1700000000.0) a 123#00\n' +
      `(${odd}) a 123#01\n(1700000000.1) a 123#02\n`);
    assert.deepEqual(rows.map(({bytes}) => bytes[0]), [0, 2]);
    assert.equal(block.restart, false);
    assert.equal(block.count.backwards + block.count.unheard, 1);
  }
});

test('a source that begins anew is another time; a leap ahead is not', () => {
  const before = '(100.0) a 123#00\n(100.1) a 123#01\n';
  const anew = parse(`${before}(0.0) a 123#02\n(0.1) a 123#03\n(0.2) a 123#04\n`);
  assert.equal(anew.block.restart, true);
  assert.deepEqual(anew.rows.map(({time_s}) => time_s), [0, 0.1, 0.2]);
  const leap = parse(`${before}(1700000000.0) a 123#02\n(1700000000.1) a 123#03\n`);
  assert.equal(leap.block.restart, false);
  assert.deepEqual(leap.rows.map(({time_s}) => time_s), [100, 100.1, 1700000000, 1700000000.1]);
});

test('a log goes on where its clock was set back or its bus was silent', () => {
  const log = (text: string): {times: number[]; block: FrameBlock} => {
    const parser = new CandumpParser(true);
    parser.feed(bytes_of(text));
    parser.end();
    const block = parser.take();
    return {times: rows_of(block).map(({time_s}) => time_s).sort((a, b) => a - b), block};
  };
  const before = '(3700.0) a 123#00\n(3700.5) a 123#01\n';
  const back = log(`${before}(100.5) a 123#02\n(101.0) a 123#03\n`);
  assert.equal(back.block.restart, false);
  assert.deepEqual(back.times, [3700, 3700.5, 3702.5, 3703]);
  assert.deepEqual(back.block.count.first_break, {line: 3, by_s: -3600});
  const gap = log(`${before}(4300.5) a 123#02\n(4300.5) a 123#03\n`);
  assert.deepEqual(gap.times, [3700, 3700.5, 4300.5, 4300.5]);
  assert.deepEqual([gap.block.count.breaks, gap.block.count.first_break], [1, {line: 3, by_s: 600}]);
});

interface Case {
  line: string;
  is: 'frame' | 'other' | 'lost' | 'broken';
  id?: string;
  extended?: boolean;
  data?: string;
  time_s?: number;
  frames?: number;
}

test('each line is what the terminal takes it for', () => {
  assert.ok(cases.length > 50);
  for (const {line: text, is, id, extended, data, time_s, frames} of cases as Case[]) {
    const {rows, block} = parse(`${text}\n`);
    const told = rows.filter(({key}) => (key & 0x40000000) === 0);
    assert.equal(block.count.malformed, is === 'broken' ? 1 : 0, text);
    assert.equal(block.count.lost, frames ?? 0, text);
    assert.equal(told.length, is === 'frame' ? 1 : 0, text);
    if (is === 'frame') {
      const [{key, length, time_s: at_s, bytes}] = told;
      assert.equal(key, parseInt(id!, 16) + (extended ? 0x80000000 : 0), text);
      assert.equal(at_s, time_s, text);
      assert.equal(bytes.slice(0, length).map((byte) => hex(byte, 2)).join(''), data, text);
    }
  }
});

test('many frames, ids and lengths, each in its column', () => {
  const next = random(23);
  const sent: number[][] = [];
  let text = '';
  for (let i = 0; i < 9000; ++i) {
    const data = [i & 255, i >> 8, 3, 4, 5, 6, 7, 8].slice(0, 2 + Math.floor(7 * next()));
    const id = Math.floor(12 * next());
    sent.push([id, ...data]);
    text += line(0, id, data);
  }
  const got = rows_of(parse(text).block)
    .map(({key, length, bytes}) => [key - 0x80000000, ...bytes.slice(0, length)]);
  const order = (rows: number[][]): string[] => rows.map(String).sort();
  assert.deepEqual(order(got), order(sent));
});

test('noise of ids does not fill the memory', () => {
  let text = '';
  for (let id = 0; id < 3000; ++id) {
    text += line(0, id, [0]);
  }
  const {rows, block} = parse(text);
  assert.equal(rows.length, 1024);
  assert.equal(block.count.unheard, 3000 - 1024);
});

/// What a line is, said once more.
const DATA = '(?:R[0-8]?|(?:[0-9A-Fa-f]{2}){8}_[9A-Fa-f]|(?:[0-9A-Fa-f]{2}){0,8}|#[0-9A-Fa-f]+)';
const ID = '(?:[0-3][0-9A-Fa-f]{7}|[0-7][0-9A-Fa-f]{2})';
const STAMP = '\\(\\d{1,12}\\.\\d{1,9}\\)';
const LINE = new RegExp(`^ *${STAMP} +[^\\x00-\\x20]+ +${ID}#${DATA}(?: [A-Z ]*)?\\r?$`);
const LETTERS = ' ()#.:_RTaAfFgG0123456789\r\t-/\u0000\u00ff';

test('a garbled line is a line or none, as its form has it', () => {
  const next = random(17);
  const lines = ['(0000000012.340000) vcan0 18FF2080#0011223344556677',
    '(1700000000.123456) can0 0CF00400#FFFFFF803EFFFFFF', '(12.5) can0 7FF#AB T',
    '(0000000012.340000) can0 123##1AABB'];
  let wrong = 0;
  for (let i = 0; i < 40000; ++i) {
    const letters = [...lines[Math.floor(lines.length * next())]];
    for (let change = Math.floor(3 * next()); change >= 0; --change) {
      const letter = LETTERS[Math.floor(LETTERS.length * next())];
      const cut = next() < 0.5 ? 1 : 0;
      letters.splice(Math.floor(letters.length * next()), cut, ...next() < 0.7 ? [letter] : []);
    }
    const text = letters.join('');
    const parser = new CandumpParser();
    parser.feed(Uint8Array.from(`${text}\n(0000000012.340000) v 18FF2080#0011223344556677\n`,
      (letter) => letter.charCodeAt(0)));
    const {count} = parser.take();
    const empty = text === '' || text === '\r';
    assert.equal(count.lines, empty ? 1 : 2, JSON.stringify(text));
    assert.equal(count.malformed, empty || LINE.test(text) ? 0 : 1, JSON.stringify(text));
    wrong += count.malformed;
  }
  assert.ok(wrong > 10000 && wrong < 39000);
});

test('a line without its frame does not take the next line for it', () => {
  const {rows, block} = parse('(0000000012.340000) vcan0\n18FF2080#0011223344556677\n');
  assert.deepEqual([rows.length, block.count.lines, block.count.malformed], [0, 2, 2]);
});
