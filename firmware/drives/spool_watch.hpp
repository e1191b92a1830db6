// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks that each spool is where the commands of late can have sent it, and that the valve side
/// says what we say.

#include <array>

#include "firmware/core/fault_set.hpp"
#include "firmware/core/time.hpp"
#include "firmware/drives/drive_validation.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {

/// Recent commands that a spool or pump may still be answering.
class CommandHistory {
 public:
  /// Cycles whose commands are kept. [cycles; size: ring, 0.96 s of late start]
  static constexpr int kMostCycles = 96;

  struct Range {
    double least = 0.0;
    double most = 0.0;
  };

  /// As if `neutral` had been sent all the time.
  explicit CommandHistory(double neutral = 0.0);

  void add(double sent);
  /// Of the newest `cycles`, 1 .. kMostCycles.
  [[nodiscard]] Range range(int cycles) const;
  [[nodiscard]] double newest() const { return sent_[static_cast<unsigned>(newest_)]; }

 private:
  std::array<double, kMostCycles> sent_{};  ///< Ring.
  int newest_ = 0;
};

/// Cycles that a command of `time_s` ago has been under way; as many as are kept at most.
[[nodiscard]] int cycles_under_way(double time_s);

/// Where a sound spool can be, whichever it is of all that start late by up to their bound and
/// follow with two lags of up to theirs: bounds that hold for lags that differ and change, too.
/// They widen at once with a command; what a spool must have left they leave as the slowest one
/// does.
class SpoolRange {
 public:
  /// A cycle on: the commands that may just take effect, and the newest one's share in a lag.
  void follow(const CommandHistory::Range& commands, double newest_share);
  [[nodiscard]] CommandHistory::Range now() const { return lag_[1]; }

 private:
  std::array<CommandHistory::Range, 2> lag_;
};

/// Of one spool. A watch changes its state in place: copies of its histories were most of the
/// stack.
struct SpoolState {
  CommandHistory sent;
  SpoolRange range;
  int wrong_cycles = 0;         ///< In a row.
  double wrong_at_ratio = 0.0;  ///< Where it was at the first of them.
  int slow_cycles = 0;          ///< That it has been wrong and on its way to where it should be.
  // A spool that opens later than it should, of which nothing moves before its time.
  int behind_cycles = 0;         ///< In a row, that it has been.
  int stood_cycles = 0;          ///< Of them, until it moved at all.
  double behind_at_ratio = 0.0;  ///< Where it was when it fell behind.
  int later_cycles = 0;          ///< By so much it was found to be slower than told.
};

/// Commands of the last cycle, one a drive.
struct SentCommand {
  bool enable = false;
  Span<const double> duty_ratio{nullptr, 0};  ///< Where the spools are to be.
  Span<const double> lead_ratio{nullptr, 0};  ///< What was sent beyond that.
  bool tried = false;  ///< On valves whose dead time and lag are not known, or it has just been so.
};

/// Feedback of the valve since then.
struct ValveFeedback {
  bool received = false;          ///< Spools and echo, as far as the bus carries them.
  bool has_echo = true;           ///< The bus carries the valve side's echo of our enable.
  bool enabled = false;           ///< That echo.
  int echo_cycles = kEchoCycles;  ///< It has so many to come.
  int cycles = 1;                 ///< Since the last ones were seen (cycles_in).
};

/// kSpoolStuck, kSpoolLate, kValveNotFollowing; the states go on by a cycle. A spool must lie in
/// its SpoolRange, with the late start and the lag that `settle_s` stands for (drive_bank.hpp),
/// within the tolerance. So one that stands is seen as soon as the slowest would have left it
/// behind. One that is not measured, and what was not received, is not checked. Where duties are
/// tried, a spool may start within 0.45 s, with lags of 0.16 s each.
///
/// A spool that is behind on its way out opens too little, which moves nothing before its time: it
/// may catch up within 0.3 s. So may one that is open too far and on its way home; one that stands
/// there is stuck at once. One that moved all the while is slower than told, and may be so from
/// then on in both ways. One that stood at first and then comes is late: kSpoolLate. One that does
/// not come is stuck. `echo_cycles` counts the cycles
/// in a row, up to feedback.echo_cycles, in which the echo differed from our enable.
[[nodiscard]] FaultSet watch_spools(DriveRows drives, const SentCommand& sent,
                                    Span<const ValidDrive> seen, const ValveFeedback& feedback,
                                    Span<SpoolState> spool, int& echo_cycles);

/// Every spool that is measured is near its middle: nobody moves the machine by hand.
[[nodiscard]] bool spools_centred(DriveRows drives, Span<const ValidDrive> seen);

}  // namespace graben
