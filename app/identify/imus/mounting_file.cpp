// SPDX-License-Identifier: Apache-2.0
#include "app/identify/imus/mounting_file.hpp"

#include <fmt/format.h>

#include <array>

#include "app/identify/file/profile_text.hpp"

namespace graben::identify {
namespace {

constexpr std::array<const char*, kAxisCount> kNames = {"boom", "arm", "bucket"};

}  // namespace

std::string mounting_text(const std::string& old_text, const MountingFit& fit,
                          const std::string& from) {
  ProfileText text(old_text);
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const std::string section = fmt::format("imu.{}", kNames[axis]);
    text.set(section, "turn", fmt::format("{:.5f}", fit.turn_rad[axis]));
    text.set("provenance", section + ".turn",
             fmt::format("{{ deviation = {:.2g}, from = {} }}", fit.deviation_rad[axis],
                         toml_quoted(from)));
  }
  return text.text();
}

}  // namespace graben::identify
