// SPDX-License-Identifier: Apache-2.0
#include "app/cli/crest_ground.hpp"

#include "app/design/surface_grid.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::cli {

std::shared_ptr<const runs::AssistGround> crest_ground(const ExcavatorProfile& profile) {
  const auto surface = std::make_shared<const design::Surface>(
      design::read_landxml(machines::find_design("crest.xml"), ""));
  machines::SiteFrame site;
  site.benchmark_m = {100.0, 200.0, 54.3};
  site.heading_rad = 0.3;
  constexpr double kStep_m = 0.025;
  auto ground = std::make_shared<runs::AssistGround>();
  ground->name = "crest, hollow";
  ground->surface = machines::held_surface(design::grid_of(*surface, {kStep_m, {}}), site,
                                           machines::kUsualRounding_m, machines::reach_m(profile));
  ground->height_m = [surface, site](const Eigen::Vector2d& at_m) {
    const Eigen::Vector3d there_m = site.to_site({at_m.x(), at_m.y(), 0.0});
    return design::height_at(*surface, there_m.head<2>()) - there_m.z();
  };
  return ground;
}

}  // namespace graben::cli
