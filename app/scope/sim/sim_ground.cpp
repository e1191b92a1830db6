#include "app/scope/sim/sim_ground.hpp"

namespace graben::scope {
namespace {

/// So far in front of its face the tip has to be when a rock is put down: it is to be run into.
constexpr double kClear_m = 0.2;

}  // namespace

void SimGround::step(plant::ExcavatorPlant& plant) {
  if (plant.profile().soil.has_value() != soil_) {
    plant.set_soil(soil_ ? std::optional(soil_profile_) : std::nullopt);
  }
  const plant::Obstacle* rock = plant.obstacle();
  if (rock != nullptr && rock->gone()) {
    obstacle_ = false;
  }
  if (rock != nullptr && !obstacle_) {
    plant.set_obstacle(std::nullopt);
  }
  const plant::ObstacleProfile& place = obstacle_profile_;
  const double in_front_m = (plant.tip().position_m - place.point_m).dot(place.normal);
  if (rock == nullptr && obstacle_ && in_front_m > kClear_m) {
    plant.set_obstacle(place);
  }
}

}  // namespace graben::scope
