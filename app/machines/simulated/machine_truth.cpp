// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/machine_truth.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace graben::machines {
namespace {

/// Points of an opening: in the bend and behind it.
constexpr int kBendPoints = 8;
constexpr int kPowerPoints = 16;

std::vector<std::pair<double, double>> opening_of(const plant::SpoolSide& side) {
  std::vector<std::pair<double, double>> opening;
  const auto add = [&](double duty_ratio) {
    if (opening.empty() || duty_ratio > opening.back().first) {
      opening.emplace_back(duty_ratio, side.area_ratio(duty_ratio));
    }
  };
  const double start = side.start_ratio();
  const double bend_end = start + side.softness_ratio;
  add(start);
  for (int i = 1; i <= kBendPoints; ++i) {
    add(start + side.softness_ratio * i / kBendPoints);
  }
  for (int i = 1; i <= kPowerPoints; ++i) {
    add(bend_end + (1.0 - bend_end) * i / kPowerPoints);
  }
  return opening;
}

/// Skogestad's half rule over pilot and spool, whose poles count as real.
void set_first_order(SideTruth& truth, const plant::SpoolDynamics& spool, double pilot_lag_s) {
  const double apart = std::sqrt(std::max(0.0, spool.damping * spool.damping - 1.0));
  std::array<double, 3> lag_s = {pilot_lag_s, spool.time_constant_s * (spool.damping + apart),
                                 spool.time_constant_s * (spool.damping - apart)};
  std::sort(lag_s.begin(), lag_s.end(), std::greater<>());
  truth.first_order_lag_s = lag_s[0] + 0.5 * lag_s[1];
  truth.first_order_dead_time_s = truth.dead_time_s + 0.5 * lag_s[1] + lag_s[2];
}

SideTruth side_truth(const plant::SpoolSide& side, const plant::SpoolDynamics& spool,
                     double dead_time_s, double pilot_lag_s) {
  SideTruth truth;
  truth.edge_ratio = side.deadband_ratio;
  truth.softness_ratio = side.softness_ratio;
  truth.start_ratio = side.start_ratio();
  truth.opening_exponent = side.opening_exponent;
  truth.opening = opening_of(side);
  truth.dead_time_s = dead_time_s;
  truth.lag_s = 2.0 * spool.damping * spool.time_constant_s + pilot_lag_s;
  set_first_order(truth, spool, pilot_lag_s);
  return truth;
}

}  // namespace

MachineTruth truth_of(const plant::ExcavatorPlantProfile& plant) {
  MachineTruth truth;
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    DriveTruth& drive = truth.drive[i];
    const plant::SpoolDynamics& spool = plant.spool[i];
    const SpoolProfile& nominal = plant.machine.valve.spool[i];
    const plant::AreaFactors& factors = plant.area_factors[i];
    drive.extend =
        side_truth(spool.extend, spool, plant.dead_time[i].extend_s, plant.pilot_lag_s[i]);
    drive.retract =
        side_truth(spool.retract, spool, plant.dead_time[i].retract_s, plant.pilot_lag_s[i]);
    drive.extend.in_m2 = factors.extend_in * nominal.extend_in_m2;
    drive.extend.out_m2 = factors.extend_out * nominal.extend_out_m2;
    drive.retract.in_m2 = factors.retract_in * nominal.retract_in_m2;
    drive.retract.out_m2 = factors.retract_out * nominal.retract_out_m2;
    drive.stroke_zero_m = i < kAxisCount ? plant.sensors.stroke_zero_m[i] : 0.0;
    drive.cap_zero_pa = plant.sensors.cap_zero_pa[i];
    drive.rod_zero_pa = plant.sensors.rod_zero_pa[i];
  }
  truth.pump_flow_factor = plant.pump_flow_ratio;
  truth.bulk_modulus_pa = plant.bulk_modulus_pa;
  truth.bypass_closes_at = plant.spool[0].bypass_closes_at;
  for (std::size_t pump = 0; pump < kPumpCount; ++pump) {
    truth.regulator[pump] = plant.machine.pump[pump].regulator;
  }
  return truth;
}

}  // namespace graben::machines
