// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which signals of a recording are a drive's.

#include <vector>

#include "app/identify/verdict/signal_log.hpp"

namespace graben::identify {

/// Columns of one drive.
struct Parts {
  std::vector<const Signal*> command;  ///< One, or one of each direction.
  const Signal* position = nullptr;
  const Signal* velocity = nullptr;
  std::vector<const Signal*> pressure;
  bool from_spool = false;
};

/// A command's own signals, else what is measured of its spool; a second sensor only where it is
/// alone. `drive` is a place in kDriveNames.
[[nodiscard]] Parts parts_of(const SignalLog& log, int drive);

/// One value in so many jumps far and back at once.
[[nodiscard]] double jump_share(const Signal& signal);

}  // namespace graben::identify
