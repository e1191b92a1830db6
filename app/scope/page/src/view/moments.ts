// SPDX-License-Identifier: Apache-2.0
/// Bookmarks, and the moment in the page's address: what stands is told there, so that the address
/// is a link to it, with the window of the plots and every bookmark.

import {bookmarks_of, hash_of, moment_of, type Bookmark} from '../model/moment';
import {button, el, Rows, section, set_attribute, set_shown, set_text} from './dom';
import {time_words} from './format';
import type {PageState, View} from './page_state';

interface Row {
  node: HTMLElement;
  jump: HTMLButtonElement;
  name: HTMLInputElement;
}

const SAID_MS = 4000;

export class Moments implements View {
  readonly node: HTMLElement;
  private readonly list = el('ul', {class: 'bookmarks'});
  private readonly rows = new Rows<Row>(this.list, () => this.make());
  private readonly none = el('p', {class: 'quiet'}, 'None yet: b marks the moment that is shown.');
  private readonly said = el('p', {class: 'quiet', role: 'status'});
  private bookmarks: Bookmark[] = bookmarks_of(location.hash);
  private opened: unknown = null;
  private written = location.hash;
  /// The address that somebody gave, until it has been followed: what the page itself writes there
  /// is no wish.
  private asked = location.hash;
  private changed = true;

  constructor(private readonly state: PageState) {
    this.node = section('bookmarks', 'Bookmarks',
      el('div', {class: 'row'},
        button('Mark this moment', () => this.mark(), {title: 'Bookmark what is shown (b)'}),
        button('Copy link', () => void this.copy(), {title: 'A link to this moment'})),
      this.said, this.none, this.list);
    addEventListener('hashchange', () => this.follow());
  }

  mark(): void {
    const {playhead, origin_s} = this.state;
    this.bookmarks.push({time_s: playhead.now_s - origin_s, name: ''});
    this.bookmarks.sort((a, b) => a.time_s - b.time_s);
    this.changed = true;
    this.write();
  }

  /// Whether the address tells where the source is looked at; once all of it is there, it is.
  opens(state: PageState): boolean {
    if (moment_of(this.asked) === null || state.setup === null) {
      return this.opened !== null && this.opened === state.setup;
    }
    const {from_s, until_s} = state.extent;
    if (state.loaded_share === 1 && until_s > from_s) {
      this.opened = state.setup;
      this.look(this.asked);
      this.asked = '';
    }
    return true;
  }

  update(state: PageState): void {
    const {playhead} = state;
    const followed = moment_of(this.asked) === null;
    if (followed && state.loaded_share === 1 && !playhead.playing && !playhead.follow) {
      this.write();
    }
    if (this.changed) {
      this.changed = false;
      this.show();
    }
  }

  /// Another address was given to a page that is open.
  private follow(): void {
    if (location.hash !== this.written && moment_of(location.hash) !== null) {
      this.written = location.hash;
      this.asked = location.hash;
      this.bookmarks = bookmarks_of(location.hash);
      this.changed = true;
    }
  }

  private look(hash: string): void {
    const {playhead, origin_s} = this.state;
    const moment = moment_of(hash)!;
    playhead.playing = false;
    playhead.seek(moment.time_s + origin_s);
    if (moment.window_s !== undefined) {
      playhead.window = [moment.window_s[0] + origin_s, moment.window_s[1] + origin_s];
    }
  }

  private write(): void {
    const {playhead, origin_s, extent} = this.state;
    const [from_s, until_s] = playhead.window;
    const whole = from_s <= extent.from_s && until_s >= extent.until_s;
    const hash = hash_of({time_s: playhead.now_s - origin_s,
      ...(whole || playhead.follow ? {} : {window_s: [from_s - origin_s, until_s - origin_s] as const})},
    this.bookmarks);
    if (hash !== this.written) {
      this.written = hash;
      history.replaceState(null, '', hash);
    }
  }

  private async copy(): Promise<void> {
    this.write();
    let words = 'The link is in the clipboard.';
    try {
      await navigator.clipboard.writeText(location.href);
    } catch {
      words = "The link is the page's address.";
    }
    set_text(this.said, words);
    setTimeout(() => set_text(this.said, ''), SAID_MS);
  }

  private show(): void {
    set_shown(this.none, this.bookmarks.length === 0);
    this.rows.take(this.bookmarks.length).forEach(({node, jump, name}, k) => {
      const {time_s, name: said} = this.bookmarks[k]!;
      set_attribute(node, 'data-place', k);
      set_text(jump, time_words(time_s));
      name.value = said;
      set_attribute(name, 'aria-label', `Name of the bookmark at ${time_words(time_s)}`);
    });
  }

  private make(): Row {
    const at = (): number => Number(node.dataset.place);
    const jump = button('', () => {
      const {playhead, origin_s} = this.state;
      playhead.playing = false;
      playhead.seek(this.bookmarks[at()]!.time_s + origin_s);
    }, {class: 'jump', title: 'Show this moment'});
    const name = el('input', {type: 'text', maxlength: 80, placeholder: 'name'});
    name.addEventListener('change', () => {
      this.bookmarks[at()]!.name = name.value.trim();
      this.write();
    });
    const node = el('li', {}, jump, name, button('Remove', () => {
      this.bookmarks.splice(at(), 1);
      this.changed = true;
      this.write();
    }));
    return {node, jump, name};
  }
}
