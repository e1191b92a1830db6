// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a machine that drives comes to rest after it was stopped, and whether it stays there.
///
/// Its pumps take some time to come back to 0, then its lines and losses hold it; the parking brake
/// closes when the tracks stand. A brake that closes before lets the body slide on its tracks.
/// Three figures: the time and the way from when the machine's side goes neutral until body and
/// tracks stand for good, and the furthest that the body is from there afterwards.

#include <vector>

#include "firmware/core/time.hpp"

namespace graben::faults {

/// Of the controller, and of what is recorded of its machine.
inline constexpr TimeUs kCycle_us = 10 * kMillisecondUs;

struct Rolling {
  double fastest_mps = 0.0;  ///< Of body and tracks.
  double position_m = 0.0;
};

class RollingWatch {
 public:
  /// Each cycle from when the machine's side is neutral on.
  void see(const Rolling& rolling) { seen_.push_back(rolling); }

  [[nodiscard]] TimeUs rest_us() const;
  [[nodiscard]] double rolled_m() const;
  [[nodiscard]] double moved_at_rest_m() const;
  [[nodiscard]] bool rests() const { return cycles_to_rest() < seen_.size(); }

 private:
  [[nodiscard]] std::size_t cycles_to_rest() const;

  std::vector<Rolling> seen_;
};

}  // namespace graben::faults
