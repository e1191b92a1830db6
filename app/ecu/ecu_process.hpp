// SPDX-License-Identifier: Apache-2.0
#pragma once
/// graben-ecu from its start to its end: its options, real time, the cycle, the way out, and the
/// statistics that a run leaves behind.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/ecu/store/process_store.hpp"
#include "app/machines/unknown_drives.hpp"
#include "firmware/core/time.hpp"
#include "hal/link/message_links.hpp"
#include "hal/link/message_rules.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/socketcan_port.hpp"

namespace graben::ecu {

/// The command line.
struct EcuOptions {
  std::vector<std::string> interfaces;  ///< CAN interfaces by name; all are heard, all are sent to.
  std::string profile;
  std::vector<std::string> tasks;     ///< Files or names, in the order of their numbers, from 0.
  std::string stats_file;             ///< Written on the way out; none if empty.
  std::optional<std::uint64_t> name;  ///< NAME on J1939; without it found_name().
  std::string store;                  ///< Folder; $STATE_DIRECTORY if empty; none without that.
  bool keeps_ground = false;          ///< As the edge has left it; in the store.
  /// Of tasks that need drives which were not commissioned.
  machines::UnknownTask unknown = machines::UnknownTask::kRefused;
  bool real_time = true;
  int priority = 80;  ///< SCHED_FIFO.
  std::optional<int> cpu;
};

/// Of the process, since its first cycle.
struct Usage {
  std::uint64_t allocations = 0;
  bool allocations_counted = false;
  std::uint64_t page_faults = 0;
  bool real_time = false;
  std::uint32_t emergencies = 0;  ///< Of nodes of CANopen, as they came and changed.
  NodeEmergency last_emergency;
  bool address_lost = false;          ///< Another station has our address (J1939-81).
  std::uint32_t claims_defended = 0;  ///< Claims of it by others that it was kept from.
  StoreCounters store;
  TimeUs start_us = 0;  ///< From the process's begin to its first frame.
};

/// Writes counters as `# name value` lines, then the histograms of wake-up latency and cycle time
/// as two threads of cyclictest -h, for what plots those. False, with the reason on standard error,
/// if the file cannot be written.
bool write_stats(const std::string& file, const CyclicClock& clock, const LinkCounters& link,
                 const CanPortCounters& port, const Usage& usage);

/// Runs until SIGTERM or SIGINT; returns the exit status. Everything that keeps it from starting
/// is told on standard error, before a single frame was sent: status 2 if it is the profile, which
/// no second try mends; 1 if it is something that may come, such as the interface. `began_us` is
/// when the process began, on the monotonic clock.
///
/// Told to end, it sends neutral for 5 cycles, so that no valve has to wait for its own timeout.
int run(const EcuOptions& options, TimeUs began_us);

}  // namespace graben::ecu
