#pragma once
/// What a run of graben-ecu leaves behind: times and counters.

#include <cstdint>
#include <string>

#include "firmware/core/time.hpp"
#include "hal/link/link_counters.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/socketcan_port.hpp"

namespace graben::ecu {

/// Of the process, since its first cycle.
struct Usage {
  std::uint64_t allocations = 0;
  bool allocations_counted = false;
  std::uint64_t page_faults = 0;
  bool real_time = false;
  TimeUs start_us = 0;  ///< From the process's begin to its first frame.
};

/// Writes counters as `# name value` lines, then the histograms of wake-up latency and cycle time
/// as two threads of cyclictest -h, for what plots those. False, with the reason on standard error,
/// if the file cannot be written.
bool write_stats(const std::string& file, const CyclicClock& clock, const LinkCounters& link,
                 const CanPortCounters& port, const Usage& usage);

}  // namespace graben::ecu
