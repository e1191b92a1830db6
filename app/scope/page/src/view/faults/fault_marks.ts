// SPDX-License-Identifier: Apache-2.0
/// Where in the log faults began, above the slider.

import {el} from '../basics/dom';
import type {FaultEvent} from './fault_log';
import type {ThemeSwitch} from '../basics/theme';

const HEIGHT_PX = 8;
const WIDTH_PX = 2;
/// Half of the slider's thumb: its middle does not reach the ends of the slider.
const INSET_PX = 8;

export class FaultMarks {
  readonly node = el('canvas', {class: 'fault-marks', height: HEIGHT_PX, 'aria-hidden': 'true'});
  private drawn = '';
  private drawn_events: readonly FaultEvent[] = [];
  private width_px = 0;

  constructor(private readonly theme: ThemeSwitch) {
    theme.on_change(() => {
      this.drawn = '';
    });
    new ResizeObserver(([entry]) => {
      this.width_px = Math.round(entry?.contentRect.width ?? 0);
    }).observe(this.node);
  }

  draw(events: readonly FaultEvent[], from_s: number, until_s: number): void {
    const key = `${from_s} ${until_s} ${this.width_px}`;
    if (key === this.drawn && events === this.drawn_events) {
      return;
    }
    this.drawn_events = events;
    this.drawn = key;
    this.node.width = this.width_px;
    const context = this.node.getContext('2d');
    if (context === null || !(until_s > from_s)) {
      return;
    }
    context.fillStyle = this.theme.colour('fault');
    for (const {time_s} of events) {
      const share = (time_s - from_s) / (until_s - from_s);
      const x = INSET_PX + share * (this.width_px - 2 * INSET_PX);
      context.fillRect(Math.round(x) - WIDTH_PX / 2, 0, WIDTH_PX, HEIGHT_PX);
    }
  }
}
