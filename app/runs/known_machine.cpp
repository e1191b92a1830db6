// SPDX-License-Identifier: Apache-2.0
#include "app/runs/known_machine.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/identified_profile.hpp"
#include "app/runs/drive_speeds.hpp"
#include "firmware/mcv/mcv_machine.hpp"

namespace graben::runs {
namespace {

using identify::Estimate;
using machines::DriveTruth;
using machines::SideTruth;

constexpr double kBand = 1.96;
/// Where an edge is measured: a valve opens gently, and nobody sees its first molecule.
constexpr double kEdgeArea = 0.002;

Estimate known(double value) { return {value, 0.0, true}; }

/// Travel at which so much of the area is open.
double travel_at(const SideTruth& side, double area_ratio) {
  for (std::size_t at = 1; at < side.opening.size(); ++at) {
    const auto& [before, area_before] = side.opening[at - 1];
    const auto& [after, area_after] = side.opening[at];
    if (area_after >= area_ratio) {
      // Between two points it is a power law rather than a straight line.
      const double power = 1.0 / side.opening_exponent;
      const double from = std::pow(area_before, power);
      const double share =
          (std::pow(area_ratio, power) - from) / (std::pow(area_after, power) - from);
      return before + std::clamp(share, 0.0, 1.0) * (after - before);
    }
  }
  return 1.0;
}

/// Speed coefficient at full opening over the profile's.
double coefficient_factor(const ExcavatorProfile& profile, int axis, bool extends,
                          const SideTruth& side) {
  const auto k = static_cast<unsigned>(axis);
  const SpoolProfile& spool = profile.valve.spool[k];
  const bool turns = axis == kSwing;
  const double cap_m2 =
      turns ? profile.swing.area_m2() : profile.geometry.cylinder[k].cap_area_m2();
  const double rod_m2 =
      turns ? profile.swing.area_m2() : profile.geometry.cylinder[k].rod_area_m2();
  const auto full = [&](double in_m2, double out_m2) {
    return full_opening_velocity_coefficient(profile.valve, in_m2, out_m2,
                                             extends ? cap_m2 : rod_m2, extends ? rod_m2 : cap_m2);
  };
  return full(side.in_m2, side.out_m2) / (extends
                                              ? full(spool.extend_in_m2, spool.extend_out_m2)
                                              : full(spool.retract_in_m2, spool.retract_out_m2));
}

void know_side(const ExcavatorProfile& profile, int axis, bool extends, const SideTruth& truth,
               double bypass_closes_at, identify::SideEstimate& side) {
  const SpoolProfile& spool = profile.valve.spool[static_cast<unsigned>(axis)];
  side.edge = known(truth.edge_ratio);
  side.softness = known(std::max(0.25 * truth.softness_ratio, 1e-3));
  side.exponent = known(truth.opening_exponent);
  side.coefficient_factor = known(coefficient_factor(profile, axis, extends, truth));
  side.out_area_factor =
      known(truth.out_m2 / (extends ? spool.extend_out_m2 : spool.retract_out_m2));
  side.dead_time_s = known(truth.dead_time_s);
  if (profile.pump[0].regulator.kind == PumpKind::kNegativeFlow) {
    side.bypass_closed_at = truth.start_ratio + bypass_closes_at * (1.0 - truth.start_ratio);
  }
  side.driven_least = truth.start_ratio;
  side.driven_most = 1.0;
  for (const double opening : identify::kTableOpenings) {
    side.duty.push_back(travel_at(truth, std::pow(opening, profile.valve.opening_exponent)));
    side.duty_deviation.push_back(0.0);
  }
}

/// Opening of the profile's model at which the bypass is closed: the mean of all sides, whose areas
/// grow by powers of their own.
double closes_at(const ExcavatorProfile& profile, const machines::MachineTruth& truth) {
  double sum = 0.0;
  for (int axis = 0; axis < profile.drive_count; ++axis) {
    const DriveTruth& drive = truth.drive[static_cast<unsigned>(axis)];
    for (const SideTruth* side : {&drive.extend, &drive.retract}) {
      sum +=
          std::pow(truth.bypass_closes_at, side->opening_exponent / profile.valve.opening_exponent);
    }
  }
  return sum / (2.0 * profile.drive_count);
}

/// Compares one value after the other.
class Count {
 public:
  explicit Count(IdentificationErrors& errors) : errors_(errors) {}

