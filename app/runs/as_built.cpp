// SPDX-License-Identifier: Apache-2.0
#include "app/runs/as_built.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/layer_pose.hpp"

namespace graben::runs {
namespace {

/// On each side of a strip that has no neighbour there.
constexpr double kRim_m = 0.05;
constexpr double kQuantile = 0.95;

double quantile(std::vector<double> values, double share) {
  const auto at =
      static_cast<std::ptrdiff_t>(std::min(static_cast<double>(values.size()) - 1.0,
                                           std::floor(share * static_cast<double>(values.size()))));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

AsBuilt as_built(const TaskProgram& program, const plant::HeightField& ground) {
  AsBuilt built;
  if (!in_layers(program) || program.fences.count == 0) {
    return built;
  }
  const LayerPlan& plan = program.layers;
  const Fence& design = program.fences.fence[static_cast<unsigned>(program.fences.count - 1)];
  const Eigen::Vector3d up = -design.normal;
  const auto along = static_cast<int>(std::ceil(plan.way_m / kBuiltGrid_m));
  const double half_m = 0.5 * plan.width_m - kRim_m;
  const auto across = static_cast<int>(std::ceil(half_m / kBuiltGrid_m));
  std::vector<double> off_m;
  built.left_m3 = 0.0;
  built.over_cut_m3 = 0.0;
  const double place_m2 = (plan.way_m / along) * (half_m / across);
  for (int strip = 0; strip < plan.strips; ++strip) {
    const TeethLine line = line_over(program, strip, 0.0);
    const Eigen::Vector2d way = line.change.position_m.head<2>().normalized();
    const Eigen::Vector2d left(-way.y(), way.x());
    for (int i = 0; i < along; ++i) {
      for (int j = -across; j < across; ++j) {
        const Eigen::Vector2d at_m =
            line.at((i + 0.5) / along).position_m.head<2>() + half_m * (j + 0.5) / across * left;
        const auto over = [&](double height_m) {
          return up.dot(Eigen::Vector3d(at_m.x(), at_m.y(), height_m)) + design.offset_m;
        };
        const BuiltPlace place{{at_m.x(), at_m.y()},
                               over(ground.height_m(at_m.x(), at_m.y())),
                               over(ground.firm_m(at_m.x(), at_m.y()))};
        off_m.push_back(place.off_m);
        built.left_m3 += place_m2 * std::max(0.0, place.off_m);
        built.over_cut_m3 += place_m2 * std::max(0.0, -place.firm_m);
        built.map.push_back(place);
      }
    }
  }
  const auto within = std::count_if(off_m.begin(), off_m.end(),
                                    [](double off) { return std::abs(off) <= kBuilt_m; });
  built.area_m2 = place_m2 * static_cast<double>(off_m.size());
  built.within_ratio = static_cast<double>(within) / static_cast<double>(off_m.size());
  built.high_m = quantile(off_m, kQuantile);
  built.low_m = quantile(off_m, 1.0 - kQuantile);
  built.median_m = quantile(off_m, 0.5);
  return built;
}

}  // namespace graben::runs
