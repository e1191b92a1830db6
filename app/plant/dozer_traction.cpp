#include "app/plant/dozer_traction.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

/// 1 - (1 - exp(-u)) / u for u >= 0.
double mean_shear_stress(double u) {
  constexpr double kLinear = 1e-5;
  return u < kLinear ? 0.5 * u : 1.0 + std::expm1(-u) / u;
}

}  // namespace

Traction::Traction(const DozerPlantProfile& profile)
    : friction_(profile.ground.friction),
      modulus_(profile.ground.slip_modulus_m),
      contact_(profile.machine.body.track_contact_m),
      damping_(profile.shear_damping_nspm) {}

double Traction::step(double track_speed_mps, double ground_speed_mps, double load_n,
                      double step_s) {
  const double passing = std::max(std::abs(track_speed_mps), std::abs(ground_speed_mps));
  const double before = shear_;
  shear_ = (before + step_s * (track_speed_mps - ground_speed_mps)) /
           (1.0 + step_s * passing / contact_);
  const double most = friction_ * load_n;
  const double stress = std::copysign(mean_shear_stress(std::abs(shear_) / modulus_), shear_);
  const double damped = most * stress + damping_ * (shear_ - before) / step_s;
  force_ = std::clamp(damped, -most, most);
  return force_;
}

}  // namespace graben::plant
