// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/oil/held_load.hpp"

#include <algorithm>

#include "firmware/core/time.hpp"
#include "firmware/excavator/estimation/oil/tuning.hpp"

namespace graben {
namespace {

double share_of_newest(double lag_s, double time_s) { return time_s / (time_s + lag_s); }

}  // namespace

void next_held_load(const OilState& oil, const Eigen::Vector2d& due_mps,
                    const Eigen::Matrix2d& inertia_kg, int cycles, HeldLoad& held) {
  const double time_s = kCyclePeriod_s * cycles;
  held.gives_way = oil.weight > 0.0 && (held.gives_way || !held.yield_mpsn.isZero(0.0));
  held.leads = held.gives_way && oil.weight > kOilLeads;
  if (!held.gives_way) {
    held.due_mps = due_mps;
    held.push_mps2.setZero();
    held.load_n = -oil.load_n;
    return;
  }
  const Eigen::Vector2d push_mps2 = (due_mps - held.due_mps) / time_s;
  held.due_mps = due_mps;
  held.push_mps2 += share_of_newest(kHeldPush_s, time_s) * (push_mps2 - held.push_mps2);
  held.load_n += share_of_newest(kHeldLoad_s, time_s) * (-oil.load_n - held.load_n);
  held.force_n = held.load_n + inertia_kg * held.push_mps2;
}

McvInput opened_for(const HeldLoad& held, DriveRows drives, const McvInput& input) {
  McvInput opened = input;
  for (int axis = 0; held.leads && axis < 2; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const DriveRow& drive = drives[axis];
    const double rod_n = drive.retract_area_m2 * input.rod_pressure_pa[k];
    const double cap_n = held.force_n[axis] + rod_n;
    opened.cap_pressure_pa[k] = std::max(0.0, cap_n) / drive.extend_area_m2;
    // What the cap side can't do without a pressure below 0, the rod side does.
    opened.rod_pressure_pa[k] = (rod_n + std::max(0.0, -cap_n)) / drive.retract_area_m2;
  }
  return opened;
}

Eigen::Vector2d filtered_force_n(const DriveRows& drives, const Span<const LoadState>& load) {
  const auto of_axis_n = [](const DriveRow& drive, const LoadState& at) {
    return drive.extend_area_m2 * at.cap_pa - drive.retract_area_m2 * at.rod_pa;
  };
  return {of_axis_n(drives[0], load[0]), of_axis_n(drives[1], load[1])};
}

}  // namespace graben
