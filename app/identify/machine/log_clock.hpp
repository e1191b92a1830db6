// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The clock of a log, which may stand still, be set or begin anew: one answer for every reader,
/// and the page's (app/scope/page/src/model/stamps.ts).
///
///   back by up to 1 s        frames of several interfaces out of order: the stamp of the one
///   before ahead by more than 1 s   nothing was on the bus, or nobody wrote: a gap, which ends a
///   piece back by more, or ahead by more than a day: if the next frame agrees, the clock was set;
///   what follows is a piece of its own, which a step back puts two seconds behind the last frame;
///   if it does not, that one stamp is garbled, and its frame is left out

#include <cstddef>
#include <functional>
#include <vector>

namespace graben::identify {

struct LoggedFrame;

/// Where a piece of a log ends.
struct ClockBreak {
  std::size_t line = 0;  ///< Of the first frame of the next one.
  double by_s = 0.0;     ///< Ahead; below 0: the clock was set back.
};

class LogClock {
 public:
  /// What counts of the time between two frames of a log: across the end of a piece `otherwise_s`,
  /// none, or what a frame usually stands for.
  static double counted_s(double before_s, double now_s, double otherwise_s = 0.0) {
    return now_s - before_s > kGap_s ? otherwise_s : now_s - before_s;
  }

  using Take = std::function<void(const LoggedFrame&)>;
  static constexpr double kDisorder_s = 1.0;
  static constexpr double kGap_s = 1.0;
  static constexpr double kLeap_s = 86400.0;
  static constexpr double kBehind_s = 2.0;

  explicit LogClock(const Take& take) : take_(take) {}

  /// Hands the frame on, now or after the next one, with a time that never goes back and the piece
  /// that it is in; or leaves it out.
  void judge(const LoggedFrame& frame);
  /// After the last one.
  void end();

  [[nodiscard]] const std::vector<ClockBreak>& breaks() const { return breaks_; }
  [[nodiscard]] std::size_t disordered() const { return disordered_; }
  [[nodiscard]] std::size_t garbled() const { return garbled_; }

 private:
  void give(LoggedFrame frame, double time_s);
  void begin_piece(const LoggedFrame& frame, double by_s);

  const Take& take_;
  bool any_ = false;
  double said_s_ = 0.0;    ///< The last stamp that counts, as the log has it.
  double offset_s_ = 0.0;  ///< From those to the time that goes on.
  double last_s_ = 0.0;    ///< Of the last frame that was handed on.
  std::size_t piece_ = 0;
  std::vector<LoggedFrame> held_;  ///< At most one, of a doubtful stamp.
  std::vector<ClockBreak> breaks_;
  std::size_t disordered_ = 0;
  std::size_t garbled_ = 0;
};

}  // namespace graben::identify
