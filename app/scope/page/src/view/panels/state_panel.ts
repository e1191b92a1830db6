// SPDX-License-Identifier: Apache-2.0
/// Mode, lambda with its reason, and why the controller is not armed, in words.

import {is_stale} from '../../model/integrity';
import {el, Rows, section, set_attribute, set_shown, set_text} from '../basics/dom';
import {fixed, name_words, time_words, unit_words} from '../basics/format';
import {is_live, type PageState, type View} from '../basics/page_state';
import {snapshot, type Mode, type Snapshot} from '../basics/snapshot';
import type {PageWords} from '../basics/words';

const MODE_WORDS: Readonly<Record<Mode, string>> = {
  Silent: 'Silent: inputs are missing, nothing is commanded',
  Ready: 'Ready: waits for enable',
  Armed: 'Armed: enabled, spools in neutral',
  Active: 'Active: the machine moves',
  Stopping: 'Stopping: brings the machine to rest',
  Fault: 'Fault: spools in neutral until enable is released',
};

export class StatePanel implements View {
  readonly node: HTMLElement;
  private readonly mode = el('p', {class: 'mode'});
  private readonly mode_words = el('p', {class: 'mode-words'});
  private readonly age = el('p', {class: 'quiet'});
  private readonly waits = el('p', {class: 'waits'});
  private readonly lambda = el('span', {class: 'figure'});
  private readonly bar = el('div', {class: 'lambda-bar', 'aria-hidden': 'true'});
  private readonly reason = el('p', {class: 'reason'});
  private readonly task = el('p', {class: 'task'});
  private readonly why = el('div', {class: 'why'});
  private readonly why_title = el('h3');
  private readonly list = el('ul');
  private readonly reasons = new Rows(this.list, () => ({node: el('li')}));

  constructor(private readonly words: PageWords) {
    this.why.append(this.why_title, this.list);
    this.bar.append(el('div'));
    this.node = section('state', 'Controller',
      el('div', {class: 'mode-line', role: 'status'}, this.mode, this.mode_words),
      this.age, this.waits, this.why,
      el('div', {class: 'lambda'},
        el('p', {class: 'figure-line'}, el('span', {class: 'label'}, 'lambda'), this.lambda),
        this.bar, this.reason),
      this.task);
  }

  update(state: PageState): void {
    set_shown(this.node, state.setup?.source.mode !== 'plan');
    const now = snapshot(state.store, state.playhead.now_s);
    this.node.classList.toggle('stale', now.stale || state.is_gone);
    set_text(this.mode, now.mode ?? 'Unknown');
    set_attribute(this.mode, 'data-mode', now.mode ?? 'none');
    set_text(this.mode_words, now.mode === null ? 'No word from the controller'
      : MODE_WORDS[now.mode].replace(/^\w+: /, ''));
    set_shown(this.age, (now.stale || state.is_gone) && now.mode !== null);
    set_text(this.age, state.is_gone ? 'The last that came before the server was gone.' : `Stale: EcuStatus is ${time_words(now.mode_age_s)} old`
      + `${is_live(state) ? '' : ' here'}.`);
    this.write_lambda(now);
    set_shown(this.waits, now.waits_for !== 0);
    set_text(this.waits, `Not ready yet: ${this.words.fault(now.waits_for)}`);
    this.write_task(state);
    this.write_why(now, state.store);
  }

  private write_lambda({lambda, limit_kind, limit_index, mode}: Snapshot): void {
    const valid = lambda.state === 'valid';
    set_text(this.lambda, valid ? fixed(lambda.value, 3)
      : lambda.state === 'error' ? 'error' : '–');
    const share = valid ? Math.max(0, Math.min(1, lambda.value)) : 0;
    this.bar.style.setProperty('--share', `${share * 100}%`);
    const held = limit_kind !== null && limit_kind !== 0;
    set_text(this.reason, !valid ? 'Share of the wanted velocity that is followed: not available'
      : held ? `Held by ${this.words.limit(limit_kind, limit_index)}`
        : mode === 'Active' ? 'Nothing holds it: the wanted velocity is followed whole'
          : 'No motion is followed: the controller is not active');
  }

  private write_task({store, playhead, machine}: PageState): void {
    const {words, stale} = task_line(store, playhead.now_s, machine);
    set_shown(this.task, words !== '');
    set_text(this.task, words);
    this.task.classList.toggle('stale', stale);
  }

  private write_why({why_not_armed}: Snapshot, store: PageState['store']): void {
    const stale = is_stale(store, 'EcuHealth', why_not_armed.age_s);
    this.why.classList.toggle('stale', stale);
    set_text(this.why_title, stale ? 'Why not armed (old)' : 'Why not armed');
    const bits = why_not_armed.state === 'valid' ? why_not_armed.raw : 0;
    set_shown(this.why, bits !== 0);
    const sentences = this.words.why_not_armed(bits);
    this.reasons.take(sentences.length).forEach(({node}, k) => set_text(node, sentences[k]!));
  }
}

type Machine = PageState['machine'];

/// What the operator asks for and how far it is; what is not said any more is called old.
export function task_line(
  store: PageState['store'], now_s: number, machine: Machine,
): {words: string; stale: boolean} {
  const {database} = store;
  const parts: {message: string; words: string[]}[] = [];
  if (database?.messages.has('OperatorCommand') === true) {
    const task = store.reading('OperatorCommand.Task', now_s);
    const speed = store.reading('OperatorCommand.SpeedOverride', now_s);
    const name = database.signal('OperatorCommand.Task').states.get(task.raw);
    parts.push({message: 'OperatorCommand', words: [
      `Task ${task.state === 'valid' ? name ?? task.raw : 'not chosen'}`,
      `speed ${speed.state === 'valid' ? `${fixed(speed.value, 0)} %` : 'not given'}`]});
  }
  if (database?.messages.has('TaskStatus') === true) {
    parts.push({message: 'TaskStatus', words: task_words(store, now_s, machine)});
  }
  const said = parts.filter(({words}) => words.length > 0).map(({message, words}) => {
    const rows = store.rows(message);
    const last = rows.at(now_s);
    const old = last >= 0 && is_stale(store, message, now_s - rows.time(last));
    return {words: words.join(', ') + (old ? ' (old)' : ''), old};
  });
  return {words: said.map(({words}) => words).join(', '), stale: said.some(({old}) => old)};
}

/// Which of the machine's tasks, and how far its step is.
function task_words(
  store: PageState['store'], now_s: number, machine: Machine,
): string[] {
  const number = store.reading('TaskStatus.TaskNumber', now_s);
  const step = store.reading('TaskStatus.Step', now_s);
  const kind = store.reading('TaskStatus.StepKind', now_s);
  const progress = store.reading('TaskStatus.Progress', now_s);
  if (number.state !== 'valid' || kind.raw === 0) {
    return [];
  }
  const signal = store.database!.signal('TaskStatus.StepKind');
  const name = machine?.kind === 'excavator' ? machine.tasks[number.raw]?.name : undefined;
  const words = [name ?? `task file ${number.raw}`];
  if (step.state === 'valid') {
    const step_kind = name_words(signal.states.get(kind.raw) ?? '').toLowerCase();
    words.push(`step ${step.raw + 1} (${step_kind})`);
  }
  if (progress.state === 'valid') {
    words.push(`${fixed(progress.value * 100, 0)}${unit_words(' %')} done`);
  }
  return words;
}
