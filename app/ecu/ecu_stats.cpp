// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/ecu_process.hpp"

#include <cinttypes>
#include <cstdio>

namespace graben::ecu {
namespace {

void count(std::FILE* to, const char* name, std::uint64_t value) {
  std::fprintf(to, "# %s %llu\n", name, static_cast<unsigned long long>(value));
}

void durations(std::FILE* to, const char* name, const Histogram& of) {
  std::fprintf(to, "# %s_min_ns %" PRId64 "\n# %s_mean_ns %" PRId64 "\n# %s_max_ns %" PRId64 "\n",
               name, of.min_ns(), name, of.mean_ns(), name, of.max_ns());
}

void print(std::FILE* to, const CyclicClock& clock, const LinkCounters& link,
           const CanPortCounters& port, const Usage& usage) {
  count(to, "real_time", usage.real_time ? 1 : 0);
  count(to, "start_us", static_cast<std::uint64_t>(usage.start_us));
  count(to, "cycles", clock.cycle_time().count());
  count(to, "overruns", clock.overruns());
  count(to, "skipped_periods", clock.skipped());
  if (usage.allocations_counted) {
    count(to, "allocations", usage.allocations);
  } else {
    std::fprintf(to, "# allocations not counted\n");
  }
  count(to, "page_faults", usage.page_faults);
  count(to, "frames_accepted", link.accepted);
  count(to, "frames_rejected", rejected(link));
  count(to, "frames_received", port.received);
  count(to, "frames_sent", port.sent);
  count(to, "frames_dropped", port.dropped_transmit);
  count(to, "receive_overflow", port.receive_overflow);
  count(to, "error_frames", port.error_frames);
  count(to, "reopened", port.reopened);
  count(to, "emergencies", usage.emergencies);
  count(to, "emergency_node", usage.last_emergency.id);
  count(to, "emergency_code", usage.last_emergency.code);
  count(to, "address_lost", usage.address_lost ? 1 : 0);
  count(to, "claims_defended", usage.claims_defended);
  count(to, "store", usage.store.is_there ? 1 : 0);
  count(to, "store_failed", usage.store.failed ? 1 : 0);
  count(to, "store_writes", usage.store.writes);
  count(to, "store_failures", usage.store.failures);
  count(to, "store_dropped", usage.store.dropped);
  count(to, "ground_tiles", usage.store.ground.tiles);
  count(to, "ground_writes", usage.store.ground.writes);
  count(to, "ground_failures", usage.store.ground.failures);
  count(to, "ground_lost", usage.store.ground.lost);
  durations(to, "wake_up_latency", clock.wake_up_latency());
  durations(to, "cycle_time", clock.cycle_time());
  std::fprintf(to, "# Columns: us, wake_up_latency, cycle_time\n");
  print_histograms(to, {&clock.wake_up_latency(), &clock.cycle_time()});
}

}  // namespace

bool write_stats(const std::string& file, const CyclicClock& clock, const LinkCounters& link,
                 const CanPortCounters& port, const Usage& usage) {
  std::FILE* to = std::fopen(file.c_str(), "w");
  if (to == nullptr) {
    std::perror(("graben-ecu: " + file).c_str());
    return false;
  }
  print(to, clock, link, port, usage);
  const bool written = std::ferror(to) == 0;
  if (std::fclose(to) != 0 || !written) {
    std::perror(("graben-ecu: " + file).c_str());
    return false;
  }
  return true;
}

}  // namespace graben::ecu
