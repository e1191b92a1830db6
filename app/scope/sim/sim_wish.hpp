// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a page may ask of a simulation (`ToServer` of page/src/model/api.ts), checked.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "app/scope/sim/sim_fault.hpp"

namespace graben::scope {

inline constexpr double kPaceLeast = 0.1;
inline constexpr double kPaceMost = 10.0;
inline constexpr double kSpeedLeast = 0.05;
inline constexpr double kSpeedMost = 1.0;

struct SimWish {
  enum class Do { kRun, kStop, kRestart, kClear, kPace, kSpeed, kSoil, kObstacle, kFault };

  Do what = Do::kRun;
  double value = 0.0;     ///< Of kPace and kSpeed.
  bool on = false;        ///< Of kSoil, kObstacle and kFault.
  std::size_t fault = 0;  ///< Which of them, of kFault.
};

/// The wish, or why it is none, in words for the page. `has_ground`: whether there can be soil and
/// an obstacle. `message` holds anything.
[[nodiscard]] std::variant<SimWish, std::string> read_wish(const nlohmann::json& message,
                                                           const std::vector<SimFault>& faults,
                                                           bool has_ground);

}  // namespace graben::scope
