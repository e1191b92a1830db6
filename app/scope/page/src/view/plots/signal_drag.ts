// SPDX-License-Identifier: Apache-2.0
/// A signal on its way into a plot: dragged, or by the keyboard through a list of the plots.

import {button, el} from '../basics/dom';
import {SIGNAL_TYPE, signal_words} from './own_lines';

export function drag_from(node: HTMLElement, signal: string): void {
  node.draggable = true;
  node.addEventListener('dragstart', (event) => {
    event.dataTransfer?.setData(SIGNAL_TYPE, signal);
    event.dataTransfer?.setData('text/plain', signal);
  });
}

/// Whoever is inside takes it first.
export function take_drops(node: HTMLElement, take: (signal: string) => void): void {
  const has = (event: DragEvent): boolean => event.dataTransfer?.types.includes(SIGNAL_TYPE) ?? false;
  const mark = (on: boolean) => node.classList.toggle('takes-drop', on);
  node.addEventListener('dragover', (event) => {
    if (has(event)) {
      event.preventDefault();
      event.stopPropagation();
      mark(true);
    }
  });
  node.addEventListener('dragleave', () => mark(false));
  node.addEventListener('drop', (event) => {
    mark(false);
    if (has(event)) {
      event.preventDefault();
      event.stopPropagation();
      take(event.dataTransfer!.getData(SIGNAL_TYPE));
    }
  });
}

export interface Plotter {
  plots(): readonly {name: string; title: string}[];
  /// `plot` null: a new one.
  put(signal: string, plot: string | null): void;
}

/// One for the whole page: which plot is a signal to go into?
export class PlotChooser {
  private readonly title = el('h2', {id: 'chooser-title'});
  private readonly list = el('div', {class: 'chooser-list'});
  private readonly dialog = el('dialog', {class: 'help', 'aria-labelledby': 'chooser-title'},
    this.title, this.list, el('div', {class: 'row'},
      button('Cancel', () => this.dialog.close())));

  constructor(private readonly plotter: Plotter) {
    document.body.append(this.dialog);
  }

  choose(signal: string): void {
    this.title.textContent = `Plot ${signal_words(signal)} in`;
    const to = (name: string | null, words: string): HTMLButtonElement => button(words, () => {
      this.dialog.close();
      this.plotter.put(signal, name);
    });
    this.list.replaceChildren(to(null, 'A new plot'),
      ...this.plotter.plots().map(({name, title}) => to(name, title)));
    this.dialog.showModal();
  }
}
