// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A candump log as MCAP: each message of our bus, of the machine's own and of the sensors on its
/// links as a channel, its signals in SI units; what the controller said of itself in words; its
/// changes of mode and its faults as a log.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/machines/bus_file.hpp"

namespace graben::app_export {

/// 29 bits or 11, and the id.
using CanId = std::pair<bool, std::uint32_t>;

struct ExportCounts {
  std::uint64_t messages = 0;  ///< Written, all channels together.
  std::size_t channels = 0;
  /// Frames that are on no channel, by their id.
  std::map<CanId, std::size_t> foreign;
  std::vector<std::string> notes;  ///< What else was in the log (LogRead).
  double duration_s = 0.0;
};

/// The bus that a machine is on, by what the controller of a log called its profile, 0 where it did
/// not; none: ours alone.
using FindBus = std::function<std::optional<machines::BusFile>(std::uint32_t profile_hash)>;

/// Stamps never go back (LogClock). Throws std::runtime_error with file, and line where it has one,
/// where the log cannot be read or is of no controller of ours; and where `mcap` cannot be written,
/// which then is a part of a file.
[[nodiscard]] ExportCounts export_mcap(const std::filesystem::path& log,
                                       const std::filesystem::path& mcap, const FindBus& find_bus);

}  // namespace graben::app_export
