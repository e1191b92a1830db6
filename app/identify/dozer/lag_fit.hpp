// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How late a measured value follows what was sent: a dead time, then equal lags of the first
/// order.

#include <vector>

#include "app/identify/machine/estimate.hpp"

namespace graben::identify {

/// One of the pieces to be looked at: what was sent and what came of it, each kGrid_s.
struct SentAndSeen {
  const std::vector<double>& sent;
  const std::vector<double>& seen;
  std::vector<char> judged;  ///< Grid points that count; all if empty.
};

struct LagFit {
  Estimate dead_time_s;
  Estimate lag_s;  ///< Of all lags together.
  double rms = 0.0;
};

/// Both are known where anything moves at all. `lags`: 1 or 2. `start`: where the value rests.
[[nodiscard]] LagFit fit_lag(const std::vector<SentAndSeen>& pieces, int lags, double start);

}  // namespace graben::identify
