// SPDX-License-Identifier: Apache-2.0
/// The scale of the cylinders' colours, in a corner of the scene.

import {pressure_gradient} from './theme';
import type {SceneColours} from './theme';

export class Legend {
  readonly node = document.createElement('div');
  private readonly scale = document.createElement('div');
  private readonly numbers = document.createElement('div');
  private readonly grey = document.createElement('span');
  private readonly none = document.createElement('div');

  constructor() {
    Object.assign(this.node.style, {minWidth: '190px'});
    const title = document.createElement('div');
    title.textContent = 'Cylinder pressure, MPa (bar)';
    const bar = document.createElement('div');
    Object.assign(bar.style, {
      height: '9px', background: pressure_gradient(), border: '1px solid currentColor',
      boxSizing: 'border-box'});
    Object.assign(this.numbers.style, {display: 'flex', justifyContent: 'space-between'});
    const stale = document.createElement('div');
    Object.assign(this.grey.style, {
      display: 'inline-block', width: '12px', height: '9px', marginRight: '5px',
      border: '1px solid currentColor', boxSizing: 'border-box'});
    stale.append(this.grey, 'old or not available');
    this.none.textContent = 'no cylinder pressures on this bus';
    this.scale.append(title, bar, this.numbers);
    this.node.append(this.scale, this.none, stale);
    this.hide();
  }

  /// No machine is shown.
  hide(): void {
    this.node.style.display = 'none';
  }

  /// Null: the machine's pressures are not measured.
  show(relief_pa: number | null): void {
    this.node.style.display = '';
    this.scale.style.display = relief_pa === null ? 'none' : '';
    this.none.style.display = relief_pa === null ? '' : 'none';
    if (relief_pa === null) {
      return;
    }
    const relief = relief_pa / 1e6;
    const number = (words: string): HTMLSpanElement => {
      const span = document.createElement('span');
      span.textContent = words;
      return span;
    };
    const both = (mpa: number): string => `${+mpa.toFixed(1)} (${Math.round(10 * mpa)})`;
    this.numbers.replaceChildren(
      number('0'), number(both(relief / 2)), number(`${both(relief)} relief`));
  }

  set_theme(colours: SceneColours): void {
    this.grey.style.background = colours.stale;
  }
}
