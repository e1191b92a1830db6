// SPDX-License-Identifier: Apache-2.0
/// 20 messages at 100 Hz for an hour: 7.2 million lines through parser and store, then what the
/// page asks for while it scrubs.

import {CandumpParser} from '../src/model/candump';
import {loadDatabase} from '../src/model/dbc';
import {messageStates} from '../src/model/integrity';
import {velocity_curve} from '../src/model/motion';
import {PageStore} from '../src/model/store';
import {bytes_of, line, protected_bytes} from './make';

const SECONDS = 3600;
const HERTZ = 100;
const BUCKETS = 1000;

const messages = [...loadDatabase('excavator').messages.values()].slice(0, 20);
const STAMP_DIGITS = 10;

/// A second of lines, whose stamps are then written over: to make all anew would take longer than
/// what is measured.
function make_second(): {text: Uint8Array; stamps: number[]} {
  let lines = '';
  const stamps: number[] = [];
  for (let i = 0; i < HERTZ; ++i) {
    for (const message of messages) {
      stamps.push(lines.length + 1);
      const value = 20000 + Math.round(10000 * Math.sin(i / 8));
      lines += line(i / HERTZ, message.id, protected_bytes(message.data_id, i % 15, value));
    }
  }
  return {text: bytes_of(lines), stamps};
}

function stamp(text: Uint8Array, stamps: readonly number[], second: number): void {
  const digits = bytes_of(String(second).padStart(STAMP_DIGITS, '0'));
  stamps.forEach((at) => text.set(digits, at));
}

const ms = (value: number): string => `${value.toFixed(1)} ms`;

function best(times: number, run: (i: number) => void): string {
  let least = Infinity;
  for (let i = 0; i < times; ++i) {
    const from = performance.now();
    run(i);
    least = Math.min(least, performance.now() - from);
  }
  return ms(least);
}

const {text, stamps} = make_second();
const parser = new CandumpParser();
const store = new PageStore();
const mebibytes = (): number => process.memoryUsage().arrayBuffers / 2 ** 20;
const before_mib = mebibytes();
let [parse_ms, append_ms] = [0, 0];
let cpu_us = 0;
for (let second = 0; second < SECONDS; ++second) {
  stamp(text, stamps, second);
  const cpu = process.cpuUsage();
  const from = performance.now();
  parser.feed(text);
  const parsed = performance.now();
  cpu_us += process.cpuUsage(cpu).user;
  parse_ms += parsed - from;
  if (parser.frames > 131072 || second === SECONDS - 1) {
    const block = parser.take();
    const taken = performance.now();
    parse_ms += taken - parsed;
    store.append(block);
    append_ms += performance.now() - taken;
  }
}
const signal = 'BoomPressure.BoomCapPressure';
const middle = SECONDS / 2;
console.log([
  `${store.frames} frames, ${(SECONDS * text.length / 1e6).toFixed(0)} MB of text`,
  `parse           ${ms(parse_ms)}, of it ${ms(cpu_us / 1000)} of the processor`,
  `append          ${ms(append_ms)}`,
  `memory          ${(mebibytes() - before_mib).toFixed(0)} MiB`,
  `curve, hour     ${best(9, (i) => store.curve(signal, i / 1e6, SECONDS, BUCKETS))}`,
  `velocity, hour  ${best(9, (i) =>
    velocity_curve(store, 'BoomStroke.BoomStroke', i / 1e6, SECONDS, BUCKETS))}`,
  `curve, 30 s     ${best(9, (i) => store.curve(signal, middle, middle + 30 + i, BUCKETS))}`,
  `1000 readings   ${best(9, () => {
    for (let i = 0; i < 1000; ++i) {
      store.reading(signal, (i * 7919) % SECONDS);
    }
  })}`,
  `bus load        ${best(9, (i) => store.bus_load(middle + i, 500000))}`,
  `messages        ${best(9, (i) => messageStates(store, middle + i))}`,
  `health          ${best(9, () => store.health)}`,
].join('\n'));
