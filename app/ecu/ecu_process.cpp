// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/ecu_process.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "app/ecu/address_name.hpp"
#include "app/ecu/address_note.hpp"
#include "app/ecu/address_port.hpp"
#include "app/ecu/diagnostic_port.hpp"
#include "app/ecu/emergency_note.hpp"
#include "app/ecu/end_signals.hpp"
#include "app/ecu/ground/ground_keeper.hpp"
#include "app/ecu/kinds.hpp"
#include "app/ecu/opened_store.hpp"
#include "app/ecu/store/process_store.hpp"
#include "app/ecu/store/site_mark.hpp"
#include "app/ecu/workshop.hpp"
#include "app/machines/any_machine.hpp"
#include "app/machines/task_file.hpp"
#include "hal/j1939/ids.hpp"
#include "platform/can_port_group.hpp"
#include "platform/linux/allocation_counter.hpp"
#include "platform/linux/bus_lock.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"
#include "platform/linux/service_notify.hpp"
#include "platform/linux/socketcan_port.hpp"

namespace graben::ecu {
namespace {

constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
constexpr int kNeutralCycles = 5;
constexpr int kFailed = 1;
/// The profile, or a task.
constexpr int kWrongFile = 2;
constexpr const char* kMachineId = "/etc/machine-id";
/// The manager wants to hear from us within an interval; three times in it is on the safe side.
constexpr TimeUs kWatchdogShare = 3;

void demand(const ErrorText& error, const char* way_out) {
  if (!error.empty()) {
    throw std::runtime_error(std::string(error.c_str()) + way_out);
  }
}

void become_real_time(const EcuOptions& options) {
  constexpr const char* kWayOut =
      "\n  give the process what it asks for (the package's service does), or --no-realtime where "
      "nothing moves";
  demand(lock_memory(), kWayOut);
  prefault_stack();
  demand(set_fifo_priority(options.priority), kWayOut);
}

/// Nothing, with every error told, if the profile is missing or wrong.
std::optional<machines::AnyMachine> read_profile(const std::string& name) try {
  return machines::load_any(machines::find_profile(name, {"/etc/graben", "/usr/share/graben"}));
} catch (const std::exception& error) {
  std::fprintf(stderr, "graben-ecu: %s\n", error.what());
  return std::nullopt;
}

/// Nothing, with every error told, if one of the tasks is missing, wrong, or can't be had.
std::optional<machines::TaskShelf> read_tasks(const std::vector<std::string>& names,
                                              const ExcavatorProfile& profile) try {
  return machines::load_tasks(names, {"/etc/graben/tasks", "/usr/share/graben/tasks"}, profile);
} catch (const std::exception& error) {
  std::fprintf(stderr, "graben-ecu: %s\n", error.what());
  return std::nullopt;
}

/// The interfaces by their names, opened.
struct Buses {
  std::deque<BusLock> locks;
  std::deque<SocketCanPort> ports;
  CanPortGroup group;

  /// Only frames with one of the `ids` are heard.
  Buses(const std::vector<std::string>& names, const std::vector<std::uint32_t>& ids) {
    for (const std::string& name : names) {
      locks.emplace_back(name);
      demand(locks.back().error(), "");
      ports.emplace_back(name, ids);
      SocketCanPort& port = ports.back();
      if (!port.open()) {
        throw std::runtime_error(port.last_error());
      }
      if (!group.add(port)) {
        throw std::runtime_error("no room for interface " + name);
      }
    }
  }
  [[nodiscard]] CanPortCounters counters() const {
    CanPortCounters sum;
    for (const SocketCanPort& port : ports) {
      const CanPortCounters& one = port.counters();
      sum.received += one.received;
      sum.sent += one.sent;
      sum.receive_overflow += one.receive_overflow;
      sum.dropped_transmit += one.dropped_transmit;
      sum.error_frames += one.error_frames;
      sum.wrong_frames += one.wrong_frames;
      sum.reopened += one.reopened;
    }
    return sum;
  }
};

/// Tells the service manager that cycles go on; it restarts what stops saying so.
class Watchdog {
 public:
  explicit Watchdog(ServiceNotify& manager)
      : manager_(manager),
        interval_us_(watchdog_interval_us(std::getenv("WATCHDOG_USEC"), std::getenv("WATCHDOG_PID"),
                                          getpid()) /
                     kWatchdogShare) {}

  void cycle_done(TimeUs now_us) {
    if (interval_us_ > 0 && now_us - last_us_ >= interval_us_) {
      manager_.watchdog();
      last_us_ = now_us;
    }
  }

