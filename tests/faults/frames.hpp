// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is done to frames on their way, and sensors as the rows break them.

#include <vector>

#include "app/runs/frame_edit.hpp"
#include "can_dbc/codec.hpp"
#include "firmware/core/codes.hpp"
#include "firmware/core/time.hpp"

namespace graben::faults {

using runs::alter;
using runs::corrupt;
using runs::counter_of;
using runs::info_of;
using runs::protect;
using runs::set_raw;
using runs::special_raw;

template <class Kind>
[[nodiscard]] TimeUs cycle_us_of(std::uint32_t id) {
  return info_of<Kind>(id).cycle_time_ms * kMillisecondUs;
}

/// A message of the machine's and what the controller makes of its absence.
struct Sensor {
  std::uint32_t id = 0;
  std::vector<dbc::Field> fields;  ///< Each of them measured, and of no use without its value.
  Fault missing = Fault::kNone;
};

/// A reading of some sensor that can be moved away from what is true.
struct Reading {
  double* offset = nullptr;
  double jump = 0.0;             ///< More than the quantity can change within a cycle.
  Fault jumped = Fault::kNone;   ///< While the last one is held instead.
  Fault missing = Fault::kNone;  ///< When that has become too old.
};

/// A line of the shipped profile, what becomes of it, and the key that the message has to name.
struct Defect {
  const char* line = "";
  const char* instead = "";
  const char* key = "";
};

}  // namespace graben::faults
