#pragma once
/// Whether the spools are where the commands of late sent them, and the valve side says what we
/// say.

#include <array>

#include "firmware/drives/spool_follow.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"

namespace graben {

/// What went to the valve in one cycle.
struct SentCommand {
  bool enable = false;
  std::array<double, kDriveCount> duty_ratio{};
};

struct SpoolWatchState {
  std::array<SpoolState, kDriveCount> spool;
  int echo_cycles = 0;  ///< In a row, that the echo has differed.
};

/// kSpoolStuck, kValveNotFollowing; `state` goes on by a cycle. Each spool as follow_spool has it.
/// `sent` is what the last cycle sent, `valid` what has come in
/// since; spools that were not received are not judged.
[[nodiscard]] FaultSet watch_spools(const ExcavatorProfile& profile, SpoolWatchState& state,
                                    const SentCommand& sent, const ValidInputs& valid);

/// Whether every spool is near its middle: the machine is not being moved by hand. True where the
/// bus does not say.
[[nodiscard]] bool spools_centred(const ExcavatorProfile& profile, const ValidInputs& valid);

}  // namespace graben
