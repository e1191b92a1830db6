// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/led_spool.hpp"

#include <algorithm>

namespace graben::test {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr double kAhead_s = 0.02;
/// Its equation is integrated in small steps, not solved as the controller does.
constexpr double kStep_s = 1e-5;

}  // namespace

void LedSpool::go_on(double duty_ratio, double time_constant_s, double time_s) {
  const double omega_ps = 1.0 / time_constant_s;
  for (int step = 0; step < static_cast<int>(time_s / kStep_s + 0.5); ++step) {
    const double pull = omega_ps * omega_ps * (duty_ratio - travel_ratio_);
    speed_ps_ += kStep_s * (pull - 2.0 * omega_ps * speed_ps_);
    travel_ratio_ += kStep_s * speed_ps_;
  }
}

double LedSpool::aim(double duty_ratio, double time_constant_s) {
  unsure_commands_ = std::max(unsure_commands_ - 1, 0);
  LedSpool ahead = *this;
  ahead.go_on(duty_ratio, time_constant_s, kAhead_s);
  go_on(duty_ratio, time_constant_s, kPeriod_s);
  return ahead.travel_ratio_;
}

}  // namespace graben::test
