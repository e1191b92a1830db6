#pragma once
/// What a controller's process says of itself on the bus, beside the controller's outputs.

#include <cstdint>

#include "firmware/core/time.hpp"

namespace graben {

/// How the process fares that the controller runs in. Counts saturate at 250 on the bus.
struct ProcessHealth {
  std::uint32_t allocations = 0;  ///< Of the process since its first cycle.
  std::uint32_t page_faults = 0;  ///< Of the control thread since its first cycle.
  std::uint32_t overruns = 0;     ///< Late cycles since the start.
  bool real_time = false;         ///< With real-time priority and locked memory.
};

struct EcuDiagnosis {
  TimeUs cycle_time_us = 0;           ///< Of the last cycle; saturates at 64255.
  std::uint32_t rejected_frames = 0;  ///< Since the start; saturates at 250.
  std::uint32_t profile_hash = 0;
  std::uint32_t dropped_frames = 0;  ///< That the bus did not take, since the start.
  ProcessHealth process;
};

}  // namespace graben
