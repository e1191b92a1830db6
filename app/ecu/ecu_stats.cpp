#include "app/ecu/ecu_stats.hpp"

#include <cstdio>

namespace graben::ecu {
namespace {

void count(std::FILE* to, const char* name, std::uint64_t value) {
  std::fprintf(to, "%s %llu\n", name, static_cast<unsigned long long>(value));
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
    std::fprintf(to, "allocations not counted\n");
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
  clock.wake_up_latency().print_summary(to, "wake_up_latency");
  clock.cycle_time().print_summary(to, "cycle_time");
  clock.wake_up_latency().print_bins(to, "wake_up_latency");
  clock.cycle_time().print_bins(to, "cycle_time");
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
