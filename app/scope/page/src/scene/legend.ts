/// The scale of the cylinders' colours, in a corner of the scene.

import {pressure_gradient} from './pressure_colour';
import type {SceneColours} from './theme';

export class Legend {
  readonly node = document.createElement('div');
  private readonly numbers = document.createElement('div');
  private readonly grey = document.createElement('span');

  constructor() {
    Object.assign(this.node.style, {
      position: 'absolute', left: '12px', bottom: '10px', width: '190px', pointerEvents: 'none',
      font: '12px/1.35 system-ui, sans-serif'});
    const title = document.createElement('div');
    title.textContent = 'Cylinder pressure, MPa';
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
    this.node.append(title, bar, this.numbers, stale);
    this.show(null);
  }

  /// Null hides it: the machine's pressures are not measured.
  show(relief_pa: number | null): void {
    this.node.style.display = relief_pa === null ? 'none' : '';
    if (relief_pa === null) {
      return;
    }
    const relief = relief_pa / 1e6;
    const number = (words: string): HTMLSpanElement => {
      const span = document.createElement('span');
      span.textContent = words;
      return span;
    };
    this.numbers.replaceChildren(
      number('0'), number(`${+(relief / 2).toFixed(1)}`), number(`${+relief.toFixed(1)} (relief)`));
  }

  set_theme(colours: SceneColours): void {
    this.node.style.color = colours.text;
    this.node.style.textShadow = `0 0 3px ${colours.halo}`;
    this.grey.style.background = colours.stale;
  }
}
