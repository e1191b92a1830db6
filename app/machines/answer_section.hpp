// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sections [valve.answer.DRIVE.SIDE] of an excavator's file: how each side of a drive's spool
/// answers, where that is known by itself.

#include <array>
#include <string>
#include <vector>

#include "app/machines/axis_names.hpp"
#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// "valve.answer.boom.extend."
[[nodiscard]] std::string answer_key(int drive, bool extends);

/// Nothing said where the file has no such section.
void read_answers(TomlReader& reader, int drive_count, ValveProfile& valve);

/// Shares of the duty between which a side's values were measured: the mark that `graben identify`
/// leaves on a side that was commissioned.
struct DrivenRange {
  double least = 0.0;
  double most = 1.0;
  bool said = false;  ///< Else nothing was measured, as far as the file says.
};

struct DrivenRanges {
  DrivenRange extend;
  DrivenRange retract;

  [[nodiscard]] DrivenRange& side(bool extends) { return extends ? extend : retract; }
  [[nodiscard]] const DrivenRange& side(bool extends) const { return extends ? extend : retract; }
};

[[nodiscard]] std::array<DrivenRanges, kDriveCount> read_driven(TomlReader& reader,
                                                                int drive_count);

/// "swing, left": the sides that the file does not say to have been measured, in their order.
[[nodiscard]] std::vector<std::string> uncommissioned_sides(
    const std::array<DrivenRanges, kDriveCount>& driven, int drive_count);

/// "not commissioned: swing, left; swing, right", or what else is to be said of that.
[[nodiscard]] std::string commissioned_text(const std::array<DrivenRanges, kDriveCount>& driven,
                                            int drive_count);

/// Shortest dead time of all sides, s.
[[nodiscard]] double shortest_dead_time_s(const ExcavatorProfile& profile);

}  // namespace graben::machines
