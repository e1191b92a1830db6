// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A log beside the profile that it is to be compared with.

#include <cstdint>
#include <string>
#include <vector>

#include "app/identify/machine/machine_log.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

/// Where the swing of a profile stands as a drive; 0 without one.
[[nodiscard]] inline double swing_lever_m(const ExcavatorProfile& profile) {
  return profile.has_swing() ? profile.swing.lever_m : 0.0;
}

/// Throws std::runtime_error, naming the log, where it says that it is of a machine with another
/// profile than one of these hashes.
void assert_same_machine(const MachineLog& log, const std::vector<std::uint32_t>& hashes);

/// Throws std::runtime_error, naming the log and the place, where a stroke is not one of the
/// profile's cylinders, the engine never runs, or nothing moves.
void assert_plausible(const MachineLog& log, const ExcavatorProfile& profile);

/// What is to be known of a log that can be used: its length, gaps, damaged frames.
[[nodiscard]] std::vector<std::string> log_notes(const MachineLog& log);

}  // namespace graben::identify
