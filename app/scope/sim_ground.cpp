#include "app/scope/sim_ground.hpp"

namespace graben::scope {

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
  if (rock == nullptr && obstacle_ && !is_inside(obstacle_profile_, plant.tip().position_m)) {
    plant.set_obstacle(obstacle_profile_);
  }
}

}  // namespace graben::scope
