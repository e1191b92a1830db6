// SPDX-License-Identifier: Apache-2.0
#include "app/commission/wrong_way.hpp"

#include <fmt/format.h>

#include <cmath>

namespace graben::commission {
namespace {

/// The controller's guard stops at 30 mm: with what a late machine still goes, this is before.
constexpr double kAgainst_m = 0.010;
/// Of another drive: its load is shaken as well.
constexpr double kOther_m = 0.015;
/// Slower it creeps: a load that sinks through an edge that begins to open.
constexpr double kGoes_mps = 0.010;

}  // namespace

std::optional<WrongWay> look_for_wrong_way(const SequenceStep& ramp,
                                           const std::array<double, kAxisCount>& begin_m,
                                           const std::array<double, kAxisCount>& now_m,
                                           const std::array<double, kAxisCount>& speed_mps) {
  const auto own = static_cast<unsigned>(ramp.axis);
  if (ramp.sign * (begin_m[own] - now_m[own]) > kAgainst_m &&
      ramp.sign * speed_mps[own] < -kGoes_mps) {
    return WrongWay{ramp.axis, ramp.sign, ramp.axis};
  }
  for (int other = 0; other < kAxisCount; ++other) {
    const auto k = static_cast<unsigned>(other);
    const double moved_m = now_m[k] - begin_m[k];
    const bool goes = std::abs(speed_mps[k]) > kGoes_mps && moved_m * speed_mps[k] > 0.0;
    if (other != ramp.axis && goes && std::abs(moved_m) > kOther_m) {
      return WrongWay{ramp.axis, ramp.sign, other};
    }
  }
  return std::nullopt;
}

std::string wrong_text(const WrongWay& wrong) {
  const char* const told = wrong.sign > 0 ? "extend" : "retract";
  if (wrong.seen == wrong.axis) {
    return fmt::format("the {}'s stroke {} while it is told to {}: sensor or valve reversed",
                       axis_name(wrong.axis), wrong.sign > 0 ? "falls" : "rises", told);
  }
  return fmt::format(
      "the {}'s stroke moves while only the {} is told to {}: sensors or valves "
      "are swapped",
      axis_name(wrong.seen), axis_name(wrong.axis), told);
}

}  // namespace graben::commission
