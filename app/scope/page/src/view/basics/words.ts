// SPDX-License-Identifier: Apache-2.0
/// The words of numbers that frames carry, as the page knows them just then.

import {fault_words, limit_words, why_not_armed} from '../../model/words';
import type {Task} from '../../model/api';
import type {PageState} from './page_state';

export interface PageWords {
  fault(code: number): string;
  limit(kind: number, index: number): string;
  why_not_armed(bits: number): string[];
}

const NO_WORDS = {fault: {}, why_not_armed: []};

export function page_words(state: PageState): PageWords {
  const words = () => state.setup?.words ?? NO_WORDS;
  return {
    fault: (code) => fault_words(words(), code),
    limit: (kind, index) => limit_words(kind, index, {
      kind: state.machine?.kind ?? state.store.database?.kind ?? 'excavator', words: words(),
      task: running_task(state),
    }),
    why_not_armed: (bits) => why_not_armed(words(), bits).map(sentence),
  };
}

/// Its fences have words of their own.
function running_task({machine, store, playhead}: PageState): Task | null {
  if (machine?.kind !== 'excavator' || store.database === null) {
    return null;
  }
  const number = store.reading('TaskStatus.TaskNumber', playhead.now_s);
  return number.state === 'valid' ? machine.tasks[number.raw] ?? null : null;
}

function sentence(words: string): string {
  const whole = words.charAt(0).toUpperCase() + words.slice(1);
  return /[.!?]$/.test(whole) ? whole : `${whole}.`;
}
