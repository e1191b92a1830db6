// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_blade_soil.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

/// Runs off at both ends with every metre, of what is carried.
constexpr double kLostPerMetre = 0.03;
/// The force comes in over this speed: at rest the ground holds no more than the blade pushes.
constexpr double kOnset_mps = 0.05;
/// What a worn edge rubs with all the time, of the bearing force, and the slope of going down over
/// which the rest comes.
constexpr double kWorn = 0.1;
constexpr double kSteep = 0.3;
/// Deeper than this no blade goes at once.
constexpr double kMostDepth_m = 1.0;

}  // namespace

BladeSoil::BladeSoil(const SoilKind& soil, const DozerPlantProfile& profile)
    : soil_(soil),
      blade_(profile.blade_shape),
      factors_(soil),
      gravity_(profile.gravity_mps2),
      random_(profile.seed, Draw::kSoilKind, 1),
      side_random_(profile.seed, Draw::kSoilKind, 2) {}

double BladeSoil::holds_m3() const {
  return 0.5 * blade_.height_m * blade_.height_m * blade_.width_m / std::tan(soil_.repose_rad);
}

void BladeSoil::lose(double way_m) {
  const double kept = std::min(carried_ * std::exp(-kLostPerMetre * way_m), holds_m3());
  lost_ += carried_ - kept;
  carried_ = kept;
}

void BladeSoil::cut_strip(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, double share,
                          Terrain& terrain) {
  const double way_m = to_m.x() - from_m.x();
  if (way_m > 0.0) {
    // Over the ground that lies before it: between two nodes one is cut already.
    const double ground_m = terrain.height_m(to_m.x() + terrain.cell_m());
    const double over_m = 0.5 * (from_m.y() + to_m.y()) - ground_m;
    const double area_m2 = share * blade_.width_m * way_m;
    if (over_m < 0.0) {
      carried_ += -over_m * area_m2 * soil_.swell;
    } else if (carried_ > 0.0) {
      const double filled_m = std::min(over_m, share * carried_ / area_m2);
      carried_ -= filled_m * area_m2;
      terrain.fill(from_m.x(), to_m.x(), ground_m + filled_m);
    }
  }
  terrain.cut(from_m, to_m);
}

void BladeSoil::go_on(double way_m) {
  if (way_m > 0.0) {
    lose(way_m);
    gone_ += way_m;
    if (soil_.stone_m > 0.0 && gone_ > soil_.stone_m) {
      gone_ = 0.0;
      stone_ = random_.normal();
      stone_left_ = side_random_.normal();
    }
  } else if (way_m < 0.0) {
    // What it draws away from stays where it lies.
    lost_ += carried_;
    carried_ = 0.0;
  }
}

Eigen::Vector2d BladeSoil::force_n(const Eigen::Vector2d& edge_m,
                                   const Eigen::Vector2d& velocity_mps, double pitch_rad,
                                   const Terrain& terrain, double beside) const {
  const double depth_m =
      std::clamp(terrain.height_m(edge_m.x() + terrain.cell_m()) - edge_m.y(), 0.0, kMostDepth_m);
  const double forward_mps = velocity_mps.x();
  const double onset = std::clamp(forward_mps / kOnset_mps, 0.0, 1.0);
  if (onset <= 0.0) {
    return Eigen::Vector2d::Zero();
  }
  const double rake_rad = blade_.rake_rad - pitch_rad;
  const double weight_n = soil_.density_kgpm3 / soil_.swell * gravity_ * carried_;
  // Of the prism, what lies on the wedge that fails; its length is that of the free face.
  const CuttingFactors factors = factors_.at(rake_rad);
  const double wedge_m = depth_m / std::tan(factors.failure_rad);
  const double prism_m = std::sqrt(2.0 * carried_ / blade_.width_m / std::tan(soil_.repose_rad));
  const double on_wedge = prism_m > 0.0 ? std::min(1.0, wedge_m / prism_m) : 0.0;
  const double surcharge_pa =
      wedge_m > 1e-3 ? on_wedge * weight_n / (blade_.width_m * wedge_m) : 0.0;
  const CuttingForce cut =
      cutting_force(soil_, factors, rake_rad, depth_m, blade_.width_m, surcharge_pa, gravity_);
  const double stones = std::max(0.2, 1.0 + soil_.stone_share * (stone_ + beside * stone_left_));
  const double rides_n = (1.0 - on_wedge) * weight_n * std::tan(soil_.friction_rad);
  Eigen::Vector2d force_n = {-(stones * cut.against_n + rides_n), -stones * cut.down_n};
  if (depth_m > 0.0) {
    const double down = std::clamp(-velocity_mps.y() / forward_mps / kSteep, 0.0, 1.0);
    const double bearing_n = bearing_pa(soil_, blade_.edge_m, depth_m, gravity_) * blade_.edge_m *
                             blade_.width_m * (kWorn + (1.0 - kWorn) * down);
    force_n += bearing_n * Eigen::Vector2d(-std::tan(soil_.wall_friction_rad), 1.0);
  }
  force_n *= onset;
  return force_n;
}

}  // namespace graben::plant
