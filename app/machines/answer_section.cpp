// SPDX-License-Identifier: Apache-2.0
#include "app/machines/answer_section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/machines/axis_names.hpp"
#include "app/machines/shared_sections.hpp"
#include "firmware/excavator/excavator_drives.hpp"

namespace graben::machines {
namespace {

void read_time(TomlReader& reader, const std::string& key, const Range& range, const char* help,
               double& value_s) {
  if (reader.has(key)) {
    value_s = reader.number(key, range, help);
  }
}

void read_side(TomlReader& reader, const std::string& at, SaidAnswer& said) {
  const std::string table = at + "spool_to_duty";
  if (reader.has(table)) {
    said.spool_to_duty = read_spool_to_duty(reader, table);
  }
  read_time(reader, at + "dead_time", {0.0, 0.5, "s"},
            "from a duty to the spool's first movement to this side, instead of valve.dead_time",
            said.dead_time_s);
  read_time(reader, at + "lag", {0.001, 1.0, "s"},
            "of the drive's speed behind its spool's command, instead of control.response",
            said.lag_s);
  read_time(reader, at + "spool_time_constant", {0.0, 0.2, "s"},
            "of the spool's own lag of the second order, instead of oil.spool_time_constant",
            said.spool_time_constant_s);
}

}  // namespace

std::string answer_key(int drive, bool extends) {
  return fmt::format("valve.answer.{}.{}.", kDriveNames[static_cast<unsigned>(drive)],
                     kSideNames[extends ? 0 : 1]);
}

void read_answers(TomlReader& reader, int drive_count, ValveProfile& valve) {
  for (int drive = 0; drive < drive_count; ++drive) {
    for (const bool extends : {true, false}) {
      read_side(reader, answer_key(drive, extends),
                valve.answer[static_cast<unsigned>(drive)].side(extends));
    }
  }
}

std::array<DrivenRanges, kDriveCount> read_driven(TomlReader& reader, int drive_count) {
  std::array<DrivenRanges, kDriveCount> driven;
  for (int drive = 0; drive < drive_count; ++drive) {
    for (const bool extends : {true, false}) {
      const std::string key = answer_key(drive, extends) + "driven";
      if (!reader.has(key)) {
        continue;
      }
      const std::vector<double> range = reader.numbers(
          key, {0.0, 1.0, ""}, 2,
          "shares of the duty between which this side was measured; nothing is known beyond");
      driven[static_cast<unsigned>(drive)].side(extends) = {range[0], range[1], true};
      if (range[0] >= range[1]) {
        reader.fail(
            key,
            fmt::format("[{}, {}]; allowed: first the least duty, then the most, which is more",
                        range[0], range[1]));
      }
    }
  }
  return driven;
}

std::vector<std::string> uncommissioned_sides(const std::array<DrivenRanges, kDriveCount>& driven,
                                              int drive_count) {
  std::vector<std::string> sides;
  for (int drive = 0; drive < drive_count; ++drive) {
    for (const bool extends : {true, false}) {
      if (!driven[static_cast<unsigned>(drive)].side(extends).said) {
        sides.push_back(side_name(drive, extends));
      }
    }
  }
  return sides;
}

std::string commissioned_text(const std::array<DrivenRanges, kDriveCount>& driven,
                              int drive_count) {
  const std::vector<std::string> sides = uncommissioned_sides(driven, drive_count);
  if (sides.empty()) {
    return "commissioned: every drive, both sides";
  }
  if (sides.size() == 2 * static_cast<std::size_t>(drive_count)) {
    return "not commissioned: no side of any drive is marked as measured (key driven)";
  }
  return fmt::format("not commissioned: {}", fmt::join(sides, "; "));
}

double shortest_dead_time_s(const ExcavatorProfile& profile) {
  double shortest_s = profile.control.dead_time_s;
  for (int drive = 0; drive < profile.drive_count; ++drive) {
    for (const bool extends : {true, false}) {
      shortest_s = std::min(shortest_s, answer_of(profile, drive, extends).dead_time_s);
    }
  }
  return shortest_s;
}

}  // namespace graben::machines
