#pragma once
/// What the bucket of a simulated excavator meets, switched while it digs.

#include "app/plant/excavator_plant.hpp"

namespace graben::scope {

class SimGround {
 public:
  SimGround(const plant::SoilProfile& soil, const plant::ObstacleProfile& obstacle)
      : soil_profile_(soil), obstacle_profile_(obstacle) {}

  void want_soil(bool wanted) { soil_ = wanted; }
  /// A rock that has come loose is gone: it has to be wanted anew.
  void want_obstacle(bool wanted) { obstacle_ = wanted; }
  [[nodiscard]] bool soil() const { return soil_; }
  [[nodiscard]] bool obstacle() const { return obstacle_; }

  /// Before each cycle: gives the plant what is wanted. A rock is put down once the tip is well
  /// in front of its face.
  void step(plant::ExcavatorPlant& plant);

 private:
  plant::SoilProfile soil_profile_;
  plant::ObstacleProfile obstacle_profile_;
  bool soil_ = false;
  bool obstacle_ = false;
};

}  // namespace graben::scope
