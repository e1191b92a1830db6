// SPDX-License-Identifier: Apache-2.0
/// A moment of a log in the page's address: `#t=12.345`, with `&w=10.5,20` the window of the plots.
/// Seconds from the first frame.

export interface Moment {
  time_s: number;
  window_s?: readonly [number, number];
}

/// Null where the address tells none, or nothing that is one.
export function moment_of(hash: string): Moment | null {
  const told = new URLSearchParams(hash.replace(/^#/, ''));
  const time_s = number_of(told.get('t'));
  if (time_s === null) {
    return null;
  }
  const [from, until, ...more] = (told.get('w') ?? '').split(',').map(number_of);
  return from != null && until != null && more.length === 0 && until > from
    ? {time_s, window_s: [from, until]} : {time_s};
}

export function hash_of({time_s, window_s}: Moment): string {
  const words = (value: number): string => String(Number(value.toFixed(4)));
  return `#t=${words(time_s)}${window_s === undefined ? '' : `&w=${window_s.map(words).join()}`}`;
}

function number_of(text: string | null): number | null {
  const value = text === null || text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}
