/// Numbers on the bus in words. What the controller itself has words for comes with the setup; the
/// limits are worded as its own reports do (app/cli/limit_words.cpp).

import type {Database, Kind, LogHealth, Machine, Task, Words} from './api';

const DRIVES: Readonly<Record<Kind, readonly string[]>> =
  {excavator: ['boom', 'arm', 'bucket', 'swing'], dozer: ['blade']};

const MODES = ['silent: inputs are missing', 'ready: enable is not given', 'armed: no task',
  'active: follows the task', 'stopping', 'fault: neutral until enable is given afresh'];

const STEPS = ['none', 'approach', 'dig', 'lift', 'swing', 'dump', 'return', 'done'];

/// EcuStatus.Mode.
export const mode_words = (mode: number): string => MODES[mode] ?? `unknown mode ${mode}`;

/// TaskStatus.StepKind.
export const step_words = (kind: number): string => STEPS[kind] ?? `unknown step ${kind}`;

/// EcuStatus.Fault.
export const fault_words = (words: Words, code: number): string =>
  words.fault[code] ?? `unknown fault ${code}`;

/// EcuHealth.WhyNotArmed: a sentence for each bit.
export function why_not_armed(words: Words, bits: number): string[] {
  const why: string[] = [];
  for (let bit = 0; bit < 16; ++bit) {
    if ((bits >> bit) & 1) {
      why.push(words.why_not_armed[bit] ?? `unknown reason, bit ${bit}`);
    }
  }
  return why;
}

/// What words of a limit can need beside its numbers.
export interface LimitContext {
  kind: Kind;
  words: Words;
  task: Task | null;  ///< The one that runs, for its fences.
}

/// EcuStatus.LimitKind and LimitIndex.
export function limit_words(limit: number, index: number, context: LimitContext): string {
  const drive = DRIVES[context.kind][index] ?? `drive ${index}`;
  switch (limit) {
    case 0: return 'none';
    case 1: return `pump flow: Pump ${index + 1}`;
    case 2: return `back flow: ${drive}`;
    case 3: return `spool travel: ${drive}`;
    case 4: return `stroke end: ${drive}`;
    case 5: return 'rise of lambda';
    case 6: return `slowed: ${fault_words(context.words, index)}`;
    case 7: return 'implement flow';
    case 8: return `transmission flow: ${index === 0 ? 'left' : 'right'} track`;
    case 9: return 'what lies ahead';
    case 10: return 'off the grade';
    case 11: return 'swing end';
    case 12: return `fence: ${context.task?.fences[index]?.words ?? `number ${index}`}`;
    case 13: return 'behind the plan';
    default: return `unknown limit ${limit}`;
  }
}

const hex = (hash: number): string => hash.toString(16).toUpperCase().padStart(8, '0');

/// What a user has to know of where the frames come from before trusting what is shown; none if
/// all is well. `loading` keeps back what only the end of a log can tell.
export function health_words(health: LogHealth, database: Database | null,
                             machines: readonly Machine[], loading: boolean): string[] {
  const words: string[] = [];
  const {malformed, first_malformed, dbc_version, profile_hash} = health;
  if (malformed > 0 && first_malformed !== null) {
    words.push(`${counted(malformed, 'line')} of ${health.lines} could not be read; the first is ` +
      `line ${first_malformed.line}: ${first_malformed.text}`);
  }
  if (database === null && !loading && health.lines > 0) {
    words.push('no frame of an excavator or a dozer is in it');
  }
  if (database !== null && dbc_version !== null && dbc_version !== database.version) {
    words.push(`the sender has version ${dbc_version} of ${database.kind}.dbc, this page has ` +
      `version ${database.version}: values may be wrong`);
  }
  const known = machines.some((machine) => machine.hash === profile_hash);
  if (profile_hash !== null && !known) {
    words.push(`the machine's profile (hash ${hex(profile_hash)}) is none that this page knows: ` +
      'its shape may be wrong');
  }
  if (health.backwards > 0) {
    words.push(`${counted(health.backwards, 'stamp')} went back: small steps are levelled out, ` +
      'before a large one all is forgotten');
  }
  return words;
}

const counted = (count: number, what: string): string => `${count} ${what}${count === 1 ? '' : 's'}`;