 private:
  ServiceNotify& manager_;
  TimeUs interval_us_;
  TimeUs last_us_ = 0;
};

/// What the process has used since its first cycle was done.
class UsageMark {
 public:
  void set() {
    faults_ = page_faults();
    allocations_ = allocation_count();
    set_ = true;
  }
  [[nodiscard]] bool is_set() const { return set_; }
  [[nodiscard]] std::uint64_t allocations() const {
    return set_ ? allocation_count() - allocations_ : 0;
  }
  [[nodiscard]] std::uint64_t faults() const {
    return set_ ? static_cast<std::uint64_t>(faults_since(faults_, page_faults())) : 0;
  }

 private:
  PageFaults faults_;
  std::uint64_t allocations_ = 0;
  bool set_ = false;
};

std::uint32_t small(std::uint64_t count) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(count, UINT32_MAX));
}

template <class Ecu, class Feed>
void cycle_until_stopped(Ecu& ecu, CyclicClock& clock, Watchdog& watchdog, UsageMark& mark,
                         EmergencyNote& note, AddressNote& address, Workshop& workshop, Feed& edge,
                         bool real_time) {
  for (int neutral_cycles = 0; neutral_cycles < kNeutralCycles;) {
    const CyclicClock::Cycle cycle = clock.wait();
    if (stop_requested()) {
      ecu.request_stop();
      ++neutral_cycles;
    }
    ecu.set_process_health(
        {small(mark.allocations()), small(mark.faults()), small(clock.overruns()), real_time});
    workshop.begin(cycle.now_us);
    ecu.step(cycle.now_us, cycle.last_us);
    workshop.cycle_done(ecu, cycle.now_us);
    edge.look(ecu.inputs(), ecu.outputs(), cycle.now_us);
    watchdog.cycle_done(cycle.now_us);
    note.look(ecu.emergency());
    address.look();
    if (!mark.is_set()) {
      mark.set();
    }
  }
  // What was sent last leaves first: the teardown of locked memory keeps a processor for
  // milliseconds, at a priority above that of the interface's interrupt.
  static_cast<void>(clock.wait());
}

/// What the controller takes, its sensors' frames, its own ids, as another one is to be heard, and
/// what a workshop's tool asks.
template <class Kind>
std::vector<std::uint32_t> heard_ids(const typename Kind::Setup& setup, const BusTable& table) {
  const auto taken = Kind::Receiver::ids();
  const auto own = Kind::Transmitter::ids();
  std::vector<std::uint32_t> ids(taken.begin(), taken.end());
  ids.insert(ids.end(), own.begin(), own.end());
  for (const std::uint32_t id : Kind::sensor_ids(setup)) {
    if (id != 0) {
      ids.push_back(id);
    }
  }
  constexpr std::uint8_t kAnyTool = j1939::kNullAddress;
  for (const std::uint32_t pgn : {j1939::kRequestPgn, j1939::kConnectionPgn}) {
    ids.push_back(j1939::id_of(0, pgn, kOwnAddress, kAnyTool));
  }
  for (const std::uint32_t pgn : {j1939::kRequestPgn, j1939::kAddressClaimedPgn}) {
    ids.push_back(j1939::id_of(0, pgn, j1939::kGlobalAddress, kAnyTool));
  }
  for (const std::uint32_t id : table_ids(table)) {
    if (id != 0) {
      ids.push_back(id);
    }
  }
  return ids;
}

/// Where the tasks have the machine; 0: nowhere.
template <class Kind>
std::uint32_t site_of([[maybe_unused]] const typename Kind::Setup& setup) {
  if constexpr (Kind::kHasTasks) {
    return site_mark(setup.book);
  } else {
    return 0;
  }
}

