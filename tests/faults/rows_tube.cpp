// SPDX-License-Identifier: Apache-2.0
// Row 57: something pushes the tool off what it follows, while every sensor is right.

#include <cmath>

#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// Beyond the tube: what the stop itself takes.
constexpr double kBeyond_m = 0.25;

/// Pushed at the bucket's tip, harder and harder, by more than the machine can hold.
void pushed_off(Trial<Excavator>& trial) {
  auto& rig = trial.work();
  const RoundedRectangle path(rig.machine.profile.dig_path);
  const auto off_m = [&rig, &path] {
    const Eigen::Vector2d tip_m = rig.plant.plant().tip().position_m;
    return (path.closest(tip_m).position_m - tip_m).norm();
  };
  const double angle_rad = 6.283 * trial.random.uniform();
  const double before_m = off_m();
  double force_n = 0.0;
  constexpr double kRise_nps = 150e3;
  rig.before_all = [&] {
    force_n += 0.01 * kRise_nps;
    rig.plant.plant().set_tip_force(force_n *
                                    Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  };
  double most_m = 0.0;
  const bool stopped = rig.run_until(15 * kSecondUs, [&] {
    most_m = std::max(most_m, off_m());
    return !in_motion(rig.mode());
  });
  rig.before_all = nullptr;
  rig.plant.plant().set_tip_force(Eigen::Vector2d::Zero());
  trial.check(stopped, "not stopped, " + std::to_string(most_m) + " m off its path");
  trial.outcome.codes.add(rig.outputs().status.fault);
  trial.outcome.harm = most_m;
  trial.outcome.harm_unit = "m";
  const double tube_m = rig.machine.profile.safety.tube_m;
  trial.check(most_m <= before_m + tube_m + kBeyond_m, std::to_string(most_m) + " m off its path");
  trial.saw("N L");
}

/// The height is wrong by more and more, with the climb that belongs to it: the edge goes off its
/// design as far as anybody can tell.
void led_off(Trial<Dozer>& trial) {
  auto& rig = trial.work();
  const double way = trial.any_of(2) == 0 ? 1.0 : -1.0;
  // The blade's hoses leak away what it is told: held where it is.
  rig.plant.faults().pose.height.drift_ps = way * 0.3;
  rig.plant.faults().pose.climb.jump = way * 0.3;
  const bool stopped = rig.run_until(15 * kSecondUs, [&] { return !in_motion(rig.mode()); });
  trial.check(stopped, "not stopped");
  trial.outcome.codes.add(rig.outputs().status.fault);
  trial.saw("N L");
}

}  // namespace

Rows<Excavator> tube_rows(const Excavator&) {
  return {{57, "off its path, plan or design", "N L", pushed_off}};
}
Rows<Dozer> tube_rows(const Dozer&) {
  return {{57, "off its path, plan or design", "N L", led_off}};
}

}  // namespace graben::faults
