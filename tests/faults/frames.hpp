#pragma once
/// What is done to frames on their way, by the names that the rows have for it.

#include "app/runs/frame_edit.hpp"
#include "firmware/core/time.hpp"

namespace graben::faults {

using bench::alter;
using bench::corrupt;
using bench::counter_of;
using bench::info_of;
using bench::protect;
using bench::set_raw;
using bench::special_raw;

template <class Kind>
[[nodiscard]] TimeUs cycle_us_of(std::uint32_t id) {
  return info_of<Kind>(id).cycle_time_ms * kMillisecondUs;
}

}  // namespace graben::faults
