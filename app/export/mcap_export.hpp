// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A candump log as MCAP: each message of our bus as a channel, its signals in SI units; what the
/// controller said of itself in words; its changes of mode and its faults as a log.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>

namespace graben::app_export {

struct ExportCounts {
  std::uint64_t messages = 0;  ///< Written, all channels together.
  std::size_t channels = 0;
  /// Frames that are no message of ours, by their id.
  std::map<std::uint32_t, std::size_t> foreign;
  std::size_t late = 0;  ///< Frames whose stamp was before that of the frame before them.
  double duration_s = 0.0;
};

/// Stamps of one log may be a little out of order where several interfaces are in it: such a frame
/// has the stamp of the one before it. Throws std::runtime_error with file, and line where it has
/// one, where the log cannot be read (a last line that is cut is passed over), is of no controller
/// of ours, or goes back by more than kMostBack_s; and where `mcap` cannot be written, which then
/// is a part of a file.
[[nodiscard]] ExportCounts export_mcap(const std::filesystem::path& log,
                                       const std::filesystem::path& mcap);
inline constexpr double kMostBack_s = 1.0;

}  // namespace graben::app_export
