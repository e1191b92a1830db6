// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sections [valve.answer.DRIVE.SIDE] of an excavator's file: how each side of a drive's spool
/// answers, where that is known by itself.

#include <array>

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// Keys of the sides, in the order extend, retract.
inline constexpr std::array<const char*, 2> kSideNames = {"extend", "retract"};

/// "valve.answer.boom.extend."
[[nodiscard]] std::string answer_key(int drive, bool extends);

/// Nothing said where the file has no such section.
void read_answers(TomlReader& reader, int drive_count, ValveProfile& valve);

/// Shares of the duty between which a side's values were measured; the whole of it where the file
/// does not say.
struct DrivenRange {
  double least = 0.0;
  double most = 1.0;
};

struct DrivenRanges {
  DrivenRange extend;
  DrivenRange retract;

  [[nodiscard]] DrivenRange& side(bool extends) { return extends ? extend : retract; }
  [[nodiscard]] const DrivenRange& side(bool extends) const { return extends ? extend : retract; }
};

[[nodiscard]] std::array<DrivenRanges, kDriveCount> read_driven(TomlReader& reader,
                                                                int drive_count);

/// Shortest dead time of all sides, s.
[[nodiscard]] double shortest_dead_time_s(const ExcavatorProfile& profile);

}  // namespace graben::machines
