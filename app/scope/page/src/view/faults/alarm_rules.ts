// SPDX-License-Identifier: Apache-2.0
/// What is wrong, as sentences: with the machine, with its plan, with the bus, with the file.

import {is_read, oldest_version} from '../../model/dbc';
import {count, hash_words} from '../basics/format';
import {is_live, type PageState} from '../basics/page_state';
import {active_codes, snapshot, type Snapshot} from '../basics/snapshot';
import type {PageWords} from '../basics/words';

export interface Alarm {
  id: string;
  /// 'alarm' for what stops the machine or hides it, 'warning' for what an engineer should know.
  level: 'alarm' | 'warning';
  words: string;
  at?: 'fault';  ///< With a jump to where it began.
}

const TASK_UNKNOWN = 37;
const POSE_UNREACHABLE = 7;
const PROGRAM = 3;  ///< OperatorCommand.Task.
const FENCE = 12;
const HELD = 0.02;  ///< Lambda at which a fence holds the machine for good.

export function alarms_of(state: PageState, words: PageWords): Alarm[] {
  return [...machine_alarms(state, words), ...source_alarms(state), ...log_alarms(state)];
}

function machine_alarms(state: PageState, words: PageWords): Alarm[] {
  const {store, playhead} = state;
  if (store.database === null) {
    return [];
  }
  const now = snapshot(store, playhead.now_s);
  const by_plan = is_plan_fault(now.fault, store, playhead.now_s);
  const alarms = plan_alarms(now, by_plan, state, words);
  const stopped = now.mode === 'Fault' || now.mode === 'Stopping';
  if (now.fault !== 0 && !by_plan) {
    alarms.push({
      id: 'fault', level: stopped ? 'alarm' : 'warning', at: 'fault',
      words: `${stopped ? 'Stopped by fault' : 'Fault'} ${now.fault}: ${words.fault(now.fault)}.`,
    });
  } else if (now.mode === 'Fault' && now.fault === 0) {
    alarms.push({id: 'fault', level: 'alarm', at: 'fault', words: 'The controller is in Fault.'});
  }
  // DM1 says up to a second late that a fault is over; EcuStatus says it at once.
  const others = now.fault === 0 ? []
    : active_codes(store, playhead.now_s).filter((code) => code !== now.fault);
  if (others.length > 0) {
    alarms.push({
      id: 'dm1', level: 'warning',
      words: 'Also active by DM1: '
        + `${others.map((code) => `${code}, ${words.fault(code)}`).join('; ')}.`,
    });
  }
  return alarms;
}

const STROKES = ['BoomStroke.BoomStroke', 'ArmStroke.ArmStroke', 'BucketStroke.BucketStroke'];

/// A pose out of reach is the plan's fault only while a plan is followed and the strokes are
/// measured: strokes that no pose has, raise the same fault.
function is_plan_fault(fault: number, store: PageState['store'], now_s: number): boolean {
  return fault === TASK_UNKNOWN || (fault === POSE_UNREACHABLE
    && store.reading('OperatorCommand.Task', now_s).raw === PROGRAM
    && STROKES.every((stroke) => store.reading(stroke, now_s).state === 'valid'));
}

/// A plan that cannot work (Zhang et al.).
function plan_alarms(
  now: Snapshot, by_plan: boolean, {machine}: PageState, words: PageWords,
): Alarm[] {
  if (by_plan) {
    return [{
      id: 'plan', level: 'alarm', at: 'fault',
      words: `This plan cannot work: ${words.fault(now.fault)} (fault ${now.fault}).`,
    }];
  }
  if (now.limit_kind === FENCE && now.mode === 'Active') {
    const held = now.lambda.state === 'valid' && now.lambda.value < HELD;
    const limit = words.limit(FENCE, now.limit_index);
    const known = machine?.kind === 'excavator' && machine.tasks.length > 0;
    return [{
      id: 'fence', level: held ? 'alarm' : 'warning',
      words: held ? `This plan cannot work, the machine is held by ${limit}.`
        : `${known ? 'Close to' : 'Slowed by'} ${limit}: the machine is slowed.`,
    }];
  }
  return [];
}

