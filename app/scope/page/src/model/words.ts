// SPDX-License-Identifier: Apache-2.0
/// Numbers on the bus in text. Faults and reasons for not arming come with the setup, the limits from
/// the table that the tool's reports use (firmware/safety/limits.toml).

import type {Kind, Task, Words} from './api';
import {LIMITS} from './generated/limits';

const DRIVES: Readonly<Record<Kind, readonly string[]>> =
  {excavator: ['boom', 'arm', 'bucket', 'swing'], dozer: ['blade']};

/// EcuStatus.Fault.
export const fault_words = (words: Words, code: number): string =>
  words.fault[code] ?? `unknown fault ${code}`;

/// EcuHealth.WhyNotArmed: a sentence for each bit.
export function why_not_armed(words: Words, bits: number): string[] {
  const why: string[] = [];
  for (let bit = 0; bit < 32; ++bit) {
    if ((bits >>> bit) & 1) {
      why.push(words.why_not_armed[bit] ?? `unknown reason, bit ${bit}`);
    }
  }
  return why;
}

const track = (index: number): string =>
  index === 0 ? 'left track' : index === 1 ? 'right track' : `track ${index}`;

/// What words of a limit can need beside its numbers.
export interface LimitContext {
  kind: Kind;
  words: Words;
  task: Task | null;  ///< The one that runs, for its fences.
}

/// As the DBC has them, of LimitKind and of LimitIndex.
const KIND_ERROR = 30;
const KIND_NOT_AVAILABLE = 31;
const INDEX_ERROR = 254;
const INDEX_NOT_AVAILABLE = 255;

/// What an index stands for, if it is one.
function whose(what: string, index: number, words: (index: number) => string): string {
  return index === INDEX_ERROR ? `${what} in error`
    : index === INDEX_NOT_AVAILABLE ? `${what} not available` : words(index);
}

/// EcuStatus.LimitKind and LimitIndex, raw.
export function limit_words(limit: number, index: number, context: LimitContext): string {
  if (limit === KIND_ERROR || limit === KIND_NOT_AVAILABLE) {
    return limit === KIND_ERROR ? 'limit in error' : 'limit not available';
  }
  const known = LIMITS[limit];
  if (known === undefined) {
    return `unknown limit ${limit}`;
  }
  const owner = owners(context)[known.of];
  return owner === undefined ? known.text
    : `${known.text}: ${whose(owner.what, index, owner.words)}`;
}

/// By what LimitIndex may be the number of.
function owners({kind, words, task}: LimitContext):
    Partial<Record<string, {what: string; words: (index: number) => string}>> {
  return {
    pump: {what: 'pump', words: (at) => `Pump ${at + 1}`},
    drive: {what: 'drive', words: (at) => DRIVES[kind][at] ?? `drive ${at}`},
    fault: {what: 'fault', words: (at) => fault_words(words, at)},
    track: {what: 'track', words: track},
    source: {what: 'source', words: (at) => `source ${at}`},
    fence: {what: 'number', words: (at) => task?.fences[at]?.words ?? `number ${at}`},
  };
}
