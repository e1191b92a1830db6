// SPDX-License-Identifier: Apache-2.0
/// The one word that is read from afar, and the sentence under it.

import {alarms_of} from '../view/faults/alarm_rules';
import {count, time_words} from '../view/basics/format';
import {is_live, type PageState} from '../view/basics/page_state';
import {snapshot, type Mode} from '../view/basics/snapshot';
import type {PageWords} from '../view/basics/words';
import {assist_words} from './assist';

export interface BigState {
  word: string;
  mode: Mode | 'None';
  more: string;
}

const MODE_WORDS: Readonly<Record<Mode, string>> = {
  Silent: 'Nothing is commanded: inputs are missing',
  Ready: 'Waits for enable',
  Armed: 'Enabled, spools in neutral',
  Active: 'The machine moves by itself',
  Stopping: 'Brings the machine to rest',
  Fault: 'Spools in neutral until enable is released',
};

/// What no machine does now, though it looks so. Null: what is shown comes from a bus.
export function not_live(setup: PageState['setup']): {kind: string; of: string} | null {
  if (setup === null || setup.source.mode === 'can') {
    return null;
  }
  return setup.source.mode === 'sim' ? {kind: 'Simulation', of: setup.sim?.task ?? setup.source.name}
    : {kind: 'Replay', of: setup.source.name};
}

/// What is old is never called a state of now.
export function big_state(state: PageState, words: PageWords): BigState {
  const {store, playhead} = state;
  if (state.link.state === 'lost' && playhead.follow) {
    return {word: 'No server', mode: 'None', more: 'What is shown is what came before'};
  }
  if (store.frames === 0 || store.database === null) {
    const reading = state.setup?.source.mode === 'log' && state.loaded_share < 1;
    return {word: reading ? 'Reading' : 'No frames', mode: 'None',
      more: reading ? `${count(state.loaded_share * 100)} % of the log` : state.link.words};
  }
  const now = snapshot(store, playhead.now_s);
  if (now.mode === null || now.stale) {
    const old = Number.isFinite(now.mode_age_s)
      ? `Its last word is ${time_words(now.mode_age_s, 1)} old` : 'It has not said a word';
    return {word: 'No controller', mode: 'None', more: loud(state, words) ?? old};
  }
  if (now.mode === 'Fault' || now.fault !== 0) {
    const word = now.mode !== 'Fault' ? now.mode : now.fault === 0 ? 'Fault' : `Fault ${now.fault}`;
    return {word, mode: now.mode,
      more: now.fault === 0 ? MODE_WORDS[now.mode] : sentence(words.fault(now.fault))};
  }
  const assist = now.mode === 'Active' ? assist_words(store, playhead.now_s) : null;
  const more = loud(state, words) ?? assist
    ?? (now.waits_for !== 0 ? `Not ready yet: ${words.fault(now.waits_for)}` : MODE_WORDS[now.mode]);
  return {word: now.mode, mode: now.mode, more};
}

/// What hides the machine, or makes what is shown of it wrong.
function loud(state: PageState, words: PageWords): string | null {
  const own = new Set(['fault', 'link']);
  return alarms_of(state, words).find(({id, level}) => level === 'alarm' && !own.has(id))?.words ?? null;
}

const sentence = (words: string): string => words.charAt(0).toUpperCase() + words.slice(1);

/// Why the machine is not working, item by item; empty when nothing is missing. Null: not known now.
export function missing(state: PageState, words: PageWords): readonly string[] | null {
  const {store, playhead} = state;
  const now = snapshot(store, playhead.now_s);
  const told = now.why_not_armed;
  const old = told.state !== 'valid' || told.age_s > MOST_AGE_S
    || (is_live(state) && state.link.state === 'lost');
  return old ? null : words.why_not_armed(told.raw);
}

/// EcuHealth comes once a second.
const MOST_AGE_S = 3;
