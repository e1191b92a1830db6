// SPDX-License-Identifier: Apache-2.0
#include "app/runs/drive_speeds.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/identified_profile.hpp"
#include "app/identify/machine/speed_model.hpp"
#include "firmware/excavator/excavator_drives.hpp"

namespace graben::runs {
namespace {

constexpr double kLoad_pa = 5e6;
constexpr double kDutyStep = 0.01;

/// A drive's steady speeds by a profile.
class DriveSpeed {
 public:
  explicit DriveSpeed(const ExcavatorProfile& profile) : profile_(profile), model_(profile) {}

  [[nodiscard]] double at_mps(int axis, bool extends, double duty) const {
    const auto k = static_cast<std::size_t>(axis);
    identify::ValveMoment moment;
    const double opening = answer_of(profile_, axis, extends).spool_to_duty.inverse(duty);
    moment.opening[k] = extends ? opening : -opening;
    (extends ? moment.cap_pa : moment.rod_pa)[k] = kLoad_pa;
    moment.swash = profile_.dig_swash_ratio;
    moment.engine_radps = profile_.pump[0].rated_speed_radps;
    return std::abs(model_.speeds_mps(moment)[k]);
  }

 private:
  const ExcavatorProfile& profile_;
  identify::SpeedModel model_;
};

}  // namespace

double largest_speed_error(const ExcavatorProfile& profile, const identify::MachineEstimate& found,
                           const identify::MachineEstimate& truth) {
  const ExcavatorProfile found_profile = identify::identified(profile, found);
  const ExcavatorProfile true_profile = identify::identified(profile, truth);
  const DriveSpeed is(found_profile);
  const DriveSpeed truly(true_profile);
  double most = 0.0;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    for (const bool extends : {true, false}) {
      const identify::SideEstimate& side =
          found.drive[static_cast<std::size_t>(axis)].side(extends);
      const double full_mps = truly.at_mps(axis, extends, 1.0);
      for (double duty = side.driven_least; duty <= side.driven_most; duty += kDutyStep) {
        const double off_mps = is.at_mps(axis, extends, duty) - truly.at_mps(axis, extends, duty);
        most = std::max(most, std::abs(off_mps) / full_mps);
      }
    }
  }
  return most;
}

}  // namespace graben::runs
