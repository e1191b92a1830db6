// SPDX-License-Identifier: Apache-2.0
#include "app/identify/motion_start.hpp"

#include <algorithm>
#include <cmath>

namespace graben::identify {
namespace {

constexpr double kUsualDelay_s = 0.2;  // For the joint's sign alone.

/// +1 where a positive command makes the velocity positive.
double sign_of(const std::vector<MotionRun>& runs, std::size_t joint) {
  double agrees = 0.0;
  for (const MotionRun& run : runs) {
    std::size_t late = 0;
    for (std::size_t row = 0; row < run.size(); ++row) {
      while (run.time_s[late] < run.time_s[row] - kUsualDelay_s) {
        ++late;
      }
      // Beyond half of the command: nobody knows the edges yet.
      const double command = run.command[joint][late];
      agrees += (std::abs(command) > 0.5 ? command : 0.0) * run.velocity_radps[joint][row];
    }
  }
  return agrees < 0.0 ? -1.0 : 1.0;
}

/// Where a curve may bend before anything is known: even from the least opening that is likely.
constexpr double kLeastEdge = 0.05;

constexpr double kBeforeEdge = 0.03;  // Of the command, for an edge that was found too late.
constexpr double kOpen = 0.03;        // Of full speed.

Bends even_bends() {
  Bends bends{};
  for (std::size_t at = 0; at < kKnots; ++at) {
    bends[at] = kLeastEdge + (1.0 - kLeastEdge) * static_cast<double>(at) / (kKnots - 1);
  }
  return bends;
}

Grid grid_of(const std::vector<MotionRun>& runs, std::size_t joint) {
  constexpr double kLeastTravel_rad = 1e-3;  // Of a joint that stands.
  Grid grid;
  grid.forward = even_bends();
  grid.backward = even_bends();
  grid.least_rad = runs[0].angle_rad[joint][0];
  grid.most_rad = grid.least_rad + kLeastTravel_rad;
  double rows = 0.0;
  for (const MotionRun& run : runs) {
    for (std::size_t row = 0; row < run.size(); ++row) {
      const Angles angles = angles_at(run, row);
      grid.least_rad = std::min(grid.least_rad, angles[joint]);
      grid.most_rad = std::max(grid.most_rad, angles[joint]);
      const Pose pose = pose_of(angles);
      for (std::size_t part = 0; part < kPose; ++part) {
        grid.usual[part] += pose[part];
      }
      rows += 1.0;
    }
  }
  for (double& part : grid.usual) {
    part /= rows;
  }
  return grid;
}

/// Commands of one direction (`sign`) as positive numbers, in order.
std::vector<double> sorted_commands(const std::vector<MotionRun>& runs, std::size_t joint,
                                    double sign) {
  std::vector<double> commands;
  for (const MotionRun& run : runs) {
    for (const double command : run.command[joint]) {
      if (sign * command > 0.0) {
        commands.push_back(sign * command);
      }
    }
  }
  std::sort(commands.begin(), commands.end());
  return commands;
}

/// Where the curve from `rises` starts to open.
double edge_of(const double* rises, const Bends& bends) {
  constexpr double kFine = 0.005;
  const double most = curve_at(rises, bends, 1.0);
  double edge = bends[0];
  while (curve_at(rises, bends, edge) < kOpen * most) {
    edge += kFine;
  }
  return std::max(kLeastEdge, edge - kBeforeEdge);
}

/// One curve of spread_bends().
void spread(double* rises, Bends& bends, const std::vector<double>& commands) {
  if (curve_at(rises, bends, 1.0) <= 0.0) {
    return;
  }
  constexpr double kLeastApart = 0.02;
  const double edge = edge_of(rises, bends);
  const auto first = std::lower_bound(commands.begin(), commands.end(), edge);
  const auto count = static_cast<double>(commands.end() - first);
  Bends to{};
  to[0] = edge;
  for (std::size_t at = 1; at < kKnots; ++at) {
    const double share = static_cast<double>(at) / (kKnots - 1);
    const double even = edge + (1.0 - edge) * share;
    const double driven =
        count > 0.0 ? first[static_cast<std::ptrdiff_t>(share * (count - 1.0))] : even;
    to[at] = std::clamp(0.5 * (even + driven), to[at - 1] + kLeastApart,
                        1.0 - kLeastApart * static_cast<double>(kKnots - 1 - at));
  }
  to.back() = 1.0;
  std::array<double, kRises> rise{};
  for (std::size_t at = 0; at < kRises; ++at) {
    rise[at] = curve_at(rises, bends, to[at + 1]) - curve_at(rises, bends, to[at]);
  }
  bends = to;
  std::copy(rise.begin(), rise.end(), rises);
}

}  // namespace

Range range(std::size_t parameter, double usual_radps) {
  constexpr double kFree = 1e6;
  if (parameter == kDeadTime) {
    return {0.0, 0.12, 0.5, kFree};
  }
  if (parameter < kForward) {
    return {0.005, 0.04, 0.6, kFree};
  }
  if (parameter < kFlowLag) {
    return {0.0, 0.5 * usual_radps, 50.0 * usual_radps, kFree};
  }
  if (parameter < kModeRate) {
    return {0.001, 0.005, 1.5, 0.1};
  }
  if (parameter == kModeRate) {
    return {1.0, 12.0, 40.0, kFree};
  }
  if (parameter < kInertia) {
    return {0.1, 8.0, 100.0, kFree};
  }
  if (parameter < kLoadForward) {
    return {-3.0, 0.0, 3.0, 0.3};
  }
  if (parameter < kLinkageRatio) {
    return {-5.0, 0.0, 5.0, 0.5};
  }
  if (parameter < kShare) {
    return {0.02, 1.0, 5.0, 1.0};
  }
  if (parameter < kRockRate) {
    return {0.0, 0.3, 8.0, 2.0};
  }
  if (parameter == kRockRate) {
    return {3.0, 20.0, 80.0, 40.0};
  }
  if (parameter == kRockDamping) {
    return {0.01, 0.15, 1.0, 1.0};
  }
  if (parameter == kRockOwn) {
    return {-20.0, 0.0, 20.0, 0.2};
  }
  return parameter == kSensorLag ? Range{0.001, 0.01, 0.15, 0.02} : Range{-20.0, 0.02, 20.0, 2.0};
}

double usual_velocity(const std::vector<MotionRun>& runs, std::size_t joint) {
  double squares = 0.0;
  double rows = 0.0;
  for (const MotionRun& run : runs) {
    for (const double velocity : run.velocity_radps[joint]) {
      squares += velocity * velocity;
    }
    rows += static_cast<double>(run.size());
  }
  return std::sqrt(squares / rows);
}

JointModel start_model(const std::vector<MotionRun>& runs, std::size_t joint) {
  JointModel model;
  model.sign = sign_of(runs, joint);
  model.grid = grid_of(runs, joint);
  const double usual_radps = usual_velocity(runs, joint);
  for (std::size_t at = 0; at < kParameters; ++at) {
    model.value[at] = range(at, usual_radps).start;
  }
  return model;
}

void spread_bends(const std::vector<MotionRun>& runs, std::size_t joint, JointModel& model) {
  spread(model.value.data() + kForward, model.grid.forward, sorted_commands(runs, joint, 1.0));
  spread(model.value.data() + kBackward, model.grid.backward, sorted_commands(runs, joint, -1.0));
}

}  // namespace graben::identify
