// SPDX-License-Identifier: Apache-2.0
/// Grounds that are tried as heights on a grid.

#include <cmath>

#include "app/machines/design_section.hpp"
#include "app/runs/assist_run.hpp"

namespace graben::runs {
namespace {

using Height = std::function<double(const Eigen::Vector2d&)>;

std::shared_ptr<const AssistGround> ground_of(const ExcavatorProfile& profile, const char* name,
                                              const Height& height_m) {
  constexpr double kStep_m = 0.05;
  machines::HeightGrid grid;
  const double reach_m = machines::reach_m(profile);
  const int half = static_cast<int>(std::ceil((reach_m + 1.0) / kStep_m));
  grid.columns = grid.rows = 2 * half + 1;
  grid.step_m = kStep_m;
  grid.first_m.setConstant(-half * kStep_m);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      grid.height_m.push_back(height_m(grid.first_m + kStep_m * Eigen::Vector2d(column, row)));
    }
  }
  auto ground = std::make_shared<AssistGround>();
  ground->name = name;
  ground->surface = machines::held_surface(grid, {}, machines::kUsualRounding_m, reach_m);
  ground->height_m = height_m;
  return ground;
}

}  // namespace

std::vector<std::shared_ptr<const AssistGround>> assist_grounds(const ExcavatorProfile& profile) {
  const ExcavatorGeometry& of = profile.geometry;
  // As assist_way.cpp has its way.
  const double middle_m = 0.54 * (of.boom_length_m + of.arm_length_m + of.bucket_length_m);
  constexpr double kDepth_m = 0.3;
  std::vector<std::shared_ptr<const AssistGround>> grounds;
  grounds.push_back(ground_of(profile, "flat", [](const Eigen::Vector2d&) { return -kDepth_m; }));
  grounds.push_back(ground_of(profile, "slope 1:2", [middle_m](const Eigen::Vector2d& at_m) {
    return -kDepth_m + 0.5 * (at_m.x() - middle_m) - 0.5;
  }));
  machines::Ditch ditch;
  constexpr double kHalf_m = 4.0;
  ditch.from_m = {middle_m, -kHalf_m, -1.0};
  ditch.to_m = {middle_m, kHalf_m};
  ditch.left = ditch.right = 0.5;
  ditch.top_m = 2.0;
  auto ground = std::make_shared<AssistGround>();
  ground->name = "V ditch";
  const double reach_m = machines::reach_m(profile);
  ground->surface = machines::held_surface(machines::ditch_grid(ditch, {}, reach_m), {},
                                           machines::kUsualRounding_m, reach_m);
  ground->height_m = [ditch](const Eigen::Vector2d& at_m) { return ditch.height_m(at_m); };
  grounds.push_back(ground);
  return grounds;
}

}  // namespace graben::runs
