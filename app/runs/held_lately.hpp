// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a stalled run lacked: what held it in its last seconds.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/runs/code_text.hpp"

namespace graben::runs {

/// Looked at before the stop. [s; chosen: of the 10 s that a stall takes; not tried]
inline constexpr double kHeldLately_s = 5.0;

/// ", held by back flow: bucket 60 %, back flow: arm 31 %": of the last seconds in which anything
/// held the motion, each limit with its share, most first; empty unless `fault` is a stall, or
/// where nothing held it. Samples with `time_s` and `limit`, in the order of time.
template <class Samples>
[[nodiscard]] std::string held_lately(Fault fault, const Samples& samples,
                                      const ActuatorNames& actuators) {
  if (fault != Fault::kStalled) {
    return "";
  }
  const auto is_held = [](const auto& sample) { return sample.limit.kind != LimitKind::kNone; };
  const auto last = std::find_if(samples.rbegin(), samples.rend(), is_held);
  LimitCount count(actuators);
  for (auto sample = last; sample != samples.rend(); ++sample) {
    if (sample->time_s < last->time_s - kHeldLately_s) {
      break;
    }
    count.add(sample->limit, 1.0);
  }
  LimitShares shares = count.shares();
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [words, share] : shares) {
    if (words != "none" && share > 0.0) {
      text += fmt::format("{} {} {:.0f} %", text.empty() ? ", held by" : ",", words, 100.0 * share);
    }
  }
  return text;
}

}  // namespace graben::runs
