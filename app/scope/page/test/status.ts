// SPDX-License-Identifier: Apache-2.0
/// Frames of a controller as text, and the page after a log of them.

import type {Setup} from '../src/model/api';
import {CandumpParser} from '../src/model/candump';
import {loadDatabase} from '../src/model/dbc';
import {State} from '../src/state';
import {bytes_of, line} from './make';

export const SETUP: Setup = {
  source: {mode: 'log', name: 'a.log', bytes: 1, bitrate: 500000}, machines: [],
  words: {fault: {0: 'none', 21: 'a spool does not obey', 37: 'no such task'}, why_not_armed: []},
};
export const EXCAVATOR = loadDatabase('excavator');

export const id = (message: string): number => EXCAVATOR.messages.get(message)!.id;
export const stroke = (time_s: number): string => line(time_s, id('BoomStroke'), new Uint8Array(8));

export function status(time_s: number, mode: number, fault: number, limit = 0, lambda = 0): string {
  const raw = Math.round(lambda / 0.00002);
  return line(time_s, id('EcuStatus'),
    [mode | (limit << 3), 0, raw & 0xff, raw >> 8, fault, 0, 0, 0]);
}

export function trouble(time_s: number, fault: number): string {
  const spn = fault === 0 ? 0 : 520192 + fault;
  return line(time_s, id('DM1'),
    [0, 0xff, spn & 0xff, (spn >> 8) & 0xff, (spn >> 16) << 5, 1, 0xff, 0xff]);
}

/// One broadcast of several, from this time on; `lost`: a packet that does not come.
export function troubles(time_s: number, faults: readonly number[], lost = 0): string {
  const bytes = [0x10, 0xff, ...faults.flatMap((fault) => {
    const spn = 520192 + fault;
    return [spn & 0xff, (spn >> 8) & 0xff, (spn >> 16) << 5 | 9, 1];
  })];
  const packets = Math.ceil(bytes.length / 7);
  let text = line(time_s, 0x1cecff82, [32, bytes.length, 0, packets, 0xff, 0xca, 0xfe, 0]);
  for (let packet = 1; packet <= packets; ++packet) {
    const part = Array.from({length: 7}, (_, k) => bytes[7 * (packet - 1) + k] ?? 0xff);
    text += packet === lost ? '' : line(time_s + 0.06 * packet, 0x1cebff82, [packet, ...part]);
  }
  return text;
}

export function identity(time_s: number, hash: number, version: number): string {
  return line(time_s, id('EcuIdentity'), [hash & 0xff, (hash >> 8) & 0xff, (hash >> 16) & 0xff,
    hash >>> 24, version, 0xff, 0xff, 0xff]);
}

/// The page after a log that ended, at its last moment.
export function page(text: string, setup = SETUP): State {
  const state = new State(false);
  const parser = new CandumpParser();
  parser.feed(bytes_of(text));
  parser.end();
  state.onOpened();
  state.onSetup(setup);
  state.onFrames({...parser.take(), restart: true}, text.length);
  state.onMessage({kind: 'end'});
  state.know_machine();
  state.playhead.seek(state.extent.until_s);
  return state;
}
