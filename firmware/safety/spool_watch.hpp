#pragma once
/// Whether the spools are where the commands of late sent them, and the valve side says what we
/// say.

#include <array>

#include "firmware/machine/excavator_profile.hpp"
#include "firmware/safety/validation.hpp"

namespace graben {

/// What went to the valve in one cycle.
struct SentCommand {
  bool enable = false;
  std::array<double, kAxisCount> duty_ratio{};
};

/// The commands that a spool may still be answering to.
struct SpoolWatchState {
  static constexpr int kMostCycles = 96;

  std::array<SentCommand, kMostCycles> sent{};  ///< Ring.
  int newest = 0;
  std::array<int, kAxisCount> wrong_cycles{};  ///< In a row.
  int echo_cycles = 0;                         ///< In a row, that the echo has differed.
};

/// Cycles in a row that a spool must be wrong: its frame comes every second one.
inline constexpr int kSpoolWrongCycles = 4;
/// The valve side has this many cycles to say what we say.
inline constexpr int kEchoCycles = 12;

struct SpoolWatchResult {
  FaultSet faults;  ///< kSpoolStuck, kValveNotFollowing
  SpoolWatchState state;
};

/// A spool answers within the dead time, which is known within 30 %, and `safety.settle_s`: it must
/// lie between the least and the largest duty of that time, within `safety.spool_tolerance`.
/// `sent` is what the last cycle sent, `valid` what has come in since; spools that were not
/// received are not judged.
[[nodiscard]] SpoolWatchResult watch_spools(const ExcavatorProfile& profile,
                                            const SpoolWatchState& last, const SentCommand& sent,
                                            const ValidInputs& valid);

/// Whether every spool is near its middle: the machine is not being moved by hand.
[[nodiscard]] bool spools_centred(const ExcavatorProfile& profile, const ValidInputs& valid);

}  // namespace graben
