#pragma once
/// What is done to frames on their way, by the names that the rows have for it.

#include "app/runs/frame_edit.hpp"
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

}  // namespace graben::faults
