// SPDX-License-Identifier: Apache-2.0
/// A log from this computer: dropped on the page or chosen. Nothing is sent anywhere.

import {button, el, set_shown} from '../basics/dom';
import {is_live, type PageState, type View} from '../basics/page_state';

export class FileOpener implements View {
  readonly node = el('div', {class: 'files'});
  private readonly input = el('input', {
    type: 'file', accept: '.log,.gz,.txt,.candump', hidden: true, 'aria-label': 'Log file',
  });
  private readonly veil = el('div', {class: 'drop-veil', hidden: true},
    el('p', {}, 'Drop a candump log to show it'));
  private allowed = false;

  constructor(private readonly open: (file: File) => void) {
    this.node.append(button('Open log …', () => this.input.click(), {class: 'quiet-button'}),
      this.input);
    document.body.append(this.veil);
    this.input.addEventListener('change', () => {
      const file = this.input.files?.[0];
      if (file !== undefined) {
        this.open(file);
      }
      this.input.value = '';
    });
    this.listen();
  }

  /// A live page shows what is live, until its server is gone.
  update(state: PageState): void {
    this.allowed = !is_live(state) || state.link.state === 'lost';
    set_shown(this.node, this.allowed);
  }

  private listen(): void {
    const has_file = (event: DragEvent) =>
      this.allowed && (event.dataTransfer?.types.includes('Files') ?? false);
    addEventListener('dragover', (event) => {
      if (has_file(event)) {
        event.preventDefault();
        set_shown(this.veil, true);
      }
    });
    addEventListener('dragleave', (event) => {
      if (event.relatedTarget === null) {
        set_shown(this.veil, false);
      }
    });
    addEventListener('drop', (event) => {
      set_shown(this.veil, false);
      const file = event.dataTransfer?.files[0];
      if (has_file(event)) {
        event.preventDefault();
        if (file !== undefined) {
          this.open(file);
        }
      }
    });
  }
}
