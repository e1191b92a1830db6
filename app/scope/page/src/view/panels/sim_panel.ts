// SPDX-License-Identifier: Apache-2.0
/// Controls of a simulation: its pace, the operator's speed, the ground, and faults by button.
/// What is shown as on is what the server says is on, not what was clicked.

import type {SimFault, SimSetup, SimState, ToServer} from '../../model/api';
import {button, el, section, set_attribute, set_shown, set_text} from '../basics/dom';
import {fixed} from '../basics/format';
import type {PageState, View} from '../basics/page_state';

const PACES = [0.1, 0.25, 0.5, 1, 2, 5, 10];

export class SimPanel implements View {
  readonly node: HTMLElement;
  private readonly controls = el('div', {class: 'sim-controls'});
  private readonly refused = el('p', {class: 'refused', role: 'status'});
  private built_for: SimSetup | null = null;
  private said: SimState | null = null;
  private said_refused = '';
  /// `said`: the server had a word since the last time, and what was clicked gives way to it.
  private refresh: (state: SimState, said: boolean) => void = () => undefined;

  constructor(private readonly send: (message: ToServer) => void) {
    this.node = section('sim', 'Simulation', this.controls, this.refused);
  }

  update({setup, sim, refused, link}: PageState): void {
    const own = setup?.source.mode === 'sim' ? setup.sim ?? null : null;
    set_shown(this.node, own !== null);
    if (own === null) {
      return;
    }
    if (own !== this.built_for) {
      this.built_for = own;
      this.build(own);
    }
    for (const node of this.controls.querySelectorAll<HTMLButtonElement>('button, input, select')) {
      node.disabled = link.state !== 'open' || sim === null;
    }
    if (sim !== null) {
      const said = sim !== this.said || refused !== this.said_refused;
      this.said = sim;
      this.said_refused = refused;
      this.refresh(sim, said);
    }
    set_shown(this.refused, refused !== '');
    set_text(this.refused, `Refused: ${refused}`);
  }

  private build(sim: SimSetup): void {
    const run = button('Start', () =>
      this.send({do: run.dataset.running === 'true' ? 'stop' : 'run'}), {class: 'primary'});
    const pace = el('select', {id: 'sim-pace'},
      ...PACES.map((value) => el('option', {value}, `${value} x real time`)));
    pace.addEventListener('change', () => this.send({do: 'pace', value: Number(pace.value)}));
    const speed = new SpeedSlider((value) => this.send({do: 'speed', value}));
    const soil = switch_of('Soil', (value) => this.send({do: 'soil', value}));
    const obstacle = switch_of('Obstacle', (value) => this.send({do: 'obstacle', value}));
    const faults = sim.faults.map((fault) => new FaultButton(fault, (value) =>
      this.send({do: 'fault', id: fault.id, value})));
    this.controls.replaceChildren(
      el('div', {class: 'row'}, run, button('Restart', () => this.send({do: 'restart'}))),
      el('div', {class: 'field'}, el('label', {for: 'sim-pace'}, 'Pace'), pace),
      speed.node,
      el('div', {class: 'row'}, sim.can.soil ? soil : null, sim.can.obstacle ? obstacle : null),
      el('h3', {}, 'Faults to inject'),
      button('Take all faults back and re-arm', () => this.send({do: 'clear'}), {class: 'wide'}),
      el('ul', {class: 'fault-buttons'}, ...faults.map(({node}) => node)));
    this.refresh = (state, said) => {
      run.dataset.running = String(state.running);
      set_text(run, state.running ? 'Stop' : 'Start');
      if (said || document.activeElement !== pace) {
        show_pace(pace, state.pace);
      }
      speed.show(state.speed);
      set_attribute(soil, 'aria-pressed', String(state.soil));
      set_attribute(obstacle, 'aria-pressed', String(state.obstacle));
      for (const fault of faults) {
        fault.show(state.faults);
      }
    };
  }
}

function show_pace(select: HTMLSelectElement, pace: number): void {
  const words = String(pace);
  if (![...select.options].some(({value}) => value === words)) {
    select.append(el('option', {value: words}, `${fixed(pace, 2)} x real time`));
  }
  if (select.value !== words) {
    select.value = words;
  }
}

function switch_of(words: string, set: (on: boolean) => void): HTMLButtonElement {
  const node = button(words, () => set(node.getAttribute('aria-pressed') !== 'true'),
    {class: 'switch', 'aria-pressed': 'false'});
  return node;
}

class SpeedSlider {
  readonly node: HTMLElement;
  private readonly input = el('input', {
    type: 'range', min: 5, max: 100, step: 5, id: 'sim-speed',
  });
  private readonly value = el('output', {for: 'sim-speed'});

  constructor(set: (share: number) => void) {
    this.node = el('div', {class: 'field'},
      el('label', {for: 'sim-speed'}, 'Speed override'), this.input, this.value);
    this.input.addEventListener('input', () => set_text(this.value, `${this.input.value} %`));
    this.input.addEventListener('change', () => set(Number(this.input.value) / 100));
  }

  show(share: number): void {
    if (document.activeElement !== this.input || !this.input.matches(':active')) {
      this.input.value = String(Math.round(share * 100));
      set_text(this.value, `${fixed(share * 100, 0)} %`);
    }
  }
}

class FaultButton {
  readonly node: HTMLElement;
  private readonly press: HTMLButtonElement;

  constructor(private readonly fault: SimFault, set: (on: boolean) => void) {
    const reaction = `reaction-${fault.id}`;
    this.press = button('', () => set(fault.once
      || this.press.getAttribute('aria-pressed') !== 'true'), {
      class: 'fault-button', 'data-fault': fault.id, 'aria-describedby': reaction,
      ...(fault.once ? {} : {'aria-pressed': 'false'}),
    });
    this.press.append(el('span', {class: 'code'}, String(fault.number)),
      el('span', {class: 'words'}, fault.words),
      el('span', {class: 'reaction', id: reaction},
        `${fault.once ? 'Once. ' : ''}Expected: ${fault.reaction}`));
    this.node = el('li', {}, this.press);
  }

  show(on: readonly string[]): void {
    if (!this.fault.once) {
      set_attribute(this.press, 'aria-pressed', String(on.includes(this.fault.id)));
    }
  }
}
