// SPDX-License-Identifier: Apache-2.0
#include "app/machines/blade_answers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/machines/axis_names.hpp"
#include "app/machines/shared_sections.hpp"

namespace graben::machines {
namespace {

constexpr const char* kTracksDriven = "hst.driven";

void read_side(TomlReader& reader, const std::string& at, SaidAnswer& said) {
  const std::string table = at + "spool_to_duty";
  if (reader.has(table)) {
    said.spool_to_duty = read_spool_to_duty(reader, table);
  }
  if (reader.has(at + "dead_time")) {
    said.dead_time_s = reader.number(
        at + "dead_time", {0.0, 0.5, "s"},
        "from a duty to the spool's first movement to this side, instead of implement.dead_time");
  }
  if (reader.has(at + "lag")) {
    said.lag_s = reader.number(at + "lag", {0.001, 1.0, "s"},
                               "of the drive's speed behind its spool's command, instead of "
                               "control.response");
  }
}

DrivenRange read_range(TomlReader& reader, const std::string& key, const char* help) {
  if (!reader.has(key)) {
    return {};
  }
  const std::vector<double> range = reader.numbers(key, {0.0, 1.0, ""}, 2, help);
  if (range[0] >= range[1]) {
    reader.fail(key, fmt::format("[{}, {}]; allowed: first the least, then the most, which is more",
                                 range[0], range[1]));
  }
  return {range[0], range[1], true};
}

std::size_t all_sides(bool tilts) { return tilts ? 5 : 3; }

}  // namespace

std::string blade_answer_key(std::size_t drive, bool extends) {
  return fmt::format("implement.answer.{}.{}.", kBladeNames[drive], kSideNames[extends ? 0 : 1]);
}

void read_blade_answers(TomlReader& reader, DozerProfile& profile) {
  for (std::size_t drive = 0; drive < kBladeNames.size(); ++drive) {
    for (const bool extends : {true, false}) {
      if (drive == 0 || reader.lists() || profile.tilt.present) {
        read_side(reader, blade_answer_key(drive, extends), profile.answer[drive].side(extends));
      }
    }
  }
}

DozerDriven read_dozer_driven(TomlReader& reader, bool tilts) {
  DozerDriven driven;
  for (std::size_t drive = 0; drive < kBladeNames.size(); ++drive) {
    for (const bool extends : {true, false}) {
      if (drive == 0 || reader.lists() || tilts) {
        driven.blade[drive].side(extends) = read_range(
            reader, blade_answer_key(drive, extends) + "driven",
            "shares of the duty between which this side was measured; nothing is known beyond");
      }
    }
  }
  driven.tracks =
      read_range(reader, kTracksDriven,
                 "displacements of the pumps, either way, between which the tracks were measured");
  return driven;
}

std::vector<std::string> uncommissioned(const DozerDriven& driven, bool tilts) {
  std::vector<std::string> names;
  for (std::size_t drive = 0; drive < (tilts ? 2U : 1U); ++drive) {
    for (const bool extends : {true, false}) {
      if (!driven.blade[drive].side(extends).said) {
        names.push_back(fmt::format("{}, {}", kBladeNames[drive], kSideNames[extends ? 0 : 1]));
      }
    }
  }
  if (!driven.tracks.said) {
    names.emplace_back("tracks");
  }
  return names;
}

std::string commissioned_text(const DozerDriven& driven, bool tilts) {
  const std::vector<std::string> names = uncommissioned(driven, tilts);
  if (names.empty()) {
    return "commissioned: every drive, both sides, and the tracks";
  }
  if (names.size() == all_sides(tilts)) {
    return "not commissioned: no drive is marked as measured (key driven)";
  }
  return fmt::format("not commissioned: {}", fmt::join(names, "; "));
}

std::vector<std::string> unknown_drives(const DozerDriven& driven, bool tilts) {
  const std::vector<std::string> names = uncommissioned(driven, tilts);
  return names.size() == all_sides(tilts) ? std::vector<std::string>{} : names;
}

}  // namespace graben::machines
