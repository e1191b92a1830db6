// SPDX-License-Identifier: Apache-2.0
#include "app/reports/check/warnings.hpp"

#include <algorithm>
#include <cmath>

#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::reports {
namespace {

/// Slowest message of the machine that a sensor's timeout has to bridge, once lost; s. A window of
/// commissioning is none: it holds for a second; nor is a touch, nor second sensors with times of
/// their own.
template <class Messages>
double slowest_period_s(const Messages& messages) {
  constexpr int kIdentity_ms = 1000;
  int most_ms = 0;
  for (const auto& message : messages) {
    if (std::string(message.sender) != "Graben" && message.cycle_time_ms < kIdentity_ms &&
        message.id != dbc::excavator::CommissionWindow::kId &&
        message.id != dbc::dozer::DozerWindow::kId &&
        message.id != dbc::excavator::TouchedPoint::kId &&
        message.id != dbc::excavator::ExternalLimit::kId &&
        std::string(message.sender) != "SecondSensors") {
      most_ms = std::max<int>(most_ms, message.cycle_time_ms);
    }
  }
  return most_ms * 1e-3;
}

}  // namespace

double edge_drop_pa(double flow_m3ps, double area_m2, double discharge, double density_kgpm3) {
  const double speed_mps = flow_m3ps / (discharge * area_m2);
  return 0.5 * density_kgpm3 * speed_mps * speed_mps;
}

void expect_rod(Warnings& warnings, const std::string& key, double bore_m, double rod_m) {
  warnings.expect(key + ".rod", rod_m / bore_m, 0.4, 0.85,
                  fmt::format("rod of {:g} m in a bore of {:g} m, a share of it", rod_m, bore_m));
}

void expect_times(Warnings& warnings, double settle_s, double sensor_timeout_s, double response_s) {
  const double period_s = std::max(slowest_period_s(dbc::excavator::kMessages),
                                   slowest_period_s(dbc::dozer::kMessages));
  warnings.add_if(sensor_timeout_s < 2.0 * period_s, "control.sensor_timeout",
                  fmt::format("{:g} s; messages come every {:g} s at the slowest, so that one lost "
                              "frame is already a lost sensor; usual: at least {:g} s",
                              sensor_timeout_s, period_s, 2.0 * period_s));
  warnings.add_if(settle_s < response_s, "safety.settle",
                  fmt::format("{:g} s is shorter than control.response, {:g} s: the watch does not "
                              "wait for what the controller itself reckons with",
                              settle_s, response_s));
}

void expect_spool(Warnings& warnings, const std::string& valve, double time_constant_s,
                  double damping, double settle_s, double response_s) {
  // A second-order lag is within 10 % of its end after about this many time constants.
  const double lag_s = 3.9 * std::max(damping, 0.7) * time_constant_s;
  warnings.add_if(settle_s < lag_s, "safety.settle",
                  fmt::format("{:g} s is shorter than the spool's own lag: {:.3f} s with {}."
                              "time_constant {:g} s; the watch takes a sound spool for a stuck one",
                              settle_s, lag_s, valve, time_constant_s));
  warnings.add_if(response_s < time_constant_s, "control.response",
                  fmt::format("{:g} s; the spool alone takes {:g} s ({}.time_constant)", response_s,
                              time_constant_s, valve));
}

void expect_deadband(Warnings& warnings, const std::string& key, double deadband_ratio,
                     const DutyTable& spool_to_duty) {
  const double first = spool_to_duty.y_first();
  warnings.add_if(
      std::abs(first - deadband_ratio) > 0.1, key,
      fmt::format("opens from a duty of {:.2f} on, where the simulated spool's deadband "
                  "ends at {:.2f} of its travel",
                  first, deadband_ratio));
}

void expect_oil(Warnings& warnings, const std::string& valve, double bulk_modulus_pa) {
  warnings.expect(valve + ".bulk_modulus", bulk_modulus_pa * 1e-9, 0.5, 2.2,
                  "stiffness of the oil with its hoses", "GPa");
}

}  // namespace graben::reports
