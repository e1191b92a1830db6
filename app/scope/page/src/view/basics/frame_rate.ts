// SPDX-License-Identifier: Apache-2.0
/// Frames of the screen that were drawn in the last second.

const SECOND_MS = 1000;
const MOST = 256;

export class FrameRate {
  private readonly times_ms = new Float64Array(MOST);
  private next = 0;

  count(now_ms: number): void {
    this.times_ms[this.next] = now_ms;
    this.next = (this.next + 1) % MOST;
  }

  per_second(now_ms: number): number {
    let frames = 0;
    for (const time_ms of this.times_ms) {
      frames += time_ms > 0 && now_ms - time_ms <= SECOND_MS ? 1 : 0;
    }
    return frames;
  }
}
