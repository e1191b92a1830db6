/// Numbers on the bus in words. What the controller itself has words for comes with the setup; the
/// limits are worded as its own reports do (app/runs/limit_text.cpp).

import type {Kind, Task, Words} from './api';

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
const KIND_ERROR = 14;
const KIND_NOT_AVAILABLE = 15;
const INDEX_ERROR = 254;
const INDEX_NOT_AVAILABLE = 255;

/// What an index stands for, if it is one.
function whose(what: string, index: number, words: (index: number) => string): string {
  return index === INDEX_ERROR ? `${what} in error`
    : index === INDEX_NOT_AVAILABLE ? `${what} not available` : words(index);
}

/// EcuStatus.LimitKind and LimitIndex, raw.
export function limit_words(limit: number, index: number, context: LimitContext): string {
  const drive = whose('drive', index, (at) => DRIVES[context.kind][at] ?? `drive ${at}`);
  switch (limit) {
    case 0: return 'none';
    case 1: return `pump flow: ${whose('pump', index, (at) => `Pump ${at + 1}`)}`;
    case 2: return `back flow: ${drive}`;
    case 3: return `spool travel: ${drive}`;
    case 4: return `stroke end: ${drive}`;
    case 5: return 'rise of lambda';
    case 6: return `slowed: ${whose('fault', index, (at) => fault_words(context.words, at))}`;
    case 7: return 'implement flow';
    case 8: return `transmission flow: ${whose('track', index, track)}`;
    case 9: return 'what lies ahead';
    case 10: return 'off the grade';
    case 11: return 'swing end';
    case 12: return `fence: ${whose('number', index, (at) =>
      context.task?.fences[at]?.words ?? `number ${at}`)}`;
    case 13: return 'behind the plan';
    case KIND_ERROR: return 'limit in error';
    case KIND_NOT_AVAILABLE: return 'limit not available';
    default: return `unknown limit ${limit}`;
  }
}