function source_alarms(state: PageState): Alarm[] {
  const alarms: Alarm[] = [];
  const {link, bus, dropped, setup, store} = state;
  if (link.state === 'lost') {
    alarms.push({id: 'link', level: 'alarm', words: link.words});
  }
  if (bus !== null && !bus.up) {
    alarms.push({id: 'bus', level: 'alarm', words: `The bus is down: ${bus.words}.`});
  }
  if (is_live(state) && link.state === 'open' && store.database !== null) {
    const {now_s, follow} = state.playhead;
    const age_s = now_s - store.until_s;
    if (follow && age_s > 1) {
      alarms.push({
        id: 'quiet', level: 'warning', words: `No frames for ${count(age_s)} s.`,
      });
    }
  }
  if (dropped > 0) {
    alarms.push({
      id: 'dropped', level: 'warning',
      words: `This page is too slow: ${count(dropped)} frame${dropped === 1 ? ' was' : 's were'} `
        + 'left out.',
    });
  }
  if (setup !== null && state.refused !== '') {
    alarms.push({id: 'refused', level: 'warning', words: `Refused: ${state.refused}`});
  }
  if (state.trouble !== '') {
    alarms.push({id: 'trouble', level: 'alarm', words: state.trouble});
  }
  return alarms;
}

function log_alarms({store, setup, machine, ended}: PageState): Alarm[] {
  const {health, database, frames} = store;
  const alarms: Alarm[] = [];
  const plan = setup?.source.mode === 'plan';
  if (health.malformed > 0 && health.malformed === health.lines) {
    alarms.push({id: 'malformed', level: 'alarm', words: 'This is no candump log'
      + `${first_line(store)}.`});
  } else if (health.malformed > 0) {
    alarms.push({
      id: 'malformed', level: 'warning',
      words: `${count(health.malformed)} line${health.malformed === 1 ? ' is' : 's are'} not `
        + `candump${first_line(store)}.`,
    });
  } else if (ended && !plan && frames === 0) {
    alarms.push({id: 'empty', level: 'alarm', words: 'This log is empty: it has no frames.'});
  } else if (ended && !plan && (database === null || health.foreign === frames)) {
    alarms.push({id: 'foreign', level: 'alarm', words: 'No frame of this log is in a DBC that '
      + 'this page has: it is not of an excavator or a dozer of ours.'});
  }
  const version = health.dbc_version;
  if (database !== null && version !== null && !is_read(database.kind, version)) {
    alarms.push({
      id: 'dbc', level: 'alarm',
      words: `Written with DBC version ${version}, this page reads versions `
        + `${oldest_version(database.kind)} to ${database.version}: values may be wrong.`,
    });
  }
  if (health.profile_hash !== null && machine === null && setup !== null) {
    alarms.push({
      id: 'profile', level: 'alarm',
      words: `No profile with hash ${hash_words(health.profile_hash)} is known here: the machine `
        + 'is not drawn; say --profile.',
    });
  }
  if (health.lost > 0) {
    alarms.push({
      id: 'lost', level: 'warning',
      words: `${count(health.lost)} frame${health.lost === 1 ? ' was' : 's were'} lost as this was recorded.`,
    });
  }
  const {first_break: first} = health;
  const mode = setup?.source.mode;
  if (first !== null && mode !== 'can' && mode !== 'sim') {
    const more = health.breaks > 1 ? `, and ${count(health.breaks - 1)} more` : '';
    alarms.push({
      id: 'break', level: 'warning',
      words: first.by_s > 0 ? `A gap of ${first.by_s.toFixed(2)} s before line ${first.line}${more}.`
        : `The log's clock goes back by ${(-first.by_s).toFixed(2)} s at line ${first.line}${more}.`,
    });
  }
  if (health.backwards > 0) {
    alarms.push({
      id: 'backwards', level: 'warning',
      words: health.backwards === 1 ? '1 frame is stamped before the one before it.'
        : `${count(health.backwards)} frames are stamped before the one before them.`,
    });
  }
  return alarms;
}

const LONGEST = 80;

function first_line({health}: PageState['store']): string {
  const first = health.first_malformed;
  if (first === null) {
    return '';
  }
  const text = first.text.length > LONGEST ? `${first.text.slice(0, LONGEST)}…` : first.text;
  return `, the first is line ${first.line}: ‘${text}’`;
}
