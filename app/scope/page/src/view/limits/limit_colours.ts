// SPDX-License-Identifier: Apache-2.0
/// One colour per limit, wherever it is shown: by its kind, a shade of it by whose it is. So boom and
/// arm stay apart, and the same limit looks the same in every strip, table and page.

import type {ThemeSwitch} from '../basics/theme';

const KINDS = 13;
/// Shares of the kind's own colour, and what the rest is of.
const SHADES: readonly (readonly [number, string])[] =
  [[1, 'sheet'], [0.62, 'sheet'], [0.6, 'ink'], [0.36, 'sheet']];

/// EcuStatus.LimitKind and LimitIndex as one number; 0: nothing holds.
export const limit_key = (kind: number, index: number): number =>
  kind === 0 ? 0 : kind * 256 + index;
export const kind_of = (key: number): number => key >> 8;
export const index_of = (key: number): number => key & 0xff;

/// As canvas and styles take it.
export function limit_colour(theme: Pick<ThemeSwitch, 'colour'>, key: number): string {
  const kind = kind_of(key);
  if (key === 0 || kind > KINDS) {
    return theme.colour(key === 0 ? 'limit0' : 'limit-more');
  }
  const [share, towards] = SHADES[index_of(key) % SHADES.length]!;
  return mixed(theme.colour(`limit${kind}`), theme.colour(towards), share);
}

/// Of two colours as #rrggbb.
function mixed(own: string, other: string, share: number): string {
  const part = (colour: string, k: number) => parseInt(colour.slice(1 + 2 * k, 3 + 2 * k), 16);
  return `#${[0, 1, 2].map((k) => Math.round(share * part(own, k) + (1 - share) * part(other, k))
    .toString(16).padStart(2, '0')).join('')}`;
}
