#pragma once
/// Checks that each spool is where the commands of late sent it, and that the valve side says what
/// we say.

#include <array>

#include "firmware/core/fault_set.hpp"
#include "firmware/drives/drive_validation.hpp"

namespace graben {

/// The commands that something may still be answering to: those of the cycles of late.
class CommandHistory {
 public:
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

/// Cycles in a row that a spool must be wrong: its frame comes every second one.
inline constexpr int kSpoolWrongCycles = 4;
/// The valve side has this many cycles to say what we say.
inline constexpr int kEchoCycles = 12;

/// Of one spool. A watch changes its state in place: copies of its histories were most of the
/// stack.
struct SpoolState {
  CommandHistory sent;
  int wrong_cycles = 0;  ///< In a row.
};

/// Commands of the last cycle, one a drive.
struct SentCommand {
  bool enable = false;
  Span<const double> duty_ratio{nullptr, 0};
};

/// Feedback of the valve since then.
struct ValveFeedback {
  bool received = false;  ///< Spools and echo, as far as the bus carries them.
  bool has_echo = true;   ///< The bus carries the valve side's echo of our enable.
  bool enabled = false;   ///< That echo.
};

/// kSpoolStuck, kValveNotFollowing; the states go on by a cycle. A spool answers within
/// spool_arrives_s(): it must lie between the least and the largest duty of that time, within the
/// tolerance. One that is not measured, and what was not received, is not checked. `echo_cycles`
/// counts the cycles in a row, up to kEchoCycles, in which the echo differed from our enable.
[[nodiscard]] FaultSet watch_spools(DriveRows drives, const SentCommand& sent,
                                    Span<const ValidDrive> seen, const ValveFeedback& feedback,
                                    Span<SpoolState> spool, int& echo_cycles);

/// Every spool that is measured is near its middle: nobody moves the machine by hand.
[[nodiscard]] bool spools_centred(DriveRows drives, Span<const ValidDrive> seen);

}  // namespace graben
