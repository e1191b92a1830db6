// SPDX-License-Identifier: Apache-2.0
#include "app/identify/motion_delay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/identify/joint_motion.hpp"
#include "app/identify/motion_start.hpp"

namespace graben::identify {

TotalDelay total_delay(const JointModel& joint, double command) {
  constexpr double kRow_s = 0.005;
  constexpr std::size_t kRows = 600;
  constexpr std::size_t kStep = 1;  // The row from which the command holds.
  MotionRun run;
  for (std::size_t row = 0; row < kRows; ++row) {
    run.time_s.push_back(kRow_s * static_cast<double>(row));
    for (std::size_t of = 0; of < kJoints; ++of) {
      run.command[of].push_back(of == 0 && row >= kStep ? command : 0.0);
      run.angle_rad[of].push_back(0.5 * (joint.grid.least_rad + joint.grid.most_rad));
      run.velocity_radps[of].push_back(0.0);
    }
  }
  // Alone, whichever joint it is: first, with the usual pose as that of all rows.
  const MotionModel alone = {joint, JointModel{}, JointModel{}, JointModel{}};
  JointRun of = joint_run(alone, 0, run, nullptr);
  std::fill(of.pose.begin(), of.pose.end(), joint.grid.usual);
  const auto states = motion<double>(of, 0, joint.value.data(), joint.grid);
  const double last_radps = std::abs(states.back().velocity_radps);
  TotalDelay delay{std::numeric_limits<double>::quiet_NaN(),
                   std::numeric_limits<double>::quiet_NaN()};
  for (std::size_t row = kStep; row < kRows && last_radps > 1e-6; ++row) {
    const double reached = std::abs(states[row].velocity_radps) / last_radps;
    const double since_s = run.time_s[row] - run.time_s[kStep];
    if (reached >= 0.5 && std::isnan(delay.half_s)) {
      delay.half_s = since_s;
    }
    if (reached >= 0.9) {
      delay.most_s = since_s;
      break;
    }
  }
  return delay;
}

bool at_bound(const JointModel& joint, std::size_t parameter, double usual_radps) {
  constexpr double kNear = 1e-3;  // Of the width between the bounds.
  const Range allowed = range(parameter, usual_radps);
  const double near = kNear * (allowed.most - allowed.least);
  const double value = joint.value[parameter];
  return value < allowed.least + near || value > allowed.most - near;
}

}  // namespace graben::identify
