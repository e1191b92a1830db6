// SPDX-License-Identifier: Apache-2.0
#include "app/runs/drive_speeds.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/drive_model.hpp"
#include "app/identify/machine/identified_profile.hpp"

namespace graben::runs {
namespace {

constexpr double kLoad_pa = 5e6;
constexpr double kDutyStep = 0.01;

/// Steady, of one drive alone. Of a side that is known to close its bypass over the travel (`by`
/// not null), as it does that, not as a profile can say it.
double speed_mps(const identify::DriveModel& model, const std::array<double, kPumpCount>& swash,
                 std::size_t axis, bool extends, double duty, const identify::SideEstimate* by) {
  identify::ValveMoment moment;
  const double opening = model.drive[axis].answer.side(extends).spool_to_duty.inverse(duty);
  moment.opening[axis] = extends ? opening : -opening;
  if (by != nullptr && by->bypass_closed_at > 0.0) {
    const double start = by->curve().start();
    moment.bypass_closed[axis] =
        std::clamp((duty - start) / (by->bypass_closed_at - start), 0.0, 1.0);
  }
  (extends ? moment.cap_pa : moment.rod_pa)[axis] = kLoad_pa;
  moment.swash = swash;
  moment.engine_radps = model.pump[0].rated_speed_radps;
  return std::abs(model.speeds_mps(moment)[axis]);
}

/// Over the duties that were driven, of full speed.
double side_error(const ExcavatorProfile& profile, const identify::SideEstimate& side,
                  const identify::DriveModel& is, const identify::DriveModel& truly,
                  const identify::MachineEstimate& truth, std::size_t axis, bool extends) {
  const identify::SideEstimate& true_side = truth.drive[axis].side(extends);
  const auto true_mps = [&](double duty) {
    return speed_mps(truly, profile.dig_swash_ratio, axis, extends, duty, &true_side);
  };
  const double full_mps = true_mps(1.0);
  double most = 0.0;
  for (double duty = side.driven_least; duty <= side.driven_most; duty += kDutyStep) {
    const double found_mps = speed_mps(is, profile.dig_swash_ratio, axis, extends, duty, nullptr);
    most = std::max(most, std::abs(found_mps - true_mps(duty)) / full_mps);
  }
  return most;
}

}  // namespace

double swing_speed_error(const ExcavatorProfile& profile, const identify::MachineEstimate& found,
                         const identify::MachineEstimate& truth, bool left) {
  return side_error(profile, found.drive[kSwing].side(left),
                    identify::DriveModel(identify::identified(profile, found)),
                    identify::DriveModel(identify::identified(profile, truth)), truth, kSwing,
                    left);
}

SpeedErrors speed_errors(const ExcavatorProfile& profile, const identify::MachineEstimate& found,
                         const identify::MachineEstimate& truth) {
  const identify::DriveModel is(identify::identified(profile, found));
  const identify::DriveModel truly(identify::identified(profile, truth));
  SpeedErrors errors;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    for (const bool extends : {true, false}) {
      const identify::SideEstimate& side = found.drive[axis].side(extends);
      const double error = side_error(profile, side, is, truly, truth, axis, extends);
      errors.most = std::max(errors.most, error);
      errors.within += side.driven_most > 0.0 && error <= kSpeedFound ? 1 : 0;
      ++errors.sides;
    }
  }
  return errors;
}

}  // namespace graben::runs
