// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Keys `bus` and `stand_in` of a profile: the bus that the machine is on, and what stands in for
/// what that bus does not carry.

#include <string>
#include <vector>

#include "app/machines/toml_reader.hpp"
#include "firmware/signals/bus_capabilities.hpp"

namespace graben::machines {

/// A bus that a profile may name.
struct KnownBus {
  std::string name;
  BusCapabilities capabilities;
  bool own_frames = true;  ///< Frames of ours, as a swing drive's and IMUs', are on it.
};

/// Why a machine that can say no more than this can't be made safe; empty: it can.
[[nodiscard]] std::string unsafe_words(const BusCapabilities& known);

/// Those of this source tree.
[[nodiscard]] const std::vector<KnownBus>& known_buses();

/// Capabilities of the bus that `bus` names, "graben" without the key. Of what it lacks, `stand_in`
/// has to name the stand-in, and nothing else: a protection that is lost is lost knowingly. An
/// error for another name, a swing drive or IMUs on a bus without our frames, a stand-in that is
/// missing, wrong or not needed, or a latency beyond `dead_time_s`, which has to cover it.
[[nodiscard]] BusCapabilities read_bus(TomlReader& reader, double dead_time_s,
                                       const std::vector<KnownBus>& buses = known_buses());

}  // namespace graben::machines
