// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commissioning on a CAN interface.

#include <filesystem>
#include <string>

#include "app/commission/commission_progress.hpp"
#include "app/operate/commission_station.hpp"

namespace graben::operate {

struct LiveOptions {
  std::string interface;
  std::string gamepad;    ///< Path; empty: the only one there is.
  bool keyboard = false;  ///< In place of a gamepad.
  TimeUs silent_after_us = 20 * kSecondUs;
  std::filesystem::path log;  ///< candump log; grows.
};

struct LiveResult {
  CommissionEnd end = CommissionEnd::kNone;  ///< kNone: told to end.
  std::string words;                         ///< CommissionStation::end_words().
  std::size_t done = 0;                      ///< Steps.
  std::size_t steps = 0;                     ///< Of so many.
  double machine_s = 0.0;                    ///< In which the machine was active, of this run.
};

/// Sends every 20 ms, after half a second of listening, until all is done, the controller or a
/// wrong way stops it, or the process is told to end; enable off goes out before it ends, and also
/// if it dies by a signal that can be caught. The log has all frames, with the date, and is in the
/// file after 0.2 s at most; the progress file is written after every step, while nothing moves.
/// Throws std::runtime_error, with the reason, if it cannot begin or may not go on.
/// `progress`: what is to be done, and what is done already.
[[nodiscard]] LiveResult run_live_commission(const LiveOptions& options,
                                             const commission::Progress& progress);
[[nodiscard]] LiveResult run_live_commission(const LiveOptions& options,
                                             const commission::DozerProgress& progress);

}  // namespace graben::operate
