// SPDX-License-Identifier: Apache-2.0
/// Puts stamps into an order in which time never goes back, as every search relies on.

/// A step back of less than this is two senders' frames out of order; of more another clock.
const JITTER_S = 1;
/// A leap ahead of more than this is as doubtful as a step back.
const LEAP_S = 86400;

/// What a stamp means for the frame that has it.
export const enum Stamp {
  use,      ///< With the time in `time_s`.
  leave,    ///< Doubtful: a single one is a garbled line.
  restart,  ///< The clock was set or the source began anew: what came before is another time.
}

/// A stamp a little before the last one is taken for the last one. One far off is left out; if the
/// next one agrees with it, the clock is another: a leap ahead goes on from there, a step back
/// restarts.
export class StampOrder {
  time_s = NaN;  ///< Of the last frame that is used.
  backwards = 0;
  leaps = 0;     ///< Frames left out for a stamp far ahead.
  private doubtful_s = NaN;

  judge(time_s: number): Stamp {
    const ahead_s = time_s - this.time_s;
    if (ahead_s >= 0 && ahead_s <= LEAP_S) {
      this.time_s = time_s;
      this.doubtful_s = NaN;
      return Stamp.use;
    }
    return this.unusual(time_s, ahead_s);
  }

  private unusual(time_s: number, ahead_s: number): Stamp {
    if (Number.isNaN(this.time_s)) {
      this.time_s = time_s;
      return Stamp.use;
    }
    this.backwards += ahead_s < 0 ? 1 : 0;
    if (ahead_s < 0 && ahead_s > -JITTER_S) {
      return Stamp.use;
    }
    const agrees = Math.abs(time_s - this.doubtful_s) < JITTER_S;
    this.doubtful_s = time_s;
    if (!agrees) {
      this.leaps += ahead_s > 0 ? 1 : 0;
      return Stamp.leave;
    }
    this.time_s = time_s;
    this.doubtful_s = NaN;
    return ahead_s < 0 ? Stamp.restart : Stamp.use;
  }
}
