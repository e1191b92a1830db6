// SPDX-License-Identifier: Apache-2.0
/// A moment of a log in the page's address: `#t=12.345`, with `&w=10.5,20` the window of the plots,
/// and with `&b=7.2 pump stalls` a bookmark, as many as there are. Seconds from the first frame, whose
/// stamp a live run's address tells with `&o=1700000000.25`: a page that comes later gets others first.

export interface Moment {
  time_s: number;
  window_s?: readonly [number, number];
  origin_s?: number;  ///< What the others are counted from, where it is told.
}

export interface Bookmark {
  time_s: number;
  name: string;
}

/// An address that somebody has tampered with fills no page.
const MOST_BOOKMARKS = 100;
const LONGEST_NAME = 80;

const told_in = (hash: string): URLSearchParams => new URLSearchParams(hash.replace(/^#/, ''));

/// Null where the address tells none, or nothing that is one.
export function moment_of(hash: string): Moment | null {
  const told = told_in(hash);
  const time_s = number_of(told.get('t'));
  if (time_s === null) {
    return null;
  }
  const [from, until, ...more] = (told.get('w') ?? '').split(',').map(number_of);
  const origin_s = number_of(told.get('o'));
  return {time_s,
    ...(from != null && until != null && more.length === 0 && until > from ? {window_s: [from, until]} : {}),
    ...(origin_s === null ? {} : {origin_s})};
}

/// In the order of time.
export function bookmarks_of(hash: string): Bookmark[] {
  const found = told_in(hash).getAll('b').slice(0, MOST_BOOKMARKS).flatMap((text): Bookmark[] => {
    const [, time = '', name = ''] = /^(\S*) ?(.*)$/s.exec(text) ?? [];
    const time_s = number_of(time);
    return time_s === null ? [] : [{time_s, name: name.slice(0, LONGEST_NAME)}];
  });
  return found.sort((a, b) => a.time_s - b.time_s);
}

/// '' where there is nothing to tell.
export function hash_of(moment: Moment | null, bookmarks: readonly Bookmark[] = []): string {
  const words = (value: number): string => String(Number(value.toFixed(4)));
  const told = new URLSearchParams();
  if (moment !== null) {
    told.set('t', words(moment.time_s));
    if (moment.window_s !== undefined) {
      told.set('w', moment.window_s.map(words).join());
    }
    if (moment.origin_s !== undefined) {
      told.set('o', words(moment.origin_s));
    }
  }
  for (const {time_s, name} of bookmarks) {
    told.append('b', name === '' ? words(time_s) : `${words(time_s)} ${name.slice(0, LONGEST_NAME)}`);
  }
  const text = told.toString().replace(/%2C/g, ',');
  return text === '' ? '' : `#${text}`;
}

function number_of(text: string | null): number | null {
  const value = text === null || text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}
