// SPDX-License-Identifier: Apache-2.0
/// How the controller's process fares, and what it says that it is.

import type {Reading} from '../../model/api';
import {is_stale} from '../../model/integrity';
import {el, section, set_shown, set_text} from '../basics/dom';
import {count, fixed, hash_words} from '../basics/format';
import type {PageState, View} from '../basics/page_state';

const SATURATED = 250;
const ALLOCATIONS_SATURATED = 13;

interface Fact {
  row: HTMLElement;
  value: HTMLElement;
  signal: string;
  words(reading: Reading, state: PageState): string;
  wrong(reading: Reading): boolean;
}

const counted = (reading: Reading) =>
  reading.raw >= SATURATED ? `${SATURATED} or more` : count(reading.value);
const allocated = (reading: Reading) =>
  reading.raw >= ALLOCATIONS_SATURATED ? `${ALLOCATIONS_SATURATED} or more` : count(reading.value);
const some = (reading: Reading) => reading.state === 'valid' && reading.raw > 0;
const never = () => false;

/// EcuChecks.Result and .Touch.
const RESULTS = ['no mark', 'not checked since the start', 'passed', 'missed: nothing arms'];
const TOUCHES = ['none', 'taken', 'refused: the tool was not still', 'refused: not in Manual',
  'refused: where the tool is was not known'];
const MISSED = 3;
const TAKEN = 1;
const minutes = (reading: Reading) =>
  (reading.state === 'valid' ? `${fixed(reading.value, 0)} min` : '–');
const millimetres = (reading: Reading) =>
  (reading.state === 'valid' ? `${fixed(reading.value, 0)} mm` : '–');

type Row = readonly [string, string, Fact['words'], Fact['wrong']];

const ROWS: readonly Row[] = [
  ['Real-time priority and memory lock', 'EcuHealth.RealTime',
    (reading) => (reading.raw === 1 ? 'on' : 'off'), (reading) => reading.raw === 0],
  ['Heap allocations since the first cycle', 'EcuHealth.Allocations', allocated, some],
  ['Stand-ins for what the bus lacks', 'EcuHealth.StandIn',
    (reading) => (reading.raw === 1 ? 'in use' : 'none'), (reading) => reading.raw === 1],
  ['Page faults since the first cycle', 'EcuHealth.PageFaults', counted, some],
  ['Late cycles', 'EcuHealth.Overruns', counted, some],
  ['Frames the bus did not take', 'EcuHealth.DroppedFrames', counted, some],
  ['Frames rejected', 'EcuStatus.RejectedFrames', counted, some],
  ['Last cycle', 'EcuStatus.CycleTime', (reading) =>
    (reading.value === 0 ? 'not measured: simulated time'
      : `${fixed(reading.value, 0)} µs`), never],
  ['Tool at its mark', 'EcuChecks.Result',
    (reading) => RESULTS[reading.raw] ?? '–', (reading) => reading.raw === MISSED],
  ['Age of that check', 'EcuChecks.Age', minutes, never],
  ['Shown off the mark, outwards', 'EcuChecks.OffOutwards', millimetres, never],
  ['The same, to the left', 'EcuChecks.OffAcross', millimetres, never],
  ['The same, upwards', 'EcuChecks.OffUp', millimetres, never],
  ['Last touch of the mark', 'EcuChecks.Touch',
    (reading) => TOUCHES[reading.raw] ?? '–', (reading) => reading.raw > TAKEN],
  ['Profile', 'EcuIdentity.ProfileHash', (reading, {machine}) => machine?.hash === reading.raw
    ? `${machine.name} (${hash_words(reading.raw)})` : hash_words(reading.raw), never],
  ['DBC version of the controller', 'EcuIdentity.DbcVersion',
    (reading) => count(reading.value), never],
  ['DBC version of the machine', 'MachineIdentity.DbcVersion',
    (reading) => count(reading.value), never],
];

export class HealthPanel implements View {
  readonly node: HTMLElement;
  private readonly facts: Fact[];
  private readonly page = el('dd');
  private readonly estimate = el('p', {class: 'note'}, 'No frame tells a stroke. The machine is drawn by what this '
    + "page makes of the IMUs' frames: some centimetres off at the teeth. The controller's own angles are better, and "
    + 'not on the bus.');

  constructor() {
    const list = el('dl', {class: 'facts'});
    this.facts = ROWS.map(([label, signal, words, wrong]) => {
      const value = el('dd');
      const row = el('div', {}, el('dt', {}, label), value);
      list.append(row);
      return {row, value, signal, words, wrong};
    });
    list.append(el('div', {}, el('dt', {}, 'DBC version of this page'), this.page));
    this.node = section('health', 'Health and identity', list, this.estimate);
  }

  update(state: PageState): void {
    const {store, playhead} = state;
    set_shown(this.node, state.setup?.source.mode !== 'plan');
    const database = store.database;
    set_shown(this.estimate, store.is_estimate('BoomStroke'));
    set_text(this.page, database === null ? '–' : `${database.version} (${database.kind})`);
    for (const {row, value, signal, words, wrong} of this.facts) {
      const known = database?.messages.has(signal.split('.')[0]!) ?? false;
      set_shown(row, known);
      if (!known) {
        continue;
      }
      const reading = store.reading(signal, playhead.now_s);
      set_text(value, reading.state === 'valid' ? words(reading, state)
        : reading.state === 'error' ? 'error'
          : reading.state === 'notAvailable' ? 'not available' : 'not received');
      row.classList.toggle('wrong', reading.state === 'valid' && wrong(reading));
      row.classList.toggle('stale', is_stale(store, signal.split('.')[0]!, reading.age_s));
    }
  }
}
