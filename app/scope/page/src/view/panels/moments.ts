// SPDX-License-Identifier: Apache-2.0
/// Bookmarks, and the moment in the page's address: what stands is told there, so that the address
/// is a link to it, with the window of the plots and every bookmark.

import {bookmarks_of, hash_of, moment_of, type Bookmark, type Moment} from '../../model/moment';
import {button, el, Rows, section, set_attribute, set_shown, set_text} from '../basics/dom';
import {time_words} from '../basics/format';
import {is_live, type PageState, type View} from '../basics/page_state';

interface Row {
  node: HTMLElement;
  jump: HTMLButtonElement;
  name: HTMLInputElement;
}

const SAID_MS = 4000;
/// What a live run was before this page came takes seconds to be read, an hour of it some more.
const MOST_WAIT_MS = 15_000;
/// Of an address's digits.
const ROUND_S = 1e-3;

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
  private asked_ms: number | null = null;  ///< Since when a live run's moment is waited for.
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
    const asked = moment_of(this.asked);
    if (asked === null || state.setup === null) {
      return this.opened !== null && this.opened === state.setup;
    }
    const {from_s, until_s} = state.extent;
    if (state.loaded_share === 1 && until_s > from_s && !this.waits(asked)) {
      this.opened = state.setup;
      this.asked = '';
      this.asked_ms = null;
      this.look(asked);
    }
    return true;
  }

  /// Of a live run the past comes after the setup, oldest first: a moment is not sought before it is
  /// there, as long as it may still come and nobody looks elsewhere.
  private waits(asked: Moment): boolean {
    const {playhead, extent, origin_s} = this.state;
    if (!is_live(this.state) || !playhead.follow
        || (asked.origin_s ?? origin_s) + asked.time_s <= extent.until_s + ROUND_S) {
      return false;
    }
    this.asked_ms ??= performance.now();
    return performance.now() - this.asked_ms < MOST_WAIT_MS;
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
      this.asked_ms = null;
      this.bookmarks = bookmarks_of(location.hash);
      this.changed = true;
    }
  }

  private look(moment: Moment): void {
    const {playhead, extent, origin_s: own_s} = this.state;
    const origin_s = moment.origin_s ?? own_s;
    const time_s = moment.time_s + origin_s;
    this.bookmarks = this.bookmarks.map(({time_s: at_s, name}) => ({time_s: at_s + (origin_s - own_s), name}));
    this.changed = true;
    if (is_live(this.state) && (time_s < extent.from_s - ROUND_S || time_s > extent.until_s + ROUND_S)) {
      this.say('The moment of this link is not in what is kept of this run.');
      return;  // another one would be taken for it
    }
    playhead.playing = false;
    playhead.seek(time_s);
    if (moment.window_s !== undefined) {
      playhead.window = [moment.window_s[0] + origin_s, moment.window_s[1] + origin_s];
    }
  }

  private write(): void {
    const {playhead, origin_s, extent} = this.state;
    const [from_s, until_s] = playhead.window;
    // What a live run has all of is another stretch when the link is followed.
    const whole = !is_live(this.state) && from_s <= extent.from_s && until_s >= extent.until_s;
    const hash = hash_of({time_s: playhead.now_s - origin_s,
      ...(whole || playhead.follow ? {} : {window_s: [from_s - origin_s, until_s - origin_s] as const}),
      ...(is_live(this.state) ? {origin_s} : {})},
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
    this.say(words);
    setTimeout(() => this.say(''), SAID_MS);
  }

  private say(words: string): void {
    set_text(this.said, words);
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