  void add(const Estimate& found, double truth, double& most) {
    const double error = std::abs(found.value - truth);
    most = std::max(most, error);
    if (found.known) {
      ++errors_.values;
      errors_.within += error <= kBand * found.deviation ? 1 : 0;
    }
  }

 private:
  IdentificationErrors& errors_;
};

void compare_side(const ExcavatorProfile& profile, const identify::SideEstimate& found,
                  const SideTruth& truth, IdentificationErrors& errors) {
  Count count(errors);
  const double is = found.curve().travel_at(kEdgeArea);
  count.add({is, found.edge.deviation, found.edge.known}, travel_at(truth, kEdgeArea),
            errors.edge_ratio);
  count.add(found.dead_time_s, truth.dead_time_s, errors.dead_time_s);
  double ignored = 0.0;
  for (std::size_t at = 1; at < found.duty.size(); ++at) {
    const double truly =
        travel_at(truth, std::pow(identify::kTableOpenings[at], profile.valve.opening_exponent));
    if (found.duty[at] <= found.driven_most) {
      count.add({found.duty[at], found.duty_deviation[at], true}, truly, ignored);
    }
  }
}

}  // namespace

identify::MachineEstimate known_machine(const ExcavatorProfile& profile,
                                        const machines::MachineTruth& truth) {
  identify::MachineEstimate machine;
  for (int axis = 0; axis < profile.drive_count; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const DriveTruth& from = truth.drive[k];
    identify::DriveEstimate& drive = machine.drive[k];
    know_side(profile, axis, true, from.extend, truth.bypass_closes_at, drive.extend);
    know_side(profile, axis, false, from.retract, truth.bypass_closes_at, drive.retract);
    drive.pilot_lag_s = known(0.0);
    drive.spool_time_constant_s = known(0.5 * from.extend.lag_s);
    drive.stroke_zero_m = known(from.stroke_zero_m);
    drive.cap_zero_pa = known(from.cap_zero_pa);
    drive.rod_zero_pa = known(from.rod_zero_pa);
  }
  if (profile.pump[0].regulator.kind == PumpKind::kNegativeFlow) {
    machine.bypass_closes_at = known(closes_at(profile, truth));
  }
  for (unsigned j = 0; j < kPumpCount; ++j) {
    machine.pump_flow_factor[j] = known(truth.pump_flow_factor[j]);
    if (profile.pump[j].regulator.sets_swash()) {
      machine.regulator[j].margin_pa = known(truth.regulator[j].margin_pa);
      machine.regulator[j].response_s = known(truth.regulator[j].response_s);
      machine.regulator[j].full_swash_pa = known(truth.regulator[j].full_swash_pa);
      machine.regulator[j].least_swash_pa = known(truth.regulator[j].least_swash_pa);
      machine.regulator[j].least_swash_ratio = known(truth.regulator[j].least_swash_ratio);
    }
  }
  return machine;
}

IdentificationErrors errors_of(const ExcavatorProfile& profile,
                               const identify::MachineEstimate& found,
                               const machines::MachineTruth& truth) {
  IdentificationErrors errors;
  Count count(errors);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const identify::DriveEstimate& drive = found.drive[k];
    const DriveTruth& truly = truth.drive[k];
    compare_side(profile, drive.extend, truly.extend, errors);
    compare_side(profile, drive.retract, truly.retract, errors);
    errors.lag_s = std::max(errors.lag_s, std::abs(drive.lag_s() - truly.extend.lag_s));
    count.add(drive.stroke_zero_m, truly.stroke_zero_m, errors.stroke_zero_m);
    count.add(drive.cap_zero_pa, truly.cap_zero_pa, errors.pressure_zero_pa);
    count.add(drive.rod_zero_pa, truly.rod_zero_pa, errors.pressure_zero_pa);
  }
  errors.speed = speed_errors(profile, found, known_machine(profile, truth));
  for (int j = 0; j < profile.pump_count; ++j) {
    const auto k = static_cast<unsigned>(j);
    count.add(found.pump_flow_factor[k], truth.pump_flow_factor[k], errors.pump_flow);
  }
  return errors;
}

}  // namespace graben::runs