/// From the interfaces to the statistics, with the controller of a machine kind.
template <class Kind>
int run_controller(const typename Kind::Setup& setup, const BusTable& table,
                   std::uint32_t profile_hash, const EcuOptions& options, TimeUs began_us) {
  if (table.bus_count != 0 && table.bus_count != options.interfaces.size()) {
    std::fprintf(stderr, "graben-ecu: --can: %zu of them; the bus profile has %u interfaces\n",
                 options.interfaces.size(), static_cast<unsigned>(table.bus_count));
    return kWrongFile;
  }
  Buses buses(options.interfaces, heard_ids<Kind>(setup, table));
  LastFrames last;
  const auto own_ids = Kind::Transmitter::ids();
  j1939::Diagnostics diagnostics(kOwnAddress, own_ids.data(), own_ids.size());
  j1939::AddressClaim claim(kOwnAddress, options.name ? *options.name : found_name(kMachineId));
  AddressPort address(buses.group, claim, last);
  DiagnosticPort port(address, diagnostics);
  EcuNode<Kind> ecu(setup, profile_hash, port, &table);
  CyclicClock clock(kPeriod_us);
  ServiceNotify manager(std::getenv("NOTIFY_SOCKET"));
  Watchdog watchdog(manager);
  UsageMark mark;
  ecu.set_last_frames(last);
  auto store = open_store<Kind>(options, profile_hash);
  if (typename Kind::Learnt learnt;
      store != nullptr && learnt_from(store->found().learnt, learnt) && !ecu.begin(learnt)) {
    std::fputs("graben-ecu: store: what was learnt is beyond what can be: begins anew\n", stderr);
  }
  const std::uint32_t site = site_of<Kind>(setup);
  if (site != 0 && store != nullptr && store->found().left_site == site) {
    ecu.begin_left_site();
    std::fputs(
        "graben-ecu: store: the machine has left the place that the tasks have: touch the site's "
        "points again, or give a file of where it stands\n",
        stderr);
  }
  const EndSignals signals(last, buses.ports);
  demand(signals.error(), "");
  claim_address(address);
  if (options.cpu) {
    demand(pin_to_cpu(*options.cpu), "");
  }
  if (options.real_time) {
    become_real_time(options);
  } else {
    std::fprintf(stderr, "graben-ecu: WITHOUT real time (--no-realtime): not for a machine\n");
  }
  Usage usage;
  usage.start_us = monotonic_now_us() - began_us;
  manager.ready();
  const char* const status = options.real_time ? "cycling" : "cycling WITHOUT real time";
  manager.status(status);
  EmergencyNote note(manager, status);
  AddressNote address_note(manager, claim);

  Workshop workshop(address, port, store.get(), site);
  ground::EdgeFeed edge(ground::finder_of(setup), edges_of(setup, store.get()));
  cycle_until_stopped(ecu, clock, watchdog, mark, note, address_note, workshop, edge,
                      options.real_time);

  manager.stopping();
  if (note.count() > 0) {
    std::fprintf(stderr, "graben-ecu: %s\n", note.words().c_str());
  }
  usage.emergencies = note.count();
  usage.address_lost = claim.is_lost();
  usage.claims_defended = claim.defended();
  usage.last_emergency = note.last();
  usage.allocations = mark.allocations();
  usage.allocations_counted = allocations_are_counted();
  usage.page_faults = mark.faults();
  usage.real_time = options.real_time;
  usage.store = end_store(std::move(store));
  const bool written = options.stats_file.empty() ||
                       write_stats(options.stats_file, clock, ecu.link(), buses.counters(), usage);
  return written ? 0 : kFailed;
}

static_assert(std::is_same_v<Kinds::AnyMachine, machines::AnyMachine>,
              "each kind whose profiles are read has its controller");

/// Tells a line each, and why.
void tell(const std::string& lines) {
  for (std::size_t from = 0; from < lines.size();) {
    const std::size_t end = lines.find('\n', from);
    std::fprintf(stderr, "graben-ecu: %s\n", lines.substr(from, end - from).c_str());
    from = end + 1;
  }
}

template <class Machine>
int run_machine(Machine machine, const EcuOptions& options, TimeUs began_us) {
  using Kind = KindOf<Machine>;
  if constexpr (Kind::kHasTasks) {
    // The controller looks into its surfaces as long as it runs.
    const auto shelf = read_tasks(options.tasks, machine.profile);
    if (!shelf) {
      return kWrongFile;
    }
    tell(machines::prepare_unknown(machine, shelf->book, options.unknown));
    return run_controller<Kind>({machine.profile, shelf->book}, Kind::table(machine), machine.hash,
                                options, began_us);
  } else {
    if (!options.tasks.empty()) {
      std::fprintf(stderr, "graben-ecu: --task: %s is a %s's profile; a %s has no tasks\n",
                   options.profile.c_str(), Kind::kName, Kind::kName);
      return kWrongFile;
    }
    tell(machines::prepare_unknown(machine, options.unknown));
    return run_controller<Kind>(machine.profile, Kind::table(machine), machine.hash, options,
                                began_us);
  }
}

}  // namespace

int run(const EcuOptions& options, TimeUs began_us) try {
  const auto machine = read_profile(options.profile);
  if (!machine) {
    return kWrongFile;
  }
  return std::visit([&](const auto& of) { return run_machine(of, options, began_us); }, *machine);
} catch (const std::exception& error) {
  std::fprintf(stderr, "graben-ecu: %s\n", error.what());
  return kFailed;
}

}  // namespace graben::ecu
