/// Of a run that is over: its figures, and what held lambda for how long.

import type {Run} from '../model/api';
import {built_map} from './built_map';
import {el, section, set_shown} from './dom';
import {fixed} from './format';
import type {PageState, View} from './page_state';

export class RunPanel implements View {
  readonly node = section('run', 'Run');
  private built_for: Run | null = null;

  update({setup}: PageState): void {
    const run = setup?.run ?? null;
    set_shown(this.node, run !== null);
    if (run === null || run === this.built_for) {
      return;
    }
    this.built_for = run;
    const heading = this.node.querySelector('h2')!;
    heading.textContent = run.title === '' ? 'Run' : run.title;
    this.node.replaceChildren(heading, el('p', {class: 'subtitle'}, run.subtitle),
      ...listed('As built', built_map(run.built)), figures(run), ...(run.limits_share.length > 0 ? [el('h3', {}, 'What held lambda'),
        shares(run)] : []),
      ...(setup?.version === undefined ? [] :
        [el('p', {class: 'subtitle'}, `Graben ${setup.version}`)]));
  }
}

const listed = (title: string, node: HTMLElement | null): HTMLElement[] =>
  node === null ? [] : [el('h3', {}, title), node];

function figures(run: Run): HTMLElement {
  return el('table', {class: 'summary'},
    el('caption', {class: 'hidden'}, 'Figures of the run'),
    el('tbody', {}, ...run.summary.map(({label, value, unit, note}) => el('tr', {},
      el('th', {scope: 'row'}, label, note === '' ? null : el('span', {class: 'note'}, note)),
      el('td', {class: 'number'}, String(value)),
      el('td', {class: 'unit'}, unit)))));
}

function shares(run: Run): HTMLElement {
  return el('table', {class: 'shares'},
    el('caption', {class: 'hidden'}, 'Share of the time per limit'),
    el('tbody', {}, ...run.limits_share.map(({name, share}) => el('tr', {},
      el('th', {scope: 'row'}, name === 'none' ? 'nothing' : name),
      el('td', {class: 'number'}, `${fixed(share * 100, 1)} %`),
      el('td', {class: 'bar-cell', 'aria-hidden': 'true'},
        el('span', {class: 'bar', style: `--share: ${Math.max(0.3, share * 100)}%`}))))));
}
