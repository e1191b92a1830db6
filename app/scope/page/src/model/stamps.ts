// SPDX-License-Identifier: Apache-2.0
/// Puts stamps into an order in which time never goes back, as every search relies on. The terminal
/// has the same answer (app/identify/machine/log_clock.hpp).

/// A step back of up to this is two senders' frames out of order; of more another clock.
const JITTER_S = 1;
/// Without a frame for longer, a piece of a log ends.
const GAP_S = 1;
/// A leap ahead of more than this is as doubtful as a step back.
const LEAP_S = 86400;
/// Where a clock was set back, the next piece of a log begins so far behind the last frame.
const BEHIND_S = 2;

/// What a stamp means for the frame that has it.
export const enum Stamp {
  use,      ///< With the time in `time_s`.
  hold,     ///< Doubtful: a garbled line, unless the next frame agrees.
  anew,     ///< The clock was set: the frame that was held counts with `held_s`, then this one.
  restart,  ///< The same, and the source began anew: what came before is another time.
}

/// A place where the clock does not go on: ahead by so much, or back.
export interface Break {
  line: number;
  by_s: number;
}

/// A stamp a little before the last one is taken for the last one. One far off is held; if the next
/// one agrees with it, the clock is another. A leap ahead goes on from there. A step back restarts a
/// live source; in a log it begins a piece of its own.
export class StampOrder {
  time_s = NaN;  ///< Of the last frame that is used.
  held_s = NaN;
  backwards = 0;
  garbled = 0;   ///< Frames left out for their stamp.
  breaks = 0;
  first_break: Break | null = null;
  private said_s = NaN;  ///< As the source has it.
  private offset_s = 0;
  private doubtful_s = NaN;
  private doubtful_line = 0;

  constructor(private readonly is_log: boolean) {}

  judge(time_s: number, line: number): Stamp {
    const ahead_s = time_s - this.said_s;
    if (ahead_s >= 0 && ahead_s <= GAP_S) {
      this.said_s = time_s;
      this.time_s = time_s + this.offset_s;
      if (!Number.isNaN(this.doubtful_s)) {
        this.give_up();
      }
      return Stamp.use;
    }
    return this.unusual(time_s, ahead_s, line);
  }

  /// No frame follows.
  end(): void {
    this.give_up();
  }

  private give_up(): void {
    this.garbled += Number.isNaN(this.doubtful_s) ? 0 : 1;
    this.doubtful_s = NaN;
  }

  private unusual(time_s: number, ahead_s: number, line: number): Stamp {
    if (Number.isNaN(this.said_s)) {
      this.said_s = time_s;
      this.time_s = time_s;
      return Stamp.use;
    }
    if (ahead_s >= -JITTER_S && ahead_s <= LEAP_S) {
      this.give_up();
      if (ahead_s < 0) {
        ++this.backwards;
        return Stamp.use;
      }
      this.note_break(line, ahead_s);
      this.said_s = time_s;
      this.time_s = time_s + this.offset_s;
      return Stamp.use;
    }
    if (!(Math.abs(time_s - this.doubtful_s) < JITTER_S)) {
      this.give_up();
      this.doubtful_s = time_s;
      this.doubtful_line = line;
      return Stamp.hold;
    }
    return this.set_clock(time_s);
  }

  private set_clock(time_s: number): Stamp {
    const first_s = this.doubtful_s;
    const by_s = first_s - this.said_s;
    this.doubtful_s = NaN;
    if (by_s < 0) {
      this.offset_s = this.is_log ? this.time_s + BEHIND_S - first_s : 0;
    }
    this.note_break(this.doubtful_line, by_s);
    this.said_s = Math.max(first_s, time_s);
    this.held_s = first_s + this.offset_s;
    this.time_s = this.said_s + this.offset_s;
    return by_s < 0 && !this.is_log ? Stamp.restart : Stamp.anew;
  }

  private note_break(line: number, by_s: number): void {
    ++this.breaks;
    this.first_break ??= {line, by_s};
  }
}
