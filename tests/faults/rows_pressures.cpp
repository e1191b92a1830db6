// SPDX-License-Identifier: Apache-2.0
// Row 65: pressures that are alive and wrong: the two of a drive swapped, both 0, doubled, halved.

#include <algorithm>

#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// The true tip may come no further from the path than this more than it would anyway.
constexpr double kMostOff_m = 0.15;
constexpr TimeUs kWatched_us = 10 * kSecondUs;

void spoil(plant::AxisFaults& faults, std::uint64_t seed) {
  switch (seed % 4) {
    case 0:
      faults.pressures_swapped = true;
      break;
    case 1:
      faults.cap.scale = faults.rod.scale = 0.0;
      break;
    case 2:
      faults.cap.scale = faults.rod.scale = 2.0;
      break;
    default:
      faults.cap.scale = faults.rod.scale = 0.5;
      break;
  }
}

double off_path_m(const Rig<Excavator>& rig) {
  const RoundedRectangle path(rig.machine.profile.dig_path);
  const Eigen::Vector2d tip_m = rig.plant.plant().tip().position_m;
  return (path.closest(tip_m).position_m - tip_m).norm();
}

/// It has to be stopped or slowed before the tool is anywhere else; what does no harm may go on.
void pressures_wrong(Trial<Excavator>& trial) {
  auto& rig = trial.work();
  const unsigned axis = trial.any_of(kAxisCount);
  const double before_m = off_path_m(rig);
  spoil(rig.plant.faults().axis[axis], trial.seed());
  const TimeUs since_us = rig.at_us();
  double most_m = 0.0;
  const bool seen = rig.run_until(kWatched_us, [&] {
    most_m = std::max(most_m, off_path_m(rig) - before_m);
    return rig.mode() != EcuMode::kActive;
  });
  if (seen) {
    trial.outcome.codes.add(rig.outputs().status.fault);
    trial.outcome.to_detection_us = rig.at_us() - since_us;
  }
  trial.outcome.harm = most_m;
  trial.outcome.harm_unit = "m";
  trial.check(most_m <= kMostOff_m,
              "the true tip is " + std::to_string(1e3 * most_m) + " mm further off the path");
  trial.saw(seen ? "N L" : "no harm");
}

}  // namespace

Rows<Excavator> pressure_rows() {
  return {{65, "pressures swapped, 0, doubled, halved", "N L | no harm", pressures_wrong}};
}

}  // namespace graben::faults
