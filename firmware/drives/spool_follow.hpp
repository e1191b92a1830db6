#pragma once
/// Whether one spool is where the commands of late sent it, and the valve side says what we say.

#include "firmware/drives/command_history.hpp"

namespace graben {

/// Cycles in a row that a spool must be wrong: its frame comes every second one.
inline constexpr int kSpoolWrongCycles = 4;
/// The valve side has this many cycles to say what we say.
inline constexpr int kEchoCycles = 12;

/// Time that a spool may take to where its command sends it, s.
[[nodiscard]] double spool_arrives_s(double dead_time_s, double settle_s);

/// What one spool may take.
struct SpoolLimits {
  double dead_time_s = 0.0;  ///< Known within 30 %.
  double settle_s = 0.0;     ///< It has reached its duty after this, beside the dead time.
  double tolerance = 0.0;    ///< Of its travel.
};

/// A watch changes its state in place: copies of its histories were most of the stack.
struct SpoolState {
  CommandHistory sent;
  int wrong_cycles = 0;  ///< In a row.
};

/// Whether it is stuck; `state` goes on by a cycle. A spool answers within the dead time and the
/// time to settle: it must lie between the least and the largest duty of that time, within the
/// tolerance. `duty_ratio` is what the last cycle sent, `spool_ratio` what has come in since; one
/// that was not `received` is not judged.
[[nodiscard]] bool follow_spool(const SpoolLimits& limits, SpoolState& state, double duty_ratio,
                                bool received, double spool_ratio);

/// Cycles in a row, up to kEchoCycles, that the valve side's echo of our enable has differed.
[[nodiscard]] int echo_cycles(int last, bool sent, bool echoed);

/// Whether a spool is near its middle: nobody moves the machine by hand.
[[nodiscard]] bool spool_centred(double spool_ratio, double tolerance);

}  // namespace graben
