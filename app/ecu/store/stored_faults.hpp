// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Stored faults as a tool reads them, of whatever profile; nothing is written.

#include <cstdint>
#include <string>
#include <vector>

#include "app/ecu/store/fault_history.hpp"
#include "app/ecu/store/freeze_frame.hpp"
#include "app/ecu/store/store_files.hpp"

namespace graben::ecu {

struct StoredFaults {
  bool has_history = false;  ///< Without it the rest says nothing but which files are not read.
  std::uint32_t profile_hash = 0;
  FaultHistory history;
  std::vector<StoredFrame> frames;        ///< Of that profile and of faults that are stored.
  std::vector<std::string> damaged;       ///< Files, where the other copy counts too.
  std::vector<std::string> unreadable;    ///< Files that are there, and why they are not read.
  std::vector<std::string> other_format;  ///< Files of a format that this program does not know.
};

/// Never throws for what is in the files.
[[nodiscard]] StoredFaults read_stored_faults(StoreFiles& files);

}  // namespace graben::ecu
