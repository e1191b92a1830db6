// SPDX-License-Identifier: Apache-2.0
#include "app/runs/found_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <vector>

namespace graben::runs {
namespace {

using machines::Found;
using machines::Told;

struct Key {
  const char* name;
  const char* unit;
  double least;
  double most;
  std::optional<Told> Found::*value;
};

/// A deadband narrower than the bypass' closing would keep the bypass partly closed at neutral.
constexpr std::array<Key, 16> kKeys = {{
    {"oil", "GPa", 0.1, 100.0, &Found::bulk_modulus_gpa},
    {"exponent", "", 0.5, 4.0, &Found::opening_exponent},
    {"dead_band", "", plant::kBypassClosingTravel, 0.6, &Found::deadband_ratio},
    {"spool_lag", "s", 0.001, 1.0, &Found::spool_time_constant_s},
    {"friction", "", 0.0, 10.0, &Found::friction_factor},
    {"mass", "", 0.1, 10.0, &Found::mass_factor},
    {"pump_flow", "", 0.1, 2.0, &Found::pump_flow_factor},
    {"engine_sag", "", 0.0, 0.5, &Found::engine_sag_ratio},
    {"dead_time", "s", 0.0, 0.5, &Found::dead_time_s},
    {"spool_closes", "s", 0.001, 1.0, &Found::closing_time_constant_s},
    {"bypass_leak", "", 0.1, 10.0, &Found::bypass_leak_factor},
    {"piston_leak", "", 0.0, 20.0, &Found::piston_leak_factor},
    {"dead_band_more", "", 0.0, 0.1, &Found::dead_band_more_ratio},
    {"stroke_zero_more", "m", -0.03, 0.03, &Found::stroke_zero_more_m},
    {"stroke_age", "s", 0.0, 0.5, &Found::stroke_age_s},
    {"rocking", "deg", 0.0, 5.0, &Found::rocking_deg},
}};

std::string with_unit(const std::string& text, const Key& key) {
  return *key.unit == '\0' ? text : fmt::format("{} {}", text, key.unit);
}

std::string range_text(const Key& key) {
  return with_unit(fmt::format("{} .. {}", key.least, key.most), key);
}

const Key& key_of(const std::string& name) {
  const auto* const key =
      std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& each) { return each.name == name; });
  if (key == kKeys.end()) {
    throw std::runtime_error(fmt::format("'{}' is unknown; allowed: {}", name, found_keys()));
  }
  return *key;
}

/// Written so that what is not a number is refused.
double value_of(const Key& key, const std::string& text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !(value >= key.least && value <= key.most)) {
    throw std::runtime_error(fmt::format("{}: {}; allowed: {}", key.name,
                                         text.empty() ? "a value is missing" : "'" + text + "'",
                                         range_text(key)));
  }
  return value;
}

/// "0.7", or "0.6..2" that is drawn.
Told told_of(const Key& key, const std::string& text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) {
    return value_of(key, text);
  }
  const Told told(value_of(key, text.substr(0, dots)), value_of(key, text.substr(dots + 2)));
  if (!told.is_range()) {
    throw std::runtime_error(
        fmt::format("{}: '{}'; allowed: a range from less to more", key.name, text));
  }
  return told;
}

std::string told_text(const Told& told) {
  return told.is_range() ? fmt::format("{} .. {}", told.least, told.most)
                         : fmt::format("{}", told.least);
}

}  // namespace

machines::Found found_of(const std::string& text) {
  Found found;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, comma - begin);
    const std::size_t equals = std::min(part.find('='), part.size());
    const Key& key = key_of(part.substr(0, equals));
    const Told value = told_of(key, equals == part.size() ? "" : part.substr(equals + 1));
    std::optional<Told>& told = found.*key.value;
    if (told) {
      throw std::runtime_error(
          fmt::format("{} is there twice; allowed: once, {}", key.name, range_text(key)));
    }
    told = value;
    begin = comma + 1;
  }
  return found;
}

std::string found_text(const machines::Found& found) {
  std::vector<std::string> parts;
  for (const Key& key : kKeys) {
    if (const std::optional<Told>& told = found.*key.value) {
      parts.push_back(with_unit(fmt::format("{} {}", key.name, told_text(*told)), key));
    }
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string found_keys() {
  std::vector<std::string> parts;
  for (const Key& key : kKeys) {
    parts.push_back(fmt::format("{} ({})", key.name, range_text(key)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace graben::runs
