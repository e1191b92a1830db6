// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which signals of a recording are a drive's.

#include <vector>

#include "app/identify/verdict/signal_log.hpp"

namespace graben::identify {

/// Columns of one drive.
struct Parts {
  int drive = 0;
  std::vector<const Signal*> command;  ///< One, or one of each direction.
  const Signal* position = nullptr;
  const Signal* velocity = nullptr;
  std::vector<const Signal*> pressure;
  bool from_spool = false;
};

/// A command's own signals, else what is measured of its spool; a second sensor only where it is
/// alone. `drive` is a place in kDriveNames.
[[nodiscard]] Parts parts_of(const SignalLog& log, int drive);

/// Columns that could be the same of a drive as one that counts are said.
void say_unused(const SignalLog& log, const std::vector<Parts>& parts,
                std::vector<std::string>& notes);

/// Values further apart than this, s, have a gap between them.
[[nodiscard]] double longest_step(double usual_s);

/// Per time: 1 where the motion's values are further apart than that, and just after it.
[[nodiscard]] std::vector<char> blind_rows(const Signal* motion, const std::vector<double>& time_s);

/// Over which a velocity is the mean, s.
inline constexpr double kWindow_s = 0.1;

/// One value in so many jumps far and back at once.
[[nodiscard]] double jump_share(const Signal& signal);

}  // namespace graben::identify
