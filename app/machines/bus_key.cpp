// SPDX-License-Identifier: Apache-2.0
#include "app/machines/bus_key.hpp"

#include <fmt/format.h>

namespace graben::machines {
namespace {

/// What a bus may lack, and what then stands in for it (firmware/signals/bus_capabilities.hpp).
struct Lack {
  const char* key;
  const char* stand_in;
  bool BusCapabilities::*carried;
  const char* help;
  const char* sensor = nullptr;  ///< The key that says whether the machine has such sensors.
  const char* sensor_help = nullptr;
};

constexpr Lack kLacks[] = {
    {"stand_in.identity", "profile", &BusCapabilities::identity,
     "what stands in for an identity that the bus lacks"},
    {"stand_in.valve_echo", "motion", &BusCapabilities::valve_echo,
     "what stands in for the valve's echo of enable"},
    {"stand_in.spool_feedback", "command", &BusCapabilities::spool_feedback,
     "what stands in for measured spool positions; pilot where pilot pressures are told",
     "sensors.spool",
     "false: the spools have no sensors; stand_in.spool_feedback is then required"},
    {"stand_in.swash_feedback", "command", &BusCapabilities::swash_feedback,
     "what stands in for measured swash", "sensors.swash",
     "false: the pumps have no sensors of their swash; stand_in.swash_feedback is then required"},
    {"stand_in.pressures", "worst_load", &BusCapabilities::pressures,
     "what stands in for measured pressures of the cylinders", "sensors.pressure",
     "false: the cylinders have no pressure sensors; stand_in.pressures is then required"},
    {"stand_in.swash_command", "profile", &BusCapabilities::swash_command,
     "what stands in for a command of the pumps' swash"},
    {"stand_in.protection", "range", &BusCapabilities::protection,
     "what stands in for counter and CRC"},
};

const KnownBus& named_bus(TomlReader& reader, const std::vector<KnownBus>& buses) {
  if (!reader.has("bus")) {
    return buses.front();
  }
  std::vector<std::string> names;
  names.reserve(buses.size());
  for (const KnownBus& bus : buses) {
    names.push_back(bus.name);
  }
  return buses[static_cast<std::size_t>(reader.choice(
      "bus", names,
      "bus that the machine is on: ours, or a bus profile by its name; without it the first"))];
}

}  // namespace

std::string unsafe_words(const BusCapabilities& known) {
  if (!known.pressures && !known.spool_feedback) {
    return "neither spools nor pressures are measured: nothing tells a drive that goes as told "
           "from "
           "a sensor that says so; allowed: measure one of them";
  }
  return "";
}

const std::vector<KnownBus>& known_buses() {
  static const std::vector<KnownBus> buses = {{"graben", {}}};
  return buses;
}

BusCapabilities read_bus(TomlReader& reader, double dead_time_s,
                         const std::vector<KnownBus>& buses) {
  const KnownBus& bus = named_bus(reader, buses);
  BusCapabilities known = bus.capabilities;
  for (const Lack& lack : kLacks) {
    if (lack.sensor != nullptr && reader.has(lack.sensor)) {
      known.*lack.carried =
          reader.boolean_or(true, lack.sensor, lack.sensor_help) && known.*lack.carried;
    }
    const bool by_pilot =
        lack.carried == &BusCapabilities::spool_feedback && bus.capabilities.spool_by_pilot;
    const bool carried = known.*lack.carried && !by_pilot;
    if (by_pilot) {
      static_cast<void>(reader.choice(lack.key, {"pilot"}, lack.help));
    } else if (!carried) {
      // Missing, or another one than there is: the reader says so.
      static_cast<void>(reader.choice(lack.key, {lack.stand_in}, lack.help));
    } else if (reader.has(lack.key)) {
      static_cast<void>(reader.choice(lack.key, {lack.stand_in}, lack.help));
      reader.fail(lack.key, fmt::format("bus \"{}\" carries it: nothing stands in", bus.name));
    }
  }
  if (!known.pressures || reader.has("stand_in.worst_load")) {
    known.worst_load_ratio =
        reader.number_or(known.worst_load_ratio, "stand_in.worst_load", {0.0, 0.9, ""},
                         "load that lambda counts with where no pressure is measured, of the "
                         "pump's relief; only with sensors.pressure = false");
  }
  if (known.pressures && reader.has("stand_in.worst_load")) {
    reader.fail("stand_in.worst_load", "pressures are measured; allowed: leave it out");
  }
  if (const std::string words = unsafe_words(known); !words.empty()) {
    reader.fail("stand_in.pressures", words);
  }
  if (!bus.capabilities.swash_command && reader.has("task.swash_on_demand")) {
    reader.fail("task.swash_on_demand", fmt::format("bus \"{}\" takes no command of the swash; "
                                                    "allowed: leave it out",
                                                    bus.name));
  }
  for (const char* drive : {"valve.swing", "imu"}) {
    if (!bus.own_frames && reader.has(drive)) {
      reader.fail(
          drive,
          fmt::format("bus \"{}\" carries no swing and no IMUs; allowed: leave it out", bus.name));
    }
  }
  if (bus.capabilities.latency_s > dead_time_s) {
    reader.fail("bus", fmt::format("a latency of {} s is more than the valve's dead time of {} s, "
                                   "which has to cover it",
                                   bus.capabilities.latency_s, dead_time_s));
  }
  return known;
}

}  // namespace graben::machines
