// SPDX-License-Identifier: Apache-2.0
/// Where an error was greatest in a plot's window, as words and as the way there.

import type {Curve} from '../../model/api';
import {button, set_shown, set_text} from '../basics/dom';
import {fixed, time_words, unit_words} from '../basics/format';

export interface Extreme {
  time_s: number;
  value: number;
}

/// By size, within the window. On the way to the path the error falls all the time and tells nothing:
/// it counts from where it was once below `arrived` and fell no more, or where it never was, all of it.
export function greatest_of(
  {time_s, value}: Curve, [from_s, until_s]: readonly [number, number], arrived: number): Extreme | null {
  let whole: Extreme | null = null;
  let found: Extreme | null = null;
  let before = 0;
  for (let k = 0; k < time_s.length; ++k) {
    const size = Math.abs(value[k]!);
    const now_s = time_s[k]!;
    if (!(now_s >= from_s && now_s <= until_s) || Number.isNaN(size)) {
      continue;
    }
    const here = {time_s: now_s, value: value[k]!};
    whole = whole !== null && Math.abs(whole.value) >= size ? whole : here;
    if (found !== null || (size < arrived && size >= before && before > 0)) {
      found = found !== null && Math.abs(found.value) >= size ? found : here;
    }
    before = size;
  }
  return found ?? whole;
}

export class Greatest {
  private at: Extreme | null = null;
  readonly node = button('', () => {
    if (this.at !== null) {
      this.seek(this.at.time_s);
    }
  }, {class: 'link greatest', title: 'Show this moment'});

  constructor(private readonly seek: (time_s: number) => void) {
    set_shown(this.node, false);
  }

  show(at: Extreme | null, unit: string, digits: number, origin_s: number): void {
    this.at = at;
    set_shown(this.node, at !== null);
    set_text(this.node, at === null ? '' : `Greatest: ${fixed(at.value, digits)} ${unit_words(unit)} `
      + `at ${time_words(at.time_s - origin_s)}`);
  }
}
